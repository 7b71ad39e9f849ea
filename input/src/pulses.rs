//! Rate of a turning wheel, from the times of the pulses of its sensor.
//!
//! Intervals between pulses are measured on the sensor's own clock, to the microsecond; only the age of the last
//! pulse is measured on this machine's. Between pulses the estimate is capped by the silence (at a higher rate the
//! next pulse would be here already, unless its message is late). So it decays by itself, and after a while of silence
//! it is zero.

use crate::clock::{Nanos, seconds_between};
use crate::filters::{MedianOfThree, OneEuro};

/// Cutoff at a steady pace, Hz: a rider's pace changes within a second.
const STEADY_CUTOFF_HZ: f64 = 1.0;
/// Rise of the cutoff with the change of pace, Hz per pulse a second each second.
const CUTOFF_PER_CHANGE: f64 = 0.5;
/// Cutoff for the change of pace, Hz.
const CHANGE_CUTOFF_HZ: f64 = 1.0;

/// Estimator of a pulse rate.
#[derive(Clone, Debug)]
pub struct PulseRate {
    /// Shortest interval that is believed, seconds; shorter ones are a bouncing contact.
    shortest_interval_s: f64,
    /// Silence after which the rate is zero, seconds.
    stop_after_s: f64,
    /// Delay of a pulse's message that is allowed for before silence lowers the rate, seconds.
    late_s: f64,
    last_pulse: Option<Nanos>,
    rate_hz: f64,
    median: MedianOfThree,
    filter: OneEuro,
}

impl PulseRate {
    /// Estimator at rest until it has seen two pulses.
    pub fn new(shortest_interval_s: f64, stop_after_s: f64, late_s: f64) -> Self {
        Self {
            shortest_interval_s,
            stop_after_s,
            late_s,
            last_pulse: None,
            rate_hz: 0.0,
            median: MedianOfThree::default(),
            filter: OneEuro::new(STEADY_CUTOFF_HZ, CUTOFF_PER_CHANGE, CHANGE_CUTOFF_HZ),
        }
    }

    /// Forgets all pulses.
    pub fn reset(&mut self) {
        *self = Self::new(self.shortest_interval_s, self.stop_after_s, self.late_s);
    }

    /// Takes `count` new pulses, the last of them at `at`, which took `interval_s` since the last one before them.
    /// False if they are a bounce, which changes nothing.
    pub fn pulses(&mut self, at: Nanos, count: u32, interval_s: f64) -> bool {
        let interval_each_s = interval_s / f64::from(count);
        if interval_each_s < self.shortest_interval_s {
            return false;
        }
        let Some(last) = self.last_pulse else {
            self.last_pulse = Some(at);
            return true;
        };
        // After a long rest the interval is meaningless; the sensor's clock may even have wrapped.
        if seconds_between(last, at) > self.stop_after_s {
            self.reset();
            self.last_pulse = Some(at);
            return true;
        }
        self.last_pulse = Some(at);
        self.rate_hz = self.filter.filter(self.median.filter(1.0 / interval_each_s), interval_s);
        true
    }

    /// Time of the last pulse.
    pub fn last_pulse(&self) -> Option<Nanos> {
        self.last_pulse
    }

    /// Pulses a second at the time `at`.
    pub fn rate_hz(&self, at: Nanos) -> f64 {
        let silence_s = self.last_pulse.map_or(f64::INFINITY, |last| seconds_between(last, at));
        let missing_s = if self.late_s > 0.0 { (silence_s - self.late_s).max(0.0) } else { silence_s };
        if silence_s > self.stop_after_s { 0.0 } else { self.rate_hz.min(1.0 / missing_s) }
    }
}

#[cfg(test)]
mod tests {
    //! A steady wheel must read its exact rate, a stopped one must come to rest without a last jerk, and neither a
    //! bouncing contact nor a clock that wrapped may appear as speed.
    use super::*;
    use crate::clock::SECOND;

    /// Rounding of a few operations, Hz.
    const ROUNDING: f64 = 1e-12;

    fn steady(interval: Nanos, pulses: u64) -> PulseRate {
        let mut rate = PulseRate::new(0.02, 2.0, 0.0);
        for n in 0..pulses {
            assert!(rate.pulses(n * interval, 1, interval as f64 * 1e-9));
        }
        rate
    }

    /// A box sends lines, not pulses: the next pulse is known up to a line later.
    #[test]
    fn a_message_that_is_late_lowers_no_rate() {
        let mut rate = PulseRate::new(0.02, 2.0, 0.06);
        assert!((0..10).all(|n| rate.pulses(n * SECOND / 4, 1, 0.25)));
        let after = |silence_s: f64| rate.rate_hz(9 * SECOND / 4 + (silence_s * 1e9) as Nanos);
        assert!((after(0.30) - 4.0).abs() < ROUNDING, "{}", after(0.30));
        assert!((after(0.56) - 2.0).abs() < 1e-6, "{}", after(0.56));
        assert_eq!(after(2.01), 0.0);
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
        let mut rate = PulseRate::new(0.02, 2.0, 0.0);
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
