//! Pure Lorentz boosts: from the world's frame to that of an observer who moves through it, and back.

use crate::axis::BoostAxis;
use crate::celerity::Celerity;
use crate::double_double::DoubleDouble;
use crate::event::FourVector;

/// A pure boost, prepared once and applied to many four-vectors.
///
/// # Example
///
/// A clock that rests in the world is seen to run slow by γ: its tick of one metre of light time takes 1.25 m.
///
/// ```
/// use physics::{Boost, Celerity, FourVector, glam::DVec3};
/// let observer_from_world = Boost::observer_from_world(Celerity::new(DVec3::new(0.75, 0.0, 0.0))?);
/// let tick = observer_from_world.apply(FourVector { t: 1.0, r: DVec3::ZERO });
/// assert_eq!(tick, FourVector { t: 1.25, r: DVec3::new(-0.75, 0.0, 0.0) });
/// # Ok::<(), physics::CelerityError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Boost(BoostAxis);

impl Boost {
    /// The boost into the frame of an observer of this celerity (measured in the world).
    pub fn observer_from_world(celerity: Celerity) -> Self {
        Self(BoostAxis::new(celerity))
    }

    /// Inverse boost: `world_from_observer` of an `observer_from_world`, and the reverse.
    pub fn inverse(self) -> Self {
        Self(self.0.reversed())
    }

    /// Transforms a four-vector into the boost's target frame.
    ///
    /// *Equation:* t' = γ t − w h, h' = γ h − w t (W 4.1), written with γ = w + 1/κ as t' = t/κ + w (t − h), h' = h/κ −
    /// w (t − h). The only difference left, t − h, is taken at 106 bits, so what error there is comes from the f64
    /// components of the input and the result.
    pub fn apply(self, vector: FourVector) -> FourVector {
        let BoostAxis { direction, magnitude, kappa } = self.0;
        if magnitude == 0.0 {
            return vector;
        }
        let split = self.0.split(vector.r.into());
        let lag = magnitude * (DoubleDouble::from(vector.t) - split.along).rounded();
        FourVector {
            t: vector.t / kappa + lag,
            r: split.across + direction.high * (split.along.rounded() / kappa - lag),
        }
    }
}
