//! Who looks at the screens: where the head is if nothing tracks it, and how far apart the eyes are.

use glam::{DMat3, DVec3};

/// Distance between the pupils of a grown person, metres: the mean of large surveys is 63 to 64 mm.
pub const EYE_SEPARATION_M: f64 = 0.064;

/// Where an untracked head is unless the file says so: at the height of someone who stands in the room's middle.
pub const HEAD_M: DVec3 = DVec3::new(0.0, 1.6, 0.0);

/// Which eye a channel is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Eye {
    /// The left one.
    Left,
    /// The right one.
    Right,
    /// The point midway between them: everything that is not stereo.
    Centre,
}

impl Eye {
    /// −1, +1 and 0: how many half separations it is to the right of the head's middle.
    pub fn side(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
            Self::Centre => 0.0,
        }
    }

    /// As display files spell it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Centre => "centre",
        }
    }
}

/// The viewer of a display.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewer {
    /// Metres between the eyes in the room: this is what frusta and pixel maps are made for.
    pub eye_separation_m: f64,
    /// How many times further apart the eyes are in the world than in the room. 1 is true to scale.
    pub eye_scale: f64,
    /// The point midway between the eyes of a head that nothing tracks, room axes, metres; it faces −z.
    pub head_m: DVec3,
}

impl Default for Viewer {
    fn default() -> Self {
        Self { eye_separation_m: EYE_SEPARATION_M, eye_scale: 1.0, head_m: HEAD_M }
    }
}

impl Viewer {
    /// An eye's place in the room, metres.
    ///
    /// # Arguments
    /// * `head_m` — the point midway between the eyes, room axes.
    /// * `room_from_head` — rotation from the head's axes (x right, y up, −z ahead).
    pub fn eye_m(&self, eye: Eye, head_m: DVec3, room_from_head: DMat3) -> DVec3 {
        head_m + room_from_head.x_axis * (0.5 * eye.side() * self.eye_separation_m)
    }

    /// How far an eye is from the head's middle in the world, head axes, metres: the eye separation times [`eye_scale`](Self::eye_scale).
    pub fn world_offset_m(&self, eye: Eye) -> DVec3 {
        DVec3::X * (0.5 * eye.side() * self.eye_separation_m * self.eye_scale)
    }
}
