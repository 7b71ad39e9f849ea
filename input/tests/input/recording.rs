//! A recording must be read back to the last bit, by this program and by others; of a damaged file every entry before
//! the damage must be returned, none after it, and none that is false.
//!
//! A wrong program would replay a ride that never was, refuse a ride because its last second is missing, or crash on
//! a hostile file.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use input::recording::{ControlsRecord, FrameRecord, Recorder, Recording, RecordingEntry, RecordingError, RideHeader};
use input::{Controls, Desk, DeskConfig, KeyboardKey, SECOND, Sample, SampleSource, VehicleKind};
use proptest::prelude::*;

fn header() -> RideHeader {
    RideHeader {
        build: "0.1.0 (test)".to_owned(),
        scene: "town".to_owned(),
        speed_of_light_m_s: 30.0 / 3.6,
        vehicle: VehicleKind::Bicycle,
        integrator: "rk4".to_owned(),
        step_s: 1.0 / 240.0,
        desk: DeskConfig::default(),
        settings: BTreeMap::from([("seed".to_owned(), "1905".to_owned())]),
    }
}

/// Entries of a ride of this many frames.
fn ride(frames: u64) -> Vec<RecordingEntry> {
    let mut desk = Desk::new(DeskConfig::default()).unwrap();
    let mut entries = Vec::new();
    for frame in 0..frames {
        let at = frame * SECOND / 60;
        let sample = match frame {
            0 => Sample::key(at, KeyboardKey::W, true),
            1 => Sample::opened(at, SampleSource::Bicycle),
            _ => Sample::bytes(at, SampleSource::Bicycle, format!("{frame}\n").into_bytes()),
        };
        desk.feed(&sample);
        entries.push(RecordingEntry::Sample(sample));
        let controls = desk.controls(at);
        let third = 1.0 / (3.0 + frame as f64);
        entries.push(RecordingEntry::Controls(ControlsRecord { frame, at, controls }));
        entries.push(RecordingEntry::Frame(FrameRecord {
            frame,
            at,
            steps: 4,
            proper_time: third,
            position: [-third, -0.0, 1e-300],
            celerity: [1e12 * third, 0.0, 0.0],
            orientation: [0.0, 0.0, 0.0, 1.0],
            ..FrameRecord::default()
        }));
    }
    entries
}

fn put(recorder: &mut Recorder, entry: &RecordingEntry) {
    match entry {
        RecordingEntry::Sample(sample) => recorder.sample(sample),
        RecordingEntry::Controls(record) => recorder.controls(record.frame, record.at, &record.controls),
        RecordingEntry::Frame(record) => recorder.frame(record),
    }
    .unwrap();
}

fn record(path: &Path, entries: &[RecordingEntry]) {
    let mut recorder = Recorder::create(path, &header()).unwrap();
    entries.iter().for_each(|entry| put(&mut recorder, entry));
    recorder.finish().unwrap();
}

/// Entries that can be read, and the error at the end.
fn read(path: &Path) -> (Vec<RecordingEntry>, Option<RecordingError>) {
    let mut recording = match Recording::open(path) {
        Ok(recording) => recording,
        Err(error) => return (Vec::new(), Some(error)),
    };
    let mut entries = Vec::new();
    for entry in &mut recording {
        match entry {
            Ok(entry) => entries.push(entry),
            Err(error) => {
                assert!(recording.next().is_none(), "an error must be the last thing");
                return (entries, Some(error));
            }
        }
    }
    assert!(recording.next().is_none());
    (entries, None)
}

/// Entries that can be read from these bytes, and the error at the end. The tests do this thousands of times: in
/// memory, where the system offers it.
fn read_bytes(bytes: &[u8]) -> (Vec<RecordingEntry>, Option<RecordingError>) {
    let memory = Path::new("/dev/shm");
    let directory = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() }.unwrap();
    let path = directory.path().join("ride.mcap");
    fs::write(&path, bytes).unwrap();
    read(&path)
}

