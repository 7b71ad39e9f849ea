//! Recordings for tests: rides made and written, by this program and by others, and their bytes taken apart.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use input::recording::{ControlsRecord, FrameRecord, Recorder, Recording, RecordingEntry, RecordingError, RideHeader};
use input::{Desk, DeskConfig, KeyboardKey, SECOND, Sample, SampleSource, VehicleKind};

pub(super) fn header() -> RideHeader {
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
pub(super) fn ride(frames: u64) -> Vec<RecordingEntry> {
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

pub(super) fn put(recorder: &mut Recorder, entry: &RecordingEntry) {
    match entry {
        RecordingEntry::Sample(sample) => recorder.sample(sample),
        RecordingEntry::Controls(record) => recorder.controls(record.frame, record.at, &record.controls),
        RecordingEntry::Frame(record) => recorder.frame(record),
    }
    .unwrap();
}

pub(super) fn record(path: &Path, entries: &[RecordingEntry]) {
    let mut recorder = Recorder::create(path, &header()).unwrap();
    entries.iter().for_each(|entry| put(&mut recorder, entry));
    recorder.finish().unwrap();
}

/// Entries that can be read, and the error at the end.
pub(super) fn read(path: &Path) -> (Vec<RecordingEntry>, Option<RecordingError>) {
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
pub(super) fn read_bytes(bytes: &[u8]) -> (Vec<RecordingEntry>, Option<RecordingError>) {
    let memory = Path::new("/dev/shm");
    let directory = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() }.unwrap();
    let path = directory.path().join("ride.mcap");
    fs::write(&path, bytes).unwrap();
    read(&path)
}

/// Directory, and the path of a recording in it.
pub(super) fn place() -> (tempfile::TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("ride.mcap");
    (directory, path)
}

/// Bytes of a short ride, and its entries.
pub(super) fn short_ride() -> (Vec<u8>, Vec<RecordingEntry>) {
    let (_directory, path) = place();
    let entries = ride(3);
    record(&path, &entries);
    (fs::read(&path).unwrap(), entries)
}

/// Compares entries; the numbers of frames by their bits.
pub(super) fn assert_same_bits(found: &[RecordingEntry], expected: &[RecordingEntry]) {
    assert_eq!(found, expected);
    for (found, expected) in found.iter().zip(expected) {
        if let (RecordingEntry::Frame(found), RecordingEntry::Frame(expected)) = (found, expected) {
            assert_eq!(found.first_difference(expected), None);
        }
    }
}

/// Options of another program that copies a recording.
pub(super) fn options() -> mcap::WriteOptions {
    mcap::WriteOptions::new().profile("rapidity").compression(None)
}

/// Description of the ride in a recording.
pub(super) fn description(bytes: &[u8]) -> mcap::records::Metadata {
    let summary = mcap::Summary::read(bytes).unwrap().unwrap();
    mcap::read::metadata(bytes, &summary.metadata_indexes[0]).unwrap()
}

/// Messages of a recording.
pub(super) fn messages(bytes: &[u8]) -> Vec<mcap::Message<'_>> {
    mcap::MessageStream::new(bytes).unwrap().map(Result::unwrap).collect()
}

/// Bytes of a file by another program, with what `fill` writes.
pub(super) fn made(options: mcap::WriteOptions, fill: impl FnOnce(&mut OtherWriter)) -> Vec<u8> {
    let mut writer = options.create(std::io::Cursor::new(Vec::new())).unwrap();
    fill(&mut writer);
    writer.finish().unwrap();
    writer.into_inner().into_inner()
}

/// Writer of another program.
pub(super) type OtherWriter = mcap::Writer<std::io::Cursor<Vec<u8>>>;

/// Bytes of a copy of a recording by another program, with a note at its end.
pub(super) fn copied(bytes: &[u8], options: mcap::WriteOptions) -> Vec<u8> {
    made(options, |copy| {
        copy.write_metadata(&description(bytes)).unwrap();
        messages(bytes).iter().for_each(|message| copy.write(message).unwrap());
        copy.write_metadata(&mcap::records::Metadata { name: "notes".to_owned(), metadata: BTreeMap::new() }).unwrap();
    })
}

/// Recordings of both formats, with their entries.
pub(super) fn both_formats() -> [(Vec<u8>, Vec<RecordingEntry>); 2] {
    [short_ride(), (include_bytes!("recordings/format_1.bin").to_vec(), ride(3))]
}

/// Checks that a copy is read as the recording was.
#[track_caller]
pub(super) fn assert_same_ride(what: &str, copy: &[u8], entries: &[RecordingEntry]) {
    let (found, error) = read_bytes(copy);
    assert!(error.is_none(), "{what}: {error:?}");
    assert_same_bits(&found, entries);
}

/// Places of every byte of the data, and of some of the index behind it.
pub(super) fn places(bytes: &[u8]) -> impl Iterator<Item = usize> {
    let data_end = data_end(bytes);
    (0..data_end).chain((data_end..bytes.len()).step_by(50))
}

/// Outermost records: beginning, kind and end of each.
pub(super) fn records(bytes: &[u8]) -> impl Iterator<Item = (usize, u8, usize)> {
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
pub(super) fn data_end(bytes: &[u8]) -> usize {
    records(bytes).find(|(_, kind, _)| *kind == 0x0f).unwrap().2
}
