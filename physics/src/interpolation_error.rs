//! The error of flat triangles between apparent positions: the angle between where a place is drawn and where its
//! light says.
//!
//! A point at displacement d appears at x' = Λd + u r, with Λ linear (the boost of d without its light-travel time)
//! and r = |d|. A triangle drawn flat between its corners' apparent positions interpolates Λd rightly and r linearly.
//! Since r is convex, every place of the triangle is drawn too far along the motion, by u δ with δ = r interpolated −
//! r ≥ 0. Outlines, and the texture between them, err by this and nothing else.
//!
//! The lengthening δ is the error of interpolating a function whose second derivative is at most 1/r: in a triangle
//! with no edge longer than L it is at most L²/(6r). Seen from the eye u δ is an angle (δ/r) F, F = w sin θ / D². F is
//! largest not dead astern but beside it; it has one maximum over θ, so that its largest value in a ball is known
//! without a search.

use std::f64::consts::PI;

use glam::DVec3;

use crate::celerity::Celerity;
use crate::direction_cone::DirectionCone;
use crate::light_cone::LightConeCoordinates;

/// Radius around the middle of an edge, as a share of the edge's length, that holds every triangle of which the edge
/// is the longest: √3/2.
const REACH: f64 = 0.866_025_403_784_438_7;

/// Bound of δ as a multiple of L²/r.
const INTERPOLATION: f64 = 1.0 / 6.0;

/// Largest share of its own apparent distance by which a place may be drawn too far forward; beyond it no bound is
/// claimed.
const LARGEST_SHARE: f64 = 0.5;

/// Interpolation between apparent positions for an observer of one celerity, and bounds of its error.
#[derive(Clone, Copy, Debug)]
pub struct TriangleInterpolation {
    direction: DVec3,
    /// Magnitude |u| of the celerity.
    w: f64,
    kappa: f64,
    /// Angle from ahead at which F is largest, radians, and F there.
    worst: (f64, f64),
}

/// Bound for every triangle of which one edge is the longest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterpolationBound {
    /// Largest angle by which a place of the triangle may be drawn wrongly, radians; infinite if nothing is claimed.
    pub error_rad: f64,
    /// Cone in which all places of the triangle are truly seen, observer's axes; all directions if nothing is claimed.
    pub cone: DirectionCone,
}

impl InterpolationBound {
    /// The bound that claims nothing.
    const NONE: Self = Self { error_rad: f64::INFINITY, cone: DirectionCone { axis: DVec3::NEG_Z, radius_rad: PI } };
}

impl TriangleInterpolation {
    /// Interpolation for an observer of this celerity.
    pub fn new(celerity: Celerity) -> Self {
        let (w, gamma) = (celerity.magnitude(), celerity.gamma());
        let direction = celerity.direction().unwrap_or(DVec3::NEG_Z);
        let mut interpolation = Self { direction, w, kappa: celerity.kappa(), worst: (PI, 0.0) };
        if w > 0.0 {
            // Solve dF/dθ = 0, w c² − γ c − 2w = 0 for the cosine c; the other root is no cosine.
            let cosine = (-4.0 * w / (gamma + (gamma * gamma + 8.0 * w * w).sqrt())).max(-1.0);
            // The angle from astern is 1/(√3 γ) at high speeds, for which this cosine is too coarse.
            let astern = if gamma > 1e3 { 1.0 / (3.0_f64.sqrt() * gamma) } else { PI - cosine.acos() };
            let angle = PI - astern;
            interpolation.worst = (angle, interpolation.sensitivity(angle));
        }
        interpolation
    }

    /// Apparent position of a place at rest, relative to the observer, observer's axes, metres; `displacement` from
    /// the observer to the place, world axes, metres.
    ///
    /// *Equation:* the light-cone form of [`crate::light_cone`].
    ///
    /// *Accuracy:* ε/D ≤ 4e-16 γ rad, which is enough for pictures up to γ = 1e12 and ten times as fast as
    /// [`crate::apparent`].
    pub fn apparent(&self, displacement: DVec3) -> DVec3 {
        if self.w == 0.0 {
            return displacement;
        }
        let along = self.direction.dot(displacement);
        let across = self.direction.cross(displacement.cross(self.direction));
        let seen = LightConeCoordinates::of(along, across.length_squared()).boosted(self.kappa);
        across + seen.along() * self.direction
    }

    /// True if the observer is at rest, so that straight edges are seen as straight.
    pub fn is_straight(&self) -> bool {
        self.w == 0.0
    }

    /// Doppler factor D at an angle from ahead in the world, radians.
    fn doppler(&self, angle: f64) -> f64 {
        let (sine, cosine) = (0.5 * angle).sin_cos();
        self.kappa * cosine * cosine + sine * sine / self.kappa
    }

    /// Sensitivity F at an angle from ahead in the world: the angle by which a place is drawn wrongly, over the share
    /// δ/r by which its distance is taken to be too long.
    fn sensitivity(&self, angle: f64) -> f64 {
        let (sine, cosine) = (0.5 * angle).sin_cos();
        let doppler = self.doppler(angle);
        2.0 * self.w * sine * cosine / (doppler * doppler)
    }

    /// Sensitivity F of a direction of the world, of any length: the angle by which a place there is drawn wrongly,
    /// over the share δ/r by which its distance is taken to be too long.
    pub fn steepness(&self, direction: DVec3) -> f64 {
        let along = self.direction.dot(direction);
        self.sensitivity(self.direction.cross(direction).length().atan2(along))
    }

