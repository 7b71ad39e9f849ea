//! Eyes of an occupant, by multiplied-out Lorentz matrices, which share nothing with the program's own composition of
//! boosts.

use crate::lorentz::{boost, four, rotation, space};
use glam::{DMat4, DVec3};
use walls::Occupant;

/// Eye in the world.
pub struct EyeInWorld {
    /// Transformation from the eye's frame, with axes named like the room's, to the world's.
    pub world_from_eye: DMat4,
    /// Place of the eye in the world, metres.
    pub place: DVec3,
}

impl EyeInWorld {
    /// Eye that is so far to the right of the middle between an occupant's eyes, in the world, metres.
    pub fn of(occupant: &Occupant, to_the_right_m: f64) -> Self {
        let Occupant { vehicle, thrust, head } = occupant;
        let world_from_room = boost(-vehicle.celerity.vector()) * rotation(vehicle.orientation);
        let of_head = carried(thrust.turn_rate.cross(head.place_m), head.celerity.vector());
        let world_from_middle = world_from_room * boost(-of_head);
        let aside = head.room_from_head.x_axis * to_the_right_m;
        // The clocks of the head and of the vehicle differ by the head's γ.
        let turn = head.turn_rate + thrust.turn_rate * (1.0 + of_head.length_squared()).sqrt();
        let of_eye = carried(turn.cross(aside), DVec3::ZERO);
        let event = four(vehicle.ct, vehicle.position)
            + world_from_room * four(0.0, head.place_m)
            + world_from_middle * four(0.0, aside);
        Self { world_from_eye: world_from_middle * boost(-of_eye), place: space(event) }
    }

    /// Direction in the world from which light comes that the eye sees in a direction of the room's axes.
    pub fn origin(&self, seen: DVec3) -> DVec3 {
        // The light came from there, at an earlier time.
        space(self.world_from_eye * four(-1.0, seen.normalize())).normalize()
    }

    /// Distance in the eye's frame of what the eye sees in a direction of the room's axes, if it is so far in the
    /// world, metres.
    pub fn apparent_m(&self, seen: DVec3, distance_m: f64) -> f64 {
        // Light that comes from one metre in the eye's frame comes from so far in the world.
        distance_m / space(self.world_from_eye * four(-1.0, seen.normalize())).length()
    }
}

/// Celerity U of what moves by `celerity` over ground that moves at β: U = γβ + u, by repetition.
fn carried(beta: DVec3, celerity: DVec3) -> DVec3 {
    (0..200).fold(celerity, |carried, _| beta * (1.0 + carried.length_squared()).sqrt() + celerity)
}
