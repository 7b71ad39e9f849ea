//! Law: wheel speed on the rider's clock is celerity, the handlebar bends the path in the world, and the brake stops
//! the bicycle.
//!
//! A program that took the wheel speed for β would stand still at c or run past it. One that turned by the world's
//! clock would ride bends whose radius depends on the speed. One that omitted γ in the felt accelerations would drift
//! off the nose, or off its celerity, in a bend.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DQuat, DVec3};
use input::{Controls, VehicleKind};
use physics::worldline::WorldlineState;
use physics::{Celerity, Event};
use ride::{IntegratorKind, LightSpeed, Notice, RAPIDITY_CAP, Vehicle, VehicleSettings};
use scene::{OpenPlane, OpenSpace};

const STEP_S: f64 = 1.0 / 240.0;
/// Tolerance for RK4 at 240 Hz with a response time of 0.7 s.
const INTEGRATION: f64 = 1e-8;

fn bicycle_at(celerity: f64) -> Vehicle {
    let celerity = Celerity::new(DVec3::NEG_Z * celerity).unwrap();
    let state = WorldlineState::new(Event::default(), celerity, DQuat::IDENTITY);
    Vehicle::new(LightSpeed::OLD_TOWN, VehicleKind::Bicycle, state, VehicleSettings::default()).unwrap()
}

fn pedalling(wheel_speed: f64) -> Controls {
    Controls { wheel_speed: Some(wheel_speed), ..Controls::default() }
}

fn ride(bicycle: &mut Vehicle, controls: &Controls, own_s: f64) {
    for _ in 0..(own_s / STEP_S).round() as usize {
        bicycle.step(STEP_S, controls, &OpenPlane);
    }
}

#[test]
fn a_wheel_at_three_quarters_of_c_is_beta_three_fifths() {
    let mut bicycle = bicycle_at(0.75);
    ride(&mut bicycle, &pedalling(0.75 * 30.0 / 3.6), 10.0);
    let state = bicycle.state();
    assert_eq!(state.celerity.vector(), DVec3::NEG_Z * 0.75);
    // Ten seconds on the saddle are 12.5 s on the church tower, 62.5 m of road, and 50 m on the bicycle's own
    // odometer.
    let odometer = bicycle.odometer();
    for (is, should) in [
        (odometer.own_s, 10.0),
        (odometer.world_s, 12.5),
        (odometer.road_m, 62.5),
        (odometer.own_m, 50.0),
        (-state.position.z, 62.5),
        (state.proper_time, 250.0 / 3.0),
    ] {
        assert!((is - should).abs() < 1e-10, "{is} instead of {should}");
    }
}

#[test]
fn any_pedalling_stays_below_the_speed_of_light() {
    for wheel_speed in [1.0, 8.0, 30.0, 100.0, 1e300] {
        let mut bicycle = bicycle_at(0.0);
        let mut before = 0.0;
        for _ in 0..30 * 240 {
            bicycle.step(STEP_S, &pedalling(wheel_speed), &OpenPlane);
            let celerity = bicycle.state().celerity;
            assert!(celerity.beta().vector().length() < 1.0);
            assert!(celerity.magnitude() >= before, "it rises steadily");
            before = celerity.magnitude();
        }
        let wanted = bicycle.light_speed().celerity(wheel_speed.min(100.0));
        assert!((before / wanted - 1.0).abs() < INTEGRATION, "{before} instead of {wanted}");
    }
}

#[test]
fn the_answer_to_the_pedals_is_gradual() {
    let mut bicycle = bicycle_at(0.0);
    ride(&mut bicycle, &pedalling(25.0 / 3.0), 0.7);
    // This is one time constant.
    let reached = bicycle.state().celerity.magnitude();
    assert!((reached - (1.0 - (-1.0f64).exp())).abs() < INTEGRATION, "{reached}");
    // The bicycle slows more slowly than it starts: it is still rolling after one such time.
    ride(&mut bicycle, &pedalling(0.0), 0.7);
    assert!(bicycle.state().celerity.magnitude() > 0.7 * reached);
}

