//! What can be set about the devices, checked once when the desk is built.
//!
//! All of it decides how bytes become controls, so all of it goes into a recording's header.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::head::HeadConfig;

/// A setting that cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{key} is {value}: expected {expected}")]
pub struct ConfigError {
    /// The setting's full name.
    pub key: &'static str,
    /// What it is set to.
    pub value: String,
    /// What would do.
    pub expected: &'static str,
}

/// Fails unless the value is positive and of a size that leaves room for arithmetic.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<(), ConfigError> {
    if (1e-6..=1e6).contains(&value) {
        Ok(())
    } else {
        Err(ConfigError { key, value: value.to_string(), expected: "a positive number from 1e-6 to 1e6" })
    }
}

/// Fails unless the value is finite and not zero.
fn not_zero(key: &'static str, value: f64) -> Result<(), ConfigError> {
    if value.is_finite() && value != 0.0 {
        Ok(())
    } else {
        Err(ConfigError { key, value: value.to_string(), expected: "a finite number other than zero" })
    }
}

/// How all devices are read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DeskConfig {
    /// The instrumented bicycle.
    pub bicycle: BicycleConfig,
    /// Riding the bicycle with keys or a gamepad.
    pub rider: RiderConfig,
    /// A SpaceMouse as raw HID.
    pub space_mouse: AxisTable,
    /// A SpaceMouse through spacenavd.
    pub spacenavd: AxisTable,
    /// The tracked head; none in recordings of before there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub head: Option<HeadConfig>,
}

impl Default for DeskConfig {
    fn default() -> Self {
        Self {
            bicycle: BicycleConfig::default(),
            rider: RiderConfig::default(),
            space_mouse: AxisTable::RAW,
            spacenavd: AxisTable::SPACENAVD,
            head: None,
        }
    }
}

impl DeskConfig {
    /// Checks every setting.
    ///
    /// # Errors
    /// Names the first one that cannot be used.
    pub fn check(&self) -> Result<(), ConfigError> {
        self.bicycle.check()?;
        self.rider.check()?;
        self.space_mouse.check("space_mouse")?;
        self.spacenavd.check("spacenavd")?;
        self.head.as_ref().map_or(Ok(()), HeadConfig::check)
    }
}

/// What a line with a single number means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BareNumber {
    /// Speed in km/h.
    #[default]
    KilometresPerHour,
    /// Turns of the wheel a minute.
    WheelTurnsPerMinute,
}

/// Geometry and calibration of the instrumented bicycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BicycleConfig {
    /// Way of the bicycle for one turn of the wheel, metres.
    pub wheel_circumference_m: f64,
    /// Magnets on the wheel.
    pub pulses_per_wheel_turn: f64,
    /// Magnets on the crank.
    pub pulses_per_crank_turn: f64,
    /// Faster cannot be ridden: such pulses are bounces, such numbers are faults. m/s.
    pub fastest_m_s: f64,
    /// After this long without a pulse, or a number, the wheel stands still. Seconds.
    pub stop_after_s: f64,
    /// Reading of the steering sensor straight ahead.
    pub steer_straight: f64,
    /// Angle per unit of the steering sensor, radians; negative where the reading grows to the
    /// right.
    pub steer_rad_per_unit: f64,
    /// Reading of the brake sensor with the lever released.
    pub brake_released: f64,
    /// Reading of the brake sensor with the lever pulled through.
    pub brake_full: f64,
    /// Angle for a steering of 1 in a four-field line, radians; negative where 1 is to the right.
    pub four_field_steer_rad: f64,
    /// Brake in a four-field line with the lever pulled through.
    pub four_field_brake_full: f64,
    /// What a line with a single number means.
    pub bare_number: BareNumber,
}

impl Default for BicycleConfig {
    /// A 28-inch wheel with one magnet, and potentiometers on a ten-bit converter with 270 degrees
    /// of travel.
    fn default() -> Self {
        Self {
            wheel_circumference_m: 2.1,
            pulses_per_wheel_turn: 1.0,
            pulses_per_crank_turn: 1.0,
            fastest_m_s: 30.0,
            stop_after_s: 2.0,
            steer_straight: 512.0,
            steer_rad_per_unit: -270.0_f64.to_radians() / 1023.0,
            brake_released: 0.0,
            brake_full: 1023.0,
            four_field_steer_rad: -0.6,
            four_field_brake_full: 1.0,
            bare_number: BareNumber::default(),
        }
    }
}

impl BicycleConfig {
    /// Way of the bicycle between two pulses, metres.
    pub fn metres_per_pulse(&self) -> f64 {
        self.wheel_circumference_m / self.pulses_per_wheel_turn
    }

    fn check(&self) -> Result<(), ConfigError> {
        positive("bicycle.wheel_circumference_m", self.wheel_circumference_m)?;
        positive("bicycle.pulses_per_wheel_turn", self.pulses_per_wheel_turn)?;
        positive("bicycle.pulses_per_crank_turn", self.pulses_per_crank_turn)?;
        positive("bicycle.fastest_m_s", self.fastest_m_s)?;
        positive("bicycle.stop_after_s", self.stop_after_s)?;
        not_zero("bicycle.steer_rad_per_unit", self.steer_rad_per_unit)?;
        not_zero("bicycle.four_field_steer_rad", self.four_field_steer_rad)?;
        positive("bicycle.four_field_brake_full", self.four_field_brake_full)?;
        if !self.steer_straight.is_finite() {
            let value = self.steer_straight.to_string();
            return Err(ConfigError { key: "bicycle.steer_straight", value, expected: "a finite number" });
        }
        not_zero("bicycle.brake_full - bicycle.brake_released", self.brake_full - self.brake_released)
    }
}

