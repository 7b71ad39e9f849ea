//! The controls, made safe: finite, within their ranges, with a wheel that stands still where there is none.

use glam::DVec3;
use input::Controls;

/// No handlebar turns further than this, radians: at a right angle the kinematic bicycle would turn on the spot.
const FARTHEST_STEER_RAD: f64 = 1.2;
/// No wheel is pedalled faster than this, m/s.
const FASTEST_WHEEL_M_S: f64 = 100.0;

/// What the rider wants, see [`Controls`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Wishes {
    pub(super) wheel_speed_m_s: f64,
    pub(super) steer_rad: f64,
    pub(super) brake: f64,
    pub(super) thrust: DVec3,
    pub(super) turn: DVec3,
    /// Whether one of the controls was no finite number; it counts as let go.
    pub(super) contained: bool,
}

impl Wishes {
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
