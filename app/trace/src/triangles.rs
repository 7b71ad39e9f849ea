//! Triangles of one body, with the hierarchy of boxes that finds the first one on a ray.
//!
//! Nothing of the scene is copied: a triangle is a number, and is read from the scene when a ray meets its box.

use crate::curve::{Curve, CurveChord};
use crate::hit::RayHit;
use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhLeafCost};
use parry3d_f64::query::Ray;
use rayon::prelude::*;
use scene::{Mesh, Scene};
use std::sync::Arc;

/// Relative margin of the boxes around triangles, in their coordinates, so that rounding misses no hit.
const MARGIN: f64 = 1e-9;

/// Number of triangles from which on several share a box.
const MANY: usize = 1 << 18;

/// Number of triangles that share a box where there are many: an eighth of the boxes, for a few more triangles to meet.
const SHARED: usize = 8;

/// Triangles of a scene, and the hierarchy of their boxes.
pub struct TriangleTree {
    scene: Arc<Scene>,
    /// Triangles, as many as share a box one after the other.
    triangles: Vec<TriangleNumber>,
    shared: usize,
    boxes: Bvh,
}

/// Place of a triangle in the scene.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct TriangleNumber {
    mesh: u32,
    triangle: u32,
}

/// Triangle of a mesh.
pub struct Triangle {
    /// Index into the scene's meshes.
    pub mesh: usize,
    corners: [usize; 3],
    points: [DVec3; 3],
    /// True if the triangle is drawn from behind as well.
    pub double_sided: bool,
    /// True if the triangle transmits light.
    pub glass: bool,
}

/// Nearest hit so far, and its distance by which hits are compared.
struct NearestHit(RayHit, f64);

impl BvhLeafCost for NearestHit {
    fn cost(&self) -> f64 {
        self.1
    }
}

impl TriangleTree {
    /// Sorts the triangles of the wanted meshes. `margin` is the width added to their boxes, metres. Triangles with a
    /// vertex that is not finite are left out.
    pub fn new(scene: &Arc<Scene>, margin: f64, wanted: impl Fn(usize) -> bool) -> Self {
        let meshes = || scene.meshes.iter().enumerate().filter(|(number, _)| wanted(*number));
        let count: usize = meshes().map(|(_, mesh)| mesh.indices.len() / 3).sum();
        Self::with_shared(scene, margin, wanted, if count < MANY { 1 } else { SHARED })
    }

    /// As [`TriangleTree::new`], with this number of triangles in a box.
    fn with_shared(scene: &Arc<Scene>, margin: f64, wanted: impl Fn(usize) -> bool, shared: usize) -> Self {
        let meshes = || (0..).zip(&scene.meshes).filter(|(number, _)| wanted(*number as usize));
        let mut triangles: Vec<TriangleNumber> =
            Vec::with_capacity(meshes().map(|(_, mesh)| mesh.indices.len() / 3).sum());
        for (mesh, source) in meshes() {
            let finite =
                |corners: &[u32; 3]| corners.iter().all(|&corner| source.positions[corner as usize].is_finite());
            let all = (0..).zip(source.indices.as_chunks::<3>().0);
            triangles.extend(
                all.filter(|(_, corners)| finite(corners)).map(|(triangle, _)| TriangleNumber { mesh, triangle }),
            );
        }
        if shared > 1 {
            triangles = gathered(scene, triangles);
        }
        let boxes: Vec<Aabb> = triangles.par_chunks(shared).map(|group| around(scene, group, margin)).collect();
        let boxes = Bvh::from_iter(BvhBuildStrategy::Binned, boxes.into_iter().enumerate());
        Self { scene: Arc::clone(scene), triangles, shared, boxes }
    }

    /// True if there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Nearest hit beyond `after`. If `clear_glass` is true, the inner side of glass counts too.
    pub fn first(
        &self,
        from: DVec3,
        direction: DVec3,
        after: f64,
        clear_glass: bool,
        is_there: impl Fn(&RayHit) -> bool,
    ) -> Option<RayHit> {
        let meet = |triangle: &Triangle| {
            let hit = triangle.meet(from, direction)?;
            let shown = hit.front || triangle.double_sided || (clear_glass && triangle.glass);
            (hit.distance > after && shown && is_there(&hit)).then_some(hit)
        };
        self.nearest(from, direction, meet, |hit| hit.distance)
    }

