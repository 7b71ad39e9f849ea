//! Adaptation of the eye: the state of an eye, and the passes that adapt it to what it sees.
//!
//! The state stays on the device. A compute pass counts a grid of pixels into histograms, a second one computes the
//! exposure and the curve from them, and the display reads both in the same frame. Nothing is read back, so no frame
//! waits for another. Sums are of integers, hence the same in every run.
//!
//! The metered quantity is the *gain*: the luminance as seen, over the luminance of the same surface without any
//! shift. A dark scene thus stays dark and a bright one bright; only the brightness added by Doppler shift and
//! searchlight effect is taken back. If they add nothing, nothing is metered, and exposure is exactly 1.

use view::Stored;

use super::development::{Development, Exposure, Tone};
use super::passes::{UNFILTERED, UNIFORM, WRITE, contents, group, layout, module, pipeline_layout};
use crate::gpu::Gpu;
use bytemuck::bytes_of;

/// Time constant of the adaptation, seconds of proper time: in this time the eye adapts by 1 − 1/e of the way.
pub const TIME_CONSTANT_S: f64 = 0.5;

/// A picture that an eye sees.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// Radiance, one sample a pixel.
    pub radiance: &'a wgpu::TextureView,
    /// Scale of that radiance.
    pub stored: Stored,
    /// Proper time of the observer since the last frame, seconds. `None`, as for a still, adapts at once.
    pub elapsed_s: Option<f64>,
}

/// The state of an eye, on the device.
pub struct Adaptation {
    pub(super) state: wgpu::Buffer,
    pub(super) curve: wgpu::Buffer,
    bins: wgpu::Buffer,
    metered: Metered,
}

/// Histograms that were taken of the last frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Metered {
    gains: bool,
    luminances: bool,
}

impl Adaptation {
    /// State of an eye that has seen nothing yet. It adapts at once to the first picture.
    pub fn new(gpu: &Gpu) -> Self {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = |label, bytes: usize| {
            let size = bytes as u64;
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let bins = shaders::METER_BINS as usize;
        Self {
            state: buffer("adaptation", size_of::<shaders::AdaptationState>()),
            curve: buffer("curve", (bins + 1) * size_of::<f32>()),
            bins: buffer("bins", 2 * bins * size_of::<[u32; 2]>()),
            metered: Metered::default(),
        }
    }
}

/// The passes that adapt an eye.
pub struct Meter {
    layout: wgpu::BindGroupLayout,
    survey: wgpu::ComputePipeline,
    expose: wgpu::ComputePipeline,
    equalise: wgpu::ComputePipeline,
}

impl Meter {
    /// Compiles the passes.
    pub fn new(gpu: &Gpu) -> Self {
        let bindings = [UNFILTERED, UNIFORM, WRITE, WRITE, WRITE];
        let layout = layout(gpu, shaders::METER.name, wgpu::ShaderStages::COMPUTE, &bindings);
        let module = module(gpu, &shaders::METER);
        let pipeline_layout = pipeline_layout(gpu, &layout);
        let pipeline = |entry_point| {
            gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: Default::default(),
                cache: None,
            })
        };
        Self { survey: pipeline("survey"), expose: pipeline("expose"), equalise: pipeline("equalise"), layout }
    }

    /// Adapts an eye to several pictures seen at once. The exposure is meant for the scale of the first one.
    pub fn adapt(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        adaptation: &mut Adaptation,
        pictures: &[Seen<'_>],
        development: &Development,
    ) {
        let [seen, ..] = pictures else { return };
        let stored = &seen.stored;
        let before = adaptation.metered;
        let now = Metered { gains: stored.shifted, luminances: development.tone == Tone::Histogram };
        adaptation.metered = now;

        // This exposure is known without metering.
        let stops = development.exposure.stops();
        let exposure = factor(f64::from(stops).exp2() / stored.scale);
        if !now.gains {
            let state = shaders::AdaptationState {
                exposure,
                white: stops.exp2().max(1.0),
                log2_exposure: stops,
                gain: 0.0,
                bright: 0.0,
            };
            let known = contents(gpu, "adaptation", bytes_of(&state), wgpu::BufferUsages::COPY_SRC);
            encoder.copy_buffer_to_buffer(&known, 0, &adaptation.state, 0, None);
        }
        if now == Metered::default() {
            return;
        }

        // If the light is shifted only since this frame, the eye has no earlier state to adapt from.
        let fresh = (now.gains && !before.gains) || (now.luminances && !before.luminances);
        let side = (pictures.len() as f64).sqrt();
        let [columns, rows] = shaders::METER_GRID.map(|pixels| ((f64::from(pixels) / side) as u32).max(1));
        let groups = pictures.iter().map(|picture| {
            let metering = shaders::MeteringUniforms {
                exposure,
                log2_exposure: stops,
                log2_scale: picture.stored.scale.log2() as f32,
                share: seen.elapsed_s.filter(|_| !fresh).map_or(1.0, share),
                automatic: u32::from(matches!(development.exposure, Exposure::Auto(_))),
                gains: u32::from(now.gains),
                luminances: u32::from(now.luminances),
                columns,
                rows,
            };
            let metering = contents(gpu, "metering", bytes_of(&metering), wgpu::BufferUsages::UNIFORM);
            let resources = [
                wgpu::BindingResource::TextureView(picture.radiance),
                metering.as_entire_binding(),
                adaptation.bins.as_entire_binding(),
                adaptation.state.as_entire_binding(),
                adaptation.curve.as_entire_binding(),
            ];
            group(gpu, shaders::METER.name, &self.layout, &resources)
        });
        let groups: Vec<_> = groups.collect();

        // First count, then compute. The curve depends on the exposure.
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.survey);
        let [across, down] = [columns, rows].map(|side| side.div_ceil(shaders::METER_WORKGROUP));
        for group in &groups {
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(across, down, 1);
        }
        pass.set_bind_group(0, &groups[0], &[]);
        for (pipeline, wanted) in [(&self.expose, now.gains), (&self.equalise, now.luminances)] {
            if wanted {
                pass.set_pipeline(pipeline);
                pass.dispatch_workgroups(1, 1, 1);
            }
        }
    }
}

/// A factor limited so that f32 holds both it and its inverse.
fn factor(factor: f64) -> f32 {
    let largest = f64::from(shaders::LARGEST_LOG2).exp2();
    factor.clamp(1.0 / largest, largest) as f32
}

/// Share of the way that the eye adapts in a time: 1 − e^(−t/τ).
fn share(elapsed_s: f64) -> f32 {
    -(-elapsed_s.max(0.0) / TIME_CONSTANT_S).exp_m1() as f32
}
