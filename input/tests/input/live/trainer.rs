//! Tests with a trainer through a real TCP connection, served by the test as a trainer with Direct Connect serves it.
//!
//! The requests must be those of the protocol, to the byte; a ride must arrive as its speed however the stream is cut
//! and however late it comes; floods, garbage, lying lengths, refusals and a trainer that dies must be survived, and
//! the trainer must be able to listen again at once. A wrong program would hang, saw, ride on without a trainer, or
//! leave its brake on.

use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::frames::Loop;
use crate::recordings::{assert_same_bits, place, read, record};
use input::devices::{DeviceNote, DeviceState};
use input::recording::{ControlsRecord, RecordingEntry};
use input::trainer::ControlRefusal;
use input::{Desk, DevicesConfig, RoadLoad, SECOND, Sample, SampleSource};

const FITNESS_MACHINE: u16 = 0x1826;
const INDOOR_BIKE_DATA: u16 = 0x2ad2;
const CONTROL_POINT: u16 = 0x2ad9;

fn uuid(short: u16) -> Vec<u8> {
    let [high, low] = short.to_be_bytes();
    [&[0, 0, high, low][..], &[0, 0, 0x10, 0, 0x80, 0, 0, 0x80, 0x5f, 0x9b, 0x34, 0xfb]].concat()
}

fn message(kind: u8, sequence: u8, data: &[u8]) -> Vec<u8> {
    let [high, low] = (data.len() as u16).to_be_bytes();
    [&[1, kind, sequence, 0, high, low], data].concat()
}

/// Notification of a speed in 0.01 km/h, 90 turns a minute and 200 W.
fn bike(speed: u16) -> Vec<u8> {
    let [low, high] = speed.to_le_bytes();
    message(6, 0, &[&uuid(INDOOR_BIKE_DATA)[..], &[0x44, 0, low, high, 180, 0, 200, 0]].concat())
}

/// What a client has asked, and the client itself, to send to.
#[derive(Default)]
struct Heard {
    /// Whole requests, in order.
    requests: Vec<Vec<u8>>,
    client: Option<TcpStream>,
}

/// Trainer that answers on a thread of its own, one client at a time.
struct Machine {
    address: SocketAddr,
    heard: Arc<Mutex<Heard>>,
    /// Services that it lists.
    services: Arc<Mutex<Vec<u16>>>,
    /// Result of what is written to its control point.
    result: Arc<AtomicU8>,
    running: Arc<()>,
    thread: Option<JoinHandle<()>>,
}

impl Machine {
    fn start() -> Self {
        let mut machine = Self {
            address: (Ipv4Addr::LOCALHOST, 0).into(),
            heard: Arc::default(),
            services: Arc::new(Mutex::new(vec![0x180a, FITNESS_MACHINE])),
            result: Arc::new(AtomicU8::new(1)),
            running: Arc::default(),
            thread: None,
        };
        machine.switch_on();
        machine
    }

    /// Listens at the address it has, without the permission to use one that lingers; within a second.
    fn switch_on(&mut self) {
        let start = Instant::now();
        let socket = loop {
            let socket = socket2::Socket::new(socket2::Domain::IPV4, socket2::Type::STREAM, None).unwrap();
            match socket.bind(&self.address.into()) {
                Ok(()) => break socket,
                Err(error) => assert!(start.elapsed() < Duration::from_secs(1), "{}: {error}", self.address),
            }
            std::thread::sleep(Duration::from_millis(10));
        };
        socket.listen(8).unwrap();
        let listener = TcpListener::from(socket);
        self.address = listener.local_addr().unwrap();
        listener.set_nonblocking(true).unwrap();
        self.running = Arc::new(());
        let running = Arc::downgrade(&self.running);
        let (heard, services, result) = (self.heard.clone(), self.services.clone(), self.result.clone());
        self.thread = Some(std::thread::spawn(move || {
            while running.strong_count() > 0 {
                match listener.accept() {
                    Ok((client, _)) => serve(&client, &heard, &services, &result, &|| running.strong_count() > 0),
                    Err(error) if error.kind() == ErrorKind::WouldBlock => {
                        std::thread::sleep(Duration::from_millis(2));
                    }
                    Err(_) => return,
                }
            }
        }));
    }