    /// Hit with the least `distance` along a ray among the triangles that `meet` gives a hit for.
    pub fn nearest(
        &self,
        from: DVec3,
        direction: DVec3,
        meet: impl Fn(&Triangle) -> Option<RayHit>,
        distance: impl Fn(&RayHit) -> f64,
    ) -> Option<RayHit> {
        if self.triangles.is_empty() || !from.is_finite() || !direction.is_finite() {
            return None;
        }
        let ray = Ray::new(vector(from), vector(direction));
        let of_box = |index: u32, _: f64| {
            let first = index as usize * self.shared;
            let group = &self.triangles[first..(first + self.shared).min(self.triangles.len())];
            let hits = group.iter().filter_map(|number| meet(&self.triangle(*number)));
            let hits = hits.map(|hit| NearestHit(hit, distance(&hit)));
            hits.reduce(|nearest, hit| if hit.1 < nearest.1 { hit } else { nearest })
        };
        let (_, NearestHit(hit, _)) = self.boxes.find_best(f64::MAX, |node, best| node.cast_ray(&ray, best), of_box)?;
        Some(hit)
    }

    fn triangle(&self, number: TriangleNumber) -> Triangle {
        let mesh = &self.scene.meshes[number.mesh as usize];
        let material = &self.scene.materials[mesh.material];
        let corners = corners_of(mesh, number);
        Triangle {
            mesh: number.mesh as usize,
            corners,
            points: corners.map(|corner| mesh.positions[corner].as_dvec3()),
            double_sided: material.double_sided,
            glass: material.transmission > 0.0,
        }
    }
}

fn corners_of(mesh: &Mesh, number: TriangleNumber) -> [usize; 3] {
    mesh.indices.as_chunks::<3>().0[number.triangle as usize].map(|corner| corner as usize)
}

