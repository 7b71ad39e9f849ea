//! Formats of the renderers' targets.

use crate::gpu::Gpu;

/// Depth format. Depth is reversed: 1 at the near plane, 0 at infinity.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Format of a target. A pipeline can draw only into targets of its own format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// Texture format of the radiance.
    pub colour: wgpu::TextureFormat,
    /// Samples per pixel, 1 or 4.
    pub samples: u32,
}

impl Format {
    /// Format for pictures that are kept: every value exact to f32, if the device can blend such values.
    pub fn exact(gpu: &Gpu) -> Self {
        let colour =
            if gpu.has_full_precision() { wgpu::TextureFormat::Rgba32Float } else { wgpu::TextureFormat::Rgba16Float };
        Self { colour, samples: 1 }
    }

    /// True if every value is exact to f32.
    pub fn is_exact(self) -> bool {
        self.colour == wgpu::TextureFormat::Rgba32Float
    }

    /// Largest value that every channel can hold.
    pub fn largest(self) -> f32 {
        if self.is_exact() { f32::MAX } else { shaders::HALF_LIMIT }
    }

    /// Format for windows: half the memory traffic, edges smoothed by the hardware.
    pub fn fast(samples: u32) -> Self {
        Self { colour: wgpu::TextureFormat::Rgba16Float, samples }
    }
}
