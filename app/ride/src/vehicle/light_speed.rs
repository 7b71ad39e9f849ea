//! Speed of light of a world, and the conversions that depend on it.
//!
//! The physics has no metres per second: times are lengths of light travel, and velocities are celerities. Wheels,
//! brakes and clocks use seconds. This module is the only place where one is converted into the other.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// LightSpeed, as far as its speed of light is concerned.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct LightSpeed {
    speed_of_light_m_s: f64,
}

impl LightSpeed {
    /// Slowest light, m/s. A thousandth of a snail's pace keeps every conversion finite.
    pub const SLOWEST_M_S: f64 = 1e-6;
    /// Fastest light, m/s. Beyond it no relativistic effect can be seen.
    pub const FASTEST_M_S: f64 = 1e12;
    /// Old town of B 5.6.1, with a speed of light of 30 km/h.
    pub const OLD_TOWN: Self = Self { speed_of_light_m_s: 30.0 / 3.6 };

    /// Creates a world whose light has this speed.
    ///
    /// # Errors
    /// [`LightSpeedError`] if the speed lies outside [`LightSpeed::SLOWEST_M_S`] to [`LightSpeed::FASTEST_M_S`], or is not a number.
    pub fn new(speed_of_light_m_s: f64) -> Result<Self, LightSpeedError> {
        if (Self::SLOWEST_M_S..=Self::FASTEST_M_S).contains(&speed_of_light_m_s) {
            Ok(Self { speed_of_light_m_s })
        } else {
            Err(LightSpeedError { speed_of_light_m_s })
        }
    }

    /// Speed of light c, m/s.
    pub fn speed_of_light_m_s(self) -> f64 {
        self.speed_of_light_m_s
    }

    /// Length of light travel, metres, of a time in seconds.
    pub fn metres(self, seconds: f64) -> f64 {
        seconds * self.speed_of_light_m_s
    }

    /// Time in seconds of a length of light travel in metres.
    pub fn seconds(self, metres: f64) -> f64 {
        metres / self.speed_of_light_m_s
    }

    /// Celerity of a speed in metres of road per second of the rider's own time.
    pub fn celerity(self, metres_per_own_second: f64) -> f64 {
        metres_per_own_second / self.speed_of_light_m_s
    }

    /// Speed in metres of road per second of the rider's own time, from a celerity.
    pub fn metres_per_own_second(self, celerity: f64) -> f64 {
        celerity * self.speed_of_light_m_s
    }
}

impl TryFrom<f64> for LightSpeed {
    type Error = LightSpeedError;
    fn try_from(speed_of_light_m_s: f64) -> Result<Self, LightSpeedError> {
        Self::new(speed_of_light_m_s)
    }
}

impl From<LightSpeed> for f64 {
    fn from(light_speed: LightSpeed) -> Self {
        light_speed.speed_of_light_m_s
    }
}

/// Speed of light out of range.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error(
    "the speed of light is {speed_of_light_m_s} m/s: expected {:e} to {:e} m/s",
    LightSpeed::SLOWEST_M_S,
    LightSpeed::FASTEST_M_S
)]
pub struct LightSpeedError {
    /// Speed that was given, m/s.
    pub speed_of_light_m_s: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_become_metres_and_metres_per_second_celerities() {
        let light_speed = LightSpeed::new(8.0).unwrap();
        assert_eq!((light_speed.metres(2.5), light_speed.seconds(20.0)), (20.0, 2.5));
        assert_eq!((light_speed.celerity(6.0), light_speed.metres_per_own_second(0.75)), (0.75, 6.0));
        // This is 30 km/h.
        assert!((LightSpeed::OLD_TOWN.metres(3600.0) - 30_000.0).abs() < 1e-9);
    }

    #[test]
    fn light_that_stands_still_or_is_no_number_is_refused() {
        for speed in [0.0, -1.0, 1e-7, 1e13, f64::NAN, f64::INFINITY] {
            assert!(LightSpeed::new(speed).is_err(), "{speed}");
        }
        assert!(serde_json::from_str::<LightSpeed>("0.0").is_err());
    }
}