/// A rider made of keys and triggers, for those without the bicycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RiderConfig {
    /// Speed he pedals up to, m/s.
    pub cruise_m_s: f64,
    /// Speed with the sprint key, m/s.
    pub sprint_m_s: f64,
    /// How hard he starts, m/s².
    pub pedal_m_s2: f64,
    /// How the bicycle slows down by itself, m/s².
    pub coast_m_s2: f64,
    /// How it slows down with the brake pulled through, m/s².
    pub brake_m_s2: f64,
    /// How fast he pushes it backward, m/s.
    pub reverse_m_s: f64,
    /// Angle that the handlebar is turned to at walking pace, radians.
    pub steer_rad: f64,
    /// How far he leans: lateral acceleration beyond which he does not steer, m/s².
    pub lateral_m_s2: f64,
    /// Distance of the axles, metres, which says how sharp a bend an angle is.
    pub wheelbase_m: f64,
}

impl Default for RiderConfig {
    fn default() -> Self {
        Self {
            cruise_m_s: 10.0,
            sprint_m_s: 25.0,
            pedal_m_s2: 2.0,
            coast_m_s2: 0.5,
            brake_m_s2: 6.0,
            reverse_m_s: 1.5,
            steer_rad: 0.6,
            lateral_m_s2: 5.0,
            wheelbase_m: 1.1,
        }
    }
}

impl RiderConfig {
    fn check(&self) -> Result<(), ConfigError> {
        positive("rider.cruise_m_s", self.cruise_m_s)?;
        positive("rider.sprint_m_s", self.sprint_m_s)?;
        positive("rider.pedal_m_s2", self.pedal_m_s2)?;
        positive("rider.coast_m_s2", self.coast_m_s2)?;
        positive("rider.brake_m_s2", self.brake_m_s2)?;
        positive("rider.reverse_m_s", self.reverse_m_s)?;
        positive("rider.steer_rad", self.steer_rad)?;
        positive("rider.lateral_m_s2", self.lateral_m_s2)?;
        positive("rider.wheelbase_m", self.wheelbase_m)
    }
}

/// Which axis of a device drives which control, and with which sign.
///
/// Six entries: thrust right, up, backward; turn nose up, nose left, roll left. Each is the number
/// of the device's axis, 1 to 6, negative where it counts the other way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AxisTable(pub [i8; 6]);

impl AxisTable {
    /// Raw HID: x right, y towards the user, z down, and the turns about them.
    pub const RAW: Self = Self([1, -3, 2, 4, -6, 5]);
    /// spacenavd as it is installed: x right, y up, z away from the user, and the same signs for
    /// the turns.
    pub const SPACENAVD: Self = Self([1, 2, -3, 4, 5, -6]);

    /// The six controls from the device's six axes.
    pub fn controls(self, axes: [f64; 6]) -> [f64; 6] {
        self.0.map(|entry| axes[usize::from(entry.unsigned_abs()) - 1] * f64::from(entry.signum()))
    }

    fn check(self, key: &'static str) -> Result<(), ConfigError> {
        if self.0.iter().all(|entry| (1..=6).contains(&entry.unsigned_abs())) {
            Ok(())
        } else {
            Err(ConfigError { key, value: format!("{:?}", self.0), expected: "six axis numbers, each ±1 to ±6" })
        }
    }
}

#[cfg(test)]
mod tests {
    //! Both back ends must turn one push into one control, and no setting may smuggle in a division
    //! by zero.
    use super::*;

    #[test]
    fn both_back_ends_mean_the_same_push() {
        let raw = [10.0, 20.0, 30.0, 40.0, 50.0, 60.0];
        // What spacenavd makes of it: x, −z, −y, for shifts and turns.
        let daemon = [10.0, -30.0, -20.0, 40.0, -60.0, -50.0];
        assert_eq!(AxisTable::RAW.controls(raw), AxisTable::SPACENAVD.controls(daemon));
        assert_eq!(AxisTable::RAW.controls(raw), [10.0, -30.0, 20.0, 40.0, -60.0, 50.0]);
    }

    #[test]
    fn the_defaults_are_sound() {
        assert_eq!(DeskConfig::default().check(), Ok(()));
    }

    #[test]
    fn a_setting_that_cannot_be_used_is_named() {
        let mut config = DeskConfig::default();
        config.bicycle.wheel_circumference_m = 0.0;
        assert_eq!(config.check().unwrap_err().key, "bicycle.wheel_circumference_m");
        let mut config = DeskConfig::default();
        config.rider.lateral_m_s2 = f64::NAN;
        assert_eq!(config.check().unwrap_err().key, "rider.lateral_m_s2");
        let mut config = DeskConfig::default();
        config.bicycle.fastest_m_s = 1e300;
        let error = config.check().unwrap_err().to_string();
        assert!(error.starts_with("bicycle.fastest_m_s is 1") && error.ends_with("from 1e-6 to 1e6"), "{error}");
        let mut config = DeskConfig::default();
        config.bicycle.brake_full = config.bicycle.brake_released;
        assert!(config.check().is_err());
        for entry in [0, 7, -7, i8::MIN] {
            let mut config = DeskConfig::default();
            config.spacenavd.0[2] = entry;
            assert_eq!(config.check().unwrap_err().key, "spacenavd");
        }
    }
}
