//! Collision: the floors that a vehicle stands on and the walls that it bumps into.
//!
//! The solid meshes' triangles are sorted once, at the first question, into floors that a wheel can roll on and steep
//! walls. A bounding volume hierarchy over each finds the few that matter in microseconds, as it is queried in every
//! step of the worldline.
//!
//! A kerb of up to [`STEP`] is climbed: the ground is sought from that height above the wheel, and walls below it do
//! not count. Triangles that share an edge agree on which side of it a point lies, to the last bit, so that nothing
//! falls through a seam.

use std::cell::Cell;
use std::sync::LazyLock;

use glam::{DVec2, DVec3, Vec3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};
use parry3d_f64::query::{PointQuery, Ray};

use crate::scene::Scene;
use crate::surroundings::{Ground, Surroundings, Wall};
use crate::triangle_point::nearest_point;
use crate::validate::SceneFault;

/// Highest step that a vehicle climbs, metres.
pub const STEP: f64 = 0.2;

/// Height up to which a vehicle with its rider collides, metres above the ground.
pub const BODY: f64 = 1.8;

/// Least upward or downward component of a floor's unit normal. Triangles with less are walls: steeper than 60°.
const STEEP: f64 = 0.5;

/// Rounding of distances that is allowed for in a search, as a share of them and in metres.
const ROUNDING: f64 = 1e-9;

/// Solid part of a scene. Positions are world metres.
pub struct Collision {
    origin: DVec3,
    circuit: Vec<DVec3>,
    sorted: LazyLock<SortedTriangles, Box<dyn FnOnce() -> SortedTriangles + Send>>,
}

/// Floors and walls.
struct SortedTriangles {
    floors: SolidTree,
    walls: SolidTree,
}

impl SortedTriangles {
    /// Sorts triangles. Those without area or with a non-finite vertex are left out.
    fn of(triangles: Vec<[Vec3; 3]>) -> Self {
        let (mut floors, mut walls) = (Vec::new(), Vec::new());
        for triangle in triangles {
            match normal(triangle.map(|corner| corner.as_dvec3())) {
                Some(normal) if normal.y.abs() < STEEP => walls.push(triangle),
                Some(_) => floors.push(triangle),
                None => {}
            }
        }
        Self { floors: SolidTree::new(floors), walls: SolidTree::new(walls) }
    }
}

impl Collision {
    /// Collects a scene's solid triangles.
    ///
    /// # Errors
    /// [`SceneFault`] if the scene breaks a promise of its types.
    pub fn new(scene: &Scene) -> Result<Self, SceneFault> {
        scene.validate()?;
        let triangles: Vec<[Vec3; 3]> = solid_triangles(scene).collect();
        let sorted: Box<dyn FnOnce() -> SortedTriangles + Send> = Box::new(move || SortedTriangles::of(triangles));
        Ok(Self { origin: scene.origin, circuit: scene.circuit.clone(), sorted: LazyLock::new(sorted) })
    }

    /// Sorts the triangles now instead of at the first question: about a microsecond for each.
    pub fn prepare(&self) {
        LazyLock::force(&self.sorted);
    }
}

impl Surroundings for Collision {
    fn nearest_surface(&self, position: DVec3, reach: f64) -> Option<Wall> {
        let place = position - self.origin;
        if !place.is_finite() || reach.is_nan() {
            return None;
        }
        let SortedTriangles { floors, walls } = &*self.sorted;
        let nearest = floors.nearest(place, reach);
        let nearer_m = nearest.map_or(reach, |(distance, _)| distance);
        let (distance, triangle) = walls.nearest(place, nearer_m).or(nearest)?;
        // A point in the surface itself is on either side of it.
        let away = (place - nearest_point(triangle, place)).try_normalize().or_else(|| normal(triangle))?;
        Some(Wall { distance, normal: away })
    }

    fn circuit(&self) -> &[DVec3] {
        &self.circuit
    }

    /// Highest floor that is not more than [`STEP`] above a point, or `None` if there is none below.
    fn height_below(&self, position: DVec3) -> Option<Ground> {
        let from = above(position, self.origin);
        let floors = &self.sorted.floors;
        if floors.triangles.is_empty() || !from.is_finite() {
            return None;
        }
        let ray = Ray::new(vector(from), vector(DVec3::NEG_Y));
        let depth = |index, _| depth_below(floors.triangle(index), from);
        let (index, depth) = floors.hierarchy.cast_ray(&ray, f64::MAX, depth)?;
        ground(position, floors.triangle(index), depth)
    }

