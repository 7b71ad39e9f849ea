//! Rotations of about 106 bits. The digits that f64 drops from an orientation are multiplied by γ² turn after turn on
//! a fast circle.

use glam::DVec4;

use crate::double_double::{DoubleDouble, DoubleDoubleVec3};

/// A quaternion, of any length but zero.
#[derive(Clone, Copy)]
pub(super) struct Rotation {
    pub(super) vector: DoubleDoubleVec3,
    pub(super) scalar: DoubleDouble,
}

impl Rotation {
    /// The rotation that is `first` and then this one.
    pub(super) fn after(self, first: Self) -> Self {
        let (a, b) = (self, first);
        Self {
            vector: b.vector.scaled(a.scalar) + a.vector.scaled(b.scalar) + a.vector.precise_cross(b.vector),
            scalar: a.scalar * b.scalar - a.vector.dot(b.vector),
        }
    }

    /// The vector turned by this rotation; the quaternion's length does not matter.
    pub(super) fn turn(self, vector: DoubleDoubleVec3) -> DoubleDoubleVec3 {
        let across = self.vector.precise_cross(vector);
        let half = across.scaled(self.scalar) + self.vector.precise_cross(across);
        vector + half.scaled(DoubleDouble::from(2.0) / self.length_squared())
    }

    /// The rotation as a quaternion of length 1. The components are divided, so that the identity stays exactly
    /// itself.
    pub(super) fn normalised(self) -> Self {
        let length = self.length_squared().sqrt();
        Self { vector: self.vector.scaled(DoubleDouble::from(1.0) / length), scalar: self.scalar / length }
    }

    fn length_squared(self) -> DoubleDouble {
        self.scalar * self.scalar + self.vector.dot(self.vector)
    }

    /// Components (x, y, z, w) rounded to f64, and the remainders of that rounding.
    pub(super) fn split(self) -> (DVec4, DVec4) {
        let (vector, scalar) = (self.vector, self.scalar);
        (vector.high.extend(scalar.high), vector.low.extend(scalar.low))
    }
}