/// Directory, and the path of a recording in it.
fn place() -> (tempfile::TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("ride.mcap");
    (directory, path)
}

/// Bytes of a short ride, and its entries.
fn short_ride() -> (Vec<u8>, Vec<RecordingEntry>) {
    let (_directory, path) = place();
    let entries = ride(3);
    record(&path, &entries);
    (fs::read(&path).unwrap(), entries)
}

/// Compares entries; the numbers of frames by their bits.
fn assert_same_bits(found: &[RecordingEntry], expected: &[RecordingEntry]) {
    assert_eq!(found, expected);
    for (found, expected) in found.iter().zip(expected) {
        if let (RecordingEntry::Frame(found), RecordingEntry::Frame(expected)) = (found, expected) {
            assert_eq!(found.first_difference(expected), None);
        }
    }
}

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

/// Options of another program that copies a recording.
fn options() -> mcap::WriteOptions {
    mcap::WriteOptions::new().profile("rapidity").compression(None)
}

/// Description of the ride in a recording.
fn description(bytes: &[u8]) -> mcap::records::Metadata {
    let summary = mcap::Summary::read(bytes).unwrap().unwrap();
    mcap::read::metadata(bytes, &summary.metadata_indexes[0]).unwrap()
}

/// Messages of a recording.
fn messages(bytes: &[u8]) -> Vec<mcap::Message<'_>> {
    mcap::MessageStream::new(bytes).unwrap().map(Result::unwrap).collect()
}

/// Bytes of a file by another program, with what `fill` writes.
fn made(options: mcap::WriteOptions, fill: impl FnOnce(&mut OtherWriter)) -> Vec<u8> {
    let mut writer = options.create(std::io::Cursor::new(Vec::new())).unwrap();
    fill(&mut writer);
    writer.finish().unwrap();
    writer.into_inner().into_inner()
}

/// Writer of another program.
type OtherWriter = mcap::Writer<std::io::Cursor<Vec<u8>>>;

/// Bytes of a copy of a recording by another program, with a note at its end.
fn copied(bytes: &[u8], options: mcap::WriteOptions) -> Vec<u8> {
    made(options, |copy| {
        copy.write_metadata(&description(bytes)).unwrap();
        messages(bytes).iter().for_each(|message| copy.write(message).unwrap());
        copy.write_metadata(&mcap::records::Metadata { name: "notes".to_owned(), metadata: BTreeMap::new() }).unwrap();
    })
}

/// Copies by other programs, with other chunks or none, compressed, and without checksums, must read the same.
#[test]
fn a_recording_copied_by_another_program_is_the_same() {
    let (bytes, entries) = short_ride();
    for options in [
        options().use_chunks(false),
        options().chunk_size(Some(300)),
        options().calculate_chunk_crcs(false).calculate_data_section_crc(false),
        options().repeat_channels(false).emit_statistics(false).emit_message_indexes(false),
        options().compression(Some(mcap::Compression::Zstd)),
        options().compression(Some(mcap::Compression::Lz4)),
        // The name of the program lost.
        mcap::WriteOptions::new(),
    ] {
        let (found, error) = read_bytes(&copied(&bytes, options));
        assert!(error.is_none(), "{error:?}");
        assert_same_bits(&found, &entries);
    }
}

/// Recordings of both formats, with their entries.
fn both_formats() -> [(Vec<u8>, Vec<RecordingEntry>); 2] {
    [short_ride(), (include_bytes!("recordings/format_1.bin").to_vec(), ride(3))]
}

/// Checks that a copy is read as the recording was.
#[track_caller]
fn assert_same_ride(what: &str, copy: &[u8], entries: &[RecordingEntry]) {
    let (found, error) = read_bytes(copy);
    assert!(error.is_none(), "{what}: {error:?}");
    assert_same_bits(&found, entries);
}

/// Way of numbering messages.
type Numbering<'a> = dyn FnMut(&mcap::Message<'_>) -> u32 + 'a;

