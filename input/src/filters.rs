//! Filters for noisy measurements, and the dead zone of a stick.
//!
//! [`MedianOfThree`] removes single outliers (a bouncing contact, a lost pulse). [`OneEuro`] then smooths, strongly
//! while the signal rests and weakly while it moves, so that slow jitter disappears and quick motion is not delayed.

use std::f64::consts::TAU;

/// Value with a dead zone about zero, continuous at the zone's edge and clamped to −1 to 1.
pub fn with_dead_zone(value: f64, zone: f64) -> f64 {
    let outside = ((value.abs() - zone) / (1.0 - zone)).clamp(0.0, 1.0);
    outside.copysign(value)
}

/// Median of the last three values.
#[derive(Clone, Debug, Default)]
pub struct MedianOfThree {
    earlier: Option<f64>,
    last: Option<f64>,
}

impl MedianOfThree {
    /// Takes a value and returns the median. Before the third value it is the smallest, which is safe for a speed.
    pub fn filter(&mut self, value: f64) -> f64 {
        let median = match (self.earlier, self.last) {
            (Some(a), Some(b)) => a.min(b).max(value.min(a.max(b))),
            (_, Some(b)) => b.min(value),
            _ => value,
        };
        self.earlier = self.last;
        self.last = Some(value);
        median
    }
}

/// Low-pass whose cutoff grows with the speed of the signal.
///
/// *Equation*: x̂ ← x̂ + α (x − x̂), α = 1/(1 + τ/Δt), τ = 1/(2π f), f = f_min + b |dx̂/dt|, where the derivative is
/// taken from the last filtered value and itself low-passed at a fixed cutoff. Casiez, Roussel, Vogel, CHI 2012.
#[derive(Clone, Debug)]
pub struct OneEuro {
    /// Cutoff at rest, Hz.
    minimum_cutoff_hz: f64,
    /// Rise of the cutoff with the speed of the signal, Hz per unit a second.
    speed_coefficient: f64,
    /// Cutoff for the speed, Hz.
    derivative_cutoff_hz: f64,
    state: Option<(f64, f64)>,
}

impl OneEuro {
    /// Filter without any value yet.
    pub fn new(minimum_cutoff_hz: f64, speed_coefficient: f64, derivative_cutoff_hz: f64) -> Self {
        Self { minimum_cutoff_hz, speed_coefficient, derivative_cutoff_hz, state: None }
    }

    /// Takes the next value, `interval_s` seconds after the one before, and returns the filtered one. An interval
    /// that is not positive repeats the last result.
    pub fn filter(&mut self, value: f64, interval_s: f64) -> f64 {
        let Some((filtered, speed)) = self.state else {
            self.state = Some((value, 0.0));
            return value;
        };
        if interval_s <= 0.0 {
            return filtered;
        }
        let share = |cutoff_hz: f64| 1.0 / (1.0 + 1.0 / (TAU * cutoff_hz * interval_s));
        let speed = speed + share(self.derivative_cutoff_hz) * ((value - filtered) / interval_s - speed);
        let cutoff_hz = self.minimum_cutoff_hz + self.speed_coefficient * speed.abs();
        let filtered = filtered + share(cutoff_hz) * (value - filtered);
        self.state = Some((filtered, speed));
        filtered
    }
}

#[cfg(test)]
mod tests {
    //! The One Euro filter must give its authors' numbers; a filter that differentiates raw values misses the third.
    use super::*;

    /// Tolerance of the published numbers, which have seven decimals.
    const PUBLISHED: f64 = 1e-7;

    #[test]
    fn one_euro_gives_its_authors_numbers() {
        let mut filter = OneEuro::new(1.0, 0.1, 1.0);
        for (noisy, expected) in [(-0.038_509_9, -0.038_509_9), (-0.028_066_4, -0.037_987_2), (0.048_622, -0.033_442_7)]
        {
            let filtered = filter.filter(noisy, 1.0 / 120.0);
            assert!((filtered - expected).abs() < PUBLISHED, "{filtered} for {expected}");
        }
    }

    #[test]
    fn one_euro_repeats_itself_when_no_time_passes() {
        let mut filter = OneEuro::new(1.0, 0.1, 1.0);
        filter.filter(1.0, 0.1);
        assert_eq!(filter.filter(5.0, 0.0), 1.0);
        assert_eq!(filter.filter(5.0, -1.0), 1.0);
    }

    #[test]
    fn a_dead_zone_rests_about_zero_and_reaches_the_ends() {
        let zoned = [0.0, 0.25, -0.25, 0.625, -1.0, 7.0].map(|value| with_dead_zone(value, 0.25));
        assert_eq!(zoned, [0.0, 0.0, 0.0, 0.5, -1.0, 1.0]);
    }

    #[test]
    fn the_median_ignores_one_outlier() {
        let mut median = MedianOfThree::default();
        assert_eq!(median.filter(2.0), 2.0);
        assert_eq!(median.filter(90.0), 2.0);
        assert_eq!(median.filter(2.1), 2.1);
        assert_eq!(median.filter(2.2), 2.2);
        assert_eq!(median.filter(0.0), 2.1);
    }
}
