//! Pictures without a window: several samples a pixel, exact to f32, read back as 8-bit sRGB.

use super::resolve::{Accumulator, Resolver};
use super::target::{Format, Radiance};
use super::{SceneRenderer, Shot};
use crate::gpu::{Gpu, GpuError};
use crate::views::sample_offset;
use image::RgbaImage;

/// What a picture is stored as.
const SCREEN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Turns radiance into pictures in memory.
pub struct Darkroom {
    resolver: Resolver,
    screen: wgpu::Texture,
    readback: wgpu::Buffer,
    row_bytes: u32,
}

impl Darkroom {
    /// For pictures of `size` pixels, from radiance of `format`.
    pub fn new(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let screen = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: SCREEN_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let row_bytes = (size[0] * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let readback = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: u64::from(row_bytes) * u64::from(size[1]),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { resolver: Resolver::new(gpu, format, SCREEN_FORMAT), screen, readback, row_bytes }
    }

    /// Encodes `radiance` as 8-bit sRGB and fetches it.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn develop(&self, gpu: &Gpu, radiance: &wgpu::TextureView) -> Result<RgbaImage, GpuError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let screen = self.screen.create_view(&wgpu::TextureViewDescriptor::default());
        self.resolver.show(gpu, &mut encoder, radiance, &screen);
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(self.row_bytes), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            self.screen.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &self.readback, layout },
            self.screen.size(),
        );
        gpu.queue.submit([encoder.finish()]);

        self.readback.map_async(wgpu::MapMode::Read, .., |_| {});
        gpu.wait()?;
        let mapped = self.readback.get_mapped_range(..).map_err(|error| GpuError::Lost(error.to_string()))?;
        let mut picture = RgbaImage::new(self.screen.width(), self.screen.height());
        let row_length = self.screen.width() as usize * 4;
        for (row, source) in picture.chunks_exact_mut(row_length).zip(mapped.chunks_exact(self.row_bytes as usize)) {
            row.copy_from_slice(&source[..row_length]);
        }
        drop(mapped);
        self.readback.unmap();
        Ok(picture)
    }
}

/// Targets of one size, used again for every picture.
pub struct Studio {
    size: [u32; 2],
    samples: u32,
    radiance: Radiance,
    sum: Accumulator,
    darkroom: Darkroom,
}

impl Studio {
    /// Makes the targets. `samples` per pixel; one sample is each pixel's centre.
    pub fn new(gpu: &Gpu, size: [u32; 2], samples: u32) -> Self {
        let format = Self::format(gpu);
        let darkroom = Darkroom::new(gpu, size, format.colour);
        Self {
            size,
            samples,
            radiance: Radiance::new(gpu, size, format),
            sum: darkroom.resolver.accumulator(gpu, size),
            darkroom,
        }
    }

    /// The format that renderers must draw in to be photographed here.
    pub fn format(gpu: &Gpu) -> Format {
        Format::exact(gpu)
    }

    /// Takes a picture. Where `renderer` needs a photo-surface, it must have been submitted before; it is received here.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn photograph(&mut self, gpu: &Gpu, renderer: &mut SceneRenderer, shot: &Shot) -> Result<RgbaImage, GpuError> {
        if renderer.transforms(shot.effects) {
            let transformed = renderer.receive()?;
            renderer.show(gpu, transformed);
        }
        renderer.prepare(gpu, shot, self.size);

        // Draw each sample, and add it up.
        self.sum.restart();
        for sample in 0..self.samples {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            renderer.draw(gpu, &mut encoder, &self.radiance, shot, sample_offset(sample, self.samples));
            if self.samples > 1 {
                self.darkroom.resolver.add(gpu, &mut encoder, &mut self.sum, &self.radiance, self.samples);
            }
            gpu.queue.submit([encoder.finish()]);
        }
        let result = if self.samples > 1 { self.sum.result() } else { self.radiance.result() };
        self.darkroom.develop(gpu, result)
    }
}

/// Size of the largest picture that the device can draw, pixels along each side.
pub fn largest_side(gpu: &Gpu) -> u32 {
    gpu.device.limits().max_texture_dimension_2d
}
