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
mod tests {
    //! A street 10 m wide between two houses, with kerbs, a ramp and a step too high to climb. A wrong program falls
    //! through seams, stops at kerbs, stands on walls, or pushes a rider into the house.

    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::material::Material;
    use crate::mesh::Mesh;

    /// Tolerance, metres, of f32 coordinates of a few metres in f64 arithmetic.
    const TOLERANCE: f64 = 1e-6;

    fn mesh(triangles: &[[Vec3; 3]], solid: bool) -> Mesh {
        let positions = triangles.concat();
        let count = positions.len();
        Mesh {
            name: "test".into(),
            normals: vec![Vec3::Y; count],
            uvs: vec![Default::default(); count],
            colours: vec![[1.0; 4]; count],
            indices: (0..count as u32).collect(),
            positions,
            solid,
            ..Mesh::default()
        }
    }

    fn collision(origin: DVec3, meshes: Vec<Mesh>) -> Collision {
        let scene = Scene { origin, materials: vec![Material::default()], meshes, ..Scene::default() };
        Collision::new(&scene).unwrap()
    }

    /// Triangles of the six faces of a box.
    fn cuboid(least: Vec3, most: Vec3) -> Vec<[Vec3; 3]> {
        let corner = |i: usize| {
            let pick = |bit: usize, axis: usize| if i >> bit & 1 == 0 { least[axis] } else { most[axis] };
            Vec3::new(pick(0, 0), pick(1, 1), pick(2, 2))
        };
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).map(|t| t.map(corner)).collect()
    }

    /// Street with houses at x < −5 and x > 5, a kerb of 15 cm at 4 < x < 5, and a step of 50 cm at z < −20.
    fn street(origin: DVec3) -> Collision {
        let floor = cuboid(Vec3::new(-20.0, -1.0, -50.0), Vec3::new(20.0, 0.0, 50.0));
        let left = cuboid(Vec3::new(-15.0, 0.0, -50.0), Vec3::new(-5.0, 8.0, 50.0));
        let right = cuboid(Vec3::new(5.0, 0.0, -50.0), Vec3::new(15.0, 8.0, 50.0));
        let kerb = cuboid(Vec3::new(4.0, 0.0, -50.0), Vec3::new(5.0, 0.15, 50.0));
        let step = cuboid(Vec3::new(-5.0, 0.0, -50.0), Vec3::new(4.0, 0.5, -20.0));
        let solid = [floor, left, right, kerb, step].map(|triangles| mesh(&triangles, true));
        let tree = mesh(&cuboid(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 3.0, 1.0)), false);
        collision(origin, solid.into_iter().chain([tree]).collect())
    }

    #[test]
    fn the_street_carries() {
        let ground = street(DVec3::ZERO).height_below(DVec3::new(2.5, 0.0, 3.0)).unwrap();
        assert_eq!(ground, Ground { height: 0.0, normal: DVec3::Y });
    }

    #[test]
    fn a_fall_ends_on_the_roof() {
        let ground = street(DVec3::ZERO).height_below(DVec3::new(7.0, 100.0, 3.0)).unwrap();
        assert!((ground.height - 8.0).abs() < TOLERANCE);
    }

    #[test]
    fn kerbs_are_climbed_and_do_not_push() {
        let street = street(DVec3::ZERO);
        let ground = street.height_below(DVec3::new(4.2, 0.0, 0.0)).unwrap();
        assert!((ground.height - 0.15).abs() < TOLERANCE);
        assert_eq!(street.nearest_wall(DVec3::new(3.9, 0.0, 0.0), 0.5), None);
    }

    #[test]
    fn high_steps_are_walls() {
        let street = street(DVec3::ZERO);
        let wall = street.nearest_wall(DVec3::new(0.0, 0.0, -19.7), 0.5).unwrap();
        assert!((wall.distance - 0.3).abs() < TOLERANCE);
        assert_eq!(wall.normal, DVec3::Z);
        let on_top = DVec3::new(0.0, 0.5, -20.3);
        assert!((street.height_below(on_top).unwrap().height - 0.5).abs() < TOLERANCE);
        assert_eq!(street.nearest_wall(on_top, 0.5), None, "from above it is none");
    }

    #[test]
    fn houses_push_away_from_themselves() {
        let street = street(DVec3::ZERO);
        let left = street.nearest_wall(DVec3::new(-4.5, 0.0, 0.0), 1.0).unwrap();
        assert_eq!(left, Wall { distance: 0.5, normal: DVec3::X });
        let right = street.nearest_wall(DVec3::new(4.5, 0.15, 0.0), 1.0).unwrap();
        assert_eq!(right, Wall { distance: 0.5, normal: DVec3::NEG_X });
        assert_eq!(street.nearest_wall(DVec3::new(-3.5, 0.0, 0.0), 1.0), None, "out of reach");
    }

    #[test]
    fn what_hangs_above_the_head_is_no_wall() {
        let sign = mesh(&cuboid(Vec3::new(0.0, 1.9, 0.0), Vec3::new(1.0, 2.5, 1.0)), true);
        let collision = collision(DVec3::ZERO, vec![sign]);
        assert_eq!(collision.nearest_wall(DVec3::new(-0.1, 0.0, 0.5), 1.0), None);
        assert!(collision.nearest_wall(DVec3::new(-0.1, 0.2, 0.5), 1.0).is_some(), "on a step it is");
    }

    #[test]
    fn trees_that_are_not_solid_do_not_count() {
        assert_eq!(street(DVec3::ZERO).nearest_wall(DVec3::new(-0.1, 0.0, 0.5), 1.0), None);
    }

    #[test]
    fn slopes_have_their_height_and_normal() {
        // The slope rises by 1 m over 2 m.
        let [a, b, c] = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 4.0), Vec3::new(4.0, 2.0, 0.0)];
        for triangle in [[a, b, c], [a, c, b]] {
            let ground = collision(DVec3::ZERO, vec![mesh(&[triangle], true)]);
            let ground = ground.height_below(DVec3::new(1.0, 0.5, 1.0)).unwrap();
            assert!((ground.height - 0.5).abs() < TOLERANCE);
            assert!(ground.normal.distance(DVec3::new(-1.0, 2.0, 0.0).normalize()) < TOLERANCE);
        }
    }

    #[test]
    fn nothing_falls_through_a_seam() {
        // A fan of thin triangles round a point: every query lies on an edge, but for rounding.
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let rim: Vec<Vec3> = (0..64).map(|i| Vec3::new((i as f32 * 0.1).cos(), 0.0, (i as f32 * 0.1).sin())).collect();
        let centre = Vec3::new(0.013, 0.0, -0.007);
        let fan: Vec<[Vec3; 3]> = rim.windows(2).map(|pair| [centre, pair[1], pair[0]]).collect();
        let ground = collision(DVec3::ZERO, vec![mesh(&fan, true)]);
        for _ in 0..100_000 {
            let towards = rim[random.random_range(1..62)].as_dvec3();
            let point = centre.as_dvec3().lerp(towards, random.random_range(0.0..0.9));
            assert!(ground.height_below(point).is_some(), "{point} fell through");
        }
    }

    #[test]
    fn far_worlds_are_the_same() {
        let origin = DVec3::new(1e9, -3e6, 7e8);
        let (near, far) = (street(DVec3::ZERO), street(origin));
        for point in [DVec3::new(4.5, 0.125, 0.0), DVec3::new(-4.5, 0.0, 2.0)] {
            let (a, b) = (near.nearest_wall(point, 1.0).unwrap(), far.nearest_wall(origin + point, 1.0).unwrap());
            assert!((a.distance - b.distance).abs() < TOLERANCE);
            let (a, b) = (near.height_below(point).unwrap(), far.height_below(origin + point).unwrap());
            assert!((a.height + origin.y - b.height).abs() < TOLERANCE);
        }
    }

    #[test]
    fn emptiness_and_nonsense_are_answered_with_nothing() {
        let empty = collision(DVec3::ZERO, Vec::new());
        assert_eq!(empty.height_below(DVec3::ZERO), None);
        assert_eq!(empty.nearest_wall(DVec3::ZERO, 1.0), None);
        let line = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0];
        let degenerate = [line, [Vec3::ZERO; 3], [Vec3::NAN, Vec3::X, Vec3::Z], [Vec3::INFINITY, Vec3::X, Vec3::Z]];
        let nothing = collision(DVec3::ZERO, vec![mesh(&degenerate, true)]);
        assert_eq!(nothing.height_below(DVec3::X), None);
        let street = street(DVec3::ZERO);
        assert_eq!(street.height_below(DVec3::NAN), None);
        assert_eq!(street.nearest_wall(DVec3::ZERO, f64::NAN), None);
        assert_eq!(street.height_below(DVec3::new(1e3, 0.0, 0.0)), None, "beyond the edge of the world");
    }

    #[test]
    fn a_single_question_is_answered_like_many() {
        let mut random = ChaCha8Rng::seed_from_u64(9);
        for origin in [DVec3::ZERO, DVec3::new(1e6, -3e3, 7e5)] {
            let triangle = |random: &mut ChaCha8Rng| {
                let centre = (Vec3::from_array(random.random()) - 0.5) * 20.0;
                [(); 3].map(|()| centre + 2.0 * Vec3::from_array(random.random()))
            };
            let triangles: Vec<[Vec3; 3]> = (0..2000).map(|_| triangle(&mut random)).collect();
            let degenerate = [[Vec3::ZERO; 3], [Vec3::NAN, Vec3::X, Vec3::Z], [Vec3::ZERO, Vec3::X, Vec3::X * 2.0]];
            let holes = [triangle(&mut random), triangle(&mut random)];
            let meshes = vec![mesh(&triangles, true), mesh(&degenerate, true), mesh(&holes, false)];
            let scene = Scene { origin, materials: vec![Material::default()], meshes, ..Scene::default() };
            let collision = Collision::new(&scene).unwrap();
            let mut hits = 0;
            for _ in 0..1000 {
                let point = origin + (DVec3::from_array(random.random()) - 0.5) * 20.0;
                let found = ground_below(&scene, point).unwrap();
                assert_eq!(found, collision.height_below(point), "below {point}");
                hits += usize::from(found.is_some());
            }
            assert!(hits > 100, "only {hits} of the points had ground below them");
            for nowhere in [DVec3::NAN, origin.with_y(f64::INFINITY)] {
                assert_eq!(ground_below(&scene, nowhere), Ok(None));
            }
        }
    }

    #[test]
    fn the_nearest_surface_is_that_of_all_triangles() {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let triangles: Vec<[Vec3; 3]> = (0..2000)
            .map(|_| {
                let centre = (Vec3::from_array(random.random()) - 0.5) * 20.0;
                [(); 3].map(|()| centre + Vec3::from_array(random.random()))
            })
            .collect();
        let origin = DVec3::new(1e6, -3e3, 7e5);
        let collision = collision(origin, vec![mesh(&triangles, true)]);
        for _ in 0..1000 {
            let place = (DVec3::from_array(random.random()) - 0.5) * 30.0;
            let points = triangles.iter().map(|triangle| nearest_point(triangle.map(|c| c.as_dvec3()), place));
            let nearest = points.min_by(|a, b| a.distance(place).total_cmp(&b.distance(place))).unwrap();
            let expected = nearest.distance(place);
            let found = collision.nearest_surface(origin + place, f64::INFINITY).unwrap();
            assert!((found.distance - expected).abs() < TOLERANCE, "{} for {expected}", found.distance);
            assert!((found.normal - (place - nearest) / expected).length() < 1e-3);
            assert_eq!(collision.nearest_surface(origin + place, 0.9 * expected), None);
        }
    }

    #[test]
    fn floors_and_roofs_are_surfaces_and_a_point_in_one_has_a_side() {
        let street = street(DVec3::ZERO);
        let over_floor = street.nearest_surface(DVec3::new(0.0, 0.7, 3.0), 1.0).unwrap();
        assert!((over_floor.distance - 0.7).abs() < TOLERANCE && over_floor.normal == DVec3::Y);
        let over_roof = street.nearest_surface(DVec3::new(9.0, 8.25, 3.0), 1.0).unwrap();
        assert!((over_roof.distance - 0.25).abs() < TOLERANCE && over_roof.normal == DVec3::Y);
        let within = street.nearest_surface(DVec3::new(-5.0, 3.0, 3.0), 1.0).unwrap();
        assert_eq!((within.distance, within.normal.abs()), (0.0, DVec3::X));
        assert_eq!(street.nearest_surface(DVec3::new(f64::NAN, 3.0, 3.0), 1.0), None);
    }

    #[test]
    fn the_nearest_wall_is_the_first_of_all_that_are_nearest() {
        let mut random = ChaCha8Rng::seed_from_u64(12);
        // Places on a coarse grid, so that many walls are equally near, and many points lie in walls.
        let mut whole = |most: i32| 0.5 * random.random_range(-most..=most) as f32;
        let triangles: Vec<[Vec3; 3]> = (0..1500)
            .map(|_| {
                let (centre, way) = (Vec3::new(whole(30), whole(3), whole(30)), Vec3::new(whole(2), 0.0, whole(2)));
                [centre, centre + way, centre + Vec3::new(0.0, 2.0, 0.0)]
            })
            .collect();
        let points: Vec<DVec3> =
            (0..1500).map(|_| DVec3::new(whole(40).into(), whole(4).into(), whole(40).into())).collect();
        let collision = collision(DVec3::ZERO, vec![mesh(&triangles, true)]);
        let walls = &collision.sorted.walls;
        let (mut tied, mut within) = (0, 0);
        for point in points {
            let slab = |index| between(walls.triangle(index), point.y + STEP, point.y + BODY);
            let all = (0..walls.triangles.len() as u32).filter_map(|index| {
                let place = nearest_in_plan(&slab(index), plan(point))?;
                Some((place.distance(plan(point)), index, place))
            });
            let mut all: Vec<_> = all.collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for radius in [0.0, 0.5, 2.0, 1e9, f64::INFINITY] {
                let found = collision.nearest_wall(point, radius);
                let Some(&(distance, _, place)) = all.first().filter(|wall| wall.0 <= radius) else {
                    assert_eq!(found, None, "at {point} within {radius}");
                    continue;
                };
                let found = found.unwrap();
                assert_eq!(found.distance, distance, "at {point} within {radius}");
                if let Some(away) = (plan(point) - place).try_normalize() {
                    assert_eq!(found.normal, DVec3::new(away.x, 0.0, away.y), "another wall at {point}");
                }
            }
            tied += usize::from(all.len() > 1 && all[0].0 == all[1].0);
            within += usize::from(all.first().is_some_and(|wall| wall.0 == 0.0));
        }
        assert!(tied > 50 && within > 10, "{tied} ties, {within} within walls");
    }

    #[test]
    fn agrees_with_trying_every_triangle() {
        let mut random = ChaCha8Rng::seed_from_u64(8);
        let triangles: Vec<[Vec3; 3]> = (0..2000)
            .map(|_| {
                let centre = (Vec3::from_array(random.random()) - 0.5) * 20.0;
                [(); 3].map(|()| centre + Vec3::from_array(random.random()))
            })
            .collect();
        let collision = collision(DVec3::ZERO, vec![mesh(&triangles, true)]);
        let mut hits = 0;
        for _ in 0..1000 {
            let point = (DVec3::from_array(random.random()) - 0.5) * 20.0;
            let floors = &collision.sorted.floors;
            let triangles = (0..floors.triangles.len() as u32).map(|index| floors.triangle(index));
            let heights = triangles.filter_map(|triangle| height(triangle, plan(point)));
            let highest = heights.filter(|&height| height <= point.y + STEP).reduce(f64::max);
            let found = collision.height_below(point).map(|ground| ground.height);
            hits += usize::from(found.is_some());
            match (found, highest) {
                (Some(found), Some(highest)) => assert!((found - highest).abs() < TOLERANCE),
                (found, highest) => assert_eq!(found, highest),
            }
        }
        assert!(hits > 100, "only {hits} of the points had ground below them");
    }
}
