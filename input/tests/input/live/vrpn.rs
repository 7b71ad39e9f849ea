//! Tests with a tracker through a real TCP connection, served by the test as the stock server serves it.
//!
//! The bytes of both sides must be exactly VRPN's; poses must arrive however the stream is cut; garbage, other
//! versions, silence, floods and a server that dies must be survived, and the head must stay at its place. A wrong
//! program would hang, lose its place in the stream, or send the head to the origin.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::time::Duration;

use super::frames::Loop;
use input::SampleSource;
use input::devices::DeviceState;
use input::head::Tracking;

/// Cookie captured from the stock server, version 7.38.
const COOKIE: &str = "7672706e3a207665722e2030372e33382020300000000000";
const SENDER_1_HEAD: &str = "000000216b027c890009b7cd00000001ffffffff0000000100000005486561640000000000000000";
const TYPE_4_POSE: &str = concat!(
    "000000326b027c890009b7ce00000004fffffffe00000008000000167672706e5f547261636b657220506f735f51",
    "75617400000000000000",
);
/// Pose of sender 1, type 4, sensor 0, at the origin, not turned.
const IDENTITY: &str = concat!(
    "000000586b027c890009d21f00000001000000040000001d",
    "0000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "3ff0000000000000",
);
/// Bytes that the client must send after its cookie: number 0 is "Head"; types 0 and 1 are `vrpn_Base ping_message`
/// and `vrpn_Base pong_message`; times and sequence numbers are zero.
const OURS: &str = concat!(
    "000000210000000000000000",
    "00000000ffffffff00000000",
    "00000005486561640000000000000000",
    "000000330000000000000000",
    "00000000fffffffe00000000",
    "000000177672706e5f426173652070696e675f6d657373616765000000000000",
    "000000330000000000000000",
    "00000001fffffffe00000000",
    "000000177672706e5f4261736520706f6e675f6d657373616765000000000000",
);
/// Ping that the client must send once a second: a message without payload, sender 0, type 0.
const OUR_PING: &str = "000000180000000000000000000000000000000000000000";
/// Answer of the client to a ping: type 1.
const OUR_PONG: &str = "000000180000000000000000000000000000000100000000";

