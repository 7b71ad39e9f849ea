//! Value that moves towards its target at a steady rate, driven by a key.
//!
//! A key is down or up, a leg is not. The value between is a function of the time of the last change and the time of
//! asking only, so the number of calls does not matter.

use crate::clock::{Nanos, seconds_between};

/// Ramp from its value at the last change of the target.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ramp {
    from: f64,
    since: Nanos,
    target: f64,
    rate: f64,
}

impl Ramp {
    /// Ramp that rests at a value since `at`.
    pub fn resting(at: Nanos, value: f64) -> Self {
        Self { from: value, since: at, target: value, rate: 0.0 }
    }

    /// Value at the time `at`.
    pub fn value(&self, at: Nanos) -> f64 {
        let way = self.target - self.from;
        let reach = self.rate * seconds_between(self.since, at);
        if way.abs() <= reach { self.target } else { self.from + reach.copysign(way) }
    }

    /// Moves towards `target` from `at` on, by `rate` a second.
    pub fn aim(&mut self, at: Nanos, target: f64, rate: f64) {
        *self = Self { from: self.value(at), since: at, target, rate };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::SECOND;

    #[test]
    fn a_ramp_reaches_its_target_and_stays() {
        let mut ramp = Ramp::default();
        ramp.aim(SECOND, -2.0, 4.0);
        assert_eq!(ramp.value(0), 0.0);
        assert_eq!(ramp.value(SECOND + SECOND / 4), -1.0);
        assert_eq!(ramp.value(SECOND + SECOND / 2), -2.0);
        assert_eq!(ramp.value(100 * SECOND), -2.0);
    }

    #[test]
    fn changing_the_target_does_not_jump() {
        let mut ramp = Ramp::default();
        ramp.aim(0, 1.0, 1.0);
        let before = ramp.value(SECOND / 2);
        ramp.aim(SECOND / 2, 0.0, 3.0);
        assert_eq!(ramp.value(SECOND / 2), before);
        assert_eq!(ramp.value(SECOND), 0.0);
    }
}
