//! Head that stands or walks in the vehicle, and its eyes.

use glam::{DMat3, DQuat, DVec3};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Observer};
use room::{EyeSide, Viewer};

/// Head in the room, whose axes are those of the vehicle (x right, y up, −z ahead).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoomHead {
    /// Point midway between the eyes, room axes, metres from the vehicle's reference point.
    pub place_m: DVec3,
    /// Rotation from the head's axes (x right, y up, −z ahead) to the room's.
    pub room_from_head: DMat3,
    /// Celerity of the head, metres of the room for each metre of its own time, room axes.
    pub celerity: Celerity,
    /// Turn of the head against the room, radians for each metre of its own time, room axes.
    pub turn_rate: DVec3,
}

impl RoomHead {
    /// Head at rest that faces −z.
    pub fn at_rest(place_m: DVec3) -> Self {
        Self { place_m, room_from_head: DMat3::IDENTITY, celerity: Celerity::ZERO, turn_rate: DVec3::ZERO }
    }
}

/// Observer in the room of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occupant {
    /// State of the vehicle in the world.
    pub vehicle: WorldlineState,
    /// Acceleration and turn of the vehicle, which carry the room along.
    pub thrust: Thrust,
    /// Head of the observer in the room.
    pub head: RoomHead,
}

/// Eye of an occupant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OccupantEye {
    /// Event and celerity of the eye in the world.
    pub observer: Observer,
    /// Rotation from the room's axes, turned with the head where its pictures are, to those of the pure boost from the
    /// world.
    ///
    /// The axes of the eye's own frame are a pure boost of the room's and are named as the room's are: a pixel of a
    /// screen shows what the eye sees, in these axes, towards the pixel. Wigner's rotation is therefore part of this
    /// rotation.
    pub observer_from_room: DQuat,
    /// Place of the eye in the room, metres. Screens are looked at from here.
    pub place_m: DVec3,
}

impl Occupant {
    /// Eye of the occupant; the centre is midway between both eyes.
    ///
    /// *Equation:* the head's event is simultaneous with the vehicle's reference point in the vehicle's frame; the
    /// eyes' events are simultaneous with the head's in the head's frame (B 5.2, W 6.3). Each is a step along the
    /// simultaneity of its own frame, [`WorldlineState::aboard`]. The vehicle's turn carries the head along, and both
    /// turns carry the eyes (B 3.4.3); Thomas precession of the head in the vehicle, of the order of the turn times the
    /// square of the head's β, is left out.
    pub fn eye(&self, viewer: &Viewer, eye: EyeSide) -> OccupantEye {
        let RoomHead { place_m, room_from_head, celerity, turn_rate } = self.head;
        let middle = self.vehicle.aboard(place_m, celerity, &self.thrust);
        let turn_rate = turn_rate + self.thrust.turn_rate * self.thrust.time_ratio(place_m, celerity);
        let turn = Thrust { turn_rate, ..Thrust::default() };
        let seen_from = middle.aboard(room_from_head * viewer.world_offset_m(eye), Celerity::ZERO, &turn);
        // Pictures that turn with the head are looked at by a head that looks ahead, in a room that has turned with it.
        let (picture_turn, room_from_head) = if viewer.turns_pictures {
            (DQuat::from_mat3(&room_from_head), DMat3::IDENTITY)
        } else {
            (DQuat::IDENTITY, room_from_head)
        };
        OccupantEye {
            observer: seen_from.observer(),
            observer_from_room: seen_from.orientation * picture_turn,
            place_m: viewer.eye_m(eye, place_m, room_from_head),
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: a turn of the head turns the pictures of a display whose pictures turn with it, and moves the
    //! eyes alone where screens stand in the room. A wrong program shows the same picture to every head.
    use super::*;
    use physics::Event;

    #[test]
    fn pictures_turn_with_the_head_only_where_the_display_says_so() {
        let celerity = Celerity::new(DVec3::new(0.0, 0.0, -0.75)).unwrap_or_default();
        let vehicle = WorldlineState::new(Event { ct: 0.0, position: DVec3::ZERO }, celerity, DQuat::IDENTITY);
        let turn = DQuat::from_rotation_y(0.5);
        let ahead = RoomHead::at_rest(DVec3::Y);
        let turned = RoomHead { room_from_head: DMat3::from_quat(turn), ..ahead };
        for (turns_pictures, expected) in [(false, DQuat::IDENTITY), (true, turn)] {
            let viewer = Viewer { turns_pictures, ..Viewer::default() };
            let eye = |head, side| Occupant { vehicle, thrust: Thrust::default(), head }.eye(&viewer, side);
            let [before, after] = [ahead, turned].map(|head| eye(head, EyeSide::Centre));
            assert_eq!(before.observer, after.observer);
            let between = before.observer_from_room.inverse() * after.observer_from_room;
            assert!(between.angle_between(expected) < 1e-7, "{between} for {expected}");
            // The picture's middle is before each eye, wherever the eyes have gone.
            let [before, after] = [ahead, turned].map(|head| eye(head, EyeSide::Left));
            assert_eq!(before.place_m == after.place_m, turns_pictures);
        }
    }
}
