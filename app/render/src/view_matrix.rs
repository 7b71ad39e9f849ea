//! Conversion of a camera for the shaders: projection, the directions of pixels, motion.

use glam::{DMat4, DVec3, DVec4, Mat4, Vec4};
use physics::{Celerity, Contraction};
use view::{Camera, PixelSample, Places};

/// Distance in front of the eye, at rest, within which nothing is drawn, metres. Reversed depth has the same relative
/// precision whatever it is, so it is small enough for molecules; what is 1e27 m away has a depth that f32 holds.
pub const NEAR_M: f64 = 1e-10;

/// View uniforms of one picture, for the shaders.
///
/// # Arguments
/// * `size` — pixels.
/// * `sample` — place within each pixel, and the part of the pixel that it stands for.
/// * `motion` — the eye's celerity.
/// * `places` — places at which things are drawn.
/// * `scale` — factor of radiance, so that the target can hold it.
pub fn shader_view(
    camera: &Camera,
    size: [u32; 2],
    sample: PixelSample,
    motion: Celerity,
    places: Places,
    scale: f64,
) -> shaders::ViewUniforms {
    let [width, height] = size.map(f64::from);
    let tangents = camera.tangents(size);
    let (middle, half) = (tangents.middle(), tangents.half());
    let kappa_of_light = motion.kappa();
    let kappa = if places == Places::Seen { kappa_of_light } else { 1.0 };
    // Reversed depth with an infinite far plane keeps f32's relative precision at every distance.
    let near = near_m(motion, places);
    let projection = DMat4::from_cols(
        DVec4::new(1.0 / half.x, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 1.0 / half.y, 0.0, 0.0),
        DVec4::new(middle.x / half.x, middle.y / half.y, 0.0, -1.0),
        DVec4::new(0.0, 0.0, near, 0.0),
    );
    let shift = DVec3::new(-2.0 * sample.offset.x / width, 2.0 * sample.offset.y / height, 0.0);
    let clip_from_observer =
        DMat4::from_translation(shift) * projection * DMat4::from_quat(camera.observer_from_eye.conjugate());

    // A pixel at `place` sees along forward + place.x right + place.y up. The line of the observer's present along it
    // leads to another direction of the world.
    let contraction = Contraction::new(if places == Places::Measured { motion } else { Celerity::ZERO });
    let shown = |direction: DVec3| contraction.world_from_observer(direction).as_vec3().extend(0.0);
    let right = camera.observer_from_eye * DVec3::X * half.x;
    let up = camera.observer_from_eye * DVec3::Y * half.y;
    let forward = camera.observer_from_eye * middle.extend(-1.0) - shift.x * right - shift.y * up;
    let along = motion.vector().normalize_or(DVec3::NEG_Z);
    shaders::ViewUniforms {
        clip_from_observer: matrix(&clip_from_observer),
        forward: shown(forward),
        right: shown(right),
        up: shown(up),
        motion: along.as_vec3().extend(kappa as f32),
        shift: DVec4::new(kappa_of_light, scale, 2.0 / width, 2.0 / height).as_vec4(),
        layer: Vec4::new(0.0, sample.width as f32, 0.0, 0.0),
        source: Vec4::new(0.0, 0.0, -1.0, 1.0),
        eye: Vec4::ZERO,
        eye_rest: Vec4::ZERO,
    }
}

/// Near plane of pictures for an eye with this celerity, metres: the reversed depth of what is z before the eye is this
/// over z.
pub fn near_m(motion: Celerity, places: Places) -> f64 {
    // Astern, the photo-surface comes closer by 1/(2κ), and the near plane with it; what is measured, by 1/γ.
    let closer = match places {
        Places::Seen => motion.kappa(),
        Places::Measured => motion.gamma(),
        Places::Instant => 1.0,
    };
    NEAR_M / closer
}

/// Matrix rounded to f32 for the GPU.
pub fn matrix(matrix: &DMat4) -> Mat4 {
    matrix.as_mat4()
}
