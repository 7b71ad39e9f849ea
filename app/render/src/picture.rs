//! Pictures without a window: several samples a pixel, exact to f32, read back as 8-bit sRGB or as linear light.

use crate::display::{self, Accumulator, Adaptation, Developer, Development, Seen};
use crate::gpu::{Gpu, GpuError};
use crate::pending::Pending;
use crate::scene_renderer::SceneRenderer;
use crate::subject::Subject;
use crate::target::{Format, Radiance};
use crate::textures::view_from_rows;
use glam::{DVec3, Vec3};
use half::f16;
use image::{Rgb32FImage, RgbaImage};
use view::{PixelSample, Shot, Stored};

/// Texture format in which a picture is stored.
pub const SCREEN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Texture format in which light is fetched.
const LIGHT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Place in the scene that a pixel's centre shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Place in metres relative to the scene's origin; for a moving body, in its own frame.
    pub position: DVec3,
    /// Index into the scene's motions; `None` for a resting surface.
    pub motion: Option<usize>,
    /// Exact apparent position of that place, relative to the observer in the observer's axes, metres. The place
    /// where it was drawn may differ.
    pub apparent: DVec3,
}

/// Develops radiance into pictures in memory.
pub struct Darkroom {
    developer: Developer,
    sheet: Sheet,
}

impl Darkroom {
    /// Darkroom for pictures of `size` pixels, from radiance of `format`.
    pub fn new(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        Self { developer: Developer::new(gpu, format, SCREEN_FORMAT), sheet: Sheet::new(gpu, size, SCREEN_FORMAT) }
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
        let pixels = self.sheet.fetch(gpu, encoder)?;
        Ok(RgbaImage::from_raw(self.sheet.texture.width(), self.sheet.texture.height(), pixels)
            .expect("the sheet has four bytes a pixel"))
    }
}

/// Texture whose contents can be fetched from the device.
pub struct Sheet {
    texture: wgpu::Texture,
    readback: wgpu::Buffer,
    row_bytes: u32,
    padded_row_bytes: u32,
}

impl Sheet {
    /// Empty sheet of `size` pixels.
    pub fn new(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let row_bytes = size[0] * format.block_copy_size(None).expect("a colour format has one aspect");
        let padded_row_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let readback = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: u64::from(padded_row_bytes) * u64::from(size[1]),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { texture, readback, row_bytes, padded_row_bytes }
    }

    /// Target that draws onto the sheet.
    pub fn view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// Bytes of the sheet, row by row, after the commands of `encoder` have drawn on it.
    ///
    /// # Errors
    /// [`GpuError`] if the device went away or the bytes cannot be read.
    pub fn fetch(&self, gpu: &Gpu, encoder: wgpu::CommandEncoder) -> Result<Vec<u8>, GpuError> {
        self.fetch_from(gpu, encoder, &self.texture, 0)
    }

    /// Bytes of a layer of a texture of the sheet's size and format that can be copied from, row by row, after the
    /// commands of `encoder`.
    ///
    /// # Errors
    /// [`GpuError`] if the device went away or the bytes cannot be read.
    pub fn fetch_from(
        &self,
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        layer: u32,
    ) -> Result<Vec<u8>, GpuError> {
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(self.padded_row_bytes), rows_per_image: None };
        let origin = wgpu::Origin3d { x: 0, y: 0, z: layer };
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo { origin, ..texture.as_image_copy() },
            wgpu::TexelCopyBufferInfo { buffer: &self.readback, layout },
            wgpu::Extent3d { depth_or_array_layers: 1, ..texture.size() },
        );
        gpu.queue.submit([encoder.finish()]);

        self.readback.map_async(wgpu::MapMode::Read, .., |_| {});
        gpu.wait()?;
        let mapped = self.readback.get_mapped_range(..).map_err(|error| GpuError::Lost(error.to_string()))?;
        let rows = mapped.chunks_exact(self.padded_row_bytes as usize);
        let bytes = rows.flat_map(|row| &row[..self.row_bytes as usize]).copied().collect();
        drop(mapped);
        self.readback.unmap();
        Ok(bytes)
    }
}

