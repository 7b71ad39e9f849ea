//! Velocity as celerity, u = γβ, and as β for reading and showing numbers.
//!
//! The speed of light is an asymptote for β but not for u, so no value of u needs a clamp and γ = √(1 + |u|²) is exact
//! to rounding at every speed. β carries only what is left of 1 − β: from γ of about 5e7 on, it cannot tell one
//! celerity from another.

use std::ops::Neg;

use glam::DVec3;
use thiserror::Error;

use crate::double_double::{DoubleDouble, DoubleDoubleVec3};

/// A velocity as the spatial part of the four-velocity in units of c: u = γβ = dx/dτ.
///
/// Always finite, and at most [`Celerity::LIMIT`] where it was given from outside; the composition of two such
/// celerities ([`compose`](crate::compose)) is still finite.
///
/// # Example
///
/// ```
/// use physics::{Celerity, glam::DVec3};
/// let celerity = Celerity::new(DVec3::new(0.0, 0.0, -0.75))?;
/// assert_eq!(celerity.gamma(), 1.25);
/// assert_eq!(celerity.beta().vector(), DVec3::new(0.0, 0.0, -0.6));
/// # Ok::<(), physics::CelerityError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Celerity(DVec3);

impl Celerity {
    /// Celerity of an observer at rest.
    pub const ZERO: Self = Self(DVec3::ZERO);

    /// The largest magnitude accepted, a rapidity of 173. Two celerities within it compose to one whose square is still
    /// finite.
    pub const LIMIT: f64 = 1e75;

    /// Checks a vector u = γβ.
    ///
    /// # Errors
    ///
    /// A component is infinite or not a number, or |u| is beyond [`Celerity::LIMIT`].
    pub fn new(vector: DVec3) -> Result<Self, CelerityError> {
        if !vector.is_finite() {
            return Err(CelerityError::NotFinite { vector });
        }
        // A vector too long for its square is infinitely long here.
        if vector.length_squared() > Self::LIMIT * Self::LIMIT {
            return Err(CelerityError::TooFast { vector });
        }
        Ok(Self(vector))
    }

    /// Celerity along a direction of any length with a rapidity η: |u| = sinh η. A negative rapidity is motion the
    /// other way.
    ///
    /// # Errors
    ///
    /// The direction is zero or not finite, or sinh η is not finite or beyond [`Celerity::LIMIT`].
    pub fn from_rapidity(direction: DVec3, rapidity: f64) -> Result<Self, CelerityError> {
        let unit = unit_vector(direction).ok_or(CelerityError::NoDirection { vector: direction })?;
        Self::new(unit * libm::sinh(rapidity))
    }

    /// A celerity known by construction to be finite and within the limit's square.
    pub(crate) fn from_finite(vector: DVec3) -> Self {
        Self(vector)
    }

    /// The vector u, dimensionless, in the axes of the frame it was measured in.
    pub fn vector(self) -> DVec3 {
        self.0
    }

    /// Magnitude |u| = sinh η, without underflow of small components.
    pub fn magnitude(self) -> f64 {
        let largest = self.0.abs().max_element();
        if largest == 0.0 { 0.0 } else { largest * (self.0 / largest).length() }
    }

    /// Lorentz factor γ = √(1 + |u|²) = cosh η.
    pub fn gamma(self) -> f64 {
        (1.0 + self.0.length_squared()).sqrt()
    }

    /// Doppler factor dead ahead, κ = γ + |u| = e^η. Dead astern it is 1/κ.
    ///
    /// *Equation:* a boost multiplies the light-cone coordinate r + h by κ and r − h by 1/κ
    /// ([`crate::light_cone`]; W 4.5, B 2.6.1). *Accuracy:* a sum of like signs, two units in the last place.
    pub fn kappa(self) -> f64 {
        self.gamma() + self.magnitude()
    }

    /// Rapidity η = asinh |u|, the proper acceleration summed along a straight start from rest.
    pub fn rapidity(self) -> f64 {
        libm::asinh(self.magnitude())
    }

    /// The unit vector of the motion; `None` at rest.
    pub fn direction(self) -> Option<DVec3> {
        unit_vector(self.0)
    }

    /// Velocity β = u/γ. If that rounds to the speed of light or beyond, the next shorter vector, so that |β| < 1
    /// always holds.
    pub fn beta(self) -> Beta {
        /// Two units in the last place: more than the rounding of γ and of the quotient together.
        const SHORTER: f64 = 1.0 - 2.0 * f64::EPSILON;
        let vector = self.0 / self.gamma();
        Beta::new(vector).unwrap_or(Beta(vector * SHORTER))
    }

