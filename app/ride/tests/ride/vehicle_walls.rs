//! Law: walls hold at any speed, let vehicles slide along them, and let them leave.
//!
//! A program that tested only the present position would pass through a house at a celerity of a few. One that took
//! away all speed near a wall would hold a vehicle that turns away from it.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DQuat, DVec3};
use input::{Controls, VehicleKind};
use physics::worldline::WorldlineState;
use physics::{Celerity, Event};
use ride::{FlightSettings, LightSpeed, Notice, Vehicle, VehicleSettings};
use scene::{Ground, Surroundings, Wall};

const STEP_S: f64 = 1.0 / 240.0;

/// Square courtyard of this half width, metres, with walls that have no thickness; ground everywhere, also outside.
struct Courtyard(f64);

impl Surroundings for Courtyard {
    fn height_below(&self, _: DVec3) -> Option<Ground> {
        Some(Ground { height: 0.0, normal: DVec3::Y })
    }

    fn nearest_wall(&self, position: DVec3, reach: f64) -> Option<Wall> {
        let half = self.0;
        let clamped = |value: f64| value.clamp(-half, half);
        let places = [
            DVec3::new(half, position.y, clamped(position.z)),
            DVec3::new(-half, position.y, clamped(position.z)),
            DVec3::new(clamped(position.x), position.y, half),
            DVec3::new(clamped(position.x), position.y, -half),
        ];
        let nearest = places.into_iter().min_by(|a, b| position.distance(*a).total_cmp(&position.distance(*b)))?;
        let distance = position.distance(nearest);
        (distance <= reach).then(|| Wall { distance, normal: (position - nearest).normalize_or(DVec3::X) })
    }
}

/// Vehicle in the middle, its nose `angle` to the left of −z.
fn vehicle(kind: VehicleKind, celerity: f64, angle: f64) -> Vehicle {
    let orientation = DQuat::from_rotation_y(angle);
    let celerity = Celerity::new(orientation * DVec3::NEG_Z * celerity).unwrap();
    let state = WorldlineState::new(Event::default(), celerity, orientation);
    Vehicle::new(LightSpeed::OLD_TOWN, kind, state, VehicleSettings::default()).unwrap()
}

fn pedalling(wheel_speed: f64) -> Controls {
    Controls { wheel_speed: Some(wheel_speed), ..Controls::default() }
}

fn inside(vehicle: &Vehicle, half: f64) -> bool {
    vehicle.state().position.x.abs() < half && vehicle.state().position.z.abs() < half
}

#[test]
fn walls_hold_at_any_celerity() {
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
        for half in [1.0, 5.0, 40.0] {
            let place = Courtyard(half);
            for celerity in [0.1, 1.0, -1.0, 5.0, 50.0, -50.0, 1e4, 1e11] {
                for angle in [0.0, 0.1, 0.7, std::f64::consts::FRAC_PI_4, 2.5] {
                    let mut vehicle = vehicle(kind, celerity, angle);
                    let controls = Controls { thrust: [0.0, 0.0, -1.0], ..pedalling(100.0) };
                    let mut clearance = f64::INFINITY;
                    for _ in 0..480 {
                        vehicle.step(STEP_S, &controls, &place);
                        assert!(inside(&vehicle, half), "{kind:?} at u = {celerity}, angle {angle}, {half} m");
                        clearance = place.nearest_wall(vehicle.state().position, 99.0).unwrap().distance.min(clearance);
                        assert!(vehicle.state().position.y.abs() < 1e-6);
                    }
                    assert!(clearance > 0.39, "{kind:?} comes as near as {clearance}");
                }
            }
        }
    }
}

/// Endless lane along z, one metre wide.
struct Lane;

impl Surroundings for Lane {
    fn height_below(&self, _: DVec3) -> Option<Ground> {
        Some(Ground { height: 0.0, normal: DVec3::Y })
    }

    fn nearest_wall(&self, position: DVec3, _: f64) -> Option<Wall> {
        let distance = 0.5 - position.x.abs();
        Some(Wall { distance: distance.abs(), normal: DVec3::X * -position.x.signum() * distance.signum() })
    }
}

#[test]
fn excess_speed_in_a_lane_is_told_and_costs_distance_but_no_time() {
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive] {
        let mut vehicle = vehicle(kind, 1e4, 0.0);
        vehicle.step(STEP_S, &Controls::default(), &Lane);
        assert_eq!(vehicle.notices(), [Notice::HeldByWalls]);
        assert!(vehicle.state().celerity.magnitude() < 1e4);
        assert!((vehicle.odometer().own_s / STEP_S - 1.0).abs() < 1e-9, "the rider's clock goes on");
        // From then on the vehicle is slow enough for the lane.
        for _ in 0..240 {
            vehicle.step(STEP_S, &Controls::default(), &Lane);
        }
        assert!(vehicle.notices().is_empty());
        assert!(vehicle.state().position.x.abs() < 0.11);
    }
}

