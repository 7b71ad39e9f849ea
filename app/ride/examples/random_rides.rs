//! Rides in the hands of chance: fuzzed devices, random actions, all vehicles, several scenes and speeds of light.
//!
//!     cargo run --release -p ride --example random_rides -- [RIDES [FIRST-SEED]]
//!
//! A ride is repeated by its seed. It ends with status 1 if a ride left the streets, stuck for good, met a number that
//! is not finite, or was not the same the second time.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example prints its figures, and ends at a failure")]

#[path = "../tests/ride/random_rides/devices.rs"]
mod devices;
#[path = "../tests/ride/random_rides/fuzzed_ride.rs"]
mod fuzzed_ride;
#[path = "../tests/ride/random_rides/streets.rs"]
mod streets;

use std::collections::BTreeMap;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use built_in::lattice::Lattice;
use built_in::{spectra, town};
use fuzzed_ride::{FuzzedRide, RidingGround, ride};
use rayon::prelude::*;
use scene::Scene;
use scene::collision::Collision;

/// One ride of so many is ridden twice and compared to the bit.
const REPEATED: u64 = 64;
/// Time of a ride that is printed, seconds.
const SLOW_S: f64 = 2.0;
/// Number of rides between two prints.
const PRINT: u64 = 1_000;
/// Number of broken laws that are printed.
const SHOWN: usize = 40;

fn main() -> ExitCode {
    let arguments: Vec<u64> = std::env::args().skip(1).filter_map(|text| text.parse().ok()).collect();
    let rides = arguments.first().copied().unwrap_or(10_000);
    let first = arguments.get(1).copied().unwrap_or(0);
    let grounds = [("town", town::build(1)), ("spectra", spectra::build()), ("lattice", Lattice::default().build())];
    let grounds = grounds.map(|(name, scene): (_, Scene)| {
        let ground = RidingGround::new(name, &scene, Arc::new(Collision::new(&scene).unwrap()));
        println!("{}", ground.description());
        ground
    });

    let (begun, done) = (Instant::now(), AtomicU64::new(0));
    let outcomes: Vec<Result<FuzzedRide, String>> = (first..first + rides)
        .into_par_iter()
        .map(|seed| {
            let started = Instant::now();
            let outcome = ride(seed, &grounds);
            if started.elapsed().as_secs_f64() > SLOW_S {
                println!("seed {seed} took {:.1} s", started.elapsed().as_secs_f64());
            }
            let number = done.fetch_add(1, Ordering::Relaxed) + 1;
            if number.is_multiple_of(PRINT) {
                println!("{number} rides in {:.0} s", begun.elapsed().as_secs_f64());
            }
            let first = outcome?;
            let same = !seed.is_multiple_of(REPEATED) || {
                let again = ride(seed, &grounds)?;
                first.last.first_difference(&again.last).is_none()
            };
            if same { Ok(first) } else { Err(format!("seed {seed}: another ride the second time")) }
        })
        .collect();

    let (kept, broken): (Vec<_>, Vec<_>) = outcomes.into_iter().partition(Result::is_ok);
    let kept: Vec<FuzzedRide> = kept.into_iter().flatten().collect();
    let mut moved = BTreeMap::new();
    kept.iter().for_each(|ride| *moved.entry((ride.in_streets, ride.moved_by)).or_insert(0_u64) += 1);
    for ((in_streets, moved_by), number) in moved {
        println!("{} in streets: {in_streets}; moved again by {moved_by:?}", number);
    }
    let fastest = kept.iter().map(|ride| ride.fastest).fold(0.0, f64::max);
    let waited: u64 = kept.iter().map(|ride| ride.not_integrated).sum();
    println!("fastest celerity {fastest:.1e}; {waited} frames with a step that could not be integrated");
    println!("{} ticks", kept.iter().map(|ride| ride.ticks).sum::<u64>());
    println!("{rides} rides in {:.0} s, {} broke a law", begun.elapsed().as_secs_f64(), broken.len());
    broken.iter().take(SHOWN).filter_map(|outcome| outcome.as_ref().err()).for_each(|law| println!("{law}"));
    if broken.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
