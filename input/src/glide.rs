//! Speed between the rare readings of a device that tells its speed once or a few times a second.
//!
//! Between two readings the truth is unknown. A speed that simply held, or faded until the next reading, would jump at
//! each of them, and the ride would saw. The law, with T the time between readings:
//!
//! - The first reading counts at once.
//! - From each later one the speed glides in a straight line, from where it stands to the reading, within T. So it is
//!   at all times between speeds that were measured, a rise stays a rise, and a stop is seen T after it was said.
//! - There it stays until 1.5 T after the reading. Then it fades in a straight line, within `stop_after_s`, to zero.
//!
//! T is the longest of the last [`GAPS`] gaps, so readings that arrive in clusters do no harm. Until as many are known,
//! a reading stays as if T were [`UNKNOWN_GAP_S`] at least. A gap longer than [`LONGEST_GAP_S`] counts as that.

use crate::clock::{Nanos, seconds_between};

/// Number of gaps of which the longest counts.
const GAPS: usize = 3;
/// Time between readings until it is known, seconds.
const UNKNOWN_GAP_S: f64 = 2.0;
/// Longest time between readings that is believed, seconds.
const LONGEST_GAP_S: f64 = 4.0;
/// Time for which a reading holds, in gaps.
const HOLDS: f64 = 1.5;

/// Speed, or another rate, from readings that come rarely; in their unit.
#[derive(Clone, Debug)]
pub(crate) struct Glide {
    /// Time in which the speed fades, when no reading comes any more, seconds.
    stop_after_s: f64,
    /// Last gaps between readings, seconds, the newest last.
    gaps_s: [Option<f64>; GAPS],
    last: Option<GlideLeg>,
}

/// Way from one speed to the next.
#[derive(Clone, Copy, Debug)]
struct GlideLeg {
    /// Time of the reading.
    at: Nanos,
    /// Speed at that time.
    from: f64,
    /// Speed that was read.
    to: f64,
}

impl Glide {
    /// Glide without any reading yet.
    pub(crate) fn new(stop_after_s: f64) -> Self {
        Self { stop_after_s, gaps_s: [None; GAPS], last: None }
    }

    /// Forgets all readings.
    pub(crate) fn reset(&mut self) {
        *self = Self::new(self.stop_after_s);
    }

    /// Takes a reading that arrived at `at`.
    pub(crate) fn read(&mut self, at: Nanos, reading: f64) {
        let from = self.speed(at).unwrap_or(reading);
        if let Some(last) = self.last {
            self.gaps_s.rotate_left(1);
            self.gaps_s[GAPS - 1] = Some(seconds_between(last.at, at).min(LONGEST_GAP_S));
        }
        self.last = Some(GlideLeg { at, from, to: reading });
    }

    /// Speed at the time `at`; `None` until a first reading.
    pub(crate) fn speed(&self, at: Nanos) -> Option<f64> {
        let GlideLeg { at: read_at, from, to } = self.last?;
        let longest = |unknown: f64| self.gaps_s.iter().map(|gap_s| gap_s.unwrap_or(unknown)).fold(0.0, f64::max);
        let age_s = seconds_between(read_at, at);
        let gap_s = longest(0.0);
        let way = if age_s < gap_s { age_s / gap_s } else { 1.0 };
        let fading_s = age_s - HOLDS * longest(UNKNOWN_GAP_S);
        let left = if fading_s > 0.0 { (1.0 - fading_s / self.stop_after_s).max(0.0) } else { 1.0 };
        Some((from + (to - from) * way) * left)
    }
}

#[cfg(test)]
mod tests {
    //! Law: a steady speed reads as itself at any rate of readings; a ramp is climbed without saw teeth and nothing
    //! beyond what was measured is shown; a stop is seen within two gaps; silence fades to a stop.
    use super::*;
    use crate::clock::SECOND;

    const STOP_AFTER_S: f64 = 2.0;
    /// Step of the looks between the readings.
    const LOOK: Nanos = SECOND / 240;

    /// Speeds seen 240 times a second, while the readings `truth` come every `gap`, for `gaps` gaps.
    fn seen(gap: Nanos, gaps: u64, truth: impl Fn(u64) -> f64) -> Vec<(Nanos, f64)> {
        let mut glide = Glide::new(STOP_AFTER_S);
        let (mut next, mut seen) = (0, Vec::new());
        for at in (0..gap * gaps).step_by(LOOK as usize) {
            while next * gap <= at {
                glide.read(next * gap, truth(next));
                next += 1;
            }
            seen.push((at, glide.speed(at).unwrap()));
        }
        seen
    }

