//! Numbers and vectors of 600 bits, 180 decimal digits: γ⁴ = 1e48 may cancel and leave far more than 50 digits.

use std::ops::{Add, Mul, Sub};

use dashu_float::FBig;
use glam::DVec3;

/// A number of 600 bits.
pub type Real = FBig;

const BITS: usize = 600;

/// Exact value of an f64.
pub fn real(value: f64) -> Real {
    Real::try_from(value).expect("only finite numbers are compared").with_precision(BITS).value()
}

/// Value rounded to f64.
pub fn to_f64(value: &Real) -> f64 {
    value.to_f64().value()
}

/// Relative error |computed − exact| / |exact|, or |computed| if the exact value is zero.
pub fn relative(computed: f64, exact: &Real) -> f64 {
    let difference = real(computed) - exact;
    if *exact == real(0.0) { to_f64(&difference).abs() } else { to_f64(&(difference / exact)).abs() }
}

/// A vector of [`Real`].
#[derive(Clone, Debug)]
pub struct RealVec(pub [Real; 3]);

impl RealVec {
    /// Exact vector of three f64.
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

/// γ of a celerity.
pub fn gamma(u: &RealVec) -> Real {
    (real(1.0) + u.dot(u)).sqrt()
}

/// Angle between a computed and the exact vector, by its sine, radians; 0 if both are zero.
pub fn angle(computed: DVec3, exact: &RealVec) -> f64 {
    let computed = RealVec::new(computed);
    let lengths = computed.length() * exact.length();
    if lengths == real(0.0) {
        return to_f64(&(&computed - exact).length());
    }
    // The sine alone cannot tell a direction from its opposite.
    if computed.dot(exact) < real(0.0) {
        return std::f64::consts::PI;
    }
    to_f64(&(computed.cross(exact).length() / lengths))
}
