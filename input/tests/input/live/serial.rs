//! Tests with the bicycle on a real pseudo-terminal.
//!
//! Lines written into the terminal must arrive as speed, steering and brake; garbage and a pulled plug must pass
//! without harm; brake commands must come back whole. A wrong program would hang, ride on without a bicycle, or not
//! find it again.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::frames::Loop;
use input::devices::DeviceState;
use input::{BrakeCommand, DevicesConfig, SECOND, SampleSource};
use serialport::{SerialPort, TTYPort};

/// Terminal under a name that stays when the terminal changes, as a device's name does.
struct Plug {
    name: PathBuf,
    terminal: Option<(TTYPort, TTYPort)>,
}

impl Plug {
    fn new(directory: &Path) -> Self {
        let mut plug = Self { name: directory.join("ttyACM0"), terminal: None };
        plug.insert();
        plug
    }

    fn insert(&mut self) {
        let (mut box_side, computer_side) = TTYPort::pair().unwrap();
        box_side.set_timeout(Duration::from_millis(20)).unwrap();
        std::os::unix::fs::symlink(computer_side.name().unwrap(), &self.name).unwrap();
        self.terminal = Some((box_side, computer_side));
    }

    fn pull(&mut self) {
        std::fs::remove_file(&self.name).unwrap();
        self.terminal = None;
    }

    fn box_side(&mut self) -> &mut TTYPort {
        &mut self.terminal.as_mut().unwrap().0
    }

    fn say(&mut self, text: &str) {
        self.box_side().write_all(text.as_bytes()).unwrap();
    }

    fn config(&self) -> DevicesConfig {
        let bicycle = Some(self.name.to_str().unwrap().to_owned());
        DevicesConfig { bicycle, space_mouse: false, gamepad: false, ..Default::default() }
    }
}

fn wheel_speed(it: &mut Loop) -> Option<f64> {
    let now = it.clock.now();
    it.desk.controls(now).wheel_speed
}

/// Line of a box whose wheel has turned `count` times, the last time at `last_us`.
fn line(now_us: u32, count: u32, last_us: u32, steer: u32, brake: u32) -> String {
    input::line::sealed(&format!("B1,{count},{now_us},{count},{last_us},0,0,{steer},{brake}"))
}

#[test]
fn a_ride_through_a_terminal() {
    let directory = tempfile::tempdir().unwrap();
    let mut plug = Plug::new(directory.path());
    let mut ride = Loop::start(&plug.config());
    ride.until_open(true);

    // Half a second at ten turns a second (21 m/s), in ragged pieces and with noise in between.
    let start = Instant::now();
    for turn in 0..6_u32 {
        std::thread::sleep((start + Duration::from_millis(100 * u64::from(turn))) - Instant::now());
        let text = line(turn * 100_000, turn, turn * 100_000, 512, 341);
        let (head, tail) = text.split_at(text.len() / 2);
        plug.say(head);
        plug.say(tail);
        plug.say("\u{7f}noise\n");
    }
    ride.until("the last line", |it| it.desk.faults(SampleSource::Bicycle).number() == 6);
    let controls = ride.desk.controls(ride.clock.now());
    // The box's clock gives 21 m/s. The age of the last pulse on this machine's clock caps it; on a busy machine that
    // is a third of a second.
    let speed = controls.wheel_speed.unwrap();
    assert!((6.0..=21.0 + 1e-9).contains(&speed), "{speed}");
    assert_eq!(controls.steer_rad, 0.0);
    assert!((controls.brake - 1.0 / 3.0).abs() < 1e-9);

    // The speed decays in silence, monotonically, to a stop.
    let now = ride.clock.now();
    let speeds: Vec<f64> =
        (0..30).map(|tenth| ride.desk.controls(now + tenth * SECOND / 10).wheel_speed.unwrap()).collect();
    assert!(speeds.is_sorted_by(|a, b| a >= b), "{speeds:?}");
    assert_eq!(speeds[29], 0.0);

    let status = &ride.devices.status()[0];
    assert_eq!((status.state.clone(), status.dropped), (DeviceState::Open, 0));
    assert!(status.samples >= 6 && !status.last.is_empty());
}

