//! `rapidity ride`: prepares the ride, and opens a window on it, or films it if there is no graphical session.

use crate::command::{RideOptions, SceneChoice};
use crate::commands::ride_film;
use crate::error::Error;
use crate::output::progress;
use crate::output::say::{say, tell};
use crate::session::live::Live;
use crate::session::preferences;
use crate::session::scenes;
use crate::session::start::{
    PRESENTATION, RideRoom, has_display, kiosk, prepared, prepared_for_tour, present, recorded,
};
use crate::session::tour_ride::TourRide;
use crate::window::{self, WaitingRide};
use input::recording::RecordingError;
use picture_files::files::writable;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tours::TourPlayer;

/// File of the film if there is no graphical session and no file is named.
const FILM: &str = "ride.mp4";

/// Carries out `rapidity ride`.
///
/// # Errors
/// Any fault that keeps the ride from beginning, or ends it.
pub fn ride(options: &RideOptions) -> Result<(), Error> {
    let films = options.out.is_some() || !has_display();
    options.passed_over(films).iter().for_each(tell);
    if options.verify {
        return options.replay.as_deref().map_or(Ok(()), |path| verify(path, options));
    }
    let options = &preferences::applied(options);
    if !films {
        let room = RideRoom::of(options)?;
        return window::run(options, waiting(options, room)?);
    }
    if options.kiosk.kiosk {
        return Err(Error::KioskWithoutWindows);
    }
    if options.display.is_some() {
        return Err(Error::NoWindows);
    }
    let path = options.out.clone().unwrap_or_else(|| {
        tell(format_args!("no display: filming the ride into {FILM}"));
        PathBuf::from(FILM)
    });
    writable(&path)?;
    ride_film::film(options, &path)
}

/// Computes a recorded ride again, and compares it bit for bit.
fn verify(path: &Path, options: &RideOptions) -> Result<(), Error> {
    let (_, mut replay) = recorded(path, &options.world)?;
    let spinner = progress::spinner("riding again");
    let frames = replay.verify();
    spinner.finish_and_clear();
    if let Some(offset) = replay.another() {
        tell(RecordingError::Another { path: path.to_owned(), offset });
    }
    Ok(say(format_args!("{}: {} frames, identical to the bit", path.display(), frames?))?)
}

/// Live or recorded ride for which the windows are opened.
fn waiting(options: &RideOptions, room: RideRoom) -> Result<WaitingRide, Error> {
    let seconds = options.seconds;
    if let Some(path) = &options.replay {
        let (scene, replay) = recorded(path, &options.world)?;
        let presentation = options.presentation(&scene.start);
        // What the rider has seen is shown again, unless the command line asks for another picture.
        let presentation = match replay.header_setting(PRESENTATION) {
            Some(json) if !options.picture_is_given => presentation.with_json(json).in_language(presentation.language),
            _ => presentation,
        };
        let begin = Box::new(move || Ok(Live::recorded(replay, seconds)));
        return Ok(WaitingRide { scene, room, presentation, begin });
    }
    if let Some(name) = &options.tour {
        return on_tour(options, room, name);
    }
    let world = scenes::load(&options.world)?;
    let presentation = options.presentation(&world.scene.start);
    let (simulation, mut log) = prepared(options, &world, &room.set_up, room.head.clone())?;
    let scene = world.scene;
    let kiosk = kiosk(options, simulation.setup(), &scene)?;
    if let Some(path) = &options.record {
        log.record(path)?;
    }
    let (options, set_up) = (options.clone(), room.set_up.clone());
    let begin = Box::new(move || present(&options, &set_up, simulation, log, kiosk));
    Ok(WaitingRide { scene, room, presentation, begin })
}

/// Ride on a tour, by its name or file.
fn on_tour(options: &RideOptions, room: RideRoom, name: &str) -> Result<WaitingRide, Error> {
    let file = Path::new(name);
    let plan = if name.ends_with(".toml") { tours::read(file)? } else { tours::built_in(name)? };
    let mut options = options.clone();
    options.world.scene = Some(match (SceneChoice::from_name(&plan.scene), file.parent()) {
        (SceneChoice::File(path), Some(folder)) if name.ends_with(".toml") => SceneChoice::File(folder.join(path)),
        (choice, _) => choice,
    });
    options.world.speed_of_light = plan.speed_of_light_m_s;
    let world = scenes::load(&options.world)?;
    let presentation = options.presentation(&world.scene.start);
    let (simulation, mut log) = prepared_for_tour(&options, &world, &room.set_up, room.head.clone(), &plan)?;
    let player = TourPlayer::new(Arc::new(plan), &world.scene.circuit, &simulation.setup().desk)?;
    if let Some(path) = &options.record {
        log.record(path)?;
    }
    let set_up = room.set_up.clone();
    let begin = move || Ok(present(&options, &set_up, simulation, log, None)?.on_tour(TourRide::new(player)));
    Ok(WaitingRide { scene: world.scene, room, presentation, begin: Box::new(begin) })
}
