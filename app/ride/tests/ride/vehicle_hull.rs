//! Law: a spaceship with a hull passes through no surface at any speed, slides along it, comes away from it, and flies
//! through free space as one without.
//!
//! A program that tested only where a step ends would fly through a wall at once. One that took all speed away would
//! stick to it. One that tested walls of the ground only would fall through floors and roofs.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DQuat, DVec3, Vec3};
use input::{Controls, VehicleKind};
use physics::worldline::WorldlineState;
use physics::{Celerity, Event};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use ride::{FlightSettings, LightSpeed, Vehicle, VehicleSettings};
use scene::collision::Collision;
use scene::{Material, Mesh, OpenSpace, Scene, Surroundings};

use crate::town::TOWN;

const STEP_S: f64 = 1.0 / 240.0;
/// Radius of the hull, metres.
const RADIUS_M: f64 = 0.4;
/// Least distance from a surface, metres: the radius, but for the accuracy of the corrections.
const LEAST_M: f64 = 0.399;
/// Half the extent of the closed room, metres.
const ROOM: Vec3 = Vec3::new(5.0, 2.5, 4.0);

/// Solid place of these triangles.
pub(super) fn place_of(triangles: &[[Vec3; 3]]) -> Collision {
    let positions = triangles.concat();
    let count = positions.len();
    let mesh = Mesh {
        normals: vec![Vec3::Y; count],
        uvs: vec![Default::default(); count],
        colours: vec![[1.0; 4]; count],
        indices: (0..count as u32).collect(),
        positions,
        solid: true,
        ..Mesh::default()
    };
    let scene = Scene { materials: vec![Material::default()], meshes: vec![mesh], ..Scene::default() };
    Collision::new(&scene).unwrap()
}

/// Closed room of twelve triangles about the origin.
fn room() -> Collision {
    let corner = |i: usize| {
        let side = |bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
        ROOM * Vec3::new(side(0), side(1), side(2))
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[Vec3; 3]> =
        quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).map(|t| t.map(corner)).collect();
    place_of(&triangles)
}

fn ship(position: DVec3, celerity: DVec3, speed_of_light_m_s: f64, hull_m: f64) -> Vehicle {
    let orientation = DQuat::from_rotation_arc(DVec3::NEG_Z, celerity.normalize_or(DVec3::NEG_Z));
    let state = WorldlineState::new(Event { ct: 0.0, position }, Celerity::new(celerity).unwrap(), orientation);
    let flight = FlightSettings { hull_m, ..FlightSettings::default() };
    let settings = VehicleSettings { flight, ..VehicleSettings::default() };
    Vehicle::new(LightSpeed::new(speed_of_light_m_s).unwrap(), VehicleKind::Fly, state, settings).unwrap()
}

fn thrust(thrust: [f64; 3]) -> Controls {
    Controls { thrust, ..Controls::default() }
}

#[test]
fn no_flight_leaves_a_closed_room() {
    let room = room();
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let rapidity_cap = libm::sinh(27.0);
    for speed_of_light in [30.0 / 3.6, 3e8] {
        for celerity in [0.0, 0.5, 20.0, 1e3, 1e6, rapidity_cap] {
            for _ in 0..12 {
                let direction = (DVec3::from_array(random.random()) - 0.5).normalize();
                let mut ship = ship(DVec3::ZERO, direction * celerity, speed_of_light, RADIUS_M);
                for tick in 0..240 {
                    let wish = [(); 3].map(|()| random.random_range(-1.0..1.0));
                    let controls = if tick % 60 < 30 { thrust([0.0, 0.0, -1.0]) } else { thrust(wish) };
                    ship.step(STEP_S, &controls, &room);
                    let position = ship.state().position;
                    let free = ROOM.as_dvec3() - position.abs();
                    assert!(free.min_element() > LEAST_M, "u = {celerity}, c = {speed_of_light}: at {position}");
                }
                assert!((ship.odometer().own_s - 1.0).abs() < 1e-9, "the ship's clock goes on");
            }
        }
    }
}

#[test]
fn a_flight_slides_along_an_inclined_plane() {
    let big = 200.0;
    let [a, b] = [Vec3::new(-big, -big, -big), Vec3::new(big, -big, -big)];
    let [c, d] = [Vec3::new(-big, big, big), Vec3::new(big, big, big)];
    let plane = place_of(&[[a, b, c], [b, d, c]]);
    let normal = DVec3::new(0.0, 1.0, -1.0).normalize();
    for up in [false, true] {
        // Downward, or level, onto the slope of 45° that rises towards +z.
        let motion = if up { DVec3::Z } else { DVec3::NEG_Y };
        let mut ship = ship(DVec3::new(0.0, 6.0, 0.0), motion * 0.5, 30.0 / 3.6, RADIUS_M);
        let along = motion - normal * motion.dot(normal);
        for _ in 0..600 {
            ship.step(STEP_S, &thrust([0.0, 0.0, -1.0]), &plane);
            let distance = ship.state().position.dot(normal);
            assert!(distance > LEAST_M, "through the plane at {}", ship.state().position);
            // The nearer the plane is, the slower it is approached: by as much as is left in a quarter of a second.
            let into_m_s = -ship.state().celerity.vector().dot(normal) * 30.0 / 3.6;
            assert!(into_m_s < (distance - RADIUS_M + 0.1) / 0.25 || distance > 3.0, "{into_m_s} m/s at {distance} m");
        }
        let celerity = ship.state().celerity.vector();
        assert!(celerity.dot(along) > 0.5 * along.length(), "{celerity} along {along}");
        assert!(celerity.dot(normal).abs() < 0.02, "{celerity}");
    }
}

