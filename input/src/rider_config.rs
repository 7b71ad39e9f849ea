//! Settings of the rider that keys and triggers simulate.

use serde::{Deserialize, Serialize};

use crate::config_error::{ConfigError, positive};

/// Rider simulated by keys and triggers, used without the bicycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RiderConfig {
    /// Speed reached by pedalling, m/s.
    pub cruise_m_s: f64,
    /// Speed with the sprint key, m/s.
    pub sprint_m_s: f64,
    /// Acceleration while pedalling, m/s².
    pub pedal_m_s2: f64,
    /// Deceleration without pedalling, m/s².
    pub coast_m_s2: f64,
    /// Deceleration with the brake pulled through, m/s².
    pub brake_m_s2: f64,
    /// Speed backward, m/s.
    pub reverse_m_s: f64,
    /// Angle of the handlebar at walking pace, radians.
    pub steer_rad: f64,
    /// Largest lateral acceleration by steering, m/s².
    pub lateral_m_s2: f64,
    /// Distance of the axles, metres, which relates the angle to the sharpness of a bend.
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
    pub(crate) fn check(&self) -> Result<(), ConfigError> {
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
