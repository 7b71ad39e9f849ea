//! Law: a ride on an instrumented bicycle, through a real pseudo-terminal and the real program, replays to the same
//! bits on any number of threads. A program that let a clock, a thread or a lost sample affect the ride would differ.

use crate::runner::{rapidity, run, said, told};
use std::io::{Read, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use serialport::{SerialPort, TTYPort};

/// Metres of road per turn of the wheel, as the decoder assumes.
const CIRCUMFERENCE_M: f64 = 2.1;
/// Rate of the sensor's lines, per second.
const LINES_PER_SECOND: u64 = 60;

/// Line of the pulse protocol, `seconds` after the bicycle was switched on, at a steady speed.
fn line(number: u64, seconds: f64, metres_per_second: f64) -> String {
    let turns = (seconds * metres_per_second / CIRCUMFERENCE_M).floor();
    let pulse_us = (turns * CIRCUMFERENCE_M / metres_per_second * 1e6) as u64;
    let steer = 512 + (number / 30) % 3;
    let body = format!("B1,{number},{},{turns},{pulse_us},0,0,{steer},0", (seconds * 1e6) as u64);
    let checksum = body.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("{body}*{checksum:02X}\r\n")
}

#[test]
fn a_ride_through_a_pseudo_terminal_replays_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let (mut bicycle, port) = TTYPort::pair().expect("the system has pseudo-terminals");
    let name = port.name().unwrap();
    bicycle.set_timeout(Duration::from_millis(5)).unwrap();

    // A thread sends pedalling for as long as the ride takes, with a line of noise now and then.
    let over = Arc::new(AtomicBool::new(false));
    let pedalling = Arc::clone(&over);
    let rider = std::thread::spawn(move || {
        let began = Instant::now();
        let mut answers = Vec::new();
        for number in 0.. {
            if pedalling.load(Ordering::Relaxed) {
                break;
            }
            let text = line(number, began.elapsed().as_secs_f64(), 5.0);
            let noise = if number % 50 == 7 { "B1,garbage*00\r\n" } else { "" };
            let _ = bicycle.write_all(format!("{noise}{text}").as_bytes());
            let mut bytes = [0; 512];
            if let Ok(count) = bicycle.read(&mut bytes) {
                answers.extend_from_slice(&bytes[..count]);
            }
            std::thread::sleep(Duration::from_millis(1000 / LINES_PER_SECOND));
        }
        String::from_utf8_lossy(&answers).into_owned()
    });
    let ridden = run(
        folder.path(),
        &[
            "ride",
            "--scene",
            "lattice",
            "--bicycle",
            &name,
            "--record",
            "r.mcap",
            "--seconds",
            "4",
            "--size",
            "64x36",
            "--samples",
            "1",
            "--out",
            "r.mp4",
        ],
    );
    over.store(true, Ordering::Relaxed);
    let answers = rider.join().unwrap();
    assert!(ridden.status.success(), "{}", told(&ridden));
    assert!(answers.contains("K1,"), "the brake was never told anything: {answers:?}");

    // The recording holds a ride that covers some distance.
    let frames = input::recording::Recording::open(&folder.path().join("r.mcap")).unwrap();
    let road = frames
        .filter_map(|entry| match entry.unwrap() {
            input::recording::RecordingEntry::Frame(frame) => Some(frame.road),
            _ => None,
        })
        .last()
        .unwrap();
    assert!(road > 2.0, "the bicycle went {road} m");

    for threads in ["1", "2"] {
        let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify", "--threads", threads]);
        assert!(verified.status.success(), "{}", told(&verified));
        assert!(said(&verified).contains("identical to the bit"), "{}", said(&verified));
    }
}

#[test]
fn a_changed_recording_is_found_out() {
    let folder = tempfile::tempdir().unwrap();
    let ridden = run(
        folder.path(),
        &[
            "ride",
            "--scene",
            "lattice",
            "--record",
            "r.mcap",
            "--seconds",
            "1",
            "--size",
            "64x36",
            "--samples",
            "1",
            "--out",
            "r.mp4",
        ],
    );
    assert!(ridden.status.success(), "{}", told(&ridden));
    let path = folder.path().join("r.mcap");
    let mut bytes = std::fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, bytes).unwrap();
    let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    assert_eq!(verified.status.code(), Some(1));
    assert!(told(&verified).contains("damaged"), "{}", told(&verified));
}

#[test]
fn what_cannot_be_done_ends_in_one_sentence_and_a_status() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&[&str], i32, &str); 8] = [
        (&["render", "--scene", "nowhere.glb", "--out", "a.png"], 1, "nowhere.glb"),
        (&["render", "--scene", "lattice", "--out", "nowhere/a.png"], 1, "nowhere"),
        (&["render", "--replay", "nowhere.mcap", "--out", "a.png"], 1, "nowhere.mcap"),
        (&["render", "--out", "a.gif"], 2, "--out"),
        (&["render", "--beta", "1,0,0", "--out", "a.png"], 2, "--beta"),
        (&["ride", "--verify"], 2, "--replay"),
        (&["check", "."], 1, "neither"),
        (&["town", "--out", "nowhere/town.glb"], 1, "nowhere"),
    ];
    for (arguments, status, word) in cases {
        let output = run(folder.path(), arguments);
        let told = told(&output) + &said(&output);
        assert_eq!(output.status.code(), Some(status), "{arguments:?}: {told}");
        assert!(told.contains(word), "{arguments:?}: {told}");
        assert!(told.lines().count() <= 2 && !told.contains("panicked"), "{arguments:?}: {told}");
    }
}

#[test]
fn without_a_driver_the_package_to_install_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let output = rapidity(folder.path(), &["render", "--scene", "lattice", "--out", "a.png"])
        .env("VK_DRIVER_FILES", "/nonexistent")
        .env("VK_ICD_FILENAMES", "/nonexistent")
        .output()
        .expect("the program starts");
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("mesa-vulkan-drivers"), "{}", told(&output));
}
