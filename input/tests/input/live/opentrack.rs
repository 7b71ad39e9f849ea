//! Tests with opentrack on a real UDP socket, played by the test.
//!
//! Poses must move the head in opentrack's directions from home; short datagrams, garbage, foreign senders and floods
//! must be survived with a reason; opentrack may be started again; the straight pose must be the one of the key. A
//! wrong program would move the picture against the head, or let a stray datagram move it. What was recorded must give
//! the same head again to the last bit.

use std::net::UdpSocket;
use std::thread;
use std::time::{Duration, Instant};

use super::frames::Loop;
use glam::{DQuat, DVec3};
use input::devices::DeviceState;
use input::head::{HeadConfig, Recentring, Tracking};
use input::{Clock, Desk, DeskConfig, Devices, DevicesConfig, KeyboardKey, Sample, SampleSource};

/// Place of the head at home, which `HeadConfig::new` gives.
const HOME: DVec3 = DVec3::new(0.0, 1.7, 0.0);
/// Rounding of places two metres from the origin, metres.
const ROUNDING: f64 = 1e-14;

/// Computer on which opentrack runs, and the port that it sends to.
struct Tracked {
    socket: UdpSocket,
    port: u16,
}

impl Tracked {
    /// Chooses a port without a listener.
    fn start() -> Self {
        let port = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        Self { socket: UdpSocket::bind("127.0.0.1:0").unwrap(), port }
    }

    /// The same computer after opentrack was started again, which sends from another port.
    fn restarted(&self) -> Self {
        Self { socket: UdpSocket::bind("127.0.0.1:0").unwrap(), port: self.port }
    }

    fn send(&self, datagram: impl AsRef<[u8]>) {
        // Linux reports at the next sending that the last one had no listener.
        let _ = self.socket.send_to(datagram.as_ref(), ("127.0.0.1", self.port));
    }
}

