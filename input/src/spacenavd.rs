//! Decoder of a SpaceMouse through the spacenavd daemon's socket.
//!
//! Events are eight 32-bit integers in the machine's order (all supported machines are little-endian). Word 0 is the
//! kind (0 motion, 1 press, 2 release, others passed over); words 1 to 6 of a motion are three shifts and three
//! turns, ±500 at full deflection; word 1 of a button is its number. The stream may be cut anywhere.
//!
//! The daemon leaves out events that repeat the last one, so a cap that is held still may be silent for seconds:
//! silence has no meaning here.

use crate::axis_table::AxisTable;
use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::spacemouse::{button, deflection};

/// Length of an event, bytes.
pub const EVENT_LENGTH: usize = 32;
/// Full deflection, unless the daemon's sensitivity is changed.
const FULL_DEFLECTION: f64 = 500.0;

const MOTION: i32 = 0;
const PRESS: i32 = 1;
/// Kinds without an effect: release, device, configuration, raw axis, raw button.
const PASSED_OVER: std::ops::RangeInclusive<i32> = 2..=6;
/// Upper half of word 0 in replies of the daemon's newer protocol, which interleave with events.
const REPLY: i32 = 0x7faa;

/// Decoder of [`SampleSource::Spacenavd`](crate::SampleSource::Spacenavd).
#[derive(Debug)]
pub struct SpacenavdDecoder {
    table: AxisTable,
    partial: Vec<u8>,
    axes: [i32; 6],
    faults: Faults,
}

impl SpacenavdDecoder {
    /// SpaceMouse at rest.
    pub fn new(table: AxisTable) -> Self {
        Self { table, partial: Vec::new(), axes: [0; 6], faults: Faults::default() }
    }

    /// Thrust right, up, backward and turn nose up, nose left, roll left, each −1 to 1.
    pub fn deflection(&self) -> [f64; 6] {
        deflection(self.table, self.axes, FULL_DEFLECTION)
    }

    fn event(&mut self, words: [i32; 8], actions: &mut Actions) {
        match words[0] {
            MOTION => self.axes.copy_from_slice(&words[1..7]),
            PRESS => {
                if let Some(action) = usize::try_from(words[1]).ok().and_then(button) {
                    actions.push(action);
                }
            }
            kind if PASSED_OVER.contains(&kind) || kind >> 16 == REPLY => {}
            kind => self.faults.count(format!("an event of unknown kind {kind}")),
        }
    }
}

impl Decoder for SpacenavdDecoder {
    fn reset(&mut self, _at: Nanos) {
        self.partial.clear();
        self.axes = [0; 6];
    }

    fn bytes(&mut self, _at: Nanos, bytes: &[u8], actions: &mut Actions) {
        let mut stream = std::mem::take(&mut self.partial);
        stream.extend_from_slice(bytes);
        let (events, rest) = stream.as_chunks::<EVENT_LENGTH>();
        for event in events {
            let mut words = [0; 8];
            for (word, bytes) in words.iter_mut().zip(event.as_chunks::<4>().0) {
                *word = i32::from_le_bytes(*bytes);
            }
            self.event(words, actions);
        }
        self.partial = rest.to_vec();
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! Events captured from the real daemon must give their push, however they are cut.
    use super::*;
    use crate::action::Action;

    /// Motion 100 −50 −25 7 −8 −300, then rest, then button 0 pressed and released.
    const CAPTURED: &str = concat!(
        "0000000064000000ceffffffe7ffffff07000000f8ffffffd4feffff00000000",
        "000000000000000000000000000000000000000000000000000000002d010000",
        "0100000000000000010000000000000000000000000000000000000000000000",
        "0200000000000000000000000000000000000000000000000000000000000000",
    );

    fn captured() -> Vec<u8> {
        (0..CAPTURED.len()).step_by(2).map(|at| u8::from_str_radix(&CAPTURED[at..at + 2], 16).unwrap()).collect()
    }

    #[test]
    fn captured_events_give_their_push() {
        let (mut daemon, mut actions) = (SpacenavdDecoder::new(AxisTable::SPACENAVD), Actions::default());
        daemon.bytes(0, &captured()[..32], &mut actions);
        assert_eq!(daemon.axes, [100, -50, -25, 7, -8, -300]);
        let expected = [0.2, -0.1, 0.05].map(|part: f64| (part.abs() - 0.03) / 0.97 * part.signum());
        for (control, expected) in daemon.deflection().iter().zip(expected) {
            assert!((control - expected).abs() < 1e-15);
        }
        assert_eq!(daemon.deflection()[3..5], [0.0, -0.0]);
        daemon.bytes(0, &captured()[32..], &mut actions);
        assert_eq!(daemon.axes, [0; 6]);
        assert_eq!(actions.take(), [Action::TogglePause]);
        assert_eq!(daemon.faults().number(), 0);
    }

    #[test]
    fn events_do_not_depend_on_the_cut() {
        for size in 1..=70 {
            let (mut daemon, mut actions) = (SpacenavdDecoder::new(AxisTable::SPACENAVD), Actions::default());
            let mut seen = Vec::new();
            for chunk in captured().chunks(size) {
                daemon.bytes(0, chunk, &mut actions);
                seen.push(daemon.axes);
            }
            assert_eq!(actions.take(), [Action::TogglePause], "cut at {size}");
            assert!(size > 32 || seen.contains(&[100, -50, -25, 7, -8, -300]), "cut at {size}");
            assert_eq!(daemon.axes, [0; 6]);
        }
    }

    #[test]
    fn the_push_ends_with_the_connection() {
        let (mut daemon, mut actions) = (SpacenavdDecoder::new(AxisTable::SPACENAVD), Actions::default());
        daemon.bytes(0, &captured()[..40], &mut actions);
        daemon.reset(0);
        assert_eq!(daemon.deflection(), [0.0; 6]);
        // The half event from before must not shift the next one.
        daemon.bytes(0, &captured()[..32], &mut actions);
        assert_eq!(daemon.axes[0], 100);
    }

    #[test]
    fn unknown_events_are_counted_and_replies_passed_over() {
        let (mut daemon, mut actions) = (SpacenavdDecoder::new(AxisTable::SPACENAVD), Actions::default());
        let mut reply = [0_u8; EVENT_LENGTH];
        reply[..4].copy_from_slice(&0x7faa_2000_i32.to_le_bytes());
        daemon.bytes(0, &reply, &mut actions);
        assert_eq!(daemon.faults().number(), 0);
        daemon.bytes(0, &[0xff; EVENT_LENGTH], &mut actions);
        assert_eq!(daemon.faults().number(), 1);
        assert_eq!(daemon.axes, [0; 6]);
    }
}
