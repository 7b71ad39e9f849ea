//! Assignment of a SpaceMouse's axes to the controls.

use serde::{Deserialize, Serialize};

use crate::config_error::ConfigError;

/// Assignment of a device's axes to the controls, with signs.
///
/// Six entries: thrust right, up, backward; turn nose up, nose left, roll left. Each is the number of the device's
/// axis, 1 to 6, negative where the axis counts the other way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AxisTable(pub [i8; 6]);

impl AxisTable {
    /// Raw HID: x right, y towards the user, z down, and the turns about them.
    pub const RAW: Self = Self([1, -3, 2, 4, -6, 5]);
    /// Axes of spacenavd as installed: x right, y up, z away from the user, and the same signs for the turns.
    pub const SPACENAVD: Self = Self([1, 2, -3, 4, 5, -6]);

    /// Six controls from the device's six axes.
    pub fn controls(self, axes: [f64; 6]) -> [f64; 6] {
        self.0.map(|entry| axes[usize::from(entry.unsigned_abs()) - 1] * f64::from(entry.signum()))
    }

    pub(crate) fn check(self, key: &'static str) -> Result<(), ConfigError> {
        if self.0.iter().all(|entry| (1..=6).contains(&entry.unsigned_abs())) {
            Ok(())
        } else {
            Err(ConfigError { key, value: format!("{:?}", self.0), expected: "six axis numbers, each ±1 to ±6" })
        }
    }
}

#[cfg(test)]
mod tests {
    //! The tables of both back ends must turn one push into one control.
    use super::*;

    #[test]
    fn both_back_ends_mean_the_same_push() {
        let raw = [10.0, 20.0, 30.0, 40.0, 50.0, 60.0];
        // Axes that spacenavd makes of the raw ones: x, −z, −y, for shifts and turns.
        let daemon = [10.0, -30.0, -20.0, 40.0, -60.0, -50.0];
        assert_eq!(AxisTable::RAW.controls(raw), AxisTable::SPACENAVD.controls(daemon));
        assert_eq!(AxisTable::RAW.controls(raw), [10.0, -30.0, 20.0, 40.0, -60.0, 50.0]);
    }
}
