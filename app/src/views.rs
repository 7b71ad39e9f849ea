//! Cameras: from the observer's directions to a flat picture.
//!
//! The camera looks along directions of the observer's own frame, whose axes are a pure boost of the world's. The
//! paths of light are not its concern: to the camera, the photo-surface is an ordinary three-dimensional object.

use glam::{DMat4, DQuat, DVec2, DVec3, DVec4, Mat4, Vec4};
use physics::photo_surface::Eye;
use physics::{Aberration, Celerity};

/// Distance in front of the eye, at rest, within which nothing is drawn, metres.
pub const NEAR_M: f64 = 0.02;

/// Place, motion and direction of view of an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaze {
    /// Place and celerity of the eye, world axes.
    pub eye: Eye,
    /// World time of the view, metres of light travel.
    pub ct: f64,
    /// Rotation from the eye's axes (x right, y up, −z ahead) to the observer's.
    pub observer_from_eye: DQuat,
}

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

    /// Data that the shaders need to draw one picture.
    ///
    /// # Arguments
    /// * `size` — width and height of the picture, pixels.
    /// * `offset` — offset of the sampled point from each pixel's centre, pixels, x right and y down.
    /// * `motion` — celerity of the eye.
    /// * `geometry` — true if aberration is drawn.
    /// * `scale` — factor that radiance is multiplied by, so that the target can hold it.
    pub fn view(&self, size: [u32; 2], offset: DVec2, motion: Celerity, geometry: bool, scale: f64) -> shaders::View {
        let [width, height] = size.map(f64::from);
        let tangents = self.tangents(size);
        let (middle, half) = (tangents.middle(), tangents.half());
        let kappa_of_light = motion.gamma() + motion.magnitude();
        let kappa = if geometry { kappa_of_light } else { 1.0 };

        // Reversed depth with an infinite far plane keeps f32's relative precision at every distance. Astern, the
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

    /// Doppler factor of light from the world at a place in a picture of the usual shape: −1 to 1 from left to right,
    /// and from bottom to top.
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

/// Matrix rounded to f32 for the GPU.
pub fn matrix(matrix: &DMat4) -> Mat4 {
    matrix.as_mat4()
}

/// Offset of sample `index` of `count` from the centre of its pixel, pixels, in −½…½.
///
/// The additive recurrence on the plastic number (Roberts' R₂) fills the square evenly for every count. A single
/// sample is at the centre.
pub fn sample_offset(index: u32, count: u32) -> DVec2 {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    if count <= 1 {
        return DVec2::ZERO;
    }
    let step = DVec2::new(1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC));
    (DVec2::splat(0.5) + step * f64::from(index)).fract() - 0.5
}