#[test]
fn free_flight_has_the_bits_of_a_ship_without_a_hull() {
    let far = place_of(&[[Vec3::new(1e4, 0.0, 0.0), Vec3::new(1e4, 1.0, 0.0), Vec3::new(1e4, 0.0, 1.0)]]);
    let places: [&dyn Surroundings; 2] = [&OpenSpace, &far];
    for place in places {
        let [mut with, mut without] = [RADIUS_M, 0.0].map(|hull| ship(DVec3::Y, DVec3::ZERO, 30.0 / 3.6, hull));
        let mut random = ChaCha8Rng::seed_from_u64(6);
        for _ in 0..720 {
            let controls = Controls {
                thrust: [(); 3].map(|()| random.random_range(-1.0..1.0)),
                turn: [(); 3].map(|()| random.random_range(-1.0..1.0)),
                ..Controls::default()
            };
            with.step(STEP_S, &controls, place);
            without.step(STEP_S, &controls, place);
            assert_eq!(with.state(), without.state());
        }
    }
}

#[test]
fn a_ship_in_a_corner_slides_along_it_and_comes_out_of_it() {
    let room = room();
    let mut ship = ship(DVec3::ZERO, DVec3::ZERO, 30.0 / 3.6, RADIUS_M);
    // Into the corner, then out of it.
    for _ in 0..240 * 6 {
        ship.step(STEP_S, &thrust([1.0, -1.0, 0.0]), &room);
    }
    let cornered = ship.state().position;
    assert!(cornered.y < 0.5 - 2.5 && (ROOM.as_dvec3() - cornered.abs()).min_element() > LEAST_M, "{cornered}");
    let towards_middle = |ship: &Vehicle| {
        let pull = ship.state().orientation.inverse() * -ship.state().position.normalize();
        thrust(pull.to_array())
    };
    let mut closest = f64::INFINITY;
    for _ in 0..240 * 4 {
        let controls = towards_middle(&ship);
        ship.step(STEP_S, &controls, &room);
        closest = ship.state().position.length().min(closest);
    }
    assert!(closest < 1.0, "only {closest} m from the middle, from {cornered}");
}

#[test]
fn a_ship_that_begins_in_a_wall_gets_out() {
    let room = room();
    let gone_m = |beside: f64, away: DVec3| {
        let place = DVec3::new(f64::from(ROOM.x) + beside, 0.3, 0.2);
        let mut ship = ship(place, DVec3::ZERO, 30.0 / 3.6, RADIUS_M);
        for _ in 0..480 {
            let pull = ship.state().orientation.inverse() * away;
            ship.step(STEP_S, &thrust(pull.to_array()), &room);
        }
        (ship.state().position - place).dot(away)
    };
    for beside in [1e-3, 0.05, 0.3] {
        for side in [-1.0, 1.0] {
            let gone = gone_m(side * beside, DVec3::X * side);
            assert!(gone > 1.0, "{} m beside the wall: only {gone} m away", side * beside);
            let through = gone_m(side * beside, DVec3::NEG_X * side);
            assert!(through < beside, "{} m beside the wall: {through} m through it", side * beside);
        }
    }
    // The middle of the wall itself is on one of its sides.
    assert!(gone_m(0.0, DVec3::X).max(gone_m(0.0, DVec3::NEG_X)) > 1.0);
}

#[test]
fn flights_through_the_town_keep_clear_of_everything() {
    let town = &TOWN.1;
    for seed in 0..10 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let place = TOWN.0.circuit[seed as usize * 20] + DVec3::Y * 1.6;
        let direction = DVec3::new(random.random_range(-1.0..1.0), 0.1, random.random_range(-1.0..1.0)).normalize();
        let celerity = [0.0, 1.0, 100.0, 1e6][seed as usize % 4];
        let mut ship = ship(place, direction * celerity, 30.0 / 3.6, RADIUS_M);
        let least = town.nearest_surface(place, 1.0).map_or(1.0, |surface| surface.distance).min(LEAST_M);
        for _ in 0..12 {
            let controls = Controls {
                thrust: [(); 3].map(|()| random.random_range(-1.0..1.0)),
                turn: [(); 3].map(|()| random.random_range(-1.0..1.0)),
                ..Controls::default()
            };
            for _ in 0..60 {
                ship.step(STEP_S, &controls, &**town);
                let position = ship.state().position;
                let nearest = town.nearest_surface(position, 1.0).map_or(1.0, |surface| surface.distance);
                assert!(nearest > least - 1e-3, "seed {seed}: {nearest} m from a surface at {position}");
                let below = town.height_below(position).map(|ground| ground.height);
                assert!(below.is_none_or(|ground| position.y > ground), "seed {seed}: under the ground at {position}");
            }
        }
    }
}
