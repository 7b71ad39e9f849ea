//! Light of a channel that is drawn with fewer pixels than the channel has, enlarged to all of them.
//!
//! Light is enlarged before anything is made of it, so that exposure, tone, gains and the combination of both eyes take
//! it as they take light that was drawn to the full.

use bytemuck::bytes_of;
use glam::Vec4;
use render::Gpu;
use render::display::{FILTERED, Pass, UNIFORM, contents};

/// Pass that enlarges light, its texels mixed linearly.
pub struct LightEnlarger {
    pass: Pass,
    sampler: wgpu::Sampler,
}

impl LightEnlarger {
    /// Enlarger of light in this format; `None` if its texels cannot be mixed.
    pub fn new(gpu: &Gpu, colour: wgpu::TextureFormat) -> Option<Self> {
        let filterable = wgpu::TextureSampleType::Float { filterable: true };
        if colour.sample_type(None, Some(gpu.device.features())) != Some(filterable) {
            return None;
        }
        let bindings = [FILTERED, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering), UNIFORM];
        Some(Self {
            pass: Pass::new(gpu, &shaders::ENLARGE, &[], &bindings, colour),
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("enlarge light"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
        })
    }

    /// Fills `whole` with the light of `small`.
    pub fn enlarge(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        small: &wgpu::TextureView,
        whole: &wgpu::TextureView,
    ) {
        let (width, height) = (whole.texture().width() as f32, whole.texture().height() as f32);
        let uniform = Vec4::new(width.recip(), height.recip(), 0.0, 0.0);
        let uniform = contents(gpu, "enlarge light", bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let resources = [
            wgpu::BindingResource::TextureView(small),
            wgpu::BindingResource::Sampler(&self.sampler),
            uniform.as_entire_binding(),
        ];
        self.pass.draw(gpu, encoder, whole, &resources);
    }
}
