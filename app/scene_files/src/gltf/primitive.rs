//! Primitives: triangles, from accessors or Draco data to arrays, and from a node's frame into the world.
//!
//! Positions decide: without them a primitive is left out. Any other attribute that cannot be read is replaced by its
//! default, and a triangle with a corner that does not exist is left out alone.

use ::gltf::json;
use ::gltf::json::accessor::{ComponentType, Type};
use ::gltf::json::mesh::{Mode, Semantic};
use ::gltf::json::validation::Checked;
use bytemuck::Pod;
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use rayon::prelude::*;

use super::accessor::{self, Purpose};
use super::attribute::attribute;
use super::deform::Deformation;
use super::document::Document;
use super::draco::DracoData;
use super::error::GltfError;
use super::extras::COLOURS;
use super::material::{SurfaceUvs, UvChannel};
use super::notices::{Notices, Part};
use scene::Mesh;

/// Number of vertices that a thread places at least.
const FEW: usize = 8192;

/// Tolerance of a normal's squared length, for f32 rounding; beyond it the normal is normalised.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Triangles in the frame of their node. All vertex arrays have the same length, except for those with a default, which
/// may be empty, as in a [`Mesh`].
#[derive(Clone, Default)]
pub(super) struct Primitive {
    pub(super) positions: Vec<Vec3>,
    pub(super) indices: Vec<u32>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    emissive_uvs: Vec<Vec2>,
    colours: Vec<[f32; 4]>,
    material: usize,
}

/// Upper bounds of a primitive's arrays, before any data are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Extent {
    /// Number of vertices.
    pub(super) vertices: u64,
    /// Number of indices of triangles.
    pub(super) corners: u64,
}

/// Upper bounds of a primitive's arrays, or `None` if it has no triangles. No data are read.
pub(super) fn extent(
    document: &Document<'_>,
    primitive: &json::mesh::Primitive,
    place: &str,
    notices: &mut Notices,
) -> Result<Option<Extent>, GltfError> {
    let Checked::Valid(mode) = primitive.mode else {
        return Err(document.damaged(&format!("{place}.mode"), "there is no such mode"));
    };
    let strip = match mode {
        Mode::Triangles => false,
        Mode::TriangleStrip | Mode::TriangleFan => true,
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
            notices.add("points and lines are not drawn".into());
            return Ok(None);
        }
    };
    let Some(positions) = attribute(primitive, Semantic::Positions) else {
        notices.add("parts without positions are not drawn".into());
        return Ok(None);
    };
    let vertices = accessor::count(document, positions, place)? as u64;
    let entries = match primitive.indices {
        Some(indices) => accessor::count(document, indices.value(), &format!("{place}.indices"))? as u64,
        None => vertices,
    };
    if vertices == 0 || entries == 0 {
        notices.add("parts without vertices are not drawn".into());
        return Ok(None);
    }
    let corners = if strip { 3 * entries } else { entries };
    // Without normals of its own, each triangle gets its own vertices.
    let flat = attribute(primitive, Semantic::Normals).is_none();
    Ok(Some(Extent { vertices: if flat { corners } else { vertices }, corners }))
}

/// Data of a primitive that is being read: in accessors, or in Draco's form.
struct Source<'a> {
    document: &'a Document<'a>,
    primitive: &'a json::mesh::Primitive,
    place: &'a str,
    draco: Option<DracoData>,
}