/// Copies number the messages anew: MCAP leaves that to the program.
#[test]
fn a_copy_may_number_the_messages_as_it_likes() {
    for (bytes, entries) in both_formats() {
        let mut counts = BTreeMap::new();
        let mut by_channel = |message: &mcap::Message<'_>| {
            let count = counts.entry(message.channel.id).or_insert(0);
            *count += 1;
            *count - 1
        };
        let mut count = 0;
        let mut from_one = |_: &mcap::Message<'_>| {
            count += 1;
            count
        };
        let ways: [(&str, &mut Numbering<'_>); 3] =
            [("by channel", &mut by_channel), ("from one", &mut from_one), ("zero", &mut |_| 0)];
        for (way, number) in ways {
            let copy = made(options(), |copy| {
                copy.write_metadata(&description(&bytes)).unwrap();
                for mut message in messages(&bytes) {
                    message.sequence = number(&message);
                    copy.write(&message).unwrap();
                }
            });
            assert_same_ride(way, &copy, &entries);
        }
    }
}

/// Copies may hold more than the ride: notes of their own between the messages, a picture, the description at the end.
#[test]
fn a_copy_may_hold_more_and_elsewhere() {
    for (bytes, entries) in both_formats() {
        let copy = made(options().chunk_size(Some(700)), |copy| {
            let (topic, message_encoding) = ("/notes".to_owned(), "json".to_owned());
            let channel = mcap::Channel { id: 77, topic, message_encoding, schema: None, metadata: BTreeMap::new() };
            let channel = std::sync::Arc::new(channel);
            for (sequence, message) in (0..).zip(messages(&bytes)) {
                if sequence % 2 == 0 {
                    let (channel, data) = (channel.clone(), b"{}"[..].into());
                    let (log_time, publish_time) = (message.log_time, message.log_time);
                    copy.write(&mcap::Message { channel, sequence, log_time, publish_time, data }).unwrap();
                }
                copy.write(&message).unwrap();
            }
            let (name, media_type) = ("helmet.txt".to_owned(), "text/plain".to_owned());
            let data = b"the rider wore a helmet"[..].into();
            copy.attach(&mcap::Attachment { log_time: 0, create_time: 0, name, media_type, data }).unwrap();
            copy.write_metadata(&description(&bytes)).unwrap();
        });
        assert_same_ride("more", &copy, &entries);
    }
}

/// Order of the file is nothing that MCAP promises: one channel after the other, or sorted by time.
#[test]
fn a_copy_may_have_another_order() {
    for (bytes, entries) in both_formats() {
        let by_channel = |message: &mcap::Message<'_>| (u64::from(message.channel.id), 0);
        let by_time = |message: &mcap::Message<'_>| (message.log_time, u64::from(message.channel.id));
        for order in [by_channel, by_time] {
            let copy = made(options(), |copy| {
                copy.write_metadata(&description(&bytes)).unwrap();
                let mut messages = messages(&bytes);
                messages.sort_by_key(order);
                messages.iter().for_each(|message| copy.write(message).unwrap());
            });
            assert_same_ride("sorted", &copy, &entries);
        }
    }
}

/// Without a summary, an index or checksums a file is still whole.
#[test]
fn a_copy_may_lack_all_that_is_optional() {
    for (bytes, entries) in both_formats() {
        let bare = options()
            .emit_summary_records(false)
            .emit_summary_offsets(false)
            .emit_message_indexes(false)
            .calculate_chunk_crcs(false)
            .calculate_data_section_crc(false)
            .calculate_summary_section_crc(false);
        assert_same_ride("bare", &copied(&bytes, bare), &entries);
    }
}

