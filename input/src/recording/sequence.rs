//! Order of a ride of the first format, whose messages are told apart by MCAP's sequence numbers alone.
//!
//! The recorder numbered the messages of all channels as one sequence. Programs that copy recordings keep those
//! numbers, count anew, count each channel by itself, or set all to zero. Each of these ways is followed as long as it
//! explains the numbers. Where numbers that were kept come in another order, the recorded one is restored; a number
//! that is missing leaves a hole, beyond which nothing is returned.

use std::collections::{BTreeMap, VecDeque};

use super::record::RecordingEntry;
use super::topic::RecordingTopic;

/// Number of entries without a number 0 after which another way of counting is believed.
const LONGEST_START: usize = 64;
/// Largest memory of messages that wait for an earlier one, bytes.
const MOST_WAITING: usize = 1 << 30;

/// Way of counting: the number that comes next, if this way explains all numbers so far.
#[derive(Clone, Copy, Debug, Default)]
enum Counting {
    /// No message has come yet. Counting begins at 0 or 1.
    #[default]
    New,
    Next(u32),
    Refuted,
}

impl Counting {
    fn explains(self, number: u32) -> bool {
        match self {
            Self::New => number <= 1,
            Self::Next(next) => number == next,
            Self::Refuted => false,
        }
    }

    /// Counts a message; this way of counting is refuted if it does not explain the number.
    fn count(&mut self, number: u32) {
        *self = if self.explains(number) { Self::Next(number.wrapping_add(1)) } else { Self::Refuted };
    }

    /// True if the number lies beyond the next one.
    fn is_beyond(self, number: u32) -> bool {
        match self {
            Self::New => number > 1,
            Self::Next(next) => number > next,
            Self::Refuted => false,
        }
    }
}

/// Entries of the first format, in the order of their numbers.
#[derive(Debug, Default)]
pub(super) struct Sequence {
    /// All messages of the ride are counted.
    ride: Counting,
    /// All messages of the file are counted.
    file: Counting,
    /// Each channel is counted by itself.
    channels: [Counting; RecordingTopic::ALL.len()],
    channels_refuted: bool,
    /// Entries that wait for an earlier one, with the number of the ride.
    held: BTreeMap<u32, RecordingEntry>,
    waiting: usize,
    unnumbered: bool,
    /// First entries as they came, while none had the number 0, and their numbers.
    start: Vec<(u32, RecordingEntry)>,
}

impl Sequence {
    /// Counts a message of a channel that is not of the ride.
    pub(super) fn other(&mut self, number: u32) {
        self.file.count(number);
    }

    /// Takes a message, and moves the entries whose turn has come to `ready`.
    ///
    /// # Errors
    /// A sentence: messages are missing.
    pub(super) fn take(
        &mut self,
        topic: RecordingTopic,
        number: u32,
        entry: RecordingEntry,
        ready: &mut VecDeque<RecordingEntry>,
    ) -> Result<(), String> {
        if self.unnumbered {
            ready.push_back(entry);
            return Ok(());
        }
        if matches!(self.ride, Counting::New) {
            return self.begin(topic, number, entry, ready);
        }
        let channel = self.channels[topic as usize];
        let channels_explain = !self.channels_refuted && channel.explains(number);
        if self.ride.explains(number) || self.file.explains(number) || channels_explain {
            let held_back = !self.held.is_empty();
            self.ride.count(number);
            self.file.count(number);
            self.channels[topic as usize].count(number);
            self.channels_refuted |= !channels_explain;
            ready.push_back(entry);
            if held_back {
                self.release(ready);
            }
            return Ok(());
        }
        if self.ride.is_beyond(number) {
            // Either the order is another, or messages are missing; the end will tell.
            (self.file, self.channels_refuted) = (Counting::Refuted, true);
            self.waiting += entry.memory();
            if self.held.insert(number, entry).is_some() || self.waiting > MOST_WAITING {
                return Err(self.missing());
            }
            return Ok(());
        }
        if !self.held.is_empty() || self.file.is_beyond(number) || (!self.channels_refuted && channel.is_beyond(number))
        {
            return Err(format!("message {number} does not follow the one before: some are missing"));
        }
        // The numbers say nothing.
        self.unnumbered = true;
        ready.push_back(entry);
        Ok(())
    }