/// Targets of one size, used again for every picture.
pub struct Studio {
    size: [u32; 2],
    samples: u32,
    radiance: Radiance,
    sum: Accumulator,
    darkroom: Darkroom,
    adaptation: Adaptation,
}

impl Studio {
    /// Makes the targets. `samples` is the number of samples for each pixel; a single sample lies at the pixel's
    /// centre.
    pub fn new(gpu: &Gpu, size: [u32; 2], samples: u32) -> Self {
        Self::with_format(gpu, size, samples, Self::format(gpu))
    }

    /// Makes the targets for renderers that draw in the given format.
    pub fn with_format(gpu: &Gpu, size: [u32; 2], samples: u32, format: Format) -> Self {
        let darkroom = Darkroom::new(gpu, size, format.colour);
        Self {
            size,
            samples,
            radiance: Radiance::new(gpu, size, format),
            sum: darkroom.developer.accumulator(gpu, size),
            darkroom,
            adaptation: Adaptation::new(gpu),
        }
    }

    /// Target format of the renderers whose pictures are taken here.
    pub fn format(gpu: &Gpu) -> Format {
        Format::exact(gpu)
    }

    /// Takes a picture.
    ///
    /// # Arguments
    /// * `pending` — what [`SceneRenderer::submit`] gave for the shot's observer.
    /// * `elapsed_s` — the observer's proper time since the picture before, seconds, for the adaptation of the eye;
    ///   `None` adapts it at once.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn photograph(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
        development: &Development,
        elapsed_s: Option<f64>,
    ) -> Result<RgbaImage, GpuError> {
        let stored = self.draw(gpu, renderer, shot, pending)?;
        let radiance = if self.samples > 1 { self.sum.result() } else { self.radiance.result() };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let seen = Seen { radiance, stored, elapsed_s };
        self.darkroom.developer.adapt(gpu, &mut encoder, &mut self.adaptation, &seen, development);
        gpu.queue.submit([encoder.finish()]);
        self.darkroom.develop(gpu, radiance, &self.adaptation, development)
    }

    /// Takes a picture as light: linear sRGB in cd/m², before exposure, tone curve and gamut. Values beyond the range
    /// of f32 become its largest value.
    ///
    /// # Errors
    /// Those of [`Studio::photograph`].
    pub fn expose(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
    ) -> Result<Rgb32FImage, GpuError> {
        let stored = self.draw(gpu, renderer, shot, pending)?;
        let radiance = if self.samples > 1 { self.sum.result() } else { self.radiance.result() };
        light(gpu, radiance, &stored)
    }

    /// Draws a picture, and fetches its light as the renderers draw it: texels row by row, and their scale.
    ///
    /// # Errors
    /// Those of [`Studio::photograph`].
    pub fn texels(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
    ) -> Result<(Vec<[f32; 4]>, Stored), GpuError> {
        let stored = self.draw(gpu, renderer, shot, pending)?;
        let radiance = if self.samples > 1 { self.sum.result() } else { self.radiance.result() };
        Ok((texels(gpu, radiance)?, stored))
    }

    /// Develops light that was computed elsewhere: texels as the renderers draw them, row by row, for a picture of
    /// this studio's size.
    ///
    /// # Errors
    /// Those of [`Studio::photograph`].
    pub fn develop(
        &mut self,
        gpu: &Gpu,
        texels: &[[f32; 4]],
        stored: Stored,
        development: &Development,
        elapsed_s: Option<f64>,
    ) -> Result<RgbaImage, GpuError> {
        let radiance = upload(gpu, self.size, texels, self.radiance.format.colour);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let seen = Seen { radiance: &radiance, stored, elapsed_s };
        self.darkroom.developer.adapt(gpu, &mut encoder, &mut self.adaptation, &seen, development);
        gpu.queue.submit([encoder.finish()]);
        self.darkroom.develop(gpu, &radiance, &self.adaptation, development)
    }

    /// Place in the scene that each pixel's centre shows, row by row; `None` for a pixel that shows no surface. The
    /// places are exact only if the device draws 32-bit floats.
    ///
    /// # Errors
    /// Those of [`Studio::photograph`].
    pub fn places(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
    ) -> Result<Vec<Option<Shown>>, GpuError> {
        renderer.subject = Subject::Places;
        let drawn = self.draw_samples(gpu, renderer, shot, pending, 1);
        renderer.subject = Subject::Light;
        drawn?;
        let sights = renderer.sights(shot);
        let shown = |[x, y, z, whose]: [f32; 4]| {
            let position = Vec3::new(x, y, z).as_dvec3();
            let index = (whose.round() as usize).checked_sub(1)?;
            Some(Shown { position, motion: index.checked_sub(1), apparent: sights.get(index)?.apparent(position) })
        };
        Ok(texels(gpu, self.radiance.result())?.into_iter().map(shown).collect())
    }

    /// Draws all samples, and adds them up.
    fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
    ) -> Result<Stored, GpuError> {
        self.draw_samples(gpu, renderer, shot, pending, self.samples)
    }

    fn draw_samples(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
        samples: u32,
    ) -> Result<Stored, GpuError> {
        renderer.show(gpu, pending)?;
        renderer.prepare(gpu, shot, self.size);
        self.sum.restart();
        for sample in 0..samples {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            renderer.draw(gpu, &mut encoder, &self.radiance, shot, PixelSample::of(sample, samples));
            if samples > 1 {
                self.darkroom.developer.add(gpu, &mut encoder, &mut self.sum, self.radiance.result(), samples);
            }
            gpu.queue.submit([encoder.finish()]);
        }
        Ok(renderer.stored(shot))
    }
}