/// Datagram of a pose: x, y, z in cm, yaw, pitch, roll in degrees.
fn datagram(numbers: [f64; 6]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// Datagram of a head that has gone `ahead_cm` towards the screen.
fn ahead(ahead_cm: f64) -> Vec<u8> {
    datagram([0.0, 0.0, -ahead_cm, 0.0, 0.0, 0.0])
}

fn track(tracked: &Tracked) -> Loop {
    let mut tracking = Loop::track(&format!("opentrack://127.0.0.1:{}", tracked.port));
    let head = HeadConfig { recentre: Recentring::Key, ..tracking.desk.head().unwrap().config().clone() };
    tracking.desk = Desk::new(DeskConfig { head: Some(head), ..Default::default() }).unwrap();
    tracking.until_open(true);
    tracking
}

fn until_at(tracking: &mut Loop, place: DVec3) {
    tracking.until(&format!("the head at {place}"), |it| it.head().position_m.distance(place) < ROUNDING);
}

fn until_ahead(tracking: &mut Loop, ahead_cm: f64) {
    until_at(tracking, HOME + DVec3::NEG_Z * 0.01 * ahead_cm);
}

fn told(tracking: &Loop) -> (u64, String) {
    let faults = tracking.desk.faults(SampleSource::Opentrack);
    (faults.number(), faults.last().unwrap_or_default().to_owned())
}

#[test]
fn the_head_goes_from_home_as_opentrack_says() {
    let tracked = Tracked::start();
    let mut tracking = track(&tracked);
    assert_eq!(tracking.head().tracked, Tracking::Never);
    tracked.send(datagram([-10.0, 5.0, -20.0, -90.0, 0.0, 0.0]));
    until_at(&mut tracking, HOME + DVec3::new(0.1, 0.05, -0.2));
    let gaze = tracking.head().orientation * DVec3::NEG_Z;
    assert!(gaze.distance(DVec3::NEG_X) < ROUNDING, "a turn to the left looks {gaze}");
    assert_eq!(tracking.devices.status()[0].source, SampleSource::Opentrack);
    let heard = tracking.desk.heard(SampleSource::Opentrack);
    assert_eq!(heard.iter().map(|sensor| sensor.pose.unwrap().0).collect::<Vec<_>>(), [DVec3::new(0.1, 0.05, -0.2)]);
}

#[test]
fn cut_and_hostile_datagrams_are_counted_with_a_reason_and_the_next_pose_is_used() {
    let tracked = Tracked::start();
    let mut tracking = track(&tracked);
    tracked.send(ahead(1.0));
    until_ahead(&mut tracking, 1.0);
    let whole = ahead(2.0);
    for length in 1..48 {
        tracked.send(&whole[..length]);
    }
    tracking.until("the cut datagrams", |it| told(it).0 == 47);
    assert!(told(&tracking).1.starts_with("a datagram of 47 bytes: opentrack sends 48"), "{}", told(&tracking).1);
    let numbers = [f64::NAN, f64::INFINITY, 1e300, -1e7];
    let hostile = numbers.map(|number| datagram([0.0, number, 0.0, 0.0, 0.0, 0.0]));
    let long = [vec![0x41; 49], vec![0; 1500], vec![0xff; 60_000]];
    for datagram in hostile.iter().chain(&long).chain([&vec![0xff; 48]]) {
        tracked.send(datagram);
    }
    tracking.until("the hostile datagrams", |it| told(it).0 == 47 + 8);
    // A pose too far for centimetres is told, too.
    tracked.send(ahead(1700.0));
    tracking.until("the pose in millimetres", |it| it.desk.head().unwrap().rejected().number() == 1);
    let why = tracking.desk.head().unwrap().rejected().last().unwrap().to_owned();
    assert!(why.to_string().contains("scale = \"mm\""), "{why}");
    assert!(tracking.head().position_m.distance(HOME + DVec3::NEG_Z * 0.01) < ROUNDING);
    tracked.send(whole);
    until_ahead(&mut tracking, 2.0);
}

#[test]
fn a_head_whose_datagrams_come_late_rests_and_goes_on() {
    let tracked = Tracked::start();
    let mut tracking = track(&tracked);
    for step in 0..20 {
        tracked.send(ahead(0.5 * f64::from(step)));
        thread::sleep(Duration::from_millis(4));
    }
    until_ahead(&mut tracking, 9.5);
    tracking.until("the loss", |it| it.head().tracked == Tracking::Lost);
    let head = tracking.head();
    assert_eq!((head.position_m, head.velocity_m_s), (HOME + DVec3::NEG_Z * 0.095, DVec3::ZERO));
    tracked.send(ahead(10.0));
    until_ahead(&mut tracking, 10.0);
    // No velocity is made across the gap.
    assert_eq!(tracking.head().velocity_m_s, DVec3::ZERO);
}

#[test]
fn of_a_flood_the_newest_pose_survives() {
    let tracked = Tracked::start();
    let mut tracking = track(&tracked);
    let began = Instant::now();
    // The datagrams are not drained while they come.
    for number in 0..300_000 {
        tracked.send(ahead(0.001 * f64::from(number % 1000)));
    }
    println!("{:.0} datagrams a second", 300_000.0 / began.elapsed().as_secs_f64());
    thread::sleep(Duration::from_millis(100));
    tracked.send(ahead(2.0));
    until_ahead(&mut tracking, 2.0);
    let status = &tracking.devices.status()[0];
    assert_eq!(told(&tracking).0, 0);
    assert!(status.samples < 30_000, "{} of 300000 passed", status.samples);
    assert!(status.dropped > 0);
}

#[test]
fn another_sender_does_not_move_the_head_and_opentrack_may_be_started_again() {
    let tracked = Tracked::start();
    let mut tracking = track(&tracked);
    tracked.send(ahead(1.0));
    until_ahead(&mut tracking, 1.0);
    let restarted = tracked.restarted();
    let began = Instant::now();
    let mut first = None;
    tracking.until("the new sender", |it| {
        restarted.send(ahead(3.0));
        if it.head().position_m != HOME + DVec3::NEG_Z * 0.01 {
            first.get_or_insert(began.elapsed());
        }
        first.is_some()
    });
    // Another sender takes the place of one that has been silent for two seconds, not before.
    assert!(first.unwrap() > Duration::from_millis(1500), "{first:?}");
    tracking.until("the dropped", |it| it.devices.status()[0].dropped > 0);
    until_ahead(&mut tracking, 3.0);
}

#[test]
fn a_port_in_use_and_a_foreign_address_are_told() {
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    for (url, expected) in [
        (format!("opentrack://127.0.0.1:{port}"), "end it, or have opentrack send to another port"),
        // An address that is reserved for documents.
        (format!("opentrack://192.0.2.1:{port}"), "is no address of this machine"),
    ] {
        Loop::track(&url).until(expected, |it| match &it.devices.status()[0].state {
            DeviceState::Absent(why) => why.to_string().contains(expected),
            DeviceState::Open => false,
        });
    }
}

/// Samples of a ride at a desk, and the desk's settings: the head turns and leans, the rider straightens it, and it
/// leans again.
fn straightened() -> (DeskConfig, Vec<Sample>) {
    let tracked = Tracked::start();
    let url = format!("opentrack://127.0.0.1:{}", tracked.port).parse().unwrap();
    let head = HeadConfig { recentre: Recentring::Key, ..HeadConfig::new(url) };
    let tracker = Some(head.url.clone());
    let clock = Clock::start();
    let devices = DevicesConfig { space_mouse: false, gamepad: false, tracker, ..Default::default() };
    let devices = Devices::open(&devices, clock).unwrap();
    while devices.status()[0].state != DeviceState::Open {
        thread::sleep(Duration::from_millis(2));
    }
    let mut samples = Vec::new();
    // A camera at the monitor's left edge sees the head that looks at the middle turned to the right by 20 degrees.
    let poses = [[12.0, -3.0, 60.0, 20.0, -5.0, 1.0], [12.0, -3.0, 60.0, 0.0, -5.0, 1.0]];
    for (number, pose) in poses.into_iter().enumerate() {
        for _ in 0..10 {
            tracked.send(datagram(pose));
            thread::sleep(Duration::from_millis(4));
        }
        let until = Instant::now() + Duration::from_secs(2);
        let before = samples.len();
        while samples.len() < before + 10 && Instant::now() < until {
            samples.extend(devices.drain());
        }
        if number == 0 {
            samples.push(Sample::key(clock.now(), KeyboardKey::U, true));
        }
    }
    (DeskConfig { head: Some(head), ..Default::default() }, samples)
}

#[test]
fn the_key_makes_the_present_pose_the_straight_one_and_a_replay_gives_the_same_bits() {
    let (config, samples) = straightened();
    let ride = |config: &DeskConfig| {
        let mut desk = Desk::new(config.clone()).unwrap();
        let states = samples.iter().map(|sample| {
            desk.feed(sample);
            desk.controls(sample.at).head.unwrap()
        });
        states.collect::<Vec<_>>()
    };
    let states = ride(&config);
    let key = samples.iter().position(|sample| sample.source == SampleSource::Keyboard).unwrap();
    let (before, straight, last) = (states[key - 1], states[key], states.last().unwrap());
    assert!(before.position_m.distance(HOME + DVec3::new(-0.12, -0.03, 0.6)) < ROUNDING);
    assert_eq!((straight.position_m, straight.orientation), (HOME, DQuat::IDENTITY));
    assert_eq!(straight.velocity_m_s, DVec3::ZERO);
    // The head has turned to the left by 20 degrees and stayed where it was.
    assert!(last.position_m.distance(HOME) < ROUNDING, "{}", last.position_m);
    let gaze = last.orientation * DVec3::NEG_Z;
    assert!(gaze.x < -0.3 && (gaze.z + 20_f64.to_radians().cos()).abs() < 2e-3, "{gaze}");
    // The settings go through the recording's header.
    let header = serde_json::to_string(&config).unwrap();
    assert_eq!(ride(&serde_json::from_str(&header).unwrap()), states);
}
