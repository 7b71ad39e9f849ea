//! Settings of the devices, checked once when the desk is built.
//!
//! Every setting decides how bytes become controls, so every setting goes into a recording's header.

use serde::{Deserialize, Serialize};

use crate::axis_table::AxisTable;
use crate::bicycle::config::BicycleConfig;
use crate::config_error::ConfigError;
use crate::gamepad_map::GamepadMap;
use crate::head::config::HeadConfig;
use crate::key_map::KeyMap;
use crate::rider_config::RiderConfig;
use crate::trainer::config::TrainerConfig;

/// Settings of all decoders.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DeskConfig {
    /// Settings of the instrumented bicycle.
    pub bicycle: BicycleConfig,
    /// Settings of the trainer.
    pub trainer: TrainerConfig,
    /// Settings for riding the bicycle with keys or a gamepad.
    pub rider: RiderConfig,
    /// Axes of a SpaceMouse read as raw HID.
    pub space_mouse: AxisTable,
    /// Axes of a SpaceMouse read through spacenavd.
    pub spacenavd: AxisTable,
    /// Work of a gamepad's axes and buttons.
    #[serde(skip_serializing_if = "GamepadMap::is_usual")]
    pub gamepad: GamepadMap,
    /// Keys that do the work of others.
    #[serde(skip_serializing_if = "KeyMap::is_empty")]
    pub keys: KeyMap,
    /// Settings of the tracked head; `None` without a tracker, and in recordings made before heads were tracked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub head: Option<HeadConfig>,
    /// True if a SpaceMouse may have more than 64 buttons, and report their numbers; false in recordings made before.
    #[serde(default = "not_in_old_recordings")]
    pub many_buttons: bool,
    /// True if keys that change the picture alone are actions, and a wand rides and acts; false in recordings made
    /// before they did.
    #[serde(default = "not_in_old_recordings")]
    pub all_act: bool,
    /// True if the rider may look round; false in recordings made before one could.
    #[serde(default = "not_in_old_recordings")]
    pub free_look: bool,
}

fn not_in_old_recordings() -> bool {
    false
}

impl Default for DeskConfig {
    fn default() -> Self {
        Self {
            bicycle: BicycleConfig::default(),
            trainer: TrainerConfig::default(),
            rider: RiderConfig::default(),
            space_mouse: AxisTable::RAW,
            spacenavd: AxisTable::SPACENAVD,
            gamepad: GamepadMap::default(),
            keys: KeyMap::default(),
            head: None,
            many_buttons: true,
            all_act: true,
            free_look: true,
        }
    }
}

impl DeskConfig {
    /// Checks every setting.
    ///
    /// # Errors
    /// The first setting that cannot be used.
    pub fn check(&self) -> Result<(), ConfigError> {
        self.bicycle.check()?;
        self.trainer.check()?;
        self.rider.check()?;
        self.space_mouse.check("axes.space_mouse")?;
        self.spacenavd.check("axes.spacenavd")?;
        self.gamepad.check()?;
        self.keys.check()?;
        self.head.as_ref().map_or(Ok(()), HeadConfig::check)
    }
}

#[cfg(test)]
mod tests {
    //! Settings that would lead to a division by zero must be refused.
    use super::*;

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
            assert_eq!(config.check().unwrap_err().key, "axes.spacenavd");
        }
    }
}
