//! How far from its place is everything drawn: the angle between the direction that a pixel sees and the one in which light really comes from
//! what it shows.
//!
//! The renderer is asked for the place in the scene that each pixel shows ([`crate::renderers::Subject::Places`]); where light from there arrives is
//! known exactly ([`physics::apparent`]). So the error is one of geometry alone: colours, textures and the ray tracer have no part in it.

use glam::DVec3;
use physics::{Observer, apparent};

use super::quantiles::Sorted;

/// Minutes of arc in a radian.
pub const ARCMIN_PER_RAD: f64 = 180.0 * 60.0 / std::f64::consts::PI;

/// Of a picture of things at rest in the world: by how many arcminutes each pixel is off.
///
/// *Frames:* `shown` pairs the unit direction of each pixel, observer's axes, with the world place it shows, metres.
pub fn errors(observer: &Observer, shown: impl IntoIterator<Item = (DVec3, DVec3)>) -> Sorted {
    between(shown.into_iter().map(|(direction, place)| (direction, apparent::at_rest(observer, place).position)))
}

/// The same of pixels' unit directions and the apparent positions of what they show, observer's axes.
pub fn between(pairs: impl IntoIterator<Item = (DVec3, DVec3)>) -> Sorted {
    let error = |(direction, apparent): (DVec3, DVec3)| {
        // By the chord: the arc cosine of a product next to 1 would lose half the digits.
        2.0 * (0.5 * direction.distance(apparent.normalize_or_zero())).min(1.0).asin() * ARCMIN_PER_RAD
    };
    Sorted::of(pairs.into_iter().map(error))
}

#[cfg(test)]
mod tests {
    //! Angles of known size come back, however small.

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
        // From abeam at 0.6 c light comes from cos θ' = 0.6 ahead; a picture that leaves it abeam is off by asin 0.6.
        let observer = Observer { event: Event::default(), celerity: Celerity::new(DVec3::Z * -0.75).expect("finite") };
        let exact = DVec3::new(0.8, 0.0, -0.6);
        let errors = errors(&observer, [(exact, DVec3::X * 9.0), (DVec3::X, DVec3::X * 9.0)]);
        assert!(errors.quantile(0.5) < 1e-11);
        // Kept in 24 bits.
        assert!((errors.quantile(1.0) - 0.6_f64.asin() * ARCMIN_PER_RAD).abs() < 2e-4);
        assert_eq!(errors.share_above(1.0), 0.5);
    }
}