    /// Takes an entry while none had the number 0: copies may count from 1, or may have put others first.
    fn begin(
        &mut self,
        topic: RecordingTopic,
        number: u32,
        entry: RecordingEntry,
        ready: &mut VecDeque<RecordingEntry>,
    ) -> Result<(), String> {
        self.file.count(number);
        self.channels_refuted |= !self.channels[topic as usize].explains(number);
        self.channels[topic as usize].count(number);
        if number > 0 {
            let is_twice = self.start.iter().any(|(earlier, _)| *earlier == number);
            self.start.push((number, entry));
            if is_twice || self.start.len() >= LONGEST_START {
                self.decide(ready);
            }
            return Ok(());
        }
        self.ride.count(number);
        ready.push_back(entry);
        for (number, entry) in std::mem::take(&mut self.start) {
            (self.file, self.channels_refuted) = (Counting::Refuted, true);
            self.waiting += entry.memory();
            if self.held.insert(number, entry).is_some() {
                return Err(self.missing());
            }
        }
        self.release(ready);
        Ok(())
    }

    /// Decides how entries are counted of which none has the number 0.
    fn decide(&mut self, ready: &mut VecDeque<RecordingEntry>) {
        let file_explains = matches!(self.file, Counting::Next(_));
        let ride_explains = (1..).zip(&self.start).all(|(expected, (number, _))| *number == expected);
        let start = std::mem::take(&mut self.start);
        if file_explains || ride_explains || !self.channels_refuted {
            let next = u32::try_from(start.len()).unwrap_or(u32::MAX) + 1;
            self.ride = if ride_explains { Counting::Next(next) } else { Counting::Refuted };
            ready.extend(start.into_iter().map(|(_, entry)| entry));
        } else {
            // The first message is missing, or comes later.
            self.ride = Counting::Next(0);
            self.waiting += start.iter().map(|(_, entry)| entry.memory()).sum::<usize>();
            self.held.extend(start);
        }
    }

    /// Checks at the end that no entry waits for one that is missing.
    ///
    /// # Errors
    /// A sentence: messages are missing.
    pub(super) fn finish(&mut self, ready: &mut VecDeque<RecordingEntry>) -> Result<(), String> {
        if !self.start.is_empty() {
            self.decide(ready);
        }
        if self.held.is_empty() { Ok(()) } else { Err(self.missing()) }
    }

    fn missing(&self) -> String {
        let expected = if let Counting::Next(next) = self.ride { next } else { 0 };
        let found = self.held.first_key_value().map_or(expected, |(number, _)| *number);
        format!("message {found} follows where {expected} should: some are missing")
    }

