//! Surroundings of a vehicle on the ground: the ground below and the nearest wall.

use glam::DVec3;

/// Ground below a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Height of the ground in the world, metres.
    pub height: f64,
    /// Unit normal, upward, world axes.
    pub normal: DVec3,
}

/// A wall near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Distance from the point to the nearest place of the wall, metres, not negative.
    pub distance: f64,
    /// Unit vector from that place to the point, world axes; level for a wall beside a vehicle on the ground. It tells
    /// only on which side of the wall the point lies.
    pub normal: DVec3,
}

/// Place at rest in the world. A vehicle asks it several times per step, so an answer should take microseconds. The
/// same question must always get the same answer, to the bit, or a ride cannot be replayed.
pub trait Surroundings: Send + Sync {
    /// Highest ground that is below `position`, or above it by at most a kerb; `None` where there is nothing to stand
    /// on.
    fn height_below(&self, position: DVec3) -> Option<Ground>;

    /// Wall nearest to a vehicle whose reference point on the ground is `position`; `None` if there is none within
    /// `reach` metres. The distance must be that of the nearest of all walls: any shorter way is known to be free.
    fn nearest_wall(&self, position: DVec3, reach: f64) -> Option<Wall>;

    /// Place of any solid surface nearest to `position`, in space; `None` if there is none within `reach` metres. The
    /// normal points from that place to `position` and need not be level. The distance must be that of the nearest of
    /// all surfaces: any shorter way is known to be free.
    fn nearest_surface(&self, _position: DVec3, _reach: f64) -> Option<Wall> {
        None
    }

    /// Corners of a closed route on the ground, world metres; empty where there is none.
    fn circuit(&self) -> &[DVec3] {
        &[]
    }
}

/// Empty space: no ground and no wall.
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

/// Endless plain at height 0, without walls.
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
