//! The observer: where and when a look is taken, and how fast the one who looks is moving.

use crate::boost::Boost;
use crate::celerity::Celerity;
use crate::event::Event;

/// An event on a worldline with the celerity there, both in the world's frame and axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Observer {
    /// Where and when.
    pub event: Event,
    /// How fast, measured in the world.
    pub celerity: Celerity,
}

impl Observer {
    /// The boost into this observer's frame; the axes stay the world's, unturned.
    pub fn observer_from_world(&self) -> Boost {
        Boost::observer_from_world(self.celerity)
    }
}
