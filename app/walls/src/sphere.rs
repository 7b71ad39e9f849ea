//! Pictures of all directions: six flat pictures around the eye, joined into one in which height and width are angles.
//!
//! The middle of the picture is straight ahead; its width is the whole turn, its height from straight below to straight
//! above (equirectangular).

use glam::{DMat3, DQuat, DVec2, DVec3, Vec4};
use rayon::prelude::*;
use render::picture::Studio;
use render::target::Format;
use render::{Gpu, GpuError, SceneRenderer};
use std::f64::consts::PI;
use view::{Camera, Effects, Field, Gaze, Shot, Stored, Tangents};

/// Tangent of half a face's angle: a little more than 45°, so that faces overlap by more than a texel.
const HALF: f64 = 1.01;

/// Light of all directions.
pub struct SphereLight {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Texels as the renderers draw them, row by row.
    pub texels: Vec<[f32; 4]>,
    /// Scale in which they hold light.
    pub stored: Stored,
}

/// Face of the cube around the eye.
struct Face {
    eye_from_face: DMat3,
    side: u32,
    texels: Vec<[f32; 4]>,
}

impl SphereLight {
    /// Light that arrives at an eye from all directions, in a picture of twice `height` by `height` pixels.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn around(
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        gaze: &Gaze,
        effects: Effects,
        (height, samples): (u32, u32),
        format: Format,
    ) -> Result<Self, GpuError> {
        // A face has as many texels for its 90° as the picture at its equator.
        let side = (f64::from(height) / 2.0 * HALF * 4.0 / PI).ceil() as u32;
        let mut studio = Studio::with_format(gpu, [side; 2], samples, format);
        let scale = gaze.shot(90.0, effects).scale();
        let mut stored = Stored::UNSHIFTED;
        let mut faces = Vec::new();
        for eye_from_face in faces_of_cube() {
            let tangents = Tangents { low: DVec2::splat(-HALF), high: DVec2::splat(HALF) };
            let observer_from_eye = gaze.observer_from_eye * DQuat::from_mat3(&eye_from_face);
            let camera = Camera { observer_from_eye, field: Field::Screen(tangents) };
            let shot = Shot { camera, observer: gaze.observer, effects, stored_scale: Some(scale), outside: None };
            let pending = renderer.submit(gpu, &gaze.observer, effects)?;
            let (texels, of_face) = studio.texels(gpu, renderer, &shot, pending)?;
            stored = of_face;
            faces.push(Face { eye_from_face, side, texels });
        }
        let size = [2 * height, height];
        let texels = (0..size[0] as usize * size[1] as usize).into_par_iter().map(|index| {
            let place = DVec2::new((index % size[0] as usize) as f64, (index / size[0] as usize) as f64) + 0.5;
            let direction = direction(size, place);
            let ahead = |face: &Face| face.eye_from_face.z_axis.dot(-direction);
            let best = faces.iter().max_by(|a, b| ahead(a).total_cmp(&ahead(b))).expect("a cube has six faces");
            best.light(direction)
        });
        Ok(Self { size, texels: texels.collect(), stored })
    }
}

/// Direction of a place in a picture of all directions, the eye's axes. Places are pixels from the upper left corner.
pub fn direction(size: [u32; 2], place: DVec2) -> DVec3 {
    let share = place / DVec2::new(f64::from(size[0]), f64::from(size[1]));
    let (longitude, latitude) = ((2.0 * share.x - 1.0) * PI, (0.5 - share.y) * PI);
    let level = latitude.cos();
    DVec3::new(longitude.sin() * level, latitude.sin(), -longitude.cos() * level)
}

/// Rotations from the axes of each face (x right, y up, −z through its middle) to the eye's.
fn faces_of_cube() -> [DMat3; 6] {
    let quarter = 0.5 * PI;
    [0.0, quarter, 2.0 * quarter, 3.0 * quarter]
        .map(DMat3::from_rotation_y)
        .into_iter()
        .chain([quarter, -quarter].map(DMat3::from_rotation_x))
        .collect::<Vec<_>>()
        .try_into()
        .expect("a cube has six faces")
}

impl Face {
    /// Light from a direction of the eye's axes, mixed from the four nearest texels.
    fn light(&self, direction: DVec3) -> [f32; 4] {
        let of_face = self.eye_from_face.transpose() * direction;
        let tangent = DVec2::new(of_face.x, -of_face.y) / -of_face.z;
        let last = self.side - 1;
        let place = ((tangent / HALF + 1.0) * 0.5 * f64::from(self.side) - 0.5)
            .clamp(DVec2::ZERO, DVec2::splat(f64::from(last)));
        let (left, top) = (place.x as u32, place.y as u32);
        let (right, bottom) = ((left + 1).min(last), (top + 1).min(last));
        let at = |x: u32, y: u32| Vec4::from_array(self.texels[(y * self.side + x) as usize]);
        let (across, down) = (place.x.fract() as f32, place.y.fract() as f32);
        let above = at(left, top).lerp(at(right, top), across);
        let below = at(left, bottom).lerp(at(right, bottom), across);
        above.lerp(below, down).to_array()
    }
}

#[cfg(test)]
mod tests {
    //! Law: each texel of a picture of all directions shows the face's texel in its own direction, on all six faces
    //! and across their edges.

    use super::*;

    #[test]
    fn every_direction_is_found_on_its_face() {
        let side = 64;
        let size = [128, 64];
        let faces = faces_of_cube().map(|eye_from_face| {
            // A face whose texels are their own directions.
            let texel = |index: u32| {
                let place = DVec2::new(f64::from(index % side), f64::from(index / side)) + 0.5;
                let tangent = (place / f64::from(side) * 2.0 - 1.0) * HALF;
                let towards = (eye_from_face * DVec3::new(tangent.x, -tangent.y, -1.0)).normalize().as_vec3();
                [towards.x, towards.y, towards.z, 1.0]
            };
            Face { eye_from_face, side, texels: (0..side * side).map(texel).collect() }
        });
        let mut used = [0; 6];
        for index in 0..size[0] * size[1] {
            let place = DVec2::new(f64::from(index % size[0]), f64::from(index / size[0])) + 0.5;
            let towards = direction(size, place);
            let ahead = |face: &Face| face.eye_from_face.z_axis.dot(-towards);
            let best = (0..6).max_by(|a, b| ahead(&faces[*a]).total_cmp(&ahead(&faces[*b]))).unwrap();
            used[best] += 1;
            let [x, y, z, _] = faces[best].light(towards).map(f64::from);
            assert!(DVec3::new(x, y, z).distance(towards) < 2e-3, "{towards}");
        }
        assert!(used.iter().all(|number| *number > 500), "{used:?}");
        assert!((direction(size, DVec2::new(64.0, 32.0)) - DVec3::NEG_Z).length() < 1e-12);
        assert!((direction(size, DVec2::new(96.0, 32.0)) - DVec3::X).length() < 1e-12);
    }
}
