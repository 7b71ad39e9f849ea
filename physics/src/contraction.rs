//! Places of things at an observer's own present: contracted along the motion, and nothing else.
//!
//! An observer who asks where everything *is now* means one moment of the observer's own time. A thing at rest in the
//! world, d away, is there at every moment. So its place in the observer's frame is the place at which its worldline
//! crosses that moment: the boost of (w h / γ, d), h being the part of d along the motion (W 4.1). The time part of the
//! boost is zero, and in space only h changes, to h / γ. This is a linear map about the eye.

use glam::{DMat3, DVec3};

use crate::celerity::Celerity;

/// Linear map from displacements in a frame to places at the present of an observer who moves through it.
///
/// # Example
///
/// At β = 0.6 a metre rod along the motion measures 80 cm, and one across it a metre.
///
/// ```
/// use physics::{Celerity, Contraction, glam::DVec3};
/// let contraction = Contraction::new(Celerity::new(DVec3::X * 0.75)?);
/// assert_eq!(contraction.observer_from_world(DVec3::X), DVec3::X * 0.8);
/// assert_eq!(contraction.observer_from_world(DVec3::Y), DVec3::Y);
/// # Ok::<(), physics::CelerityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contraction {
    /// Unit vector n of the motion; zero at rest.
    direction: DVec3,
    gamma: f64,
    /// Celerity u.
    celerity: DVec3,
}

impl Contraction {
    /// Map for an observer of this celerity, measured in the frame of the displacements.
    pub fn new(celerity: Celerity) -> Self {
        let direction = celerity.direction().unwrap_or(DVec3::ZERO);
        Self { direction, gamma: celerity.gamma(), celerity: celerity.vector() }
    }

    /// Place at the observer's present of a thing that rests at displacement `d` from the observer.
    ///
    /// *Frames:* `d` in the frame in which the thing rests; the place in the axes of the pure boost out of it.
    ///
    /// *Equation:* x' = d − (1 − 1/γ)(d·n) n. *Accuracy:* a few roundings of |d|; 1 − 1/γ is not taken as a difference.
    pub fn observer_from_world(&self, d: DVec3) -> DVec3 {
        d - self.direction * (self.direction.dot(d) * self.shorter())
    }

    /// Displacement at which a thing rests that is at the place `x` at the observer's present: the inverse.
    ///
    /// *Equation:* d = x' + (γ − 1)(x'·n) n.
    pub fn world_from_observer(&self, x: DVec3) -> DVec3 {
        let longer = self.celerity.length_squared() / (self.gamma + 1.0);
        x + self.direction * (self.direction.dot(x) * longer)
    }

    /// Time, in the frame of the displacements, by which an event at the place `x` of the observer's present is later
    /// than the observer's own, metres.
    ///
    /// *Equation:* t = u·x' (W 4.1).
    pub fn world_time(&self, x: DVec3) -> f64 {
        self.celerity.dot(x)
    }

    /// Matrix of [`Contraction::observer_from_world`].
    pub fn matrix(&self) -> DMat3 {
        DMat3::from_cols(
            self.observer_from_world(DVec3::X),
            self.observer_from_world(DVec3::Y),
            self.observer_from_world(DVec3::Z),
        )
    }

    /// Part by which lengths along the motion are shorter, 1 − 1/γ = w² / (γ (γ + 1)).
    fn shorter(&self) -> f64 {
        let w = self.celerity.length();
        w / self.gamma * (w / (self.gamma + 1.0))
    }
}
