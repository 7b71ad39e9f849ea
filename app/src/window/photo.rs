//! Photo of the window's picture, without the head-up display.

use crate::canvas::Canvas;
use crate::error::Error;
use picture_files::files::{save, unused};
use presentation::Presentation;
use render::display::{Development, Seen};
use render::target::Format;
use render::{Gpu, SceneRenderer};
use studio::Darkroom;
use view::{Gaze, Projection};
use walls::{FlatPicture, ProjectedPicture, ProjectedView, Quality, Walls};

/// Writes the picture into `photo-001.png` or the next free number, as an eye sees it that is adapted to it. For a
/// room, writes one file for each window. Returns the names of the files.
///
/// # Errors
/// A lost device, or a folder that cannot be written to.
pub fn take(
    gpu: &Gpu,
    renderer: &mut SceneRenderer,
    canvas: &mut Canvas,
    development: &Development,
) -> Result<String, Error> {
    match canvas {
        Canvas::Picture(picture) => take_picture(gpu, renderer, picture, development),
        Canvas::Room(walls) => take_room(gpu, renderer, walls, development),
        Canvas::Preview(room) => take_room(gpu, renderer, &mut room.walls, development),
    }
}

/// Width and height of a picture of all directions, pixels, and samples of each of its pixels.
const SPHERE: [u32; 2] = [2880, 1440];
const SPHERE_SAMPLES: u32 = 2;

/// Writes a picture of all directions into `sphere-001.png` or the next free number. Its middle is where the gaze goes.
/// Returns the name of the file.
///
/// # Errors
/// A lost device, or a folder that cannot be written to.
pub fn take_sphere(
    gpu: &Gpu,
    renderer: &mut SceneRenderer,
    format: Format,
    gaze: &Gaze,
    presentation: &Presentation,
) -> Result<String, Error> {
    let quality = Quality { format, samples: SPHERE_SAMPLES, density: 1.5, smooth: true };
    let mut sphere = ProjectedPicture::new(gpu, Projection::Sphere, SPHERE, None, quality);
    let view = ProjectedView { gaze: *gaze, fov_deg: presentation.fov_deg, effects: presentation.effects };
    let pending = sphere.submit(gpu, renderer, &view)?;
    sphere.draw(gpu, renderer, &view, pending)?;
    let mut darkroom = Darkroom::new(gpu, SPHERE, format.colour);
    let stored = sphere.stored();
    let seen: Vec<_> = sphere.lights().into_iter().map(|radiance| Seen { radiance, stored, elapsed_s: None }).collect();
    let picture = darkroom.begin(gpu, &seen, &presentation.development).finish_one(gpu)?;
    let path = unused("sphere", "png");
    save(picture, &path)?;
    Ok(path.display().to_string())
}

fn take_picture(
    gpu: &Gpu,
    renderer: &mut SceneRenderer,
    picture: &mut FlatPicture,
    development: &Development,
) -> Result<String, Error> {
    let (radiance, adaptation) = picture.whole(gpu, renderer);
    let texture = radiance.texture();
    let mut darkroom = Darkroom::new(gpu, [texture.width(), texture.height()], texture.format());
    let picture = darkroom.develop(gpu, radiance, adaptation, development)?;
    let path = unused("photo", "png");
    save(picture, &path)?;
    Ok(path.display().to_string())
}

fn take_room(
    gpu: &Gpu,
    renderer: &mut SceneRenderer,
    walls: &mut Walls,
    development: &Development,
) -> Result<String, Error> {
    walls.draw_whole(gpu, renderer)?;
    // A photo shows the world, without the menu that asked for it.
    walls.sheets.clear();
    let mut told = Vec::new();
    for window in 0..walls.display.windows.len() {
        let picture = walls.develop_window(gpu, window, development)?;
        let path = unused("photo", "png");
        save(picture, &path)?;
        told.push(path.display().to_string());
    }
    Ok(told.join(", "))
}
