//! `rapidity render --display`: a picture for every channel of a room.

use crate::commands::cameraman::dial_of_stills;
use crate::error::Error;
use crate::output::progress;
use crate::output::say::tell;
use crate::session::scenes;
use command::RenderOptions;
use glam::DVec3;
use physics::Event;
use physics::worldline::{Thrust, WorldlineState};
use picture_files::files::{WriteError, save};
use render::choice::Choice;
use render::{Gpu, SceneRenderer};
use room::Display;
use scene::Start;
use std::path::Path;
use studio::{SCREEN_FORMAT, Studio, largest_side};
use view::{Camera, Dial, EYE_HEIGHT_M, Occasion, RendererName};
use walls::preview::RoomOnlooker;
use walls::{Occupant, Quality, Walls};

/// Carries out `rapidity render --display`.
///
/// # Errors
/// Any fault that keeps a picture from being drawn or written.
pub fn render(options: &RenderOptions, gpu: &Gpu, display: &str, folder: &Path) -> Result<(), Error> {
    if options.dial.renderer == RendererName::Raytrace {
        return Err(Error::WallsByRays);
    }
    let display = Display::named_or_file_within(display, &options.world.reading.budget())?;
    for notice in &display.notices {
        tell(format_args!("{}: {notice}", display.name));
    }
    let limit = largest_side(gpu);
    if let Some(channel) = display.channels.iter().find(|channel| channel.size().iter().any(|side| *side > limit)) {
        return Err(Error::TooLarge { size: channel.size(), limit });
    }
    make_folder(folder)?;

    let scene = scenes::load(&options.world)?.scene;
    let vehicle = vehicle(options, scene.start);
    let picture = &options.picture;
    let quality = Quality {
        format: Studio::format(gpu),
        samples: picture.samples,
        // With one sample a pixel of a bent screen has the colour of the nearest of many rays; else rays are mixed.
        density: if picture.samples == 1 { 3.0 } else { 1.5 },
        smooth: picture.samples > 1,
    };
    // A bent surface with several rays for each of its pixels does not need the map as fine as well.
    let bent = display.channels.iter().any(|channel| channel.flat(&display).is_none());
    let usual = dial_of_stills(&options.dial, picture);
    let coarser = bent && picture.samples == 1 && options.dial.map_scale.is_none();
    let finer = if coarser { quality.density } else { 1.0 };
    let wanted = Dial { map_scale: usual.map_scale.map(|scale| scale / finer), ..usual };
    let spinner = progress::cutting(wanted);
    let Choice { scene, dial, because } = Choice::of(scene, wanted, Occasion::Still)?;
    spinner.finish_and_clear();
    tell(format_args!("{because}, on {}", gpu.description()));
    let spinner = progress::spinner("uploading");
    let mut renderer = SceneRenderer::new(gpu, scene, quality.format, picture.background, dial, Occasion::Still)?;
    let head = options.room.head(&display.viewer);
    let mut walls = Walls::new(gpu, display, quality, SCREEN_FORMAT);
    gpu.wait()?;
    spinner.finish_and_clear();

    let count = walls.display.channels.len();
    let spinner = progress::spinner("drawing");
    let occupant = Occupant { vehicle, thrust: Thrust::default(), head };
    let submitted = walls.submit(gpu, &mut renderer, &occupant, picture.effects)?;
    let drawn = walls.draw(gpu, &mut renderer, submitted)?;
    if let Some((channel, behind)) = drawn.behind.first() {
        return Err(Error::EyeBehind { channel: channel.clone(), behind: *behind });
    }
    walls.adapt(gpu, &picture.development(), None);
    gpu.wait()?;
    spinner.finish_and_clear();
    if drawn.certainty.error_px() > 1.0 {
        tell(drawn.certainty.sentence());
    }
    for channel in 0..count {
        let path = folder.join(format!("{}.png", walls.display.channels[channel].name));
        save(walls.develop(gpu, channel, &picture.development())?, &path)?;
        tell(format_args!("wrote {}", path.display()));
    }
    if options.room.preview {
        let mut onlooker = RoomOnlooker::outside(&walls);
        onlooker.from_m = options.room.preview_from.unwrap_or(onlooker.from_m);
        let path = folder.join("room.png");
        save(walls.develop_room(gpu, picture.size, &occupant, &onlooker, &picture.development())?, &path)?;
        tell(format_args!("wrote {}", path.display()));
    }
    Ok(())
}

/// State of the vehicle in which the room rests: at --position, by default the scene's start, with its −z along
/// --look.
fn vehicle(options: &RenderOptions, start: Start) -> WorldlineState {
    let view = &options.viewpoint;
    let position = view.position.unwrap_or(start.eye() - DVec3::Y * EYE_HEIGHT_M);
    let look = view.look.unwrap_or(start.look);
    let orientation = Camera::looking(look, view.up(&start), 1.0).observer_from_eye;
    WorldlineState::new(Event { ct: 0.0, position }, view.celerity(), orientation)
}

/// Makes the folder for the pictures, unless it exists.
fn make_folder(folder: &Path) -> Result<(), Error> {
    Ok(std::fs::create_dir_all(folder).map_err(|error| WriteError::new(folder, error))?)
}