/// Triangles in the order of the Morton code of their middles, so that neighbours in space are neighbours in the list.
fn gathered(scene: &Scene, triangles: Vec<TriangleNumber>) -> Vec<TriangleNumber> {
    let middle = |number: &TriangleNumber| {
        let mesh = &scene.meshes[number.mesh as usize];
        corners_of(mesh, *number).into_iter().map(|corner| mesh.positions[corner].as_dvec3() / 3.0).sum::<DVec3>()
    };
    let bounds = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
    let nothing = || (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = triangles.par_iter().map(|number| (middle(number), middle(number))).reduce(nothing, bounds);
    // One cell size for all axes, 2²¹ cells along the longest.
    let cells = f64::from((1 << 21) - 1) / (high - low).max_element().max(f64::MIN_POSITIVE);
    let code = |number: &TriangleNumber| {
        let [x, y, z] = ((middle(number) - low) * cells).to_array().map(|cell| spread(cell as u64));
        x | y << 1 | z << 2
    };
    let mut coded: Vec<(u64, TriangleNumber)> =
        triangles.into_par_iter().map(|number| (code(&number), number)).collect();
    coded.par_sort_unstable();
    coded.into_iter().map(|(_, number)| number).collect()
}

/// 21 bits, spread with two zeros between each and the next.
fn spread(bits: u64) -> u64 {
    let steps = [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ];
    steps.into_iter().fold(bits & 0x001f_ffff, |bits, (shift, kept)| (bits | bits << shift) & kept)
}

impl Triangle {
    /// Hit of a ray with the triangle. Triangles that share an edge agree to the last bit on the side of it on which
    /// the ray passes.
    ///
    /// *Equation:* the signed volumes of the direction with each edge, seen from the beginning of the ray, d·(b × c)
    /// and so on, are the shares of the corners.
    pub fn meet(&self, from: DVec3, direction: DVec3) -> Option<RayHit> {
        let (weights, away, front) = self.shares(from, direction)?;
        let distance = away.dot(direction);
        (distance > 0.0).then(|| self.hit(weights, from + away, distance, front))
    }

    /// Hit of a piece of a curve with the triangle, computed by the tangent at the point of contact.
    pub fn meet_curve(&self, curve: &Curve<'_>, chord: &CurveChord) -> Option<RayHit> {
        let distance = curve.crosses(chord, self.points)?;
        let (position, rate) = curve.at(distance);
        let direction = rate.normalize_or_zero();
        let size = self.points[0].distance(self.points[1]).max(self.points[0].distance(self.points[2]));
        let (weights, _, front) = self.shares(position - direction * size, direction)?;
        Some(self.hit(weights, position, distance, front))
    }

    fn hit(&self, weights: [f64; 3], position: DVec3, distance: f64, front: bool) -> RayHit {
        let [a, b, c] = self.points;
        let plane = (b - a).cross(c - a);
        RayHit { mesh: self.mesh, corners: self.corners, weights, position, distance, plane, front }
    }

    /// Shares of the corners where a line passes, the vector from its beginning to that point, and true if the line
    /// comes from the front.
    fn shares(&self, from: DVec3, direction: DVec3) -> Option<([f64; 3], DVec3, bool)> {
        let [a, b, c] = self.points.map(|point| point - from);
        let volumes = [b.cross(c), c.cross(a), a.cross(b)].map(|area| area.dot(direction));
        let within = volumes.iter().all(|&volume| volume >= 0.0) || volumes.iter().all(|&volume| volume <= 0.0);
        let sum: f64 = volumes.iter().sum();
        if !within || sum == 0.0 {
            return None;
        }
        let weights = volumes.map(|volume| volume / sum);
        let away = a * weights[0] + b * weights[1] + c * weights[2];
        Some((weights, away, sum < 0.0))
    }
}

/// Box around triangles.
fn around(scene: &Scene, triangles: &[TriangleNumber], margin: f64) -> Aabb {
    let points = triangles.iter().flat_map(|number| {
        let mesh = &scene.meshes[number.mesh as usize];
        corners_of(mesh, *number).map(|corner| mesh.positions[corner].as_dvec3())
    });
    let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = points.fold(bounds, |(low, high), point| (low.min(point), high.max(point)));
    let margin = DVec3::splat(margin + MARGIN * (1.0 + low.abs().max(high.abs()).max_element()));
    Aabb::new(vector(low - margin), vector(high + margin))
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

#[cfg(test)]
mod tests {
    //! Law under test: rays meet the same triangles, however many of them share a box.

    use super::*;
    use glam::Vec3;
    use scene::Material;

    #[test]
    fn shared_boxes_change_no_hit() {
        // A wavy sheet of 60 × 60 squares, with one corner nowhere.
        let side = 61_u32;
        let place = |index: u32| {
            let (x, z) = ((index % side) as f32, (index / side) as f32);
            Vec3::new(x, (0.7 * x).sin() * (0.4 * z).cos(), z)
        };
        let mut positions: Vec<Vec3> = (0..side * side).map(place).collect();
        positions[700] = Vec3::NAN;
        let squares = (0..side * (side - 1)).filter(|index| index % side < side - 1);
        let indices = squares.flat_map(|a| [a, a + side, a + 1, a + 1, a + side, a + side + 1]).collect();
        let mesh = Mesh { normals: vec![Vec3::Y; positions.len()], positions, indices, ..Mesh::default() };
        let scene = Scene { meshes: vec![mesh], materials: vec![Material::default()], ..Scene::default() };
        let scene = Arc::new(scene);
        let [alone, shared] = [1, SHARED].map(|shared| TriangleTree::with_shared(&scene, 0.0, |_| true, shared));
        assert!(shared.triangles.len() == alone.triangles.len() && shared.triangles.len() < 7200);
        let mut met = 0;
        for number in 0..2000 {
            let across = |step: u32| f64::from(number * step % 997) / 997.0 * 60.0;
            let from = DVec3::new(across(7), 5.0, across(13));
            let direction = (DVec3::new(across(5), 0.0, across(11)) - from).normalize();
            let [one, other] = [&alone, &shared].map(|tree| {
                let hit = tree.first(from, direction, 0.0, false, |_| true)?;
                Some((hit.corners, hit.distance.to_bits()))
            });
            assert_eq!(one, other, "from {from} along {direction}");
            met += usize::from(one.is_some());
        }
        assert!((1000..2000).contains(&met), "{met} rays of 2000 met the sheet");
    }
}
