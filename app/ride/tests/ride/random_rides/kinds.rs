//! Law: the kinds of rides that once broke a law of random rides keep it. Each test rides in a small place of its kind.

use glam::{DQuat, DVec3, Vec3};
use input::{Controls, VehicleKind};
use physics::worldline::WorldlineState;
use physics::{Celerity, Event};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use ride::{IntegratorKind, LightSpeed, Notice, Vehicle, VehicleSettings};
use scene::collision::Collision;
use scene::{OpenPlane, Surroundings};

use crate::vehicle_hull::place_of;

const STEP_S: f64 = 1.0 / 240.0;
/// Least distance of a vehicle from a wall, metres: the reach of its body, less an elbow.
const BODY_M: f64 = 0.384;
/// Greatest height of a fast vehicle above the ground, metres, and of one that stops at its end.
const LIFTED_M: f64 = 0.46;
/// Half the width of a yard, metres.
const HALF_M: f32 = 2.5;
/// Height of a yard's middle above its edge, metres: with it, the height of a vehicle above the edge varies.
const FALL_M: f32 = 0.05;

/// Yard with thin walls, and a doorstep all along them, this high and deep, metres.
fn yard(high: f32, deep: f32) -> Collision {
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [Vec3; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    let inner = HALF_M - deep;
    let ring = |half: f32, y: f32| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, z)| Vec3::new(half * x, y, half * z))
    };
    for side in 0..4 {
        let next = (side + 1) % 4;
        let mut between = |[half, y]: [f32; 2], [to_half, to_y]: [f32; 2]| {
            let (from, to) = (ring(half, y), ring(to_half, to_y));
            quad([from[side], from[next], to[next], to[side]]);
        };
        // The ground falls away from the middle, and goes on beyond the walls.
        between([0.0, FALL_M], [inner, 0.0]);
        between([inner, 0.0], [50.0, 0.0]);
        between([HALF_M, 0.0], [HALF_M, 3.0]);
        between([inner, 0.0], [inner, high]);
        between([inner, high], [HALF_M, high]);
    }
    place_of(&triangles)
}

