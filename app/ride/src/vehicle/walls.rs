//! Soft walls: the nearer a wall, the slower a vehicle may come towards it.
//!
//! With d the clearance left, the celerity into the wall is at most d/T: the clearance then falls exponentially and is never used up, and what goes
//! along the wall is left alone, so that a vehicle slides and can always leave. This is a constraint and not a force: it is applied to the celerity
//! between two steps of the worldline.
//!
//! No speed gets a vehicle through. A step is cut so that none covers more than what is known to be free, or than a stride that is shorter than the
//! body ([`stride_m`]); and where rounding or a second wall has let it come too near, it is pushed back to its clearance, or stays where it was.

use glam::DVec3;
use physics::Celerity;

use super::surroundings::{Surroundings, Wall};
use super::world::World;

/// Half the width of a rider and his elbows, metres.
const BODY_RADIUS_M: f64 = 0.4;
/// T above, seconds of own time.
const YIELD_S: f64 = 0.25;
/// Walls farther away than this do nothing at a usual speed, metres.
const REACH_M: f64 = 3.0;
/// Longest stride beside a wall, metres: less than the body's radius.
const STRIDE_M: f64 = 0.15;
/// Shortest stride, metres: one who begins inside a wall gets out.
const SHORTEST_STRIDE_M: f64 = 0.01;
/// A bicycle that rolls into a wall is turned along it in a bend of at least this radius, metres,
pub(super) const DEFLECTION_RADIUS_M: f64 = 0.5;
/// and no faster than a rider can follow, radians per second of own time.
pub(super) const FASTEST_DEFLECTION_RAD_S: f64 = 3.0;
/// Distances are known to about this, metres.
const ROUNDING_M: f64 = 1e-6;

/// The wall that matters for a way of `way_m` metres.
pub(super) fn nearest(surroundings: &dyn Surroundings, position: DVec3, way_m: f64) -> Option<Wall> {
    surroundings.nearest_wall(position, REACH_M.max(BODY_RADIUS_M + way_m)).filter(|wall| wall.distance.is_finite())
}

/// How far one may go in any direction before looking again, metres.
pub(super) fn stride_m(wall: Option<Wall>, way_m: f64) -> f64 {
    let Some(wall) = wall else { return way_m };
    let stride = STRIDE_M.min(0.5 * wall.distance).max(SHORTEST_STRIDE_M);
    stride.max(wall.distance - BODY_RADIUS_M)
}

/// By how much the celerity into the wall is too large, the celerity being that of the motion.
pub(super) fn excess(wall: &Wall, celerity: DVec3, world: World) -> f64 {
    (-celerity.dot(wall.normal) - allowed(wall, world)).max(0.0)
}

/// The largest celerity into this wall.
fn allowed(wall: &Wall, world: World) -> f64 {
    world.celerity((wall.distance - BODY_RADIUS_M).max(0.0) / YIELD_S)
}

/// The celerity, less what is too much of it into the wall.
pub(super) fn slid(wall: &Wall, celerity: DVec3, world: World) -> DVec3 {
    celerity + wall.normal * excess(wall, celerity, world)
}

/// A celerity along the unit vector `direction`, cut until it does not go into the wall too fast.
pub(super) fn limited_along(wall: &Wall, direction: DVec3, celerity: f64, world: World) -> f64 {
    let into = -direction.dot(wall.normal);
    if into <= 0.0 { celerity } else { celerity.min(allowed(wall, world) / into) }
}

/// The end of a way from `from` towards `to`, not nearer to a wall than the body is wide, or than it was before; and the wall there. None where no such
/// end is found.
pub(super) fn settled(
    surroundings: &dyn Surroundings,
    before: Option<Wall>,
    to: DVec3,
    way_m: f64,
) -> Option<(DVec3, Option<Wall>)> {
    /// Two walls of a corner are cleared in turns; this often brings the rest of a right angle below the rounding.
    const PUSHES: usize = 8;
    let clearance = before.map_or(BODY_RADIUS_M, |wall| wall.distance.min(BODY_RADIUS_M));
    let mut position = to;
    for _ in 0..PUSHES {
        let wall = nearest(surroundings, position, way_m);
        match wall {
            Some(wall) if wall.distance < clearance - ROUNDING_M => {
                position += wall.normal * (clearance - wall.distance);
            }
            _ => return Some((position, wall)),
        }
    }
    None
}

/// The celerity with which `way_m` metres are not exceeded in `own_s` seconds.
pub(super) fn slowed(celerity: Celerity, way_m: f64, own_s: f64, world: World) -> Celerity {
    celerity.capped(world.celerity(way_m / own_s).asinh())
}