pub(super) fn unhex(hex: &str) -> Vec<u8> {
    (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect()
}

/// Message in the form of VRPN's own documents and captures.
pub(super) fn message(seconds: u32, microseconds: u32, sender: i32, kind: i32, payload: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for word in [24 + payload.len() as u32, seconds, microseconds, sender as u32, kind as u32, 0] {
        bytes.extend_from_slice(&word.to_be_bytes());
    }
    bytes.extend_from_slice(payload);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

/// Description that a number is a name: −1 of a sender, −2 of a type.
pub(super) fn description(kind: i32, number: i32, name: &str) -> Vec<u8> {
    let length = name.len() as u32 + 1;
    message(0, 0, number, kind, &[&length.to_be_bytes(), name.as_bytes(), &[0]].concat())
}

/// Pose of sender 1, type 4: frame `number` of a 100 Hz tracker, at (x, 1.5, 0).
pub(super) fn pose(number: u32, x: f64) -> Vec<u8> {
    let mut payload = vec![0; 8];
    for value in [x, 1.5, 0.0, 0.0, 0.0, 0.0, 1.0] {
        payload.extend_from_slice(&value.to_be_bytes());
    }
    message(1_795_325_065 + number / 100, number % 100 * 10_000, 1, 4, &payload)
}

pub(super) fn descriptions() -> Vec<u8> {
    [unhex(SENDER_1_HEAD), unhex(TYPE_4_POSE)].concat()
}

/// Server of one client at a time.
pub(super) struct Server {
    listener: TcpListener,
}

impl Server {
    pub(super) fn start() -> Self {
        Self { listener: TcpListener::bind("127.0.0.1:0").unwrap() }
    }

    pub(super) fn url(&self) -> String {
        format!("vrpn://127.0.0.1:{}/Head", self.listener.local_addr().unwrap().port())
    }

    /// Client that has sent nothing yet.
    pub(super) fn accept(&self) -> TcpStream {
        let client = self.listener.accept().unwrap().0;
        client.set_read_timeout(Some(Duration::from_secs(5))).unwrap();
        client
    }

    /// Client after the exchange of cookies.
    pub(super) fn greet(&self) -> TcpStream {
        let mut client = self.accept();
        client.write_all(&unhex(COOKIE)).unwrap();
        expect(&mut client, COOKIE);
        client
    }
}

pub(super) fn expect(client: &mut TcpStream, hex: &str) {
    let mut heard = vec![0; hex.len() / 2];
    client.read_exact(&mut heard).unwrap();
    assert_eq!(heard, unhex(hex), "expected {hex}");
}

pub(super) fn until_at(tracking: &mut Loop, x: f64) {
    tracking.until(&format!("the head at {x}"), |it| {
        let head = it.head();
        head.tracked != Tracking::Never && (head.position_m.x - x).abs() < 1e-12
    });
}

fn until_absent(tracking: &mut Loop, expected: &str) {
    tracking.until(expected, |it| match &it.devices.status()[0].state {
        DeviceState::Absent(why) => why.to_string().contains(expected),
        DeviceState::Open => false,
    });
}

#[test]
fn both_sides_speak_vrpn_to_the_byte() {
    let server = Server::start();
    let mut tracking = Loop::track(&server.url());
    let mut client = server.greet();
    expect(&mut client, OURS);
    expect(&mut client, OUR_PING);
    client.write_all(&[descriptions(), unhex(IDENTITY)].concat()).unwrap();
    // The protocol's own example is the zero pose, which no sensor measures.
    tracking.until("the pose", |it| it.desk.head().unwrap().rejected().number() == 1);
    let rejected = tracking.desk.head().unwrap().rejected().last().unwrap().to_owned();
    assert!(rejected.starts_with("the zero pose"), "{rejected}");
    assert_eq!(tracking.head().tracked, Tracking::Never);

    // The client must answer a ping, with its own numbers.
    client.write_all(&[description(-2, 7, "vrpn_Base ping_message"), message(0, 0, 1, 7, &[])].concat()).unwrap();
    let mut heard = [0; 24];
    for _ in 0..10 {
        client.read_exact(&mut heard).unwrap();
        if heard.to_vec() == unhex(OUR_PONG) {
            break;
        }
        assert_eq!(heard.to_vec(), unhex(OUR_PING));
    }
    assert_eq!(heard.to_vec(), unhex(OUR_PONG));
    let status = &tracking.devices.status()[0];
    assert_eq!((status.source, status.name.as_str(), &status.state), (SampleSource::Vrpn, "Head", &DeviceState::Open));
    assert_eq!(tracking.desk.faults(SampleSource::Vrpn).number(), 0);
}

#[test]
fn the_stream_may_be_cut_anywhere_and_what_is_not_described_is_passed_over() {
    let server = Server::start();
    let mut tracking = Loop::track(&server.url());
    let mut client = server.greet();
    client.set_nodelay(true).unwrap();
    // A pose of an unknown sender, before any description, and one of another device.
    let other = description(-1, 2, "Wand");
    let mut of_other = pose(0, 9.0);
    of_other[15] = 2;
    let stream = [pose(0, 9.0), descriptions(), other, of_other, pose(1, 0.25)].concat();
    for (index, byte) in stream.iter().enumerate() {
        client.write_all(&[*byte]).unwrap();
        if index % 16 == 0 {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    until_at(&mut tracking, 0.25);
    assert_eq!(tracking.desk.faults(SampleSource::Vrpn).number(), 0);
    assert_eq!(tracking.desk.head().unwrap().rejected().number(), 0);
}

#[test]
fn a_server_that_dies_leaves_the_head_where_it_is_and_may_come_back() {
    let server = Server::start();
    let mut tracking = Loop::track(&server.url());
    for (session, x) in [(0, 0.5), (1, 0.6)] {
        let mut client = server.greet();
        client.write_all(&descriptions()).unwrap();
        for number in 0..10 {
            let pose = pose(1000 * session + number, x - 0.001 * f64::from(9 - number));
            client.write_all(&pose).unwrap();
        }
        until_at(&mut tracking, x);
        // The server dies in the middle of a message.
        client.write_all(&pose(1000 * session + 11, 0.0)[..50]).unwrap();
        drop(client);
        tracking.until("the loss", |it| it.head().tracked == Tracking::Lost);
        let head = tracking.head();
        assert_eq!((head.position_m.x, head.velocity_m_s.to_array()), (x, [0.0; 3]));
    }
    assert_eq!(tracking.desk.faults(SampleSource::Vrpn).number(), 0);
}

#[test]
fn what_is_no_server_is_told_and_one_that_becomes_one_is_used() {
    let server = Server::start();
    let mut tracking = Loop::track(&server.url());
    server.accept().write_all(b"HTTP/1.1 400 Bad Request\r\n\r\n").unwrap();
    until_absent(&mut tracking, "does not speak VRPN");
    server.accept().write_all(b"vrpn: ver. 06.04  0\0\0\0\0\0").unwrap();
    until_absent(&mut tracking, "speaks VRPN \"06.04");
    let silent = server.accept();
    until_absent(&mut tracking, "it says nothing");
    drop(silent);
    // Garbage behind a good beginning, with impossible lengths.
    for garbage in [[0xff; 64], [0; 64]] {
        let mut client = server.greet();
        client.write_all(&[&descriptions()[..], &garbage].concat()).unwrap();
        until_absent(&mut tracking, "the stream is damaged");
        drop(client);
    }
    let mut client = server.greet();
    client.write_all(&[descriptions(), pose(1, 0.75)].concat()).unwrap();
    until_at(&mut tracking, 0.75);
    drop((client, server));
    until_absent(&mut tracking, "nothing listens there");
}

#[test]
fn of_a_flood_the_newest_pose_survives() {
    let server = Server::start();
    let mut tracking = Loop::track(&server.url());
    let mut client = server.greet();
    client.write_all(&descriptions()).unwrap();
    // The stream of 20 MB is not drained.
    let many: Vec<u8> = (0..1000).flat_map(|number| pose(number, 0.0)).collect();
    for _ in 0..230 {
        client.write_all(&many).unwrap();
    }
    tracking.until("the flood", |it| it.devices.status()[0].dropped > 0);
    // The tracker goes on.
    for number in 1001..1100 {
        client.write_all(&pose(number, 0.001 * f64::from(number - 1000))).unwrap();
        std::thread::sleep(Duration::from_millis(1));
    }
    until_at(&mut tracking, 0.099);
    assert_eq!(tracking.desk.faults(SampleSource::Vrpn).number(), 0);
}

/// Port at which a server listens as the stock server does: without leave to share it with what is left of an earlier
/// connection.
fn listen_as_the_stock_server(port: u16) -> std::io::Result<TcpListener> {
    use socket2::{Domain, Socket, Type};
    let socket = Socket::new(Domain::IPV4, Type::STREAM, None)?;
    socket.bind(&std::net::SocketAddr::from(([127, 0, 0, 1], port)).into())?;
    socket.listen(4)?;
    Ok(socket.into())
}

#[test]
fn a_server_that_is_killed_in_mid_ride_can_be_started_again_at_once_and_is_used() {
    let mut server = Server { listener: listen_as_the_stock_server(0).unwrap() };
    let port = server.listener.local_addr().unwrap().port();
    let mut tracking = Loop::track(&server.url());
    for (session, x) in [(0, 0.5), (1, 0.6), (2, 0.7)] {
        let mut client = server.greet();
        client.write_all(&[descriptions(), pose(1000 * session, x)].concat()).unwrap();
        until_at(&mut tracking, x);
        // The system closes the killed server's sockets, the connection first. What it has read leaves an ordinary end.
        client.set_nonblocking(true).unwrap();
        while client.read(&mut [0; 4096]).is_ok_and(|length| length > 0) {}
        drop(client);
        drop(server);
        let killed = std::time::Instant::now();
        let listener = loop {
            match listen_as_the_stock_server(port) {
                Ok(listener) => break listener,
                Err(error) => {
                    assert!(killed.elapsed() < Duration::from_secs(2), "after {:?}: {error}", killed.elapsed());
                }
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        server = Server { listener };
    }
    // A client that is killed leaves nothing either.
    let client = server.greet();
    drop(tracking);
    drop((client, server));
    listen_as_the_stock_server(port).unwrap();
}

#[test]
fn a_mistaken_name_is_told_although_the_server_repeats_it() {
    let server = Server::start();
    let mut tracking = Loop::track(&server.url().replace("/Head", "/Hand"));
    let mut client = server.greet();
    // As the stock server does: it describes what the client has described, and sends the poses of its own devices.
    client.write_all(&[descriptions(), description(-1, 5, "Hand")].concat()).unwrap();
    let mut number = 0;
    tracking.until("the advice", |it| {
        number += 1;
        client.write_all(&pose(number, 0.5)).unwrap();
        let now = it.clock.now();
        it.desk.tracker_advice(now).is_some()
    });
    let now = tracking.clock.now();
    let told = tracking.desk.tracker_advice(now).unwrap();
    let expected = "the server has no device \"Hand\": a ping is not answered; the server sends sensor 0 of Head";
    assert_eq!(told, expected);
    let heard = &tracking.desk.heard(SampleSource::Vrpn)[0];
    assert!(heard.count > 100 && heard.rate_hz(now) > 50.0 && heard.is_tracked(now), "{heard:?}");
    assert_eq!(tracking.devices.status()[0].state, DeviceState::Open);
    // The answer to a ping takes it back, and asks for the sensor.
    client.write_all(&[description(-2, 9, "vrpn_Base pong_message"), message(0, 0, 5, 9, &[])].concat()).unwrap();
    tracking.until("the answer", |it| {
        it.desk.tracker_advice(now).is_some_and(|told| told.starts_with("no pose comes from sensor 0 of Hand"))
    });
}

#[test]
fn a_server_that_answers_late_is_waited_for() {
    let server = Server::start();
    let mut tracking = Loop::track(&server.url());
    let mut client = server.accept();
    client.write_all(&unhex(COOKIE)[..10]).unwrap();
    std::thread::sleep(Duration::from_millis(600));
    client.write_all(&unhex(COOKIE)[10..]).unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    client.write_all(&descriptions()).unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    client.write_all(&pose(1, 0.25)).unwrap();
    until_at(&mut tracking, 0.25);
    assert!(tracking.replays_to_the_bit() > 0);
}
