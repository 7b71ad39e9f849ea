//! Aberration and Doppler factor: the direction in which light is seen, and the factor by which its frequency is
//! raised.
//!
//! A direction is a null vector without its length, so aberration is the image of a point one metre away, by the
//! light-cone form that the apparent position uses too: exact ahead, astern and 1e-12 rad from astern at every γ, with
//! no angle, no `acos` and no difference.

use glam::DVec3;

use crate::axis::BoostAxis;
use crate::celerity::Celerity;

/// Aberration for an observer of one celerity, prepared once and applied to many directions.
///
/// # Example
///
/// Light that comes from abeam in the world is seen ahead of abeam at β = 0.6: cos θ' = 0.6.
///
/// ```
/// use physics::{Celerity, aberration::Aberration, glam::DVec3};
/// let aberration = Aberration::new(Celerity::new(DVec3::new(0.75, 0.0, 0.0))?);
/// let (direction, doppler) = aberration.observer_from_world(DVec3::Y);
/// assert_eq!(direction, DVec3::new(0.6, 0.8, 0.0));
/// assert_eq!(doppler, 1.25);
/// # Ok::<(), physics::CelerityError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Aberration(BoostAxis);

impl Aberration {
    /// Aberration for an observer of this celerity, measured in the world.
    pub fn new(celerity: Celerity) -> Self {
        Self(BoostAxis::new(celerity))
    }

    /// The direction n' in which the observer sees light that in the world comes from `n`, and the Doppler factor.
    ///
    /// *Frames, units:* both directions point from the observer to the source; `n` in world axes, of any finite length
    /// but zero, n' of length 1 in the axes of the pure boost. A zero `n` has no direction: n' is zero and D = γ.
    ///
    /// *Equation:* D = γ + u·n for a unit n; across the motion n'⊥ = n⊥ / D (W 4.2, B eq. 2.8).
    ///
    /// *Accuracy:* 1e-15 rad and a few units in the last place of D, γ to 1e12 (`tests/physics/high_precision.rs`).
    pub fn observer_from_world(&self, n: DVec3) -> (DVec3, f64) {
        let image = self.0.image(n.into());
        (image.direction(), image.doppler)
    }

    /// The direction n in the world of light that the observer sees in `n'`, and the Doppler factor D = ν_observed /
    /// ν_world.
    ///
    /// Inverse of [`Aberration::observer_from_world`], with the same properties.
    pub fn world_from_observer(&self, n: DVec3) -> (DVec3, f64) {
        let image = self.0.reversed().image(n.into());
        (image.direction(), 1.0 / image.doppler)
    }
}