#[test]
fn an_unpedalled_bicycle_rolls_to_a_stop() {
    let mut bicycle = bicycle_at(1.0);
    ride(&mut bicycle, &Controls::default(), 60.0);
    assert!(bicycle.state().celerity.magnitude() < 1e-6);
}

#[test]
fn the_bend_is_a_circle_of_the_same_radius_at_any_speed() {
    let steer_rad = 0.25f64;
    let radius = VehicleSettings::default().bicycle.wheelbase_m / steer_rad.tan();
    // The first tolerance is rounding in 76,000 steps. RK4 at 240 Hz loses bearing with the fifth power of the
    // gyroscopes' turn in a step, γ Ω: 0.08 rad in the last case.
    for (celerity, tolerance) in [(0.01, 1e-7), (0.75, 1e-6), (3.0, 1e-3)] {
        let mut bicycle = bicycle_at(celerity);
        let speed = bicycle.light_speed().metres_per_own_second(celerity);
        let controls = Controls { steer_rad, ..pedalling(speed) };
        // The centre is left of the start, at rest in the world.
        let centre = DVec3::NEG_X * radius;
        let round_s = std::f64::consts::TAU * radius / speed;
        let steps = (round_s / STEP_S).ceil();
        for _ in 0..steps as usize {
            bicycle.step(round_s / steps, &controls, &OpenPlane);
            let distance = (bicycle.state().position - centre).length();
            assert!((distance - radius).abs() < tolerance, "{distance} instead of {radius} at u = {celerity}");
            let nose = bicycle.state().orientation * DVec3::NEG_Z;
            assert!(bicycle.state().celerity.direction().unwrap().distance(nose) < 1e-12);
        }
        // The circle closes: no bearing is lost to Thomas precession, and the nose keeps to the motion.
        assert!(bicycle.state().position.length() < tolerance, "{}", bicycle.state().position);
        assert!((bicycle.state().orientation * DVec3::NEG_Z).distance(DVec3::NEG_Z) < tolerance);
        assert!((bicycle.state().celerity.magnitude() / celerity - 1.0).abs() < tolerance);
    }
}

#[test]
fn the_integrators_agree_on_a_winding_ride() {
    let end = |integrator| {
        let settings = VehicleSettings { integrator, ..VehicleSettings::default() };
        let mut bicycle =
            Vehicle::new(LightSpeed::OLD_TOWN, VehicleKind::Bicycle, WorldlineState::default(), settings).unwrap();
        for n in 0..10 * 240 {
            let steer_rad = 0.04 * (f64::from(n) / 240.0).sin();
            bicycle.step(STEP_S, &Controls { steer_rad, ..pedalling(12.0) }, &OpenPlane);
        }
        bicycle.state().position
    };
    let reference = end(IntegratorKind::DormandPrince);
    assert!(end(IntegratorKind::Rk4).distance(reference) < 1e-4);
    // The midpoint of a varying control is of second order.
    assert!(end(IntegratorKind::Exact).distance(reference) < 1e-2);
    assert!(reference.length() > 30.0);
}

#[test]
fn the_brake_has_two_stages_and_stops_any_celerity() {
    let felt = |brake| {
        let mut bicycle = bicycle_at(3.0);
        let before = bicycle.state().celerity.rapidity();
        ride(&mut bicycle, &Controls { brake, ..pedalling(25.0) }, 0.25);
        bicycle.light_speed().metres_per_own_second(before - bicycle.state().celerity.rapidity()) / 0.25
    };
    let settings = VehicleSettings::default().bicycle;
    // The pedals withstand the first stage of the brake, not the second.
    assert!(felt(0.25) > 0.0 && felt(0.25) < 0.6 * settings.drag_m_s2);
    assert!((felt(0.5) - settings.drag_m_s2).abs() < 1e-6);
    assert!((felt(1.0) - settings.stop_m_s2).abs() < 1e-6);

    for celerity in [1.0, -1.0, 1e3, 1e11] {
        let mut bicycle = bicycle_at(celerity);
        let stop_s = bicycle.light_speed().metres(bicycle.state().celerity.rapidity()) / settings.stop_m_s2;
        ride(&mut bicycle, &Controls { brake: 1.0, ..Controls::default() }, stop_s + 2.0);
        assert!(bicycle.state().celerity.magnitude() < 1e-9, "from {celerity}");
    }
}

