//! How fast something turns, from the times at which it passed a sensor.
//!
//! Intervals between pulses are measured on the sensor's own clock, to the microsecond; only the
//! age of the last pulse needs ours. Between pulses the estimate is capped by what the silence
//! still allows (had it turned faster, the next pulse would be here already), so it decays by
//! itself, and after a while of silence it is zero.

use crate::clock::{Nanos, seconds_between};
use crate::filters::{MedianOfThree, OneEuro};

/// Cutoff at a steady pace, Hz: a rider's pace changes within a second.
const STEADY_CUTOFF_HZ: f64 = 1.0;
/// How quickly the filter opens when the pace changes, Hz per pulse a second each second.
const CUTOFF_PER_CHANGE: f64 = 0.5;
/// Cutoff for the change of pace, Hz.
const CHANGE_CUTOFF_HZ: f64 = 1.0;

/// Estimator of a pulse rate.
#[derive(Clone, Debug)]
pub struct PulseRate {
    /// Shorter intervals are a bouncing contact.
    shortest_interval_s: f64,
    /// After this much silence it stands still.
    stop_after_s: f64,
    last_pulse: Option<Nanos>,
    rate_hz: f64,
    median: MedianOfThree,
    filter: OneEuro,
}

impl PulseRate {
    /// An estimator that stands still until it has seen two pulses.
    pub fn new(shortest_interval_s: f64, stop_after_s: f64) -> Self {
        Self {
            shortest_interval_s,
            stop_after_s,
            last_pulse: None,
            rate_hz: 0.0,
            median: MedianOfThree::default(),
            filter: OneEuro::new(STEADY_CUTOFF_HZ, CUTOFF_PER_CHANGE, CHANGE_CUTOFF_HZ),
        }
    }

    /// Forgets all pulses.
    pub fn reset(&mut self) {
        *self = Self::new(self.shortest_interval_s, self.stop_after_s);
    }

    /// Takes `count` new pulses, the last of them at `at`, which took `interval_s` since the last
    /// one before them. Says whether they were believed: a bounce is not, and leaves everything as
    /// it was.
    pub fn pulses(&mut self, at: Nanos, count: u32, interval_s: f64) -> bool {
        let interval_each_s = interval_s / f64::from(count);
        if interval_each_s < self.shortest_interval_s {
            return false;
        }
        let Some(last) = self.last_pulse else {
            self.last_pulse = Some(at);
            return true;
        };
        // After a long rest the interval says nothing, the sensor's clock may even have wrapped.
        if seconds_between(last, at) > self.stop_after_s {
            self.reset();
            self.last_pulse = Some(at);
            return true;
        }
        self.last_pulse = Some(at);
        self.rate_hz = self.filter.filter(self.median.filter(1.0 / interval_each_s), interval_s);
        true
    }

    /// When the last pulse came.
    pub fn last_pulse(&self) -> Option<Nanos> {
        self.last_pulse
    }

    /// Pulses a second at the time `at`.
    pub fn rate_hz(&self, at: Nanos) -> f64 {
        let silence_s = self.last_pulse.map_or(f64::INFINITY, |last| seconds_between(last, at));
        if silence_s > self.stop_after_s { 0.0 } else { self.rate_hz.min(1.0 / silence_s) }
    }
}

#[cfg(test)]
mod tests {
    //! A steady wheel must read its exact rate, a stopped one must come to rest without a last
    //! jerk, and neither a bouncing contact nor a clock that wrapped may show as speed.
    use super::*;
    use crate::clock::SECOND;

    /// Rounding of a few operations.
    const ROUNDING: f64 = 1e-12;

    fn steady(interval: Nanos, pulses: u64) -> PulseRate {
        let mut rate = PulseRate::new(0.02, 2.0);
        for n in 0..pulses {
            assert!(rate.pulses(n * interval, 1, interval as f64 * 1e-9));
        }
        rate
    }

    #[test]
    fn one_pulse_is_no_speed() {
        assert_eq!(steady(SECOND / 4, 1).rate_hz(0), 0.0);
    }

    #[test]
    fn a_steady_wheel_reads_its_rate() {
        let rate = steady(SECOND / 4, 10);
        assert!((rate.rate_hz(9 * SECOND / 4) - 4.0).abs() < ROUNDING);
    }

    #[test]
    fn several_pulses_at_once_read_like_single_ones() {
        let mut rate = PulseRate::new(0.02, 2.0);
        rate.pulses(0, 1, 0.1);
        rate.pulses(SECOND / 2, 5, 0.5);
        assert!((rate.rate_hz(SECOND / 2) - 10.0).abs() < ROUNDING);
    }

    #[test]
    fn silence_decays_to_a_stop() {
        let rate = steady(SECOND / 4, 10);
        let last = 9 * SECOND / 4;
        assert!((rate.rate_hz(last + SECOND / 2) - 2.0).abs() < ROUNDING);
        assert!((rate.rate_hz(last + SECOND) - 1.0).abs() < ROUNDING);
        let mut before = f64::INFINITY;
        for n in 0..300 {
            let now = rate.rate_hz(last + n * SECOND / 100);
            assert!(now <= before);
            before = now;
        }
        assert_eq!(before, 0.0);
    }

    #[test]
    fn a_bounce_changes_nothing() {
        let mut rate = steady(SECOND / 4, 10);
        let (last, before) = (9 * SECOND / 4, rate.rate_hz(9 * SECOND / 4));
        for interval_s in [0.001, 0.0, -1.0] {
            assert!(!rate.pulses(last + SECOND / 1000, 1, interval_s));
        }
        assert_eq!(rate.rate_hz(last), before);
    }

    #[test]
    fn a_pulse_after_a_long_rest_starts_anew() {
        let mut rate = steady(SECOND / 4, 10);
        // The sensor's clock has wrapped: its interval claims 50 ms.
        assert!(rate.pulses(4300 * SECOND, 1, 0.05));
        assert_eq!(rate.rate_hz(4300 * SECOND), 0.0);
    }
}
