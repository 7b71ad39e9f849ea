//! The observer: an event on a worldline, and the celerity there.

use glam::DVec3;

use crate::boost::Boost;
use crate::celerity::Celerity;
use crate::event::{Event, FourVector};

/// An event on a worldline with the celerity there, both in the world's frame and axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Observer {
    /// Event of the look.
    pub event: Event,
    /// Celerity, measured in the world.
    pub celerity: Celerity,
}

impl Observer {
    /// The boost into this observer's frame; the axes stay the world's, unturned.
    pub fn observer_from_world(&self) -> Boost {
        Boost::observer_from_world(self.celerity)
    }

    /// The observer who rests at `offset` from this one, at the same time for both.
    ///
    /// *Frames, units:* `offset` in the axes of the pure boost into this observer's frame, metres; the result in the
    /// world. Every eye aboard a vehicle and each eye of a pair is worked out here.
    ///
    /// *Equation:* the event is this one plus B(−u)(0, offset): along the motion the offset is longer by γ in the
    /// world, and later by u·offset (B 5.2).
    ///
    /// # Example
    ///
    /// One metre ahead, at β = 0.6:
    ///
    /// ```
    /// use physics::{Celerity, Event, Observer, glam::DVec3};
    /// let observer = Observer { event: Event::default(), celerity: Celerity::new(DVec3::new(0.75, 0.0, 0.0))? };
    /// let ahead = observer.at_offset(DVec3::X);
    /// assert_eq!(ahead.event, Event { ct: 0.75, position: DVec3::new(1.25, 0.0, 0.0) });
    /// assert_eq!(ahead.celerity, observer.celerity);
    /// # Ok::<(), physics::CelerityError>(())
    /// ```
    pub fn at_offset(&self, offset: DVec3) -> Self {
        let world_from_observer = self.observer_from_world().inverse();
        let displacement = world_from_observer.apply(FourVector { t: 0.0, r: offset });
        Self { event: self.event + displacement, celerity: self.celerity }
    }
}
