//! Shape of the photo-surface about a place: how a small step of a resting thing moves its apparent position, and how
//! its surface stands there.
//!
//! With d the displacement from the eye to a place at rest, r = |d|, n = d/r and the celerity u, the apparent position
//! is x' = d + u (r + u·d / (1 + γ)) (W 5.1; [`crate::apparent`] computes it without cancellation). Its derivative and
//! the normals follow in closed form. They are what an onlooker needs who looks at the photo-surface from outside
//! (W 5.1.5).

use glam::{DMat3, DVec3};

use crate::aberration::Aberration;
use crate::celerity::Celerity;

/// Derivative of the apparent position x' by the displacement d.
///
/// *Frames, units:* `displacement` from the eye to a place at rest in the world, metres, not zero; the result takes
/// world axes to those of the pure boost.
///
/// *Equation:* DR = 1 + u⊗u / (1 + γ) + u⊗n; det DR = D.
pub fn jacobian(celerity: Celerity, displacement: DVec3) -> DMat3 {
    let u = celerity.vector();
    let row = u / (1.0 + celerity.gamma()) + displacement.normalize();
    // Column j of u ⊗ row is u row_j.
    DMat3::IDENTITY + DMat3::from_cols(u * row.x, u * row.y, u * row.z)
}

/// Unit normal of the photo-surface where a resting surface with this normal is seen.
///
/// *Frames, units:* `displacement` as for [`jacobian`], `normal` of any length, world axes; the result in the axes of
/// the pure boost, on the same side of the surface.
///
/// *Equation:* with e along the motion, θ the angle from it to d, w = |u|, and ê⊥ across the motion towards d: N∥ =
/// n∥ / D, N⊥ = n⊥ − (w sin θ) N∥ ê⊥, the solution of DRᵀ N = n, here of length 1.
pub fn normal(celerity: Celerity, displacement: DVec3, normal: DVec3) -> DVec3 {
    let Some(e) = celerity.direction() else { return normal.normalize_or_zero() };
    let (_, doppler) = Aberration::new(celerity).observer_from_world(displacement);
    let towards = displacement.normalize();
    let across = towards - e * e.dot(towards);
    let along = normal.dot(e) / doppler;
    let outside = normal - e * normal.dot(e) - across * (celerity.magnitude() * along) + e * along;
    outside.normalize_or_zero()
}