/// Two rides in one file must be noticed: whoever has joined them expects both.
#[test]
fn two_rides_in_one_file_are_noticed() {
    let (bytes, entries) = short_ride();
    let (_directory, path) = place();
    fs::write(&path, [bytes.clone(), bytes.clone()].concat()).unwrap();
    let mut recording = Recording::open(&path).unwrap();
    let found: Vec<_> = recording.by_ref().map(Result::unwrap).collect();
    assert_same_bits(&found, &entries);
    assert_eq!(recording.another(), Some(bytes.len() as u64));

    fs::write(&path, &bytes).unwrap();
    let mut recording = Recording::open(&path).unwrap();
    assert_eq!((recording.by_ref().count(), recording.another()), (entries.len(), None));

    // Messages of two rides, merged into one file, and the description of a second ride among them.
    let merged = made(options(), |copy| {
        copy.write_metadata(&description(&bytes)).unwrap();
        messages(&bytes).iter().chain(&messages(&bytes)).for_each(|message| copy.write(message).unwrap());
    });
    let (found, error) = read_bytes(&merged);
    assert_same_bits(&found, &entries);
    assert!(error.unwrap().to_string().contains("two rides"));
    let other = made(options(), |copy| {
        copy.write_metadata(&description(&bytes)).unwrap();
        let mut second = description(&bytes);
        second.metadata.insert("header".to_owned(), "{}".to_owned());
        copy.write_metadata(&second).unwrap();
    });
    assert!(matches!(read_bytes(&other).1, Some(RecordingError::Another { .. })));
}

/// A few compressed bytes that claim to be gigabytes must be refused before they fill the memory.
#[test]
fn a_chunk_that_unpacks_to_gigabytes_is_refused() {
    let (bytes, _) = short_ride();
    for has_checksum in [true, false] {
        let options = options().compression(Some(mcap::Compression::Zstd)).chunk_size(None);
        let bomb = made(options.calculate_chunk_crcs(has_checksum), |copy| {
            copy.write_metadata(&description(&bytes)).unwrap();
            let channel_id = copy.add_channel(0, "/notes", "json", &BTreeMap::new()).unwrap();
            let zeros = vec![0; 64 << 20];
            for sequence in 0..9 {
                let header = mcap::records::MessageHeader { channel_id, sequence, log_time: 0, publish_time: 0 };
                copy.write_to_known_channel(&header, &zeros).unwrap();
            }
        });
        assert!(bomb.len() < 1 << 20);
        let text = read_bytes(&bomb).1.unwrap().to_string();
        assert!(text.contains("the chunk holds"), "{text}");
    }
}

