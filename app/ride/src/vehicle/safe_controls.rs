//! Safe controls: finite and within their ranges. A missing wheel counts as standing still.

use glam::DVec3;
use input::Controls;

/// Largest angle of the handlebar, radians. At a right angle the kinematic bicycle would turn on the spot.
const FARTHEST_STEER_RAD: f64 = 1.2;
/// Largest speed of the pedalled wheel, m/s.
const FASTEST_WHEEL_M_S: f64 = 100.0;

/// Rider's controls after the checks; see [`Controls`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct SafeControls {
    pub(super) wheel_speed_m_s: f64,
    pub(super) steer_rad: f64,
    pub(super) brake: f64,
    pub(super) thrust: DVec3,
    pub(super) turn: DVec3,
    /// True if one of the controls was not a finite number; it counts as released.
    pub(super) contained: bool,
}

impl SafeControls {
    pub(super) fn new(controls: &Controls) -> Self {
        let mut contained = false;
        let mut safe = |value: f64, least: f64, most: f64| {
            contained |= !value.is_finite();
            if value.is_finite() { value.clamp(least, most) } else { 0.0 }
        };
        let mut vector = |values: [f64; 3]| DVec3::from_array(values.map(|value| safe(value, -1.0, 1.0)));
        let (thrust, turn) = (vector(controls.thrust), vector(controls.turn));
        Self {
            wheel_speed_m_s: safe(controls.wheel_speed.unwrap_or(0.0), -FASTEST_WHEEL_M_S, FASTEST_WHEEL_M_S),
            steer_rad: safe(controls.steer_rad, -FARTHEST_STEER_RAD, FARTHEST_STEER_RAD),
            brake: safe(controls.brake, 0.0, 1.0),
            thrust,
            turn,
            contained,
        }
    }
}
