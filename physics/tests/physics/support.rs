//! Random celerities, and the measure of a vector's error, for the tests of this crate.

use exact_reference::random::vector;
use physics::Celerity;
use physics::glam::DVec3;
use rand_chacha::ChaCha8Rng;

/// Relative rounding of one f64 operation.
pub const EPSILON: f64 = f64::EPSILON;

/// A celerity of any direction with a magnitude between two powers of ten.
pub fn celerity(random: &mut ChaCha8Rng, decades: std::ops::Range<f64>) -> Celerity {
    Celerity::new(vector(random, decades)).unwrap()
}

/// |a − b| as a share of the larger length.
pub fn relative_difference(a: DVec3, b: DVec3) -> f64 {
    a.distance(b) / a.length().max(b.length()).max(f64::MIN_POSITIVE)
}
