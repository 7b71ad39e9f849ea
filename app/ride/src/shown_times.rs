//! Gaps of a recorded ride: long times without a frame, as when the computer slept. The ride waited meanwhile, so
//! whoever shows it need not wait as long.

use input::{Nanos, SECOND};

/// Longest time between two frames that is shown as it was.
const LONGEST_GAP: Nanos = 10 * SECOND;
/// Time for which a longer gap is shown.
const SHOWN_GAP: Nanos = SECOND;

/// Times of a recorded ride's frames, with long gaps shortened. So what is shown is bounded by the number of frames.
#[derive(Clone, Copy, Debug, Default)]
pub struct ShownTimes {
    last: Nanos,
    shown: Nanos,
    gaps: u64,
    longest: Nanos,
}

impl ShownTimes {
    /// Time at which the frame of the recorded time `at` is shown. Time that runs backwards stands still.
    pub fn shown(&mut self, at: Nanos) -> Nanos {
        let gap = at.saturating_sub(self.last);
        self.last = self.last.max(at);
        if gap > LONGEST_GAP {
            self.gaps += 1;
            self.longest = self.longest.max(gap);
        }
        self.shown += if gap > LONGEST_GAP { SHOWN_GAP } else { gap };
        self.shown
    }

    /// Recorded time of what is shown at `shown`, at or before the newest frame, whose recorded time is `at`. Of a long
    /// gap the last part is shown, at its own pace: the ride waited before.
    pub fn recorded(&self, shown: Nanos, at: Nanos) -> Nanos {
        at.saturating_sub(self.shown.saturating_sub(shown))
    }

    /// Sentence about the gaps, if there were any.
    pub fn sentence(&self) -> Option<String> {
        let seconds = |time: Nanos| time as f64 / SECOND as f64;
        (self.gaps > 0).then(|| {
            format!(
                "{} of more than {:.0} s without a frame, the longest {:.1} s, shown as {:.0} s",
                if self.gaps == 1 { "one gap".to_owned() } else { format!("{} gaps", self.gaps) },
                seconds(LONGEST_GAP),
                seconds(self.longest),
                seconds(SHOWN_GAP)
            )
        })
    }
}

#[cfg(test)]
mod tests {
    //! Law: a ride is shown at its own pace, and no pair of frames takes longer than the longest gap.
    use super::*;

    const YEAR: Nanos = 365 * 24 * 3600 * SECOND;

    #[test]
    fn a_ride_without_gaps_keeps_its_times() {
        let mut times = ShownTimes::default();
        for at in [0, 5, SECOND, 11 * SECOND] {
            assert_eq!(times.shown(at), at);
        }
        assert_eq!(times.sentence(), None);
    }

    #[test]
    fn a_year_without_a_frame_is_a_second() {
        let mut times = ShownTimes::default();
        assert_eq!([0, YEAR, YEAR + 5, 2 * YEAR].map(|at| times.shown(at)), [0, SECOND, SECOND + 5, 2 * SECOND + 5]);
        let told = times.sentence().unwrap();
        assert!(told.starts_with("2 gaps") && told.contains("31536000.0 s"), "{told}");
        // The first frame, too, and one that cannot be.
        assert_eq!(ShownTimes::default().shown(Nanos::MAX), SECOND);
    }

    #[test]
    fn what_is_shown_between_two_frames_has_its_own_time() {
        let mut times = ShownTimes::default();
        for at in [SECOND, 3 * SECOND] {
            assert_eq!(times.shown(at), at);
            assert_eq!(times.recorded(at - SECOND / 2, at), at - SECOND / 2);
        }
        // Of a year, the last second.
        assert_eq!(times.shown(YEAR), 4 * SECOND);
        let recorded = [3 * SECOND, 7 * SECOND / 2, 4 * SECOND].map(|shown| times.recorded(shown, YEAR));
        assert_eq!(recorded, [YEAR - SECOND, YEAR - SECOND / 2, YEAR]);
    }

    #[test]
    fn time_that_runs_backwards_stands_still() {
        let mut times = ShownTimes::default();
        assert_eq!([SECOND, 0, SECOND / 2, 2 * SECOND].map(|at| times.shown(at)), [SECOND, SECOND, SECOND, 2 * SECOND]);
    }
}
