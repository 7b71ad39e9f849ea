//! A ride without a window: ridden first, filmed afterwards.
//!
//! Drawing may be slower than riding, and devices do not wait; so whoever rides live is followed by the clock, and the
//! film is drawn when he has arrived. A recorded rider and the built-in tour need no clock.

use crate::command::{RideOptions, SceneChoice};
use crate::error::Error;
use crate::gpu::Gpu;
use crate::live::gaze;
use crate::log::Log;
use crate::progress;
use crate::render::{Cameraman, Moment, interrupted};
use crate::renderers::polygon::Pace;
use crate::ride::{first_actions, prepared, present, recorded};
use crate::scene::{Scene, source};
use crate::simulation::{Frame, ReplayError, Replayed, Simulation, Tour};
use input::{Key, Nanos, SECOND, Sample, VehicleKind};
use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Pictures a second of the film.
const FRAMES_PER_SECOND: u32 = 30;
/// Seconds of a ride for which `--seconds` says nothing.
const SECONDS: f64 = 10.0;
/// Frames that a live ride is followed with, for each of the film's.
const FRAMES_PER_PICTURE: u32 = 2;

/// Films a ride into `path`.
///
/// # Errors
/// Whatever keeps the ride from being ridden or drawn.
pub fn film(options: &RideOptions, path: &Path) -> Result<(), Error> {
    // Without a graphics device nobody needs to ride.
    let gpu = Gpu::new()?;
    let seconds = options.seconds.unwrap_or(SECONDS);
    let (scene, moments) = match &options.replay {
        Some(recording) => {
            let rate = f64::from(FRAMES_PER_SECOND);
            let (scene, _, moments) = reel(recording, &options.world.scene, rate, options.seconds)?;
            (scene, moments)
        }
        None => {
            let scene = source::load(&options.world.scene, options.world.speed_of_light)?;
            let (simulation, mut log) = prepared(options, &scene)?;
            if let Some(path) = &options.record {
                log.record(path)?;
            }
            let somebody = options.devices.bicycle.is_some() || options.devices.spacemouse;
            let reel = if somebody || options.realtime {
                follow(options, simulation, log, seconds)?
            } else {
                demonstrate(options, &scene, simulation, log, seconds)?
            };
            (scene, reel.moments)
        }
    };
    let mut camera = Cameraman::new(&gpu, scene, &options.picture, options.world.bending(Pace::Still))?;
    let count = moments.len() as u64;
    camera.film(moments.into_iter().map(Ok), count, f64::from(FRAMES_PER_SECOND), path)
}

/// A recorded ride once more: its scene, its speed of light in metres per second, and the observer at each picture's time.
///
/// A recording that is damaged or differs is followed as far as it goes, and the user told.
///
/// # Errors
/// The recording or its scene cannot be read at all.
pub fn reel(
    recording: &Path,
    choice: &SceneChoice,
    frames_per_second: f64,
    seconds: Option<f64>,
) -> Result<(Scene, f64, Vec<Moment>), Error> {
    let (scene, mut replay) = recorded(recording, choice)?;
    let speed_of_light = replay.simulation().setup().world.speed_of_light_m_s();
    let spinner = progress::spinner(format!("riding {} again", recording.display()));
    let mut reel = Reel::new(frames_per_second, seconds.unwrap_or(f64::INFINITY));
    let mut differed = false;
    loop {
        match replay.next_frame() {
            Ok(Some(Replayed { frame, difference })) => {
                if let (Some(difference), false) = (difference, differed) {
                    differed = true;
                    eprintln!("{}", ReplayError::Differs { frame: frame.record.frame, difference });
                }
                if !reel.add(&frame)? {
                    break;
                }
            }
            Ok(None) => break,
            Err(error) if reel.moments.is_empty() => return Err(error.into()),
            Err(error) => {
                eprintln!("{error}");
                break;
            }
        }
    }
    spinner.finish_and_clear();
    Ok((scene, speed_of_light, reel.moments))
}

