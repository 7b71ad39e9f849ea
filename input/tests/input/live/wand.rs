//! Tests with a wand over real sockets: a VRPN server's sensor, buttons and channels, and a flystick of DTrack.
//!
//! What is pressed must be held, what is released let go, and a tracker that dies must let go of everything. A wrong
//! program would keep a button pressed, take another device's, or lose the newest state in a flood.

use std::io::Write;
use std::net::{TcpStream, UdpSocket};
use std::time::{Duration, Instant};

use super::frames::Loop;
use super::vrpn::{Server, description, descriptions, expect, message, pose};
use input::head::Tracking;
use input::{HeadConfig, HeldButtons, SampleSource, WandConfig, WandState};

/// Numbers that the test's server gives: to the wand, and to the types.
const WAND: i32 = 7;
const BUTTON: i32 = 10;
const BUTTONS: i32 = 11;
const CHANNELS: i32 = 12;

fn wand_descriptions() -> Vec<u8> {
    let types = [(BUTTON, "vrpn_Button Change"), (BUTTONS, "vrpn_Button States"), (CHANNELS, "vrpn_Analog Channel")];
    let types = types.map(|(number, name)| description(-2, number, name)).concat();
    [descriptions(), description(-1, WAND, "Wand"), types].concat()
}

fn change(sender: i32, button: i32, state: i32) -> Vec<u8> {
    message(1, 0, sender, BUTTON, &[button.to_be_bytes(), state.to_be_bytes()].concat())
}

fn states(states: &[i32]) -> Vec<u8> {
    let words = [states.len() as i32].into_iter().chain(states.iter().copied());
    message(1, 0, WAND, BUTTONS, &words.flat_map(i32::to_be_bytes).collect::<Vec<_>>())
}

fn channels(values: &[f64]) -> Vec<u8> {
    let words = [values.len() as f64].into_iter().chain(values.iter().copied());
    message(1, 0, WAND, CHANNELS, &words.flat_map(f64::to_be_bytes).collect::<Vec<_>>())
}

fn track(url: &str, wand: WandConfig) -> Loop {
    Loop::track_head(HeadConfig { wand: Some(wand), ..HeadConfig::new(url.parse().unwrap()) })
}

/// Head's sensor 0 is on the hand, and the device "Wand" in it.
fn hand() -> WandConfig {
    WandConfig { buttons: Some("Wand".to_owned()), trigger: Some(2), ..Default::default() }
}

fn wand(it: &mut Loop) -> WandState {
    *it.controls().wand.unwrap()
}

fn until_held(tracking: &mut Loop, bits: u64) {
    tracking.until(&format!("buttons {bits:b}"), |it| wand(it).buttons == HeldButtons(bits));
}

fn greet(server: &Server) -> TcpStream {
    let mut client = server.greet();
    client.write_all(&wand_descriptions()).unwrap();
    client
}

#[test]
fn a_wands_devices_are_named_and_pinged() {
    let server = Server::start();
    let _tracking = track(&server.url(), WandConfig { axes: Some("Stick".to_owned()), ..hand() });
    let mut client = server.greet();
    let hex = |bytes: Vec<u8>| bytes.iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    for (number, name) in (0..).zip(["Head", "Wand", "Stick"]) {
        expect(&mut client, &hex(description(-1, number, name)));
    }
    for (number, name) in (0..).zip(["vrpn_Base ping_message", "vrpn_Base pong_message"]) {
        expect(&mut client, &hex(description(-2, number, name)));
    }
    for number in [0, 1, 2, 0, 1, 2] {
        expect(&mut client, &hex(message(0, 0, number, 0, &[])));
    }
}

#[test]
fn pose_buttons_and_stick_arrive_however_they_are_cut_and_a_server_that_dies_lets_go() {
    let server = Server::start();
    let mut tracking = track(&server.url(), hand());
    for session in 0..2 {
        let mut client = greet(&server);
        let stream = [
            pose(1000 * session, 0.25),
            change(WAND, 0, 1),
            change(1, 5, 1),
            change(WAND, 3, 1),
            channels(&[0.5, -2.0, 0.75]),
        ];
        for byte in stream.concat() {
            client.write_all(&[byte]).unwrap();
        }
        tracking.until("the trigger", |it| wand(it).trigger == 0.75);
        let seen = wand(&mut tracking);
        assert_eq!((seen.position_m.to_array(), seen.tracked), ([0.25, 1.5, 0.0], Tracking::Tracked));
        assert_eq!((seen.buttons, seen.stick), (HeldButtons(0b1001), [0.5, -1.0]));
        client.write_all(&change(WAND, 0, 0)).unwrap();
        until_held(&mut tracking, 0b1000);
        client.write_all(&states(&[0, 2, 1])).unwrap();
        until_held(&mut tracking, 0b110);
        // The server dies in the middle of a release.
        client.write_all(&change(WAND, 1, 0)[..30]).unwrap();
        drop(client);
        until_held(&mut tracking, 0);
        tracking.until("the loss", |it| wand(it).tracked == Tracking::Lost);
        let lost = wand(&mut tracking);
        assert_eq!((lost.position_m.x, lost.stick, lost.trigger), (0.25, [0.0; 2], 0.0));
    }
    assert_eq!(tracking.desk.faults(SampleSource::Vrpn).number(), 0);
    assert!(tracking.replays_to_the_bit() > 10);
}