    /// Nearest wall within `radius` metres of a point on the ground, between [`STEP`] and [`BODY`] above it.
    ///
    /// The normal is horizontal and points away from the wall, on either side of it, so that a vehicle may lean on it
    /// softly.
    fn nearest_wall(&self, position: DVec3, radius: f64) -> Option<Wall> {
        let foot = position - self.origin;
        let (lowest, highest) = (foot.y + STEP, foot.y + BODY);
        let walls = &self.sorted.walls;
        if walls.triangles.is_empty() || !foot.is_finite() || radius.is_nan() {
            return None;
        }
        let near = |index| {
            let slab = between(walls.triangle(index), lowest, highest);
            let point = nearest_in_plan(&slab, plan(foot))?;
            Some((point.distance(plan(foot)), index, point))
        };
        let first = |a: &(f64, u32, DVec2), b: &(f64, u32, DVec2)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        // Of walls that are as near, the first counts. The search comes to all of them, since it takes boxes for nearer
        // than they are, unless the point is in a wall.
        let found = Cell::new(None);
        let to_box = |node: &BvhNode, _| plan_distance(&node.aabb(), foot, lowest, highest);
        let to_wall = |index, _| {
            let wall = near(index)?;
            found.set(found.get().into_iter().chain([wall]).min_by(first));
            Some(wall.0)
        };
        walls.hierarchy.find_best(radius.next_up(), to_box, to_wall)?;
        let (distance, index, point) = match found.get()? {
            (0.0, ..) => {
                let corner = DVec3::new(foot.x - ROUNDING, lowest, foot.z - ROUNDING);
                let opposite = DVec3::new(foot.x + ROUNDING, highest, foot.z + ROUNDING);
                let here = Aabb::new(vector(corner), vector(opposite));
                walls.hierarchy.intersect_aabb(&here).filter_map(near).min_by(first)?
            }
            nearest => nearest,
        };
        let away = (plan(foot) - point).try_normalize().or_else(|| {
            let normal = normal(walls.triangle(index))?;
            plan(normal).try_normalize()
        })?;
        (distance <= radius).then_some(Wall { distance, normal: DVec3::new(away.x, 0.0, away.y) })
    }
}

/// Highest floor of a scene that is not more than [`STEP`] above a point: the answer of [`Collision::height_below`]
/// for a single question, from one pass over the triangles and without a hierarchy.
///
/// # Errors
/// [`SceneFault`] if the scene breaks a promise of its types.
pub fn ground_below(scene: &Scene, position: DVec3) -> Result<Option<Ground>, SceneFault> {
    scene.validate()?;
    let from = above(position, scene.origin);
    if !from.is_finite() {
        return Ok(None);
    }
    let floor = |triangle: &[DVec3; 3]| normal(*triangle).is_some_and(|normal| normal.y.abs() >= STEEP);
    let below = |triangle| Some((depth_below(triangle, from)?, triangle));
    // The plan is looked at first: hardly any triangle is below the point, and normals cost a root.
    let triangles = solid_triangles(scene).map(|triangle| triangle.map(|corner| corner.as_dvec3()));
    let nearest = triangles.filter_map(below).filter(|(_, triangle)| floor(triangle));
    let nearest = nearest.min_by(|one, other| one.0.total_cmp(&other.0));
    Ok(nearest.and_then(|(depth, triangle)| ground(position, triangle, depth)))
}

/// Triangles of the solid meshes, metres relative to the scene's origin.
fn solid_triangles(scene: &Scene) -> impl Iterator<Item = [Vec3; 3]> {
    scene.meshes.iter().filter(|mesh| mesh.solid).flat_map(|mesh| {
        let triangles = mesh.indices.as_chunks::<3>().0.iter();
        triangles.map(|corners| corners.map(|corner| mesh.positions[corner as usize]))
    })
}

/// Place from which the ground below a point is sought, relative to the scene's origin.
fn above(position: DVec3, origin: DVec3) -> DVec3 {
    position - origin + STEP * DVec3::Y
}

/// Depth of a triangle below a point, metres; `None` if it is not below.
fn depth_below(triangle: [DVec3; 3], from: DVec3) -> Option<f64> {
    let depth = from.y - height(triangle, plan(from))?;
    (depth >= 0.0).then_some(depth)
}

/// Ground that a floor is, at `depth` below the place from which it is sought.
fn ground(position: DVec3, floor: [DVec3; 3], depth: f64) -> Option<Ground> {
    let normal = normal(floor)?;
    Some(Ground { height: position.y + STEP - depth, normal: normal * normal.y.signum() })
}

/// Triangles, relative to the scene's origin, with the hierarchy that finds them.
struct SolidTree {
    triangles: Vec<[Vec3; 3]>,
    hierarchy: Bvh,
}

