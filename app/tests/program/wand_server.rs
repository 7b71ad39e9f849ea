//! Server of a tracker that sees a head and a wand, whose hand is the test's.

use glam::{DQuat, DVec3};
use input::vrpn::{POSE, wire};
use std::io::Write;
use std::net::TcpListener;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Messages per second.
const RATE_HZ: u32 = 100;
/// Time for which a button is pressed: several frames of a software driver.
const PRESS: Duration = Duration::from_millis(600);
/// Numbers of the server's kinds of messages.
const POSES: i32 = 4;
const BUTTONS: i32 = 10;
const AXES: i32 = 11;
/// Place of the hand, room axes, metres.
const HAND: DVec3 = DVec3::new(0.25, 1.25, -0.2);

/// State of the hand and of the head.
#[derive(Clone, Copy, Debug)]
struct Held {
    turn: DQuat,
    stick: [f64; 2],
    head_x: f64,
    button: Option<i32>,
}

/// Server of a wand. It serves until the test's process ends.
pub struct WandServer {
    /// Address of the head's device.
    pub url: String,
    held: Arc<Mutex<Held>>,
}

impl WandServer {
    /// Starts the server, with the hand at rest.
    pub fn start() -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let url = format!("vrpn://{}/Head", listener.local_addr().unwrap());
        let still = Held { turn: DQuat::IDENTITY, stick: [0.0; 2], head_x: 0.0, button: None };
        let held = Arc::new(Mutex::new(still));
        let server = Self { url, held: Arc::clone(&held) };
        std::thread::spawn(move || {
            for client in listener.incoming() {
                let (mut client, held) = (client.unwrap(), Arc::clone(&held));
                std::thread::spawn(move || {
                    let began = Instant::now();
                    let mut before = None;
                    let mut outcome = client.write_all(&greeting());
                    while outcome.is_ok() {
                        let now = *held.lock().unwrap();
                        outcome = client.write_all(&messages(began.elapsed(), &now, &mut before));
                        std::thread::sleep(Duration::from_secs(1) / RATE_HZ);
                    }
                });
            }
        });
        server
    }

    fn change(&self, change: impl FnOnce(&mut Held)) {
        change(&mut self.held.lock().unwrap());
    }

    /// Points at a point of the room, metres.
    pub fn point(&self, point: DVec3) {
        self.change(|held| held.turn = DQuat::from_rotation_arc(DVec3::NEG_Z, (point - HAND).normalize()));
        std::thread::sleep(PRESS);
    }

    /// Pushes the stick: to the right, ahead.
    pub fn push(&self, stick: [f64; 2]) {
        self.change(|held| held.stick = stick);
    }

    /// Moves the head to the right, metres.
    pub fn walk(&self, right_m: f64) {
        self.change(|held| held.head_x = right_m);
    }

    /// Presses a button, and lets it go.
    pub fn press(&self, button: i32) {
        self.change(|held| held.button = Some(button));
        std::thread::sleep(PRESS);
        self.change(|held| held.button = None);
        std::thread::sleep(PRESS);
    }
}

/// First bytes of the server: its version, the name of its device, and the kinds of its messages.
fn greeting() -> Vec<u8> {
    let kinds = [(POSES, POSE), (BUTTONS, "vrpn_Button Change"), (AXES, "vrpn_Analog Channel")];
    let named = kinds.map(|(number, kind)| wire::description(wire::DESCRIBES_TYPE, number, kind));
    [wire::COOKIE.to_vec(), wire::description(wire::DESCRIBES_SENDER, 1, "Head"), named.concat()].concat()
}

/// Messages at a time; `before`: button that was down.
fn messages(time: Duration, held: &Held, before: &mut Option<i32>) -> Vec<u8> {
    let (seconds, microseconds) = (1_000_000 + time.as_secs() as u32, time.subsec_micros());
    let message =
        |kind: i32, payload: &[u8]| wire::VrpnMessage { seconds, microseconds, sender: 1, kind, payload }.to_bytes();
    let pose = |sensor: i32, place: DVec3, turn: DQuat| {
        let mut payload = sensor.to_be_bytes().to_vec();
        payload.extend([0; 4]);
        for value in place.to_array().into_iter().chain(turn.to_array()) {
            payload.extend_from_slice(&value.to_be_bytes());
        }
        message(POSES, &payload)
    };
    let button = |number: i32, down: i32| message(BUTTONS, &[number.to_be_bytes(), down.to_be_bytes()].concat());
    let mut bytes = pose(0, DVec3::new(held.head_x, 1.6, 0.0), DQuat::IDENTITY);
    bytes.extend(pose(1, HAND, held.turn));
    bytes.extend(message(AXES, &[2.0, held.stick[0], held.stick[1]].map(f64::to_be_bytes).concat()));
    if *before != held.button {
        bytes.extend(before.map_or_else(Vec::new, |number| button(number, 0)));
        bytes.extend(held.button.map_or_else(Vec::new, |number| button(number, 1)));
        *before = held.button;
    }
    bytes
}
