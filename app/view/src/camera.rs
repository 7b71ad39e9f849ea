//! Cameras: from the observer's directions to a flat picture.
//!
//! The camera looks along directions of the observer's own frame, whose axes are a pure boost of the world's. To the
//! camera, the photo-surface is an ordinary three-dimensional object; the paths of light are computed elsewhere.

use glam::{DQuat, DVec2, DVec3};
use physics::{Aberration, Celerity};

/// Camera with a flat picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Rotation from the eye's axes (x right, y up, −z ahead) to the observer's.
    pub observer_from_eye: DQuat,
    /// Part of the plane ahead that the picture shows.
    pub field: Field,
}

/// Part of the plane one unit ahead of the eye that a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Field {
    /// A picture whose middle lies straight ahead, with square pixels.
    Ahead {
        /// Full vertical angle, radians, in (0, π).
        fov_y_rad: f64,
    },
    /// A screen, whose middle need not be straight ahead of the eye (B A.2; Kooima 2009).
    Screen(Tangents),
}

/// Rectangle in the plane one unit ahead of the eye: x to the right, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// Lower left corner of the rectangle.
    pub low: DVec2,
    /// Upper right corner of the rectangle.
    pub high: DVec2,
}

impl Tangents {
    /// Middle of the rectangle.
    pub fn middle(&self) -> DVec2 {
        0.5 * (self.low + self.high)
    }

    /// Vector from the middle to the upper right corner.
    pub fn half(&self) -> DVec2 {
        0.5 * (self.high - self.low)
    }

    /// Pixels per unit of tangent in a picture of `size` pixels, horizontally and vertically.
    pub fn focal_length(&self, size: [u32; 2]) -> DVec2 {
        DVec2::new(f64::from(size[0]), f64::from(size[1])) / (self.high - self.low)
    }

    /// Largest tangents of the rectangle, to either side, horizontally and vertically.
    pub fn farthest(&self) -> DVec2 {
        self.low.abs().max(self.high.abs())
    }
}

impl Camera {
    /// Creates a camera that looks along `look`, with `up` as far up in the picture as possible (observer's axes, any
    /// length).
    ///
    /// If `up` is parallel to `look`, the world's −z is used instead; when looking along that, +y.
    pub fn looking(look: DVec3, up: DVec3, fov_y_rad: f64) -> Self {
        let back = -look.normalize_or(DVec3::NEG_Z);
        let right = [up, DVec3::NEG_Z, DVec3::Y]
            .into_iter()
            .map(|candidate| candidate.normalize_or_zero().cross(back))
            .find(|right| right.length_squared() > 1e-12)
            .map_or(DVec3::X, DVec3::normalize);
        let axes = glam::DMat3::from_cols(right, back.cross(right), back);
        Self { observer_from_eye: DQuat::from_mat3(&axes), field: Field::Ahead { fov_y_rad } }
    }

    /// Rectangle of the plane ahead that a picture of `size` pixels shows.
    pub fn tangents(&self, size: [u32; 2]) -> Tangents {
        match self.field {
            Field::Ahead { fov_y_rad } => {
                let tan_y = (0.5 * fov_y_rad).tan();
                let high = DVec2::new(tan_y * f64::from(size[0]) / f64::from(size[1].max(1)), tan_y);
                Tangents { low: -high, high }
            }
            Field::Screen(tangents) => tangents,
        }
    }

    /// Direction of a place in a picture of `size` pixels, eye axes: (x, y, −1).
    ///
    /// *Units:* pixels from the upper left corner; the centre of the first pixel is at one half.
    pub fn ahead(&self, size: [u32; 2], place: DVec2) -> DVec3 {
        let tangents = self.tangents(size);
        let from_middle = (place - 0.5 * DVec2::new(f64::from(size[0]), f64::from(size[1]))) * DVec2::new(1.0, -1.0);
        (tangents.middle() + from_middle / tangents.focal_length(size)).extend(-1.0)
    }

    /// Doppler factor of light from the world at a place in a picture of the usual shape: −1 to 1 from left to right,
    /// and from bottom to top. `bends`: true if light takes its time.
    pub fn doppler_at(&self, place: DVec2, motion: Celerity, bends: bool) -> f64 {
        const USUAL: [u32; 2] = [16, 10];
        let tangents = self.tangents(USUAL);
        let seen = self.observer_from_eye * (tangents.middle() + place * tangents.half()).extend(-1.0);
        let aberration = Aberration::new(motion);
        let (_, doppler) =
            if bends { aberration.world_from_observer(seen) } else { aberration.observer_from_world(seen) };
        doppler
    }
}