    #[test]
    fn a_steady_speed_is_itself_at_every_rate() {
        for gap in [2 * SECOND, SECOND, SECOND / 4, SECOND / 50] {
            for (at, speed) in seen(gap, 12, |_| 10.0) {
                assert!((speed - 10.0).abs() < 1e-9, "{speed} at {at} with a gap of {gap}");
            }
        }
    }

    #[test]
    fn late_and_clustered_readings_make_no_saw() {
        let mut glide = Glide::new(STOP_AFTER_S);
        // Readings every second, each up to 0.4 s late, and two of three in one packet.
        for n in 0..30_u64 {
            let at = n * SECOND + n * 7919 % 40 * SECOND / 100;
            let first = n.div_ceil(3) * 3 * SECOND;
            glide.read(if n % 3 == 0 { at } else { at.max(first) }, 10.0);
            for look in 1..60 {
                let speed = glide.speed(at + look * SECOND / 60).unwrap();
                assert!((speed - 10.0).abs() < 1e-9, "{speed} after reading {n}");
            }
        }
    }

    #[test]
    fn a_ramp_has_no_saw_teeth_and_ends_where_it_was_measured() {
        for gap in [2 * SECOND, SECOND, SECOND / 4] {
            // Up to 10 m/s at 1 m/s², and level from there on.
            let per_gap = gap as f64 / SECOND as f64;
            let speeds = seen(gap, 30, |n| (n as f64 * per_gap).min(10.0));
            for pair in speeds.windows(2) {
                assert!(pair[0].1 <= pair[1].1, "{pair:?} with a gap of {gap}");
                // No jump either: the slope of the glide is that of the ramp.
                assert!(pair[1].1 - pair[0].1 < 1.01 / 240.0, "{pair:?} with a gap of {gap}");
            }
            let (_, last) = speeds[speeds.len() - 1];
            assert!(last <= 10.0 && last > 7.0, "{last}");
        }
    }

    #[test]
    fn a_ramp_is_followed_one_gap_behind() {
        for (at, speed) in seen(SECOND, 12, |n| n as f64).into_iter().filter(|(at, _)| *at > 8 * SECOND) {
            let behind = at as f64 / SECOND as f64 - speed;
            assert!((behind - 1.0).abs() < 0.01, "{behind} behind at {at}");
        }
    }

    #[test]
    fn a_stop_is_seen_within_two_gaps() {
        for gap in [2 * SECOND, SECOND, SECOND / 4] {
            // The rider stops just after reading 7; reading 8 says so.
            let stopped = 7 * gap;
            for (at, speed) in seen(gap, 12, |n| if n < 8 { 10.0 } else { 0.0 }) {
                assert!((0.0..=10.0).contains(&speed));
                assert!(at < stopped + 2 * gap || speed == 0.0, "{speed} at {at} with a gap of {gap}");
            }
        }
    }

    #[test]
    fn silence_holds_and_fades_to_a_stop() {
        let mut glide = Glide::new(STOP_AFTER_S);
        (0..5).for_each(|n| glide.read(n * SECOND, 8.0));
        let after = |quarters: u64| glide.speed(4 * SECOND + quarters * SECOND / 4).unwrap();
        assert_eq!([after(4), after(6)], [8.0, 8.0]);
        assert!((after(10) - 4.0).abs() < 1e-9);
        assert_eq!([after(14), after(4000)], [0.0, 0.0]);
        // The reading after a long silence is reached within the longest gap.
        glide.read(1000 * SECOND, 8.0);
        assert!((glide.speed(1004 * SECOND).unwrap() - 8.0).abs() < 1e-9);
    }

    #[test]
    fn readings_of_one_time_or_of_the_past_do_no_harm() {
        let mut glide = Glide::new(STOP_AFTER_S);
        for _ in 0..5 {
            glide.read(SECOND, 5.0);
        }
        glide.read(0, 6.0);
        assert!(glide.speed(SECOND).is_some_and(f64::is_finite));
        glide.reset();
        assert_eq!(glide.speed(SECOND), None);
    }
}
