//! Law: thrust is rapidity on the pilot's clock, the nose follows the motion or the gyroscopes, and nothing jumps or
//! breaks at any speed.
//!
//! A program that accelerated in the world's frame would gain speed ever more slowly in rapidity. One whose nose
//! follows the motion by direction alone would spin at rest and flip in reverse. One that stored γ and u separately
//! would leave the mass shell on a long flight.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DQuat, DVec3};
use input::{Controls, VehicleKind};
use physics::worldline::WorldlineState;
use physics::{Celerity, Event};
use ride::{FlightSettings, IntegratorKind, LightSpeed, Nose, Notice, RAPIDITY_CAP, Vehicle, VehicleSettings};
use scene::{Ground, OpenPlane, OpenSpace, Surroundings, Wall};

const STEP_S: f64 = 1.0 / 240.0;
/// Depth below the ground from which it is still found, metres.
const KERB_M: f64 = 0.2;

fn vehicle(kind: VehicleKind, celerity: DVec3, flight: FlightSettings) -> Vehicle {
    let state = WorldlineState::new(Event::default(), Celerity::new(celerity).unwrap(), DQuat::IDENTITY);
    let settings = VehicleSettings { flight, ..VehicleSettings::default() };
    Vehicle::new(LightSpeed::OLD_TOWN, kind, state, settings).unwrap()
}

fn spaceship(celerity: DVec3) -> Vehicle {
    vehicle(VehicleKind::Fly, celerity, FlightSettings::default())
}

fn gyroscopic() -> FlightSettings {
    FlightSettings { nose: Nose::Gyroscopic, ..FlightSettings::default() }
}

fn thrust(thrust: [f64; 3]) -> Controls {
    Controls { thrust, ..Controls::default() }
}

fn turn(turn: [f64; 3]) -> Controls {
    Controls { turn, ..Controls::default() }
}

fn fly(vehicle: &mut Vehicle, controls: &Controls, own_s: f64) {
    for _ in 0..(own_s / STEP_S).round() as usize {
        vehicle.step(STEP_S, controls, &OpenSpace);
    }
}

fn nose(vehicle: &Vehicle) -> DVec3 {
    vehicle.state().orientation * DVec3::NEG_Z
}

fn motion(vehicle: &Vehicle) -> DVec3 {
    vehicle.state().celerity.direction().unwrap()
}

#[test]
fn full_thrust_reaches_a_celerity_of_one_in_three_seconds() {
    let mut ship = spaceship(DVec3::ZERO);
    fly(&mut ship, &thrust([0.0, 0.0, -1.0]), 3.0);
    let celerity = ship.state().celerity;
    assert!((celerity.rapidity() - 3.0 * FlightSettings::default().thrust_per_s).abs() < 1e-10);
    assert!((celerity.magnitude() - 1.0).abs() < 1e-3);
    assert_eq!(motion(&ship), DVec3::NEG_Z);
}

#[test]
fn thrust_is_felt_alike_at_any_speed_and_the_cap_is_told() {
    let mut ship = spaceship(DVec3::ZERO);
    let forward = thrust([0.0, 0.0, -1.0]);
    let per_second = FlightSettings::default().thrust_per_s;
    let mut before = 0.0;
    for second in 1..=100 {
        fly(&mut ship, &forward, 1.0);
        let rapidity = ship.state().celerity.rapidity();
        let expected = (before + per_second).min(RAPIDITY_CAP);
        // RK4's error per step, (h a)⁵/120, is below rounding; that of asinh at this size is not.
        assert!((rapidity - expected).abs() < 1e-9, "second {second}: {rapidity} instead of {expected}");
        assert_eq!(ship.notices().contains(&Notice::RapidityCapped), rapidity >= RAPIDITY_CAP - 1e-9);
        before = rapidity;
    }
    assert!(ship.state().position.is_finite() && ship.state().ct.is_finite());
}

#[test]
fn a_thrust_reversed_brings_the_ship_back_to_rest() {
    let mut ship = spaceship(DVec3::ZERO);
    for backward in [-1.0, 1.0] {
        fly(&mut ship, &thrust([0.0, 0.0, backward]), 60.0);
    }
    // Rapidity rises to 17.6 and falls back: |δu| ≈ εγ, with RK4's error on top.
    assert!(ship.state().celerity.magnitude() < 1e-6, "{:?}", ship.state().celerity);
    assert_eq!(nose(&ship), DVec3::NEG_Z);
}

