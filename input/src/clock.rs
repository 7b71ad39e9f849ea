//! The ride's clock, and the unit of its time stamps.

use std::time::Instant;

/// Nanoseconds since the ride began, on one monotonic clock for devices and frames alike.
pub type Nanos = u64;

/// One second in [`Nanos`].
pub const SECOND: Nanos = 1_000_000_000;

/// Seconds from `earlier` to `later`; zero if they are the wrong way round, as samples of two threads may be.
pub fn seconds_between(earlier: Nanos, later: Nanos) -> f64 {
    later.saturating_sub(earlier) as f64 * 1e-9
}

/// Monotonic clock of the ride, zero at the start. Copies agree.
#[derive(Clone, Copy, Debug)]
pub struct Clock(Instant);

impl Clock {
    /// Starts a clock at zero.
    pub fn start() -> Self {
        Self(Instant::now())
    }

    /// Time since the start. The range is 584 years.
    pub fn now(self) -> Nanos {
        Nanos::try_from(self.0.elapsed().as_nanos()).unwrap_or(Nanos::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_that_runs_backwards_counts_as_none() {
        assert_eq!(seconds_between(5 * SECOND, 3 * SECOND), 0.0);
        assert_eq!(seconds_between(3 * SECOND, 5 * SECOND), 2.0);
    }
}
