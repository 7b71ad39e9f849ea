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

/// A camera with square pixels and a flat picture (Kooima's special case of a screen straight ahead).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// From eye axes (x right, y up, −z ahead) to the observer's.
    pub observer_from_eye: DQuat,
    /// Full vertical angle, radians, in (0, π).
    pub fov_y_rad: f64,
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
        Self { observer_from_eye: DQuat::from_mat3(&axes), fov_y_rad }
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
        let tan_y = (0.5 * self.fov_y_rad).tan();
        let tan_x = tan_y * width / height;
        let kappa_of_light = motion.gamma() + motion.magnitude();
        let kappa = if geometry { kappa_of_light } else { 1.0 };

        // Reversed depth with an infinite far plane keeps f32's relative precision at every distance; astern the
        // photo-surface comes closer by 1/(2κ), and the near plane with it.
        let near = NEAR_M / kappa;
        let projection = DMat4::from_cols(
            DVec4::new(1.0 / tan_x, 0.0, 0.0, 0.0),
            DVec4::new(0.0, 1.0 / tan_y, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 0.0, -1.0),
            DVec4::new(0.0, 0.0, near, 0.0),
        );
        let shift = DVec3::new(-2.0 * offset.x / width, 2.0 * offset.y / height, 0.0);
        let clip_from_observer =
            DMat4::from_translation(shift) * projection * DMat4::from_quat(self.observer_from_eye.conjugate());

        // A pixel at `place` sees along forward + place.x right + place.y up.
        let right = self.observer_from_eye * DVec3::X * tan_x;
        let up = self.observer_from_eye * DVec3::Y * tan_y;
        let forward = self.observer_from_eye * DVec3::NEG_Z - shift.x * right - shift.y * up;
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

    /// Doppler factor of light from the world at a place in the picture: −1 to 1 from below to above, and to the right by the same measure.
    pub fn doppler_at(&self, place: DVec2, motion: Celerity, geometry: bool) -> f64 {
        let seen = self.observer_from_eye * (place * (0.5 * self.fov_y_rad).tan()).extend(-1.0);
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
