//! Gate before a tracker's queue: what comes too fast is thinned to the newest of each kind.
//!
//! A server that has gone mad, or is hostile, can send a million poses a second. Each would be decoded in a frame and
//! written into the recording, although a head has one place. Up to [`MESSAGES_PER_S`] everything passes, which is
//! several times what any tracker sends. Beyond that a message waits, and gives way to a newer one of its kind.

use std::time::Instant;

/// Number of short messages a second that pass; long ones count for several.
const MESSAGES_PER_S: f64 = 6000.0;
/// Number of short messages that may come at once.
const BURST: f64 = 600.0;
/// Length by which a message counts for one more, bytes.
const SHORT: f64 = 512.0;
/// Most kinds of messages of which one can wait.
const MOST_KINDS: usize = 64;

/// Kind of a message: the newest of a kind says all.
pub(super) type MessageKind = [u8; 12];

/// Gate that holds messages back while too many come.
#[derive(Debug)]
pub(super) struct FloodGate {
    /// Number of short messages that may pass now.
    room: f64,
    counted_at: Instant,
    /// Newest messages of each kind that did not pass, in the order in which the kinds came.
    waiting: Vec<(MessageKind, Vec<u8>)>,
    passed_over: u64,
}

impl FloodGate {
    pub(super) fn new(now: Instant) -> Self {
        Self { room: BURST, counted_at: now, waiting: Vec::new(), passed_over: 0 }
    }

    /// Appends a message to `bytes`, behind those that wait, or keeps it until there is room.
    pub(super) fn take(&mut self, now: Instant, kind: MessageKind, message: &[u8], bytes: &mut Vec<u8>) {
        self.release(now, bytes);
        if self.waiting.is_empty() && self.admits(message.len()) {
            bytes.extend_from_slice(message);
            return;
        }
        if let Some((_, older)) = self.waiting.iter_mut().find(|(waiting, _)| *waiting == kind) {
            older.clear();
            older.extend_from_slice(message);
        } else if self.waiting.len() < MOST_KINDS {
            self.waiting.push((kind, message.to_vec()));
            return;
        }
        self.passed_over += 1;
    }

    /// Appends the messages that wait, as far as there is room.
    pub(super) fn release(&mut self, now: Instant, bytes: &mut Vec<u8>) {
        let elapsed_s = now.saturating_duration_since(self.counted_at).as_secs_f64();
        self.counted_at = now;
        self.room = (self.room + MESSAGES_PER_S * elapsed_s).min(BURST);
        let mut passing = 0;
        for (_, message) in &self.waiting {
            // As `admits`, which would borrow all of the gate.
            let cost = cost(message.len());
            if self.room < cost {
                break;
            }
            self.room -= cost;
            bytes.extend_from_slice(message);
            passing += 1;
        }
        self.waiting.drain(..passing);
    }

    /// Number of messages that were passed over for newer ones since the last call.
    pub(super) fn passed_over(&mut self) -> u64 {
        std::mem::take(&mut self.passed_over)
    }

    fn admits(&mut self, length: usize) -> bool {
        let cost = cost(length);
        let admits = self.room >= cost;
        if admits {
            self.room -= cost;
        }
        admits
    }
}

/// Number of short messages that a message counts for; a very long one passes when the gate has been quiet.
fn cost(length: usize) -> f64 {
    (1.0 + length as f64 / SHORT).min(BURST)
}

#[cfg(test)]
mod tests {
    //! Law: what a tracker sends passes as it is; of a flood a bounded part passes, and the newest of each kind.
    use super::*;
    use std::time::Duration;

    fn kind(number: u8) -> MessageKind {
        [number; 12]
    }

    #[test]
    fn a_tracker_passes_unchanged() {
        let start = Instant::now();
        let (mut gate, mut bytes, mut sent) = (FloodGate::new(start), Vec::new(), Vec::new());
        // Two kinds of four sensors at 480 Hz, eight at a time.
        for n in 0..4800_u32 {
            let at = start + Duration::from_secs(1) * (n / 8) / 480;
            let message = [n.to_le_bytes(); 20].concat();
            gate.take(at, kind((n % 8) as u8), &message, &mut bytes);
            sent.extend(message);
        }
        assert_eq!((bytes, gate.passed_over()), (sent, 0));
    }

    #[test]
    fn of_a_flood_a_bounded_part_passes_and_the_newest_of_each_kind() {
        let start = Instant::now();
        let (mut gate, mut bytes) = (FloodGate::new(start), Vec::new());
        // A million a second for a second.
        let count = 1_000_000_u32;
        for n in 0..count {
            gate.take(start + Duration::from_micros(u64::from(n)), kind((n % 2) as u8), &n.to_le_bytes(), &mut bytes);
        }
        gate.release(start + Duration::from_secs(2), &mut bytes);
        let passed: Vec<u32> = bytes.as_chunks::<4>().0.iter().map(|bytes| u32::from_le_bytes(*bytes)).collect();
        assert!((5000..7000).contains(&passed.len()), "{} passed", passed.len());
        assert_eq!(passed[passed.len() - 2..], [count - 2, count - 1]);
        assert_eq!(gate.passed_over(), u64::from(count) - passed.len() as u64);
    }

    #[test]
    fn kinds_without_end_cost_no_memory() {
        let start = Instant::now();
        let (mut gate, mut bytes) = (FloodGate::new(start), Vec::new());
        for n in 0..100_000_u32 {
            let kind = [n.to_le_bytes(); 3].concat().try_into().unwrap();
            gate.take(start, kind, &[0; 4000], &mut bytes);
        }
        assert!(bytes.len() < 400_000 && gate.waiting.len() <= MOST_KINDS, "{}", bytes.len());
    }
}
