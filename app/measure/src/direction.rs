//! Direction errors: the angle between the direction of a pixel and the exact direction of the light from the place
//! that it shows.
//!
//! The renderer tells the place in the scene that each pixel shows ([`render::Subject::Places`]). The
//! direction from which light from there arrives is known exactly ([`physics::apparent`]). So the error is one of
//! geometry alone: colours, textures and the ray tracer have no part in it.

use glam::DVec3;
use physics::{Observer, apparent};

use super::quantiles::Sorted;

/// Minutes of arc in a radian.
pub const ARCMIN_PER_RAD: f64 = 180.0 * 60.0 / std::f64::consts::PI;

/// Errors of a picture of things at rest in the world, arcminutes for each pixel.
///
/// *Frames:* `shown` pairs the unit direction of each pixel, observer's axes, with the world place that it shows,
/// metres.
pub fn errors(observer: &Observer, shown: impl IntoIterator<Item = (DVec3, DVec3)>) -> Sorted {
    between(shown.into_iter().map(|(direction, place)| (direction, apparent::at_rest(observer, place).position)))
}

/// Angles between pixels' unit directions and the apparent positions of what they show, observer's axes, arcminutes.
pub fn between(pairs: impl IntoIterator<Item = (DVec3, DVec3)>) -> Sorted {
    let error = |(direction, apparent): (DVec3, DVec3)| {
        // Use the chord: the arc cosine of a product close to 1 would lose half the digits.
        2.0 * (0.5 * direction.distance(apparent.normalize_or_zero())).min(1.0).asin() * ARCMIN_PER_RAD
    };
    Sorted::of(pairs.into_iter().map(error))
}

#[cfg(test)]
mod tests {
    //! Angles of known size must come back, however small.

    use super::*;
    use physics::{Celerity, Event};

    #[test]
    fn an_angle_put_in_comes_out() {
        let event = Event { ct: 0.0, position: DVec3::new(3.0, -2.0, 5.0) };
        let observer = Observer { event, celerity: Celerity::ZERO };
        for angle in [1e-12, 1e-6, 1e-3, 1.0_f64] {
            let place = event.position + 7.0 * DVec3::new(angle.sin(), 0.0, -angle.cos());
            let errors = errors(&observer, [(DVec3::NEG_Z, place)]);
            let expected = angle * ARCMIN_PER_RAD;
            assert!((errors.quantile(0.5) - expected).abs() < 1e-3 * expected + 1e-11, "{angle}");
        }
    }

    #[test]
    fn aberration_is_counted_as_what_it_is() {
        // At 0.6 c, light from abeam arrives from cos θ' = 0.6 ahead. A picture that leaves it abeam is off by asin
        // 0.6.
        let observer = Observer { event: Event::default(), celerity: Celerity::new(DVec3::Z * -0.75).expect("finite") };
        let exact = DVec3::new(0.8, 0.0, -0.6);
        let errors = errors(&observer, [(exact, DVec3::X * 9.0), (DVec3::X, DVec3::X * 9.0)]);
        assert!(errors.quantile(0.5) < 1e-11);
        // The results are stored in 24 bits.
        assert!((errors.quantile(1.0) - 0.6_f64.asin() * ARCMIN_PER_RAD).abs() < 2e-4);
        assert_eq!(errors.share_above(1.0), 0.5);
    }
}