    /// Dies: its sockets are closed by the system.
    fn kill(&mut self) {
        self.running = Arc::default();
        self.thread.take().unwrap().join().unwrap();
        self.heard.lock().unwrap().client = None;
    }

    fn config(&self) -> DevicesConfig {
        let trainer = Some(format!("tcp://{}", self.address).parse().unwrap());
        DevicesConfig { trainer, space_mouse: false, gamepad: false, ..Default::default() }
    }

    /// Sends bytes to the client, if there is one.
    fn send(&self, bytes: &[u8]) {
        if let Some(client) = &mut self.heard.lock().unwrap().client {
            // A client that has gone is noticed elsewhere.
            let _ = client.write_all(bytes);
        }
    }

    /// Sends bytes one by one, with no answer among them.
    fn dribble(&self, bytes: &[u8]) {
        let mut heard = self.heard.lock().unwrap();
        let client = heard.client.as_mut().unwrap();
        for byte in bytes {
            client.write_all(&[*byte]).unwrap();
            std::thread::sleep(Duration::from_micros(300));
        }
    }

    /// Values written to the control point so far.
    fn written(&self) -> Vec<Vec<u8>> {
        let heard = self.heard.lock().unwrap();
        heard.requests.iter().filter(|request| request[1] == 4).map(|request| request[22..].to_vec()).collect()
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        if self.thread.is_some() {
            self.kill();
        }
    }
}

/// Serves one client until it or the trainer goes.
fn serve(
    mut client: &TcpStream,
    heard: &Mutex<Heard>,
    services: &Mutex<Vec<u16>>,
    result: &AtomicU8,
    runs: &dyn Fn() -> bool,
) {
    client.set_nonblocking(false).unwrap();
    client.set_nodelay(true).unwrap();
    client.set_read_timeout(Some(Duration::from_millis(5))).unwrap();
    let mut stream = Vec::new();
    while runs() {
        let mut buffer = [0; 256];
        match client.read(&mut buffer) {
            Ok(0) => return,
            Ok(length) => stream.extend_from_slice(&buffer[..length]),
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(_) => return,
        }
        while stream.len() >= 6 && stream.len() >= 6 + usize::from(u16::from_be_bytes([stream[4], stream[5]])) {
            let whole = 6 + usize::from(u16::from_be_bytes([stream[4], stream[5]]));
            let request: Vec<u8> = stream.drain(..whole).collect();
            let answers = answers(&request, &services.lock().unwrap(), result.load(Ordering::Relaxed));
            let mut heard = heard.lock().unwrap();
            if client.write_all(&answers).is_err() {
                return;
            }
            let last_of_greeting = request[1] == 5 && request[6..22] == uuid(INDOOR_BIKE_DATA);
            if last_of_greeting {
                heard.client = Some(client.try_clone().unwrap());
            }
            heard.requests.push(request);
        }
    }
}

/// Answers to a request.
fn answers(request: &[u8], services: &[u16], result: u8) -> Vec<u8> {
    let (kind, sequence, data) = (request[1], request[2], &request[6..]);
    match kind {
        1 => message(1, sequence, &services.iter().flat_map(|service| uuid(*service)).collect::<Vec<u8>>()),
        2 => {
            let list = [&uuid(0x2acc)[..], &[1], &uuid(INDOOR_BIKE_DATA), &[4], &uuid(CONTROL_POINT), &[6]].concat();
            message(2, sequence, &[data, &list].concat())
        }
        4 => {
            let indication = message(6, 0, &[&data[..16], &[0x80, data[16], result]].concat());
            [message(4, sequence, &data[..16]), indication].concat()
        }
        kind => message(kind, sequence, &data[..16]),
    }
}

fn wheel_speed(riding: &mut Loop) -> f64 {
    let now = riding.clock.now();
    riding.desk.controls(now).wheel_speed.unwrap_or(f64::NAN)
}

