//! Viewer of the screens: the place of an untracked head, and the distance between the eyes.

use glam::{DMat3, DVec3};

/// Distance between the pupils of an adult, metres. The mean of large surveys is 63 to 64 mm.
pub const EYE_SEPARATION_M: f64 = 0.064;

/// Place of an untracked head unless the file gives one, room axes, metres: the height of a person standing in the
/// room's middle.
pub const HEAD_M: DVec3 = DVec3::new(0.0, view::EYE_HEIGHT_M, 0.0);

/// Eye for which a channel is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EyeSide {
    /// The left eye.
    Left,
    /// The right eye.
    Right,
    /// The point midway between the eyes, for everything that is not stereo.
    Centre,
}

impl EyeSide {
    /// Place of the eye to the right of the head's middle, in half eye separations: −1, +1 or 0.
    pub fn side(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
            Self::Centre => 0.0,
        }
    }

    /// Name of the eye in display files.
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
    /// Distance between the eyes in the room, metres. Frusta and pixel maps are made for it.
    pub eye_separation_m: f64,
    /// Distance between the eyes in the world, divided by that in the room. 1 is true to scale.
    pub eye_scale: f64,
    /// Point midway between the eyes of an untracked head, room axes, metres; the head faces −z.
    pub head_m: DVec3,
    /// True if the pictures turn with the head, as those of a headset, or of a window that stands for one. Otherwise
    /// the screens stand still in the room, and a turn of the head moves the eyes alone.
    pub turns_pictures: bool,
}

impl Default for Viewer {
    fn default() -> Self {
        Self { eye_separation_m: EYE_SEPARATION_M, eye_scale: 1.0, head_m: HEAD_M, turns_pictures: false }
    }
}

impl Viewer {
    /// Place of an eye in the room, room axes, metres.
    ///
    /// # Arguments
    /// * `head_m` — point midway between the eyes, room axes, metres.
    /// * `room_from_head` — rotation from the head's axes (x right, y up, −z ahead).
    pub fn eye_m(&self, eye: EyeSide, head_m: DVec3, room_from_head: DMat3) -> DVec3 {
        head_m + room_from_head.x_axis * (0.5 * eye.side() * self.eye_separation_m)
    }

    /// Offset of an eye from the head's middle in the world, head axes, metres: the eye separation times
    /// [`eye_scale`](Self::eye_scale), half of it to each side.
    pub fn world_offset_m(&self, eye: EyeSide) -> DVec3 {
        DVec3::X * (0.5 * eye.side() * self.eye_separation_m * self.eye_scale)
    }
}
