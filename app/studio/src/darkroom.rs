//! Development of light into pictures in memory.

use crate::sheet::{Fetching, SCREEN_FORMAT, Sheet};
use half::f16;
use image::{Rgb32FImage, RgbaImage};
use render::display::{Accumulator, Adaptation, Developer, Development, LINEAR_FORMAT, Seen};
use render::{Gpu, GpuError};

/// Develops light into pictures in memory, for an eye that adapts from one to the next.
pub struct Darkroom {
    developer: Developer,
    sheet: Sheet,
    adaptation: Adaptation,
}

/// Pictures on their way from the device.
#[must_use = "what is not waited for was developed in vain"]
pub struct Developing {
    size: [u32; 2],
    fetching: Vec<Fetching>,
}

impl Darkroom {
    /// Darkroom for pictures of `size` pixels, from radiance of `format`.
    pub fn new(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let developer = Developer::new(gpu, format, SCREEN_FORMAT);
        Self { developer, sheet: Sheet::new(gpu, size, SCREEN_FORMAT), adaptation: Adaptation::new(gpu) }
    }

    /// Darkroom that exposes light and does nothing else to it, for screens of a high dynamic range.
    pub fn exposing(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let developer = Developer::exposing(gpu, format);
        Self { developer, sheet: Sheet::new(gpu, size, LINEAR_FORMAT), adaptation: Adaptation::new(gpu) }
    }

    /// Sums of samples of the pictures' size.
    pub(crate) fn accumulator(&self, gpu: &Gpu) -> Accumulator {
        self.developer.accumulator(gpu, self.sheet.size())
    }

    /// Adds one of `count` samples.
    pub(crate) fn add(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        sum: &mut Accumulator,
        sample: &wgpu::TextureView,
        count: u32,
    ) {
        self.developer.add(gpu, encoder, sum, sample, count);
    }

    /// Adapts the eye to pictures that it sees together, develops each, encodes it as 8-bit sRGB and begins to fetch
    /// it.
    pub fn begin(&mut self, gpu: &Gpu, seen: &[Seen<'_>], development: &Development) -> Developing {
        let Self { developer, sheet, adaptation } = self;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        developer.adapt_to_all(gpu, &mut encoder, adaptation, seen, development);
        gpu.queue.submit([encoder.finish()]);
        let mut fetching = Vec::new();
        for Seen { radiance, .. } in seen {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            developer.show(gpu, &mut encoder, radiance, adaptation, development, &sheet.view());
            fetching.push(sheet.begin(gpu, encoder));
        }
        Developing { size: sheet.size(), fetching }
    }

    /// Develops `radiance` for an eye in the state `adaptation`, encodes it as 8-bit sRGB and fetches it.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn develop(
        &mut self,
        gpu: &Gpu,
        radiance: &wgpu::TextureView,
        adaptation: &Adaptation,
        development: &Development,
    ) -> Result<RgbaImage, GpuError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.developer.show(gpu, &mut encoder, radiance, adaptation, development, &self.sheet.view());
        Ok(picture(self.sheet.size(), self.sheet.fetch(gpu, encoder)?))
    }
}

impl Developing {
    /// Waits for the pictures.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn finish(self, gpu: &Gpu) -> Result<Vec<RgbaImage>, GpuError> {
        self.fetching.into_iter().map(|fetching| Ok(picture(self.size, fetching.finish(gpu)?))).collect()
    }

    /// Waits for light that was [exposed](Darkroom::exposing) alone: linear sRGB, white is 1.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn finish_exposed(self, gpu: &Gpu) -> Result<Vec<Rgb32FImage>, GpuError> {
        let light = |fetching: Fetching| {
            let bytes = fetching.finish(gpu)?;
            let halves = bytes
                .chunks_exact(8)
                .flat_map(|texel| [0, 2, 4].map(|at| f16::from_le_bytes([texel[at], texel[at + 1]]).to_f32()));
            let picture = Rgb32FImage::from_raw(self.size[0], self.size[1], halves.collect());
            Ok(picture.expect("the sheet has four halves a pixel"))
        };
        self.fetching.into_iter().map(light).collect()
    }

    /// Waits for the picture of a single eye.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn finish_one(self, gpu: &Gpu) -> Result<RgbaImage, GpuError> {
        let mut pictures = self.finish(gpu)?;
        Ok(pictures.pop().expect("an eye has a picture"))
    }
}

fn picture(size: [u32; 2], pixels: Vec<u8>) -> RgbaImage {
    RgbaImage::from_raw(size[0], size[1], pixels).expect("the sheet has four bytes a pixel")
}