/// Damage of compressed data must be found before or after it is unpacked, and must not stop the program.
#[test]
fn a_flipped_bit_of_a_compressed_copy_is_found() {
    let (bytes, entries) = short_ride();
    for compression in [mcap::Compression::Zstd, mcap::Compression::Lz4] {
        let copy = copied(&bytes, options().compression(Some(compression)));
        for index in 0..data_end(&copy) {
            let mut damaged = copy.clone();
            damaged[index] ^= 1 << (index % 8);
            let (found, error) = read_bytes(&damaged);
            assert_eq!(found, entries[..found.len()], "bit {} of byte {index}", index % 8);
            assert!(error.is_some(), "bit {} of byte {index}", index % 8);
        }
    }
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

/// A crash must lose at most the last second: the copy of a file during the ride must hold all before.
#[test]
fn a_file_that_is_being_written_holds_all_but_the_last_second() {
    let (directory, path) = place();
    let entries = ride(40);
    let mut recorder = Recorder::create(&path, &header()).unwrap();
    entries.iter().for_each(|entry| put(&mut recorder, entry));
    let written = Instant::now();
    let copy = directory.path().join("copy.mcap");
    loop {
        fs::copy(&path, &copy).unwrap();
        let (found, error) = read(&copy);
        assert!(matches!(error, Some(RecordingError::CutOff { .. })), "{error:?}");
        assert_eq!(found, entries[..found.len()]);
        if found.len() == entries.len() {
            break;
        }
        // The limit is twice the promise, for a busy machine.
        assert!(written.elapsed() < Duration::from_secs(2), "{} of {}", found.len(), entries.len());
        std::thread::sleep(Duration::from_millis(20));
    }
    drop(recorder);
    assert!(read(&path).1.is_none(), "a dropped recorder finishes its file");
}

#[test]
fn of_a_file_cut_anywhere_everything_before_the_cut_is_read() {
    let (bytes, entries) = short_ride();
    let mut most = 0;
    for length in places(&bytes) {
        let (found, error) = read_bytes(&bytes[..length]);
        assert_eq!(found, entries[..found.len()], "cut at {length}");
        assert!(found.len() >= most, "cut at {length}");
        most = found.len();
        match error {
            // The index was cut, not the data.
            None => assert_eq!(found.len(), entries.len(), "cut at {length}"),
            Some(RecordingError::Empty { .. }) => assert_eq!(length, 0),
            Some(RecordingError::NotMcap { .. }) => assert!(length < 8),
            Some(RecordingError::CutOff { offset, .. }) => {
                // The error must name the record that is missing or incomplete.
                let begins = records(&bytes).map(|(begins, _, _)| begins).filter(|&begins| begins <= length).last();
                assert_eq!(Some(offset as usize), begins, "cut at {length}");
            }
            Some(other) => panic!("cut at {length}: {other}"),
        }
    }
    assert_eq!(most, entries.len());
}

#[test]
fn a_flipped_bit_anywhere_in_the_data_is_found_and_nothing_false_is_read() {
    let (bytes, entries) = short_ride();
    let data_end = data_end(&bytes);
    for index in places(&bytes) {
        let mut damaged = bytes.clone();
        damaged[index] ^= 1 << (index % 8);
        let (found, error) = read_bytes(&damaged);
        assert_eq!(found, entries[..found.len()], "bit {} of byte {index}", index % 8);
        if index < data_end {
            assert!(error.is_some(), "bit {} of byte {index}", index % 8);
        } else {
            assert!(error.is_none() && found.len() == entries.len(), "byte {index}: {error:?}");
        }
    }
}

/// Lengths and counts of four gigabytes at every place.
#[test]
fn a_length_of_gigabytes_anywhere_ends_in_a_sentence() {
    let (bytes, entries) = short_ride();
    for index in 0..data_end(&bytes) - 4 {
        let mut hostile = bytes.clone();
        hostile[index..index + 4].fill(0xff);
        let (found, error) = read_bytes(&hostile);
        assert_eq!(found, entries[..found.len()], "byte {index}");
        assert!(error.is_some(), "byte {index}");
    }
}

/// Places of every byte of the data, and of some of the index behind it.
fn places(bytes: &[u8]) -> impl Iterator<Item = usize> {
    let data_end = data_end(bytes);
    (0..data_end).chain((data_end..bytes.len()).step_by(50))
}

/// Outermost records: beginning, kind and end of each.
fn records(bytes: &[u8]) -> impl Iterator<Item = (usize, u8, usize)> {
    let mut begins = 8;
    std::iter::from_fn(move || {
        let header = bytes.get(begins..begins + 9)?;
        let length = u64::from_le_bytes(header[1..].try_into().unwrap());
        let record = (begins, header[0], begins + 9 + length as usize);
        begins = record.2;
        Some(record)
    })
}

/// End of the record that ends the data.
fn data_end(bytes: &[u8]) -> usize {
    records(bytes).find(|(_, kind, _)| *kind == 0x0f).unwrap().2
}

/// A recording that was cut off has no checksum over the whole, so a lost chunk must be noticed by itself.
#[test]
fn a_chunk_that_is_missing_is_noticed() {
    let (_directory, path) = place();
    // Four megabytes that cannot be compressed, in chunks of about one.
    let mut noise = 1_u64;
    let mut byte = || {
        noise = noise.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (noise >> 56) as u8
    };
    let mut loud = |at| {
        let bytes: Vec<u8> = (0..4000).map(|_| byte()).collect();
        RecordingEntry::Sample(Sample::bytes(at, SampleSource::Bicycle, bytes))
    };
    let entries: Vec<_> = (0..1000).map(&mut loud).collect();
    record(&path, &entries);
    let bytes = fs::read(&path).unwrap();
    let chunks: Vec<_> = records(&bytes).filter(|(_, kind, _)| *kind == 6).collect();
    // The first chunk holds the channels only.
    let [_, _, lost, kept, ..] = chunks[..] else { panic!("{} chunks", chunks.len()) };
    let holed = [&bytes[..lost.0], &bytes[lost.2..kept.2]].concat();
    let (found, error) = read_bytes(&holed);
    assert_eq!(found, entries[..found.len()]);
    assert!(!found.is_empty() && found.len() < entries.len());
    let text = error.unwrap().to_string();
    assert!(text.contains("missing"), "{text}");
}

/// A wrong speed of light must be noticed before the ride, not at its end.
#[test]
fn a_changed_header_is_refused_at_once() {
    let (bytes, _) = short_ride();
    let place_of_scene = bytes.windows(6).position(|text| text == b"\"town\"").unwrap();
    let mut changed = bytes;
    changed[place_of_scene + 1] = b'd';
    let (_directory, path) = place();
    fs::write(&path, changed).unwrap();
    let text = Recording::open(&path).unwrap_err().to_string();
    assert!(text.contains("`header` does not match its checksum"), "{text}");
}

#[test]
fn damage_is_told_with_its_place() {
    let (bytes, _) = short_ride();
    let chunk = records(&bytes).filter(|(_, kind, _)| *kind == 6).last().unwrap();
    let mut damaged = bytes;
    damaged[chunk.2 - 4] ^= 1;
    let text = read_bytes(&damaged).1.unwrap().to_string();
    assert!(text.contains("is damaged at byte") && text.contains("chunk"), "{text}");
}

#[test]
fn other_files_are_told_from_recordings() {
    let (directory, path) = place();
    let said = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        Recording::open(&path).unwrap_err().to_string()
    };
    assert!(said(b"").contains("is empty"));
    assert!(said(b"{\"asset\":{\"version\":\"2.0\"}}").contains("is not a recording"));
    assert!(said(b"\x89MCAP1\r\n").contains("is not a recording"));

    let mut foreign = mcap::WriteOptions::new().profile("ros2").create(std::io::Cursor::new(Vec::new())).unwrap();
    foreign.finish().unwrap();
    assert!(said(&foreign.into_inner().into_inner()).contains("of another program (profile \"ros2\""));

    let mut other = mcap::WriteOptions::new().create(std::io::Cursor::new(Vec::new())).unwrap();
    other.finish().unwrap();
    assert!(said(&other.into_inner().into_inner()).contains("of another program (profile \"\""));

    let nameless = mcap::WriteOptions::new().profile("rapidity").create(std::io::Cursor::new(Vec::new()));
    let mut nameless = nameless.unwrap();
    nameless.finish().unwrap();
    assert!(said(&nameless.into_inner().into_inner()).contains("the description of the ride is missing"));

    assert!(Recording::open(directory.path()).unwrap_err().to_string().contains("is a directory"));
    let missing = directory.path().join("missing.mcap");
    assert!(Recording::open(&missing).unwrap_err().to_string().starts_with("cannot open"));
    #[cfg(unix)]
    assert!(matches!(Recording::open(Path::new("/dev/zero")), Err(RecordingError::NotMcap { .. })));
}

#[test]
fn a_later_format_is_named() {
    let (bytes, _) = short_ride();
    let (_directory, path) = place();
    let key = b"format_version\x01\x00\x00\x00";
    let version = bytes.windows(key.len()).position(|text| text == key).unwrap() + key.len();
    let mut later = bytes;
    later[version] = b'3';
    fs::write(&path, later).unwrap();
    assert!(Recording::open(&path).unwrap_err().to_string().contains("has format \"3\""));
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
