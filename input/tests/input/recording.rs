//! A recording must be read back to the last bit, by this program and by others, and whatever devices send. A wrong
//! program would replay a ride that never was.

use std::collections::BTreeMap;
use std::fs;

use input::recording::{Recorder, Recording, RecordingEntry, RecordingError, RideHeader};
use input::{Controls, Desk, DeskConfig, KeyboardKey, SECOND, Sample, SampleSource};
use proptest::prelude::*;

use crate::recordings::{assert_same_bits, data_end, header, place, put, read, read_bytes, record, ride, short_ride};

#[test]
fn what_is_written_is_read_to_the_last_bit() {
    let (_directory, path) = place();
    let entries = ride(100);
    record(&path, &entries);
    assert_eq!(Recording::open(&path).unwrap().header(), &header());
    let (found, error) = read(&path);
    assert!(error.is_none(), "{error:?}");
    assert_same_bits(&found, &entries);
}

/// Recording of the first format, kept from an older program.
#[test]
fn old_recordings_read_to_the_same_bits() {
    let (found, error) = read_bytes(include_bytes!("recordings/format_1.bin"));
    assert!(error.is_none(), "{error:?}");
    assert_same_bits(&found, &ride(3));
}

#[test]
fn a_recording_of_nothing_is_a_recording() {
    let (_directory, path) = place();
    record(&path, &[]);
    let (found, error) = read(&path);
    assert!(found.is_empty() && error.is_none());
}

#[test]
fn samples_out_of_order_stay_in_the_order_of_the_desk() {
    let (_directory, path) = place();
    let entries = [3, 1, 2].map(|at| RecordingEntry::Sample(Sample::key(at, KeyboardKey::A, true)));
    record(&path, &entries);
    assert_eq!(read(&path).0, entries);
}

/// Ride of an hour that is recorded while it goes on.
#[test]
fn what_came_before_the_file_is_written_first_however_much() {
    let (_directory, path) = place();
    let press = |at| RecordingEntry::Sample(Sample::key(at, KeyboardKey::W, at % 2 == 0));
    let past: Vec<_> = (0..50_000).map(press).collect();
    let mut recorder = Recorder::create(&path, &header()).unwrap();
    recorder.past(past.clone()).unwrap();
    (50_000..50_100).for_each(|at| put(&mut recorder, &press(at)));
    recorder.finish().unwrap();
    let (found, error) = read(&path);
    assert!(error.is_none(), "{error:?}");
    assert_eq!(found.len(), 50_100);
    assert_eq!(found[..50_000], past);
}

/// Reader of the specification's own library, which must find channels, schemas and times.
#[test]
fn others_read_it_too() {
    let (_directory, path) = place();
    let entries = ride(100);
    record(&path, &entries);
    let bytes = fs::read(&path).unwrap();
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    assert_eq!(summary.stats.unwrap().message_count, entries.len() as u64 + 101);
    assert_eq!(summary.metadata_indexes.len(), 1);
    let mut topics = BTreeMap::new();
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        *topics.entry(message.channel.topic.clone()).or_insert(0) += 1;
        if message.channel.topic == "/device/raw" {
            assert_eq!((message.channel.message_encoding.as_str(), &message.channel.schema), ("cbor", &None));
            let samples: ciborium::Value = ciborium::from_reader(&*message.data).unwrap();
            let bytes = samples.as_map().unwrap().iter().find(|(key, _)| key.as_text() == Some("bytes")).unwrap();
            assert!(bytes.1.is_bytes());
            continue;
        }
        let schema = message.channel.schema.as_ref().unwrap();
        assert_eq!((message.channel.message_encoding.as_str(), schema.encoding.as_str()), ("json", "jsonschema"));
        serde_json::from_slice::<serde_json::Value>(&schema.data).unwrap();
        serde_json::from_slice::<serde_json::Value>(&message.data).unwrap();
    }
    let expected = [("/controls", 100), ("/device/raw", 100), ("/observer", 100), ("/pose", 100), ("/tf", 1)];
    assert_eq!(topics, BTreeMap::from(expected.map(|(topic, count)| (topic.to_owned(), count))));
}

/// Times of a wall clock date the messages; the ride's own time stays in them.
#[test]
fn messages_are_dated_since_1970() {
    const BEGAN: u64 = 1_700_000_000_123_456_789;
    let (_directory, path) = place();
    let mut recorder = Recorder::create(&path, &header()).unwrap();
    recorder.began(BEGAN).unwrap();
    ride(5).iter().for_each(|entry| put(&mut recorder, entry));
    recorder.finish().unwrap();
    let bytes = fs::read(&path).unwrap();
    let mut frames = 0;
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        let value = || serde_json::from_slice::<serde_json::Value>(&message.data).unwrap();
        match message.channel.topic.as_str() {
            "/controls" | "/observer" => {
                let at = value()["at"].as_u64().unwrap();
                assert_eq!((message.log_time, message.publish_time), (BEGAN + at, BEGAN + at));
            }
            "/pose" => {
                let (pose, third) = (value(), 1.0 / (3.0 + f64::from(frames)));
                let nanoseconds = pose["timestamp"]["nsec"].as_u64().unwrap();
                assert_eq!(pose["timestamp"]["sec"].as_u64().unwrap() * SECOND + nanoseconds, message.log_time);
                assert_eq!(pose["pose"]["position"]["x"].as_f64().unwrap(), -third);
                frames += 1;
            }
            _ => {}
        }
    }
    assert_eq!(frames, 5);
}

