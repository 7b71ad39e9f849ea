//! Textures whose contents are fetched from the device, at once or while it draws on.

use render::{Gpu, GpuError};
use std::sync::{Arc, Mutex, PoisonError};

/// Texture format in which a picture is stored.
pub const SCREEN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Texture whose contents can be fetched from the device.
pub struct Sheet {
    texture: wgpu::Texture,
    row_bytes: u32,
    padded_row_bytes: u32,
    /// Buffers that are not under way.
    free: Arc<Mutex<Vec<wgpu::Buffer>>>,
}

/// Contents of a sheet on their way from the device.
#[must_use = "what is not waited for was fetched in vain"]
pub struct Fetching {
    readback: wgpu::Buffer,
    row_bytes: u32,
    padded_row_bytes: u32,
    submission: wgpu::SubmissionIndex,
    free: Arc<Mutex<Vec<wgpu::Buffer>>>,
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
        Self { texture, row_bytes, padded_row_bytes, free: Arc::default() }
    }

    /// Width and height, pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.texture.width(), self.texture.height()]
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
        self.begin(gpu, encoder).finish(gpu)
    }

    /// Bytes of a layer of a texture of the sheet's size and format that can be copied from, row by row, after the
    /// commands of `encoder`.
    ///
    /// # Errors
    /// [`GpuError`] if the device went away or the bytes cannot be read.
    pub fn fetch_from(
        &self,
        gpu: &Gpu,
        encoder: wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        layer: u32,
    ) -> Result<Vec<u8>, GpuError> {
        self.begin_from(gpu, encoder, texture, layer).finish(gpu)
    }

    /// Begins to fetch the sheet after the commands of `encoder` have drawn on it. It may be drawn on again at once.
    pub fn begin(&self, gpu: &Gpu, encoder: wgpu::CommandEncoder) -> Fetching {
        self.begin_from(gpu, encoder, &self.texture, 0)
    }

    fn begin_from(
        &self,
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        layer: u32,
    ) -> Fetching {
        let kept = self.free.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let readback = kept.unwrap_or_else(|| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("picture"),
                size: u64::from(self.padded_row_bytes) * u64::from(self.texture.height()),
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            })
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(self.padded_row_bytes), rows_per_image: None };
        let origin = wgpu::Origin3d { x: 0, y: 0, z: layer };
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo { origin, ..texture.as_image_copy() },
            wgpu::TexelCopyBufferInfo { buffer: &readback, layout },
            wgpu::Extent3d { depth_or_array_layers: 1, ..texture.size() },
        );
        let submission = gpu.queue.submit([encoder.finish()]);
        readback.map_async(wgpu::MapMode::Read, .., |_| {});
        let Self { row_bytes, padded_row_bytes, free, .. } = self;
        let free = Arc::clone(free);
        Fetching { readback, row_bytes: *row_bytes, padded_row_bytes: *padded_row_bytes, submission, free }
    }
}

impl Fetching {
    /// Waits for the bytes, row by row.
    ///
    /// # Errors
    /// [`GpuError`] if the device went away or the bytes cannot be read.
    pub fn finish(self, gpu: &Gpu) -> Result<Vec<u8>, GpuError> {
        gpu.wait_for(self.submission)?;
        let mapped = self.readback.get_mapped_range(..).map_err(|error| GpuError::Lost(error.to_string()))?;
        let mut bytes = Vec::with_capacity(mapped.len() / self.padded_row_bytes as usize * self.row_bytes as usize);
        for row in mapped.chunks_exact(self.padded_row_bytes as usize) {
            bytes.extend_from_slice(&row[..self.row_bytes as usize]);
        }
        drop(mapped);
        self.readback.unmap();
        self.free.lock().unwrap_or_else(PoisonError::into_inner).push(self.readback);
        Ok(bytes)
    }
}
