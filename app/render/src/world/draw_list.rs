//! List of a scene's draws: triangles joined by material and motion, and perhaps gathered by their place.

use glam::{DVec3, Vec3};
use scene::{Alpha, Scene};
use std::ops::Range;

/// Number of triangles of a [`Group`]: enough that a draw of its own costs little in comparison.
const GROUP_TRIANGLES: usize = 512;

/// Successive triangles with the same material and motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Index into the scene's materials.
    pub material: usize,
    /// Index into the scene's motions; `None` for what rests in the world.
    pub motion: Option<usize>,
    /// Range of the index buffer.
    pub indices: Range<u32>,
    /// World position by which blended surfaces are sorted, metres; for a moving body, in its own frame.
    pub centre: DVec3,
    /// Groups of the same triangles that lie close together, for views that see little of the world.
    pub groups: Vec<Group>,
}

/// A few triangles, and a ball around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Range of the index buffer.
    pub indices: Range<u32>,
    /// Middle of the ball, world position, metres.
    pub centre: DVec3,
    /// Radius of the ball, metres.
    pub radius: f64,
}

/// Order in which the meshes are drawn: opaque ones first, by material and by motion.
pub fn order(scene: &Scene) -> Vec<usize> {
    let blends = |mesh: usize| scene.materials[scene.meshes[mesh].material].alpha == Alpha::Blend;
    let mut order: Vec<usize> = (0..scene.meshes.len()).collect();
    order.sort_by_key(|&mesh| (blends(mesh), scene.meshes[mesh].material, scene.meshes[mesh].motion));
    order
}

/// Adds a draw. It is joined to the draw before it if that is opaque and has the same material and motion.
pub fn push_draw(opaque: &mut Vec<Draw>, blended: &mut Vec<Draw>, draw: Draw, blends: bool) {
    match opaque.last_mut() {
        _ if blends => blended.push(draw),
        Some(last) if (last.material, last.motion) == (draw.material, draw.motion) => {
            last.indices.end = draw.indices.end;
        }
        _ => opaque.push(draw),
    }
}

/// Sorts the triangles of opaque draws by their place, and gives all draws their groups.
pub fn groups_of(scene: &Scene, indices: &mut [u32], opaque: &mut [Draw], blended: &mut [Draw]) {
    let positions: Vec<Vec3> = scene.meshes.iter().flat_map(|mesh| mesh.positions.iter().copied()).collect();
    for draw in &mut *opaque {
        gather(&mut indices[draw.indices.start as usize..draw.indices.end as usize], &positions);
    }
    for draw in opaque.iter_mut().chain(blended) {
        let range = draw.indices.start as usize..draw.indices.end as usize;
        draw.groups = groups(&indices[range], draw.indices.start, &positions, scene.origin);
    }
}

/// Sorts triangles by the Morton code of their centres, so that neighbours in space are neighbours in the list.
fn gather(indices: &mut [u32], positions: &[Vec3]) {
    let mut triangles: Vec<[u32; 3]> =
        indices.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect();
    let middle = |corners: &[u32; 3]| corners.iter().map(|&i| positions[i as usize]).sum::<Vec3>() / 3.0;
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for triangle in &triangles {
        let middle = middle(triangle);
        (low, high) = (low.min(middle), high.max(middle));
    }
    // One cell size for all axes, 1024 cells along the longest.
    let cells = 1023.0 / (high - low).max_element().max(f32::MIN_POSITIVE);
    triangles.sort_by_cached_key(|triangle| {
        let [x, y, z] = ((middle(triangle) - low) * cells).to_array().map(|cell| spread(cell as u32));
        x | y << 1 | z << 2
    });
    for (place, corner) in indices.iter_mut().zip(triangles.as_flattened()) {
        *place = *corner;
    }
}

/// Ten bits spread with two zeros between each and the next.
fn spread(bits: u32) -> u32 {
    (0..10).fold(0, |sum, bit| sum | (bits >> bit & 1) << (3 * bit))
}

/// Splits a list of triangles into groups. `first` is the place of the list in the index buffer.
fn groups(indices: &[u32], first: u32, positions: &[Vec3], origin: DVec3) -> Vec<Group> {
    let group = |(number, corners): (usize, &[u32])| {
        let corner = |&index: &u32| positions[index as usize].as_dvec3();
        let (low, high) = corners
            .iter()
            .map(corner)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let centre = 0.5 * (low + high);
        let radius = corners.iter().map(|index| corner(index).distance(centre)).fold(0.0, f64::max);
        let start = first + (number * 3 * GROUP_TRIANGLES) as u32;
        Group { indices: start..start + corners.len() as u32, centre: origin + centre, radius }
    };
    indices.chunks(3 * GROUP_TRIANGLES).enumerate().map(group).collect()
}

/// Mean of the finite positions, metres.
pub fn centre(positions: &[Vec3]) -> DVec3 {
    let sum: DVec3 = positions.iter().filter(|p| p.is_finite()).map(|p| p.as_dvec3()).sum();
    sum / positions.len().max(1) as f64
}
