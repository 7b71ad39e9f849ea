//! Seeded random numbers, vectors and orientations: the same in every run.

use std::f64::consts::TAU;
use std::ops::Range;

use glam::{DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The generator of all tests.
pub fn seeded(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// A unit vector, every direction as likely.
pub fn direction(random: &mut ChaCha8Rng) -> DVec3 {
    let z = random.random_range(-1.0..=1.0_f64);
    let (sine, cosine) = random.random_range(0.0..TAU).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cosine, radius * sine, z)
}

/// A size between two powers of ten, every decade as likely.
pub fn size(random: &mut ChaCha8Rng, decades: Range<f64>) -> f64 {
    10.0_f64.powf(random.random_range(decades))
}

/// A vector of any direction with a length between two powers of ten.
pub fn vector(random: &mut ChaCha8Rng, decades: Range<f64>) -> DVec3 {
    direction(random) * size(random, decades)
}

/// A unit vector `angle` radians away from `axis`, turned about it at random.
pub fn direction_off(random: &mut ChaCha8Rng, axis: DVec3, angle: f64) -> DVec3 {
    let across = axis.normalize().cross(direction(random)).normalize();
    axis.normalize() * angle.cos() + across * angle.sin()
}

/// A rotation about any axis by any angle.
pub fn orientation(random: &mut ChaCha8Rng) -> DQuat {
    DQuat::from_axis_angle(direction(random), random.random_range(0.0..TAU))
}
