//! A ride without a window: ridden first, filmed afterwards.
//!
//! Drawing may be slower than riding, and devices do not wait. So a live ride is recorded in real time, and the film
//! is drawn when the ride has ended. A recorded rider and the built-in tour need no clock.

use crate::commands::cameraman::{Cameraman, Equipment, FilmOut, dial_of_stills};
use crate::commands::tour_film;
use crate::error::Error;
use crate::output::progress;
use crate::output::say::tell;
use crate::session::interrupt::interrupted;
use crate::session::reel::{FRAMES_PER_SECOND, Ridden, Told, reel};
use crate::session::scenes;
use crate::session::start::{RideRoom, first_actions, prepared, present};
use command::RideOptions;
use filming::Reel;
use hardware::SetUp;
use input::{KeyboardKey, Nanos, SECOND, Sample, VehicleKind};
use picture_files::FilmCodec;
use render::Gpu;
use ride::{LogError, RideLog, Simulation, Tour};
use scene::{Scene, Start};
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Length of a ride without `--seconds`, seconds.
const SECONDS: f64 = 10.0;
/// Number of simulated frames of a live ride for each picture of the film.
const FRAMES_PER_PICTURE: u32 = 2;

/// Films a ride into `path`.
///
/// # Errors
/// Any fault that keeps the ride from being ridden or drawn.
pub fn film(options: &RideOptions, path: &Path) -> Result<(), Error> {
    // Without a graphics device the ride is not begun.
    let gpu = Gpu::new()?;
    let seconds = options.seconds.unwrap_or(SECONDS);
    let rate = f64::from(FRAMES_PER_SECOND);
    let (scene, reel, recorded) = match (&options.replay, &options.tour) {
        (Some(recording), _) => {
            let shown = |start: &Start| (options.presentation(start), options.picture.is_given);
            let Ridden { scene, reel, .. } = reel(recording, &options.world, (rate, options.seconds), shown)?;
            (scene, reel, Ok(()))
        }
        (None, Some(name)) => return tour_film::film(&gpu, options, name, path),
        (None, None) => {
            let world = scenes::load(&options.world)?;
            let room = RideRoom::of(options)?;
            let (simulation, mut log) = prepared(options, &world, &room.set_up, room.head)?;
            let scene = world.scene;
            if let Some(path) = &options.record {
                log.record(path)?;
            }
            let reel = Reel::new(rate, seconds, options.presentation(&scene.start));
            let (reel, recorded) = if options.devices.are_ridden() || room.set_up.names_a_ride()? || options.realtime {
                follow(options, &room.set_up, simulation, log, (reel, seconds))?
            } else {
                demonstrate(options, &scene, simulation, log, reel)?
            };
            (scene, reel, recorded)
        }
    };
    let dial = dial_of_stills(&options.dial, &options.picture);
    let mut camera = Cameraman::new(&gpu, scene, &options.picture, dial, Equipment::default())?;
    let count = reel.len();
    camera.film((0..).zip(reel.pictures()).map(Ok), count, FilmOut::Film(path, FilmCodec::usual(path), rate))?;
    // What was ridden is filmed even if it could not be recorded.
    Ok(recorded?)
}

/// Film's moments, and the outcome of recording the ride.
type Followed = (Reel<Told>, Result<(), LogError>);

/// Follows a live ride in real time.
fn follow(
    options: &RideOptions,
    set_up: &SetUp,
    simulation: Simulation,
    log: RideLog,
    (mut reel, seconds): (Reel<Told>, f64),
) -> Result<Followed, Error> {
    let options = RideOptions { seconds: Some(seconds), ..options.clone() };
    let mut live = present(&options, set_up, simulation, log, None)?;
    let stop = interrupted();
    let spinner = progress::spinner("riding");
    let period = SECOND / Nanos::from(FRAMES_PER_SECOND * FRAMES_PER_PICTURE);
    while !stop.load(Ordering::Relaxed) {
        let Some(frame) = live.frame_for(Some(&mut reel))? else { break };
        reel.add(&frame);
        let next = (frame.record.at / period + 1) * period;
        std::thread::sleep(Duration::from_nanos(next.saturating_sub(live.now())));
    }
    let recorded = live.finish();
    spinner.finish_and_clear();
    for report in live.devices() {
        [&report.line].into_iter().chain(&report.details).for_each(tell);
    }
    Ok((reel, recorded))
}

/// Simulates a ride of the built-in rider, which needs no clock.
fn demonstrate(
    options: &RideOptions,
    scene: &Scene,
    mut simulation: Simulation,
    mut log: RideLog,
    mut reel: Reel<Told>,
) -> Result<Followed, Error> {
    let mut rider = Demonstrator::new(scene, &simulation);
    let stop = interrupted();
    for number in 0.. {
        let at = number * SECOND / Nanos::from(FRAMES_PER_SECOND);
        let mut samples = rider.samples(&simulation, at);
        if at == 0 {
            samples.extend(first_actions(options).iter().map(|action| Sample::action(0, action)));
        }
        let frame = simulation.frame_for(at, &samples, Some(&mut reel));
        if let Err(error) = log.frame(&samples, &frame) {
            tell(error);
        }
        if !reel.add(&frame) || stop.load(Ordering::Relaxed) {
            break;
        }
    }
    Ok((reel, log.finish()))
}

/// Scripted rider, used without devices: a cyclist that follows the scene's circuit, or a foot on the pedal.
enum Demonstrator {
    Cyclist(Box<Tour>),
    Foot { pressed: bool },
}

impl Demonstrator {
    fn new(scene: &Scene, simulation: &Simulation) -> Self {
        let setup = simulation.setup();
        match (setup.kind, Tour::new(&scene.circuit, &setup.desk.bicycle)) {
            (VehicleKind::Bicycle, Some(tour)) => Self::Cyclist(Box::new(tour)),
            _ => Self::Foot { pressed: false },
        }
    }

    /// Samples of the scripted rider up to `at`.
    fn samples(&mut self, simulation: &Simulation, at: Nanos) -> Vec<Sample> {
        match self {
            Self::Cyclist(tour) => tour.samples(simulation.vehicle(), at),
            Self::Foot { pressed } if !*pressed => {
                *pressed = true;
                let key = simulation.setup().desk.keys.key_for(KeyboardKey::W);
                key.map(|key| Sample::key(at, key, true)).into_iter().collect()
            }
            Self::Foot { .. } => Vec::new(),
        }
    }
}
