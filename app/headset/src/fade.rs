//! Fade of the pictures while the runtime does not see the head: a world that does not follow the head makes ill.

/// Time for which the head may be unseen before the pictures fade, seconds.
const GRACE_S: f64 = 0.15;
/// Time in which the pictures fade to black, and in which they come back, seconds.
const FADE_S: f64 = 0.3;
/// Longest time that counts from one turn to the next, seconds: what a runtime held up was no time unseen.
const LONGEST_S: f64 = 0.1;

/// Fade of the pictures, turn by turn.
#[derive(Clone, Copy, Debug, Default)]
pub struct HeadFade {
    /// Time of the last turn on the runtime's clock, nanoseconds.
    last_ns: Option<i64>,
    /// Time for which the head has not been seen, seconds.
    unseen_s: f64,
    /// Progress of the fade, 0 to 1.
    faded: f64,
}

impl HeadFade {
    /// Share of the pictures' signal that is taken, 0 to 1, in a turn at a time of the runtime's clock, nanoseconds.
    pub fn after(&mut self, time_ns: i64, is_seen: bool) -> f64 {
        let passed_ns = self.last_ns.replace(time_ns).map_or(0, |last_ns| time_ns.saturating_sub(last_ns));
        let passed_s = (passed_ns as f64 * 1e-9).clamp(0.0, LONGEST_S);
        if is_seen {
            self.unseen_s = 0.0;
            self.faded = (self.faded - passed_s / FADE_S).max(0.0);
        } else {
            self.unseen_s += passed_s;
            // A turn that passes the grace fades for the rest of it.
            let fading_s = passed_s.min(self.unseen_s - GRACE_S).max(0.0);
            self.faded = (self.faded + fading_s / FADE_S).min(1.0);
        }
        self.faded * self.faded * (3.0 - 2.0 * self.faded)
    }
}

#[cfg(test)]
mod tests {
    //! Law: pictures are whole while the head is seen, and for 0.15 s after; then they fade to black within 0.3 s, and
    //! come back within 0.3 s, smoothly, at every rate of the headset. A wrong program flickers at each pose that is
    //! missing, or shows a world that is nailed to the head.
    use super::*;

    /// Time for which the pictures stay whole, and time of the fade, seconds.
    const WHOLE_S: f64 = 0.15;
    const FADING_S: f64 = 0.3;
    /// Rounding of times that are added up.
    const ROUNDING: f64 = 1e-6;

    /// Shares that are taken in turns at this rate, for a head that is seen as the function of the time says.
    fn taken(rate_hz: f64, seconds: f64, is_seen: impl Fn(f64) -> bool) -> Vec<(f64, f64)> {
        let mut fade = HeadFade::default();
        let turns = (0..).map(|turn| f64::from(turn) / rate_hz).take_while(|time| *time <= seconds);
        turns.map(|time| (time, fade.after((time * 1e9).round() as i64 - 7, is_seen(time)))).collect()
    }

    #[test]
    fn a_head_that_is_not_seen_fades_the_pictures_and_brings_them_back() {
        for rate_hz in [20.0, 72.0, 90.0, 144.0] {
            let period_s = 1.0 / rate_hz;
            let (lost_s, found_s) = (1.0, 2.0);
            let shares = taken(rate_hz, 3.0, |time| time < lost_s || time >= found_s);
            for &(time, share) in &shares {
                let (unseen_s, seen_s) = (time - lost_s, time - found_s);
                let whole = unseen_s < WHOLE_S - period_s - ROUNDING || seen_s > FADING_S + period_s + ROUNDING;
                let black = unseen_s > WHOLE_S + FADING_S + period_s + ROUNDING && seen_s < -ROUNDING;
                assert!(!whole || share == 0.0, "{rate_hz} Hz, {time} s: {share}");
                assert!(!black || share == 1.0, "{rate_hz} Hz, {time} s: {share}");
            }
            // Neither way is a leap.
            let steepest = shares.windows(2).map(|two| (two[1].1 - two[0].1).abs()).fold(0.0, f64::max);
            assert!(steepest < 1.5 * period_s / FADING_S + ROUNDING, "{rate_hz} Hz: {steepest}");
        }
    }

    #[test]
    fn a_pose_that_is_missing_now_and_then_fades_nothing() {
        let shares = taken(90.0, 5.0, |time| time % 0.2 > 0.14);
        assert!(shares.iter().all(|(_, share)| *share == 0.0));
    }

    #[test]
    fn a_runtime_that_pauses_or_sets_its_clock_does_not_blacken_at_once() {
        let mut fade = HeadFade::default();
        assert_eq!(fade.after(0, false), 0.0);
        assert_eq!(fade.after(60_000_000_000, false), 0.0);
        assert_eq!(fade.after(i64::MIN, false), 0.0);
        assert!(fade.after(i64::MAX, false) < 0.2);
    }
}
