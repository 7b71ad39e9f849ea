//! Primitives: triangles, from accessors or Draco data to arrays, and from a node's frame into the world.
//!
//! Positions decide: without them a primitive is left out. Any other attribute that cannot be read is replaced by its
//! default, and a triangle with a corner that does not exist is left out alone.

use ::gltf::json;
use ::gltf::json::accessor::Type;
use ::gltf::json::mesh::{Mode, Semantic};
use ::gltf::json::validation::Checked;
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};

use super::accessor::{self, Purpose};
use super::attribute::attribute;
use super::deform::Deformation;
use super::document::Document;
use super::draco::DracoData;
use super::error::GltfError;
use super::extras::COLOURS;
use super::material::SurfaceUvs;
use super::notices::{Notices, Part};
use scene::Mesh;

/// Tolerance of a normal's squared length, for f32 rounding; beyond it the normal is normalised.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Triangles in the frame of their node. All vertex arrays have the same length, except for `emissive_uvs`, which may
/// be empty.
#[derive(Default)]
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

    /// Components of an attribute that has a default: one that cannot be read, or has another number of elements
    /// than there are vertices, is `None`, and named.
    fn optional(
        &self,
        (semantic, name, purpose): (Semantic, &str, Purpose),
        vertices: usize,
        notices: &mut Notices,
    ) -> Result<Option<(Vec<f32>, usize)>, GltfError> {
        let place = format!("{}.attributes.{name}", self.place);
        match self.attribute(semantic, name, purpose) {
            Ok(Some((values, width))) if values.len() != width * vertices => {
                let fault = format!("{} entries for {vertices} positions", values.len() / width);
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

    fn uvs(&self, set: u32, vertices: usize, notices: &mut Notices) -> Result<Option<Vec<Vec2>>, GltfError> {
        let name = format!("TEXCOORD_{set}");
        let purpose = Purpose::Vectors(Type::Vec2);
        let found = self.optional((Semantic::TexCoords(set), &name, purpose), vertices, notices)?;
        Ok(found.map(|(values, _)| values.as_chunks().0.iter().copied().map(Vec2::from_array).collect()))
    }
}

fn vectors(values: &[f32]) -> Vec<Vec3> {
    values.as_chunks().0.iter().copied().map(Vec3::from_array).collect()
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
        let purpose = Purpose::Vectors(Type::Vec3);
        let positions = source.attribute(Semantic::Positions, "POSITION", purpose)?;
        let (positions, _) =
            positions.ok_or_else(|| document.damaged(&format!("{place}.attributes"), "POSITION is missing"))?;
        let mut positions = vectors(&positions);
        let count = positions.len();
        let normals = source.optional((Semantic::Normals, "NORMAL", purpose), count, notices)?;
        let mut normals = normals.map(|(values, _)| vectors(&values));
        let uvs = source.uvs(channel.base.set, count, notices)?;
        let emissive_uvs = match channel.emissive {
            None => Vec::new(),
            Some(emissive) => {
                let uvs = source.uvs(emissive.set, count, notices)?.unwrap_or_else(|| vec![Vec2::ZERO; count]);
                uvs.into_iter().map(|uv| emissive.apply(uv)).collect()
            }
        };
        let uvs = uvs.unwrap_or_else(|| vec![Vec2::ZERO; count]).into_iter().map(|uv| channel.base.apply(uv));
        let uvs = uvs.collect();
        let unclamped = Semantic::Extras(COLOURS.into());
        let semantic = match attribute(primitive, unclamped.clone()) {
            Some(_) => (unclamped, COLOURS, Purpose::Colours),
            None => (Semantic::Colors(0), "COLOR_0", Purpose::Colours),
        };
        let colours = match source.optional(semantic, count, notices)? {
            Some((values, width)) => {
                let colour = |c: &[f32]| [c[0], c[1], c[2], c.get(3).copied().unwrap_or(1.0)];
                values.chunks_exact(width).map(colour).collect()
            }
            None => vec![[1.0; 4]; count],
        };
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
                let place = format!("{place}.indices");
                accessor::read(document, index.value(), &place, Purpose::Indices, |value| value as u32)?.values
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
            *values = indices.iter().map(|&index| values[index as usize]).collect();
        }
        spread(&mut self.positions, &self.indices);
        spread(&mut self.uvs, &self.indices);
        if !self.emissive_uvs.is_empty() {
            spread(&mut self.emissive_uvs, &self.indices);
        }
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
    pub(super) fn place(&self, name: String, mut transform: DAffine3, origin: DVec3) -> (Mesh, usize) {
        transform.translation -= origin;
        let linear = transform.matrix3;
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis].map(|axis| axis / largest(linear));
        let mirror = x.dot(y.cross(z)) < 0.0;
        let sign = if mirror { -1.0 } else { 1.0 };
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        let positions: Vec<Vec3> =
            self.positions.iter().map(|position| transform.transform_point3(position.as_dvec3()).as_vec3()).collect();
        let normals = self.normals.iter().map(|normal| unit(cofactors * normal.as_dvec3())).collect();
        let mut indices = self.indices.clone();
        if mirror {
            indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let not_finite = positions.iter().filter(|position| !position.is_finite()).count();
        let (uvs, emissive_uvs, colours) = (self.uvs.clone(), self.emissive_uvs.clone(), self.colours.clone());
        (
            Mesh {
                name,
                material: self.material,
                positions,
                normals,
                uvs,
                emissive_uvs,
                colours,
                indices,
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
