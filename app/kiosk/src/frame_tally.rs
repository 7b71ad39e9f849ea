//! Tally of frame times for the day's log.

use crate::day_log::DayEvent;
use input::{Nanos, SECOND};

/// Time between two entries on frame times.
const SUMMARY: Nanos = 60 * SECOND;
/// Longest frame that a rider does not notice, nanoseconds.
const LATE: Nanos = SECOND / 20;

/// Frames since the last entry.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrameTally {
    /// Number of frames, of those that were late, and the time of the longest.
    frames: u64,
    late: u64,
    longest: Nanos,
    /// Time of the last frame, and of the last entry.
    before: Option<Nanos>,
    summed: Nanos,
}

impl FrameTally {
    /// Counts a frame at the time `now`.
    pub fn add(&mut self, now: Nanos) {
        if let Some(before) = self.before.replace(now) {
            let time = now.saturating_sub(before);
            self.frames += 1;
            self.late += u64::from(time > LATE);
            self.longest = self.longest.max(time);
        }
    }

    /// True if it is time for an entry.
    pub fn is_due(&self, now: Nanos) -> bool {
        now.saturating_sub(self.summed) >= SUMMARY
    }

    /// Entry on the frames so far, if there were any; counting begins anew.
    pub fn take(&mut self, now: Nanos) -> Option<DayEvent<'static>> {
        let Self { frames, late, longest, before, summed } = *self;
        *self = Self { before, summed: now, ..Self::default() };
        let mean_ms = now.saturating_sub(summed) as f64 / frames as f64 / 1e6;
        (frames > 0).then_some(DayEvent::Frames { frames, mean_ms, longest_ms: longest as f64 / 1e6, late })
    }
}

#[cfg(test)]
mod tests {
    //! Law: every frame counts in one entry, with its time, and as late if it is longer than a twentieth of a second.

    use super::*;

    #[test]
    fn an_entry_counts_the_frames_since_the_last_one() {
        let mut tally = FrameTally::default();
        for at in [0, 10, 20, 80] {
            tally.add(at * SECOND / 1000);
        }
        assert!(!tally.is_due(59 * SECOND) && tally.is_due(60 * SECOND));
        let entry = tally.take(80 * SECOND / 1000);
        assert!(
            matches!(entry, Some(DayEvent::Frames { frames: 3, late: 1, longest_ms, mean_ms })
                if longest_ms == 60.0 && (mean_ms - 80.0 / 3.0).abs() < 1e-9),
            "{entry:?}"
        );
        assert!(tally.take(90 * SECOND / 1000).is_none());
    }
}
