//! Content of a recording: its messages, decoded and put into the order of the ride.

use std::collections::{BTreeMap, VecDeque};

use mcap::records::{MessageHeader, Record, op};
use serde::de::DeserializeOwned;

use super::assembly::Assembly;
use super::parse::parsed;
use super::record::{ControlsRecord, FrameRecord, ReadControls, RecordingEntry};
use super::sample_message::{FirstFormatSample, SampleMessage};
use super::sequence::Sequence;
use super::topic::RecordingTopic;
use crate::sample::Sample;

/// Way in which the messages of a file are put in order.
#[derive(Debug)]
enum RideOrder {
    /// By the numbers in the messages.
    Numbers(Box<Assembly>),
    /// By MCAP's sequence numbers, and the numbers of the frames that are to come next: controls and observer.
    Sequence { sequence: Box<Sequence>, controls: u64, frame: u64 },
}

/// Messages that have been read and not yet returned, and the channels known so far.
#[derive(Debug)]
pub(super) struct Content {
    /// Channels by their number; `None` for one that no replay needs.
    channels: BTreeMap<u16, Option<RecordingTopic>>,
    order: RideOrder,
    ready: VecDeque<RecordingEntry>,
}

impl Content {
    /// No messages yet, of a file of the present format.
    pub(super) fn new() -> Self {
        Self { channels: BTreeMap::new(), order: RideOrder::Numbers(Box::default()), ready: VecDeque::new() }
    }

    /// No messages yet, of a file of the first format.
    pub(super) fn of_first_format() -> Self {
        let order = RideOrder::Sequence { sequence: Box::default(), controls: 0, frame: 0 };
        Self { order, ..Self::new() }
    }

    /// Next entry of the ride, if it is there.
    ///
    /// # Errors
    /// A sentence: a frame is missing.
    pub(super) fn next(&mut self) -> Result<Option<RecordingEntry>, String> {
        let Some(entry) = self.ready.pop_front() else { return Ok(None) };
        if let RideOrder::Sequence { controls, frame, .. } = &mut self.order {
            let (what, found, expected) = match &entry {
                RecordingEntry::Sample(_) => return Ok(Some(entry)),
                RecordingEntry::Controls(record) => ("the controls of frame", record.frame, controls),
                RecordingEntry::Frame(record) => ("frame", record.frame, frame),
            };
            if found != *expected {
                self.ready.clear();
                return Err(format!("{what} {found} follows where {expected} should: some are missing"));
            }
            *expected += 1;
        }
        Ok(Some(entry))
    }

    /// Takes a channel or a message; other records are passed over.
    ///
    /// # Errors
    /// A sentence that says what is wrong with the record.
    pub(super) fn take(&mut self, opcode: u8, body: &[u8]) -> Result<(), String> {
        match opcode {
            op::CHANNEL => match parsed(opcode, body) {
                Some(Record::Channel(channel)) => {
                    let topic = RecordingTopic::ALL.into_iter().find(|topic| topic.name() == channel.topic);
                    self.channels.insert(channel.id, topic);
                    Ok(())
                }
                _ => Err("a channel is shorter than it says".to_owned()),
            },
            op::MESSAGE => match parsed(opcode, body) {
                Some(Record::Message { header, data }) => self.message(header, &data),
                _ => Err("a message is shorter than its header".to_owned()),
            },
            _ => Ok(()),
        }
    }

    /// Puts all entries that are left in order, once no more messages come.
    ///
    /// # Errors
    /// A sentence that names what is missing.
    pub(super) fn finish(&mut self) -> Result<(), String> {
        match &mut self.order {
            RideOrder::Numbers(assembly) => assembly.finish(&mut self.ready),
            RideOrder::Sequence { sequence, .. } => sequence.finish(&mut self.ready),
        }
    }

    fn message(&mut self, header: MessageHeader, message: &[u8]) -> Result<(), String> {
        let MessageHeader { sequence: number, channel_id, .. } = header;
        let channel = self.channels.get(&channel_id).ok_or_else(|| format!("message {number} is of no channel"))?;
        let Some(topic) = *channel else {
            if let RideOrder::Sequence { sequence, .. } = &mut self.order {
                sequence.other(number);
            }
            return Ok(());
        };
        match &mut self.order {
            RideOrder::Numbers(assembly) => {
                match topic {
                    RecordingTopic::Samples => {
                        SampleMessage::from_cbor(message)?
                            .try_for_each(|(number, sample)| assembly.sample(number, sample))?;
                    }
                    RecordingTopic::Controls => {
                        let ReadControls { samples, record } = text(number, message)?;
                        let samples = samples.ok_or_else(|| format!("message {number}: `samples` is missing"))?;
                        assembly.controls(samples, record)?;
                    }
                    RecordingTopic::Frames => assembly.frame(text::<FrameRecord>(number, message)?)?,
                }
                assembly.drain(&mut self.ready);
                Ok(())
            }
            RideOrder::Sequence { sequence, .. } => {
                let entry = match topic {
                    RecordingTopic::Samples => {
                        let sample: FirstFormatSample = text(number, message)?;
                        let sample = Sample::try_from(sample).map_err(|what| format!("message {number}: {what}"))?;
                        RecordingEntry::Sample(sample)
                    }
                    RecordingTopic::Controls => RecordingEntry::Controls(text::<ControlsRecord>(number, message)?),
                    RecordingTopic::Frames => RecordingEntry::Frame(text(number, message)?),
                };
                sequence.take(topic, number, entry, &mut self.ready)
            }
        }
    }
}

/// Message in JSON.
fn text<T: DeserializeOwned>(number: u32, text: &[u8]) -> Result<T, String> {
    serde_json::from_slice(text).map_err(|error| format!("message {number}: {error}"))
}
