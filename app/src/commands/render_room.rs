//! `rapidity render --display`: a picture for every channel of a room.

use crate::command::{RenderOptions, Renderer};
use crate::error::Error;
use crate::gpu::Gpu;
use crate::progress;
use crate::render::save;
use crate::renderers::SceneRenderer;
use crate::renderers::choice::Choice;
use crate::renderers::image::MapQuality;
use crate::renderers::picture::{SCREEN_FORMAT, Studio, largest_side};
use crate::renderers::polygon::Pace;
use crate::room::Display;
use crate::scene::{Start, source};
use crate::views::Camera;
use crate::walls::preview::Onlooker;
use crate::walls::{Occupant, Quality, Walls};
use physics::Event;
use physics::worldline::State;
use std::path::Path;

/// Carries out `rapidity render --display`.
///
/// # Errors
/// Whatever keeps a picture from being drawn or written.
pub fn render(options: &RenderOptions, gpu: &Gpu, display: &str, folder: &Path) -> Result<(), Error> {
    if options.picture.renderer == Renderer::Raytrace {
        return Err(Error::WallsByRays);
    }
    let display = Display::named_or_file(display)?;
    for notice in &display.notices {
        eprintln!("{}: {notice}", display.name);
    }
    let limit = largest_side(gpu);
    if let Some(channel) = display.channels.iter().find(|channel| channel.size().iter().any(|side| *side > limit)) {
        return Err(Error::TooLarge { size: channel.size(), limit });
    }
    make_folder(folder)?;

    let scene = source::load(&options.world.scene, options.world.speed_of_light)?;
    let vehicle = vehicle(options, scene.start);
    let picture = &options.picture;
    let quality = Quality {
        format: Studio::format(gpu),
        samples: picture.samples,
        density: if picture.samples == 1 { 3.0 } else { 1.0 },
        smooth: false,
    };
    // What is drawn finely already needs a map that is no finer.
    let bent = display.channels.iter().any(|channel| channel.flat(&display).is_none());
    let usual = picture.map_of_pictures();
    let finer = if bent && picture.map_scale.is_none() { quality.density } else { 1.0 };
    let map = MapQuality { texels_per_pixel: usual.texels_per_pixel / finer, ..usual };
    let Choice { scene, method, because } =
        Choice::of(scene, picture.renderer, options.world.bending(Pace::Still), map)?;
    eprintln!("{because}, on {}", gpu.description());
    let spinner = progress::spinner("uploading");
    let mut renderer = SceneRenderer::new(gpu, &scene, quality.format, picture.background, method)?;
    let head = options.room.head(&display.viewer);
    let mut walls = Walls::new(gpu, display, quality, SCREEN_FORMAT);
    gpu.wait()?;
    spinner.finish_and_clear();

    let count = walls.display.channels.len();
    let spinner = progress::spinner("drawing");
    let occupant = Occupant { vehicle, head };
    let drawn = walls.draw(gpu, &mut renderer, &occupant, picture.effects)?;
    if let Some((channel, behind)) = drawn.behind.first() {
        return Err(Error::EyeBehind { channel: channel.clone(), behind: *behind });
    }
    walls.adapt(gpu, &picture.development(), None);
    gpu.wait()?;
    spinner.finish_and_clear();
    if drawn.certainty.error_px() > 1.0 {
        eprintln!("{}", drawn.certainty.sentence());
    }
    for channel in 0..count {
        let path = folder.join(format!("{}.png", walls.display.channels[channel].name));
        save(&walls.develop(gpu, channel, &picture.development())?, &path)?;
        eprintln!("wrote {}", path.display());
    }
    if options.room.preview {
        let mut onlooker = Onlooker::outside(&walls);
        onlooker.from_m = options.room.preview_from.unwrap_or(onlooker.from_m);
        let path = folder.join("room.png");
        save(&walls.develop_room(gpu, picture.size, &occupant, &onlooker, &picture.development())?, &path)?;
        eprintln!("wrote {}", path.display());
    }
    Ok(())
}

/// The vehicle that the room rests in: at --position, which is on the ground where nothing is said, and with its −z along --look.
fn vehicle(options: &RenderOptions, start: Start) -> State {
    let view = &options.viewpoint;
    let position = view.position.unwrap_or(start.position);
    let look = view.look.unwrap_or(start.look);
    let orientation = Camera::looking(look, view.up, 1.0).observer_from_eye;
    State::new(Event { ct: 0.0, position }, view.celerity(), orientation)
}

/// Makes the folder that pictures go into, if it is not there.
fn make_folder(folder: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(folder).map_err(|error| Error::Write { path: folder.to_owned(), reason: error.to_string() })
}
