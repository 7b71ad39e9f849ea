//! Scenes of the sizes that Weiskopf measured (W table 6.1).

use built_in::lattice::Lattice;
use glam::Vec3;
use scene::refine::{RefineError, refine};
use scene::{Mesh, Scene};

/// Numbers of vertices and triangles in W table 6.1.
pub const SIZES: [[usize; 2]; 3] = [[21_198, 18_770], [135_907, 113_397], [20_786, 19_864]];

/// Boxes around the origin with exactly this many vertices and triangles.
///
/// A box with whole faces has 24 and 12, one with faces of four by four squares 150 and 192: two equations for the
/// numbers of both. Whole numbers leave a rest of less than a percent, which vertices without triangles and triangles
/// drawn twice make up.
pub fn scene_of(vertices: usize, triangles: usize) -> Result<Scene, RefineError> {
    let cut = (2 * triangles - vertices) / 234;
    let whole = (vertices - 150 * cut) / 24;
    let side = ((cut + whole) as f64).cbrt().ceil() as u32;
    let lattice = Lattice { count: [side; 3], ..Default::default() };
    let whole_box = Lattice { count: [1; 3], ..lattice }.build();
    let cut_box = refine(&whole_box, 0.36 * lattice.side)?;

    let mut mesh = Mesh::default();
    for index in 0..cut + whole {
        let column = index as u32;
        let centre = lattice.centre([column % side, column / side % side, column / (side * side)]);
        append(&mut mesh, &if index < cut { &cut_box } else { &whole_box }.meshes[0], centre);
    }
    for last in vec![mesh.positions.len() - 1; vertices - mesh.positions.len()] {
        mesh.positions.push(mesh.positions[last]);
        mesh.normals.push(mesh.normals[last]);
        mesh.uvs.push(mesh.uvs[last]);
        mesh.colours.push(mesh.colours[last]);
    }
    mesh.indices.extend_from_within(..3 * triangles - mesh.indices.len());
    Ok(Scene { meshes: vec![mesh], ..whole_box })
}

/// Adds a copy of `source`, moved by `offset`.
fn append(mesh: &mut Mesh, source: &Mesh, offset: Vec3) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(source.positions.iter().map(|&position| position + offset));
    mesh.normals.extend(&source.normals);
    mesh.uvs.extend(&source.uvs);
    mesh.colours.extend(&source.colours);
    mesh.indices.extend(source.indices.iter().map(|index| first + index));
}