/// Runs frames while the trainer notifies a speed, in 0.01 km/h, until the ride has it.
fn until_at(riding: &mut Loop, machine: &Machine, speed: u16) {
    let metres = f64::from(speed) * 0.01 / 3.6;
    riding.until(&format!("a ride at {metres} m/s"), |it| {
        machine.send(&bike(speed));
        (wheel_speed(it) - metres).abs() < 1e-9
    });
}

fn until_absent(riding: &mut Loop, expected: &str) {
    riding.until(expected, |it| match &it.devices.status()[0].state {
        DeviceState::Absent(why) => why.to_string().contains(expected),
        DeviceState::Open => false,
    });
}

#[test]
fn the_requests_are_those_of_the_protocol_and_a_ride_arrives() {
    let machine = Machine::start();
    let mut riding = Loop::start(&machine.config());
    until_at(&mut riding, &machine, 3600);
    let now = riding.clock.now();
    let controls = riding.desk.controls(now);
    assert_eq!((controls.cadence_hz, riding.desk.trainer().power_w(now)), (Some(1.5), Some(200.0)));
    let status = &riding.devices.status()[0];
    assert_eq!((status.source, status.name.as_str(), &status.note), (SampleSource::Trainer, "trainer", &None));
    assert_eq!((&status.state, &status.path), (&DeviceState::Open, &format!("tcp://{}", machine.address)));
    assert_eq!(riding.desk.faults(SampleSource::Trainer).number(), 0);

    riding.until("the first load", |_| machine.written().len() > 2);
    let write = |value: &[u8]| [&uuid(CONTROL_POINT), value].concat();
    let expected = [
        message(1, 0, &[]),
        message(2, 1, &uuid(FITNESS_MACHINE)),
        message(5, 2, &[&uuid(INDOOR_BIKE_DATA)[..], &[1]].concat()),
        message(5, 3, &[&uuid(CONTROL_POINT)[..], &[1]].concat()),
        message(4, 4, &write(&[0])),
        message(4, 5, &write(&[7])),
        message(4, 6, &write(&[0x11, 0, 0, 0, 0, 40, 51])),
    ];
    assert_eq!(machine.heard.lock().unwrap().requests[..7], expected);
}

#[test]
fn the_road_is_told_to_the_byte_and_taken_back_at_the_end() {
    let machine = Machine::start();
    let mut riding = Loop::start(&machine.config());
    for (slope, brake, bytes) in
        [(-0.03, 0.0, [0xd4, 0xfe]), (0.1234, 0.0, [0xd2, 0x04]), (0.02, 1.0, [0xa4, 0x06]), (f64::NAN, 0.0, [0, 0])]
    {
        riding.until(&format!("a slope of {slope}"), |it| {
            it.devices.load(RoadLoad { slope, brake });
            machine.written().last() == Some(&vec![0x11, 0, 0, bytes[0], bytes[1], 40, 51])
        });
    }
    riding.devices.load(RoadLoad { slope: 0.3, brake: 0.0 });
    drop(riding);
    let written = machine.written();
    assert_eq!(written[written.len() - 2..], [vec![0x11, 0, 0, 0, 0, 40, 51], vec![1]]);
}

#[test]
fn the_road_is_told_a_few_times_a_second_however_it_changes() {
    let machine = Machine::start();
    let mut riding = Loop::start(&DevicesConfig { slope_felt_percent: 50, ..machine.config() });
    riding.until("control", |_| machine.written().len() > 2);
    let before = machine.written().len();
    let (start, mut slope) = (Instant::now(), 0.0);
    riding.until("two seconds of hills", |it| {
        slope += 0.0001;
        it.devices.load(RoadLoad { slope, brake: 0.0 });
        start.elapsed() > Duration::from_secs(2)
    });
    let told = machine.written().len() - before;
    assert!((3..=9).contains(&told), "{told} loads in two seconds");
    // Half of the slope is felt.
    riding.devices.load(RoadLoad { slope: 0.1, brake: 0.0 });
    riding.until("half", |_| machine.written().last().unwrap()[3..5] == 500_i16.to_le_bytes());
}

