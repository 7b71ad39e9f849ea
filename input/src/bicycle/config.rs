//! Settings of the instrumented bicycle.

use serde::{Deserialize, Serialize};

use crate::config_error::{ConfigError, not_zero, positive};

/// Meaning of a line with a single number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BareNumber {
    /// Speed in km/h.
    #[default]
    KilometresPerHour,
    /// Turns of the wheel a minute.
    WheelTurnsPerMinute,
}

/// Sensor that the speed is made from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SpeedSource {
    /// Sensor of the wheel.
    #[default]
    Wheel,
    /// Sensor of the crank, for a box that counts the pedals alone (B 5.6.1).
    Cadence,
}

/// Geometry and calibration of the instrumented bicycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BicycleConfig {
    /// Distance that the bicycle covers in one turn of the wheel, metres.
    pub wheel_circumference_m: f64,
    /// Number of magnets on the wheel.
    pub pulses_per_wheel_turn: f64,
    /// Number of magnets on the crank.
    pub pulses_per_crank_turn: f64,
    /// Sensor that the speed of a `B1` line is made from.
    pub speed_from: SpeedSource,
    /// Distance that the bicycle covers in one turn of the crank, metres, where the speed is made from the cadence.
    pub metres_per_crank_turn: f64,
    /// Highest speed that can be ridden, m/s. Faster pulses are bounces, larger numbers are faults.
    pub fastest_m_s: f64,
    /// Time without a pulse or a number after which the wheel counts as standing, seconds.
    pub stop_after_s: f64,
    /// Delay of a line that is allowed for before a missing pulse slows the wheel down, seconds: a box that sends
    /// fifty lines a second tells a pulse up to a fiftieth late. 0, as in recordings made before: none.
    #[serde(default = "none_in_old_recordings")]
    pub late_s: f64,
    /// True if the handlebar has a sensor. Without one keys steer, or the program along the street.
    pub handlebar: bool,
    /// Reading of the steering sensor straight ahead.
    pub steer_straight: f64,
    /// Angle per unit of the steering sensor, radians; negative where the reading grows to the right.
    pub steer_rad_per_unit: f64,
    /// Angle to either side within which the handlebar counts as straight, radians. Beyond it the angle counts from
    /// there, without a jump.
    pub steer_dead_rad: f64,
    /// Reading of the brake sensor with the lever released.
    pub brake_released: f64,
    /// Reading of the brake sensor with the lever pulled through.
    pub brake_full: f64,
    /// Exponent from the lever's way, 0 to 1, to the brake: above 1 it brakes softly at first.
    pub brake_curve: f64,
    /// Angle for a steering of 1 in a four-field line, radians; negative where 1 is to the right.
    pub four_field_steer_rad: f64,
    /// Brake in a four-field line with the lever pulled through.
    pub four_field_brake_full: f64,
    /// Meaning of a line with a single number.
    pub bare_number: BareNumber,
    /// True if the speed glides from one bare number to the next. False, as in recordings made before it did: each
    /// holds for half a second and then fades, which saws where numbers come less often than twice a second.
    #[serde(default = "not_in_old_recordings")]
    pub bare_number_glides: bool,
}

fn not_in_old_recordings() -> bool {
    false
}

fn none_in_old_recordings() -> f64 {
    0.0
}

impl Default for BicycleConfig {
    /// Settings for a 28-inch wheel with one magnet, and potentiometers on a ten-bit converter with 270 degrees of
    /// travel.
    fn default() -> Self {
        Self {
            wheel_circumference_m: 2.1,
            pulses_per_wheel_turn: 1.0,
            pulses_per_crank_turn: 1.0,
            speed_from: SpeedSource::default(),
            metres_per_crank_turn: 5.5,
            fastest_m_s: 30.0,
            stop_after_s: 2.0,
            late_s: 0.06,
            handlebar: true,
            steer_straight: 512.0,
            steer_rad_per_unit: -270.0_f64.to_radians() / 1023.0,
            steer_dead_rad: 0.0,
            brake_released: 0.0,
            brake_full: 1023.0,
            brake_curve: 1.0,
            four_field_steer_rad: -0.6,
            four_field_brake_full: 1.0,
            bare_number: BareNumber::default(),
            bare_number_glides: true,
        }
    }
}

impl BicycleConfig {
    /// Distance that the bicycle covers between two pulses, metres.
    pub fn metres_per_pulse(&self) -> f64 {
        self.wheel_circumference_m / self.pulses_per_wheel_turn
    }

    pub(crate) fn check(&self) -> Result<(), ConfigError> {
        positive("bicycle.wheel_circumference_m", self.wheel_circumference_m)?;
        positive("bicycle.pulses_per_wheel_turn", self.pulses_per_wheel_turn)?;
        positive("bicycle.pulses_per_crank_turn", self.pulses_per_crank_turn)?;
        positive("bicycle.metres_per_crank_turn", self.metres_per_crank_turn)?;
        positive("bicycle.fastest_m_s", self.fastest_m_s)?;
        positive("bicycle.stop_after_s", self.stop_after_s)?;
        if !(0.0..=1.0).contains(&self.late_s) {
            let value = self.late_s.to_string();
            return Err(ConfigError { key: "bicycle.late_s", value, expected: "a time from 0 to 1 second" });
        }
        not_zero("bicycle.steer_rad_per_unit", self.steer_rad_per_unit)?;
        not_zero("bicycle.four_field_steer_rad", self.four_field_steer_rad)?;
        if !(0.0..1.0).contains(&self.steer_dead_rad) {
            let value = self.steer_dead_rad.to_string();
            return Err(ConfigError { key: "bicycle.steer_dead_rad", value, expected: "an angle from 0 to 1 radian" });
        }
        if !(0.1..=10.0).contains(&self.brake_curve) {
            let value = self.brake_curve.to_string();
            return Err(ConfigError { key: "bicycle.brake_curve", value, expected: "an exponent from 0.1 to 10" });
        }
        positive("bicycle.four_field_brake_full", self.four_field_brake_full)?;
        if !self.steer_straight.is_finite() {
            let value = self.steer_straight.to_string();
            return Err(ConfigError { key: "bicycle.steer_straight", value, expected: "a finite number" });
        }
        not_zero("bicycle.brake_full - bicycle.brake_released", self.brake_full - self.brake_released)
    }
}

#[cfg(test)]
mod tests {
    //! Law: the header of an old recording means what it meant.
    use super::*;

    #[test]
    fn bare_numbers_glide_and_lines_may_be_late_but_in_old_recordings() {
        assert!(BicycleConfig::default().bare_number_glides && BicycleConfig::default().late_s > 0.0);
        let old: BicycleConfig = serde_json::from_str("{}").unwrap();
        assert_eq!(old, BicycleConfig { bare_number_glides: false, late_s: 0.0, ..Default::default() });
    }
}
