//! Filling of a large buffer on the device, piece by piece, so that its contents are never in memory twice.

use crate::gpu::Gpu;
use bytemuck::NoUninit;
use wgpu::util::DeviceExt;

/// Size of a piece, bytes.
const PIECE: usize = 4 << 20;

/// Bytes that may be under way to the device before it is waited for.
const UNDER_WAY: u64 = 32 << 20;

/// A buffer that is being filled from its beginning.
pub struct BufferFill<'gpu> {
    gpu: &'gpu Gpu,
    buffer: wgpu::Buffer,
    piece: Vec<u8>,
    /// Bytes that were written.
    written: u64,
    /// Bytes that were written since the device was waited for.
    under_way: u64,
}

impl<'gpu> BufferFill<'gpu> {
    /// Makes a buffer of `size` bytes.
    pub fn new(gpu: &'gpu Gpu, label: &str, size: usize, usage: wgpu::BufferUsages) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: size as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { gpu, buffer, piece: Vec::with_capacity(size.min(PIECE)), written: 0, under_way: 0 }
    }

    /// Appends values.
    pub fn extend<T: NoUninit>(&mut self, values: impl Iterator<Item = T>) {
        for value in values {
            if self.piece.len() + size_of::<T>() > PIECE {
                self.write();
            }
            self.piece.extend_from_slice(bytemuck::bytes_of(&value));
        }
    }

    fn write(&mut self) {
        let length = self.piece.len() as u64;
        self.gpu.queue.write_buffer(&self.buffer, self.written, &self.piece);
        self.piece.clear();
        self.written += length;
        self.under_way += length;
        if self.under_way >= UNDER_WAY {
            hand_over(self.gpu);
            self.under_way = 0;
        }
    }

    /// Writes the rest, and gives the buffer.
    pub fn finish(mut self) -> wgpu::Buffer {
        if !self.piece.is_empty() {
            self.write();
        }
        self.buffer
    }
}

/// Has the device take all that was written, and frees the memory through which it went.
pub fn hand_over(gpu: &Gpu) {
    gpu.queue.submit([]);
    // A device that is lost says so when it draws.
    let _ = gpu.device.poll(wgpu::PollType::wait_indefinitely());
}

/// Small buffer with its contents.
pub fn filled<T: NoUninit>(gpu: &Gpu, label: &str, contents: &[T], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let contents = bytemuck::cast_slice(contents);
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
}
