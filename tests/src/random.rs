//! Seeded random numbers: the same in every run.

use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Random generator of all tests.
pub fn seeded(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// Random unit vector, all directions equally likely.
pub fn direction(random: &mut ChaCha8Rng) -> DVec3 {
    let z = random.random_range(-1.0..=1.0_f64);
    let (sine, cosine) = random.random_range(0.0..std::f64::consts::TAU).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cosine, radius * sine, z)
}
