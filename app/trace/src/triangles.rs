//! Triangles of one body, with the hierarchy of boxes that finds the first one on a ray.

use crate::curve::{Curve, CurveChord};
use crate::hit::RayHit;
use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::Ray;
use scene::Scene;

/// Relative margin of the boxes around triangles, in their coordinates, so that rounding misses no hit.
const MARGIN: f64 = 1e-9;

/// Triangles, and the hierarchy of their boxes.
pub struct TriangleTree {
    triangles: Vec<Triangle>,
    boxes: Bvh,
}

/// Triangle of a mesh.
pub struct Triangle {
    mesh: usize,
    corners: [usize; 3],
    points: [DVec3; 3],
    /// True if the triangle is drawn from behind as well.
    pub double_sided: bool,
    /// True if the triangle transmits light.
    pub glass: bool,
}

impl TriangleTree {
    /// Sorts the triangles of the wanted meshes. `margin` is the width added to their boxes, metres. Triangles with a
    /// vertex that is not finite are left out.
    pub fn new(scene: &Scene, margin: f64, wanted: impl Fn(usize) -> bool) -> Self {
        let mut triangles = Vec::new();
        for (number, mesh) in scene.meshes.iter().enumerate().filter(|(number, _)| wanted(*number)) {
            let material = &scene.materials[mesh.material];
            let (double_sided, glass) = (material.double_sided, material.transmission > 0.0);
            for corners in mesh.indices.as_chunks::<3>().0 {
                let corners = corners.map(|corner| corner as usize);
                let points = corners.map(|corner| mesh.positions[corner].as_dvec3());
                if points.iter().all(|point| point.is_finite()) {
                    triangles.push(Triangle { mesh: number, corners, points, double_sided, glass });
                }
            }
        }
        let boxes: Vec<Aabb> = triangles.iter().map(|triangle| around(triangle.points, margin)).collect();
        Self { triangles, boxes: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes) }
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
        let meet = |index: u32| meet(&self.triangles[index as usize]);
        let cost = |index: u32, _: f64| meet(index).map(|hit| distance(&hit));
        let (index, _) = self.boxes.cast_ray(&ray, f64::MAX, cost)?;
        meet(index)
    }
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

fn around([a, b, c]: [DVec3; 3], margin: f64) -> Aabb {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let margin = DVec3::splat(margin + MARGIN * (1.0 + low.abs().max(high.abs()).max_element()));
    Aabb::new(vector(low - margin), vector(high + margin))
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}
