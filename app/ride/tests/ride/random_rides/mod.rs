//! Law: whatever its devices send, a ride's numbers stay finite; a bicycle and a car stay in the streets, on the
//! ground and clear of walls; a spaceship passes through no surface; and when all is let go, fresh keys move the
//! vehicle again without a restart. A wrong program throws a rider over a roof, or leaves one caught in a corner.
//!
//! The example `random_rides` rides as many as it is told to.

mod devices;
#[allow(dead_code, reason = "the example tells more of a ride")]
mod fuzzed_ride;
mod kinds;
#[allow(dead_code, reason = "the example tells more of the streets")]
mod streets;

use rayon::prelude::*;
use std::sync::Arc;

use built_in::spectra;
use scene::collision::Collision;

use super::town::TOWN;
use fuzzed_ride::{RidingGround, ride};

/// Number of rides.
const RIDES: u64 = 300;

#[test]
fn random_rides_stay_in_the_streets_move_again_and_meet_no_nan() {
    let hall = spectra::build();
    let hall_collision = Arc::new(Collision::new(&hall).unwrap());
    let grounds =
        [RidingGround::new("town", &TOWN.0, TOWN.1.clone()), RidingGround::new("spectra", &hall, hall_collision)];
    let broken: Vec<String> = (0..RIDES).into_par_iter().filter_map(|seed| ride(seed, &grounds).err()).collect();
    assert!(broken.is_empty(), "{} of {RIDES} rides: {}", broken.len(), broken.join("\n"));
}
