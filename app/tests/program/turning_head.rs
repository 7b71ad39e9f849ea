//! Server of a tracker whose head sways and turns, for tests of the program.

use std::io::Write;
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use glam::DQuat;
use input::vrpn::{POSE, wire};

/// Rate of poses, hertz.
pub const POSES_HZ: u32 = 100;
/// Sway of the head: amplitude, metres, and angular frequency, radians per second.
pub const SWAY: (f64, f64) = (0.2, 3.0);
/// Turn of the head to the left and right: amplitude, radians, and angular frequency, radians per second.
pub const TURN: (f64, f64) = (0.7, 2.3);
/// Nod of the head, likewise.
const NOD: (f64, f64) = (0.2, 1.7);

/// First bytes of a server: its version, and the name and kind of its tracker.
pub fn greeting() -> Vec<u8> {
    let names = [
        wire::COOKIE.to_vec(),
        wire::description(wire::DESCRIBES_SENDER, 1, "Head"),
        wire::description(wire::DESCRIBES_TYPE, 4, POSE),
    ];
    names.concat()
}

/// Starts a server whose "Head" sways and turns for every client until it disconnects; returns its address.
pub fn serve() -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let place = listener.local_addr().unwrap();
    std::thread::spawn(move || {
        for client in listener.incoming() {
            let mut client = client.unwrap();
            let began = Instant::now();
            let mut outcome = client.write_all(&greeting());
            while outcome.is_ok() {
                outcome = client.write_all(&pose(began.elapsed()));
                std::thread::sleep(Duration::from_secs(1) / POSES_HZ);
            }
        }
    });
    format!("vrpn://{place}/Head")
}

/// Payload with the pose of the head at this time.
pub fn pose(time: Duration) -> Vec<u8> {
    let [x, yaw, pitch] = [SWAY, TURN, NOD].map(|(amplitude, rate)| amplitude * (rate * time.as_secs_f64()).sin());
    let turn = DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch);
    let mut payload = vec![0; 8];
    for value in [x, 1.6, 0.0, turn.x, turn.y, turn.z, turn.w] {
        payload.extend_from_slice(&value.to_be_bytes());
    }
    let (seconds, microseconds) = (1_000_000 + time.as_secs() as u32, time.subsec_micros());
    wire::VrpnMessage { seconds, microseconds, sender: 1, kind: 4, payload: &payload }.to_bytes()
}

/// Starts a server that sends poses of "Head" to every client as fast as it takes them; returns its address, and the
/// number of poses that were sent.
pub fn flood() -> (String, Arc<AtomicU64>) {
    /// Number of poses that are sent together.
    const TOGETHER: u32 = 2000;
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let place = listener.local_addr().unwrap();
    let sent = Arc::new(AtomicU64::new(0));
    let count = Arc::clone(&sent);
    std::thread::spawn(move || {
        for client in listener.incoming() {
            let mut client = client.unwrap();
            let poses: Vec<u8> = (0..TOGETHER).flat_map(|n| pose(Duration::from_micros(u64::from(n)))).collect();
            let mut outcome = client.write_all(&greeting());
            while outcome.is_ok() {
                outcome = client.write_all(&poses);
                count.fetch_add(u64::from(TOGETHER), Ordering::Relaxed);
            }
        }
    });
    (format!("vrpn://{place}/Head"), sent)
}
