//! How far a flat triangle between apparent positions is from where light says.
//!
//! A point at displacement d appears at x' = Λd + u r, with Λ linear (the boost of d without its light-travel time) and r = |d|. A triangle
//! drawn flat between its corners' apparent positions interpolates Λd rightly and r linearly. r is convex, so every place of the triangle is
//! drawn too far along the motion, by u δ with δ = r interpolated − r ≥ 0: outlines, and the texture between them, err by this and nothing else.
//!
//! δ is the error of interpolating a function whose second derivative is at most 1/r: in a triangle with no edge longer than L it is at most
//! L²/(6r). Seen from the eye u δ is an angle (δ/r) F, F = w sin θ / D², which is largest not dead astern but beside it; F has one maximum
//! over θ, so that its largest value in a ball is known without a search.

use std::f64::consts::PI;

use glam::DVec3;

use crate::celerity::Celerity;
use crate::light_cone::LightConeCoordinates;

pub use self::{InterpolationBound as Bound, TriangleInterpolation as Bend}; // until app is moved

/// Share of an edge's length within which of its middle every triangle lies that has no longer edge: √3/2.
const REACH: f64 = 0.866_025_403_784_438_7;

/// δ of a triangle is at most L²/r times this.
const INTERPOLATION: f64 = 1.0 / 6.0;

/// Beyond this share of its own apparent distance a place is drawn so far forward that no bound is claimed.
const LARGEST_SHARE: f64 = 0.5;

/// Bounds for an observer of one celerity.
#[derive(Clone, Copy, Debug)]
pub struct TriangleInterpolation {
    direction: DVec3,
    /// |u|.
    w: f64,
    kappa: f64,
    /// Where F is largest, radians from ahead, and how large.
    worst: (f64, f64),
}

/// What is claimed of every triangle of which an edge is the longest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterpolationBound {
    /// The angle by which any of its places may be drawn wrongly, radians; infinite where nothing is claimed.
    pub error_rad: f64,
    /// Middle of a cone in which all its places are truly seen (unit vector, observer's axes).
    pub direction: DVec3,
    /// Half the angle of that cone; π where nothing is claimed.
    pub radius_rad: f64,
}

impl InterpolationBound {
    /// Nothing is claimed.
    const NONE: Self = Self { error_rad: f64::INFINITY, direction: DVec3::ZERO, radius_rad: PI };
}

impl TriangleInterpolation {
    /// For an observer of this celerity.
    pub fn new(celerity: Celerity) -> Self {
        let (w, gamma) = (celerity.magnitude(), celerity.gamma());
        let direction = celerity.direction().unwrap_or(DVec3::NEG_Z);
        let mut interpolation = Self { direction, w, kappa: celerity.kappa(), worst: (PI, 0.0) };
        if w > 0.0 {
            // dF/dθ = 0: w c² − γ c − 2w = 0, of whose roots the other one is no cosine.
            let cosine = (-4.0 * w / (gamma + (gamma * gamma + 8.0 * w * w).sqrt())).max(-1.0);
            // At high speeds the angle from astern is 1/(√3 γ), which this cosine is too coarse for.
            let astern = if gamma > 1e3 { 1.0 / (3.0_f64.sqrt() * gamma) } else { PI - cosine.acos() };
            let angle = PI - astern;
            interpolation.worst = (angle, interpolation.sensitivity(angle));
        }
        interpolation
    }

    /// Where a place at rest appears, relative to the observer, in his axes; `displacement` from him in the world.
    ///
    /// *Equation:* the light-cone form of [`crate::light_cone`].
    ///
    /// *Accuracy:* ε/D ≤ 4e-16 γ rad, which is enough for pictures up to γ = 1e12 and ten times as fast as [`crate::apparent`].
    pub fn apparent(&self, displacement: DVec3) -> DVec3 {
        if self.w == 0.0 {
            return displacement;
        }
        let along = self.direction.dot(displacement);
        let across = self.direction.cross(displacement.cross(self.direction));
        let seen = LightConeCoordinates::of(along, across.length_squared()).boosted(self.kappa);
        across + seen.along() * self.direction
    }

    /// D at an angle from ahead, in the world.
    fn doppler(&self, angle: f64) -> f64 {
        let (sine, cosine) = (0.5 * angle).sin_cos();
        self.kappa * cosine * cosine + sine * sine / self.kappa
    }

