//! Law: a head that crosses a resting vehicle at celerity u sees what is abeam ahead by asin β, as aberration says,
//! while its velocity counts, and abeam while it does not; the rider chooses in mid-ride. A wrong program would show
//! the same in every mode, or go on in the mode that the ride began with.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::session::tracker::head;
use glam::DVec3;
use input::{Action, DeskConfig, HeadConfig, SECOND, Sample, SampleSource, TrackingMode, VehicleKind};
use physics::worldline::Thrust;
use ride::{LightSpeed, RideStart, Setup, Simulation, VehicleSettings};
use room::{EyeSide, Viewer};
use scene::OpenSpace;
use std::sync::Arc;
use walls::Occupant;

/// Celerity of the head in the vehicle.
const U: f64 = 0.18;
/// Speed of light, m/s.
const C_M_S: f64 = 25.0 / 3.0;
/// Angle by which a source abeam is seen ahead, radians: sin θ = β = u/γ.
const BETA: f64 = 0.177_152_5;

/// Angle of light from straight ahead of the vehicle that the head sees to the side of its motion, radians.
fn seen_rad(simulation: &mut Simulation, at: u64, samples: &[Sample]) -> (f64, Vec<Action>) {
    let frame = simulation.frame(at, samples);
    let head = frame.controls.head.as_ref().map(|state| head(state, C_M_S));
    let viewer = Viewer::default();
    let head = head.unwrap_or_else(|| walls::RoomHead::at_rest(viewer.head_m));
    let occupant = Occupant { vehicle: *frame.vehicle.state(), thrust: Thrust::default(), head };
    let eye = occupant.eye(&viewer, EyeSide::Centre);
    // Of a source in the world's direction −z, far away.
    let aberration = physics::Aberration::new(eye.observer.celerity);
    let (seen, _) = aberration.observer_from_world(DVec3::NEG_Z);
    let in_room = eye.observer_from_room.inverse() * seen;
    (in_room.x.atan2(-in_room.z), frame.controls.actions)
}

#[test]
fn a_crossing_head_sees_what_is_abeam_ahead_while_its_velocity_counts() {
    let head = HeadConfig::new("opentrack://".parse().unwrap());
    let setup = Setup {
        light_speed: LightSpeed::new(C_M_S).unwrap(),
        kind: VehicleKind::Fly,
        start: RideStart::at_rest(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig { head: Some(head), ..Default::default() },
    };
    let mut simulation = Simulation::new(setup, Arc::new(OpenSpace)).unwrap();
    let mut measured = Vec::new();
    let steps = 240;
    for step in 0..=steps {
        let at = (1 + step) * SECOND / 240;
        // A crossing to the right and back again, at 100 % of a steady pace: opentrack counts centimetres to the left.
        let half = 60;
        let (turn, side) = (step / half, step % half);
        let along = if turn % 2 == 0 { side } else { half - side };
        let x_m = U * C_M_S * along as f64 / 240.0;
        let bytes: Vec<u8> =
            [-100.0 * x_m, 0.0, 0.0, 0.0, 0.0, 0.0].iter().flat_map(|n: &f64| n.to_le_bytes()).collect();
        let mut samples = vec![Sample::bytes(at, SampleSource::Opentrack, bytes)];
        match turn {
            1 if side == 0 => samples.push(Sample::action(at, &Action::Tracking(TrackingMode::Position))),
            2 if side == 0 => samples.push(Sample::action(at, &Action::NextTracking)),
            3 if side == 0 => samples.push(Sample::action(at, &Action::NextTracking)),
            _ => {}
        }
        let (angle, _) = seen_rad(&mut simulation, at, &samples);
        // Late in each crossing the filter has settled.
        if side == half - 1 {
            measured.push(angle);
        }
    }
    assert_eq!(simulation.desk().tracking(), Some(TrackingMode::PositionAndVelocity));
    let expected = BETA.asin();
    assert!((expected.to_degrees() - 10.2).abs() < 0.01);
    let [both, place, off, again] = measured[..] else { panic!("{measured:?}") };
    // Aberration moves what is abeam towards the motion: to the right, and on the way back to the left.
    assert!((both - expected).abs() < 0.01, "{} for {}", both.to_degrees(), expected.to_degrees());
    assert!(place.abs() < 1e-12 && off.abs() < 1e-12, "{place} {off}");
    assert!((again + expected).abs() < 0.01, "{}", again.to_degrees());
}