impl Source<'_> {
    /// Components of an attribute and their number in an element; `None` if the primitive has no such attribute.
    fn attribute(
        &self,
        semantic: Semantic,
        name: &str,
        purpose: Purpose,
    ) -> Result<Option<(Vec<f32>, usize)>, GltfError> {
        let place = format!("{}.attributes.{name}", self.place);
        if let Some(found) = self.draco.as_ref().and_then(|draco| draco.attribute(name)) {
            let (values, width) = found;
            return match purpose.width() {
                Some(expected) if expected != width => {
                    Err(self.document.damaged(&place, format!("{width} components instead of {expected}")))
                }
                _ => Ok(Some((values, width))),
            };
        }
        let Some(index) = attribute(self.primitive, semantic) else { return Ok(None) };
        let numbers = accessor::read(self.document, index, &place, purpose, |value| value as f32)?;
        Ok(Some((numbers.values, numbers.width)))
    }

    /// Vectors of an attribute; `None` if the primitive has no such attribute.
    fn vectors<T: Pod>(&self, semantic: Semantic, name: &str, element: Type) -> Result<Option<Vec<T>>, GltfError> {
        let index = attribute(self.primitive, semantic.clone()).filter(|_| self.draco.is_none());
        let stored = index.and_then(|index| accessor::as_stored(self.document, index, (element, ComponentType::F32)));
        if stored.is_some() {
            return Ok(stored);
        }
        let found = self.attribute(semantic, name, Purpose::Vectors(element))?;
        Ok(found.map(|(values, _)| bytemuck::pod_collect_to_vec(&values)))
    }

    /// Colours of the vertices; `None` if the primitive has none.
    fn colours(&self, semantic: Semantic, name: &str) -> Result<Option<Vec<[f32; 4]>>, GltfError> {
        let found = self.attribute(semantic, name, Purpose::Colours)?;
        Ok(found.map(|(values, width)| {
            let colour = |c: &[f32]| [c[0], c[1], c[2], c.get(3).copied().unwrap_or(1.0)];
            values.chunks_exact(width).map(colour).collect()
        }))
    }

    /// Elements of an attribute that has a default: one that could not be read, or has another number of elements
    /// than there are vertices, is `None`, and named.
    fn optional<T>(
        &self,
        name: &str,
        found: Result<Option<Vec<T>>, GltfError>,
        vertices: usize,
        notices: &mut Notices,
    ) -> Result<Option<Vec<T>>, GltfError> {
        let place = format!("{}.attributes.{name}", self.place);
        match found {
            Ok(Some(values)) if values.len() != vertices => {
                let fault = format!("{} entries for {vertices} positions", values.len());
                notices.left_out(Part::Mesh, &place, &fault);
                Ok(None)
            }
            Ok(found) => Ok(found),
            Err(error) => {
                notices.left_out(Part::Mesh, &place, &error.part_fault()?);
                Ok(None)
            }
        }
    }

    /// Texture coordinates of a set as a surface takes them; empty if they are 0, for want of others.
    fn uvs(&self, of: UvChannel, vertices: usize, notices: &mut Notices) -> Result<Vec<Vec2>, GltfError> {
        let name = format!("TEXCOORD_{}", of.set);
        let found = self.vectors(Semantic::TexCoords(of.set), &name, Type::Vec2);
        Ok(match self.optional(&name, found, vertices, notices)? {
            Some(mut uvs) => {
                uvs.iter_mut().for_each(|uv| *uv = of.apply(*uv));
                uvs
            }
            None if of.apply(Vec2::ZERO) == Vec2::ZERO => Vec::new(),
            None => vec![of.apply(Vec2::ZERO); vertices],
        })
    }
}

