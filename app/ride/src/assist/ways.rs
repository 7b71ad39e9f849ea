//! Free ways: how far a vehicle can go in a direction before a wall stops it.
//!
//! A way is followed over the ground in strides as long as the nearest wall is away, so it misses none.

use glam::DVec3;
use scene::Surroundings;

/// Distance from walls that a way keeps, metres: the body's radius and a hand's breadth.
const MARGIN_M: f64 = 0.55;
/// Distance within which walls are looked for at each place of a way, metres.
const REACH_M: f64 = 3.0;
/// Shortest stride, metres. It lets a way lead out of the margin of a wall beside it.
const SHORTEST_M: f64 = 0.15;
/// Angle between two ways that are compared, radians.
const SPACING_RAD: f64 = std::f64::consts::PI / 18.0;
/// Number of ways to either side.
const TO_EITHER_SIDE: u32 = 18;
/// Length of free way for which a way to the side by one radian is taken, metres.
const PREFERENCE_M_PER_RAD: f64 = 4.0;

/// Length of the free way from a point on the ground along a level unit vector, metres, up to `most_m`.
pub(super) fn free_m(surroundings: &dyn Surroundings, from: DVec3, direction: DVec3, most_m: f64) -> f64 {
    let mut gone_m = 0.0;
    let mut place = from;
    let mut before_m = 0.0;
    while gone_m < most_m {
        let clear_m = surroundings.nearest_wall(place, REACH_M).map_or(REACH_M, |wall| wall.distance);
        // A way out of a wall's margin is free as long as it leads away.
        if clear_m < MARGIN_M && clear_m <= before_m {
            return gone_m;
        }
        let stride_m = (clear_m - MARGIN_M).max(SHORTEST_M);
        before_m = clear_m;
        gone_m += stride_m;
        place += direction * stride_m;
        place.y = surroundings.height_below(place).map_or(place.y, |ground| ground.height);
    }
    most_m
}

/// Direction of the best way round the level unit vector `wanted`, and its free length: a long one, and not far from
/// `wanted`.
pub(super) fn best(surroundings: &dyn Surroundings, from: DVec3, wanted: DVec3, most_m: f64) -> (DVec3, f64) {
    let left = DVec3::Y.cross(wanted);
    let mut found = (wanted, free_m(surroundings, from, wanted, most_m));
    let mut best_m = found.1;
    for step in 1..=TO_EITHER_SIDE {
        let angle = f64::from(step) * SPACING_RAD;
        let cost_m = PREFERENCE_M_PER_RAD * angle;
        if most_m - cost_m <= best_m {
            break;
        }
        for side in [1.0, -1.0] {
            let direction = wanted * libm::cos(angle) + left * (side * libm::sin(angle));
            let free = free_m(surroundings, from, direction, most_m);
            if free - cost_m > best_m {
                (best_m, found) = (free - cost_m, (direction, free));
            }
        }
    }
    found
}
