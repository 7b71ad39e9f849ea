//! Tests with a DTrack controller on a real UDP socket, played by the test.
//!
//! Frames must give their poses; garbage, truncated and endless datagrams and floods must be survived, and a body
//! that the cameras lose must stay at its place. A wrong program would send the head to the origin or turn it the
//! other way.

use std::net::UdpSocket;
use std::time::Duration;

use super::frames::Loop;
use input::SampleSource;
use input::devices::DeviceState;
use input::head::Tracking;

/// Controller, and the address that it sends to.
struct Controller {
    socket: UdpSocket,
    port: u16,
}

impl Controller {
    /// Chooses a port without a listener.
    fn start() -> Self {
        let port = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        Self { socket: UdpSocket::bind("127.0.0.1:0").unwrap(), port }
    }

    fn send(&self, datagram: impl AsRef<[u8]>) {
        // Linux reports at the next sending that the last one had no listener.
        let _ = self.socket.send_to(datagram.as_ref(), ("127.0.0.1", self.port));
    }
}

/// Frame `number` of a 60 Hz controller: one body at (x, 0.2, 0.3) m, turned by 30 degrees about z.
fn frame(number: u32, x_mm: f64) -> String {
    let time_us = number * 16_667;
    format!(
        "fr {number}\r\nts2 {} {} 4200\r\n6dcal 2\r\n6d 1 [0 1.000][{x_mm:.3} 200.000 300.000 0.0 0.0 30.0]\
         [0.866025 0.500000 0.000000 -0.500000 0.866025 0.000000 0.000000 0.000000 1.000000]\r\n6df2 0 0 \r\n",
        1_795_325_065 + time_us / 1_000_000,
        time_us % 1_000_000
    )
}

fn track(controller: &Controller) -> Loop {
    let mut tracking = Loop::track(&format!("dtrack://127.0.0.1:{}", controller.port));
    tracking.until_open(true);
    tracking
}

fn until_at(tracking: &mut Loop, x: f64) {
    tracking.until(&format!("the head at {x}"), |it| {
        let head = it.head();
        head.tracked != Tracking::Never && (head.position_m.x - x).abs() < 1e-12
    });
}

#[test]
fn a_frame_gives_what_the_stock_vrpn_server_makes_of_it() {
    let controller = Controller::start();
    let mut tracking = track(&controller);
    controller.send(frame(1, 100.0));
    until_at(&mut tracking, 0.1);
    let head = tracking.head();
    assert_eq!(head.position_m.to_array(), [0.1, 0.2, 0.3]);
    // 0 0 0.258819 0.965926, from six decimals of the matrix.
    for (found, expected) in head.orientation.to_array().into_iter().zip([0.0, 0.0, 0.258_819, 0.965_926]) {
        assert!((found - expected).abs() < 1e-6, "{found} for {expected}");
    }
    assert_eq!(tracking.devices.status()[0].source, SampleSource::Dtrack);
}

#[test]
fn a_body_that_is_lost_stays() {
    let controller = Controller::start();
    let mut tracking = track(&controller);
    for number in 0..20 {
        controller.send(frame(number, f64::from(number)));
        std::thread::sleep(Duration::from_millis(1));
    }
    until_at(&mut tracking, 0.019);
    let mut number = 20;
    tracking.until("the loss", |it| {
        controller.send(format!("fr {number}\r\n6dcal 2\r\n6d 0 \r\n"));
        number += 1;
        it.head().tracked == Tracking::Lost
    });
    let head = tracking.head();
    assert_eq!((head.position_m.to_array(), head.velocity_m_s.to_array()), ([0.019, 0.2, 0.3], [0.0; 3]));
    assert_eq!(tracking.devices.status()[0].state, DeviceState::Open);
    assert_eq!(tracking.desk.faults(SampleSource::Dtrack).number(), 0);
}

