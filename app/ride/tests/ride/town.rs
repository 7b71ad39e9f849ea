//! Law: the tour gets round the built-in town, and vehicles never enter a house.
//!
//! A modelled town's walls are not perfect: at corners, doorsteps and street furniture a wrong program would let a
//! vehicle slip through or be thrown about.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::sync::{Arc, LazyLock};

use built_in::town;
use glam::DVec3;
use input::{BicycleConfig, Controls, DeskConfig, SECOND, VehicleKind};
use physics::Celerity;
use physics::worldline::WorldlineState;
use ride::{LightSpeed, RideStart, Setup, Simulation, Tour, Vehicle, VehicleSettings};
use scene::collision::Collision;
use scene::{OpenSpace, Scene, Surroundings};

/// Town built once for all tests, as its pictures take their time.
pub(super) static TOWN: LazyLock<(Scene, Arc<Collision>)> = LazyLock::new(|| {
    let scene = town::build(1);
    let collision = Arc::new(Collision::new(&scene).unwrap());
    (scene, collision)
});

/// Largest distance of the tour from the circuit, metres.
const ON_THE_ROUTE_M: f64 = 0.3;
/// Least distance of a vehicle from a wall, metres: the reach of its body, save for rounding.
const BODY_M: f64 = 0.39;
/// Largest rise between two frames, metres: a kerb's ramp at the greatest speed, for a sixtieth of a second.
const CLIMB_M: f64 = 0.08;

fn start() -> RideStart {
    RideStart::at_rest(TOWN.0.circuit[0], TOWN.0.circuit[1] - TOWN.0.circuit[0], DVec3::Y)
}

#[test]
fn the_tour_laps_the_streets_and_touches_nothing() {
    let (scene, surroundings) = &*TOWN;
    let setup = Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind: VehicleKind::Bicycle,
        start: start(),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig::default(),
    };
    let mut tour = Tour::new(&scene.circuit, &BicycleConfig::default()).unwrap();
    let mut simulation = Simulation::new(setup, surroundings.clone()).unwrap();
    let mut passed = vec![false; scene.circuit.len()];
    let mut before = simulation.vehicle().state().position;
    for n in 0..60 * 120 {
        let at = n * SECOND / 60;
        let samples = tour.samples(simulation.vehicle(), at);
        let frame = simulation.frame(at, &samples);
        assert!(frame.notices.is_empty());
        let position = frame.vehicle.state().position;
        let nearest = scene.circuit.iter().map(|point| point.distance(position)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 2.0 + ON_THE_ROUTE_M, "{nearest} m from the circuit's points at {position}");
        assert!(surroundings.nearest_wall(position, 1.2 - ON_THE_ROUTE_M).is_none(), "brushes a wall at {position}");
        let ground = surroundings.height_below(position).unwrap().height;
        assert!((position.y - ground).abs() < 0.1, "off the ground at {position}");
        assert!((position.y - before.y).abs() < CLIMB_M, "jumps up or down at {position}");
        for (passed, point) in passed.iter_mut().zip(&scene.circuit) {
            *passed |= point.distance(position) < 1.0 + ON_THE_ROUTE_M;
        }
        before = position;
    }
    let missed = passed.iter().filter(|passed| !**passed).count();
    assert_eq!(missed, 0, "points of the circuit that were never passed");
}

#[test]
fn random_controls_stay_in_the_streets() {
    use rand::{RngExt, SeedableRng};
    let surroundings = &TOWN.1;
    for seed in 0..12 {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
        let kind = if seed % 2 == 0 { VehicleKind::Bicycle } else { VehicleKind::Drive };
        let state = start().state().unwrap();
        let mut vehicle = Vehicle::new(LightSpeed::OLD_TOWN, kind, state, VehicleSettings::default()).unwrap();
        vehicle.settle(&**surroundings);
        for _ in 0..40 {
            let controls = Controls {
                wheel_speed: Some(random.random_range(-3.0..30.0)),
                steer_rad: random.random_range(-0.6..0.6),
                thrust: [random.random_range(-1.0..1.0), 0.0, random.random_range(-1.0..0.5)],
                turn: [0.0, random.random_range(-1.0..1.0), 0.0],
                ..Controls::default()
            };
            for _ in 0..120 {
                let before = vehicle.state().position;
                vehicle.step(1.0 / 240.0, &controls, &**surroundings);
                let after = vehicle.state().position;
                assert!((after.y - before.y).abs() < CLIMB_M, "seed {seed}: jumps at {after}");
                let nearest = |position| surroundings.nearest_wall(position, 1.0).map_or(1.0, |wall| wall.distance);
                assert!(nearest(after) > BODY_M, "seed {seed}: {} m from a wall at {after}", nearest(after));
                // The path between had no wall either; a step downwards may turn a doorstep into a wall there.
                let between = (1..4).map(|share| nearest(before.lerp(after, f64::from(share) / 4.0)));
                assert!(between.fold(1.0, f64::min) > 0.5 * BODY_M, "seed {seed}: through a wall before {after}");
            }
        }
    }
}

#[test]
fn walls_of_the_streets_hold_at_any_celerity() {
    let surroundings = &TOWN.1;
    for celerity in [20.0, 1e3, 1e6] {
        for (index, &place) in TOWN.0.circuit.iter().enumerate().step_by(40) {
            let angle = index as f64;
            let direction = DVec3::new(angle.sin(), 0.0, angle.cos());
            let mut state: WorldlineState = RideStart::at_rest(place, direction, DVec3::Y).state().unwrap();
            state.celerity = Celerity::new(direction * celerity).unwrap();
            let mut car =
                Vehicle::new(LightSpeed::OLD_TOWN, VehicleKind::Drive, state, VehicleSettings::default()).unwrap();
            car.settle(&**surroundings);
            for _ in 0..24 {
                car.step(1.0 / 240.0, &Controls::default(), &**surroundings);
                let position = car.state().position;
                let wall = surroundings.nearest_wall(position, 1.0);
                assert!(wall.is_none_or(|wall| wall.distance > BODY_M), "u = {celerity} from {place}: {wall:?}");
            }
            // The town is some 200 m across; a vehicle that had left it would be far away by now.
            assert!(car.state().position.length() < 300.0, "u = {celerity} from {place} to {}", car.state().position);
        }
    }
}

#[test]
fn a_spaceship_that_becomes_a_car_is_set_on_the_ground() {
    let mut ship =
        Vehicle::new(LightSpeed::OLD_TOWN, VehicleKind::Fly, start().state().unwrap(), VehicleSettings::default())
            .unwrap();
    let up = Controls { thrust: [0.0, 1.0, 0.0], ..Controls::default() };
    for _ in 0..240 * 5 {
        ship.step(1.0 / 240.0, &up, &OpenSpace);
    }
    assert!(ship.state().position.y > 20.0);
    ship.set_kind(VehicleKind::Drive, &*TOWN.1);
    let position = ship.state().position;
    assert_eq!(Some(position.y), TOWN.1.height_below(position).map(|ground| ground.height));
}