#[test]
fn lateral_thrust_bends_the_path_and_turns_the_nose_with_it() {
    let mut ship = spaceship(DVec3::NEG_Z * 1.5);
    for _ in 0..20 * 240 {
        ship.step(STEP_S, &thrust([1.0, 0.0, 0.0]), &OpenSpace);
        // The path is a circle: the speed stays and the nose keeps to the motion, but for the softening, s²/u² of the
        // turn.
        assert!((ship.state().celerity.magnitude() - 1.5).abs() < 1e-2);
        assert!(nose(&ship).angle_between(motion(&ship)) < 2e-3);
    }
    // Full thrust turns the motion by a/u per second.
    let turned: f64 = 20.0 * FlightSettings::default().thrust_per_s / 1.5;
    let expected = DVec3::new(turned.sin(), 0.0, -turned.cos());
    assert!(motion(&ship).angle_between(expected) < 1e-2);
}

#[test]
fn nothing_jumps_through_rest_and_reverse() {
    let mut ship = spaceship(DVec3::NEG_Z * 0.3);
    let mut before = ship.clone();
    for n in 0..60 * 240 {
        // Full reversals beside a steady push to the side: the motion swings through rest and back, again and again.
        let backward = if n / 720 % 2 == 0 { 1.0 } else { -1.0 };
        ship.step(STEP_S, &thrust([0.05 * (f64::from(n) / 500.0).sin(), 0.02, backward]), &OpenSpace);
        let change = ship.state().celerity.vector().distance(before.state().celerity.vector());
        assert!(change < 0.01, "celerity jumps by {change}");
        let turned = ship.state().orientation.angle_between(before.state().orientation);
        assert!(turned < 0.02, "the nose jumps by {turned} rad at {:?}", ship.state().celerity);
        before = ship.clone();
    }
}

#[test]
fn reverse_does_not_turn_the_ship_round() {
    let mut ship = spaceship(DVec3::ZERO);
    fly(&mut ship, &thrust([0.0, 0.0, 1.0]), 10.0);
    assert_eq!(motion(&ship), DVec3::Z);
    assert_eq!(nose(&ship), DVec3::NEG_Z);
    fly(&mut ship, &thrust([0.2, 0.0, 1.0]), 10.0);
    assert!(nose(&ship).angle_between(-motion(&ship)) < 0.05);
}

#[test]
fn twist_rolls_about_the_axis_of_motion_at_any_speed() {
    for (celerity, flight) in [
        (0.0, FlightSettings::default()),
        (1.5, FlightSettings::default()),
        (1e6, FlightSettings::default()),
        (1.5, gyroscopic()),
    ] {
        let mut ship = vehicle(VehicleKind::Fly, DVec3::NEG_Z * celerity, flight);
        fly(&mut ship, &turn([0.0, 0.0, 1.0]), 1.0);
        assert!(nose(&ship).distance(DVec3::NEG_Z) < 1e-9);
        // After one radian to the left the right wing is up.
        let right = ship.state().orientation * DVec3::X;
        assert!(right.distance(DVec3::new(1f64.cos(), 1f64.sin(), 0.0)) < 1e-8, "{right} at u = {celerity}");
        assert_eq!(ship.state().celerity.vector(), DVec3::NEG_Z * celerity);
    }
}

#[test]
fn the_rudder_turns_on_the_spot_at_rest_and_the_motion_when_flying() {
    let mut ship = spaceship(DVec3::ZERO);
    fly(&mut ship, &turn([0.0, 1.0, 0.0]), 0.5);
    assert!(nose(&ship).distance(DVec3::new(-0.5f64.sin(), 0.0, -0.5f64.cos())) < 1e-9);
    assert_eq!(ship.state().celerity, Celerity::ZERO);

    let mut ship = spaceship(DVec3::NEG_Z * 2.0);
    let seconds = 4.0;
    fly(&mut ship, &turn([1.0, 0.0, 0.0]), seconds);
    assert!((ship.state().celerity.magnitude() - 2.0).abs() < 1e-3, "the rudder does not drive");
    assert!(motion(&ship).y > 0.0 && nose(&ship).angle_between(motion(&ship)) < 2e-3);
    let full = FlightSettings::default().thrust_per_s / 2.0 * seconds;
    assert!(motion(&ship).angle_between(DVec3::NEG_Z) <= full, "no more than full thrust");
}

