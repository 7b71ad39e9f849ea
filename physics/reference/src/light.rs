//! The textbook's formulas for light, which lose ε γ² astern in f64 and nothing here.

use crate::real::{Real, RealVec, gamma, real};

/// Apparent displacement x' of a point at rest at displacement `d`, and its Doppler factor D = |x'| / |d|, for an
/// observer of celerity `u`.
///
/// *Equation:* the emission event (−|d|, d) boosted, x' = d + u (|d| + u·d / (1 + γ)) (W 4.1). `d` is not zero.
pub fn boosted_light(u: &RealVec, d: &RealVec) -> (RealVec, Real) {
    let r = d.length();
    let along = u.dot(d);
    let image = d + &(u * &(&r + along / (real(1.0) + gamma(u))));
    let doppler = image.length() / r;
    (image, doppler)
}

/// Retarded displacement of a source of celerity `u` that is at displacement `d` now, and the light's travel time,
/// metres (B eq. 2.22).
pub fn retarded(d: &RealVec, u: &RealVec) -> (RealVec, Real) {
    let gamma = gamma(u);
    let beta = u * &(real(1.0) / &gamma);
    let along = beta.dot(d);
    let gamma_squared = &gamma * &gamma;
    let age = &gamma_squared * (&along * real(-1.0) + (&along * &along + d.dot(d) / &gamma_squared).sqrt());
    (d - &(&beta * &age), age)
}

#[cfg(test)]
mod tests {
    //! Law: light travels at c. At β = 0.6 everything is a ratio of small numbers.
    use super::*;
    use crate::real::to_f64;
    use glam::DVec3;

    #[test]
    fn at_three_fifths_of_light_speed_a_point_ahead_is_twice_as_far() {
        let u = RealVec::new(DVec3::X * 0.75);
        for (d, image, doppler) in [(DVec3::X, DVec3::X * 2.0, 2.0), (-DVec3::X, DVec3::X * -0.5, 0.5)] {
            let (seen, factor) = boosted_light(&u, &RealVec::new(d));
            assert_eq!(seen.0.map(|component| to_f64(&component)), image.to_array());
            assert_eq!(to_f64(&factor), doppler);
        }
    }

    #[test]
    fn retarded_source_is_as_far_as_its_light_has_travelled() {
        let (d, age) = retarded(&RealVec::new(DVec3::new(3.0, -1.0, 2.0)), &RealVec::new(DVec3::new(0.5, 2.0, -7.0)));
        assert!(to_f64(&((d.length() - &age) / &age)).abs() < 1e-150);
    }
}
