//! Law: whoever walks through the calibration of a strange bicycle gets a file with which it steers and brakes right;
//! a walk that breaks off writes nothing and says why. A crank alone rides as fast as its set-up says.

use crate::runner::{rapidity, said, told};
use serialport::{SerialPort, TTYPort};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::Stdio;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// State of a bicycle as its box sees it.
#[derive(Clone, Copy)]
struct BoxState {
    steer: u32,
    brake: u32,
    wheel: u32,
    crank: u32,
}

/// Change of the box's state in a step of the walk.
type Change = fn(&mut BoxState);

/// Bicycle at a pseudo-terminal whose box sends fifty lines a second, until it is dropped.
struct PtyBicycle {
    name: String,
    state: Arc<Mutex<Option<BoxState>>>,
    _computer_side: TTYPort,
    sender: Option<std::thread::JoinHandle<()>>,
}

impl PtyBicycle {
    /// Bicycle whose box sends `line` of its state and its time, seconds.
    fn new(state: BoxState, line: impl Fn(BoxState, f64) -> String + Send + 'static) -> Self {
        let (mut box_side, computer_side) = TTYPort::pair().unwrap();
        let state = Arc::new(Mutex::new(Some(state)));
        let shared = state.clone();
        let sender = std::thread::spawn(move || {
            let began = Instant::now();
            // `None` ends the box.
            while let Some(now) = *shared.lock().unwrap() {
                let _ = box_side.write_all(line(now, began.elapsed().as_secs_f64()).as_bytes());
                std::thread::sleep(Duration::from_millis(20));
            }
        });
        Self { name: computer_side.name().unwrap(), state, _computer_side: computer_side, sender: Some(sender) }
    }

    fn set(&self, change: impl FnOnce(&mut BoxState)) {
        change(self.state.lock().unwrap().as_mut().unwrap());
    }
}

impl Drop for PtyBicycle {
    fn drop(&mut self) {
        *self.state.lock().unwrap() = None;
        self.sender.take().into_iter().for_each(|sender| sender.join().unwrap());
    }
}

fn pulses(state: BoxState, _: f64) -> String {
    let BoxState { steer, brake, wheel, crank } = state;
    input::line::sealed(&format!("B1,0,0,{wheel},0,{crank},0,{steer},{brake}"))
}

/// Lines of `devices` while it listens for two seconds.
fn listing(folder: &Path, file: &str) -> String {
    let output = rapidity(folder, &["devices", "--set-up", file, "--seconds", "2"]).output().unwrap();
    assert!(output.status.success(), "{}", told(&output));
    said(&output)
}

#[test]
fn a_strange_bicycle_steers_right_after_the_walk() {
    let folder = tempfile::tempdir().unwrap();
    let straight = BoxState { steer: 2900, brake: 4000, wheel: 10, crank: 5 };
    let bicycle = PtyBicycle::new(straight, pulses);
    // What others wrote into the file stays.
    std::fs::write(folder.path().join("mine.toml"), "# Hall 3\n[rider]\ncruise_m_s = 4.0\n").unwrap();
    let arguments = ["devices", "--calibrate", "mine.toml", "--bicycle", &bicycle.name];
    let mut walk = rapidity(folder.path(), &arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut answers = walk.stdin.take().unwrap();
    let mut lines = BufReader::new(walk.stdout.take().unwrap()).lines();
    let steps: [(&str, Change, &str); 7] = [
        ("1. ", |_| {}, ""),
        ("2. ", |state| state.steer = 2900 - 508, ""), // 45° to the left, 11.3 units a degree
        ("3. ", |state| state.steer = 2900 + 339, "30"),
        ("4. ", |state| (state.steer, state.brake) = (2900, 1200), ""),
        ("5. ", |state| (state.brake, state.wheel) = (4000, 12), ""),
        ("6. ", |state| state.crank = 6, ""),
        ("How many metres is one turn of the wheel", |_| {}, "2.05"),
    ];
    for (question, change, answer) in steps {
        assert!(lines.any(|line| line.unwrap().starts_with(question)), "{question}");
        bicycle.set(change);
        // A line of the box that was under way is read before the answer.
        std::thread::sleep(Duration::from_millis(150));
        writeln!(answers, "{answer}").unwrap();
    }
    let rest: Vec<String> = lines.map(Result::unwrap).collect();
    assert!(rest.concat().contains("Written: mine.toml"), "{rest:?}");
    assert!(walk.wait().unwrap().success());
    let file = std::fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    for kept in ["# Hall 3", "cruise_m_s = 4.0", "pulses_per_wheel_turn = 2.0", "wheel_circumference_m = 2.05"] {
        assert!(file.contains(kept), "{kept}: {file}");
    }

    for degrees in [25.0, -20.0] {
        bicycle.set(|state| (state.steer, state.brake) = ((2900.0 - 11.3 * degrees) as u32, 2600));
        let text = listing(folder.path(), "mine.toml");
        let after = text.split("handlebar ").nth(1).and_then(|rest| rest.split('°').next()).unwrap();
        let steered: f64 = after.parse().unwrap();
        assert!((steered - degrees).abs() < 0.5, "{text}");
        assert!(text.contains("brake 0.50"), "{text}");
    }
}

#[test]
fn a_crank_alone_rides_by_its_set_up() {
    let folder = tempfile::tempdir().unwrap();
    let rest = BoxState { steer: 512, brake: 0, wheel: 0, crank: 0 };
    // One turn of the crank a second, on the box's clock.
    let bicycle = PtyBicycle::new(rest, |_, at_s| {
        let turns = at_s.floor() as u32;
        let now_us = (at_s * 1e6) as u32;
        input::line::sealed(&format!("B1,0,{now_us},0,0,{turns},{},512,0", turns * 1_000_000))
    });
    let text = format!("[bicycle]\nport = {:?}\nspeed_from = \"cadence\"\nmetres_per_crank_turn = 5.5\n", bicycle.name);
    std::fs::write(folder.path().join("crank.toml"), text).unwrap();
    let output = rapidity(folder.path(), &["devices", "--set-up", "crank.toml", "--seconds", "5"]).output().unwrap();
    assert!(said(&output).contains("wheel 5.50 m/s"), "{}", said(&output));
}

#[test]
fn a_walk_that_breaks_off_writes_nothing_and_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let output = rapidity(folder.path(), arguments).stdin(Stdio::null()).output().unwrap();
        assert!(!output.status.success());
        assert!(!folder.path().join("mine.toml").exists());
        told(&output)
    };
    let straight = BoxState { steer: 2900, brake: 4000, wheel: 10, crank: 5 };
    let bicycle = PtyBicycle::new(straight, pulses);
    let numbers = PtyBicycle::new(straight, |_, _| "23.4\n".to_owned());
    std::fs::write(folder.path().join("bad.toml"), "[bicycle\n").unwrap();
    for (file, port, expected) in [
        ("mine.toml", None, "which bicycle? Name its port with --bicycle"),
        ("mine.toml", Some(bicycle.name.as_str()), "ended before its last step; nothing was written"),
        ("mine.toml", Some(numbers.name.as_str()), "each line is one number"),
        ("none/mine.toml", Some(bicycle.name.as_str()), "there is no folder none"),
        ("bad.toml", Some(bicycle.name.as_str()), "bad.toml, line 1"),
    ] {
        let port = port.map_or_else(Vec::new, |port| vec!["--bicycle", port]);
        let text = run(&[&["devices", "--calibrate", file][..], &port].concat());
        assert!(text.contains(expected), "{file}: {text}");
    }
}
