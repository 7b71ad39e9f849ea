//! Numbers of about 106 bits, as an unevaluated sum of two f64.
//!
//! A boost multiplies small differences of large inputs by γ: there the inputs' own 53 bits suffice, but an
//! intermediate's do not. The few such intermediates are carried as `high + low`, with |low| at most half a unit in
//! the last place of `high`. The error-free sum is Knuth's, the error-free product uses the fused multiply-add; see T.
//! J. Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18 (1971).

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

/// An unevaluated sum `high + low`; relative error of the operations about 2⁻¹⁰⁴.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DoubleDouble {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl DoubleDouble {
    /// The exact sum of two f64, in any order of magnitude (Knuth).
    pub(crate) fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let b_seen = high - a;
        let low = (a - (high - b_seen)) + (b - b_seen);
        Self { high, low }
    }

    /// The exact product of two f64, barring underflow.
    pub(crate) fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let low = a.mul_add(b, -high);
        Self { high, low }
    }

    /// The exact sum of two f64 of which |a| ≥ |b| (Dekker).
    fn ordered_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let low = b - (high - a);
        Self { high, low }
    }

    /// The square root of a non-negative number: one Newton step from the f64 root.
    pub(crate) fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::default();
        }
        let root = self.high.sqrt();
        let remainder = self - Self::product(root, root);
        Self::ordered_sum(root, remainder.high / (2.0 * root))
    }

    /// The f64 nearest to the sum.
    pub(crate) fn rounded(self) -> f64 {
        self.high + self.low
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let first = Self::ordered_sum(high.high, high.low + low.high);
        Self::ordered_sum(first.high, first.low + low.low)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high.mul_add(other.low, self.low * other.high);
        Self::ordered_sum(product.high, product.low + cross)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let remainder = self - other * Self::from(first);
        let second = remainder.high / other.high;
        let remainder = remainder - other * Self::from(second);
        Self::ordered_sum(first, second) + Self::from(remainder.high / other.high)
    }
}

/// A vector of [`DoubleDouble`] components, stored as the sum of two vectors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DoubleDoubleVec3 {
    pub(crate) high: DVec3,
    pub(crate) low: DVec3,
}

impl From<DVec3> for DoubleDoubleVec3 {
    fn from(high: DVec3) -> Self {
        Self { high, low: DVec3::ZERO }
    }
}

impl DoubleDoubleVec3 {
    /// The exact sum of two f64 vectors (Knuth).
    pub(crate) fn sum(a: DVec3, b: DVec3) -> Self {
        let high = a + b;
        let b_seen = high - a;
        let low = (a - (high - b_seen)) + (b - b_seen);
        Self { high, low }
    }

    /// The exact difference of two f64 vectors.
    pub(crate) fn difference(a: DVec3, b: DVec3) -> Self {
        Self::sum(a, -b)
    }

    fn ordered_sum(a: DVec3, b: DVec3) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    fn component(self, index: usize) -> DoubleDouble {
        DoubleDouble { high: self.high[index], low: self.low[index] }
    }

    pub(crate) fn dot(self, other: Self) -> DoubleDouble {
        let product = |index| self.component(index) * other.component(index);
        product(0) + product(1) + product(2)
    }

    /// Product of this vector and a number.
    pub(crate) fn scaled(self, factor: DoubleDouble) -> Self {
        let high = self.high * factor.high;
        let rounding = self.high.mul_add(DVec3::splat(factor.high), -high);
        Self::ordered_sum(high, rounding + (self.high * factor.low + self.low * factor.high))
    }

    /// Product of this vector and a power of two: exact, unless it underflows.
    pub(crate) fn times_power_of_two(self, factor: f64) -> Self {
        Self { high: self.high * factor, low: self.low * factor }
    }

    /// `self × other`, rounded to f64 only at the end: each component keeps its own relative precision where the two
    /// are nearly parallel.
    ///
    /// The leading part is Kahan's difference of products; the low words enter to first order.
    pub(crate) fn cross(self, other: Self) -> DVec3 {
        let (a, b) = (self.high, other.high);
        let leading = DVec3::new(
            difference_of_products(a.y, b.z, a.z, b.y),
            difference_of_products(a.z, b.x, a.x, b.z),
            difference_of_products(a.x, b.y, a.y, b.x),
        );
        leading + (a.cross(other.low) + self.low.cross(b))
    }

    /// `self × other` to about 106 bits of the product of their lengths.
    pub(crate) fn precise_cross(self, other: Self) -> Self {
        let product = |i, j| self.component(i) * other.component(j) - self.component(j) * other.component(i);
        let [x, y, z] = [product(1, 2), product(2, 0), product(0, 1)];
        Self { high: DVec3::new(x.high, y.high, z.high), low: DVec3::new(x.low, y.low, z.low) }
    }

    /// The f64 vector nearest to the sum.
    pub(crate) fn rounded(self) -> DVec3 {
        self.high + self.low
    }
}

impl Add for DoubleDoubleVec3 {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let first = Self::ordered_sum(high.high, high.low + low.high);
        Self::ordered_sum(first.high, first.low + low.low)
    }
}

impl Neg for DoubleDoubleVec3 {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDoubleVec3 {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

/// a b − c d to within 1.5 units in the last place (Kahan; see C.-P. Jeannerod et al., Math. Comp. 82 (2013)).
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let subtracted = c * d;
    let rounding = (-c).mul_add(d, subtracted);
    a.mul_add(b, -subtracted) + rounding
}

#[cfg(test)]
mod tests {
    //! Law: a sum of two f64 carries what one f64 loses. Plain f64 would answer 0 in every test here.
    use super::*;

    #[test]
    fn a_sum_keeps_what_f64_drops() {
        let sum = DoubleDouble::from(1.0) + DoubleDouble::from(1e-25);
        assert_eq!((sum - DoubleDouble::from(1.0)).rounded(), 1e-25);
    }

    #[test]
    fn a_product_keeps_its_rounding_error() {
        let x = 1.0 + f64::EPSILON;
        let square = DoubleDouble::from(x) * DoubleDouble::from(x);
        let expected = f64::EPSILON * f64::EPSILON;
        assert_eq!((square - DoubleDouble::from(1.0 + 2.0 * f64::EPSILON)).rounded(), expected);
    }

    #[test]
    fn root_and_quotient_invert_square_and_product() {
        /// A few units of 2⁻¹⁰⁴.
        const TOLERANCE: f64 = 2e-31;
        for value in [2.0, 0.1, 3e100, 7e-100] {
            let value = DoubleDouble::from(value);
            let root = value.sqrt();
            assert!(((root * root - value) / value).rounded().abs() < TOLERANCE);
            assert!(((value / root - root) / root).rounded().abs() < TOLERANCE);
        }
    }

    #[test]
    fn cross_product_of_nearly_parallel_vectors_keeps_its_digits() {
        let a = DVec3::new(1.0, 1.0 + f64::EPSILON, 1.0);
        let b = DVec3::new(1.0 + f64::EPSILON, 1.0 + 2.0 * f64::EPSILON, 1.0);
        // z: 1 + 2ε − (1 + ε)² = −ε².
        let cross = DoubleDoubleVec3::from(a).cross(DoubleDoubleVec3::from(b));
        assert_eq!(cross.z, -f64::EPSILON * f64::EPSILON);
    }
}
