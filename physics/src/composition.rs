//! Composition of two boosts, as of a head that moves within a vehicle that moves through the world (W 6.3).
//!
//! Two boosts in different directions make a boost and a rotation, Wigner's. As spinors a boost is (1 + t·σ) up to a
//! factor, t = u/(1 + γ), and the product (1 + t₁·σ)(1 + t₂·σ) = 1 + t₁·t₂ + (t₁ + t₂)·σ + i (t₁ × t₂)·σ shows the
//! rotation's quaternion: (1 + t₁·t₂, ± t₁ × t₂). Opposite directions make 1 + t₁·t₂ and the sum of the celerities
//! cancel at large γ. Below, each is written by 1 ± cos θ, both of which are half the square of a sum or difference of
//! the two unit vectors, held to 106 bits: sums of like signs only.

use glam::{DQuat, DVec3};

use crate::axis::BoostAxis;
use crate::celerity::Celerity;

/// Two boosts in a row: B(head)·B(vehicle) = R(wigner)·B(celerity).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition {
    /// The head's celerity in the world, world axes.
    pub celerity: Celerity,
    /// The rotation from the axes of the single boost by `celerity` to the axes reached by the two boosts in turn.
    pub wigner: DQuat,
}

/// Composes the celerity of a head, measured in the vehicle's frame (a pure boost of the world's), with the vehicle's
/// in the world.
///
/// *Equation:* with e₁, w₁, γ₁, κ₁ of the vehicle and e₂, … of the head, θ between them: u·e₁ = w₁γ₂ + γ₁w₂ cos θ, u
/// across e₁ = w₂ (e₂ across e₁); the quaternion is the normalised ((1 + γ₁)(1 + γ₂) + w₁w₂ cos θ, u₁ × u₂).
///
/// # Example
///
/// Rapidities add along one line, and nothing turns.
///
/// ```
/// use physics::{Celerity, compose, glam::{DQuat, DVec3}};
/// let half = Celerity::new(DVec3::new(0.75, 0.0, 0.0))?;
/// let both = compose(half, half);
/// assert_eq!(both.celerity.vector(), DVec3::new(1.875, 0.0, 0.0)); // β = 15/17
/// assert_eq!(both.wigner, DQuat::IDENTITY);
/// # Ok::<(), physics::CelerityError>(())
/// ```
pub fn compose(vehicle: Celerity, head: Celerity) -> Composition {
    let (first, second) = (BoostAxis::new(vehicle), BoostAxis::new(head));
    let (w1, w2) = (first.magnitude, second.magnitude);
    if w1 == 0.0 || w2 == 0.0 {
        let celerity = if w1 == 0.0 { head } else { vehicle };
        return Composition { celerity, wigner: DQuat::IDENTITY };
    }
    // Take the angle between the two from whichever of e₂ ∓ e₁ is short.
    let acute = first.direction.high.dot(second.direction.high) >= 0.0;
    let short = if acute { second.direction - first.direction } else { second.direction + first.direction }.rounded();
    let deviation = 0.5 * short.length_squared(); // 1 − |cos θ|
    let normal = first.direction.high.cross(short); // e₁ × e₂, as e₁ × e₁ = 0
    let across = normal.cross(first.direction.high);
    let cosine = 1.0 - deviation; // |cos θ|

    // γ = w + 1/κ and 1 + γ = w + (1 + 1/κ).
    let (inverse1, inverse2) = (1.0 / first.kappa, 1.0 / second.kappa);
    let (rest1, rest2) = (1.0 + inverse1, 1.0 + inverse2);
    let (along, scalar) = if acute {
        let along = w1 * (w2 + inverse2) + (w1 + inverse1) * w2 * cosine;
        (along, (w1 + rest1) * (w2 + rest2) + w1 * w2 * cosine)
    } else {
        // w₁γ₂ − γ₁w₂|cos θ| and its like for the quaternion, the leading w₁w₂ cancelled by hand.
        let along = w1 * w2 * deviation + w1 * inverse2 - w2 * inverse1 * cosine;
        (along, w1 * w2 * deviation + w1 * rest2 + w2 * rest1 + rest1 * rest2)
    };
    let vector = normal * (w1 * w2);
    let length = libm::hypot(scalar, vector.length());
    Composition {
        celerity: Celerity::from_finite(first.direction.high * along + across * w2),
        wigner: unit_quaternion(vector / length, scalar / length),
    }
}

/// A quaternion from its vector and scalar parts, already of length 1 to rounding.
fn unit_quaternion(vector: DVec3, scalar: f64) -> DQuat {
    DQuat::from_xyzw(vector.x, vector.y, vector.z, scalar)
}
