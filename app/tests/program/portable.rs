//! Law: a recording replays to the bit on every processor. The C library computes sin, exp and their kin in other
//! instructions, to other bits, where there is no fused multiplication. A ride that asks it for one of them anywhere on
//! its way differs after some frames.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use crate::runner::{WITHOUT_FMA, rapidity, said, told};
use crate::turning_head::{greeting, pose};
use glam::DVec3;
use input::head::{MouseButton, MouseEvent};
use input::{Action, DeskConfig, HeadConfig, KeyboardKey, SECOND, Sample, SampleSource, VehicleKind};
use ride::{LightSpeed, RideLog, RideStart, Setup, Simulation, VehicleSettings};
use scene::collision::Collision;

/// Number of frames of a ride. The C library's functions differ for one argument in a thousand, so a minute of ticks
/// meets some in each function.
const FRAMES: u64 = 3600;

/// Number of frames after which the keys are pressed again.
const CYCLE: u64 = 360;

/// Tracker of a head that the mouse moves.
const MOUSE: &str = "mouse";

/// Samples of a ride by keys, with a handlebar and a head that never rest.
fn samples() -> Vec<Sample> {
    let mut samples = vec![Sample::mouse(0, MouseEvent::Button { button: MouseButton::Left, pressed: true })];
    for cycle in 0..FRAMES / CYCLE {
        let tenth = |n: u64| (CYCLE * cycle / 6 + n) * SECOND / 10;
        samples.extend([
            Sample::key(tenth(1), KeyboardKey::W, true),
            Sample::key(tenth(9), KeyboardKey::A, true),
            Sample::key(tenth(20), KeyboardKey::A, false),
            Sample::key(tenth(21), KeyboardKey::D, true),
            Sample::key(tenth(24), KeyboardKey::R, true),
            Sample::key(tenth(29), KeyboardKey::Q, true),
            Sample::key(tenth(33), KeyboardKey::D, false),
            Sample::action(tenth(35), &Action::TimeScale(0.7)),
            Sample::key(tenth(40), KeyboardKey::R, false),
            Sample::action(tenth(50), &Action::SpeedOfLight(8.0 - 0.5 * cycle as f64)),
            Sample::key(tenth(52), KeyboardKey::Q, false),
            Sample::key(tenth(55), KeyboardKey::W, false),
        ]);
    }
    for n in 0..FRAMES {
        let at = n * SECOND / 60;
        let turn = (n % 37) as f32 - 17.0;
        samples.push(Sample::mouse(at, MouseEvent::Moved { right: turn, down: 0.3 * turn }));
        if n % 50 == 20 {
            samples.push(Sample::mouse(at, MouseEvent::Button { button: MouseButton::Right, pressed: n % 100 == 20 }));
        }
    }
    samples.sort_by_key(|sample| sample.at);
    samples
}

/// Bytes of a tracker up to this frame: a head that sways and turns.
fn tracked(n: u64) -> Vec<u8> {
    let newest = pose(Duration::from_nanos(n * SECOND / 60));
    if n == 0 { [greeting(), newest].concat() } else { newest }
}

/// Records a ride in the lattice, on this processor as it is. `tracker`: address of the head's tracker.
fn record(path: &Path, kind: VehicleKind, bicycle: bool, tracker: &str) {
    let head = HeadConfig::new(tracker.parse().unwrap());
    let setup = Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind,
        start: RideStart::at_rest(DVec3::new(3.0, 0.0, -2.0), DVec3::new(1.0, 0.0, -1.3), DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig { head: Some(head), ..DeskConfig::default() },
    };
    let lattice = Collision::new(&built_in::lattice::Lattice::default().build()).unwrap();
    let start = setup.start.state().unwrap();
    let mut log = RideLog::new(setup.header("0.1.0 (test)", "lattice"));
    log.record(path).unwrap();
    let mut simulation = Simulation::new(setup, Arc::new(lattice)).unwrap();
    let mut waiting = samples().into_iter().peekable();
    let mut turned_by = 0.0_f64;
    for n in 0..FRAMES {
        let at = n * SECOND / 60 + n * 7919 % 2_000_000;
        let mut due = Vec::new();
        while let Some(sample) = waiting.next_if(|sample| sample.at <= at) {
            due.push(sample);
        }
        if bicycle {
            // A turn of the wheel every eight lines, and a handlebar that never rests.
            let line = format!("B1,{n},{},{},{},0,0,{},0", n * 16_667, n / 8, n / 8 * 8 * 16_667, 480 + n % 61);
            let sum = line.bytes().fold(0, |sum, byte| sum ^ byte);
            due.push(Sample::bytes(at, SampleSource::Bicycle, format!("{line}*{sum:02X}\r\n").into_bytes()));
        }
        if tracker != MOUSE {
            due.push(Sample::bytes(at, SampleSource::Vrpn, tracked(n)));
        }
        let frame = simulation.frame(at, &due);
        turned_by = turned_by.max(frame.controls.head.as_ref().map_or(0.0, |head| head.turn_rad_s.length()));
        log.frame(&due, &frame).unwrap();
    }
    // A mouse turns the head in leaps, which are no motion.
    assert!(turned_by > 1.0 || tracker == MOUSE, "a head that turns, by {turned_by} rad/s at most");
    let end = simulation.vehicle().state();
    let turned = end.orientation.angle_between(start.orientation);
    assert!(end.celerity.magnitude() > 0.1 && turned > 0.1, "a ride that turns, by {turned} rad: {end:?}");
    log.finish().unwrap();
}

#[test]
fn a_steered_ride_with_a_head_that_turns_has_the_same_bits_without_fused_multiplication() {
    let folder = tempfile::tempdir().unwrap();
    for (name, kind, bicycle, tracker) in [
        ("keys.mcap", VehicleKind::Bicycle, false, MOUSE),
        ("bicycle.mcap", VehicleKind::Bicycle, true, MOUSE),
        ("drive.mcap", VehicleKind::Drive, false, MOUSE),
        ("fly.mcap", VehicleKind::Fly, false, MOUSE),
        ("tracked.mcap", VehicleKind::Bicycle, true, "vrpn://localhost/Head"),
    ] {
        record(&folder.path().join(name), kind, bicycle, tracker);
        for plain in [true, false] {
            let mut command = rapidity(folder.path(), &["ride", "--replay", name, "--verify"]);
            if !plain {
                command.env(WITHOUT_FMA.0, WITHOUT_FMA.1);
            }
            let verified = command.output().unwrap();
            let text = said(&verified);
            assert!(
                text.contains(&format!("{FRAMES} frames, identical to the bit")),
                "{name}: {text}{}",
                told(&verified)
            );
        }
    }
}
