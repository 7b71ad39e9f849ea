//! Motion along the ground.
//!
//! A wheel does not jump up a kerb. The vehicle examines the ground a little ahead along its motion and turns its
//! motion up or down to meet it, with an acceleration like that of any other turn. Within one look-ahead distance l
//! it settles on the ground without overshooting: with y the height above the ground and s the distance,
//! y″ + (k/l) y′ + (k/l²) y = 0, critically damped for k = 4.

use glam::{DQuat, DVec3};

use scene::Surroundings;

/// Look-ahead distance, metres: about a wheelbase.
const LOOK_M: f64 = 0.8;
/// Stiffness k of the equation above.
const STIFFNESS: f64 = 4.0;
/// Smallest look-ahead distance, in lengths of one step.
const LOOK_PER_STEP: f64 = 4.0;
/// Steepest course up or down, radians.
const STEEPEST_RAD: f64 = 0.5;
/// Fastest change of pitch, radians per second of own time.
const FASTEST_PITCH_RAD_S: f64 = 20.0;

/// Direction in which the ground lets the motion go.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct GroundCourse {
    /// Angle above the horizon that leads back to the ground, radians.
    slope_rad: f64,
    /// Look-ahead distance, metres.
    look_m: f64,
}

impl GroundCourse {
    /// Course along the ground ahead. `direction` is the unit vector of the motion, not vertical; `distance_m` is the
    /// distance until the next look, metres. Where there is no ground, the course is level.
    pub(super) fn ahead(surroundings: &dyn Surroundings, position: DVec3, direction: DVec3, distance_m: f64) -> Self {
        let look_m = LOOK_M.max(LOOK_PER_STEP * distance_m);
        // The look goes along the present slope, so that a hill is not taken for a step.
        let ahead = position + direction * (look_m / libm::hypot(direction.x, direction.z));
        let height = surroundings.height_below(ahead).map(|ground| ground.height);
        let slope_rad = height.map_or(0.0, |height| libm::atan2(height - position.y, look_m));
        Self { slope_rad: slope_rad.clamp(-STEEPEST_RAD, STEEPEST_RAD), look_m }
    }

    /// Course for a nose that points backward.
    pub(super) fn reversed(self) -> Self {
        Self { slope_rad: -self.slope_rad, ..self }
    }

    /// Rate at which a motion at `slope_rad` above the horizon turns upward, radians per second, at a speed in m/s.
    /// Rate and speed both count own time.
    pub(super) fn pitch_rate_rad_s(&self, slope_rad: f64, speed_m_s: f64) -> f64 {
        let rate = STIFFNESS * speed_m_s * (self.slope_rad - slope_rad) / self.look_m;
        rate.clamp(-FASTEST_PITCH_RAD_S, FASTEST_PITCH_RAD_S)
    }
}

/// Point of the ground below `position`, or `position` itself where there is no ground.
pub(super) fn placed(surroundings: &dyn Surroundings, position: DVec3) -> DVec3 {
    surroundings.height_below(position).map_or(position, |ground| DVec3 { y: ground.height, ..position })
}

/// Level unit vector along which the nose points. For a nose straight up or down, the vehicle's floor or roof gives
/// the direction.
pub(super) fn heading(orientation: DQuat) -> DVec3 {
    /// Horizontal part of the nose's unit vector below which the nose has no heading.
    const UPRIGHT: f64 = 1e-3;
    let nose = orientation * DVec3::NEG_Z;
    let level = |vector: DVec3| DVec3 { y: 0.0, ..vector };
    let along = if level(nose).length() > UPRIGHT { nose } else { orientation * DVec3::Y * -nose.y };
    level(along).normalize_or(DVec3::NEG_Z)
}

/// Orientation without roll whose nose points along `nose`, a unit vector that is not vertical.
pub(super) fn upright(nose: DVec3) -> DQuat {
    let right = nose.cross(DVec3::Y).normalize_or(DVec3::X);
    DQuat::from_mat3(&glam::DMat3::from_cols(right, right.cross(nose), -nose)).normalize()
}
