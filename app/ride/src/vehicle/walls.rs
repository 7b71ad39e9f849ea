//! Soft walls: the nearer a wall is, the slower a vehicle may approach it.
//!
//! With d the clearance left, the celerity into the wall is at most d/T. The clearance then falls exponentially and
//! is never used up. The celerity along the wall is not changed, so a vehicle slides and can always leave. This is a
//! constraint and not a force: it is applied to the celerity between two steps of the worldline.
//!
//! A vehicle passes through no wall at any speed. A step is cut into strides that are no longer than the space known
//! to be free, or are shorter than the body ([`stride_m`]). If rounding or a second wall has still let the vehicle
//! come too near, it is pushed back to its clearance, or stays where it was.

use glam::DVec3;
use physics::Celerity;

use super::light_speed::LightSpeed;
use scene::{Surroundings, Wall};

/// Half the width of a rider with elbows, metres.
const BODY_RADIUS_M: f64 = 0.4;
/// Time T above, seconds of own time.
const YIELD_S: f64 = 0.25;
/// Distance within which walls are looked for at usual speeds, metres.
const REACH_M: f64 = 3.0;
/// Distance that is free where no wall is found, metres.
pub(super) const FREE_M: f64 = REACH_M - BODY_RADIUS_M;
/// Longest stride beside a wall, metres: less than the body's radius.
const STRIDE_M: f64 = 0.15;
/// Shortest stride, metres. It lets a vehicle that begins inside a wall get out.
const SHORTEST_STRIDE_M: f64 = 0.01;
/// Smallest radius of the bend in which a bicycle that rolls into a wall is turned along it, metres.
pub(super) const DEFLECTION_RADIUS_M: f64 = 0.5;
/// Fastest turn along a wall that a rider can follow, radians per second of own time.
pub(super) const FASTEST_DEFLECTION_RAD_S: f64 = 3.0;
/// Largest number of strides between walls for one piece of a step.
pub(super) const MOST_STRIDES: usize = 64;
/// Accuracy of distances, metres.
const ROUNDING_M: f64 = 1e-6;

/// Nearest wall that matters for a motion of `distance_m` metres.
pub(super) fn nearest(surroundings: &dyn Surroundings, position: DVec3, distance_m: f64) -> Option<Wall> {
    surroundings
        .nearest_wall(position, REACH_M.max(BODY_RADIUS_M + distance_m))
        .filter(|wall| wall.distance.is_finite())
}

/// Distance that the vehicle may go in any direction before the next look at the walls, metres.
pub(super) fn stride_m(wall: Option<Wall>, distance_m: f64) -> f64 {
    let Some(wall) = wall else { return distance_m };
    let stride = STRIDE_M.min(0.5 * wall.distance).max(SHORTEST_STRIDE_M);
    stride.max(wall.distance - BODY_RADIUS_M)
}

/// Excess of the celerity into the wall over the allowed one; 0 if there is none.
pub(super) fn excess(wall: &Wall, celerity: DVec3, light_speed: LightSpeed) -> f64 {
    (-celerity.dot(wall.normal) - allowed(wall, light_speed)).max(0.0)
}

/// Largest celerity allowed into this wall.
fn allowed(wall: &Wall, light_speed: LightSpeed) -> f64 {
    light_speed.celerity((wall.distance - BODY_RADIUS_M).max(0.0) / YIELD_S)
}

/// Celerity without its excess into the wall.
pub(super) fn slid(wall: &Wall, celerity: DVec3, light_speed: LightSpeed) -> DVec3 {
    celerity + wall.normal * excess(wall, celerity, light_speed)
}

/// Celerity along the unit vector `direction`, reduced until its part into the wall is allowed.
pub(super) fn limited_along(wall: &Wall, direction: DVec3, celerity: f64, light_speed: LightSpeed) -> f64 {
    let into = -direction.dot(wall.normal);
    if into <= 0.0 { celerity } else { celerity.min(allowed(wall, light_speed) / into) }
}

/// End of a motion to `to`, moved so that it is not nearer to a wall than the body's radius, or than the start was; and
/// the wall there. `None` if no such end is found.
pub(super) fn settled(
    surroundings: &dyn Surroundings,
    before: Option<Wall>,
    to: DVec3,
    distance_m: f64,
) -> Option<(DVec3, Option<Wall>)> {
    /// Number of corrections. Two walls of a corner are cleared in turns; with this many, the rest in a right angle
    /// is below the rounding.
    const PUSHES: usize = 8;
    let clearance = clearance_m(before);
    let mut position = to;
    for _ in 0..PUSHES {
        let wall = nearest(surroundings, position, distance_m);
        match wall {
            Some(wall) if wall.distance < clearance - ROUNDING_M => {
                position += wall.normal * (clearance - wall.distance);
            }
            _ => return Some((position, wall)),
        }
    }
    None
}

/// Least distance that a vehicle keeps from walls, metres: the body's radius, or less where it has begun nearer.
fn clearance_m(before: Option<Wall>) -> f64 {
    before.map_or(BODY_RADIUS_M, |wall| wall.distance.min(BODY_RADIUS_M))
}

/// True if a wall that counts where the ground has moved the vehicle is nearer than an elbow can yield, and nearer than
/// the wall at the start.
pub(super) fn is_too_near(before: Option<Wall>, wall: Option<Wall>) -> bool {
    /// Distance by which an elbow yields, metres.
    const ELBOW_M: f64 = 0.015;
    wall.is_some_and(|wall| wall.distance < clearance_m(before).min(BODY_RADIUS_M - ELBOW_M))
}

/// True if the straight way of a stride, with its corrections, from a place where `wall` is the nearest is known to
/// lead through none: it is shorter than the way to the nearest wall, or stays on the near side of one that the
/// shortest stride could pass. A correction away from a wall that counts only at the height where the stride ends may
/// have led through another. A place in a wall is on either side of it.
pub(super) fn leads_through_none(wall: Option<Wall>, way: DVec3, free_m: f64) -> bool {
    let way_m = libm::hypot(way.x, way.z);
    let Some(wall) = wall else { return way_m < free_m.max(FREE_M) + BODY_RADIUS_M };
    let is_beside = wall.distance < 2.0 * SHORTEST_STRIDE_M && way_m < 2.0 * SHORTEST_STRIDE_M;
    way_m < wall.distance
        || wall.distance <= ROUNDING_M
        || (is_beside && wall.distance + way.dot(wall.normal) > ROUNDING_M)
}

/// Celerity with which at most `distance_m` metres are covered in `own_s` seconds.
pub(super) fn slowed(celerity: Celerity, distance_m: f64, own_s: f64, light_speed: LightSpeed) -> Celerity {
    celerity.capped(libm::asinh(light_speed.celerity(distance_m / own_s)))
}
