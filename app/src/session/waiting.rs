//! Rides that are ready to begin, and wait for their windows.

use crate::error::Error;
use crate::session::live::Live;
use crate::session::scenes;
use crate::session::start::{PRESENTATION, RideRoom, kiosk, prepared, prepared_for_tour, present, recorded};
use crate::session::tour_ride::TourRide;
use command::{RideOptions, SceneChoice, WorldOptions};
use presentation::Presentation;
use ride::{RideLog, Simulation};
use scene::Scene;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tours::{TourPlan, TourPlayer};

/// Function that begins a ride.
pub type Begin = Box<dyn FnOnce() -> Result<Live, Error> + Send>;

/// Ride that is ready to begin.
pub struct WaitingRide {
    /// Options of the ride. Its scene and its speed of light are named, wherever they come from.
    pub options: RideOptions,
    /// Scene of the ride.
    pub scene: Scene,
    /// Room in which the ride is shown.
    pub room: RideRoom,
    /// How the ride is shown at its beginning.
    pub presentation: Presentation,
    /// Function that begins the ride. It is called when everything else is ready, since the ride's clock starts with
    /// it.
    pub begin: Begin,
}

impl WaitingRide {
    /// Live or recorded ride, or tour, that the options ask for.
    ///
    /// # Errors
    /// A scene, a recording, a tour or a setting that cannot be used.
    pub fn of(options: &RideOptions, room: RideRoom) -> Result<Self, Error> {
        match (&options.replay, &options.tour) {
            (Some(path), _) => of_recording(options, room, path, None),
            (None, Some(name)) => of_tour(options, room, name),
            (None, None) => of_rider(options, room),
        }
    }
}

/// Recorded ride, shown as its rider saw it, unless the command line asks for another picture; with the captions of a
/// tour, if one tells of it.
fn of_recording(
    options: &RideOptions,
    room: RideRoom,
    path: &Path,
    plan: Option<TourPlan>,
) -> Result<WaitingRide, Error> {
    let seconds = options.seconds;
    let (scene, replay) = recorded(path, &options.world)?;
    let mut options = options.clone();
    options.world.scene.get_or_insert_with(|| SceneChoice::from_name(replay.scene()));
    options.world.speed_of_light = Some(replay.simulation().setup().light_speed.speed_of_light_m_s());
    let presentation = options.presentation(&scene.start);
    let presentation = match replay.header_setting(PRESENTATION) {
        Some(json) if !options.picture.is_given => presentation.with_json(json).in_language(presentation.language),
        _ => presentation,
    };
    let keys = options.keys.clone();
    let desk = &replay.simulation().setup().desk;
    let player = plan.map(|plan| TourPlayer::new(Arc::new(plan), &scene.circuit, desk)).transpose()?;
    let begin = Box::new(move || {
        let live = Live::recorded(replay, keys, seconds);
        Ok(match player {
            Some(player) => live.on_tour(TourRide::new(player)),
            None => live,
        })
    });
    Ok(WaitingRide { options, scene, room, presentation, begin })
}

/// Ride of a rider who decides.
fn of_rider(options: &RideOptions, room: RideRoom) -> Result<WaitingRide, Error> {
    let world = scenes::load(&options.world)?;
    let presentation = options.presentation(&world.scene.start);
    let (simulation, mut log) = prepared(options, &world, &room.set_up, room.head.clone())?;
    let scene = world.scene;
    let kiosk = kiosk(options, simulation.setup(), &scene)?;
    if let Some(path) = &options.record {
        log.record(path)?;
    }
    let mut options = options.clone();
    options.world.scene = Some(options.world.scene());
    options.world.speed_of_light = Some(world.speed_of_light_m_s);
    let (begun, set_up) = (options.clone(), room.set_up.clone());
    let begin = Box::new(move || present(&begun, &set_up, simulation, log, kiosk));
    Ok(WaitingRide { options, scene, room, presentation, begin })
}

/// Ride on a tour, by its name or file. A tour of a recording shows that.
fn of_tour(options: &RideOptions, room: RideRoom, name: &str) -> Result<WaitingRide, Error> {
    let plan = plan(name)?;
    if let Some(recording) = &plan.recording {
        let (path, scene) = (beside(name, recording), Some(scene_of(&plan, name)));
        let options = RideOptions { world: WorldOptions { scene, ..options.world.clone() }, ..options.clone() };
        return of_recording(&options, room, &path, Some(plan));
    }
    let ReadyTour { options, scene, presentation, simulation, mut log, tour } =
        ReadyTour::of(options, &room, name, plan)?;
    if let Some(path) = &options.record {
        log.record(path)?;
    }
    let (begun, set_up) = (options.clone(), room.set_up.clone());
    let begin = move || Ok(present(&begun, &set_up, simulation, log, None)?.on_tour(tour));
    Ok(WaitingRide { options, scene, room, presentation, begin: Box::new(begin) })
}

/// Plan of a tour, by its name or file.
///
/// # Errors
/// A name that no tour has, or a file that cannot be used.
pub fn plan(name: &str) -> Result<TourPlan, Error> {
    Ok(if name.ends_with(".toml") { tours::read(Path::new(name))? } else { tours::built_in(name)? })
}

/// Scene of a plan; a file's is looked for beside the tour's own file.
fn scene_of(plan: &TourPlan, name: &str) -> SceneChoice {
    match SceneChoice::from_name(&plan.scene) {
        SceneChoice::File(path) => SceneChoice::File(beside(name, path)),
        choice => choice,
    }
}

/// Path that is relative to the file of a tour.
fn beside(name: &str, path: impl AsRef<Path>) -> PathBuf {
    match Path::new(name).parent() {
        Some(folder) if name.ends_with(".toml") => folder.join(path),
        _ => path.as_ref().to_owned(),
    }
}

/// Tour that is ready to be ridden.
pub struct ReadyTour {
    /// Options of its ride, with its scene and its speed of light.
    pub options: RideOptions,
    /// Scene of the tour.
    pub scene: Scene,
    /// How it is shown at its beginning.
    pub presentation: Presentation,
    /// Simulation of its ride.
    pub simulation: Simulation,
    /// Log of its ride.
    pub log: RideLog,
    /// Tour itself.
    pub tour: TourRide,
}

impl ReadyTour {
    /// Tour of a name, or of a file.
    ///
    /// # Errors
    /// A tour, a scene or a setting that cannot be used.
    pub fn of(options: &RideOptions, room: &RideRoom, name: &str, plan: TourPlan) -> Result<Self, Error> {
        let mut options = options.clone();
        options.world.scene = Some(scene_of(&plan, name));
        options.world.speed_of_light = plan.speed_of_light_m_s;
        let world = scenes::load(&options.world)?;
        options.world.speed_of_light = Some(world.speed_of_light_m_s);
        let presentation = options.presentation(&world.scene.start);
        let (simulation, log) = prepared_for_tour(&options, &world, &room.set_up, room.head.clone(), &plan)?;
        let player = TourPlayer::new(Arc::new(plan), &world.scene.circuit, &simulation.setup().desk)?;
        Ok(Self { options, scene: world.scene, presentation, simulation, log, tour: TourRide::new(player) })
    }
}
