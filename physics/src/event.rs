//! Events, and the four-vectors between them.
//!
//! An event has a position and a time and no length; the difference of two events is a four-vector and has one.
//! Keeping the types apart lets the compiler refuse the boost of an absolute position.

use std::ops::{Add, Neg, Sub};

use glam::DVec3;

use crate::double_double::{DoubleDouble, DoubleDoubleVec3};

/// A point of spacetime.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Event {
    /// Time ct, metres of light travel.
    pub ct: f64,
    /// Position, metres.
    pub position: DVec3,
}

/// A difference of events, or any other quantity that a boost transforms as (t, r).
///
/// # Example
///
/// ```
/// use physics::{FourVector, glam::DVec3};
/// let light = FourVector { t: -5.0, r: DVec3::new(3.0, 4.0, 0.0) };
/// assert_eq!(light.interval(), 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FourVector {
    /// Time component, in metres for a displacement.
    pub t: f64,
    /// Space components, in metres for a displacement.
    pub r: DVec3,
}

impl FourVector {
    /// Scalar product t₁ t₂ − r₁·r₂, signature (+, −, −, −). Rounded only once, so that it is exact to the last bit
    /// for null vectors too.
    pub fn dot(self, other: Self) -> f64 {
        let times = DoubleDouble::product(self.t, other.t);
        (times - DoubleDoubleVec3::from(self.r).dot(other.r.into())).rounded()
    }

    /// Squared interval t² − |r|²: positive if timelike, zero on the light cone, negative if spacelike.
    pub fn interval(self) -> f64 {
        self.dot(self)
    }
}

impl Sub for Event {
    type Output = FourVector;
    fn sub(self, origin: Self) -> FourVector {
        FourVector { t: self.ct - origin.ct, r: self.position - origin.position }
    }
}

impl Add<FourVector> for Event {
    type Output = Self;
    fn add(self, displacement: FourVector) -> Self {
        Self { ct: self.ct + displacement.t, position: self.position + displacement.r }
    }
}

impl Add for FourVector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { t: self.t + other.t, r: self.r + other.r }
    }
}

impl Sub for FourVector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for FourVector {
    type Output = Self;
    fn neg(self) -> Self {
        Self { t: -self.t, r: -self.r }
    }
}
