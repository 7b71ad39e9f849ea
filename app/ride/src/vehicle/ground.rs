//! Staying on the ground.
//!
//! A wheel does not teleport up a kerb. The vehicle looks a little way ahead along its motion, sees how much higher or lower the ground is there,
//! and turns its motion up or down accordingly, with an acceleration like that of any other turn. Over a distance of one look it settles on the
//! ground without overshooting: with y the height above it and s the way, y″ + (k/l) y′ + (k/l²) y = 0, critically damped for k = 4.

use glam::{DQuat, DVec3};

use super::surroundings::Surroundings;

/// How far ahead the ground is looked at, metres: about a wheelbase.
const LOOK_M: f64 = 0.8;
/// k above.
const STIFFNESS: f64 = 4.0;
/// A look goes at least this many steps ahead.
const LOOK_PER_STEP: f64 = 4.0;
/// The steepest way up or down, radians.
const STEEPEST_RAD: f64 = 0.5;
/// Nothing pitches faster than this, radians per second of own time.
const FASTEST_PITCH_RAD_S: f64 = 20.0;

/// Which way the ground wants the motion to go.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Course {
    /// Angle above the horizon that leads back to the ground, radians.
    slope_rad: f64,
    /// Look-ahead, metres.
    look_m: f64,
}

impl Course {
    /// Looks at the ground ahead; `direction` is the unit vector of the motion, not vertical, `way_m` what will be ridden before the next look. Where there is
    /// no ground the way is level.
    pub(super) fn ahead(surroundings: &dyn Surroundings, position: DVec3, direction: DVec3, way_m: f64) -> Self {
        let look_m = LOOK_M.max(LOOK_PER_STEP * way_m);
        // Look along the present slope, so that a hill is not taken for a step.
        let ahead = position + direction * (look_m / direction.x.hypot(direction.z));
        let height = surroundings.height_below(ahead).map(|ground| ground.height);
        let slope_rad = height.map_or(0.0, |height| (height - position.y).atan2(look_m));
        Self { slope_rad: slope_rad.clamp(-STEEPEST_RAD, STEEPEST_RAD), look_m }
    }

    /// The same for a nose that points backward.
    pub(super) fn reversed(self) -> Self {
        Self { slope_rad: -self.slope_rad, ..self }
    }

    /// The rate at which a motion at `slope_rad` above the horizon is to turn upward, radians per second, at this speed in m/s (both by the own
    /// clock).
    pub(super) fn pitch_rate_rad_s(&self, slope_rad: f64, speed_m_s: f64) -> f64 {
        let rate = STIFFNESS * speed_m_s * (self.slope_rad - slope_rad) / self.look_m;
        rate.clamp(-FASTEST_PITCH_RAD_S, FASTEST_PITCH_RAD_S)
    }
}

/// The point of the ground below, or the point itself where there is none.
pub(super) fn placed(surroundings: &dyn Surroundings, position: DVec3) -> DVec3 {
    surroundings.height_below(position).map_or(position, |ground| DVec3 { y: ground.height, ..position })
}

/// The level unit vector along which the nose points; for a nose straight up or down, along which the roof or the floor does.
pub(super) fn heading(orientation: DQuat) -> DVec3 {
    /// Closer to the vertical than this the nose has no heading.
    const UPRIGHT: f64 = 1e-3;
    let nose = orientation * DVec3::NEG_Z;
    let level = |vector: DVec3| DVec3 { y: 0.0, ..vector };
    let along = if level(nose).length() > UPRIGHT { nose } else { orientation * DVec3::Y * -nose.y };
    level(along).normalize_or(DVec3::NEG_Z)
}

/// The orientation without roll whose nose points along `nose`, a unit vector that is not vertical.
pub(super) fn upright(nose: DVec3) -> DQuat {
    let right = nose.cross(DVec3::Y).normalize_or(DVec3::X);
    DQuat::from_mat3(&glam::DMat3::from_cols(right, right.cross(nose), -nose)).normalize()
}
