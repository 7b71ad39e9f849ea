//! Pictures taken from light of all directions.

use crate::projected_view::ProjectedView;
use glam::{DMat3, DQuat, DVec2, DVec3};
use render::display::{Pass, from_sphere};
use render::{Gpu, view_from_rows};
use view::{Gaze, Projection};

/// Pass that takes the picture of a projection from a sphere that stands upright.
pub struct SphereTaker {
    directions: wgpu::TextureView,
    pass: Pass,
    /// Rotation from the axes of the sphere to those of the picture's middle.
    eye_from_sphere: DQuat,
}

impl SphereTaker {
    /// Pass for pictures of `size` pixels. `upright`: axis of the sphere, axes of the picture's middle.
    pub fn new(gpu: &Gpu, projection: Projection, size: [u32; 2], upright: DVec3, format: wgpu::TextureFormat) -> Self {
        // The sphere's middle is where the picture's lies, as far as its axis lets it.
        let back = [DVec3::Z, DVec3::Y].map(|back| back.reject_from_normalized(upright));
        let back = if back[0].length() > 0.1 { back[0] } else { back[1] }.normalize();
        let eye_from_sphere = DMat3::from_cols(upright.cross(back), upright, back);
        let texel = |index: u64| {
            let at = DVec2::new((index % u64::from(size[0])) as f64, (index / u64::from(size[0])) as f64);
            let direction = projection.direction(size, at + 0.5);
            let of_sphere = direction.map(|direction| eye_from_sphere.transpose() * direction);
            of_sphere.map_or([0.0; 4], |direction| direction.as_vec3().extend(1.0).to_array())
        };
        let texels: Vec<[f32; 4]> = (0..u64::from(size[0]) * u64::from(size[1])).map(texel).collect();
        let (kind, bytes) = (wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&texels));
        Self {
            directions: view_from_rows(gpu, "directions", [size[0], size[1], 1], kind, bytes),
            pass: from_sphere(gpu, format),
            eye_from_sphere: DQuat::from_mat3(&eye_from_sphere),
        }
    }

    /// View of the sphere for that of a picture.
    pub fn view(&self, view: &ProjectedView) -> ProjectedView {
        let observer_from_eye = view.gaze.observer_from_eye * self.eye_from_sphere;
        ProjectedView { gaze: Gaze { observer_from_eye, ..view.gaze }, ..*view }
    }

    /// Takes the picture `light` from the light of a sphere.
    pub fn take(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        sphere: &wgpu::TextureView,
        light: &wgpu::TextureView,
    ) {
        let resources =
            [wgpu::BindingResource::TextureView(&self.directions), wgpu::BindingResource::TextureView(sphere)];
        self.pass.draw(gpu, encoder, light, &resources);
    }
}
