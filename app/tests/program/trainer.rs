//! Law: a trainer, through a real socket and the real program, is listed with what it measures, rides, feels the slope
//! of the road, and its ride replays to the same bits. A program that lost the trainer on its way would stand still;
//! one that forgot the road would tell it nothing but level ground.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use input::recording::{Recording, RecordingEntry};
use input::trainer::wire::{
    CAN_NOTIFY, CAN_WRITE, CHARACTERISTICS, CONTROL_POINT, DirectConnectMessage, FITNESS_MACHINE, HEADER_LENGTH,
    INDOOR_BIKE_DATA, NOTIFICATION, SERVICES, UUID_LENGTH, WRITE, uuid,
};

use crate::runner::{run, said, told};

/// Values that were written to the control point.
type WrittenValues = Arc<Mutex<Vec<Vec<u8>>>>;

/// Starts a trainer on which somebody rides at 18 km/h, 80 turns a minute and 150 W, told once a second. Returns its
/// address, and what is written to its control point.
fn serve() -> (String, WrittenValues) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let place = listener.local_addr().unwrap();
    let written = WrittenValues::default();
    let told = written.clone();
    std::thread::spawn(move || {
        for client in listener.incoming() {
            answer(client.unwrap(), &told);
        }
    });
    (format!("tcp://{place}"), written)
}

/// Serves one client until it goes.
fn answer(mut client: TcpStream, written: &WrittenValues) {
    let message = |kind, sequence, data: &[u8]| DirectConnectMessage { kind, sequence, response: 0, data }.to_bytes();
    let bike = message(NOTIFICATION, 0, &[&uuid(INDOOR_BIKE_DATA)[..], &[0x44, 0, 8, 7, 160, 0, 150, 0]].concat());
    client.set_read_timeout(Some(Duration::from_millis(10))).unwrap();
    let (mut stream, mut asked, mut due) = (Vec::new(), 0, Instant::now());
    loop {
        let mut buffer = [0; 256];
        match client.read(&mut buffer) {
            Ok(0) => return,
            Ok(length) => stream.extend_from_slice(&buffer[..length]),
            Err(_) => {}
        }
        while let Some(data) = stream.get(4..HEADER_LENGTH).map(|l| usize::from(u16::from_be_bytes([l[0], l[1]]))) {
            if stream.len() < HEADER_LENGTH + data {
                break;
            }
            let request: Vec<u8> = stream.drain(..HEADER_LENGTH + data).collect();
            let data = &request[HEADER_LENGTH..];
            let answer = match request[1] {
                SERVICES => uuid(FITNESS_MACHINE).to_vec(),
                CHARACTERISTICS => {
                    let records = [&uuid(INDOOR_BIKE_DATA)[..], &[CAN_NOTIFY], &uuid(CONTROL_POINT), &[CAN_WRITE]];
                    [data, &records.concat()].concat()
                }
                _ => data[..UUID_LENGTH].to_vec(),
            };
            let mut outcome = client.write_all(&message(request[1], request[2], &answer));
            if request[1] == WRITE {
                let value = &data[UUID_LENGTH..];
                written.lock().unwrap().push(value.to_vec());
                let obeyed = [&uuid(CONTROL_POINT)[..], &[0x80, value[0], 1]].concat();
                outcome = outcome.and_then(|()| client.write_all(&message(NOTIFICATION, 0, &obeyed)));
            }
            asked += 1;
            if outcome.is_err() {
                return;
            }
        }
        if asked > 2 && Instant::now() >= due {
            due = Instant::now() + Duration::from_secs(1);
            if client.write_all(&bike).is_err() {
                return;
            }
        }
    }
}

#[test]
fn a_trainer_is_listed_with_what_it_measures() {
    let folder = tempfile::tempdir().unwrap();
    let (trainer, _) = serve();
    let listed = run(folder.path(), &["devices", "--trainer", &trainer, "--seconds", "1.5"]);
    let text = said(&listed);
    assert!(listed.status.success(), "{}", told(&listed));
    assert!(text.contains(&format!("trainer     trainer {trainer}: ")) && text.contains(" 0 bad, 0 dropped"), "{text}");
    assert!(text.contains("\ntrainer 18 km/h · 80 rpm · 150 W\n"), "{text}");

    // Nobody listens at the first port of all.
    let text = said(&run(folder.path(), &["devices", "--trainer", "tcp://127.0.0.1:1", "--seconds", "0.5"]));
    assert!(text.contains("no trainer at tcp://127.0.0.1:1: nothing listens there: switch the trainer on"), "{text}");
}

/// Scene with a slope of 5 % uphill, on which the ride begins.
fn slope() -> String {
    let corners: [[f32; 3]; 4] =
        [[-200.0, -10.0, 200.0], [200.0, -10.0, 200.0], [200.0, 10.0, -200.0], [-200.0, 10.0, -200.0]];
    let mut bytes: Vec<u8> = corners.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|index| index.to_le_bytes()));
    let percent: String = bytes.iter().map(|byte| format!("%{byte:02x}")).collect();
    serde_json::json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.0, -0.9, 50.0]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": 60, "uri": format!("data:application/octet-stream,{percent}")}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
             "min": [-200.0, -10.0, -200.0], "max": [200.0, 10.0, 200.0]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
    })
    .to_string()
}

#[test]
fn a_ride_uphill_is_felt_and_replays_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("slope.gltf"), slope()).unwrap();
    let (trainer, written) = serve();
    let arguments = ["ride", "--scene", "slope.gltf", "--vehicle", "bicycle", "--realtime", "--seconds", "4"];
    let picture = ["--size", "64x36", "--samples", "1", "--out", "r.mp4", "--record", "r.mcap"];
    let felt = ["--trainer", &trainer, "--slope-felt", "50"];
    let ridden = run(folder.path(), &[&arguments[..], &picture, &felt].concat());
    assert!(ridden.status.success(), "{}", told(&ridden));

    // Half of 5 % is felt, and all is taken back at the end.
    let written = written.lock().unwrap().clone();
    assert!(written.contains(&vec![0x11, 0, 0, 250, 0, 40, 51]), "{written:?}");
    assert_eq!(written[written.len() - 2..], [vec![0x11, 0, 0, 0, 0, 40, 51], vec![1]]);

    // From the first number on, the wheel turns at 5 m/s without a tooth.
    let speeds: Vec<f64> = Recording::open(&folder.path().join("r.mcap"))
        .unwrap()
        .filter_map(|entry| match entry.unwrap() {
            RecordingEntry::Controls(record) => record.controls.wheel_speed,
            _ => None,
        })
        .collect();
    assert!(speeds.len() > 60 && speeds.iter().all(|speed| (speed - 5.0).abs() < 1e-9), "{speeds:?}");
    let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    assert!(verified.status.success() && said(&verified).contains("identical to the bit"), "{}", told(&verified));
}