impl SolidTree {
    fn new(triangles: Vec<[Vec3; 3]>) -> Self {
        let bounds = |&[a, b, c]: &[Vec3; 3]| {
            let (least, most) = (a.min(b).min(c), a.max(b).max(c));
            Aabb::new(vector(least.as_dvec3()), vector(most.as_dvec3()))
        };
        let boxes: Vec<Aabb> = triangles.iter().map(bounds).collect();
        Self { hierarchy: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes), triangles }
    }

    /// Distance of the triangle nearest to a place, if that is within `reach`, and the triangle.
    fn nearest(&self, place: DVec3, reach: f64) -> Option<(f64, [DVec3; 3])> {
        if self.triangles.is_empty() {
            return None;
        }
        let at = vector(place);
        let to_box = |node: &BvhNode, _| node.aabb().distance_to_local_point(at, true);
        let distance = |index, _| Some(nearest_point(self.triangle(index), place).distance(place));
        let (index, distance) = self.hierarchy.find_best(reach, to_box, distance)?;
        Some((distance, self.triangle(index)))
    }

    fn triangle(&self, index: u32) -> [DVec3; 3] {
        self.triangles[index as usize].map(|corner| corner.as_dvec3())
    }
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

/// Distance in plan from a place to a box, as far as the box lies between two heights; [`f64::MAX`] if it does not.
fn plan_distance(bounds: &Aabb, place: DVec3, lowest: f64, highest: f64) -> f64 {
    if bounds.maxs.y < lowest || bounds.mins.y > highest {
        return f64::MAX;
    }
    let beside = |least: f64, most: f64, at: f64| (least - at).max(at - most).max(0.0);
    let x = beside(bounds.mins.x, bounds.maxs.x, place.x);
    let z = beside(bounds.mins.z, bounds.maxs.z, place.z);
    // A box's distance must not be rounded beyond that of what it holds.
    DVec2::new(x, z).length() * (1.0 - ROUNDING)
}

/// Position in plan (seen from above): x and z.
fn plan(v: DVec3) -> DVec2 {
    DVec2::new(v.x, v.z)
}

/// Unit normal of a triangle, or `None` if it has no area or a non-finite corner.
fn normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    (b - a).cross(c - a).try_normalize()
}

/// Twice the signed area of the triangle a, b, p in plan: its sign tells the side of a–b on which p lies. Swapping a
/// and b changes the sign and no other bit.
fn side(a: DVec3, b: DVec3, p: DVec2) -> f64 {
    let (a, b) = (plan(a) - p, plan(b) - p);
    a.x * b.y - a.y * b.x
}

/// Height (y) of a triangle above or below a point in plan, if the point is in it or on its edge.
fn height([a, b, c]: [DVec3; 3], p: DVec2) -> Option<f64> {
    let weights = [side(b, c, p), side(c, a, p), side(a, b, p)];
    let within = weights.iter().all(|&weight| weight >= 0.0) || weights.iter().all(|&weight| weight <= 0.0);
    let [u, v, w] = weights;
    let sum = u + v + w;
    (within && sum != 0.0).then(|| (u * a.y + v * b.y + w * c.y) / sum)
}

/// Part of a triangle between two heights, a convex polygon; empty if it only touches them.
fn between(triangle: [DVec3; 3], lowest: f64, highest: f64) -> Vec<DVec3> {
    let above = clip(&triangle, |corner| corner.y - lowest);
    clip(&above, |corner| highest - corner.y)
}

/// Part of a convex polygon where a linear function is not negative (Sutherland–Hodgman); empty if that has no
/// extent.
fn clip(polygon: &[DVec3], inside: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut clipped = Vec::with_capacity(polygon.len() + 1);
    let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
    for (&from, &to) in ends {
        let (start, end) = (inside(from), inside(to));
        if start >= 0.0 {
            clipped.push(from);
        }
        if (start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0) {
            clipped.push(from.lerp(to, start / (start - end)));
        }
    }
    if !clipped.iter().any(|&corner| inside(corner) > 0.0) {
        clipped.clear();
    }
    clipped
}

/// Nearest point of a convex polygon to another point, both in plan.
fn nearest_in_plan(polygon: &[DVec3], p: DVec2) -> Option<DVec2> {
    let edges = || polygon.iter().zip(polygon.iter().cycle().skip(1));
    let sides = || edges().map(|(&a, &b)| side(a, b, p));
    if !polygon.is_empty() && (sides().all(|side| side > 0.0) || sides().all(|side| side < 0.0)) {
        return Some(p);
    }
    let nearest_on_edge = |(&a, &b): (&DVec3, &DVec3)| {
        let (a, along) = (plan(a), plan(b) - plan(a));
        let length_squared = along.length_squared();
        let share = if length_squared > 0.0 { ((p - a).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
        a + share * along
    };
    edges().map(nearest_on_edge).min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p)))
}

#[cfg(test)]
#[path = "collision/tests.rs"]
mod tests;
