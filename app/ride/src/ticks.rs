//! Fixed steps: the ticks of the ride's clock that are due.
//!
//! Tick n is due at n/240 s. Ticks are counted in integers from the ride's start, so nothing drifts, and nothing
//! depends on how time was cut into frames, except for the ticks that a stall drops.

use input::{Nanos, SECOND};

/// Number of ticks per second of real time.
pub const TICKS_PER_SECOND: u32 = 240;

/// Largest number of ticks per frame. A frame that comes later has stalled, and the world waits for it.
const MOST_TICKS: u64 = TICKS_PER_SECOND as u64 / 4;

/// Number of ticks that have passed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ticks {
    passed: u64,
}

impl Ticks {
    /// Times of the ticks that have become due at `at`, at most a quarter of a second's; and the number of older ones
    /// that were dropped.
    pub(super) fn due(&mut self, at: Nanos) -> (impl Iterator<Item = Nanos> + use<>, u64) {
        let due = passed(at).max(self.passed);
        let dropped = (due - self.passed).saturating_sub(MOST_TICKS);
        let first = self.passed + dropped + 1;
        self.passed = due;
        ((first..=due).map(time), dropped)
    }

    /// Time of the last tick that has passed.
    pub(super) fn last(&self) -> Nanos {
        time(self.passed)
    }

    /// Share of a tick that has passed at `at` since the one at `tick`, from 0 to below 1.
    pub(super) fn fraction(tick: Nanos, at: Nanos) -> f64 {
        let since = at.saturating_sub(tick) as f64 * 1e-9 * f64::from(TICKS_PER_SECOND);
        since.min(1.0 - f64::EPSILON)
    }
}

/// Number of ticks that are due at `at`.
fn passed(at: Nanos) -> u64 {
    let ticks = u128::from(at) * u128::from(TICKS_PER_SECOND) / u128::from(SECOND);
    u64::try_from(ticks).unwrap_or(u64::MAX)
}

/// Time at which a tick is due: the first nanosecond not before it.
fn time(tick: u64) -> Nanos {
    let at = (u128::from(tick) * u128::from(SECOND)).div_ceil(u128::from(TICKS_PER_SECOND));
    Nanos::try_from(at).unwrap_or(Nanos::MAX)
}

#[cfg(test)]
mod tests {
    //! Law under test: however a second is cut into frames, it has 240 ticks at the same times. A clock that adds up
    //! rounded intervals ends with 239 or 241.
    use super::*;

    fn times(frames: &[Nanos]) -> Vec<Nanos> {
        let mut ticks = Ticks::default();
        frames.iter().flat_map(|&at| ticks.due(at).0).collect()
    }

    #[test]
    fn a_second_has_240_ticks_however_it_is_cut() {
        let whole = times(&[SECOND / 4, SECOND / 2, 3 * SECOND / 4, SECOND]);
        assert_eq!(whole.len(), 240);
        assert_eq!(whole[239], SECOND);
        let fine: Vec<Nanos> = (0..=1000).map(|n| n * SECOND / 1000).collect();
        assert_eq!(times(&fine), whole);
        let uneven: Vec<Nanos> = (0..=144).map(|n| n * 6_944_444).chain([SECOND]).collect();
        assert_eq!(times(&uneven), whole);
    }

    #[test]
    fn a_year_later_no_tick_is_lost() {
        let year = 365 * 24 * 3600 * SECOND;
        let mut ticks = Ticks::default();
        let (_, dropped) = ticks.due(year);
        assert_eq!(dropped, 365 * 24 * 3600 * 240 - 60);
        assert_eq!(ticks.due(year + SECOND / 4).0.count(), 60);
    }

    #[test]
    fn a_stall_drops_all_but_a_quarter_second() {
        let mut ticks = Ticks::default();
        let (times, dropped) = ticks.due(2 * SECOND);
        assert_eq!((times.count(), dropped), (60, 420));
    }

    #[test]
    fn time_that_runs_backwards_has_no_ticks() {
        let mut ticks = Ticks::default();
        assert_eq!(ticks.due(SECOND / 8).0.count(), 30);
        assert_eq!(ticks.due(0).0.count(), 0);
        assert_eq!(Ticks::fraction(ticks.last(), 0), 0.0);
        assert_eq!(ticks.due(SECOND / 4).0.count(), 30);
    }

    #[test]
    fn the_fraction_grows_from_tick_to_tick() {
        let mut ticks = Ticks::default();
        let second_tick = SECOND / 120 + 1;
        assert_eq!(ticks.due(second_tick).0.count(), 2);
        let fraction = |at| Ticks::fraction(ticks.last(), at);
        assert!(fraction(second_tick) < 1e-6);
        assert!((fraction(second_tick + SECOND / 480) - 0.5).abs() < 1e-6);
        assert!(fraction(SECOND) < 1.0);
        assert!(Ticks::fraction(Ticks { passed: u64::MAX }.last(), u64::MAX) < 1.0);
    }
}
