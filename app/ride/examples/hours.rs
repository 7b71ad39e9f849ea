//! Hours of a ride with every device at its highest rate, faster than the clock: memory stays flat, and the ride can
//! be recorded from its beginning at the end, and replays to the bit.
//!
//!     cargo run --release -p ride --example hours -- [HOURS]
//!
//! Devices: a bicycle of 200 lines a second, a SpaceMouse and a gamepad of 1000 reports each, DTrack of 240 frames
//! with four bodies, and keys. Frames: 60 a second. It ends with status 1 where memory grows after a quarter of
//! an hour by more than 4 MB an hour (the places of the chunks on the disk are kept), or where the recording differs.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example prints its figures, and ends at a failure")]

use input::gamepad::GamepadItem;
use input::gamepad_codes as codes;
use input::{DeskConfig, HeadConfig, KeyboardKey, Nanos, SECOND, Sample, SampleSource, VehicleKind};
use ride::{LightSpeed, Replay, RideLog, RideStart, Setup, Simulation, VehicleSettings};
use scene::OpenPlane;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Largest factor by which the ride is faster than the clock.
const FASTER: u64 = 20;
/// Growth of memory that is borne, megabytes an hour.
const GROWTH_MB: f64 = 4.0;
/// Time between two prints, seconds of the ride.
const PRINT_S: u64 = 900;

/// Samples of all devices in the millisecond number `ms`.
fn samples(ms: u64, samples: &mut Vec<Sample>) {
    let at = ms * (SECOND / 1000);
    let seconds = ms as f64 / 1000.0;
    if ms.is_multiple_of(5) {
        // 2.86 turns a second, as at 6 m/s.
        let turns = (seconds * 6.0 / 2.1).floor();
        let last_us = (turns * 2.1 / 6.0 * 1e6) as u64;
        let steer = 512.0 + 80.0 * libm::sin(0.3 * seconds);
        let line = format!("B1,{},{},{turns},{},0,0,{steer:.0},0", ms / 5, ms * 1000 % (1 << 32), last_us % (1 << 32));
        samples.push(Sample::bytes(at, SampleSource::Bicycle, input::line::sealed(&line).into_bytes()));
    }
    let push = (100.0 * libm::sin(seconds)) as i16;
    let report = [&[1][..], &push.to_le_bytes(), &[0; 10]].concat();
    samples.push(Sample::bytes(at, SampleSource::SpaceMouse, report));
    let mut bytes = Vec::new();
    if ms == 0 {
        GamepadItem::Gamepad.encode(&mut bytes);
        GamepadItem::Axis { code: 0, value: 0, least: -32768, most: 32767 }.encode(&mut bytes);
    }
    GamepadItem::Event { kind: codes::ABSOLUTE, code: 0, value: i32::from(push) }.encode(&mut bytes);
    samples.push(Sample::bytes(at, SampleSource::Gamepad, bytes));
    if ms * 240 / 1000 != (ms + 1) * 240 / 1000 {
        let x = 300.0 * libm::sin(0.6 * seconds);
        let body =
            |number: u32| format!(" [{number} 1.000][{x:.3} 1700.000 {}.000 0 0 0][1 0 0 0 1 0 0 0 1]", 100 * number);
        let bodies: String = (0..4).map(body).collect();
        let frame = format!("fr {}\r\nts {seconds:.6}\r\n6d 4{bodies}\r\n", ms * 240 / 1000 + 1);
        samples.push(Sample::bytes(at, SampleSource::Dtrack, frame.into_bytes()));
    }
    if ms.is_multiple_of(500) {
        samples.push(Sample::key(at, KeyboardKey::J, ms.is_multiple_of(1000)));
    }
}

/// Resident memory of this program, megabytes; 0 where the system does not say.
fn resident_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok()).unwrap_or(0.0) / 1000.0
}

fn main() -> ExitCode {
    let hours: f64 = std::env::args().nth(1).map_or(3.0, |text| text.parse().unwrap());
    let folder = std::env::temp_dir().join(format!("rapidity-hours-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let head = HeadConfig::new("dtrack://".parse().unwrap());
    let setup = Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind: VehicleKind::Bicycle,
        start: RideStart::at_rest(glam::DVec3::ZERO, glam::DVec3::NEG_Z, glam::DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig { head: Some(head), ..DeskConfig::default() },
    };
    let mut log = RideLog::new(setup.header("0 (hours)", "plane")).keep_past_in(folder.join("past"));
    let mut ride = Simulation::new(setup, Arc::new(OpenPlane)).unwrap();
    let began = Instant::now();
    let (mut settled_mb, mut most_mb) = (0.0_f64, 0.0_f64);
    let (mut ms, mut count) = (0, 0_u64);
    let frames = (hours * 3600.0 * 60.0) as u64;
    let mut due = Vec::new();
    println!("| ridden, min | samples, millions | memory, MB | past on disk, MB |\n|---|---|---|---|");
    for frame in 0..=frames {
        let at: Nanos = frame * SECOND / 60;
        due.clear();
        while ms * (SECOND / 1000) <= at {
            samples(ms, &mut due);
            ms += 1;
        }
        count += due.len() as u64;
        let ridden = ride.frame(at, &due);
        log.frame(&due, &ridden).unwrap();
        // The disk is given its time: live, a frame takes seventeen milliseconds.
        let earliest = Duration::from_nanos(at / FASTER);
        std::thread::sleep(earliest.saturating_sub(began.elapsed()));
        if frame > 0 && frame % (60 * PRINT_S) == 0 {
            let memory = resident_mb();
            let disk: u64 = std::fs::read_dir(folder.join("past"))
                .into_iter()
                .flatten()
                .filter_map(|file| Some(file.ok()?.metadata().ok()?.len()))
                .sum();
            println!("| {} | {:.1} | {memory:.0} | {:.0} |", frame / 3600, count as f64 / 1e6, disk as f64 / 1e6);
            if frame == 60 * PRINT_S { settled_mb = memory } else { most_mb = most_mb.max(memory) }
        }
    }
    println!("ridden in {:.0} s", began.elapsed().as_secs_f64());

    let path = folder.join("late.mcap");
    let began = Instant::now();
    log.record(&path).unwrap();
    log.finish().unwrap();
    println!("recorded from the beginning in {:.1} s", began.elapsed().as_secs_f64());
    let recording = input::recording::Recording::open(&path).unwrap();
    let verified = Replay::new(recording, Arc::new(OpenPlane)).unwrap().verify();
    let _ = std::fs::remove_dir_all(&folder);
    match verified {
        Ok(verified) if verified == frames + 1 && most_mb <= settled_mb + GROWTH_MB * hours => {
            println!(
                "{verified} frames, identical to the bit; memory {settled_mb:.0} MB, then at most {most_mb:.0} MB"
            );
            ExitCode::SUCCESS
        }
        outcome => {
            println!("{outcome:?} of {} frames; memory {settled_mb:.0} MB, then {most_mb:.0} MB", frames + 1);
            ExitCode::FAILURE
        }
    }
}