#[test]
fn a_step_that_counts_again_pushes_no_vehicle_through_the_wall_behind_it() {
    let mut random = ChaCha8Rng::seed_from_u64(1907);
    for high in [0.201, 0.205, 0.21, 0.22, 0.23, 0.24] {
        for deep in [0.05, 0.15, 0.32, 0.5] {
            let yard = yard(high, deep);
            for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
                for (light_m_s, celerity) in [(30.0 / 3.6, 2.0), (30.0 / 3.6, 0.2), (3e8, 0.0), (3e8, 1e-6)] {
                    let mut ahead = || DQuat::from_rotation_y(random.random_range(0.0..6.3));
                    let orientation = ahead();
                    let celerity = Celerity::new(orientation * DVec3::NEG_Z * celerity).unwrap();
                    let state = WorldlineState::new(Event::default(), celerity, orientation);
                    let light_speed = LightSpeed::new(light_m_s).unwrap();
                    let mut vehicle = Vehicle::new(light_speed, kind, state, VehicleSettings::default()).unwrap();
                    for tick in 0..480 {
                        let mut between = |most: f64| random.random_range(-most..most);
                        let steer_rad = if tick % 60 < 30 { 0.0 } else { between(0.6) };
                        let thrust = [between(1.0), 0.0, between(1.0) - 0.5];
                        let controls = Controls { thrust, steer_rad, wheel_speed: Some(8.0), ..Controls::default() };
                        vehicle.step(STEP_S, &controls, &yard);
                        let place = vehicle.state().position;
                        let is_inside = place.x.abs().max(place.z.abs()) < f64::from(HALF_M);
                        assert!(is_inside, "{kind:?}, c = {light_m_s}, {high} m high, {deep} m deep: at {place}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_motion_into_the_ground_ends_clear_of_walls() {
    let mut random = ChaCha8Rng::seed_from_u64(2663);
    for high in [0.3, 0.5, 0.7] {
        // A car on the step, which is a terrace, or below it.
        let yard = yard(high, 1.3);
        for _ in 0..400 {
            let mut between = |most: f64| random.random_range(-most..most);
            let place = DVec3::new(between(2.0), f64::from(high) + 0.05, between(2.0));
            if yard.nearest_wall(place, 0.5).is_some() {
                continue;
            }
            let motion = DVec3::new(between(1.0), between(4.0), between(1.0)).normalize_or(DVec3::NEG_Y);
            let celerity = Celerity::new(motion * libm::exp10(between(4.0))).unwrap();
            let state = WorldlineState::new(Event { ct: 0.0, position: place }, celerity, DQuat::IDENTITY);
            let settings = VehicleSettings::default();
            let mut car = Vehicle::new(LightSpeed::OLD_TOWN, VehicleKind::Drive, state, settings).unwrap();
            for _ in 0..60 {
                car.step(STEP_S, &Controls::default(), &yard);
                let wall = yard.nearest_wall(car.state().position, BODY_M);
                assert_eq!(wall, None, "at {} from the motion {motion}", car.state().position);
            }
        }
    }
}

#[test]
fn a_fast_vehicle_stops_at_the_grounds_end_and_not_above_it() {
    let [a, b, c, d] =
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, z)| Vec3::new(10.0 * x, 0.0, 10.0 * z));
    let plane = place_of(&[[a, b, c], [a, c, d]]);
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
        for slope in [0.02, 0.1, 0.3] {
            // Fourteen metres a step: over the end at once.
            let motion = DVec3::new(0.1, slope, -1.0).normalize();
            let orientation = DQuat::from_rotation_arc(DVec3::NEG_Z, motion);
            let state = WorldlineState::new(Event::default(), Celerity::new(motion * 1.1e-5).unwrap(), orientation);
            let light_speed = LightSpeed::new(3e8).unwrap();
            let mut vehicle = Vehicle::new(light_speed, kind, state, VehicleSettings::default()).unwrap();
            for _ in 0..60 {
                vehicle.step(STEP_S, &Controls::default(), &plane);
                let place = vehicle.state().position;
                assert!(place.x.abs().max(place.z.abs()) <= 10.0, "{kind:?} has left the ground at {place}");
                assert!(place.y < LIFTED_M, "{kind:?} stops in the air at {place}");
            }
        }
    }
}

#[test]
fn steps_that_would_outlast_their_time_are_left_to_rk4() {
    // A handlebar turns a bicycle, and the ground a car that points into it, as fast at any celerity.
    let controls = Controls { steer_rad: 0.5, ..Controls::default() };
    let (level, down) = (DVec3::NEG_Z, DVec3::new(0.0, -0.2, -1.0).normalize());
    for (integrator, kind, motion, fast) in [
        (IntegratorKind::Exact, VehicleKind::Bicycle, level, 1e6),
        (IntegratorKind::DormandPrince, VehicleKind::Drive, down, 1e5),
    ] {
        for (celerity, outlasts) in [(1.0, false), (fast, true)] {
            let start = Celerity::new(motion * celerity).unwrap();
            let state = WorldlineState::new(Event::default(), start, DQuat::IDENTITY);
            let settings = VehicleSettings { integrator, ..VehicleSettings::default() };
            let mut vehicle = Vehicle::new(LightSpeed::OLD_TOWN, kind, state, settings).unwrap();
            vehicle.step(STEP_S, &controls, &OpenPlane);
            let is_left = vehicle.notices().contains(&Notice::TakenByRk4);
            assert_eq!(is_left, outlasts, "{integrator:?} at the celerity {celerity}");
            assert!(vehicle.state().position.is_finite() && vehicle.state().celerity.magnitude() > 0.5 * celerity);
        }
    }
}