    /// F: the angle, for each part of its distance, by which a place is drawn wrongly.
    fn sensitivity(&self, angle: f64) -> f64 {
        let (sine, cosine) = (0.5 * angle).sin_cos();
        let doppler = self.doppler(angle);
        2.0 * self.w * sine * cosine / (doppler * doppler)
    }

    /// F of a direction of the world, of any length: by what angle a place there is drawn wrongly for each part of its distance by which
    /// that is taken to be too long.
    pub fn steepness(&self, direction: DVec3) -> f64 {
        let along = self.direction.dot(direction);
        self.sensitivity(self.direction.cross(direction).length().atan2(along))
    }

    /// The observed angle from ahead of a world angle, also of one beyond π.
    fn observed(&self, angle: f64) -> f64 {
        let (sine, cosine) = (0.5 * angle).sin_cos();
        2.0 * sine.atan2(self.kappa * cosine)
    }

    /// What [`TriangleInterpolation::bound`] claims at most of an edge of such a length at such a distance, whichever way it lies; infinite where that is
    /// nothing. It takes no angle, and most edges of a scene are small enough for it.
    pub fn bound_anywhere(&self, distance: f64, length: f64) -> f64 {
        let nearest = distance - REACH * length;
        let excess = INTERPOLATION * (length / nearest).powi(2);
        let share = excess * self.w * self.kappa;
        if nearest > 0.0 && share < LARGEST_SHARE { excess * self.worst.1 / (1.0 - share) } else { f64::INFINITY }
    }

    /// What can be claimed of triangles of which an edge is the longest: `middle` is the displacement of its middle from the observer.
    ///
    /// *Equation:* (δ/r) F / (1 − (δ/r) w/D), each at its worst in the ball of √3/2 L about the middle, which holds all such triangles. The
    /// denominator is for places astern, which are drawn nearer than they appear.
    ///
    /// *Accuracy:* held against points of random triangles (`tests/physics/interpolation_error.rs`).
    pub fn bound(&self, middle: DVec3, length: f64) -> InterpolationBound {
        let (distance, radius) = (middle.length(), REACH * length);
        if radius >= distance || !(radius / distance).is_finite() {
            return if self.w == 0.0 {
                InterpolationBound { error_rad: 0.0, ..InterpolationBound::NONE }
            } else {
                InterpolationBound::NONE
            };
        }
        let along = self.direction.dot(middle);
        let across = middle - along * self.direction;
        let (angle, reach) = (across.length().atan2(along), (radius / distance).asin());

        // The cone in which the ball is seen: circles stay circles, and their extremes along the meridian stay opposite.
        let (low, high) = (self.observed(angle - reach), self.observed(angle + reach));
        let (sine, cosine) = (0.5 * (low + high)).sin_cos();
        let direction = sine * across.normalize_or_zero() + cosine * self.direction;
        let direction = direction.normalize_or(self.direction * cosine.signum());
        let bound = InterpolationBound { error_rad: 0.0, direction, radius_rad: 0.5 * (high - low) };
        if self.w == 0.0 {
            return bound;
        }

        let nearest = distance - radius;
        let excess = INTERPOLATION * (length / nearest).powi(2);
        let (first, last) = ((angle - reach).max(0.0), (angle + reach).min(PI));
        let steepest = if (first..=last).contains(&self.worst.0) {
            self.worst.1
        } else {
            self.sensitivity(first).max(self.sensitivity(last))
        };
        let share = excess * self.w / self.doppler(last);
        let error_rad = if share < LARGEST_SHARE { excess * steepest / (1.0 - share) } else { f64::INFINITY };
        InterpolationBound { error_rad, ..bound }
    }

    /// The angle by which a place is drawn wrongly if its distance is taken to be `interpolated` instead, radians.
    ///
    /// *Equation:* tan of the angle between x' and x' + u δ, by their cross and dot products.
    pub fn error(&self, displacement: DVec3, interpolated: f64) -> f64 {
        let seen = self.apparent(displacement);
        let drawn = seen + self.direction * (self.w * (interpolated - displacement.length()));
        seen.cross(drawn).length().atan2(seen.dot(drawn))
    }
}