#[test]
fn the_stream_may_be_cut_anywhere() {
    let machine = Machine::start();
    let mut riding = Loop::start(&machine.config());
    riding.until_open(true);
    let stream: Vec<u8> = (0..8).flat_map(|n| [bike(1800), message(6, n, &uuid(0x2ada))].concat()).collect();
    machine.dribble(&stream);
    riding.until("the speed", |it| (wheel_speed(it) - 5.0).abs() < 1e-9);
    assert_eq!(riding.desk.faults(SampleSource::Trainer).number(), 0);
}

#[test]
fn notifications_once_a_second_and_late_are_a_steady_ride() {
    let machine = Machine::start();
    let mut riding = Loop::start(&machine.config());
    riding.until_open(true);
    let start = Instant::now();
    let mut sent = 0;
    let mut slowest = f64::INFINITY;
    riding.until("six seconds", |it| {
        // Each is late by another part of a third of a second.
        let due = Duration::from_millis(1000 * sent + sent * 7919 % 333);
        if start.elapsed() >= due {
            machine.send(&bike(3600));
            sent += 1;
        }
        let speed = wheel_speed(it);
        if !speed.is_nan() {
            slowest = slowest.min(speed);
        }
        start.elapsed() > Duration::from_secs(6)
    });
    assert!((slowest - 10.0).abs() < 0.1, "{slowest}");
}

#[test]
fn of_a_flood_the_newest_speed_survives() {
    let machine = Machine::start();
    let mut riding = Loop::start(&machine.config());
    riding.until_open(true);
    let many: Vec<u8> = std::iter::repeat_n(bike(1800), 1000).flatten().collect();
    // The stream of 30 MB is not drained.
    (0..1000).for_each(|_| machine.send(&many));
    riding.until("the flood", |it| it.devices.status()[0].dropped > 0);
    until_at(&mut riding, &machine, 720);
    assert_eq!(riding.desk.faults(SampleSource::Trainer).number(), 0);
    assert_eq!(riding.devices.status()[0].state, DeviceState::Open);
}

#[test]
fn a_trainer_that_is_killed_stops_the_ride_and_can_listen_again_at_once() {
    let mut machine = Machine::start();
    let mut riding = Loop::start(&machine.config());
    for speed in [1800, 2700] {
        until_at(&mut riding, &machine, speed);
        // It dies in the middle of a notification.
        machine.send(&bike(speed)[..11]);
        machine.kill();
        riding.until("the loss", |it| wheel_speed(it).is_nan());
        until_absent(&mut riding, "nothing listens there: switch the trainer on");
        machine.switch_on();
    }
    until_at(&mut riding, &machine, 3600);
    assert_eq!(riding.desk.faults(SampleSource::Trainer).number(), 0);
}

#[test]
fn a_trainer_that_refuses_control_is_ridden_and_the_refusal_told() {
    let machine = Machine::start();
    machine.result.store(5, Ordering::Relaxed);
    let mut riding = Loop::start(&machine.config());
    riding.until("the refusal", |it| it.devices.status()[0].note == Some(DeviceNote::NoControl(ControlRefusal::Taken)));
    until_at(&mut riding, &machine, 3600);
    assert_eq!(machine.written(), [vec![0]]);
    drop(riding);
    // What was asked for is taken back: the trainer may have changed its mind.
    assert_eq!(machine.written(), [vec![0], vec![0x11, 0, 0, 0, 0, 40, 51], vec![1]]);
}

#[test]
fn what_is_no_trainer_is_told_and_one_that_becomes_one_is_used() {
    let mut machine = Machine::start();
    let address = machine.address;
    machine.kill();
    let listener = TcpListener::bind(address).unwrap();
    let mut riding = Loop::start(&machine.config());
    for (says, told) in [
        (
            &b"HTTP/1.1 400 Bad Request\r\n\r\n"[..],
            "does not speak Direct Connect, version 1 (it sent \"HTTP/1.1 400 Bad",
        ),
        (&[1, 9, 0, 0, 0, 0], "message of kind 9"),
        (&[1, 1, 0, 0, 0xff, 0xff, 0], "message of 65535 bytes"),
        (&[1, 1, 0, 2, 0, 0], "it does not list its services: it reports an error without a reason"),
        (&[], "it has closed the connection; is another program connected to it?"),
    ] {
        let mut client = listener.accept().unwrap().0;
        // The request is read, or its bytes would turn the end into a reset.
        client.read_exact(&mut [0; 6]).unwrap();
        client.write_all(says).unwrap();
        drop(client);
        until_absent(&mut riding, told);
    }
    let silent = listener.accept().unwrap().0;
    until_absent(&mut riding, "it says nothing; is it a trainer with Direct Connect?");
    drop((silent, listener));
    *machine.services.lock().unwrap() = vec![0x180a, 0x1818];
    machine.switch_on();
    until_absent(&mut riding, "it has no fitness machine service (1826), but 180a, 1818; name a trainer with FTMS");
    machine.services.lock().unwrap().push(FITNESS_MACHINE);
    until_at(&mut riding, &machine, 3600);
}

