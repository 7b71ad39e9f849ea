//! Rigid transforms: a turn, then a shift.

use glam::{DQuat, DVec3};

/// Rigid transform, named `target_from_source`. It takes points of the source's axes to the target's, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// Origin of the source in the target's axes, metres.
    pub position: DVec3,
    /// Turn that takes the source's axes to the target's, of length one.
    pub orientation: DQuat,
}

impl Rigid {
    /// Transform that changes nothing.
    pub const IDENTITY: Self = Self { position: DVec3::ZERO, orientation: DQuat::IDENTITY };

    /// Point of the source's axes in the target's.
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.position + self.orientation * point
    }

    /// Inverse transform, `source_from_target`.
    pub fn inverse(&self) -> Self {
        let orientation = self.orientation.conjugate();
        Self { position: orientation * -self.position, orientation }
    }
}

impl std::ops::Mul for Rigid {
    type Output = Self;

    /// Product: `c_from_b * b_from_a` is `c_from_a`.
    fn mul(self, other: Self) -> Self {
        Self { position: self.point(other.position), orientation: (self.orientation * other.orientation).normalize() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_apply_from_right_to_left_and_inverses_undo() {
        let turn = Rigid { position: DVec3::X, orientation: DQuat::from_rotation_y(0.7) };
        let shift = Rigid { position: DVec3::new(0.1, -0.2, 0.3), orientation: DQuat::from_rotation_x(-0.4) };
        let point = DVec3::new(3.0, 5.0, -7.0);
        let difference = (turn * shift).point(point) - turn.point(shift.point(point));
        assert!(difference.length() < 1e-14, "{difference}");
        let back = (turn * shift).inverse().point((turn * shift).point(point));
        assert!((back - point).length() < 1e-14, "{back}");
    }
}