#[test]
fn gyroscopes_precess_and_do_not_follow() {
    let mut ship = vehicle(VehicleKind::Fly, DVec3::NEG_Z * 0.75, gyroscopic());
    let left = thrust([-1.0, 0.0, 0.0]);
    fly(&mut ship, &left, 2.0);
    // The motion bends to the left; Thomas precession turns the axes, seen from the world, to the other side and by
    // less.
    assert!(motion(&ship).x < -0.5);
    assert!(nose(&ship).x > 0.0 && nose(&ship).x < -motion(&ship).x);
}

#[test]
fn the_brake_brings_any_flight_to_rest() {
    for celerity in [DVec3::new(0.3, -2.0, 0.1), DVec3::new(1e10, 0.0, 5e9)] {
        let mut ship = spaceship(celerity);
        let stop_s = ship.state().celerity.rapidity() / FlightSettings::default().thrust_per_s;
        fly(&mut ship, &Controls { brake: 1.0, ..Controls::default() }, stop_s);
        assert!(ship.state().celerity.magnitude() < 1e-6, "{celerity}");
    }
}

#[test]
fn a_driven_vehicle_stays_level_and_on_the_ground() {
    let mut car = vehicle(VehicleKind::Drive, DVec3::ZERO, FlightSettings::default());
    fly(&mut car, &thrust([0.2, 1.0, -1.0]), 5.0);
    assert!(car.state().celerity.magnitude() > 1.0);
    assert_eq!(car.state().position.y, 0.0);
    assert!((car.state().orientation * DVec3::Y).distance(DVec3::Y) < 1e-12);
    assert!((car.gaze().observer.event.position.y - 1.6).abs() < 1e-12);
}

/// Ground that is level, then a slope of one in ten along −z from the origin on.
struct Slope;

impl Surroundings for Slope {
    fn height_below(&self, position: DVec3) -> Option<Ground> {
        let height = (-position.z).max(0.0) * 0.1;
        (position.y >= height - KERB_M).then_some(Ground { height, normal: DVec3::Y })
    }

    fn nearest_wall(&self, _: DVec3, _: f64) -> Option<Wall> {
        None
    }
}

#[test]
fn wheels_follow_the_ground() {
    for (kind, controls) in [
        (VehicleKind::Drive, thrust([0.0, 0.0, -0.5])),
        (VehicleKind::Bicycle, Controls { wheel_speed: Some(6.0), ..Controls::default() }),
    ] {
        let mut vehicle = vehicle(kind, DVec3::ZERO, FlightSettings::default());
        vehicle.settle(&Slope);
        let mut farthest = 0.0f64;
        for _ in 0..12 * 240 {
            vehicle.step(STEP_S, &controls, &Slope);
            let position = vehicle.state().position;
            farthest = farthest.max((position.y - (-position.z).max(0.0) * 0.1).abs());
        }
        let position = vehicle.state().position;
        assert!(position.z < -10.0, "{kind:?} goes nowhere");
        assert!((position.y + 0.1 * position.z).abs() < 1e-4, "{kind:?} at {position}");
        // The kink is ridden smoothly.
        assert!(farthest < 0.05, "{kind:?} leaves the ground by {farthest}");
        // The motion is along the slope, not under it.
        assert!((motion(&vehicle).y - 0.1f64.atan().sin()).abs() < 1e-3, "{kind:?}");
        // Who pedals feels the slope.
        let felt = if kind == VehicleKind::Bicycle { 0.1 } else { 0.0 };
        assert!((vehicle.slope() - felt).abs() < 1e-3, "{kind:?} feels {}", vehicle.slope());
    }
}

