//! Law: a head that a VRPN server tracks, through a real socket and the real program, is listed, is part of the ride,
//! and replays to the same bits. A program that lost the tracker on its way would have no head; one that read a clock
//! would have another head the second time.

use crate::runner::{run, said, told};
use std::io::Write;
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use input::head::Tracking;
use input::recording::{Recording, RecordingEntry};
use input::vrpn::{POSE, wire};
use input::{Sample, Signal};

/// Rate of poses, hertz.
const RATE_HZ: u32 = 100;
/// Sway of the head: amplitude, metres, and angular frequency, radians per second.
const SWAY: (f64, f64) = (0.2, 3.0);

/// Starts a server whose "Head" sways for every client until it disconnects; returns its address.
fn serve() -> String {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let place = listener.local_addr().unwrap();
    std::thread::spawn(move || {
        for client in listener.incoming() {
            let mut client = client.unwrap();
            let names = [
                wire::COOKIE.to_vec(),
                wire::description(wire::DESCRIBES_SENDER, 1, "Head"),
                wire::description(wire::DESCRIBES_TYPE, 4, POSE),
            ];
            let began = Instant::now();
            let mut outcome = client.write_all(&names.concat());
            while outcome.is_ok() {
                outcome = client.write_all(&pose(began.elapsed()));
                std::thread::sleep(Duration::from_secs(1) / RATE_HZ);
            }
        }
    });
    format!("vrpn://{place}/Head")
}

/// Payload with the pose of the head at this time.
fn pose(time: Duration) -> Vec<u8> {
    let x = SWAY.0 * (SWAY.1 * time.as_secs_f64()).sin();
    let mut payload = vec![0; 8];
    for value in [x, 1.6, 0.0, 0.0, 0.0, 0.0, 1.0] {
        payload.extend_from_slice(&value.to_be_bytes());
    }
    let (seconds, microseconds) = (1_000_000 + time.as_secs() as u32, time.subsec_micros());
    wire::VrpnMessage { seconds, microseconds, sender: 1, kind: 4, payload: &payload }.to_bytes()
}

#[test]
fn a_tracked_head_is_listed() {
    let folder = tempfile::tempdir().unwrap();
    let listed = run(folder.path(), &["devices", "--tracker", &serve(), "--seconds", "1.5"]);
    let text = said(&listed);
    assert!(listed.status.success(), "{}", told(&listed));
    let device = text.lines().find(|line| line.starts_with("vrpn ")).unwrap_or_else(|| panic!("{text}"));
    assert!(device.contains("Head") && device.contains(" 0 bad, 0 dropped"), "{device}");
    let head = text.lines().find(|line| line.starts_with("head ")).unwrap_or_else(|| panic!("{text}"));
    assert!(head.starts_with("head tracked") && head.contains("+1.600") && head.ends_with("0 rejected"), "{head}");

    let other = serve().replace("Head", "Wand");
    let text = said(&run(folder.path(), &["devices", "--tracker", &other, "--seconds", "1.5"]));
    assert!(text.contains("head not seen yet") && text.contains("no such device, but Head"), "{text}");
}

#[test]
fn a_ride_with_a_tracked_head_replays_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let tracker = serve();
    let arguments = ["ride", "--scene", "lattice", "--realtime", "--seconds", "3", "--record", "r.mcap"];
    let picture = ["--size", "64x36", "--samples", "1", "--out", "r.mp4", "--tracker", &tracker];
    let ridden = run(folder.path(), &[&arguments[..], &picture].concat());
    assert!(ridden.status.success(), "{}", told(&ridden));

    let recording = Recording::open(&folder.path().join("r.mcap")).unwrap();
    let head = recording.header().desk.head.clone().expect("the header says how the head was tracked");
    assert_eq!(head.url.to_string(), tracker);
    let heads: Vec<_> = recording
        .filter_map(|entry| match entry.unwrap() {
            RecordingEntry::Controls(record) => record.controls.head,
            _ => None,
        })
        .filter(|head| head.tracked == Tracking::Tracked)
        .collect();
    let fastest = heads.iter().map(|head| head.velocity_m_s.x.abs()).fold(0.0, f64::max);
    let expected = SWAY.0 * SWAY.1;
    // The velocity is a mean of four frames, on a busy machine.
    assert!((0.5 * expected..1.5 * expected).contains(&fastest), "{fastest} of {expected} in {} frames", heads.len());

    let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    assert!(verified.status.success(), "{}", told(&verified));
    assert!(said(&verified).contains("identical to the bit"), "{}", said(&verified));
}

#[test]
fn a_wrong_place_is_told_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let refused = run(folder.path(), &["ride", "--tracker", "vrpn://cave"]);
    assert_eq!(refused.status.code(), Some(2));
    let text = told(&refused);
    assert!(text.contains("names no device of the server") && text.lines().count() == 1, "{text}");
}

/// Starts a server that sends poses of "Head" to every client as fast as it takes them; returns its address, and the
/// number of poses that were sent.
fn flood() -> (String, Arc<AtomicU64>) {
    /// Number of poses that are sent together.
    const TOGETHER: u32 = 2000;
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let place = listener.local_addr().unwrap();
    let sent = Arc::new(AtomicU64::new(0));
    let count = Arc::clone(&sent);
    std::thread::spawn(move || {
        for client in listener.incoming() {
            let mut client = client.unwrap();
            let names = [
                wire::COOKIE.to_vec(),
                wire::description(wire::DESCRIBES_SENDER, 1, "Head"),
                wire::description(wire::DESCRIBES_TYPE, 4, POSE),
            ];
            let poses: Vec<u8> = (0..TOGETHER).flat_map(|n| pose(Duration::from_micros(u64::from(n)))).collect();
            let mut outcome = client.write_all(&names.concat());
            while outcome.is_ok() {
                outcome = client.write_all(&poses);
                count.fetch_add(u64::from(TOGETHER), Ordering::Relaxed);
            }
        }
    });
    (format!("vrpn://{place}/Head"), sent)
}

#[test]
fn a_flood_of_poses_leaves_the_ride_its_frames_and_the_recording_its_size() {
    let folder = tempfile::tempdir().unwrap();
    let (tracker, sent) = flood();
    let arguments = ["ride", "--scene", "lattice", "--realtime", "--seconds", "3", "--record", "r.mcap"];
    let picture = ["--size", "64x36", "--samples", "1", "--out", "r.mp4", "--tracker", &tracker];
    let ridden = run(folder.path(), &[&arguments[..], &picture].concat());
    assert!(ridden.status.success(), "{}", told(&ridden));

    let (path, sent) = (folder.path().join("r.mcap"), sent.load(Ordering::Relaxed));
    let bytes = std::fs::metadata(&path).unwrap().len();
    let (mut frames, mut poses) = (0_u64, 0_u64);
    for entry in Recording::open(&path).unwrap() {
        match entry.unwrap() {
            RecordingEntry::Frame(_) => frames += 1,
            RecordingEntry::Sample(Sample { signal: Signal::Bytes(bytes), .. }) => {
                poses += (bytes.len() / pose(Duration::ZERO).len()) as u64;
            }
            RecordingEntry::Sample(_) | RecordingEntry::Controls(_) => {}
        }
    }
    println!("{sent} poses sent in 3 s, {poses} at most recorded, {frames} frames, {bytes} bytes");
    assert!(sent > 300_000, "{sent} poses are no flood");
    assert!(poses < 60_000, "{poses} poses were recorded");
    assert!(bytes < 10_000_000, "the recording has {bytes} bytes");
    // Sixty a second, on a machine whose other core sends.
    assert!(frames > 90, "{frames} frames in 3 s");
}
