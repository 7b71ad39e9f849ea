//! List of a scene's draws: triangles joined by material and motion, in groups that lie close together.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use scene::cut::{Cut, CutMesh};
use scene::{Alpha, Mesh, Scene};
use std::borrow::Cow;
use std::ops::Range;

/// Largest number of triangles of a [`Group`]: enough that a draw of its own costs little in comparison.
const GROUP_TRIANGLES: usize = 64;

/// Parts of its radius and of its place by which a ball is taken to be larger than computed, so that rounding leaves
/// nothing outside.
const ROUNDING: [f64; 2] = [1e-9, 1e-12];

/// Draws of a scene or of one of its cuts, in the order of their triangles in the index buffer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawList {
    /// Indices of the scene's meshes, in the order in which they are drawn.
    pub order: Vec<usize>,
    /// Opaque draws, in any order before the sky: one for each material and motion.
    pub opaque: Vec<Draw>,
    /// Blended draws, from far to near after the sky: one for each mesh.
    pub blended: Vec<Draw>,
}

/// Successive triangles with the same material and motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Index into the scene's materials.
    pub material: usize,
    /// Index into the scene's motions; `None` for what rests in the world.
    pub motion: Option<usize>,
    /// Range of the index buffer.
    pub indices: Range<u32>,
    /// Position by which blended surfaces are sorted, metres, relative to the scene's origin; for a moving body, in its
    /// own frame.
    pub centre: DVec3,
    /// Groups of the same triangles, in the same order.
    pub groups: Vec<Group>,
}

/// A few triangles that lie close together, and a ball around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Range of the index buffer.
    pub indices: Range<u32>,
    /// Middle of the ball, metres, relative to the scene's origin; for a moving body, in its own frame.
    pub centre: DVec3,
    /// Radius of the ball, metres.
    pub radius: f64,
}

impl DrawList {
    /// Draws of a scene, or of one of its cuts.
    pub fn of(scene: &Scene, cut: Option<&Cut>) -> Self {
        let order = order(scene);
        let uncut = CutMesh::default();
        let cut_of = |mesh: usize| cut.map_or(&uncut, |cut| &cut.meshes[mesh]);
        let groups: Vec<Vec<Group>> = order
            .par_iter()
            .map(|&mesh| {
                let (mesh, cut_mesh) = (&scene.meshes[mesh], cut_of(mesh));
                groups(&corners(mesh, cut.map(|_| cut_mesh)), |vertex| cut_mesh.place(mesh, vertex as usize))
            })
            .collect();
        let mut list = Self { order: order.clone(), ..Self::default() };
        let mut start = 0;
        for (mesh, groups) in order.into_iter().zip(groups) {
            let Mesh { material, motion, ref positions, .. } = scene.meshes[mesh];
            let blends = scene.materials[material].alpha == Alpha::Blend;
            let shifted =
                |group: Group| Group { indices: start + group.indices.start..start + group.indices.end, ..group };
            let groups: Vec<Group> = groups.into_iter().map(shifted).collect();
            let end = groups.last().map_or(start, |group| group.indices.end);
            // Only blended draws are sorted by their distance.
            let centre = if blends { centre(positions) } else { DVec3::ZERO };
            list.push(Draw { material, motion, indices: start..end, centre, groups }, blends);
            start = end;
        }
        list
    }

    /// Adds a draw. It is joined to the draw before it if that is opaque and has the same material and motion.
    fn push(&mut self, draw: Draw, blends: bool) {
        match self.opaque.last_mut() {
            _ if blends => self.blended.push(draw),
            Some(last) if (last.material, last.motion) == (draw.material, draw.motion) => {
                last.indices.end = draw.indices.end;
                draw.groups.into_iter().for_each(|group| last.push(group));
            }
            _ => self.opaque.push(draw),
        }
    }

    /// Number of triangles.
    pub fn triangle_count(&self) -> u64 {
        self.opaque.iter().chain(&self.blended).map(|draw| draw.indices.len() as u64 / 3).sum()
    }
}

impl Draw {
    /// Adds a group. It is joined to the group before it if both are small.
    fn push(&mut self, group: Group) {
        match self.groups.last_mut() {
            Some(last) if last.indices.len() + group.indices.len() <= 3 * GROUP_TRIANGLES => last.join(&group),
            _ => self.groups.push(group),
        }
    }
}

impl Group {
    /// Adds the next triangles of the index buffer.
    fn join(&mut self, next: &Self) {
        self.indices.end = next.indices.end;
        let apart = self.centre.distance(next.centre);
        if apart + next.radius <= self.radius {
            return;
        }
        if apart + self.radius <= next.radius {
            (self.centre, self.radius) = (next.centre, next.radius);
            return;
        }
        let radius = 0.5 * (apart + self.radius + next.radius);
        self.centre += (next.centre - self.centre) * ((radius - self.radius) / apart);
        self.radius = radius * (1.0 + ROUNDING[0]) + ROUNDING[1] * self.centre.length();
    }
}