#[test]
fn a_kerb_is_climbed_smoothly() {
    /// Ground with a step of 15 cm at z = −10.
    struct Kerb;
    impl Surroundings for Kerb {
        fn height_below(&self, position: DVec3) -> Option<Ground> {
            let height = if position.z < -10.0 { 0.15 } else { 0.0 };
            (position.y >= height - KERB_M).then_some(Ground { height, normal: DVec3::Y })
        }
        fn nearest_wall(&self, _: DVec3, _: f64) -> Option<Wall> {
            None
        }
    }
    let mut bicycle = vehicle(VehicleKind::Bicycle, DVec3::NEG_Z * 0.6, FlightSettings::default());
    let riding = Controls { wheel_speed: Some(5.0), ..Controls::default() };
    let mut before = bicycle.state().position.y;
    for _ in 0..5 * 240 {
        bicycle.step(STEP_S, &riding, &Kerb);
        let height = bicycle.state().position.y;
        assert!((height - before).abs() < 0.01, "jumps by {}", height - before);
        assert!((-0.01..0.16).contains(&height));
        before = height;
    }
    assert!((before - 0.15).abs() < 1e-3);
    assert!(nose(&bicycle).y.abs() < 1e-3, "level again");
}

#[test]
fn changing_the_vehicle_keeps_eye_or_ground() {
    let mut vehicle = vehicle(VehicleKind::Bicycle, DVec3::NEG_Z * 0.75, FlightSettings::default());
    let gaze = vehicle.gaze();
    vehicle.set_kind(VehicleKind::Fly, &OpenPlane);
    assert_eq!(vehicle.gaze(), gaze);
    fly(&mut vehicle, &thrust([0.3, 1.0, -1.0]), 5.0);
    fly(&mut vehicle, &turn([1.0, 0.0, 1.0]), 1.0);
    assert!(vehicle.state().position.y > 1.0);
    for kind in [VehicleKind::Drive, VehicleKind::Bicycle] {
        vehicle.set_kind(kind, &OpenPlane);
        assert_eq!(vehicle.state().position.y, 0.0);
        assert!((vehicle.state().orientation * DVec3::X).y.abs() < 1e-12, "upright");
        assert!(vehicle.state().celerity.magnitude() > 0.1);
    }
}

#[test]
fn controls_of_any_kind_leave_every_vehicle_finite() {
    use rand::{RngExt, SeedableRng};
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    let strange = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, -1e308, 5e-324, 0.0, -0.0];
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive, VehicleKind::Fly] {
        for integrator in [IntegratorKind::Rk4, IntegratorKind::Exact, IntegratorKind::DormandPrince] {
            for speed_of_light in [LightSpeed::SLOWEST_M_S, 30.0 / 3.6, 3e8] {
                let settings = VehicleSettings { integrator, ..VehicleSettings::default() };
                let light_speed = LightSpeed::new(speed_of_light).unwrap();
                let mut vehicle = Vehicle::new(light_speed, kind, WorldlineState::default(), settings).unwrap();
                for _ in 0..300 {
                    let mut any = |range: f64| {
                        if random.random_bool(0.05) {
                            strange[random.random_range(0..strange.len())]
                        } else {
                            random.random_range(-range..range)
                        }
                    };
                    let controls = Controls {
                        wheel_speed: Some(any(50.0)),
                        steer_rad: any(2.0),
                        brake: any(1.5),
                        thrust: [any(1.5), any(1.5), any(1.5)],
                        turn: [any(1.5), any(1.5), any(1.5)],
                        ..Controls::default()
                    };
                    let own_s = any(0.1);
                    let finite = controls.thrust.iter().chain(&controls.turn).all(|value| value.is_finite())
                        && [controls.steer_rad, controls.brake, own_s].iter().all(|value| value.is_finite())
                        && controls.wheel_speed.is_some_and(f64::is_finite)
                        && own_s >= 0.0;
                    vehicle.step(own_s, &controls, &OpenPlane);
                    assert_eq!(vehicle.notices().contains(&Notice::ControlsNotFinite), !finite);
                    let state = vehicle.state();
                    assert!(state.position.is_finite() && state.ct.is_finite() && state.proper_time.is_finite());
                    assert!((state.orientation.length() - 1.0).abs() < 1e-9);
                    assert!(!vehicle.notices().contains(&Notice::NotIntegrated), "{kind:?} {integrator:?}");
                    assert!(state.celerity.rapidity() <= RAPIDITY_CAP + 1e-9);
                    assert!((0.0..=1.0).contains(&vehicle.resistance()));
                    assert!(vehicle.gaze().observer.event.position.is_finite());
                    let odometer = vehicle.odometer();
                    assert!(
                        odometer.road_m.is_finite()
                            && odometer.own_m <= odometer.road_m
                            && odometer.world_s >= odometer.own_s
                    );
                }
            }
        }
    }
}