impl Primitive {
    /// Reads a primitive, given by the indices of its mesh and of itself, and deforms it.
    pub(super) fn read(
        document: &Document<'_>,
        (mesh, index): (usize, usize),
        deformation: Option<&Deformation>,
        channels: &[SurfaceUvs],
        notices: &mut Notices,
    ) -> Result<Self, GltfError> {
        let place = format!("meshes[{mesh}].primitives[{index}]");
        let primitive = &document.json.meshes[mesh].primitives[index];
        let default = document.json.materials.len(); // the default material is the last
        let material = primitive.material.map(|material| material.value());
        if let Some(missing) = material.filter(|material| *material >= default) {
            let fault = format!("there is no number {missing} among {default}");
            notices.left_out(Part::Material, &format!("{place}.material"), &fault);
        }
        let material = material.map_or(default, |material| material.min(default));
        let channel = channels[material];
        let source =
            Source { document, primitive, place: &place, draco: DracoData::read(document, primitive, &place)? };

        // Read the attributes.
        let positions = source.vectors::<Vec3>(Semantic::Positions, "POSITION", Type::Vec3)?;
        let mut positions =
            positions.ok_or_else(|| document.damaged(&format!("{place}.attributes"), "POSITION is missing"))?;
        let count = positions.len();
        let normals = source.vectors::<Vec3>(Semantic::Normals, "NORMAL", Type::Vec3);
        let mut normals = source.optional("NORMAL", normals, count, notices)?;
        let uvs = source.uvs(channel.base, count, notices)?;
        let emissive_uvs = match channel.emissive {
            None => Vec::new(),
            Some(emissive) => {
                let read = source.uvs(emissive, count, notices)?;
                // Coordinates of 0 have to be kept beside others.
                if read.is_empty() && !uvs.is_empty() { vec![Vec2::ZERO; count] } else { read }
            }
        };
        let unclamped = Semantic::Extras(COLOURS.into());
        let semantic = match attribute(primitive, unclamped.clone()) {
            Some(_) => (unclamped, COLOURS),
            None => (Semantic::Colors(0), "COLOR_0"),
        };
        let colours = source.optional(semantic.1, source.colours(semantic.0, semantic.1), count, notices)?;
        let colours = colours.unwrap_or_default();
        let mirrored = match deformation {
            Some(deformation) => {
                let read = |semantic, name: &str, purpose| source.attribute(semantic, name, purpose);
                deformation.apply(document, (primitive, &place), &read, &mut positions, normals.as_mut(), notices)?
            }
            None => false,
        };

        // Read the triangles.
        let corners = match (&source.draco, primitive.indices) {
            (Some(draco), _) => draco.indices(),
            (None, Some(index)) => {
                let scalar = |component| (Type::Scalar, component);
                let index = index.value();
                if let Some(stored) = accessor::as_stored::<u32>(document, index, scalar(ComponentType::U32)) {
                    stored
                } else if let Some(stored) = accessor::as_stored::<u16>(document, index, scalar(ComponentType::U16)) {
                    stored.into_iter().map(u32::from).collect()
                } else {
                    let place = format!("{place}.indices");
                    accessor::read(document, index, &place, Purpose::Indices, |value| value as u32)?.values
                }
            }
            (None, None) => (0..count as u32).collect(),
        };
        let indices = match primitive.mode {
            Checked::Valid(Mode::TriangleStrip) if source.draco.is_none() => strip(&corners),
            Checked::Valid(Mode::TriangleFan) if source.draco.is_none() => fan(&corners),
            _ => corners,
        };
        let mut read = Self { positions, indices, normals: Vec::new(), uvs, emissive_uvs, colours, material };
        if !read.indices.len().is_multiple_of(3) {
            notices.add(format!("{place} ends in an incomplete triangle, which is left out"));
            read.indices.truncate(read.indices.len() / 3 * 3);
        }
        read.keep_whole_triangles(&place, notices);
        if mirrored {
            read.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        match normals {
            Some(normals) => read.normals = normals,
            None => read.flatten(),
        }
        Ok(read)
    }

    /// Leaves out the triangles with a corner that does not exist.
    fn keep_whole_triangles(&mut self, place: &str, notices: &mut Notices) {
        let count = self.positions.len();
        let Some(beyond) = self.indices.iter().copied().find(|&corner| corner as usize >= count) else { return };
        let before = self.indices.len() / 3;
        let whole = |corners: &&[u32; 3]| corners.iter().all(|&corner| (corner as usize) < count);
        let kept: Vec<[u32; 3]> = self.indices.as_chunks::<3>().0.iter().filter(whole).copied().collect();
        let fault = format!("vertex {beyond} of {count}; {} of {before} triangles", before - kept.len());
        notices.left_out(Part::Mesh, &format!("{place}.indices"), &fault);
        self.indices = kept.into_flattened();
    }

    /// Gives each triangle its own vertices and its own normal, as glTF demands for a file without normals.
    fn flatten(&mut self) {
        fn spread<T: Copy>(values: &mut Vec<T>, indices: &[u32]) {
            if !values.is_empty() {
                *values = indices.iter().map(|&index| values[index as usize]).collect();
            }
        }
        spread(&mut self.positions, &self.indices);
        spread(&mut self.uvs, &self.indices);
        spread(&mut self.emissive_uvs, &self.indices);
        spread(&mut self.colours, &self.indices);
        self.indices = (0..self.indices.len() as u32).collect();
        let normal = |&[a, b, c]: &[Vec3; 3]| {
            let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
            [(b - a).cross(c - a).normalize_or_zero().as_vec3(); 3]
        };
        self.normals = self.positions.as_chunks().0.iter().flat_map(normal).collect();
    }

    /// Mesh in the world, relative to `origin`, and the number of its vertices that are not finite.
    ///
    /// A mirroring transform reverses the winding of triangles, so it is reversed again. Normals transform by the
    /// inverse transpose, which is the cofactor matrix but for length and the determinant's sign, and exists for flat
    /// transforms too.
    pub(super) fn place(mut self, name: String, mut transform: DAffine3, origin: DVec3) -> (Mesh, usize) {
        transform.translation -= origin;
        let linear = transform.matrix3;
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis].map(|axis| axis / largest(linear));
        let mirror = x.dot(y.cross(z)) < 0.0;
        let sign = if mirror { -1.0 } else { 1.0 };
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        self.positions.par_iter_mut().with_min_len(FEW).for_each(|position| {
            *position = transform.transform_point3(position.as_dvec3()).as_vec3();
        });
        self.normals.par_iter_mut().with_min_len(FEW).for_each(|normal| *normal = unit(cofactors * normal.as_dvec3()));
        let Self { positions, indices: mut corners, normals, uvs, emissive_uvs, colours, material } = self;
        if mirror {
            corners.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let not_finite = positions.iter().filter(|position| !position.is_finite()).count();
        (
            Mesh {
                name,
                material,
                positions,
                normals,
                uvs,
                emissive_uvs,
                colours,
                indices: corners,
                solid: true,
                motion: None,
            },
            not_finite,
        )
    }
}

/// Largest component of a matrix; dividing by it keeps products from overflowing or vanishing. 1 if it is not a
/// normal number.
fn largest(matrix: DMat3) -> f64 {
    let largest = matrix.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
    if largest.is_normal() { largest } else { 1.0 }
}

/// Unit vector of a normal, or up if it has no direction. A normal that is unit already stays the same to the bit.
fn unit(normal: DVec3) -> Vec3 {
    if (normal.length_squared() - 1.0).abs() <= UNIT_TOLERANCE {
        normal.as_vec3()
    } else {
        normal.try_normalize().unwrap_or(DVec3::Y).as_vec3()
    }
}

/// Triangles of a strip: each vertex with the two before it; every other triangle is reversed.
fn strip(corners: &[u32]) -> Vec<u32> {
    let triangle = |(index, corner): (usize, &[u32])| {
        if index % 2 == 0 { [corner[0], corner[1], corner[2]] } else { [corner[0], corner[2], corner[1]] }
    };
    corners.windows(3).enumerate().flat_map(triangle).collect()
}

/// Triangles of a fan: each vertex with the one before it and the first (glTF 2.0, 3.7.2.1: the first comes last).
fn fan(corners: &[u32]) -> Vec<u32> {
    let first = corners.first().copied().unwrap_or_default();
    corners.get(1..).unwrap_or_default().windows(2).flat_map(|pair| [pair[0], pair[1], first]).collect()
}
