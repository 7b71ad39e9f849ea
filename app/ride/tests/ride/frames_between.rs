//! Law: what a film shows between two frames of a ride is what a faster ride would have shown, and asking for it
//! changes no bit of the ride. Head and look go on evenly between the reports of their devices.
//!
//! A program that shows the newest recorded frame stands still in three pictures of four. One that simulates the ride
//! at the pictures' times, instead of showing it there on a copy, rides another ride.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::path::Path;
use std::sync::Arc;

use built_in::lattice::Lattice;
use glam::{DQuat, DVec3};
use input::recording::{Recording, RecordingEntry};
use input::{Action, DeskConfig, HeadConfig, MouseButton, MouseEvent, Nanos, SECOND, Sample, VehicleKind};
use physics::{Celerity, compose};
use ride::{FrameTaker, Replay, RideFrame, Setup, Simulation};
use scene::OpenPlane;
use scene::collision::Collision;

use super::simulation::{busy_ride, entries, frames, looking_ride, setup, simulation};

/// Taker of frames at an even rate.
struct Film {
    rate: u64,
    frames: Vec<RideFrame>,
    wanted: u64,
}

impl Film {
    fn new(rate: u64) -> Self {
        Self { rate, frames: Vec::new(), wanted: 0 }
    }
}

impl FrameTaker for Film {
    fn wanted(&mut self, at: Nanos) -> Vec<Nanos> {
        let times: Vec<Nanos> =
            (self.wanted..).map(|n| n * SECOND / self.rate).take_while(|time| *time <= at).collect();
        self.wanted += times.len() as u64;
        times
    }

    fn take(&mut self, frame: RideFrame) {
        self.frames.push(frame);
    }
}

#[test]
fn asking_for_frames_between_changes_no_bit() {
    for kind in [VehicleKind::Bicycle, VehicleKind::Drive, VehicleKind::Fly] {
        let (setup, samples) = (setup(kind), looking_ride());
        let of = |setup: &Setup| {
            Replay::of(entries(setup, &samples).into_iter().map(Ok), setup.clone(), Arc::new(OpenPlane)).unwrap()
        };
        let (mut plain, mut asked, mut film) = (of(&setup), of(&setup), Film::new(997));
        while let Some(before) = plain.next_frame().unwrap() {
            let after = asked.next_frame_for(Some(&mut film)).unwrap().unwrap();
            assert_eq!((before.difference, after.difference), (None, None), "{kind:?}");
            let (before, after) = (before.frame, after.frame);
            assert_eq!(before.record.first_difference(&after.record), None, "{kind:?}");
            assert_eq!((before.controls, before.gaze), (after.controls, after.gaze));
        }
        assert_eq!(asked.simulation().vehicle().state(), plain.simulation().vehicle().state());
        assert!(film.frames.len() > 8900, "{} frames", film.frames.len());
    }
}

#[test]
fn old_recordings_keep_their_bits_while_they_are_filmed() {
    let lattice = Arc::new(Collision::new(&Lattice::default().build()).unwrap());
    for name in ["bicycle", "fly", "head"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/recordings/{name}.mcap"));
        let mut replay = Replay::new(Recording::open(&path).unwrap(), lattice.clone()).unwrap();
        let (mut film, mut frames) = (Film::new(500), 0);
        while let Some(replayed) = replay.next_frame_for(Some(&mut film)).unwrap() {
            assert_eq!(replayed.difference, None, "{name}");
            frames += 1;
        }
        assert!(frames == 240 && film.frames.len() > 1500, "{name}: {frames}, {}", film.frames.len());
    }
}