    /// Celerity of the same direction with the rapidity cut to `limit` (η ≥ 0); unchanged below it.
    ///
    /// A vehicle calls this after each step, and compares, to tell the rider that the limit is reached.
    pub fn capped(self, limit: f64) -> Self {
        let (magnitude, largest) = (self.magnitude(), libm::sinh(limit));
        if magnitude <= largest { self } else { Self(self.0 * (largest / magnitude)) }
    }
}

impl Neg for Celerity {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl From<Beta> for Celerity {
    fn from(beta: Beta) -> Self {
        beta.celerity()
    }
}

/// A velocity in units of c, |β| < 1: for reading and showing numbers, never for computing with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Beta(DVec3);

impl Beta {
    /// Checks a vector v/c.
    ///
    /// # Errors
    ///
    /// A component is infinite or not a number, or |β| ≥ 1.
    pub fn new(vector: DVec3) -> Result<Self, CelerityError> {
        if !vector.is_finite() {
            return Err(CelerityError::NotFinite { vector });
        }
        let beta = Self(vector);
        if beta.gamma_squared_inverse().high > 0.0 {
            Ok(beta)
        } else {
            Err(CelerityError::NotSlowerThanLight { vector })
        }
    }

    /// The vector v/c, in the axes of the frame it was measured in.
    pub fn vector(self) -> DVec3 {
        self.0
    }

    /// Celerity u = β/√(1 − β²).
    ///
    /// # Example
    ///
    /// ```
    /// use physics::{Beta, glam::DVec3};
    /// let beta = Beta::new(DVec3::new(0.6, 0.0, 0.0))?;
    /// assert_eq!(beta.celerity().vector(), DVec3::new(0.75, 0.0, 0.0));
    /// # Ok::<(), physics::CelerityError>(())
    /// ```
    pub fn celerity(self) -> Celerity {
        let vector = DoubleDoubleVec3::from(self.0);
        Celerity::from_finite(vector.scaled(DoubleDouble::from(1.0) / self.gamma_squared_inverse().sqrt()).rounded())
    }

    /// 1/γ² = 1 − β², to 106 bits.
    fn gamma_squared_inverse(self) -> DoubleDouble {
        // A component beyond 1 decides alone, and its square might overflow.
        if self.0.abs().max_element() >= 1.0 {
            return DoubleDouble::default();
        }
        let beta = DoubleDoubleVec3::from(self.0);
        DoubleDouble::from(1.0) - beta.dot(beta)
    }
}

/// The unit vector along `vector`, whatever its length; `None` if it is zero or not finite.
pub(crate) fn unit_vector(vector: DVec3) -> Option<DVec3> {
    // A quotient of zeros or infinities is not a number and has no unit vector.
    (vector / vector.abs().max_element()).try_normalize()
}

/// The reasons why a vector is not a velocity.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum CelerityError {
    /// A component is infinite or not a number.
    #[error("the velocity {vector} has a component that is not a finite number; give three finite numbers")]
    NotFinite {
        /// The vector given.
        vector: DVec3,
    },
    /// A celerity beyond [`Celerity::LIMIT`].
    #[error("the celerity {vector} is longer than {limit:e}, the fastest that is computed", limit = Celerity::LIMIT)]
    TooFast {
        /// The vector given.
        vector: DVec3,
    },
    /// A velocity of |β| ≥ 1.
    #[error(
        "the velocity {vector} is not slower than light: |beta| must be below 1; a celerity (gamma beta) may have any length"
    )]
    NotSlowerThanLight {
        /// The vector given.
        vector: DVec3,
    },
    /// A direction of no length.
    #[error("{vector} has no direction; give a finite vector that is not zero")]
    NoDirection {
        /// The vector given.
        vector: DVec3,
    },
}

#[cfg(test)]
mod tests {
    //! Law: κ = e^η. A program that took κ from β, as √((1 + β)/(1 − β)), would lose it where β is all but 1, and one
    //! that took γ − |u| for 1/κ would find 0.
    use super::*;

    #[test]
    fn three_four_five_gives_kappa_two() {
        assert_eq!(Celerity::new(DVec3::new(0.0, -0.75, 0.0)).unwrap().kappa(), 2.0);
        assert_eq!(Celerity::ZERO.kappa(), 1.0);
    }

    #[test]
    fn kappa_is_the_exponential_of_the_rapidity_at_every_speed() {
        for rapidity in [1e-12, 0.1, 1.0, 10.0, 27.0, 100.0, 172.0] {
            let kappa = Celerity::from_rapidity(DVec3::new(1.0, -2.0, 2.0), rapidity).unwrap().kappa();
            // The rapidity's own rounding is multiplied by itself.
            let tolerance = 4.0 * f64::EPSILON * (1.0 + rapidity);
            assert!((kappa / rapidity.exp() - 1.0).abs() < tolerance, "{rapidity}: {kappa}");
        }
        assert_eq!(Celerity::new(DVec3::X * 1e75).unwrap().kappa(), 2e75);
    }
}
