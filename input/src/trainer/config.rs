//! Settings of the trainer.

use serde::{Deserialize, Serialize};

use crate::config_error::{ConfigError, positive};

/// Settings that decide how a trainer's notifications become a speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TrainerConfig {
    /// Highest speed that can be ridden, m/s; larger ones are faults.
    pub fastest_m_s: f64,
    /// Time in which the speed fades to zero when notifications end, seconds.
    pub stop_after_s: f64,
    /// Distance per turn of the wheel, metres, for trainers that send revolutions instead of a speed.
    pub wheel_circumference_m: f64,
}

impl Default for TrainerConfig {
    /// Settings that fit every trainer: the wheel is the one that trainers pretend to have.
    fn default() -> Self {
        Self { fastest_m_s: 40.0, stop_after_s: 2.0, wheel_circumference_m: 2.096 }
    }
}

impl TrainerConfig {
    pub(crate) fn check(&self) -> Result<(), ConfigError> {
        positive("trainer.fastest_m_s", self.fastest_m_s)?;
        positive("trainer.stop_after_s", self.stop_after_s)?;
        positive("trainer.wheel_circumference_m", self.wheel_circumference_m)
    }
}
