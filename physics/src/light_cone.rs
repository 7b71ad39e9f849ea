//! The light-cone coordinates of an emission event, in which a boost is two scalings.
//!
//! Light that is received now at the origin left a point at distance r at the event (−r, d). With h the part of d along
//! an axis and q the square of the part across it, the coordinates of that event along the axis are r + h and r − h.
//! A boost along the axis multiplies the first by κ = γ + |u| and the second by 1/κ, and leaves the part across alone:
//!
//! ```text
//! r = √(h² + q)    larger = r + |h|    smaller = q / larger
//! (ahead, behind) = h ≥ 0 ? (larger, smaller) : (smaller, larger)
//! h' = (κ ahead − behind / κ) / 2    r' = (κ ahead + behind / κ) / 2    D = r' / r
//! ```
//!
//! This is the vector form of tan θ'/2 = e^(−η) tan θ/2 (W 4.5, 5.1; B 2.6.1). Neither r + |h| nor q / larger cancels.
//! The vector registers of [`crate::photo_surface`] compute the same in f32, and `shaders/wgsl/aberration.wgsl` on the
//! GPU.

/// Coordinates r + h and r − h of the event at which light left a point, both at least zero. Units of the distance.
///
/// # Example
///
/// A point 3 across and 4 along the motion, at β = 0.6, κ = 2:
///
/// ```
/// use physics::light_cone::LightConeCoordinates;
/// let emitted = LightConeCoordinates::of(4.0, 9.0);
/// assert_eq!(emitted, LightConeCoordinates { ahead: 9.0, behind: 1.0 });
/// let seen = emitted.boosted(2.0);
/// assert_eq!((seen.along(), seen.distance()), (8.75, 9.25)); // 8.75² + 3² = 9.25²
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightConeCoordinates {
    /// Coordinate r + h.
    pub ahead: f64,
    /// Coordinate r − h.
    pub behind: f64,
}

impl LightConeCoordinates {
    /// Coordinates of a point with a part `along` the axis, h, and the square `across_squared` of the part across it,
    /// q.
    ///
    /// *Accuracy:* two units in the last place of each, however different the two are. Both are zero for a point at the
    /// origin. Inputs whose squares overflow or underflow are for the caller to scale.
    pub fn of(along: f64, across_squared: f64) -> Self {
        Self::at_distance((along * along + across_squared).sqrt(), along, across_squared)
    }

    /// Coordinates of a point whose distance r = √(h² + q) is known already.
    pub fn at_distance(distance: f64, along: f64, across_squared: f64) -> Self {
        let larger = distance + along.abs();
        let smaller = if larger > 0.0 { across_squared / larger } else { 0.0 };
        let (ahead, behind) = if along >= 0.0 { (larger, smaller) } else { (smaller, larger) };
        Self { ahead, behind }
    }

    /// Coordinates of the same event for an observer who moves along the axis, `kappa` = γ + |u|
    /// ([`Celerity::kappa`](crate::Celerity::kappa)).
    pub fn boosted(self, kappa: f64) -> Self {
        Self { ahead: kappa * self.ahead, behind: self.behind / kappa }
    }

    /// Part h of the displacement along the axis.
    pub fn along(self) -> f64 {
        0.5 * (self.ahead - self.behind)
    }

    /// Distance r of the point.
    pub fn distance(self) -> f64 {
        0.5 * (self.ahead + self.behind)
    }
}

#[cfg(test)]
mod tests {
    //! Law: ahead · behind = q, whatever the angle. A program that takes r − |h| as a difference has 0 for the smaller
    //! one close to the axis.
    use super::*;

    #[test]
    fn three_four_five_is_exact_on_both_sides() {
        assert_eq!(LightConeCoordinates::of(4.0, 9.0), LightConeCoordinates { ahead: 9.0, behind: 1.0 });
        assert_eq!(LightConeCoordinates::of(-4.0, 9.0), LightConeCoordinates { ahead: 1.0, behind: 9.0 });
        assert_eq!(LightConeCoordinates::of(0.0, 0.0), LightConeCoordinates::default());
    }

    #[test]
    fn the_smaller_coordinate_keeps_its_digits_close_to_the_axis() {
        // r − h = q / 2h to first order, 1e-40 below which f64 has no room beside 1.
        let close = LightConeCoordinates::of(-1.0, 1e-40);
        assert_eq!((close.ahead, close.behind), (5e-41, 2.0));
        // Dead astern at κ = 1e12, what is left of the distance is the shrunk coordinate.
        assert_eq!(close.boosted(1e12).distance(), 1e-12);
    }

    #[test]
    fn a_boost_keeps_the_part_across() {
        for (along, across_squared) in [(2.0, 3.0), (-2.0, 3.0), (-1e6, 1e-3), (0.0, 7.0)] {
            for kappa in [1.0, 2.0, 1e6] {
                let seen = LightConeCoordinates::of(along, across_squared).boosted(kappa);
                let kept = seen.ahead * seen.behind / across_squared;
                assert!((kept - 1.0).abs() < 4.0 * f64::EPSILON, "{along} {across_squared} {kappa}: {kept}");
            }
        }
    }
}