#[test]
fn a_recording_without_a_beginning_is_dated_by_its_making() {
    let now = || std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_nanos() as u64;
    let (_directory, path) = place();
    let before = now();
    record(&path, &ride(2));
    let bytes = fs::read(&path).unwrap();
    let first = mcap::MessageStream::new(&bytes).unwrap().next().unwrap().unwrap().log_time;
    assert!((before..=now()).contains(&first), "{first}");
}

#[test]
fn the_desk_says_the_same_again() {
    let (_directory, path) = place();
    record(&path, &ride(200));
    let mut recording = Recording::open(&path).unwrap();
    let mut desk = Desk::new(recording.header().desk.clone()).unwrap();
    let mut frames = 0;
    for entry in &mut recording {
        match entry.unwrap() {
            RecordingEntry::Sample(sample) => desk.feed(&sample),
            RecordingEntry::Controls(record) => {
                assert_eq!(desk.controls(record.at), record.controls, "frame {}", record.frame);
            }
            RecordingEntry::Frame(_) => frames += 1,
        }
    }
    assert_eq!(frames, 200);
}

#[test]
fn a_header_that_cannot_be_read_back_is_refused_before_the_ride() {
    let (_directory, path) = place();
    let nonsense = RideHeader { step_s: f64::NAN, ..header() };
    let text = Recorder::create(&path, &nonsense).unwrap_err().to_string();
    assert!(text.starts_with("cannot write") && text.contains("null"), "{text}");
    assert!(!path.exists(), "the name must stay free");
}

#[test]
fn nothing_is_written_over() {
    let (directory, path) = place();
    fs::write(&path, "precious").unwrap();
    assert!(matches!(Recorder::create(&path, &header()), Err(RecordingError::Exists { .. })));
    assert_eq!(fs::read(&path).unwrap(), b"precious");
    assert!(matches!(Recorder::create(directory.path(), &header()), Err(RecordingError::Directory { .. })));
    let nowhere = directory.path().join("no/such/ride.mcap");
    assert!(Recorder::create(&nowhere, &header()).unwrap_err().to_string().starts_with("cannot create"));
}

/// Bytes that any device might send, good or bad.
fn any_bytes() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        proptest::collection::vec(any::<u8>(), 0..80),
        "[0-9,.*B1-]{0,40}\n".prop_map(String::into_bytes),
        (any::<u32>(), any::<u32>(), any::<i64>()).prop_map(|(count, time, raw)| {
            input::line::sealed(&format!("B1,0,{time},{count},{time},{count},{time},{raw},{raw}")).into_bytes()
        }),
        (0..4_u8, proptest::collection::vec(any::<u8>(), 12)).prop_map(|(id, rest)| [vec![id], rest].concat()),
    ]
}

fn any_sample() -> impl Strategy<Value = Sample> {
    let source = proptest::sample::select(SampleSource::ALL.to_vec());
    (any::<u64>(), source, any_bytes(), 0..20_u8).prop_map(|(at, source, bytes, kind)| {
        let at = at % (100 * SECOND);
        match kind {
            0 => Sample::opened(at, source),
            1 => Sample::closed(at, source),
            _ => Sample::bytes(at, source, bytes),
        }
    })
}

fn is_sound(controls: &Controls) -> bool {
    let unit = |value: &f64| (-1.0..=1.0).contains(value);
    controls.wheel_speed.is_none_or(f64::is_finite)
        && controls.cadence_hz.is_none_or(|cadence| cadence.is_finite() && cadence >= 0.0)
        && controls.steer_rad.is_finite()
        && (0.0..=1.0).contains(&controls.brake)
        && controls.thrust.iter().chain(&controls.turn).all(unit)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// Controls must stay in their ranges, whatever devices send, and a recording must give the same controls again.
    #[test]
    fn any_noise_gives_sound_controls_and_the_same_again(samples in proptest::collection::vec(any_sample(), 1..60)) {
        let (_directory, path) = place();
        let mut desk = Desk::new(DeskConfig::default()).unwrap();
        let mut recorder = Recorder::create(&path, &header()).unwrap();
        for (frame, sample) in (0..).zip(&samples) {
            desk.feed(sample);
            recorder.sample(sample).unwrap();
            let controls = desk.controls(sample.at);
            prop_assert!(is_sound(&controls), "{controls:?}");
            recorder.controls(frame, sample.at, &controls).unwrap();
        }
        recorder.finish().unwrap();

        let mut again = Desk::new(DeskConfig::default()).unwrap();
        for entry in Recording::open(&path).unwrap() {
            match entry.unwrap() {
                RecordingEntry::Sample(sample) => again.feed(&sample),
                RecordingEntry::Controls(record) => prop_assert_eq!(again.controls(record.at), record.controls),
                RecordingEntry::Frame(_) => prop_assert!(false, "there was no frame"),
            }
        }
    }

    /// A hostile file must end in an error, whatever its records claim to be and to hold.
    #[test]
    fn hostile_files_are_refused(
        records in proptest::collection::vec((0..20_u8, any::<u64>(), 0..3_u8, any_bytes()), 0..8),
        whole_start in any::<bool>(),
    ) {
        let (bytes, _) = short_ride();
        let mut hostile = if whole_start { bytes[..data_end(&bytes) / 2].to_vec() } else { bytes[..8].to_vec() };
        for (kind, claimed, honest, body) in records {
            hostile.push(kind);
            let length = if honest > 0 { body.len() as u64 } else { claimed };
            hostile.extend_from_slice(&length.to_le_bytes());
            hostile.extend_from_slice(&body);
        }
        prop_assert!(read_bytes(&hostile).1.is_some());
    }
}
