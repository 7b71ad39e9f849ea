//! Seeded random vectors and celerities for the tests of this crate.

use physics::Celerity;
use physics::glam::{DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Relative rounding of one f64 operation.
pub const EPSILON: f64 = f64::EPSILON;

/// The one generator of all tests: the same numbers in every run.
pub fn seeded(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// A direction, every one as likely.
pub fn direction(random: &mut ChaCha8Rng) -> DVec3 {
    let z = random.random_range(-1.0..=1.0_f64);
    let (sine, cosine) = random.random_range(0.0..std::f64::consts::TAU).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cosine, radius * sine, z)
}

/// A size between two powers of ten, every decade as likely.
pub fn size(random: &mut ChaCha8Rng, decades: std::ops::Range<f64>) -> f64 {
    10.0_f64.powf(random.random_range(decades))
}

/// A vector of any direction with a size between two powers of ten.
pub fn vector(random: &mut ChaCha8Rng, decades: std::ops::Range<f64>) -> DVec3 {
    direction(random) * size(random, decades)
}

/// A celerity of any direction with a magnitude between two powers of ten.
pub fn celerity(random: &mut ChaCha8Rng, decades: std::ops::Range<f64>) -> Celerity {
    Celerity::new(vector(random, decades)).unwrap()
}

/// A direction `angle` away from `axis`, turned about it at random.
pub fn direction_off(random: &mut ChaCha8Rng, axis: DVec3, angle: f64) -> DVec3 {
    let across = axis.normalize().cross(direction(random)).normalize();
    axis.normalize() * angle.cos() + across * angle.sin()
}

/// An orientation, every one as likely enough for a test.
pub fn orientation(random: &mut ChaCha8Rng) -> DQuat {
    DQuat::from_axis_angle(direction(random), random.random_range(0.0..std::f64::consts::TAU))
}

/// |a − b| as a share of the larger length.
pub fn relative_difference(a: DVec3, b: DVec3) -> f64 {
    a.distance(b) / a.length().max(b.length()).max(f64::MIN_POSITIVE)
}
