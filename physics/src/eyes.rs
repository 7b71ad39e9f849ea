//! Two eyes: the pair of events from which a stereo picture is taken.
//!
//! The eyes of one observer look at the same moment of the observer's own time. In the world the two events are
//! further apart along the motion than the eyes are, by γ, and the event ahead is later, so each eye sees the world at
//! a time of its own (B 5.2).

use glam::DVec3;
use thiserror::Error;

use crate::celerity::unit_vector;
use crate::event::Event;
use crate::observer::Observer;

/// The events of both eyes, in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Eyes {
    /// Event of the left eye.
    pub left: Event,
    /// Event of the right eye.
    pub right: Event,
}

/// Events of the two eyes of an observer whose event is at the middle of the head.
///
/// *Frames, units:* `separation` in metres of the observer's frame; `right` points from the left eye to the right one
/// in the axes of the pure boost into that frame, and may have any length; the events are in the world.
///
/// # Errors
///
/// The separation is negative or not finite, or `right` has no direction.
///
/// # Example
///
/// Two eyes, one behind the other, at β = 0.6:
///
/// ```
/// use physics::{Celerity, Event, Observer, eyes::eyes, glam::DVec3};
/// let observer = Observer { event: Event::default(), celerity: Celerity::new(DVec3::new(0.75, 0.0, 0.0))? };
/// let eyes = eyes(&observer, 2.0, DVec3::X)?;
/// assert_eq!(eyes.right, Event { ct: 0.75, position: DVec3::new(1.25, 0.0, 0.0) });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn eyes(observer: &Observer, separation: f64, right: DVec3) -> Result<Eyes, EyesError> {
    if !(separation.is_finite() && separation >= 0.0) {
        return Err(EyesError::Separation { separation });
    }
    let right = unit_vector(right).ok_or(EyesError::Right { right })?;
    let half = right * (0.5 * separation);
    Ok(Eyes { left: observer.at_offset(-half).event, right: observer.at_offset(half).event })
}

/// The reasons why there is no pair of eyes.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum EyesError {
    /// A separation that is negative or not finite.
    #[error("the separation of the eyes must be a finite number of metres, 0 or more, not {separation}")]
    Separation {
        /// The value given.
        separation: f64,
    },
    /// A direction towards the right eye that is zero or not finite.
    #[error("the direction towards the right eye must be finite and not zero, not {right}")]
    Right {
        /// The value given.
        right: DVec3,
    },
}
