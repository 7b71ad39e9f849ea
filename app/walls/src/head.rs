//! A head that stands or walks in the vehicle, and the eyes in it.

use crate::room::{Eye, Viewer};
use glam::{DMat3, DQuat, DVec3};
use physics::worldline::State;
use physics::{Celerity, Observer};

/// A head in the room, whose axes are those of the vehicle (x right, y up, −z ahead).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Head {
    /// The point midway between the eyes, metres from the vehicle's reference point.
    pub place_m: DVec3,
    /// Rotation from the head's axes (x right, y up, −z where it faces).
    pub room_from_head: DMat3,
    /// Celerity in the room.
    pub celerity: Celerity,
}

impl Head {
    /// A head that rests and faces −z.
    pub fn at_rest(place_m: DVec3) -> Self {
        Self { place_m, room_from_head: DMat3::IDENTITY, celerity: Celerity::ZERO }
    }
}

/// Someone in the room of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occupant {
    /// The vehicle.
    pub vehicle: State,
    /// His head in it.
    pub head: Head,
}

/// One of his eyes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OccupantEye {
    /// Event and celerity in the world.
    pub observer: Observer,
    /// Rotation from the room's axes to those of the pure boost from the world.
    ///
    /// His own frame's axes are a pure boost of the room's, and are named as the room's are: a pixel of a screen shows what he sees, in these
    /// axes, towards it. Wigner's rotation is therefore part of this one.
    pub observer_from_room: DQuat,
    /// Where it is in the room, metres: what screens are looked at from.
    pub place_m: DVec3,
}

impl Occupant {
    /// One of his eyes; the centre is between them.
    ///
    /// *Equation:* the head's event is simultaneous to the vehicle's reference point for the vehicle, the eyes' events to the head's for the
    /// head (B 5.2, W 6.3): each a step along the simultaneity of its own frame, [`State::aboard`].
    pub fn eye(&self, viewer: &Viewer, eye: Eye) -> OccupantEye {
        let Head { place_m, room_from_head, celerity } = self.head;
        let middle = self.vehicle.aboard(place_m, celerity);
        let seen_from = middle.aboard(room_from_head * viewer.world_offset_m(eye), Celerity::ZERO);
        OccupantEye {
            observer: seen_from.observer(),
            observer_from_room: seen_from.orientation,
            place_m: viewer.eye_m(eye, place_m, room_from_head),
        }
    }
}