/// Sorts the triangles of a scene's opaque meshes by their place, so that neighbours in space are neighbours in the
/// list, in every cut of the scene too.
pub fn gather(scene: &mut Scene) {
    for mesh in &mut scene.meshes {
        let corners = mesh.indices.as_chunks::<3>().0;
        if corners.len() <= GROUP_TRIANGLES || scene.materials[mesh.material].alpha == Alpha::Blend {
            continue;
        }
        let middle = |corners: &[u32; 3]| corners.iter().map(|&i| mesh.positions[i as usize]).sum::<Vec3>() / 3.0;
        let cells = Cells::around(corners.iter().map(middle));
        let mut corners = corners.to_vec();
        corners.par_sort_by_cached_key(|corners| cells.number(middle(corners)));
        mesh.indices = corners.into_flattened();
    }
}

/// Order in which the meshes are drawn: opaque ones first, by material, by motion and by their place.
fn order(scene: &Scene) -> Vec<usize> {
    let blends = |mesh: &Mesh| scene.materials[mesh.material].alpha == Alpha::Blend;
    let corner = |mesh: &Mesh| mesh.positions.first().copied().unwrap_or_default();
    let cells = Cells::around(scene.meshes.iter().map(corner));
    let mut order: Vec<usize> = (0..scene.meshes.len()).collect();
    order.sort_by_cached_key(|&mesh| {
        let mesh = &scene.meshes[mesh];
        (blends(mesh), mesh.material, mesh.motion, cells.number(corner(mesh)))
    });
    order
}

/// Corners of the triangles of a mesh that can be drawn. A corner without a finite place would be drawn at the eye.
pub fn corners<'a>(mesh: &'a Mesh, cut: Option<&'a CutMesh>) -> Cow<'a, [u32]> {
    if let Some(cut) = cut {
        return Cow::Borrowed(cut.indices(mesh));
    }
    if mesh.positions.iter().all(|position| position.is_finite()) {
        return Cow::Borrowed(&mesh.indices);
    }
    let finite = |corners: &&[u32; 3]| corners.iter().all(|&corner| mesh.positions[corner as usize].is_finite());
    mesh.indices.as_chunks::<3>().0.iter().filter(finite).flatten().copied().collect()
}

/// Splits a list of triangles into groups, counted from the beginning of the list.
fn groups(corners: &[u32], place: impl Fn(u32) -> DVec3 + Sync) -> Vec<Group> {
    let group = |(number, corners): (usize, &[u32])| {
        let places = || corners.iter().map(|&corner| place(corner));
        let (low, high) =
            places().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let centre = 0.5 * (low + high);
        let radius = places().map(|at| at.distance_squared(centre)).fold(0.0, f64::max).sqrt();
        let radius = radius * (1.0 + ROUNDING[0]) + ROUNDING[1] * centre.length();
        let start = (number * 3 * GROUP_TRIANGLES) as u32;
        Group { indices: start..start + corners.len() as u32, centre, radius }
    };
    corners.par_chunks(3 * GROUP_TRIANGLES).enumerate().map(group).collect()
}

/// Cells of a cube around points, numbered along a Morton curve.
struct Cells {
    low: Vec3,
    /// Cells for each metre.
    per_metre: f32,
}

impl Cells {
    /// Cells around points, of which some may not be finite.
    fn around(points: impl Iterator<Item = Vec3>) -> Self {
        let finite = points.filter(|point| point.is_finite());
        let (low, high) = finite.fold((Vec3::MAX, Vec3::MIN), |(low, high), point| (low.min(point), high.max(point)));
        // One size for all axes.
        Self { low, per_metre: ((1 << CELL_BITS) - 1) as f32 / (high - low).max_element().max(f32::MIN_POSITIVE) }
    }

    /// Number of the cell that holds a point; points near each other mostly have numbers near each other.
    fn number(&self, point: Vec3) -> u64 {
        let [x, y, z] = ((point - self.low) * self.per_metre).to_array().map(|cell| spread(cell as u32));
        x | y << 1 | z << 2
    }
}

/// Bits of the number of a cell along each axis.
const CELL_BITS: u32 = 20;

/// Bits of a cell's number spread with two zeros between each and the next.
fn spread(bits: u32) -> u64 {
    let bits = u64::from(bits);
    (0..CELL_BITS).fold(0, |sum, bit| sum | (bits >> bit & 1) << (3 * bit))
}

/// Mean of the finite positions, metres.
fn centre(positions: &[Vec3]) -> DVec3 {
    let sum: DVec3 = positions.iter().filter(|p| p.is_finite()).map(|p| p.as_dvec3()).sum();
    sum / positions.len().max(1) as f64
}
