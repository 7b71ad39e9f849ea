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