#[test]
fn counts_that_lie_are_told_and_change_nothing() {
    let server = Server::start();
    let mut tracking = track(&server.url(), hand());
    let mut client = greet(&server);
    client.write_all(&[change(WAND, 2, 1), channels(&[0.0, 0.0, 0.5])].concat()).unwrap();
    until_held(&mut tracking, 0b100);
    let bad = [
        change(WAND, -1, 1),
        change(WAND, i32::MAX, 1),
        message(1, 0, WAND, BUTTON, &[0; 12]),
        message(1, 0, WAND, BUTTONS, &[0x7f, 0xff, 0xff, 0xff, 0, 0, 0, 1]),
        message(1, 0, WAND, BUTTONS, &[0xff; 64_000]),
        message(1, 0, WAND, CHANNELS, &1e300_f64.to_be_bytes()),
        message(1, 0, WAND, CHANNELS, &[0xff; 63_000]),
        message(1, 0, WAND, CHANNELS, &[]),
    ];
    client.write_all(&bad.concat()).unwrap();
    tracking.until("the faults", |it| it.desk.faults(SampleSource::Vrpn).number() == 8);
    let told = tracking.desk.faults(SampleSource::Vrpn).last().unwrap().to_owned();
    assert_eq!(told, "a `vrpn_Analog Channel` of Wand of 0 bytes");
    let seen = wand(&mut tracking);
    assert_eq!((seen.buttons, seen.trigger), (HeldButtons(0b100), 0.5));
    client.write_all(&channels(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY])).unwrap();
    tracking.until("no number", |it| wand(it).trigger == 0.0);
    assert_eq!(wand(&mut tracking).stick, [0.0; 2]);
    assert!(tracking.replays_to_the_bit() > 3);
}

#[test]
fn of_a_flood_of_buttons_the_newest_state_survives() {
    let server = Server::start();
    let mut tracking = track(&server.url(), hand());
    let mut client = greet(&server);
    let many: Vec<u8> =
        (0..10_000).flat_map(|n| [change(WAND, n % 4, n / 4 % 2), channels(&[0.1; 3])].concat()).collect();
    // A million messages within a second or two, which nobody drains.
    let began = Instant::now();
    for _ in 0..50 {
        client.write_all(&many).unwrap();
    }
    assert!(began.elapsed() < Duration::from_secs(20), "{:?}", began.elapsed());
    let last: Vec<u8> = (0..4).flat_map(|button| change(WAND, button, button % 2)).collect();
    client.write_all(&[last, channels(&[0.5; 3])].concat()).unwrap();
    tracking.until("the newest", |it| {
        let seen = wand(it);
        (seen.buttons, seen.trigger) == (HeldButtons(0b1010), 0.5)
    });
    assert!(tracking.devices.status()[0].dropped > 100_000);
    assert_eq!(tracking.desk.faults(SampleSource::Vrpn).number(), 0);
}

#[test]
fn a_mistaken_name_of_the_buttons_is_told() {
    let server = Server::start();
    let mut tracking = track(&server.url(), WandConfig { buttons: Some("Wnad".to_owned()), ..hand() });
    let mut client = greet(&server);
    client.write_all(&[pose(0, 0.5), change(WAND, 0, 1)].concat()).unwrap();
    let expected = "the server has no device \"Wnad\": a ping is not answered; \
                    the server sends sensor 0 of Head and buttons of Wand";
    tracking.until(expected, |it| {
        let now = it.clock.now();
        it.desk.tracker_advice(now).as_deref() == Some(expected)
    });
    assert_eq!(wand(&mut tracking).buttons, HeldButtons(0));
}

