//! Footing of a vehicle on the ground: the ground does not let it go, however fast it is, and has an end.
//!
//! The motion along the ground ([`super::ground`]) turns up and down no faster than a rider can follow. At a high
//! celerity that would throw a vehicle off the first kerb and over the roofs, and nothing stops it where the ground
//! ends. So, after each stride, a vehicle that had ground below is held: it rises no further above the ground than a
//! wheel on a kerb's ramp, sinks at least at a slope while it is higher, is lifted until it finds the ground that it
//! has run into, and stops where there is no ground.

use glam::DVec3;
use scene::{Ground, Surroundings};

/// Height above the ground up to which a vehicle moves freely, metres: a kerb, and its ramp.
const LOOSE_M: f64 = 0.25;
/// Least slope at which a vehicle sinks while it is higher.
const SINK: f64 = 0.3;
/// Height up to which ground is found in which a vehicle has sunk, besides a kerb's, metres.
const SUNK_M: f64 = 0.3;
/// Depth in the ground to which a vehicle that is deeper is lifted, metres: just enough for the ground to be found.
const SUNK_HELD_M: f64 = scene::collision::STEP - 1e-3;
/// Height besides, up to which a vehicle that stops at the end of the ground is left where it is, metres.
const LEFT_M: f64 = 0.2;
/// Number of halvings of a stride in search of the end of the ground.
const HALVINGS: usize = 6;

/// End of a stride on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Footing {
    /// The stride may end where it did.
    Free,
    /// The stride ends on another height; the motion is level there.
    Level(DVec3),
    /// The ground ends; the vehicle stops here.
    Edge(DVec3),
}

impl Footing {
    /// Footing at the end of a stride from `before` to `to`. A place without ground below has none to lose.
    pub(super) fn of(surroundings: &dyn Surroundings, before: DVec3, to: DVec3) -> Self {
        if surroundings.height_below(before).is_none() {
            return Self::Free;
        }
        let Some(ground) = surroundings.height_below(to + SUNK_M * DVec3::Y) else {
            let last = last_on_ground(surroundings, before, to);
            let highest = surroundings.height_below(last).map_or(last.y, |ground| highest(ground, before, last));
            let is_high = last.y > highest + LEFT_M;
            return Self::Edge(DVec3 { y: if is_high { highest } else { last.y }, ..last });
        };
        let rise_m = to.y - ground.height;
        let highest = highest(ground, before, to);
        if to.y > highest {
            Self::Level(DVec3 { y: highest, ..to })
        } else if rise_m < -scene::collision::STEP {
            Self::Level(DVec3 { y: ground.height - SUNK_HELD_M, ..to })
        } else {
            Self::Free
        }
    }
}

/// Greatest height at `to`, above this ground, after a stride from `before`.
fn highest(ground: Ground, before: DVec3, to: DVec3) -> f64 {
    let way_m = libm::hypot(to.x - before.x, to.z - before.z);
    (ground.height + LOOSE_M).max(before.y - SINK * way_m)
}

/// Last place with ground below on the way from `before`, which has some, to `to`.
fn last_on_ground(surroundings: &dyn Surroundings, before: DVec3, to: DVec3) -> DVec3 {
    let (mut from, mut share) = (before, 0.5);
    for _ in 0..HALVINGS {
        let tried = from + (to - before) * share;
        if surroundings.height_below(tried).is_some() {
            from = tried;
        }
        share *= 0.5;
    }
    from
}