/// Uploads texels into a texture of one of the formats that renderers draw in.
fn upload(gpu: &Gpu, size: [u32; 2], texels: &[[f32; 4]], format: wgpu::TextureFormat) -> wgpu::TextureView {
    let half = |value: f32| f16::from_f32(value.clamp(-shaders::HALF_LIMIT, shaders::HALF_LIMIT));
    let halves: Vec<[f16; 4]>;
    let bytes: &[u8] = if format == wgpu::TextureFormat::Rgba32Float {
        bytemuck::cast_slice(texels)
    } else {
        halves = texels.iter().map(|texel| texel.map(half)).collect();
        bytemuck::cast_slice(&halves)
    };
    view_from_rows(gpu, "radiance", [size[0], size[1], 1], format, bytes)
}

/// Fetches radiance from the device: linear sRGB in cd/m².
///
/// # Errors
/// [`GpuError::Lost`] if the device went away.
pub fn light(gpu: &Gpu, radiance: &wgpu::TextureView, stored: &Stored) -> Result<Rgb32FImage, GpuError> {
    let size = radiance.texture().size();

    let candela = stored.white / stored.scale;
    let largest = f64::from(f32::MAX);
    let values = texels(gpu, radiance)?
        .into_iter()
        .flat_map(|[red, green, blue, _]| [red, green, blue])
        .map(|value| (f64::from(value) * candela).clamp(-largest, largest) as f32)
        .collect();
    Ok(Rgb32FImage::from_raw(size.width, size.height, values).expect("the sheet has three colours a pixel"))
}

/// Fetches a texture as 32-bit floats, without any conversion of the values.
fn texels(gpu: &Gpu, texture: &wgpu::TextureView) -> Result<Vec<[f32; 4]>, GpuError> {
    let size = texture.texture().size();
    let sheet = Sheet::new(gpu, [size.width, size.height], LIGHT_FORMAT);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    display::copy(gpu, &mut encoder, texture, &sheet.view(), LIGHT_FORMAT);
    Ok(bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&sheet.fetch(gpu, encoder)?))
}

/// Largest side of a picture that the device can draw, pixels.
pub fn largest_side(gpu: &Gpu) -> u32 {
    gpu.device.limits().max_texture_dimension_2d
}