/// What the film will show: the observer at each picture's time.
struct Reel {
    moments: Vec<Moment>,
    last: Option<Moment>,
    frames_per_second: f64,
    end: Nanos,
}

impl Reel {
    fn new(frames_per_second: f64, seconds: f64) -> Self {
        Self { moments: Vec::new(), last: None, frames_per_second, end: (seconds * SECOND as f64) as Nanos }
    }

    /// When the next picture is due.
    fn due(&self) -> Nanos {
        (self.moments.len() as f64 * SECOND as f64 / self.frames_per_second) as Nanos
    }

    /// Takes a frame; pictures that were due before it show the frame before. Returns false once the film is full.
    fn add(&mut self, frame: &Frame) -> Result<bool, Error> {
        let newest = Moment { gaze: gaze(frame)?, own_s: frame.vehicle.odometer().own_s };
        while self.due() < frame.record.at.min(self.end) {
            self.moments.push(self.last.unwrap_or(newest));
        }
        if self.due() == frame.record.at && self.due() < self.end {
            self.moments.push(newest);
        }
        self.last = Some(newest);
        Ok(self.due() < self.end)
    }
}

/// Follows somebody who rides now, as the clock goes.
fn follow(options: &RideOptions, simulation: Simulation, log: Log, seconds: f64) -> Result<Reel, Error> {
    let options = RideOptions { seconds: Some(seconds), ..options.clone() };
    let mut live = present(&options, simulation, log)?;
    let stop = interrupted();
    let spinner = progress::spinner("riding");
    let mut reel = Reel::new(f64::from(FRAMES_PER_SECOND), seconds);
    let period = SECOND / Nanos::from(FRAMES_PER_SECOND * FRAMES_PER_PICTURE);
    while !stop.load(Ordering::Relaxed) {
        let Some(frame) = live.frame()? else { break };
        reel.add(&frame)?;
        let next = (frame.record.at / period + 1) * period;
        std::thread::sleep(Duration::from_nanos(next.saturating_sub(live.now())));
    }
    live.finish()?;
    spinner.finish_and_clear();
    for line in live.devices() {
        eprintln!("{line}");
    }
    Ok(reel)
}

/// Has the built-in rider ride, who needs no clock.
fn demonstrate(
    options: &RideOptions,
    scene: &Scene,
    mut simulation: Simulation,
    mut log: Log,
    seconds: f64,
) -> Result<Reel, Error> {
    let mut rider = Demonstrator::new(scene, &simulation);
    let mut reel = Reel::new(f64::from(FRAMES_PER_SECOND), seconds);
    let stop = interrupted();
    while !stop.load(Ordering::Relaxed) {
        let at = reel.due();
        let mut samples = rider.samples(&simulation, at);
        if at == 0 {
            samples.extend(first_actions(options).iter().map(|action| Sample::action(0, action)));
        }
        let frame = simulation.frame(at, &samples);
        log.frame(&samples, &frame)?;
        if !reel.add(&frame)? {
            break;
        }
    }
    log.finish()?;
    Ok(reel)
}

/// Who rides where nobody does: a cyclist who knows the way round, or a foot on the pedal.
enum Demonstrator {
    Cyclist(Box<Tour>),
    Foot { pressed: bool },
}

impl Demonstrator {
    fn new(scene: &Scene, simulation: &Simulation) -> Self {
        let setup = simulation.setup();
        match (setup.kind, Tour::new(&scene.circuit)) {
            (VehicleKind::Bicycle, Some(tour)) => Self::Cyclist(Box::new(tour)),
            _ => Self::Foot { pressed: false },
        }
    }

    /// What he does up to `at`.
    fn samples(&mut self, simulation: &Simulation, at: Nanos) -> Vec<Sample> {
        match self {
            Self::Cyclist(tour) => tour.samples(simulation.vehicle(), at),
            Self::Foot { pressed } if !*pressed => {
                *pressed = true;
                vec![Sample::key(at, Key::W, true)]
            }
            Self::Foot { .. } => Vec::new(),
        }
    }
}
