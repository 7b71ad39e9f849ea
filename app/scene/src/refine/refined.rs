//! Refined scenes: every edge that the rule splits is split, mesh by mesh.

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use super::divide::divide;
use super::error::RefineError;
use super::split_rule::{SplitRule, distance_squared, midpoint};
use crate::mesh::Mesh;
use crate::scene::{MAX_TRIANGLES, Scene};

/// Number of f32 steps that an edge must span at least. Rounding of midpoints then stays well below the amount by
/// which a split shortens an edge.
const STEPS_PER_EDGE: f32 = 16.0;

/// Ratio of the estimated number of triangles to the largest one from which on nothing is counted.
const SURE: f64 = 3.0;

/// Refined scene: no edge is longer than `edge` metres. If the scene has a circuit, edges further away from it than
/// [`NEAR_M`](super::NEAR_M) may be longer by their distance over [`NEAR_M`](super::NEAR_M).
///
/// Positions, texture coordinates and colours of new vertices are the means of their edge's ends; normals are too,
/// and are normalised. Vertices are shared within a mesh as they were. Edges with a non-finite end stay as they are,
/// and triangles without area are split like others (they may close a seam). The result does not depend on the number
/// of threads.
///
/// # Errors
/// [`RefineError`], before any memory is taken for the result.
pub fn refine(scene: &Scene, edge: f32) -> Result<Scene, RefineError> {
    refine_within(scene, edge, MAX_TRIANGLES)
}

/// True if [`refine`] would make more than `limit` triangles.
pub fn cut_beyond(scene: &Scene, edge: f32, limit: usize) -> bool {
    let circuit: Vec<DVec3> = scene.circuit.iter().map(|&place| place - scene.origin).collect();
    scene.validate().is_ok() && SplitRule::new(f64::from(edge), &circuit).count(scene, limit).is_none()
}

fn refine_within(scene: &Scene, edge: f32, limit: usize) -> Result<Scene, RefineError> {
    if !(edge.is_finite() && edge > 0.0) {
        return Err(RefineError::Edge(edge));
    }
    scene.validate()?;
    let circuit: Vec<DVec3> = scene.circuit.iter().map(|&place| place - scene.origin).collect();
    let rule = SplitRule::new(f64::from(edge), &circuit);
    for mesh in &scene.meshes {
        let enough = STEPS_PER_EDGE * rule.coarsest_step(mesh);
        if edge < enough {
            return Err(RefineError::TooFine { mesh: mesh.name.clone(), edge, enough });
        }
    }
    let limit = limit.max(scene.triangle_count());
    // Counting takes as long as splitting does, so it is left to scenes close to the limit.
    let estimate = rule.estimate(scene);
    if estimate > limit as f64 && (estimate > SURE * limit as f64 || rule.count(scene, limit).is_none()) {
        let triangles = rule.at_least(scene).max(limit as u64 + 1);
        let enough = round_lengths_above(edge)
            .find(|&length| SplitRule::new(f64::from(length), &circuit).estimate(scene) <= limit as f64)
            .expect("a length above all edges splits none");
        return Err(RefineError::TooMany { scene: scene.name.clone(), edge, triangles, limit, enough });
    }
    Ok(Scene {
        name: scene.name.clone(),
        origin: scene.origin,
        textures: scene.textures.clone(),
        materials: scene.materials.clone(),
        meshes: scene.meshes.par_iter().map(|mesh| refine_mesh(mesh, rule)).collect(),
        motions: scene.motions.clone(),
        light: scene.light,
        lamps: scene.lamps.clone(),
        start: scene.start,
        cameras: scene.cameras.clone(),
        speed_of_light_m_s: scene.speed_of_light_m_s,
        circuit: scene.circuit.clone(),
        places: scene.places.clone(),
        clocks: scene.clocks.clone(),
        notices: scene.notices.clone(),
        illuminant: scene.illuminant.clone(),
        white: scene.white,
        panorama: scene.panorama.clone(),
    })
}

/// Refines one mesh triangle by triangle, so that neighbours in space stay neighbours in memory.
fn refine_mesh(mesh: &Mesh, rule: SplitRule<'_>) -> Mesh {
    let mut refined = Mesh { indices: Vec::new(), ..mesh.clone() };
    let mut midpoint_of_edge = HashMap::new();
    let (mut stack, mut near) = (Vec::new(), Vec::new());
    for corners in mesh.indices.chunks_exact(3) {
        let rule = rule.within([0, 1, 2].map(|corner| mesh.positions[corners[corner] as usize]), &mut near);
        stack.push([corners[0], corners[1], corners[2]]);
        while let Some(corners) = stack.pop() {
            let [a, b, c] = corners;
            let midpoints = [(a, b), (b, c), (c, a)].map(|(a, b)| {
                let ends = [a, b].map(|end| refined.positions[end as usize]);
                rule.splits(ends[0], ends[1]).then(|| {
                    *midpoint_of_edge.entry((a.min(b), a.max(b))).or_insert_with(|| add_midpoint(&mut refined, a, b))
                })
            });
            if midpoints == [None; 3] {
                refined.indices.extend(corners);
            } else {
                let position = |vertex: u32| refined.positions[vertex as usize];
                divide(
                    corners,
                    midpoints,
                    |a, b| distance_squared(position(a), position(b)),
                    |child| stack.push(child),
                );
            }
        }
    }
    refined
}

/// Adds the vertex half way between two others.
fn add_midpoint(mesh: &mut Mesh, a: u32, b: u32) -> u32 {
    let middle = u32::try_from(mesh.positions.len()).expect("MAX_TRIANGLES keeps vertices countable in 32 bits");
    let [a, b] = [a as usize, b as usize];
    mesh.positions.push(midpoint(mesh.positions[a], mesh.positions[b]));
    mesh.normals.push((mesh.normals[a] + mesh.normals[b]).normalize_or(mesh.normals[a]));
    if !mesh.uvs.is_empty() {
        mesh.uvs.push(mesh.uvs[a].midpoint(mesh.uvs[b]));
    }
    if !mesh.emissive_uvs.is_empty() {
        mesh.emissive_uvs.push(mesh.emissive_uvs[a].midpoint(mesh.emissive_uvs[b]));
    }
    if !mesh.colours.is_empty() {
        mesh.colours.push(std::array::from_fn(|channel| 0.5 * (mesh.colours[a][channel] + mesh.colours[b][channel])));
    }
    middle
}

/// Round lengths above `length`, rising: 1, 2, 5 times a power of ten.
fn round_lengths_above(length: f32) -> impl Iterator<Item = f32> {
    let exponent = length.log10().floor() as i32;
    (exponent..)
        .flat_map(|exponent| [1, 2, 5].map(|digit| format!("{digit}e{exponent}").parse().expect("a decimal number")))
        .filter(move |&round| round > length)
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
