//! Special relativity for an observer who looks: frames, worldlines, aberration, apparent positions.
//!
//! # Conventions
//!
//! - **Axes** are right-handed, y up, forward −z, as in glTF.
//! - **Units.** Metres. Time is carried as ct in metres, so c = 1 everywhere in this crate; only the edge of the
//!   program knows a speed of light in metres per second.
//! - **Velocity** is carried as [`Celerity`], u = γβ: it is unbounded and loses nothing at any speed. [`Beta`] is for
//!   reading and showing.
//! - **Doppler factor** D = ν_observed / ν_emitted; D > 1 is approach.
//! - **A direction** `n` points from the observer to the source of the light. For light from a world at rest D = γ +
//!   u·n, n in world axes.
//! - **Metric** signature (+, −, −, −): the interval of a timelike [`FourVector`] is positive.
//! - **Transforms** are named `target_from_source` and applied right to left, boosts too. A boost is *pure*: it turns
//!   no axes, so "the observer's axes" are the world's axes seen after the boost unless an orientation is named.
//! - **Precision** is f64. Formulas are written in light-cone coordinates or as sums of like signs wherever the
//!   textbook form cancels, and hold for γ up to 1e12 and beyond.
//!
//! Sources are cited as W (Weiskopf, *Visualization of Four-Dimensional Spacetimes*, Tübingen 2001) and B (Borchers,
//! *Interaktive und stereoskopische Visualisierung in der speziellen Relativitätstheorie*, Tübingen 2005).

mod axis;
mod double_double;

pub mod aberration;
pub mod apparent;
pub mod apparent_shape;
pub mod boost;
pub mod celerity;
pub mod colour;
pub mod composition;
pub mod contraction;
pub mod direction_cone;
pub mod event;
pub mod eyes;
pub mod interpolation_error;
pub mod light_cone;
pub mod newton;
pub mod observer;
pub mod photo_surface;
pub mod retarded;
pub mod simultaneous;
pub mod stereo_perception;
pub mod worldline;

pub use aberration::Aberration;
pub use apparent::{Apparent, PointSource};
pub use boost::Boost;
pub use celerity::{Beta, Celerity, CelerityError};
pub use composition::{Composition, compose};
pub use contraction::Contraction;
pub use direction_cone::DirectionCone;
pub use event::{Event, FourVector};
pub use light_cone::LightConeCoordinates;
pub use observer::Observer;

/// The vector and quaternion types of the public interface.
pub use glam;
