//! From the observer's directions to a flat picture: an eye's camera.
//!
//! The camera looks along directions of the observer's own frame, whose axes are a pure boost of the world's. How
//! light got there is none of its business: the photo-surface is an ordinary three-dimensional object to it.

use glam::{DMat4, DQuat, DVec2, DVec3, DVec4, Mat4, Vec4};
use physics::photo_surface::Eye;
use physics::{Aberration, Celerity};

/// Metres in front of the eye, at rest, nearer than which nothing is drawn.
pub const NEAR_M: f64 = 0.02;

/// Where an eye is, how it moves, and where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaze {
    /// Place and celerity, world axes.
    pub eye: Eye,
    /// World time of the look, metres of light travel.
    pub ct: f64,
    /// From eye axes (x right, y up, −z ahead) to the observer's.
    pub observer_from_eye: DQuat,
}

/// A camera with a flat picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// From eye axes (x right, y up, −z ahead) to the observer's.
    pub observer_from_eye: DQuat,
    /// How much of the plane ahead the picture shows.
    pub field: Field,
}

/// What of the plane one unit ahead of the eye a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Field {
    /// Its middle lies straight ahead, and its pixels are square.
    Ahead {
        /// Full vertical angle, radians, in (0, π).
        fov_y_rad: f64,
    },
    /// A screen, before whose middle the eye need not be (B A.2; Kooima 2009).
    Screen(Tangents),
}

/// A rectangle in the plane one unit ahead of the eye: x to the right, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// Its lower left corner.
    pub low: DVec2,
    /// Its upper right corner.
    pub high: DVec2,
}

impl Tangents {
    /// Its middle.
    pub fn middle(&self) -> DVec2 {
        0.5 * (self.low + self.high)
    }

    /// From its middle to its upper right corner.
    pub fn half(&self) -> DVec2 {
        0.5 * (self.high - self.low)
    }

    /// Pixels per tangent of a picture of `size`, across and down.
    pub fn focal_length(&self, size: [u32; 2]) -> DVec2 {
        DVec2::new(f64::from(size[0]), f64::from(size[1])) / (self.high - self.low)
    }

    /// The corner or edge farthest from straight ahead, to either side.
    pub fn farthest(&self) -> DVec2 {
        self.low.abs().max(self.high.abs())
    }
}

impl Camera {
    /// A camera that looks along `look` with `up` as far up in the picture as can be (observer's axes, any length).
    ///
    /// Where `up` is parallel to `look`, the world's −z (or, looking along that, +y) takes its place.
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

    /// What a picture of `size` pixels shows of the plane ahead.
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

    /// Where a place in a picture of `size` pixels looks, eye axes: (x, y, −1).
    ///
    /// *Units:* pixels from the upper left corner; the middle of the first pixel is at one half.
    pub fn ahead(&self, size: [u32; 2], place: DVec2) -> DVec3 {
        let tangents = self.tangents(size);
        let from_middle = (place - 0.5 * DVec2::new(f64::from(size[0]), f64::from(size[1]))) * DVec2::new(1.0, -1.0);
        (tangents.middle() + from_middle / tangents.focal_length(size)).extend(-1.0)
    }

    /// What the shaders need to draw one picture.
    ///
    /// # Arguments
    /// * `size` — pixels.
    /// * `offset` — of the sampled point from each pixel's centre, in pixels, x right and y down.
    /// * `motion` — the eye's celerity.
    /// * `geometry` — whether its aberration is to be drawn.
    /// * `scale` — what radiance is multiplied by, so that the target can hold it.
    pub fn view(&self, size: [u32; 2], offset: DVec2, motion: Celerity, geometry: bool, scale: f64) -> shaders::View {
        let [width, height] = size.map(f64::from);
        let tangents = self.tangents(size);
        let (middle, half) = (tangents.middle(), tangents.half());
        let kappa_of_light = motion.gamma() + motion.magnitude();
        let kappa = if geometry { kappa_of_light } else { 1.0 };

        // Reversed depth with an infinite far plane keeps f32's relative precision at every distance; astern the
        // photo-surface comes closer by 1/(2κ), and the near plane with it.
        let near = NEAR_M / kappa;
        let projection = DMat4::from_cols(
            DVec4::new(1.0 / half.x, 0.0, 0.0, 0.0),
            DVec4::new(0.0, 1.0 / half.y, 0.0, 0.0),
            DVec4::new(middle.x / half.x, middle.y / half.y, 0.0, -1.0),
            DVec4::new(0.0, 0.0, near, 0.0),
        );
        let shift = DVec3::new(-2.0 * offset.x / width, 2.0 * offset.y / height, 0.0);
        let clip_from_observer =
            DMat4::from_translation(shift) * projection * DMat4::from_quat(self.observer_from_eye.conjugate());

        // A pixel at `place` sees along forward + place.x right + place.y up.
        let right = self.observer_from_eye * DVec3::X * half.x;
        let up = self.observer_from_eye * DVec3::Y * half.y;
        let forward = self.observer_from_eye * middle.extend(-1.0) - shift.x * right - shift.y * up;
        let along = motion.vector().normalize_or(DVec3::NEG_Z);
        shaders::View {
            clip_from_observer: matrix(&clip_from_observer),
            forward: forward.as_vec3().extend(0.0),
            right: right.as_vec3().extend(0.0),
            up: up.as_vec3().extend(0.0),
            motion: along.as_vec3().extend(kappa as f32),
            shift: DVec4::new(kappa_of_light, scale, 2.0 / width, 2.0 / height).as_vec4(),
            layer: Vec4::ZERO,
            source: Vec4::new(0.0, 0.0, -1.0, 1.0),
            eye: Vec4::ZERO,
            eye_rest: Vec4::ZERO,
        }
    }

    /// Doppler factor of light from the world at a place in a picture of usual shape: −1 to 1 from left to right, and from below to above.
    pub fn doppler_at(&self, place: DVec2, motion: Celerity, geometry: bool) -> f64 {
        const USUAL: [u32; 2] = [16, 10];
        let tangents = self.tangents(USUAL);
        let seen = self.observer_from_eye * (tangents.middle() + place * tangents.half()).extend(-1.0);
        let aberration = Aberration::new(motion);
        let (_, doppler) =
            if geometry { aberration.world_from_observer(seen) } else { aberration.observer_from_world(seen) };
        doppler
    }
}

/// Rounds a matrix to what the GPU takes.
pub fn matrix(matrix: &DMat4) -> Mat4 {
    matrix.as_mat4()
}

/// Where sample `index` of `count` lies within its pixel: offsets from the centre in −½…½.
///
/// The additive recurrence on the plastic number (Roberts' R₂) fills the square evenly for every count; one
/// sample is the centre itself.
pub fn sample_offset(index: u32, count: u32) -> DVec2 {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    if count <= 1 {
        return DVec2::ZERO;
    }
    let step = DVec2::new(1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC));
    (DVec2::splat(0.5) + step * f64::from(index)).fract() - 0.5
}
