//! Photo-surfaces that are being computed, and the memory that they are written to.

use crate::gpu::GpuError;
use crossbeam_channel::{Receiver, Sender};
use physics::photo_surface::Stats;
use std::time::Duration;

/// Mapped buffer that one photo-surface is written to. It returns to the buffers in circulation when it is dropped.
pub(crate) struct Staging {
    buffer: Option<wgpu::Buffer>,
    home: Sender<wgpu::Buffer>,
}

/// Photo-surface that is ready to be drawn.
pub struct Transformed {
    pub(crate) staging: Staging,
    /// Vertices, and those without a finite apparent position.
    pub stats: Stats,
    /// Time that the transform took.
    pub duration: Duration,
}

/// Photo-surface that is being computed for one picture. [`SceneRenderer::show`](crate::SceneRenderer::show) takes
/// it, waits for it and has the next pictures drawn from it. If it is dropped instead, it is forgotten, and its
/// memory is used again.
///
/// A method that needs no photo-surface gives an empty one.
#[must_use = "a photo-surface that is not shown was worked out in vain"]
#[derive(Debug, Default)]
pub struct Pending(Option<Receiver<Transformed>>);

impl Staging {
    /// A buffer that is mapped, and the channel that it returns by.
    pub(crate) fn new(buffer: wgpu::Buffer, home: Sender<wgpu::Buffer>) -> Self {
        Self { buffer: Some(buffer), home }
    }

    /// Mapped buffer of this staging.
    pub(crate) fn buffer(&self) -> &wgpu::Buffer {
        self.buffer.as_ref().expect("only `into_parts` takes the buffer away")
    }

    /// Buffer and the channel that it returns by, for a copy that ends later.
    pub(crate) fn into_parts(mut self) -> (wgpu::Buffer, Sender<wgpu::Buffer>) {
        let buffer = self.buffer.take().expect("only `into_parts` takes the buffer away");
        (buffer, self.home.clone())
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        if let Some(buffer) = self.buffer.take() {
            // A closed channel means that the renderer is gone, and the buffer with it.
            let _ = self.home.send(buffer);
        }
    }
}

impl Pending {
    pub(crate) fn of(finished: Receiver<Transformed>) -> Self {
        Self(Some(finished))
    }

    /// True if a photo-surface is being computed, false if the method needs none.
    pub fn is_under_way(&self) -> bool {
        self.0.is_some()
    }

    /// Waits for the photo-surface; `None` if the method needs none.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if its memory went away with the device.
    pub(crate) fn wait(self) -> Result<Option<Transformed>, GpuError> {
        let lost = |_| GpuError::Lost("the memory of a photo-surface is gone".to_owned());
        self.0.map(|finished| finished.recv().map_err(lost)).transpose()
    }
}
