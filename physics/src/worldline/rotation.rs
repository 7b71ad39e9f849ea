//! Rotations of about 106 bits: what f64 drops from an orientation, a fast circle multiplies by γ² a turn after turn.

use glam::DVec4;

use crate::double_double::{DoubleDouble, DoubleDoubleVec3};

/// A quaternion, of any length but zero.
#[derive(Clone, Copy)]
pub(super) struct Rotation {
    pub(super) vector: DoubleDoubleVec3,
    pub(super) scalar: DoubleDouble,
}

impl Rotation {
    /// This rotation after another.
    pub(super) fn after(self, first: Self) -> Self {
        let (a, b) = (self, first);
        Self {
            vector: b.vector.scaled(a.scalar) + a.vector.scaled(b.scalar) + a.vector.precise_cross(b.vector),
            scalar: a.scalar * b.scalar - a.vector.dot(b.vector),
        }
    }

    /// The vector turned; the quaternion's length does not matter.
    pub(super) fn turn(self, vector: DoubleDoubleVec3) -> DoubleDoubleVec3 {
        let across = self.vector.precise_cross(vector);
        let half = across.scaled(self.scalar) + self.vector.precise_cross(across);
        vector + half.scaled(DoubleDouble::from(2.0) / self.length_squared())
    }

    /// At length 1. Divided, so that no rotation stays exactly none.
    pub(super) fn normalised(self) -> Self {
        let length = self.length_squared().sqrt();
        Self { vector: self.vector.scaled(DoubleDouble::from(1.0) / length), scalar: self.scalar / length }
    }

    fn length_squared(self) -> DoubleDouble {
        self.scalar * self.scalar + self.vector.dot(self.vector)
    }

    /// The components (x, y, z, w) in f64, and what they leave.
    pub(super) fn split(self) -> (DVec4, DVec4) {
        let (vector, scalar) = (self.vector, self.scalar);
        (vector.high.extend(scalar.high), vector.low.extend(scalar.low))
    }
}