#[test]
fn a_slow_ride_filmed_fast_is_the_fast_ride() {
    for (kind, slow) in [(VehicleKind::Bicycle, 30), (VehicleKind::Drive, 24), (VehicleKind::Fly, 7)] {
        let fast = frames(&mut simulation(kind), &busy_ride(), (0..=9 * 120).map(|n| n * SECOND / 120));
        let (mut ride, mut film) = (simulation(kind), Film::new(120));
        let mut before = None;
        for at in (0..=9 * slow).map(|n| n * SECOND / slow) {
            let due = busy_ride().into_iter().filter(|sample| before < Some(sample.at) && sample.at <= at);
            let due: Vec<Sample> = due.collect();
            ride.frame_for(at, &due, Some(&mut film));
            before = Some(at);
        }
        assert_eq!(film.frames.len(), fast.len());
        for (number, (shown, of_fast)) in film.frames.iter().zip(&fast).enumerate() {
            assert_eq!((shown.gaze, shown.record.at), (of_fast.gaze, of_fast.record.at), "{kind:?} {number}");
            assert_eq!((shown.paused, shown.time_scale), (of_fast.paused, of_fast.time_scale), "{kind:?} {number}");
            assert_eq!(shown.vehicle.state(), of_fast.vehicle.state(), "{kind:?} {number}");
        }
        let moves = film.frames.windows(2).filter(|two| two[0].gaze.observer != two[1].gaze.observer).count();
        assert!(moves > 900, "{kind:?}: {moves} pictures differ from the one before");
    }
}

#[test]
fn actions_are_told_once_to_whoever_counts_them() {
    // Those of the frames between are all since the last frame of the ride.
    let (mut ride, mut film) = (simulation(VehicleKind::Bicycle), Film::new(100));
    let action = |at| Sample::action(at, &Action::TimeScale(0.5));
    let samples = [action(SECOND / 10), action(SECOND / 5)];
    let frame = ride.frame_for(SECOND / 4, &samples, Some(&mut film));
    let counts: Vec<usize> = film.frames.iter().map(|frame| frame.controls.actions.len()).collect();
    let expected: Vec<usize> = (0..=25).map(|n| usize::from(n >= 10) + usize::from(n >= 20)).collect();
    assert_eq!((counts, frame.controls.actions.len()), (expected, 2));
}

#[test]
fn a_look_turns_evenly_between_ticks() {
    let (mut ride, mut film) = (simulation(VehicleKind::Fly), Film::new(1000));
    for n in 0..=36 {
        let at = n * SECOND / 30;
        let due: Vec<Sample> = looking_ride()
            .into_iter()
            .filter(|sample| sample.at > at - u64::from(n > 0) * SECOND / 30 && sample.at <= at)
            .collect();
        ride.frame_for(at, &due, Some(&mut film));
    }
    // A key turns at 90 degrees a second.
    let turns = film.frames[700..1000]
        .windows(2)
        .map(|two| two[0].gaze.observer_from_eye.angle_between(two[1].gaze.observer_from_eye).to_degrees());
    for turn in turns {
        assert!((turn - 0.09).abs() < 1e-3, "{turn}° in a millisecond");
    }
}

/// Flight with a head that the mouse moves: it is turned, and it walks ahead from the first second on.
fn walking(rate: u64) -> (Vec<RideFrame>, Vec<RideFrame>) {
    let desk = DeskConfig { head: Some(HeadConfig::new("mouse".parse().unwrap())), ..DeskConfig::default() };
    let mut ride = Simulation::new(Setup { desk, ..setup(VehicleKind::Fly) }, Arc::new(OpenPlane)).unwrap();
    let button = MouseEvent::Button { button: MouseButton::Left, pressed: true };
    let samples = [
        Sample::action(0, &Action::Thrust([0.0, 0.0, -1.0])),
        Sample::mouse(SECOND / 5, button),
        Sample::mouse(SECOND / 4, MouseEvent::Moved { right: -200.0, down: 40.0 }),
        Sample::mouse(SECOND, MouseEvent::Wheel(30.0)),
    ];
    let mut film = Film::new(rate);
    let mut ridden = Vec::new();
    for n in 0..=40 {
        let at = n * SECOND / 20;
        let due = samples.iter().filter(|sample| sample.at <= at && (n == 0 || sample.at > (n - 1) * SECOND / 20));
        let due: Vec<Sample> = due.cloned().collect();
        ridden.push(ride.frame_for(at, &due, Some(&mut film)));
    }
    (ridden, film.frames)
}

