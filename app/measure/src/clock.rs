//! Times of the stages of a picture, and memory that its renderer holds on the device.

use std::time::Instant;

use render::target::Radiance;
use render::{Gpu, GpuError, Pending, SceneRenderer};
use view::{PixelSample, Shot};

/// Times of one picture's stages, milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stages {
    /// Photo-surface, cut, or plan of the map: the computation on the CPU.
    pub bend: f64,
    /// Transfer of the result to the device.
    pub upload: f64,
    /// Drawing, including the map's panes, until the device is done.
    pub draw: f64,
}

impl Stages {
    /// Sum of all stages, milliseconds.
    pub fn total(self) -> f64 {
        self.bend + self.upload + self.draw
    }
}

/// Draws a picture from nothing, like a still: each stage waits for the one before.
///
/// # Errors
/// A lost device.
pub fn still(
    gpu: &Gpu,
    renderer: &mut SceneRenderer,
    radiance: &Radiance,
    shot: &Shot,
    samples: u32,
) -> Result<Stages, GpuError> {
    let watch = Watch::start();
    let pending = renderer.submit(gpu, &shot.observer, shot.effects)?;
    picture(gpu, renderer, radiance, (shot, pending), samples, watch)
}

/// Draws a frame like one of a ride. The photo-surface that is drawn was begun a frame ago, and the `next` one is
/// computed meanwhile; a cut is the newest there is.
///
/// # Errors
/// A lost device.
pub fn frame(
    gpu: &Gpu,
    renderer: &mut SceneRenderer,
    radiance: &Radiance,
    (shown, pending): (&Shot, &mut Pending),
    next: &Shot,
) -> Result<Stages, GpuError> {
    let watch = Watch::start();
    let now = match std::mem::take(pending) {
        begun if begun.is_under_way() => begun,
        _ => renderer.submit(gpu, &shown.observer, shown.effects)?,
    };
    *pending = renderer.submit(gpu, &next.observer, next.effects)?;
    picture(gpu, renderer, radiance, (shown, now), 1, watch)
}

/// Takes the oldest photo-surface that is being computed, waits for it, and draws.
fn picture(
    gpu: &Gpu,
    renderer: &mut SceneRenderer,
    radiance: &Radiance,
    (shot, pending): (&Shot, Pending),
    samples: u32,
    mut watch: Watch,
) -> Result<Stages, GpuError> {
    let mut stages = Stages::default();
    let transforms = pending.is_under_way();
    renderer.show(gpu, pending)?;
    if transforms {
        stages.bend = watch.lap();
    }
    renderer.prepare(gpu, shot, radiance.size);
    let prepared = watch.lap();
    if let Some(map) = renderer.map_stats() {
        // The map's panes are already being drawn, so the wait for them belongs to drawing.
        (stages.bend, stages.upload) = (map.plan_ms, prepared - map.plan_ms);
    } else {
        *(if transforms { &mut stages.upload } else { &mut stages.bend }) += prepared;
        gpu.queue.submit([]);
        gpu.wait()?;
        stages.upload += watch.lap();
    }
    for sample in 0..samples {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        renderer.draw(gpu, &mut encoder, radiance, shot, PixelSample::of(sample, samples));
        gpu.queue.submit([encoder.finish()]);
    }
    gpu.wait()?;
    stages.draw = watch.lap();
    Ok(stages)
}

/// Stopwatch that returns the milliseconds since the last reading.
struct Watch(Instant);

impl Watch {
    fn start() -> Self {
        Self(Instant::now())
    }

    fn lap(&mut self) -> f64 {
        let now = Instant::now();
        (now - std::mem::replace(&mut self.0, now)).as_secs_f64() * 1e3
    }
}

/// Memory of all buffers and textures on the device, of all renderers together, bytes; `None` if the driver does not
/// tell.
///
/// # Errors
/// A lost device.
pub fn device_bytes(gpu: &Gpu) -> Result<Option<i64>, GpuError> {
    // Resources that are no longer used are freed once the device is done with them.
    gpu.queue.submit([]);
    gpu.wait()?;
    Ok(gpu.device.generate_allocator_report().map(|report| report.total_allocated_bytes as i64))
}
