//! Numbers and vectors of 600 bits, 180 decimal digits: γ⁴ = 1e48 may cancel and leave far more than 50 digits.

use std::ops::{Add, Mul, Sub};

use dashu_float::FBig;
use glam::DVec3;

/// A number of 600 bits.
pub type Real = FBig;

/// Precision of all numbers, bits.
const BITS: usize = 600;

/// The number that an f64 is, exactly.
///
/// # Panics
///
/// The value is infinite or not a number: no exact result is to be compared with it.
pub fn real(value: f64) -> Real {
    Real::try_from(value).expect("only finite numbers are compared").with_precision(BITS).value()
}

/// The nearest f64. (A [`Real`] itself truncates, in all its operations.)
pub fn to_f64(value: &Real) -> f64 {
    value.repr().to_f64().value()
}

/// |computed − exact| as a share of |exact|, or |computed| where the exact number is zero.
pub fn relative(computed: f64, exact: &Real) -> f64 {
    let difference = real(computed) - exact;
    if *exact == real(0.0) { to_f64(&difference).abs() } else { to_f64(&(difference / exact)).abs() }
}

/// A vector of three [`Real`] components.
#[derive(Clone, Debug)]
pub struct RealVec(pub [Real; 3]);

impl RealVec {
    /// The vector that three f64 are, exactly.
    pub fn new(vector: DVec3) -> Self {
        Self(vector.to_array().map(real))
    }

    fn map2(&self, other: &Self, f: impl Fn(&Real, &Real) -> Real) -> Self {
        Self([0, 1, 2].map(|i| f(&self.0[i], &other.0[i])))
    }

    /// Scalar product of two vectors.
    pub fn dot(&self, other: &Self) -> Real {
        let [x, y, z] = self.map2(other, |a, b| a * b).0;
        x + y + z
    }

    /// Vector product of two vectors.
    pub fn cross(&self, other: &Self) -> Self {
        let ([a, b, c], [d, e, f]) = (&self.0, &other.0);
        Self([b * f - c * e, c * d - a * f, a * e - b * d])
    }

    /// Length of the vector.
    pub fn length(&self) -> Real {
        self.dot(self).sqrt()
    }
}

impl Add for &RealVec {
    type Output = RealVec;
    fn add(self, other: Self) -> RealVec {
        self.map2(other, |a, b| a + b)
    }
}

impl Sub for &RealVec {
    type Output = RealVec;
    fn sub(self, other: Self) -> RealVec {
        self.map2(other, |a, b| a - b)
    }
}

impl Mul<&Real> for &RealVec {
    type Output = RealVec;
    fn mul(self, factor: &Real) -> RealVec {
        RealVec([0, 1, 2].map(|i| &self.0[i] * factor))
    }
}

/// γ = √(1 + u²) of a celerity.
pub fn gamma(u: &RealVec) -> Real {
    (real(1.0) + u.dot(u)).sqrt()
}

/// The angle between a computed and the exact vector by its sine, radians; π where they point to opposite sides. Where
/// one of them is zero, the length of their difference.
pub fn angle(computed: DVec3, exact: &RealVec) -> f64 {
    let computed = RealVec::new(computed);
    let lengths = computed.length() * exact.length();
    if lengths == real(0.0) {
        return to_f64(&(&computed - exact).length());
    }
    // The sine alone would take a direction for its opposite.
    if computed.dot(exact) < real(0.0) {
        return std::f64::consts::PI;
    }
    to_f64(&(computed.cross(exact).length() / lengths))
}

#[cfg(test)]
mod tests {
    //! Law: 180 digits are carried. A program of f64 would lose 1e-100 beside 1, and a program of the angle alone could
    //! not tell a vector from its opposite.
    use super::*;

    #[test]
    fn a_hundred_digits_below_one_are_kept() {
        let sum = real(1.0) + real(1e-100);
        assert_eq!(to_f64(&(sum - real(1.0))), 1e-100);
    }

    #[test]
    fn three_four_five_is_exact() {
        let (x, y) = (RealVec::new(DVec3::new(3.0, 0.0, 0.0)), RealVec::new(DVec3::new(0.0, 4.0, 0.0)));
        assert_eq!(to_f64(&(&x + &y).length()), 5.0);
        assert_eq!(x.cross(&y).0.map(|component| to_f64(&component)), [0.0, 0.0, 12.0]);
        assert_eq!(to_f64(&gamma(&RealVec::new(DVec3::X * 0.75))), 1.25);
    }

    #[test]
    fn errors_are_shares_of_the_exact_number_or_vector() {
        assert_eq!(relative(1.5, &real(2.0)), 0.25);
        assert_eq!(relative(-1.5, &real(-2.0)), 0.25);
        assert_eq!(relative(0.5, &real(0.0)), 0.5);
        let x = RealVec::new(DVec3::X);
        assert_eq!(angle(DVec3::Y, &x), 1.0);
        assert_eq!(angle(-DVec3::X, &x), std::f64::consts::PI);
        assert_eq!(angle(DVec3::ZERO, &x), 1.0);
        assert_eq!(angle(DVec3::new(1.0, 1e-30, 0.0), &x), 1e-30);
    }
}