#[test]
fn a_pulled_plug_stops_and_may_be_put_back() {
    let directory = tempfile::tempdir().unwrap();
    let mut plug = Plug::new(directory.path());
    let mut ride = Loop::start(&plug.config());
    for speed in ["18", "36"] {
        ride.until_open(true);
        plug.say(&format!("{speed}\n"));
        let expected = speed.parse::<f64>().unwrap() / 3.6;
        ride.until("the speed", |it| wheel_speed(it).is_some_and(|speed| speed > 0.9 * expected));
        plug.say("half a li");
        plug.pull();
        ride.until_open(false);
        ride.until("nobody to ride", |it| wheel_speed(it).is_none());
        plug.insert();
    }
    ride.until_open(true);
    assert_eq!(ride.desk.faults(SampleSource::Bicycle).number(), 0);
}

#[test]
fn brake_commands_come_back_whole_newest_first_not_too_often_and_let_go_at_the_end() {
    let directory = tempfile::tempdir().unwrap();
    let mut plug = Plug::new(directory.path());
    let mut ride = Loop::start(&plug.config());
    ride.until_open(true);
    // Two hundred frames in a fifth of a second, more commands than a box can take. The box sends all the while, so
    // that no read waits.
    let start = Instant::now();
    for frame in 0..200_u32 {
        ride.devices.brake(f64::from(frame) / 199.0);
        plug.say("0\n");
        std::thread::sleep(Duration::from_millis(1));
    }
    let elapsed = start.elapsed();

    // A pause long enough for the last command to be sent.
    std::thread::sleep(Duration::from_millis(200));
    drop(ride);

    let mut heard = Vec::new();
    let mut buffer = [0; 256];
    while let Ok(length) = plug.box_side().read(&mut buffer) {
        heard.extend_from_slice(&buffer[..length]);
    }
    let text = String::from_utf8(heard).unwrap();
    let commands: Vec<BrakeCommand> = text.lines().map(|line| BrakeCommand::parse(line).unwrap()).collect();
    for (sequence, command) in (0..).zip(&commands) {
        assert_eq!(command.sequence, sequence);
    }
    let (released, commands) = commands.split_last().unwrap();
    assert_eq!(released.brake, 0.0, "the brake must be let go at the end");
    let most = elapsed.as_millis() / 20 + 2;
    assert!((2..=most).contains(&(commands.len() as u128)), "{} of {most}", commands.len());
    assert!(commands.is_sorted_by(|a, b| a.brake < b.brake));
    assert_eq!(commands.last().unwrap().brake, 1.0);
}

#[test]
fn a_flood_does_not_stop_the_ride() {
    let directory = tempfile::tempdir().unwrap();
    let mut plug = Plug::new(directory.path());
    let mut ride = Loop::start(&plug.config());
    ride.until_open(true);
    // A megabyte of noise that is not drained meanwhile, then a good line.
    let noise = [b'#'; 4096];
    for _ in 0..256 {
        let mut rest = &noise[..];
        while !rest.is_empty() {
            // The terminal may be full for a moment.
            rest = &rest[plug.box_side().write(rest).unwrap_or(0)..];
        }
    }
    plug.say("\n36\n36\n36\n");
    ride.until("the good line", |it| wheel_speed(it).is_some_and(|speed| speed > 9.0));
    assert!(ride.desk.faults(SampleSource::Bicycle).number() > 0);
}

#[test]
fn what_is_missing_is_said_in_a_sentence() {
    let directory = tempfile::tempdir().unwrap();
    let ordinary_file = directory.path().join("file");
    std::fs::write(&ordinary_file, "36\n").unwrap();
    for (path, expected) in [
        (directory.path().join("nowhere"), "plug the bicycle in"),
        (ordinary_file, "cannot be opened as a serial port"),
        (directory.path().to_owned(), "cannot be opened as a serial port"),
    ] {
        let bicycle = Some(path.to_str().unwrap().to_owned());
        let mut ride =
            Loop::start(&DevicesConfig { bicycle, space_mouse: false, gamepad: false, ..Default::default() });
        ride.until(expected, |it| match &it.devices.status()[0].state {
            DeviceState::Absent(why) => why.to_string().contains(expected),
            DeviceState::Open => false,
        });
    }
}
