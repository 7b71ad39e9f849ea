//! Photo of the window's picture, without the head-up display.

use crate::canvas::{Canvas, FlatPicture};
use crate::error::Error;
use crate::output::files::{save, unused};
use render::Gpu;
use render::display::Development;
use render::picture::Darkroom;
use walls::Walls;

/// Writes the picture into `photo-001.png` or the next free number, as an eye sees it that is adapted to it. For a
/// room, writes one file for each window. Returns a sentence that names the files.
///
/// # Errors
/// A lost device, or a folder that cannot be written to.
pub fn take(gpu: &Gpu, canvas: &mut Canvas, development: &Development) -> Result<String, Error> {
    match canvas {
        Canvas::Picture(picture) => take_picture(gpu, picture, development),
        Canvas::Room(walls) => take_room(gpu, walls, development),
        Canvas::Preview(room) => take_room(gpu, &mut room.walls, development),
    }
}

fn take_picture(gpu: &Gpu, picture: &FlatPicture, development: &Development) -> Result<String, Error> {
    let FlatPicture { radiance, adaptation, .. } = picture;
    let mut darkroom = Darkroom::new(gpu, radiance.size, radiance.format.colour);
    let picture = darkroom.develop(gpu, radiance.result(), adaptation, development)?;
    let path = unused("photo", "png");
    save(&picture, &path)?;
    Ok(format!("photo: {}", path.display()))
}

fn take_room(gpu: &Gpu, walls: &mut Walls, development: &Development) -> Result<String, Error> {
    let mut told = Vec::new();
    for window in 0..walls.display.windows.len() {
        let picture = walls.develop_window(gpu, window, development)?;
        let path = unused("photo", "png");
        save(&picture, &path)?;
        told.push(path.display().to_string());
    }
    Ok(format!("photo: {}", told.join(", ")))
}
