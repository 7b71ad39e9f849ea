//! Of a damaged file every entry before the damage must be returned, none after it, and none that is false. A wrong
//! program would refuse a ride because its last second is missing, or crash on a hostile file.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use input::recording::{Recorder, Recording, RecordingEntry, RecordingError};
use input::{Sample, SampleSource};

use crate::recordings::{data_end, header, place, places, put, read, read_bytes, record, records, ride, short_ride};

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
