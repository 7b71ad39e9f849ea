//! Tests with a SpaceMouse through a real socket, served by the test as spacenavd serves it.
//!
//! The push must arrive however the stream is cut, a cap held still must stay pushed, and a daemon that dies must
//! release it. A wrong program would keep the flight going, or lose its place in the stream.

use std::io::Write;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::time::Duration;

use super::frames::Loop;
use input::devices::DeviceState;
use input::{Action, Controls, DevicesConfig, SECOND, SampleSource};

/// Captured events: motion 100 −50 −25 7 −8 −300, rest, press and release of button 0.
const MOTION: [i32; 8] = [0, 100, -50, -25, 7, -8, -300, 0];
const REST: [i32; 8] = [0, 0, 0, 0, 0, 0, 0, 301];
const PRESS: [i32; 8] = [1, 0, 1, 0, 0, 0, 0, 0];
const RELEASE: [i32; 8] = [2, 0, 0, 0, 0, 0, 0, 0];

fn bytes(words: [i32; 8]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_ne_bytes()).collect()
}

fn config(socket: &Path) -> DevicesConfig {
    DevicesConfig { gamepad: false, spacenavd_socket: Some(socket.to_owned()), ..Default::default() }
}

fn controls(it: &mut Loop) -> Controls {
    let now = it.clock.now();
    it.desk.controls(now)
}

/// True if the captured push has arrived: right, down, and the user's −25, which is backward.
fn is_pushed(controls: &Controls) -> bool {
    let [right, up, back] = controls.thrust;
    right > 0.1 && up < -0.05 && back > 0.01 && controls.turn[2] > 0.5
}

fn accept(listener: &UnixListener) -> UnixStream {
    listener.accept().unwrap().0
}

#[test]
fn a_push_arrives_is_held_and_ends() {
    let directory = tempfile::tempdir().unwrap();
    let socket = directory.path().join("spnav.sock");
    let listener = UnixListener::bind(&socket).unwrap();
    let mut flight = Loop::start(&config(&socket));
    let mut daemon = accept(&listener);

    // The stream is cut within a word.
    let motion = bytes(MOTION);
    daemon.write_all(&motion[..10]).unwrap();
    std::thread::sleep(Duration::from_millis(20));
    daemon.write_all(&motion[10..]).unwrap();
    flight.until("the push", |it| is_pushed(&controls(it)));
    // The daemon says nothing while the cap is held still.
    let later = flight.clock.now() + 10 * SECOND;
    assert!(is_pushed(&flight.desk.controls(later)));

    daemon.write_all(&[bytes(PRESS), bytes(RELEASE), bytes(REST)].concat()).unwrap();
    let mut actions = Vec::new();
    flight.until("the rest", |it| {
        let controls = controls(it);
        actions.extend(controls.actions);
        controls.thrust == [0.0; 3] && controls.turn == [0.0; 3]
    });
    assert_eq!(actions, [Action::TogglePause]);
    assert_eq!(flight.devices.status()[0].source, SampleSource::Spacenavd);
}

#[test]
fn a_daemon_that_dies_lets_go_and_may_come_back() {
    let directory = tempfile::tempdir().unwrap();
    let socket = directory.path().join("spnav.sock");
    let mut flight = Loop::start(&config(&socket));
    flight.until("a word about the daemon", |it| match &it.devices.status()[0].state {
        DeviceState::Absent(why) => why.to_string().contains("spacenavd does not run"),
        DeviceState::Open => false,
    });
    for _ in 0..2 {
        let listener = UnixListener::bind(&socket).unwrap();
        let mut daemon = accept(&listener);
        // The daemon dies in the middle of the second event.
        daemon.write_all(&[bytes(MOTION), bytes(REST)[..7].to_vec()].concat()).unwrap();
        flight.until("the push", |it| is_pushed(&controls(it)));
        drop((daemon, listener));
        std::fs::remove_file(&socket).unwrap();
        flight.until_open(false);
        flight.until("letting go", |it| controls(it).thrust == [0.0; 3]);
    }
    assert_eq!(flight.desk.faults(SampleSource::Spacenavd).number(), 0);
}

#[test]
fn a_flood_keeps_the_newest_event() {
    let directory = tempfile::tempdir().unwrap();
    let socket = directory.path().join("spnav.sock");
    let listener = UnixListener::bind(&socket).unwrap();
    let mut flight = Loop::start(&config(&socket));
    let mut daemon = accept(&listener);
    // Twenty thousand events come undrained; the last ones are a push.
    let rest = bytes(REST);
    for _ in 0..20_000 {
        daemon.write_all(&rest).unwrap();
    }
    daemon.write_all(&bytes(MOTION)).unwrap();
    flight.until("the push", |it| is_pushed(&controls(it)));
    assert_eq!(flight.desk.faults(SampleSource::Spacenavd).number(), 0);
}
