//! Law: the eye aboard a vehicle is at its place and time in the vehicle's frame.
//!
//! A program that added the eye's offset in the world would miss a factor γ along the motion, and the delay with it.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DQuat, DVec3};
use input::VehicleKind;
use physics::worldline::WorldlineState;
use physics::{Celerity, Event};
use ride::{LightSpeed, Vehicle, VehicleSettings};
use view::Gaze;

/// View from a bicycle at the event (7; 1, 2, 3), whose rider's eye rests at `offset_m` in the pilot's axes.
fn gaze(celerity: DVec3, orientation: DQuat, offset_m: DVec3) -> Gaze {
    let event = Event { ct: 7.0, position: DVec3::new(1.0, 2.0, 3.0) };
    let state = WorldlineState::new(event, Celerity::new(celerity).unwrap(), orientation);
    let settings = VehicleSettings { eye_m: offset_m.to_array(), ..VehicleSettings::default() };
    Vehicle::new(LightSpeed::OLD_TOWN, VehicleKind::Bicycle, state, settings).unwrap().gaze()
}

#[test]
fn an_eye_ahead_is_later_and_farther_by_gamma() {
    let celerity = DVec3::new(0.0, 0.0, -0.75);
    let gaze = gaze(celerity, DQuat::IDENTITY, DVec3::new(0.0, 1.5, -1.0));
    assert_eq!(gaze.observer.event.position, DVec3::new(1.0, 3.5, 3.0 - 1.25));
    assert_eq!(gaze.observer.event.ct, 7.75);
    assert_eq!(gaze.observer.celerity.vector(), celerity);
}

#[test]
fn the_offset_turns_with_the_pilot() {
    let quarter_left = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
    let gaze = gaze(DVec3::ZERO, quarter_left, DVec3::NEG_Z);
    assert!((gaze.observer.event.position - DVec3::new(0.0, 2.0, 3.0)).length() < 1e-15);
    assert_eq!(gaze.observer.event.ct, 7.0);
    assert_eq!(gaze.observer_from_eye, quarter_left);
}