    /// Observed angle from ahead of a world angle, radians; world angles beyond π are allowed.
    fn observed(&self, angle: f64) -> f64 {
        let (sine, cosine) = (0.5 * angle).sin_cos();
        2.0 * sine.atan2(self.kappa * cosine)
    }

    /// Angle from ahead and half the opening angle, radians, of the cone in which a ball lies in the world.
    fn world_cone(&self, middle: DVec3, radius: f64) -> (f64, f64) {
        let along = self.direction.dot(middle);
        let across = middle - along * self.direction;
        (across.length().atan2(along), (radius / middle.length()).asin())
    }

    /// Cone in which a ball of places at rest is seen, observer's axes; `None` if the ball holds the observer, or has
    /// no finite size. `middle`: displacement from the observer to its middle, world axes, metres; `radius`: metres.
    ///
    /// Circles stay circles (Penrose 1959), and their extremes along the meridian through the motion stay opposite.
    pub fn cone(&self, middle: DVec3, radius: f64) -> Option<DirectionCone> {
        let distance = middle.length();
        if radius >= distance || !(radius / distance).is_finite() {
            return None;
        }
        let (angle, reach) = self.world_cone(middle, radius);
        let across = middle - self.direction.dot(middle) * self.direction;
        let (low, high) = (self.observed(angle - reach), self.observed(angle + reach));
        let (sine, cosine) = (0.5 * (low + high)).sin_cos();
        let axis = sine * across.normalize_or_zero() + cosine * self.direction;
        let axis = axis.normalize_or(self.direction * cosine.signum());
        Some(DirectionCone { axis, radius_rad: 0.5 * (high - low) })
    }

    /// Upper limit of the error that [`TriangleInterpolation::bound`] gives for an edge of this length at this
    /// distance, whichever way it lies; infinite if nothing is claimed. It takes no angle, and most edges of a scene
    /// are small enough for it.
    pub fn bound_anywhere(&self, distance: f64, length: f64) -> f64 {
        let nearest = distance - REACH * length;
        let excess = INTERPOLATION * (length / nearest).powi(2);
        let share = excess * self.w * self.kappa;
        if nearest > 0.0 && share < LARGEST_SHARE { excess * self.worst.1 / (1.0 - share) } else { f64::INFINITY }
    }

    /// Bound for all triangles of which an edge of this `length` is the longest; `middle` is the displacement from the
    /// observer to the middle of the edge. World axes, metres.
    ///
    /// *Equation:* (δ/r) F / (1 − (δ/r) w/D), each at its worst in the ball of √3/2 L about the middle, which holds
    /// all such triangles. The denominator is for places astern, which are drawn nearer than they appear.
    ///
    /// *Accuracy:* held against points of random triangles (`tests/physics/interpolation_error.rs`).
    pub fn bound(&self, middle: DVec3, length: f64) -> InterpolationBound {
        let (distance, radius) = (middle.length(), REACH * length);
        let Some(cone) = self.cone(middle, radius) else {
            return if self.w == 0.0 {
                InterpolationBound { error_rad: 0.0, ..InterpolationBound::NONE }
            } else {
                InterpolationBound::NONE
            };
        };
        let bound = InterpolationBound { error_rad: 0.0, cone };
        if self.w == 0.0 {
            return bound;
        }
        let (angle, reach) = self.world_cone(middle, radius);

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

    /// Largest factor by which a small step in the world is longer between apparent positions: κ.
    ///
    /// *Equation:* the derivative of x' is a boost, which lengthens by γ at most, and u⊗n of length w
    /// ([`crate::apparent_shape::jacobian`]).
    pub fn stretch(&self) -> f64 {
        self.kappa
    }

    /// Bound for all triangles of which an edge of this `length` is the longest, as looked at from `place` instead of
    /// from the eye; `middle` is the displacement from the eye to the middle of the edge, world axes; `place` is
    /// relative to the eye, observer's axes; metres.
    ///
    /// *Equation:* the flat triangle is off by at most w δ, and lies in a ball about the apparent position of the
    /// middle, of κ √3/2 L and w δ ([`TriangleInterpolation::stretch`]).
    pub fn bound_from(&self, place: DVec3, middle: DVec3, length: f64) -> InterpolationBound {
        let radius = REACH * length;
        let nearest = middle.length() - radius;
        let off = if self.w == 0.0 {
            0.0
        } else if nearest > 0.0 {
            self.w * INTERPOLATION * length * length / nearest
        } else {
            return InterpolationBound::NONE;
        };
        let towards = self.apparent(middle) - place;
        let (distance, reach) = (towards.length(), self.kappa * radius + off);
        let share = off / (distance - reach);
        if !(reach < distance && share < LARGEST_SHARE) {
            return if self.w == 0.0 {
                InterpolationBound { error_rad: 0.0, ..InterpolationBound::NONE }
            } else {
                InterpolationBound::NONE
            };
        }
        let cone = DirectionCone { axis: towards / distance, radius_rad: (reach / distance).asin() };
        InterpolationBound { error_rad: share.asin(), cone }
    }

    /// Angle by which a place is drawn wrongly if its distance is taken to be `interpolated` instead, radians.
    ///
    /// *Equation:* tan of the angle between x' and x' + u δ, by their cross and dot products.
    pub fn error(&self, displacement: DVec3, interpolated: f64) -> f64 {
        let seen = self.apparent(displacement);
        let drawn = seen + self.direction * (self.w * (interpolated - displacement.length()));
        seen.cross(drawn).length().atan2(seen.dot(drawn))
    }
}