#[test]
fn garbage_in_the_middle_of_a_ride_is_told_and_the_ride_goes_on_afterwards() {
    let machine = Machine::start();
    let mut riding = Loop::start(&machine.config());
    let mut seed = 1_u32;
    let random: Vec<u8> = std::iter::repeat_with(|| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 24) as u8
    })
    .take(100_000)
    .collect();
    let lying = [1, 6, 0, 0, 0x20, 0];
    for (garbage, told) in [(&random[..], "does not speak Direct Connect"), (&lying, "message of 8192 bytes")] {
        until_at(&mut riding, &machine, 3600);
        machine.send(garbage);
        until_absent(&mut riding, told);
    }
    until_at(&mut riding, &machine, 1800);
    // Good messages with bad contents are counted, and change nothing.
    machine.send(&message(6, 0, &[&uuid(INDOOR_BIKE_DATA)[..], &[0xff, 0x1f, 9]].concat()));
    machine.send(&message(6, 0, &[]));
    riding.until("the fault", |it| it.desk.faults(SampleSource::Trainer).number() == 1);
    assert_eq!(riding.devices.status()[0].state, DeviceState::Open);
}

#[test]
fn a_recorded_ride_replays_to_the_bit() {
    let mut machine = Machine::start();
    let mut riding = Loop::start(&machine.config());
    let mut entries = Vec::new();
    let (start, mut frame, mut killed) = (Instant::now(), 0, false);
    while start.elapsed() < Duration::from_secs(2) {
        machine.send(&bike(1800 + 10 * frame as u16));
        for sample in riding.devices.drain() {
            riding.desk.feed(&sample);
            entries.push(RecordingEntry::Sample(sample));
        }
        let at = riding.clock.now();
        let controls = riding.desk.controls(at);
        entries.push(RecordingEntry::Controls(ControlsRecord { frame, at, controls }));
        frame += 1;
        std::thread::sleep(Duration::from_millis(16));
        if start.elapsed() > Duration::from_secs(1) && !killed {
            machine.kill();
            machine.switch_on();
            killed = true;
        }
    }
    let opened = Sample::opened(0, SampleSource::Trainer).signal;
    let openings = |entry: &&RecordingEntry| matches!(entry, RecordingEntry::Sample(sample) if sample.signal == opened);
    assert!(entries.iter().filter(openings).count() >= 2, "the trainer has not come back");

    let (_directory, path) = place();
    record(&path, &entries);
    let (found, error) = read(&path);
    assert!(error.is_none(), "{error:?}");
    assert_same_bits(&found, &entries);
    let mut desk = Desk::new(Default::default()).unwrap();
    let mut fastest = 0.0_f64;
    for entry in found {
        match entry {
            RecordingEntry::Sample(sample) => desk.feed(&sample),
            RecordingEntry::Controls(ControlsRecord { at, controls, .. }) => {
                let again = desk.controls(at);
                assert_eq!(again.wheel_speed.map(f64::to_bits), controls.wheel_speed.map(f64::to_bits));
                assert_eq!(again.cadence_hz.map(f64::to_bits), controls.cadence_hz.map(f64::to_bits));
                fastest = fastest.max(again.wheel_speed.unwrap_or(0.0));
            }
            RecordingEntry::Frame(_) => {}
        }
    }
    assert!(fastest > 5.0 && riding.clock.now() > SECOND, "{fastest}");
}
