//! Cone of directions, such as the one in which an observer sees a ball.

use glam::{DQuat, DVec3};

/// All directions within an angle of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionCone {
    /// Axis, unit vector.
    pub axis: DVec3,
    /// Half the angle of the cone, radians, from 0 to π. At π it holds all directions.
    pub radius_rad: f64,
}

impl DirectionCone {
    /// The same cone in other axes.
    pub fn turned(&self, target_from_source: DQuat) -> Self {
        Self { axis: target_from_source * self.axis, ..*self }
    }

    /// True if it is convex, so that flat triangles between points in it lie in it.
    pub fn is_convex(&self) -> bool {
        self.radius_rad < std::f64::consts::FRAC_PI_2
    }
}
