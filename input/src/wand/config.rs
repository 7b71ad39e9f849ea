//! Settings of the wand: the table `[tracker.wand]` of a display file.
//!
//! ```
//! # let text = r#"
//! url = "vrpn://192.168.0.10/Head"
//! [wand]
//! sensor = 1
//! buttons = "Wand"
//! wand_from_sensor = { pitch = 15 }
//! trigger = 2
//! # "#;
//! # let config: input::HeadConfig = toml::from_str(text).unwrap();
//! # config.check().unwrap();
//! # assert_eq!(config.wand_devices(), ["Wand"]);
//! ```

use serde::{Deserialize, Serialize};

use super::signal::MOST_AXES;
use super::work::WandButtons;
use crate::config_error::ConfigError;
use crate::head::placement::{AxesPlacement, WAND_FROM_SENSOR};
use crate::vrpn::wire::LONGEST_NAME;

/// Settings of the wand, which the head's tracker sees, too.
///
/// The tracker's axes are placed in the room as the head's are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WandConfig {
    /// Number of the sensor, with VRPN, of the flystick, with DTrack, or of the hand, with OpenXR: 1 left, 2 right.
    pub sensor: i32,
    /// VRPN device of the pose. `None` for the head's device.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub device: Option<String>,
    /// VRPN device of the buttons. `None` for that of the pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub buttons: Option<String>,
    /// VRPN device of the axes. `None` for that of the buttons.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axes: Option<String>,
    /// Placement of the sensor's axes in the wand's, which points along its −z.
    pub wand_from_sensor: AxesPlacement,
    /// Numbers of the stick's axes: to the right, ahead.
    pub stick: StickAxes,
    /// Number of the trigger's axis. `None` without such an axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trigger: Option<u32>,
    /// Actions of the buttons that have not their usual ones.
    #[serde(skip_serializing_if = "WandButtons::are_usual")]
    pub actions: WandButtons,
}

/// Numbers of the axes of a stick: to the right, ahead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct StickAxes(pub [u32; 2]);

impl Default for StickAxes {
    fn default() -> Self {
        Self([0, 1])
    }
}

/// Names of the VRPN devices of a wand.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct WandDevices {
    pub(crate) pose: String,
    pub(crate) buttons: String,
    pub(crate) axes: String,
}

impl WandConfig {
    /// Names of the devices, where the head's is `head`.
    pub(crate) fn devices(&self, head: &str) -> WandDevices {
        let pose = self.device.as_deref().unwrap_or(head);
        let buttons = self.buttons.as_deref().unwrap_or(pose);
        let axes = self.axes.as_deref().unwrap_or(buttons);
        WandDevices { pose: pose.to_owned(), buttons: buttons.to_owned(), axes: axes.to_owned() }
    }

    /// Checks every setting; names have a meaning with a VRPN server alone.
    ///
    /// # Errors
    /// The first setting that cannot be used.
    pub(crate) fn check(&self, has_names: bool) -> Result<(), ConfigError> {
        let names = [
            ("tracker.wand.device", &self.device),
            ("tracker.wand.buttons", &self.buttons),
            ("tracker.wand.axes", &self.axes),
        ];
        for (key, name) in names {
            let Some(name) = name else { continue };
            let expected = if !has_names {
                "nothing but with VRPN; elsewhere wands have numbers: `sensor`"
            } else if name.is_empty() || name.len() >= LONGEST_NAME {
                "the name of a device of the server, of 1 to 99 letters"
            } else {
                continue;
            };
            return Err(ConfigError { key, value: format!("{name:?}"), expected });
        }
        let expected = "numbers of axes from 0 to 127";
        let axes =
            [("tracker.wand.stick", self.stick.0.to_vec()), ("tracker.wand.trigger", Vec::from_iter(self.trigger))];
        for (key, numbers) in axes {
            if numbers.iter().any(|number| *number as usize >= MOST_AXES) {
                return Err(ConfigError { key, value: format!("{numbers:?}"), expected });
            }
        }
        self.actions.check()?;
        self.wand_from_sensor.check(&WAND_FROM_SENSOR)
    }
}