#[test]
fn a_bicycle_at_rest_stays_to_the_bit() {
    let mut bicycle = bicycle_at(0.0);
    ride(&mut bicycle, &Controls { steer_rad: 0.5, brake: 0.3, ..Controls::default() }, 5.0);
    assert_eq!(bicycle.state().position, DVec3::ZERO);
    assert_eq!(bicycle.state().orientation, DQuat::IDENTITY);
    assert_eq!(bicycle.state().celerity, Celerity::ZERO);
    assert!((bicycle.odometer().own_s - 5.0).abs() < 1e-9);
}

#[test]
fn there_and_back_ends_where_it_began() {
    let mut bicycle = bicycle_at(0.0);
    let steer_rad = 0.1;
    for wheel_speed in [4.0, -4.0] {
        ride(&mut bicycle, &Controls { steer_rad, ..pedalling(wheel_speed) }, 6.0);
        ride(&mut bicycle, &Controls { steer_rad, brake: 1.0, ..Controls::default() }, 4.0);
        assert!(bicycle.state().celerity.magnitude() < 1e-9);
    }
    // The bicycle is pushed back along the same bend by the same response.
    assert!(bicycle.state().position.length() < 1e-6, "{}", bicycle.state().position);
    assert!((bicycle.state().orientation * DVec3::NEG_Z).distance(DVec3::NEG_Z) < 1e-6);
}

#[test]
fn nothing_jumps_when_the_pedals_are_reversed() {
    let mut bicycle = bicycle_at(0.0);
    let mut before = bicycle.clone();
    for n in 0..40 * 240 {
        let wheel_speed = if n / 480 % 2 == 0 { 10.0 } else { -10.0 };
        bicycle.step(STEP_S, &Controls { steer_rad: 0.3, ..pedalling(wheel_speed) }, &OpenPlane);
        let change = bicycle.state().celerity.vector().distance(before.state().celerity.vector());
        assert!(change < 0.03, "celerity jumps by {change}");
        assert!(bicycle.state().orientation.angle_between(before.state().orientation) < 0.02);
        before = bicycle.clone();
    }
}

#[test]
fn the_ergometer_feels_the_lever_and_the_start() {
    let mut bicycle = bicycle_at(0.0);
    bicycle.step(STEP_S, &Controls::default(), &OpenPlane);
    let free = bicycle.resistance();
    bicycle.step(STEP_S, &pedalling(6.0), &OpenPlane);
    let starting = bicycle.resistance();
    ride(&mut bicycle, &pedalling(6.0), 10.0);
    let steady = bicycle.resistance();
    bicycle.step(STEP_S, &Controls { brake: 1.0, ..pedalling(6.0) }, &OpenPlane);
    assert!(starting > 2.0 * free && (steady - free).abs() < 1e-3);
    assert_eq!(bicycle.resistance(), 1.0);
}

#[test]
fn beyond_the_cap_there_is_a_notice() {
    let mut bicycle = bicycle_at(2.0 * RAPIDITY_CAP.sinh());
    bicycle.step(STEP_S, &Controls::default(), &OpenSpace);
    assert!(bicycle.notices().contains(&Notice::RapidityCapped));
    assert!(bicycle.state().celerity.rapidity() <= RAPIDITY_CAP);
    assert_eq!(Notice::RapidityCapped.to_string(), "rapidity capped at 27");
}
