//! Pictures that are drawn smaller than their window, enlarged to it.

use super::passes::{FILTERED, Pass, UNIFORM, contents};
use crate::gpu::Gpu;
use crate::target::texture;
use bytemuck::bytes_of;
use glam::Vec4;

/// Pass that enlarges developed pictures, and the picture that it enlarges.
pub struct Enlarger {
    pass: Pass,
    sampler: wgpu::Sampler,
    format: wgpu::TextureFormat,
    picture: Option<wgpu::TextureView>,
}

impl Enlarger {
    /// Enlarger for screens of this format.
    pub fn new(gpu: &Gpu, screen: wgpu::TextureFormat) -> Self {
        let bindings = [FILTERED, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), UNIFORM];
        Self {
            pass: Pass::new(gpu, &shaders::ENLARGE, &[], &bindings, screen),
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("enlarge"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
            format: screen,
            picture: None,
        }
    }

    /// Target of `size` pixels into which the small picture is developed.
    pub fn target(&mut self, gpu: &Gpu, size: [u32; 2]) -> wgpu::TextureView {
        let fits = |view: &wgpu::TextureView| {
            let texture = view.texture();
            [texture.width(), texture.height()] == size
        };
        let kept = self.picture.take().filter(fits);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let picture = kept.unwrap_or_else(|| texture(gpu, "small picture", size, self.format, 1, usage));
        self.picture = Some(picture.clone());
        picture
    }

    /// Fills the screen with the picture that was developed into [`Enlarger::target`], texels mixed linearly.
    pub fn enlarge(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, screen: &wgpu::TextureView) {
        let Some(picture) = &self.picture else { return };
        let (width, height) = (screen.texture().width() as f32, screen.texture().height() as f32);
        let uniform = Vec4::new(width.recip(), height.recip(), 0.0, 0.0);
        let uniform = contents(gpu, "enlarge", bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let resources = [
            wgpu::BindingResource::TextureView(picture),
            wgpu::BindingResource::Sampler(&self.sampler),
            uniform.as_entire_binding(),
        ];
        self.pass.draw(gpu, encoder, screen, &resources);
    }
}
