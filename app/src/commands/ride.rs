//! `rapidity ride`: puts the ride together, and opens a window on it, or films it where there is no display.

use crate::check::say;
use crate::command::{RideOptions, SceneChoice, VehicleName};
use crate::error::Error;
use crate::film_ride;
use crate::live::Live;
use crate::log::Log;
use crate::preferences;
use crate::progress;
use crate::render::writable;
use crate::room::Display;
use crate::scene::collision::Collision;
use crate::scene::{Scene, source};
use crate::simulation::{Replay, Setup, Simulation, Start};
use crate::vehicle::{Surroundings, VehicleSettings, World};
use crate::walls::tracker;
use crate::window;
use glam::DVec3;
use input::devices::{Devices, DevicesConfig};
use input::recording::Recording;
use input::{Action, Clock, DeskConfig, HeadConfig, Sample, TrackerUrl, VehicleKind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Where a ride is filmed that has no display and names no file.
const FILM: &str = "ride.mp4";

/// The display that a tracked head sees where none is named.
pub const WINDOW: &str = "window";

/// Key of a recording's setting that tells its scene from others.
const FINGERPRINT: &str = "scene_fingerprint";

fn fingerprint(scene: &Scene) -> String {
    format!("{:016x}", scene.fingerprint())
}

/// Carries out `rapidity ride`.
///
/// # Errors
/// Whatever keeps the ride from beginning, or ends it.
pub fn ride(options: &RideOptions) -> Result<(), Error> {
    if options.verify {
        return options.replay.as_deref().map_or(Ok(()), |path| verify(path, options));
    }
    let options = &preferences::applied(options)?;
    if options.out.is_none() && window::has_display() {
        let (scene, begin) = begin(options)?;
        return window::run(options, scene, begin);
    }
    if options.display.is_some() {
        return Err(Error::NoWindows);
    }
    let path = options.out.clone().unwrap_or_else(|| {
        eprintln!("no display: filming the ride into {FILM}");
        PathBuf::from(FILM)
    });
    writable(&path)?;
    film_ride::film(options, &path)
}

/// Computes a recorded ride again, and compares it bit for bit.
fn verify(path: &Path, options: &RideOptions) -> Result<(), Error> {
    let (_, replay) = recorded(path, &options.world.scene)?;
    let spinner = progress::spinner("riding again");
    let frames = replay.verify();
    spinner.finish_and_clear();
    say(&format!("{}: {} frames, identical to the bit", path.display(), frames?))
}

/// The scene, and what begins a ride in it: live, or recorded.
fn begin(options: &RideOptions) -> Result<(Scene, window::Begin), Error> {
    let seconds = options.seconds;
    if let Some(path) = &options.replay {
        let (scene, replay) = recorded(path, &options.world.scene)?;
        return Ok((scene, Box::new(move || Ok(Live::recorded(replay, seconds)))));
    }
    let scene = source::load(&options.world.scene, options.world.speed_of_light)?;
    let (simulation, mut log) = prepared(options, &scene)?;
    if let Some(path) = &options.record {
        log.record(path)?;
    }
    let options = options.clone();
    Ok((scene, Box::new(move || present(&options, simulation, log))))
}

/// A live ride whose clock starts now.
///
/// # Errors
/// Devices that cannot be read.
pub fn present(options: &RideOptions, simulation: Simulation, log: Log) -> Result<Live, Error> {
    let clock = Clock::start();
    let devices = Devices::open(&devices_config(options, &simulation.setup().desk), clock)?;
    let mut live = Live::present(simulation, devices, clock, log, options.seconds);
    for action in first_actions(options) {
        live.say(|at| Sample::action(at, &action));
    }
    Ok(live)
}

/// A recording's scene, and the ride in it once more.
///
/// # Errors
/// The recording or its scene cannot be read.
pub fn recorded(path: &Path, choice: &SceneChoice) -> Result<(Scene, Replay), Error> {
    let recording = Recording::open(path)?;
    // A scene that is named overrides the recorded one, whose file may have moved.
    let choice = match choice {
        SceneChoice::Town => SceneChoice::from_name(&recording.header().scene),
        named => named.clone(),
    };
    let scene = source::load(&choice, recording.header().speed_of_light_m_s)?;
    if recording.header().settings.get(FINGERPRINT).is_some_and(|recorded| *recorded != fingerprint(&scene)) {
        eprintln!(
            "{}: {} is not the scene that was ridden through; expect another ride",
            path.display(),
            choice.name()
        );
    }
    let surroundings = surroundings(&scene)?;
    Ok((scene, Replay::new(recording, surroundings)?))
}

/// A simulation at its beginning, and the log of it.
///
/// # Errors
/// Settings that cannot be used, or a scene without sound geometry.
pub fn prepared(options: &RideOptions, scene: &Scene) -> Result<(Simulation, Log), Error> {
    let setup = setup(options, scene)?;
    let mut header = setup.header(env!("CARGO_PKG_VERSION"), &options.world.scene.name());
    header.settings.insert(FINGERPRINT.to_owned(), fingerprint(scene));
    Ok((Simulation::new(setup, surroundings(scene)?)?, Log::new(header)))
}

/// What the vehicle stands on and runs into.
fn surroundings(scene: &Scene) -> Result<Arc<dyn Surroundings>, Error> {
    let spinner = progress::spinner("finding ground and walls");
    let collision = Collision::new(scene)?;
    spinner.finish_and_clear();
    Ok(Arc::new(collision))
}

fn setup(options: &RideOptions, scene: &Scene) -> Result<Setup, Error> {
    let kind = match options.vehicle.vehicle {
        VehicleName::Bicycle => VehicleKind::Bicycle,
        VehicleName::Drive => VehicleKind::Drive,
        VehicleName::Fly => VehicleKind::Fly,
    };
    let mut vehicle = VehicleSettings { integrator: options.vehicle.integrator, ..Default::default() };
    vehicle.flight.nose = options.vehicle.transport;
    // One who flies begins at his eye, the others on the ground.
    let eye = if kind == VehicleKind::Fly { DVec3::from_array(vehicle.eye_m) } else { DVec3::ZERO };
    Ok(Setup {
        world: World::new(options.world.speed_of_light)?,
        kind,
        start: Start::at_rest(scene.start.position + eye, scene.start.look),
        vehicle,
        desk: DeskConfig { head: head_config(options)?, ..Default::default() },
    })
}

/// The room that a ride is shown in, if it is: a tracked head before a single picture sees through it as through a window.
///
/// # Errors
/// A display that cannot be used.
pub fn display(options: &RideOptions) -> Result<Option<Display>, Error> {
    let tracked = options.devices.tracker.as_ref().map(|_| WINDOW);
    Ok(options.display.as_deref().or(tracked).map(Display::named_or_file).transpose()?)
}

/// How the head is tracked.
fn head_config(options: &RideOptions) -> Result<Option<HeadConfig>, Error> {
    let Some(display) = display(options)? else { return Ok(None) };
    Ok(tracker::head_config(&display, options.devices.tracker.as_ref())?)
}

/// Whether it is the mouse that moves the head.
///
/// # Errors
/// As [`display`].
pub fn mouse_moves_head(options: &RideOptions) -> Result<bool, Error> {
    Ok(options.replay.is_none() && head_config(options)?.is_some_and(|head| head.url == TrackerUrl::Mouse))
}

/// What the command line asks of the simulation while it runs.
pub fn first_actions(options: &RideOptions) -> Vec<Action> {
    let scale = options.vehicle.time_scale;
    if scale == 1.0 { Vec::new() } else { vec![Action::TimeScale(scale)] }
}

/// Which devices the command line names.
pub fn devices_config(options: &RideOptions, desk: &DeskConfig) -> DevicesConfig {
    DevicesConfig {
        bicycle: options.devices.bicycle.clone(),
        space_mouse: options.devices.spacemouse || window::has_display(),
        tracker: desk.head.as_ref().map(|head| head.url.clone()),
        ..Default::default()
    }
}
