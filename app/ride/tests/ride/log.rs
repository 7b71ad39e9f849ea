//! Law: a log that cannot be written any further says so once when it happens, and again at the end of the ride;
//! and the memory of a ride is bounded by bytes, and its past reaches back to its beginning. A recording has
//! frames, or is not there.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::path::Path;
use std::time::{Duration, Instant};

use input::recording::{Recording, RecordingEntry};
use input::{DeskConfig, SECOND, Sample, SampleSource, VehicleKind};
use ride::{LightSpeed, LogError, RideLog, RideStart, Setup, Simulation, VehicleSettings};
use scene::OpenPlane;

/// Ride, and its log.
struct LoggedRide {
    simulation: Simulation,
    log: RideLog,
    frames: u64,
}

impl LoggedRide {
    fn new() -> Self {
        let setup = Setup {
            light_speed: LightSpeed::OLD_TOWN,
            kind: VehicleKind::Fly,
            start: RideStart::at_rest(glam::DVec3::ZERO, glam::DVec3::NEG_Z, glam::DVec3::Y),
            vehicle: VehicleSettings::default(),
            desk: DeskConfig::default(),
        };
        let log = RideLog::new(setup.header("0.1.0 (test)", "plane"));
        Self { simulation: Simulation::new(setup, std::sync::Arc::new(OpenPlane)).unwrap(), log, frames: 0 }
    }

    /// Rides a frame in which a device says so many bytes.
    fn frame(&mut self, bytes: usize) -> Result<(), LogError> {
        let at = self.frames * SECOND / 60;
        self.frames += 1;
        let samples = [Sample::bytes(at, SampleSource::Bicycle, vec![b'x'; bytes])];
        let frame = self.simulation.frame(at, &samples);
        self.log.frame(&samples, &frame)
    }

    /// Rides on until a frame cannot be written; its sentence.
    fn until_told(&mut self) -> String {
        let began = Instant::now();
        loop {
            match self.frame(1) {
                Ok(()) => assert!(began.elapsed() < Duration::from_secs(20), "nothing was told"),
                Err(error) => return error.to_string(),
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

fn frames(path: &Path) -> usize {
    let entries = Recording::open(path).unwrap();
    entries.filter(|entry| matches!(entry, Ok(RecordingEntry::Frame(_)))).count()
}

/// A file that is removed while it is written takes the ride with it.
#[cfg(unix)]
#[test]
fn a_removed_file_is_told_when_it_happens_and_at_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ride.mcap");
    let mut ride = LoggedRide::new();
    ride.log.record(&path).unwrap();
    ride.frame(1).unwrap();
    std::fs::remove_file(&path).unwrap();
    let told = ride.until_told();
    assert!(told.contains("was removed or replaced"), "{told}");
    // The ride goes on, without another word.
    assert!(!ride.log.is_recording());
    ride.frame(1).unwrap();

    // What is remembered can be recorded into another file, and the end tells of the first all the same.
    let other = folder.path().join("other.mcap");
    ride.log.record(&other).unwrap();
    ride.log.stop().unwrap();
    assert_eq!(frames(&other) as u64, ride.frames);
    assert!(matches!(ride.log.finish(), Err(LogError::Incomplete { path: told }) if told == path));
}

#[test]
fn a_recording_that_is_whole_ends_without_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ride.mcap");
    let mut ride = LoggedRide::new();
    ride.frame(1).unwrap();
    ride.log.record(&path).unwrap();
    ride.frame(1).unwrap();
    ride.log.finish().unwrap();
    assert_eq!(frames(&path), 2);
}

/// A program that is ended while its windows open has ridden nothing: whoever ends it, and however.
#[test]
fn a_ride_without_a_frame_leaves_no_recording() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ride.mcap");
    let mut ride = LoggedRide::new();
    ride.log.record(&path).unwrap();
    assert!(ride.log.is_recording() && ride.log.awaited() == Some(&path) && !path.exists());
    ride.log.finish().unwrap();
    assert!(!ride.log.is_recording() && !path.exists());

    ride.log.record(&path).unwrap();
    ride.frame(1).unwrap();
    assert!(ride.log.is_recording() && ride.log.awaited().is_none());
    ride.log.finish().unwrap();
    assert_eq!(frames(&path), 1);
}

#[test]
fn a_place_where_nothing_can_be_recorded_is_told_before_the_ride() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ride.mcap");
    std::fs::write(&path, "another").unwrap();
    let mut ride = LoggedRide::new();
    for (path, expected) in [
        (&path, "exists already"),
        (&folder.path().to_owned(), "is a directory"),
        (&path.join("none"), "cannot create"),
    ] {
        let told = ride.log.record(path).unwrap_err().to_string();
        assert!(told.contains(expected), "{told}");
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "another");

