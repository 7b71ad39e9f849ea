//! Rest of a room: the time since which its eyes see the same.

use crate::head::OccupantEye;
use crate::picture_shares::STILL_AFTER;
use std::time::Instant;
use view::Effects;

/// Eyes that the room was drawn for last, and the time since which they see the same.
#[derive(Clone, Debug)]
pub struct RoomRest {
    eyes: Vec<OccupantEye>,
    effects: Effects,
    since: Instant,
}

impl RoomRest {
    /// Eyes of the room's newest frame. `before`: those of the frame before it, if nothing in the scene moves.
    pub fn after(before: Option<Self>, eyes: Vec<OccupantEye>, effects: Effects) -> Self {
        let since = before.filter(|before| {
            let alike = before.eyes.iter().zip(&eyes).all(|(one, other)| looks_alike(one, other));
            alike && before.eyes.len() == eyes.len() && before.effects == effects
        });
        Self { since: since.map_or_else(Instant::now, |before| before.since), eyes, effects }
    }

    /// True if these eyes look at the time of the frame before, as while a ride is held.
    pub fn is_at(&self, eyes: &[OccupantEye]) -> bool {
        let times = self.eyes.iter().zip(eyes);
        times.clone().count() == eyes.len()
            && times.into_iter().all(|(one, other)| one.observer.event.ct == other.observer.event.ct)
    }

    /// True if nothing has changed for a while.
    pub fn is_still(&self) -> bool {
        self.since.elapsed() >= STILL_AFTER
    }
}

/// True if two eyes see the same of a scene in which nothing moves: the time of the event does not matter.
fn looks_alike(one: &OccupantEye, other: &OccupantEye) -> bool {
    let same =
        |eye: &OccupantEye| (eye.observer.event.position, eye.observer.celerity, eye.observer_from_room, eye.place_m);
    same(one) == same(other)
}