/// Frame of a controller: body 0 at x, and flystick 1 with these buttons and axes.
fn frame(number: u32, x_mm: f64, buttons: u32, axes: &str) -> String {
    let eye = "[1 0 0 0 1 0 0 0 1]";
    format!(
        "fr {number}\r\nts2 1795325065 {} 4200\r\n6dcal 1\r\n6d 1 [0 1.000][{x_mm} 0 0 0 0 0]{eye}\r\n\
         6df2 2 2 [0 1.000 4 2][9 9 9]{eye}[15 1 1] [1 1.000 6 2][{x_mm} 1000 -100]{eye}[{buttons} {axes}]\r\n",
        number * 16_667 % 1_000_000
    )
}

/// Loop that a controller sends to.
fn flystick() -> (Loop, impl Fn(&str)) {
    let port = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let wand = WandConfig { sensor: 1, ..Default::default() };
    let mut tracking = track(&format!("dtrack://127.0.0.1:{port}"), wand);
    tracking.until_open(true);
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    (tracking, move |text: &str| drop(socket.send_to(text.as_bytes(), ("127.0.0.1", port))))
}

#[test]
fn a_flysticks_buttons_and_stick_arrive_and_its_silence_lets_go() {
    let (mut tracking, send) = flystick();
    send(&frame(1, 400.0, 0b100_001, "0.25 -1.00"));
    until_held(&mut tracking, 0b100_001);
    let seen = wand(&mut tracking);
    assert_eq!((seen.position_m.to_array(), seen.tracked), ([0.4, 1.0, -0.1], Tracking::Tracked));
    assert_eq!((seen.stick, seen.trigger), ([0.25, -1.0], 0.0));
    send(&frame(2, 401.0, 0b10, "0 0"));
    until_held(&mut tracking, 0b10);
    // Out of the cameras' sight the buttons work, and the place stays.
    send(&frame(3, 402.0, 0b11, "0 0").replace("[1 1.000 6 2]", "[1 -1.000 6 2]"));
    until_held(&mut tracking, 0b11);
    assert_eq!(wand(&mut tracking).position_m.x, 0.401);
    // A line that lies is told, and harms neither the head nor what is held.
    send(&frame(4, 403.0, 0, "0 0").replace("[1 1.000 6 2]", "[1 1.000 4000000000 2]"));
    tracking.until("the fault", |it| it.desk.faults(SampleSource::Dtrack).number() == 1);
    assert_eq!((tracking.head().position_m.x, wand(&mut tracking).buttons), (0.403, HeldButtons(0b11)));
    until_held(&mut tracking, 0);
    assert!(tracking.replays_to_the_bit() > 5);
}

#[test]
fn of_a_flood_of_frames_the_newest_buttons_survive() {
    let (mut tracking, send) = flystick();
    for number in 0..20_000 {
        send(&frame(number, 400.0, number % 64, "1 1"));
    }
    std::thread::sleep(Duration::from_millis(100));
    let mut number = 20_000;
    tracking.until("the newest", |it| {
        // A datagram may be lost in a flood, as any may.
        number += 1;
        send(&frame(number, 500.0, 0b101_010, "0.5 0.5"));
        let seen = wand(it);
        (seen.buttons, seen.stick) == (HeldButtons(0b101_010), [0.5; 2])
    });
    assert_eq!(tracking.desk.faults(SampleSource::Dtrack).number(), 0);
}

#[test]
fn where_the_head_is_straightened_the_wand_keeps_its_place_before_it() {
    let port = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
    let head = HeadConfig {
        wand: Some(WandConfig { sensor: 1, ..Default::default() }),
        recentre: input::head::Recentring::Start,
        ..HeadConfig::new(format!("dtrack://127.0.0.1:{port}").parse().unwrap())
    };
    let mut tracking = Loop::track_head(head);
    tracking.until_open(true);
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    // The head at x = 0.4 m looks along −x: its matrix is a quarter turn to the left about y.
    let turned = frame(1, 400.0, 1, "0 0").replacen("[1 0 0 0 1 0 0 0 1]", "[0 0 -1 0 1 0 1 0 0]", 1);
    socket.send_to(turned.as_bytes(), ("127.0.0.1", port)).unwrap();
    until_held(&mut tracking, 1);
    let controls = tracking.controls();
    let (head, wand) = (controls.head.unwrap(), controls.wand.unwrap());
    // In the tracker's axes the wand is 1 m above and 0.1 m ahead of the head along −z, which is to its right.
    let between = wand.position_m - head.position_m;
    assert!((between - glam::DVec3::new(0.1, 1.0, 0.0)).length() < 1e-9, "{between}");
    assert!((wand.orientation * glam::DVec3::NEG_Z - glam::DVec3::X).length() < 1e-9, "{}", wand.orientation);
    assert!(tracking.replays_to_the_bit() > 1);
}