    // A file that comes in between is told with the first frame and at the end, and stays.
    let other = folder.path().join("other.mcap");
    ride.log.record(&other).unwrap();
    std::fs::write(&other, "another").unwrap();
    assert!(ride.frame(1).unwrap_err().to_string().contains("exists already"));
    ride.frame(1).unwrap();
    assert!(matches!(ride.log.finish(), Err(LogError::Incomplete { path }) if path == other));
    assert_eq!(std::fs::read_to_string(&other).unwrap(), "another");
}

/// Ride whose past of so many megabytes is kept in this folder.
fn long_ride(folder: &Path, megabytes: u64) -> LoggedRide {
    let mut ride = LoggedRide::new();
    ride.log = ride.log.keep_past_in(folder.to_owned());
    (0..megabytes / 4).for_each(|_| ride.frame(4 << 20).unwrap());
    ride
}

fn entries(path: &Path) -> Vec<RecordingEntry> {
    Recording::open(path).unwrap().collect::<Result<_, _>>().unwrap()
}

/// A device that sends megabytes must not fill the memory, and hours must be recorded all the same.
#[test]
fn a_long_ride_is_recorded_from_its_beginning_at_any_time() {
    let folder = tempfile::tempdir().unwrap();
    let past = folder.path().join("past");
    let mut ride = LoggedRide::new();
    ride.log = ride.log.keep_past_in(past.clone());
    let whole = folder.path().join("whole.mcap");
    ride.log.record(&whole).unwrap();
    let kept = |expected: usize| {
        let files = std::fs::read_dir(&past).map_or(0, Iterator::count);
        assert_eq!(files, expected, "temporary recordings");
    };
    (0..10).for_each(|_| ride.frame(4 << 20).unwrap());
    kept(0);
    (0..10).for_each(|_| ride.frame(4 << 20).unwrap());
    kept(1);
    ride.log.stop().unwrap();

    let [early, late] = ["early.mcap", "late.mcap"].map(|name| folder.path().join(name));
    ride.log.record(&early).unwrap();
    (0..3).for_each(|_| ride.frame(100).unwrap());
    ride.log.stop().unwrap();
    (0..3).for_each(|_| ride.frame(100).unwrap());
    ride.log.record(&late).unwrap();
    ride.log.finish().unwrap();
    assert_eq!((frames(&whole), frames(&early), frames(&late)), (20, 23, 26));
    // The same entries to the last bit, whatever way they took.
    let (whole, late) = (entries(&whole), entries(&late));
    assert!(late.len() == 26 * 3 && whole == late[..whole.len()]);
    drop(ride);
    kept(0);
}

#[test]
fn a_copy_that_is_removed_is_told_when_it_happens() {
    let folder = tempfile::tempdir().unwrap();
    let mut ride = long_ride(folder.path(), 80);
    let path = folder.path().join("late.mcap");
    ride.log.record(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let told = ride.until_told();
    assert!(told.contains("was removed or replaced"), "{told}");
    assert!(matches!(ride.log.finish(), Err(LogError::Incomplete { path: told }) if told == path));
}

#[test]
fn a_past_that_has_no_place_is_told_when_it_is_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let blocked = folder.path().join("a file");
    std::fs::write(&blocked, "").unwrap();
    let mut ride = long_ride(&blocked, 80);
    let told = ride.log.record(&folder.path().join("late.mcap")).unwrap_err().to_string();
    assert!(told.contains("no longer remembered (cannot create") && told.contains("--record FILE"), "{told}");
}

/// A program that was killed leaves its temporary recording; the next one removes it, but none that is in use.
#[test]
fn remnants_of_other_programs_are_removed() {
    let folder = tempfile::tempdir().unwrap();
    let [old, used, other] = ["past-ride-1-0.mcap", "past-ride-2-0.mcap", "my ride.mcap"].map(|name| {
        let path = folder.path().join(name);
        let file = std::fs::File::create(&path).unwrap();
        file.set_modified(std::time::SystemTime::now() - Duration::from_secs(3600)).unwrap();
        (path, file)
    });
    used.1.lock_shared().unwrap();
    let ride = long_ride(folder.path(), 80);
    assert!(!old.0.exists() && used.0.exists() && other.0.exists());
    drop(ride);
}
