//! Primitives: triangles in the frame of a node, and from there into the world.

use ::gltf::json;
use ::gltf::json::accessor::Type;
use ::gltf::json::mesh::{Mode, Semantic};
use ::gltf::json::validation::Checked;
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};
use rayon::prelude::*;

use super::accessor;
use super::attribute::attribute;
use super::deform::Deformation;
use super::document::Document;
use super::error::GltfError;
use super::extras::COLOURS;
use super::material::SurfaceUvs;
use super::notices::{Notices, Part};
use super::source::Source;
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
    // Without normals of its own, each triangle gets its own vertices; vertices of no triangle are left out.
    let flat = attribute(primitive, Semantic::Normals).is_none();
    Ok(Some(Extent { vertices: if flat { corners } else { vertices.min(corners) }, corners }))
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
        let source = &mut Source::new(document, primitive, &place)?;
        let indices = source.triangles(notices)?;

        // Read the attributes.
        let positions = source.vectors::<Vec3>(Semantic::Positions, "POSITION", Type::Vec3)?;
        let mut positions =
            positions.ok_or_else(|| document.damaged(&format!("{place}.attributes"), "POSITION is missing"))?;
        let normals = source.vectors::<Vec3>(Semantic::Normals, "NORMAL", Type::Vec3);
        let mut normals = source.optional("NORMAL", normals, notices)?;
        let uvs = source.uvs(channel.base, notices)?;
        let emissive_uvs = match channel.emissive {
            None => Vec::new(),
            Some(emissive) => {
                let read = source.uvs(emissive, notices)?;
                // Coordinates of 0 have to be kept beside others.
                if read.is_empty() && !uvs.is_empty() { vec![Vec2::ZERO; positions.len()] } else { read }
            }
        };
        let unclamped = Semantic::Extras(COLOURS.into());
        let semantic = match attribute(primitive, unclamped.clone()) {
            Some(_) => (unclamped, COLOURS),
            None => (Semantic::Colors(0), "COLOR_0"),
        };
        let colours = source.optional(semantic.1, source.colours(semantic.0, semantic.1), notices)?;
        let colours = colours.unwrap_or_default();
        let mirrored = match deformation {
            Some(deformation) => deformation.apply(source, &mut positions, normals.as_mut(), notices)?,
            None => false,
        };
        let mut read = Self { positions, indices, normals: Vec::new(), uvs, emissive_uvs, colours, material };
        if mirrored {
            read.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        match normals {
            Some(normals) => read.normals = normals,
            None => read.flatten(),
        }
        Ok(read)
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
