//! Order of a ride, restored from messages that carry their numbers.
//!
//! Another program may have sorted the messages by time, or written one channel after the other. What counts is each
//! channel's own numbering: samples are numbered, controls say how many samples came before them, and the frame of
//! the same number follows the controls. A message that is missing leaves a hole, beyond which nothing is returned.

use std::collections::{BTreeMap, VecDeque};

use super::record::{ControlsRecord, FrameRecord, RecordingEntry};
use crate::sample::Sample;

/// Largest memory of messages that wait for an earlier one, bytes.
const MOST_WAITING: usize = 1 << 30;

/// Messages in any order, made into the entries of a ride.
#[derive(Debug, Default)]
pub(super) struct Assembly {
    samples: BTreeMap<u64, Sample>,
    /// Controls by their frame, each with the number of samples before them.
    controls: BTreeMap<u64, (u64, ControlsRecord)>,
    frames: BTreeMap<u64, FrameRecord>,
    /// Numbers of the entries that are to be returned next.
    next_sample: u64,
    next_controls: u64,
    next_frame: u64,
    /// Memory of the waiting messages, bytes.
    waiting: usize,
}

impl Assembly {
    /// Takes a sample with its number.
    ///
    /// # Errors
    /// A sentence: the number was there already.
    pub(super) fn sample(&mut self, number: u64, sample: Sample) -> Result<(), String> {
        self.wait(RecordingEntry::Sample(sample.clone()).memory())?;
        let is_new = number >= self.next_sample && self.samples.insert(number, sample).is_none();
        if is_new { Ok(()) } else { Err(twice("sample", number)) }
    }

    /// Takes the controls of a frame, which `samples` came before.
    ///
    /// # Errors
    /// A sentence: the frame's controls were there already.
    pub(super) fn controls(&mut self, samples: u64, record: ControlsRecord) -> Result<(), String> {
        let frame = record.frame;
        self.wait(RecordingEntry::Controls(record.clone()).memory())?;
        let is_new = frame >= self.next_controls && self.controls.insert(frame, (samples, record)).is_none();
        if is_new { Ok(()) } else { Err(twice("the controls of frame", frame)) }
    }

    /// Takes a frame.
    ///
    /// # Errors
    /// A sentence: the frame was there already.
    pub(super) fn frame(&mut self, record: FrameRecord) -> Result<(), String> {
        let frame = record.frame;
        self.wait(size_of::<RecordingEntry>())?;
        let is_new = frame >= self.next_frame && self.frames.insert(frame, record).is_none();
        if is_new { Ok(()) } else { Err(twice("frame", frame)) }
    }

    /// Moves the entries whose turn has come to `ready`.
    pub(super) fn drain(&mut self, ready: &mut VecDeque<RecordingEntry>) {
        // A frame comes after its controls, and before those of the next.
        loop {
            if self.next_frame < self.next_controls {
                if !self.put_frame(ready) {
                    return;
                }
            } else if !self.put_controls(ready) {
                return;
            }
        }
    }

    /// Moves the remaining entries to `ready`, once no more messages come.
    ///
    /// # Errors
    /// A sentence that names what is missing, if entries remain that come after it.
    pub(super) fn finish(&mut self, ready: &mut VecDeque<RecordingEntry>) -> Result<(), String> {
        // A ride may end before the frame, and entries may be recorded without frames.
        loop {
            let has_hole = !self.put_frame(ready) && !self.frames.is_empty();
            if has_hole || !self.put_controls(ready) {
                break;
            }
        }
        if self.frames.is_empty() && self.controls.is_empty() {
            while self.put_sample(ready) {}
        }
        if self.frames.is_empty() && self.controls.is_empty() && self.samples.is_empty() {
            return Ok(());
        }
        Err(if self.controls.contains_key(&self.next_controls) && self.next_frame == self.next_controls {
            format!("sample {} is missing", self.next_sample)
        } else if self.next_frame < self.next_controls && !self.frames.is_empty() {
            format!("frame {} is missing", self.next_frame)
        } else if !self.frames.is_empty() || !self.controls.is_empty() {
            format!("the controls of frame {} are missing", self.next_controls)
        } else {
            format!("sample {} is missing", self.next_sample)
        })
    }

    /// Counts the memory of a message.
    fn wait(&mut self, memory: usize) -> Result<(), String> {
        self.waiting += memory;
        if self.waiting <= MOST_WAITING {
            return Ok(());
        }
        Err(format!(
            "too much waits for an earlier message: sample {}, frame {} or its controls are missing",
            self.next_sample, self.next_frame
        ))
    }

    fn put(&mut self, entry: RecordingEntry, ready: &mut VecDeque<RecordingEntry>) -> bool {
        self.waiting = self.waiting.saturating_sub(entry.memory());
        ready.push_back(entry);
        true
    }

