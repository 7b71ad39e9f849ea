//! Photos of the window's picture, without the readings at its edges.

use crate::error::Error;
use crate::gpu::Gpu;
use crate::live::unused;
use crate::render::save;
use crate::renderers::display::{Adaptation, Development};
use crate::renderers::picture::Darkroom;
use crate::renderers::target::Radiance;
use crate::walls::Walls;

/// Writes the picture, as an adapted eye sees it, into `photo-001.png` or the next free number. Returns a sentence
/// with the file's name.
///
/// # Errors
/// [`Error`] of a lost device, or of a folder that cannot be written to.
pub fn take(
    gpu: &Gpu,
    radiance: &Radiance,
    adaptation: &Adaptation,
    development: &Development,
) -> Result<String, Error> {
    let mut darkroom = Darkroom::new(gpu, radiance.size, radiance.format.colour);
    let picture = darkroom.develop(gpu, radiance.result(), adaptation, development)?;
    let path = unused("photo", "png");
    save(&picture, &path)?;
    Ok(format!("photo: {}", path.display()))
}

/// Writes a photo of each window of a room. Returns a sentence with the files' names.
///
/// # Errors
/// [`Error`] as for [`take`].
pub fn take_room(gpu: &Gpu, walls: &mut Walls, development: &Development) -> Result<String, Error> {
    let mut told = Vec::new();
    for window in 0..walls.display.windows.len() {
        let picture = walls.develop_window(gpu, window, development)?;
        let path = unused("photo", "png");
        save(&picture, &path)?;
        told.push(path.display().to_string());
    }
    Ok(format!("photo: {}", told.join(", ")))
}