    /// Moves the held entries whose turn has come to `ready`.
    fn release(&mut self, ready: &mut VecDeque<RecordingEntry>) {
        while let Counting::Next(next) = self.ride
            && let Some(entry) = self.held.remove(&next)
        {
            self.waiting = self.waiting.saturating_sub(entry.memory());
            self.ride.count(next);
            ready.push_back(entry);
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law: whatever way a copy was numbered, the ride is the one that was recorded, and a lost message is noticed as
    //! long as the numbers tell it.
    use super::*;
    use crate::sample::{Sample, SampleSource};

    const TOPICS: [RecordingTopic; 4] =
        [RecordingTopic::Samples, RecordingTopic::Samples, RecordingTopic::Controls, RecordingTopic::Frames];

    /// Messages of a ride: topic, number, and an entry that tells the number.
    fn ride() -> Vec<(RecordingTopic, u32, RecordingEntry)> {
        let entry = |number| RecordingEntry::Sample(Sample::opened(u64::from(number), SampleSource::Bicycle));
        (0..40).map(|number| (TOPICS[number as usize % TOPICS.len()], number, entry(number))).collect()
    }

    fn entries() -> Vec<RecordingEntry> {
        ride().into_iter().map(|(_, _, entry)| entry).collect()
    }

    fn taken(
        messages: impl IntoIterator<Item = (Option<RecordingTopic>, u32, RecordingEntry)>,
    ) -> (Vec<RecordingEntry>, Result<(), String>) {
        let (mut sequence, mut ready) = (Sequence::default(), VecDeque::new());
        for (topic, number, entry) in messages {
            match topic {
                None => sequence.other(number),
                Some(topic) => {
                    if let Err(what) = sequence.take(topic, number, entry, &mut ready) {
                        return (ready.into(), Err(what));
                    }
                }
            }
        }
        let outcome = sequence.finish(&mut ready);
        (ready.into(), outcome)
    }

    /// Ride numbered by `number`, which is given the topic and the place.
    fn renumbered(
        mut number: impl FnMut(RecordingTopic, u32) -> u32,
    ) -> Vec<(Option<RecordingTopic>, u32, RecordingEntry)> {
        ride().into_iter().map(|(topic, place, entry)| (Some(topic), number(topic, place), entry)).collect()
    }

    /// Numbers that count each channel from `first`.
    fn by_channel(first: u32) -> impl FnMut(RecordingTopic, u32) -> u32 {
        let mut counts = [first; 3];
        move |topic, _| {
            counts[topic as usize] += 1;
            counts[topic as usize] - 1
        }
    }

    #[test]
    fn every_way_of_counting_gives_the_ride() {
        for (way, messages) in [
            ("as recorded", renumbered(|_, place| place)),
            ("from one", renumbered(|_, place| place + 1)),
            ("by channel", renumbered(by_channel(0))),
            ("by channel from one", renumbered(by_channel(1))),
            ("all zero", renumbered(|_, _| 0)),
        ] {
            assert_eq!(taken(messages), (entries(), Ok(())), "{way}");
        }
    }

    #[test]
    fn another_channel_counts_with_the_ride_or_by_itself() {
        let note = entries()[0].clone();
        for own in [false, true] {
            let mut messages = Vec::new();
            let (mut all, mut ours) = (0, 0);
            for (topic, place, entry) in ride() {
                if place % 5 == 3 {
                    messages.push((None, if own { place / 5 } else { all }, note.clone()));
                    all += 1;
                }
                messages.push((Some(topic), if own { ours } else { all }, entry));
                (all, ours) = (all + 1, ours + 1);
            }
            assert_eq!(taken(messages), (entries(), Ok(())), "own: {own}");
        }
    }

    #[test]
    fn numbers_that_were_kept_restore_the_order() {
        // One channel after the other, in both orders.
        let mut messages = renumbered(|_, place| place);
        messages.sort_by_key(|(topic, ..)| topic.map(|topic| topic as usize));
        assert_eq!(taken(messages.clone()), (entries(), Ok(())));
        messages.reverse();
        assert_eq!(taken(messages), (entries(), Ok(())));
        // The first messages exchanged, as times may demand it.
        for first in [1, 2, 3] {
            let mut messages = renumbered(|_, place| place);
            messages[..=first].rotate_left(1);
            assert_eq!(taken(messages), (entries(), Ok(())), "{first}");
        }
    }

    #[test]
    fn a_ride_without_its_beginning_is_noticed() {
        let mut messages = renumbered(|_, place| place);
        messages.drain(..8);
        let (found, outcome) = taken(messages);
        assert!(found.is_empty() && outcome.is_err(), "{found:?}");
    }

    #[test]
    fn a_lost_message_is_noticed_and_nothing_after_it_is_returned() {
        for (way, mut messages) in
            [("as recorded", renumbered(|_, place| place)), ("by channel", renumbered(by_channel(0)))]
        {
            messages.drain(12..20);
            let (found, outcome) = taken(messages);
            assert_eq!(found, entries()[..12], "{way}");
            assert!(outcome.unwrap_err().contains("some are missing"), "{way}");
        }
    }
}