#[test]
fn a_head_on_stop_is_soft() {
    let mut bicycle = vehicle(VehicleKind::Bicycle, 1.0, 0.0);
    let mut before = bicycle.state().celerity.magnitude();
    for _ in 0..10 * 240 {
        bicycle.step(STEP_S, &pedalling(25.0 / 3.0), &Courtyard(10.0));
        let celerity = bicycle.state().celerity.magnitude();
        // The approach is exponential with 0.25 s: from u = 1, at most 1/60 a step.
        assert!((celerity - before).abs() < 0.02, "from {before} to {celerity}");
        before = celerity;
    }
    assert!(before < 0.05, "it stands: {before}");
    assert!((bicycle.state().position.z + 10.0 - 0.4).abs() < 0.05);
    assert!(bicycle.resistance() > 0.5, "the pedals feel the wall");
}

#[test]
fn a_glancing_ride_slides_along_the_wall() {
    let place = Courtyard(60.0);
    let mut bicycle = vehicle(VehicleKind::Bicycle, 1.0, 0.3);
    let mut before = bicycle.state().orientation;
    for _ in 0..25 * 240 {
        bicycle.step(STEP_S, &pedalling(25.0 / 3.0), &place);
        let turned = bicycle.state().orientation.angle_between(before);
        assert!(turned < 3.1 * STEP_S, "the frame is swung round by {turned}");
        before = bicycle.state().orientation;
        if bicycle.state().position.z < -55.0 {
            break;
        }
    }
    // The vehicle has met a wall on the left or ahead by now and still moves.
    let mut car = vehicle(VehicleKind::Drive, 1.0, 0.3);
    for _ in 0..240 * 8 {
        car.step(STEP_S, &Controls::default(), &Courtyard(10.0));
    }
    let position = car.state().position;
    assert!(position.z < -9.0 && position.x < -9.0, "slides into the corner: {position}");
    assert!(bicycle.state().celerity.magnitude() > 0.5);
}

#[test]
fn a_vehicle_at_a_wall_can_leave() {
    for angle in [0.0, 0.4, std::f64::consts::FRAC_PI_4] {
        let place = Courtyard(6.0);
        let mut bicycle = vehicle(VehicleKind::Bicycle, 2.0, angle);
        for _ in 0..5 * 240 {
            bicycle.step(STEP_S, &pedalling(10.0), &place);
        }
        // Turn the handlebar and keep pedalling: round and back to the middle.
        let nearest = (0..20 * 240)
            .map(|_| {
                bicycle.step(STEP_S, &Controls { steer_rad: 0.5, ..pedalling(3.0) }, &place);
                place.nearest_wall(bicycle.state().position, 99.0).unwrap().distance
            })
            .fold(0.0, f64::max);
        assert!(nearest > 1.5, "held at the wall, {nearest} m at most, from angle {angle}");

        // Pushing back works, too.
        let mut bicycle = vehicle(VehicleKind::Bicycle, 2.0, angle);
        for wheel_speed in [10.0, -1.5] {
            for _ in 0..5 * 240 {
                bicycle.step(STEP_S, &pedalling(wheel_speed), &place);
            }
        }
        assert!(place.nearest_wall(bicycle.state().position, 99.0).unwrap().distance > 1.5, "from angle {angle}");

        // A car turns round and thrusts.
        let mut car = vehicle(VehicleKind::Drive, 2.0, angle);
        for _ in 0..5 * 240 {
            car.step(STEP_S, &Controls::default(), &place);
        }
        for _ in 0..2 * 240 {
            car.step(STEP_S, &Controls { thrust: [0.0, 0.0, 1.0], ..Controls::default() }, &place);
        }
        assert!(place.nearest_wall(car.state().position, 99.0).unwrap().distance > 1.0, "from angle {angle}");
    }
}

#[test]
fn a_start_too_near_a_wall_neither_throws_nor_holds_the_bicycle() {
    let place = Courtyard(0.3);
    let mut bicycle = vehicle(VehicleKind::Bicycle, 0.0, 0.0);
    for _ in 0..240 {
        bicycle.step(STEP_S, &pedalling(5.0), &place);
        assert!(inside(&bicycle, 0.3));
    }
    // Start just outside the courtyard, facing away from it.
    let state =
        WorldlineState::new(Event { ct: 0.0, position: DVec3::new(0.0, 0.0, -0.35) }, Celerity::ZERO, DQuat::IDENTITY);
    let mut bicycle =
        Vehicle::new(LightSpeed::OLD_TOWN, VehicleKind::Bicycle, state, VehicleSettings::default()).unwrap();
    for _ in 0..2 * 240 {
        bicycle.step(STEP_S, &pedalling(5.0), &place);
    }
    assert!(bicycle.state().position.z < -5.0);
}

#[test]
fn walls_do_not_stop_a_spaceship() {
    let mut ship = vehicle(VehicleKind::Fly, 1.0, 0.0);
    assert_eq!(ship.settings().flight, FlightSettings::default());
    for _ in 0..240 {
        ship.step(STEP_S, &Controls::default(), &Courtyard(3.0));
    }
    assert!(ship.state().position.z < -3.0);
}
