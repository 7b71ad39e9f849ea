//! Primitives: triangles, from accessors to arrays, and from a node's frame into the world.

use ::gltf::json;
use ::gltf::json::accessor::Type;
use ::gltf::json::mesh::{Mode, Semantic};
use ::gltf::json::validation::Checked;
use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};

use super::accessor::{self, Purpose};
use super::container::Document;
use super::error::GltfError;
use super::extras::COLOURS;
use super::material::UvChannel;
use super::notices::Notices;
use scene::Mesh;

/// Tolerance of a normal's squared length, for f32 rounding; beyond it the normal is normalised.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Triangles in the frame of their node. All vertex arrays have the same length.
pub(super) struct Primitive {
    pub(super) positions: Vec<Vec3>,
    pub(super) indices: Vec<u32>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    colours: Vec<[f32; 4]>,
    material: usize,
}

/// Upper bound of the length of the primitive's longest array, or `None` if it has no triangles. No data are read.
pub(super) fn corners(
    document: &Document,
    primitive: &json::mesh::Primitive,
    place: &str,
    notices: &mut Notices,
) -> Result<Option<u64>, GltfError> {
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
    let vertices = accessor::count(document, positions(document, primitive, place)?, place)? as u64;
    let entries = match primitive.indices {
        Some(indices) => accessor::count(document, indices.value(), &format!("{place}.indices"))? as u64,
        None => vertices,
    };
    Ok(Some(vertices.max(if strip { 3 * entries } else { entries })))
}

fn positions(document: &Document, primitive: &json::mesh::Primitive, place: &str) -> Result<usize, GltfError> {
    let missing = || document.damaged(&format!("{place}.attributes"), "POSITION is missing");
    attribute(primitive, Semantic::Positions).ok_or_else(missing)
}

fn attribute(primitive: &json::mesh::Primitive, semantic: Semantic) -> Option<usize> {
    primitive.attributes.get(&Checked::Valid(semantic)).map(|index| index.value())
}

impl Primitive {
    /// Reads a primitive, given by the indices of its mesh and of itself.
    pub(super) fn read(
        document: &Document,
        (mesh, index): (usize, usize),
        channels: &[UvChannel],
        notices: &mut Notices,
    ) -> Result<Self, GltfError> {
        let place = format!("meshes[{mesh}].primitives[{index}]");
        let primitive = &document.json.meshes[mesh].primitives[index];
        let material = primitive.material.map(|material| material.value());
        if let Some(material) = material {
            document.item(&document.json.materials, material, &format!("{place}.material"))?;
        }
        let material = material.unwrap_or(document.json.materials.len()); // the default one is the last
        let channel = channels[material];

        // Read the attributes.
        let index = positions(document, primitive, &place)?;
        let vectors = |index, name: &str| {
            let place = format!("{place}.attributes.{name}");
            accessor::read(document, index, &place, Purpose::Vectors(Type::Vec3), |value| value as f32)
                .map(|numbers| numbers.values.as_chunks().0.iter().copied().map(Vec3::from_array).collect::<Vec<_>>())
        };
        let positions = vectors(index, "POSITION")?;
        let count = positions.len();
        let normals = attribute(primitive, Semantic::Normals).map(|index| vectors(index, "NORMAL")).transpose()?;
        let uvs = match attribute(primitive, Semantic::TexCoords(channel.set)) {
            Some(index) => {
                let place = format!("{place}.attributes.TEXCOORD_{}", channel.set);
                let purpose = Purpose::Vectors(Type::Vec2);
                let numbers = accessor::read(document, index, &place, purpose, |value| value as f32)?;
                numbers.values.as_chunks().0.iter().map(|&uv| channel.apply(Vec2::from_array(uv))).collect()
            }
            None => vec![Vec2::ZERO; count],
        };
        let unclamped = attribute(primitive, Semantic::Extras(COLOURS.into()));
        let colours = match unclamped.or_else(|| attribute(primitive, Semantic::Colors(0))) {
            Some(index) => {
                let place = format!("{place}.attributes.COLOR_0");
                let numbers = accessor::read(document, index, &place, Purpose::Colours, |value| value as f32)?;
                let colour = |c: &[f32]| [c[0], c[1], c[2], c.get(3).copied().unwrap_or(1.0)];
                numbers.values.chunks_exact(numbers.width).map(colour).collect()
            }
            None => vec![[1.0; 4]; count],
        };
        for (name, length) in
            [("NORMAL", normals.as_ref().map_or(count, Vec::len)), ("TEXCOORD", uvs.len()), ("COLOR_0", colours.len())]
        {
            if length != count {
                let fault = format!("{length} entries for {count} positions");
                return Err(document.damaged(&format!("{place}.attributes.{name}"), fault));
            }
        }

        // Read the triangles.
        let corners = match primitive.indices {
            Some(index) => {
                let place = format!("{place}.indices");
                accessor::read(document, index.value(), &place, Purpose::Indices, |value| value as u32)?.values
            }
            None => (0..count as u32).collect(),
        };
        if let Some(beyond) = corners.iter().find(|&&corner| corner as usize >= count) {
            return Err(document.damaged(&format!("{place}.indices"), format!("vertex {beyond} of {count}")));
        }
        let indices = match primitive.mode {
            Checked::Valid(Mode::TriangleStrip) => strip(&corners),
            Checked::Valid(Mode::TriangleFan) => fan(&corners),
            _ => corners,
        };
        let mut read = Self { positions, indices, normals: Vec::new(), uvs, colours, material };
        if !read.indices.len().is_multiple_of(3) {
            notices.add(format!("{place} ends in an incomplete triangle, which is left out"));
            read.indices.truncate(read.indices.len() / 3 * 3);
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
            *values = indices.iter().map(|&index| values[index as usize]).collect();
        }
        spread(&mut self.positions, &self.indices);
        spread(&mut self.uvs, &self.indices);
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
        let (uvs, colours) = (self.uvs.clone(), self.colours.clone());
        (
            Mesh {
                name,
                material: self.material,
                positions,
                normals,
                uvs,
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
