//! Law: the built-in tour takes a bicycle round a closed route, by sensor lines through the real decoder.
//!
//! A wrong sign of the handlebar or of the yaw leaves the route at the first bend; a tour that does not look ahead is
//! carried out of the bends.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::sync::Arc;

use glam::DVec3;
use input::{BicycleConfig, DeskConfig, SECOND, SpeedSource, VehicleKind};
use ride::{LightSpeed, RideFrame, RideStart, Setup, Simulation, Tour, VehicleSettings};
use scene::OpenPlane;

/// Largest distance from the route, metres.
const ON_THE_ROUTE_M: f64 = 1.0;
/// Largest rate of turn in a bend, radians per second of own time; at the cruise the sharpest bend would have 1.16.
const BEND_RAD_S: f64 = 1.05;

/// Closed route: a rounded rectangle of 60 m × 30 m with an S-bend in one of the long sides. The sharpest radius is
/// 6 m.
fn circuit() -> Vec<DVec3> {
    let mut points = Vec::new();
    let mut position = DVec3::ZERO;
    let mut heading = 0.0f64; // To the left of −z.
    let mut go = |length: f64, turn: f64| {
        let steps = (length / 1.5).ceil();
        for _ in 0..steps as usize {
            heading += 0.5 * turn / steps;
            position += DVec3::new(-heading.sin(), 0.0, -heading.cos()) * (length / steps);
            heading += 0.5 * turn / steps;
            points.push(position);
        }
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let bend = |radius: f64, turn: f64| (radius * turn.abs(), turn);
    for (length, turn) in [
        (40.0, 0.0),
        bend(6.0, quarter),
        (18.0, 0.0),
        bend(6.0, quarter),
        (14.0, 0.0),
        // The S-bend goes out and back in.
        bend(8.0, -0.5),
        bend(8.0, 1.0),
        bend(8.0, -0.5),
        (40.0 - 14.0 - 32.0 * 0.5f64.sin(), 0.0),
        bend(6.0, quarter),
        (18.0, 0.0),
        bend(6.0, quarter),
    ] {
        if length > 0.0 {
            go(length, turn);
        }
    }
    assert!(position.length() < 0.1, "the route is closed: {position}");
    points
}

fn setup(circuit: &[DVec3]) -> Setup {
    Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind: VehicleKind::Bicycle,
        start: RideStart::at_rest(circuit[0], circuit[1] - circuit[0], DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig::default(),
    }
}

fn ride(seconds: u64) -> Vec<RideFrame> {
    ride_on(&BicycleConfig::default(), seconds)
}

/// Ride on a bicycle that is calibrated in this way.
fn ride_on(bicycle: &BicycleConfig, seconds: u64) -> Vec<RideFrame> {
    let circuit = circuit();
    let mut setup = setup(&circuit);
    setup.desk.bicycle = bicycle.clone();
    let mut tour = Tour::new(&circuit, bicycle).unwrap();
    let mut simulation = Simulation::new(setup, Arc::new(OpenPlane)).unwrap();
    (0..=60 * seconds)
        .map(|n| {
            let at = n * SECOND / 60;
            let samples = tour.samples(simulation.vehicle(), at);
            simulation.frame(at, &samples)
        })
        .collect()
}

fn distance_to(circuit: &[DVec3], position: DVec3) -> f64 {
    let next = circuit.iter().skip(1).chain(circuit.first());
    circuit
        .iter()
        .zip(next)
        .map(|(&from, &to)| {
            let share = ((position - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
            position.distance(from.lerp(to, share))
        })
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn the_tour_laps_the_circuit_and_keeps_to_it() {
    let circuit = circuit();
    let frames = ride(120);
    let mut farthest = 0.0f64;
    for frame in &frames {
        let position = frame.vehicle.state().position;
        farthest = farthest.max(distance_to(&circuit, position));
    }
    assert!(farthest < ON_THE_ROUTE_M, "it strays by {farthest} m");
    let turned = frames
        .windows(60)
        .map(|second| second[0].gaze.observer_from_eye.angle_between(second[59].gaze.observer_from_eye));
    assert!(turned.fold(0.0, f64::max) < BEND_RAD_S, "it is swung round in a bend");
    // The ride is more than two rounds, and passes each point of the circuit.
    let end = &frames[frames.len() - 1];
    assert!(end.record.road > 2.0 * 150.0, "{} m", end.record.road);
    for point in &circuit {
        let nearest = frames.iter().map(|frame| frame.vehicle.state().position.distance(*point));
        assert!(nearest.fold(f64::INFINITY, f64::min) < 1.0 + ON_THE_ROUTE_M);
    }
}

#[test]
fn speed_rises_gently_from_rest_to_the_cruise() {
    let frames = ride(30);
    let mut before = 0.0;
    for frame in &frames {
        let celerity = frame.record.celerity.iter().map(|u| u * u).sum::<f64>().sqrt();
        // The largest gain is 3 m/s² over a sixtieth of a second.
        assert!(celerity - before < 3.0 / 60.0 / LightSpeed::OLD_TOWN.speed_of_light_m_s(), "{before} to {celerity}");
        before = celerity;
    }
    let at = |second: usize| LightSpeed::OLD_TOWN.metres_per_own_second(frames[60 * second].record.rapidity.sinh());
    assert!(at(1) < 1.5 && at(4) > 1.0, "{} {}", at(1), at(4));
    let fastest = (0..30).map(at).fold(0.0, f64::max);
    assert!((0.9 * Tour::CRUISE_M_S..1.05 * Tour::CRUISE_M_S).contains(&fastest), "{fastest}");
}

#[test]
fn the_sensors_lines_are_all_understood() {
    let circuit = circuit();
    let setup = setup(&circuit);
    let mut tour = Tour::new(&circuit, &BicycleConfig::default()).unwrap();
    let mut simulation = Simulation::new(setup, Arc::new(OpenPlane)).unwrap();
    let mut lines = 0;
    for n in 0..600 {
        let samples = tour.samples(simulation.vehicle(), n * SECOND / 60);
        lines += samples.len();
        simulation.frame(n * SECOND / 60, &samples);
    }
    assert_eq!(lines, 1 + 999, "a hundred a second");
    assert_eq!(simulation.desk().faults(input::SampleSource::Bicycle).number(), 0);
}

/// The museum's bicycle stands still while the attract ride is shown, but the lines pass through its calibration.
#[test]
fn the_tour_keeps_to_the_circuit_on_a_bicycle_of_any_calibration() {
    let strange = BicycleConfig {
        steer_straight: 2900.0,
        steer_rad_per_unit: -0.001_543,
        steer_dead_rad: 0.02,
        brake_released: 4000.0,
        brake_full: 1200.0,
        brake_curve: 2.0,
        pulses_per_wheel_turn: 3.0,
        ..BicycleConfig::default()
    };
    let cadence = BicycleConfig {
        speed_from: SpeedSource::Cadence,
        metres_per_crank_turn: 4.0,
        pulses_per_crank_turn: 4.0,
        ..strange.clone()
    };
    let circuit = circuit();
    let usual = ride(60).last().unwrap().vehicle.odometer().road_m;
    for bicycle in [strange, cadence] {
        let frames = ride_on(&bicycle, 60);
        let farthest =
            frames.iter().map(|frame| distance_to(&circuit, frame.vehicle.state().position)).fold(0.0, f64::max);
        let road_m = frames.last().unwrap().vehicle.odometer().road_m;
        assert!(farthest < 1.5, "{farthest} m off");
        assert!((road_m / usual - 1.0).abs() < 0.05, "{road_m} m for {usual} m");
    }
}

#[test]
fn a_tour_repeats_to_the_bit() {
    let (a, b) = (ride(20), ride(20));
    assert!(a.iter().zip(&b).all(|(a, b)| a.record.first_difference(&b.record).is_none()));
}

#[test]
fn a_circuit_without_three_finite_corners_is_refused() {
    assert!(Tour::new(&[], &BicycleConfig::default()).is_none());
    assert!(Tour::new(&circuit()[..2], &BicycleConfig::default()).is_none());
    assert!(Tour::new(&[DVec3::X, DVec3::Y, DVec3::INFINITY], &BicycleConfig::default()).is_none());
}