    fn put_sample(&mut self, ready: &mut VecDeque<RecordingEntry>) -> bool {
        let Some(sample) = self.samples.remove(&self.next_sample) else { return false };
        self.next_sample += 1;
        self.put(RecordingEntry::Sample(sample), ready)
    }

    /// Puts the next controls, once all samples before them are there.
    fn put_controls(&mut self, ready: &mut VecDeque<RecordingEntry>) -> bool {
        let Some(&(samples, _)) = self.controls.get(&self.next_controls) else { return false };
        while self.next_sample < samples {
            if !self.put_sample(ready) {
                return false;
            }
        }
        let Some((_, record)) = self.controls.remove(&self.next_controls) else { return false };
        self.next_controls += 1;
        self.put(RecordingEntry::Controls(record), ready)
    }

    /// Puts the next frame. A frame without controls follows none.
    fn put_frame(&mut self, ready: &mut VecDeque<RecordingEntry>) -> bool {
        if self.next_frame >= self.next_controls {
            return false;
        }
        let Some(record) = self.frames.remove(&self.next_frame) else { return false };
        self.next_frame += 1;
        self.put(RecordingEntry::Frame(record), ready)
    }
}

fn twice(what: &str, number: u64) -> String {
    format!("{what} {number} is there twice; are two rides in this file?")
}

#[cfg(test)]
mod tests {
    //! Law: in whatever order the messages come, the ride has the one order in which it was recorded, up to the first
    //! message that is missing.
    use super::*;
    use crate::sample::SampleSource;
    use proptest::prelude::*;

    /// Entry of a ride, with its number, and for controls the number of samples before.
    type Numbered = (u64, u64, RecordingEntry);

    fn ride(frames: u64) -> Vec<Numbered> {
        let mut entries = Vec::new();
        let mut samples = 0;
        for frame in 0..frames {
            for _ in 0..frame % 3 {
                // The time of a sample may lie before the frame, or after.
                let sample = Sample::bytes(frame * 7 % 5, SampleSource::Bicycle, [samples as u8]);
                entries.push((samples, 0, RecordingEntry::Sample(sample)));
                samples += 1;
            }
            let controls = ControlsRecord { frame, at: frame, ..Default::default() };
            entries.push((frame, samples, RecordingEntry::Controls(controls)));
            entries.push((frame, 0, RecordingEntry::Frame(FrameRecord { frame, at: frame, ..Default::default() })));
        }
        entries
    }

    fn assembled(entries: &[Numbered]) -> (Vec<RecordingEntry>, Result<(), String>) {
        let (mut assembly, mut ready) = (Assembly::default(), VecDeque::new());
        for (number, samples, entry) in entries {
            match entry.clone() {
                RecordingEntry::Sample(sample) => assembly.sample(*number, sample),
                RecordingEntry::Controls(record) => assembly.controls(*samples, record),
                RecordingEntry::Frame(record) => assembly.frame(record),
            }
            .unwrap();
            assembly.drain(&mut ready);
        }
        let outcome = assembly.finish(&mut ready);
        (ready.into(), outcome)
    }

    fn entries(ride: &[Numbered]) -> Vec<RecordingEntry> {
        ride.iter().map(|(_, _, entry)| entry.clone()).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn any_order_gives_the_order_of_the_ride(
            shuffled in Just(ride(12)).prop_shuffle(),
        ) {
            prop_assert_eq!(assembled(&shuffled), (entries(&ride(12)), Ok(())));
        }

        #[test]
        fn what_comes_after_a_hole_is_not_returned(hole in 0..30_usize) {
            let ride = ride(12);
            let mut holed = ride.clone();
            holed.remove(hole);
            let (found, outcome) = assembled(&holed);
            prop_assert!(found.len() <= hole && found[..] == entries(&ride)[..found.len()]);
            prop_assert!(outcome.unwrap_err().contains("missing"));
        }
    }

    #[test]
    fn entries_come_as_soon_as_their_turn_has_come() {
        let (mut assembly, mut ready) = (Assembly::default(), VecDeque::new());
        assembly.sample(0, Sample::opened(0, SampleSource::Bicycle)).unwrap();
        assembly.frame(FrameRecord::default()).unwrap();
        assembly.drain(&mut ready);
        assert!(ready.is_empty());
        assembly.controls(1, ControlsRecord::default()).unwrap();
        assembly.drain(&mut ready);
        assert_eq!((ready.len(), assembly.waiting), (3, 0));
    }

    #[test]
    fn a_number_that_comes_twice_is_told() {
        let mut assembly = Assembly::default();
        assembly.frame(FrameRecord::default()).unwrap();
        assert!(assembly.frame(FrameRecord::default()).unwrap_err().contains("two rides"));
    }
}
