//! What a vehicle on the ground has to know of the place it moves in: the ground below, the nearest wall.

use glam::DVec3;

/// Ground below a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// World height, metres.
    pub height: f64,
    /// Unit normal, upward, world axes.
    pub normal: DVec3,
}

/// A wall near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// From the point to the nearest place of the wall, metres, not negative.
    pub distance: f64,
    /// Unit vector from that place to the point, world axes, level. On which side of the wall the point lies is all it says.
    pub normal: DVec3,
}

/// A place at rest in the world. Vehicles ask it several times a step, so answers should take microseconds; the same question must
/// always get the same answer, to the bit, or a ride does not replay.
pub trait Surroundings: Send + Sync {
    /// The highest ground that is below `position` or no more than a kerb above it, none where there is nothing to stand on.
    fn height_below(&self, position: DVec3) -> Option<Ground>;

    /// The wall nearest to a vehicle whose reference point on the ground is `position`, none within `reach` metres. The distance must be
    /// that to the nearest wall of all: a way shorter than it is known to be free.
    fn nearest_wall(&self, position: DVec3, reach: f64) -> Option<Wall>;
}

/// Nothing but space.
#[derive(Clone, Copy, Debug, Default)]
pub struct OpenSpace;

impl Surroundings for OpenSpace {
    fn height_below(&self, _: DVec3) -> Option<Ground> {
        None
    }

    fn nearest_wall(&self, _: DVec3, _: f64) -> Option<Wall> {
        None
    }
}

/// An endless plain at the height 0, without a wall.
#[derive(Clone, Copy, Debug, Default)]
pub struct OpenPlane;

impl Surroundings for OpenPlane {
    fn height_below(&self, _: DVec3) -> Option<Ground> {
        Some(Ground { height: 0.0, normal: DVec3::Y })
    }

    fn nearest_wall(&self, _: DVec3, _: f64) -> Option<Wall> {
        None
    }
}