#[test]
fn garbage_is_counted_and_the_next_frame_used() {
    let controller = Controller::start();
    let mut tracking = track(&controller);
    controller.send(frame(1, 100.0));
    until_at(&mut tracking, 0.1);
    let good = frame(2, 110.0);
    let truncated = good.find("0.866").unwrap() + 20;
    let garbage: [&[u8]; 4] = [b"\xff\xfe\x00", b"6d 3 [", &good.as_bytes()[..truncated], &[b'x'; 40_000]];
    for datagram in garbage {
        controller.send(datagram);
    }
    tracking.until("the garbage", |it| it.desk.faults(SampleSource::Dtrack).number() == 4);
    assert_eq!(tracking.head().position_m.x, 0.1);
    controller.send(good);
    until_at(&mut tracking, 0.11);
}

#[test]
fn of_a_flood_the_newest_pose_survives() {
    let controller = Controller::start();
    let mut tracking = track(&controller);
    // The frames are not drained while they come.
    for number in 0..20_000 {
        controller.send(frame(number, 1.0));
    }
    std::thread::sleep(Duration::from_millis(100));
    controller.send(frame(20_001, 2.0));
    until_at(&mut tracking, 0.002);
    assert_eq!(tracking.desk.faults(SampleSource::Dtrack).number(), 0);
}

#[test]
fn a_port_in_use_and_a_foreign_address_are_told() {
    let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    for (url, expected) in [
        (format!("dtrack://127.0.0.1:{port}"), "another program listens at"),
        // An address that is reserved for documents.
        (format!("dtrack://192.0.2.1:{port}"), "is no address of this machine"),
    ] {
        Loop::track(&url).until(expected, |it| match &it.devices.status()[0].state {
            DeviceState::Absent(why) => why.to_string().contains(expected),
            DeviceState::Open => false,
        });
    }
}

#[test]
fn a_multicast_group_is_heard_on_the_loopback_and_its_garbage_survived() {
    let group = (std::net::Ipv4Addr::new(239, 193, 7, 78), Controller::start().port);
    let mut tracking = Loop::track(&format!("dtrack://{}:{}", group.0, group.1));
    tracking.until_open(true);
    let sender = UdpSocket::bind("127.0.0.1:0").unwrap();
    socket2::SockRef::from(&sender).set_multicast_if_v4(&std::net::Ipv4Addr::LOCALHOST).unwrap();
    sender.send_to(frame(1, 100.0).as_bytes(), group).unwrap();
    until_at(&mut tracking, 0.1);
    sender.send_to(b"6d 3 [\xff", group).unwrap();
    tracking.until("the garbage", |it| it.desk.faults(SampleSource::Dtrack).number() == 1);
    let told = tracking.desk.faults(SampleSource::Dtrack).last().unwrap().to_owned();
    assert!(told.starts_with("a datagram that is not ASCII text"), "{told}");
    sender.send_to(frame(2, 110.0).as_bytes(), group).unwrap();
    until_at(&mut tracking, 0.11);
    assert!(tracking.replays_to_the_bit() > 1);
}

#[test]
fn a_body_that_is_not_seen_is_told_with_those_that_are() {
    let controller = Controller::start();
    let head = input::HeadConfig {
        sensor: 5,
        ..input::HeadConfig::new(format!("dtrack://127.0.0.1:{}", controller.port).parse().unwrap())
    };
    let mut tracking = Loop::track_head(head);
    tracking.until_open(true);
    let mut number = 0;
    let expected = "body 5 is not seen; body 0 and inertial body 2 are seen";
    tracking.until(expected, |it| {
        number += 1;
        controller.send(frame(number, 1.0) + "6di 1 [2 1 0.500][1 2 3][1 0 0 0 1 0 0 0 1]\r\n");
        std::thread::sleep(Duration::from_millis(10));
        let now = it.clock.now();
        it.desk.tracker_advice(now).as_deref() == Some(expected)
    });
    assert_eq!(tracking.head().tracked, Tracking::Never);
}