#[test]
fn a_film_sees_with_the_tracked_head() {
    let (ridden, film) = walking(480);
    let c = ridden[0].vehicle.light_speed().speed_of_light_m_s();
    let mut fastest: f64 = 0.0;
    // Before the first tick nothing is known of a head.
    for frame in ridden[1..].iter().chain(&film[3..]) {
        let (head, seen) = (frame.controls.head.unwrap(), frame.head_gaze());
        let (state, u) = (frame.vehicle.state(), Celerity::new(head.velocity_m_s / c).unwrap());
        fastest = fastest.max(u.magnitude());
        // The head's event is simultaneous with the vehicle's; its motion is composed with the vehicle's, and its axes
        // hold Wigner's rotation.
        let place = state.observer_at(head.position_m).event;
        assert!(seen.observer.event.position.distance(place.position) < 1e-9);
        let aboard = Celerity::new(state.orientation * u.vector()).unwrap();
        let composed = compose(state.celerity, aboard);
        assert!(seen.observer.celerity.vector().distance(composed.celerity.vector()) < 1e-12);
        let expected = composed.wigner.inverse() * state.orientation * head.orientation;
        assert!(seen.observer_from_eye.dot(expected).abs() > 1.0 - 1e-12);
    }
    assert!(fastest > 0.1, "the head has to move, or nothing is tested: {fastest}");
    let turned = film[film.len() - 1].controls.head.unwrap().orientation.angle_between(DQuat::IDENTITY);
    assert!(turned > 0.4, "{turned} rad");
    // A head that nobody tracks is the vehicle's own eye.
    let plain = frames(&mut simulation(VehicleKind::Fly), &looking_ride(), [0, SECOND / 2, SECOND]);
    assert!(plain.iter().all(|frame| frame.head_gaze() == frame.gaze));
}

#[test]
fn a_tracked_head_goes_on_evenly_between_ticks() {
    let (_, film) = walking(960);
    let places: Vec<DVec3> = film[5..].iter().map(|frame| frame.controls.head.unwrap().position_m).collect();
    let steps: Vec<f64> = places.windows(2).map(|two| two[1].distance(two[0])).collect();
    // A quarter of a tick each: none stands still, none leaps. It begins to walk after a second.
    for three in steps[980..1500].windows(3) {
        assert!(three[1] > 0.0 && three.iter().all(|step| (step / three[1] - 1.0).abs() < 0.2), "{three:?}");
    }
}

#[test]
fn a_recorded_head_is_filmed_without_leaps() {
    let lattice = Arc::new(Collision::new(&Lattice::default().build()).unwrap());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings/head.mcap");
    let recorded = Recording::open(&path).unwrap().filter_map(|entry| match entry.unwrap() {
        RecordingEntry::Controls(record) => record.controls.head,
        _ => None,
    });
    let recorded: Vec<DVec3> = recorded.map(|head| head.position_m).collect();
    let largest = |places: &[DVec3]| places.windows(2).map(|two| two[0].distance(two[1])).fold(0.0, f64::max);
    let mut replay = Replay::new(Recording::open(&path).unwrap(), lattice).unwrap();
    let mut film = Film::new(960);
    while replay.next_frame_for(Some(&mut film)).unwrap().is_some() {}
    let filmed: Vec<DVec3> = film.frames.iter().filter_map(|frame| Some(frame.controls.head?.position_m)).collect();
    let [of_frames, of_film] = [largest(&recorded), largest(&filmed[100..])];
    assert!(of_frames > 0.0 && of_film < 0.25 * of_frames, "{of_film} m and {of_frames} m");
}
