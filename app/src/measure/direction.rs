//! How far from its place is everything drawn: the angle between the direction that a pixel sees and the one in which light really comes from
//! what it shows.
//!
//! The renderer is asked for the place in the scene that each pixel shows ([`crate::renderers::Subject::Places`]); where light from there arrives is
//! known exactly ([`physics::apparent`]). So the error is one of geometry alone: colours, textures and the ray tracer have no part in it.

use glam::DVec3;
use physics::{Observer, apparent};

/// Minutes of arc in a radian.
pub const ARCMIN_PER_RAD: f64 = 180.0 * 60.0 / std::f64::consts::PI;

/// Angles, sorted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DirectionErrors {
    arcmin: Vec<f64>,
}

impl DirectionErrors {
    /// Of a picture of things at rest in the world.
    ///
    /// *Frames:* `shown` pairs the unit direction of each pixel, observer's axes, with the world place it shows, metres.
    pub fn of(observer: &Observer, shown: impl IntoIterator<Item = (DVec3, DVec3)>) -> Self {
        let seen = |(direction, place): (DVec3, DVec3)| (direction, apparent::at_rest(observer, place).position);
        Self::between(shown.into_iter().map(seen))
    }

    /// Of pixels' unit directions and the apparent positions of what they show, observer's axes.
    pub fn between(pairs: impl IntoIterator<Item = (DVec3, DVec3)>) -> Self {
        let error = |(direction, apparent): (DVec3, DVec3)| {
            // By the chord: the arc cosine of a product next to 1 would lose half the digits.
            2.0 * (0.5 * direction.distance(apparent.normalize_or_zero())).min(1.0).asin() * ARCMIN_PER_RAD
        };
        let mut arcmin: Vec<f64> = pairs.into_iter().map(error).collect();
        arcmin.sort_by(f64::total_cmp);
        Self { arcmin }
    }

    /// Of several pictures as of one.
    pub fn together(pictures: impl IntoIterator<Item = Self>) -> Self {
        let mut arcmin: Vec<f64> = pictures.into_iter().flat_map(|picture| picture.arcmin).collect();
        arcmin.sort_by(f64::total_cmp);
        Self { arcmin }
    }

    /// How many pixels show a surface.
    pub fn count(&self) -> usize {
        self.arcmin.len()
    }

    /// The angle in arcminutes that this share of the pixels, 0 to 1, does not exceed; 0 if there are none.
    pub fn quantile(&self, share: f64) -> f64 {
        let last = self.arcmin.len().saturating_sub(1);
        let index = (share.clamp(0.0, 1.0) * self.arcmin.len() as f64).ceil() as usize;
        self.arcmin.get(index.saturating_sub(1).min(last)).copied().unwrap_or(0.0)
    }

    /// Share of the pixels off by more than so many arcminutes.
    pub fn share_above(&self, arcmin: f64) -> f64 {
        let above = self.arcmin.len() - self.arcmin.partition_point(|&error| error <= arcmin);
        above as f64 / self.arcmin.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    //! Angles of known size come back, however small; quantiles are those of the sorted list.

    use super::*;
    use physics::{Celerity, Event};

    #[test]
    fn an_angle_put_in_comes_out() {
        let event = Event { ct: 0.0, position: DVec3::new(3.0, -2.0, 5.0) };
        let observer = Observer { event, celerity: Celerity::ZERO };
        for angle in [1e-12, 1e-6, 1e-3, 1.0_f64] {
            let place = event.position + 7.0 * DVec3::new(angle.sin(), 0.0, -angle.cos());
            let errors = DirectionErrors::of(&observer, [(DVec3::NEG_Z, place)]);
            let expected = angle * ARCMIN_PER_RAD;
            assert!((errors.quantile(0.5) - expected).abs() < 1e-3 * expected + 1e-11, "{angle}");
        }
    }

    #[test]
    fn aberration_is_counted_as_what_it_is() {
        // From abeam at 0.6 c light comes from cos θ' = 0.6 ahead; a picture that leaves it abeam is off by asin 0.6.
        let observer = Observer { event: Event::default(), celerity: Celerity::new(DVec3::Z * -0.75).expect("finite") };
        let exact = DVec3::new(0.8, 0.0, -0.6);
        let errors = DirectionErrors::of(&observer, [(exact, DVec3::X * 9.0), (DVec3::X, DVec3::X * 9.0)]);
        assert!(errors.quantile(0.5) < 1e-11);
        assert!((errors.quantile(1.0) - 0.6_f64.asin() * ARCMIN_PER_RAD).abs() < 1e-9);
        assert_eq!(errors.share_above(1.0), 0.5);
    }

    #[test]
    fn quantiles_are_those_of_the_sorted_list() {
        let errors = DirectionErrors { arcmin: (1..=100).map(f64::from).collect() };
        assert_eq!([0.0, 0.5, 0.99, 1.0].map(|share| errors.quantile(share)), [1.0, 50.0, 99.0, 100.0]);
        assert_eq!(errors.share_above(99.0), 0.01);
        assert_eq!(DirectionErrors::default().quantile(0.5), 0.0);
    }
}
