//! A ride without a window: ridden first, filmed afterwards.
//!
//! Drawing may be slower than riding, and devices do not wait; so whoever rides live is followed by the clock, and the
//! film is drawn when he has arrived. A recorded rider and the built-in tour need no clock.

use crate::command::RideOptions;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::live::{Live, gaze};
use crate::log::Log;
use crate::progress;
use crate::render::{Cameraman, interrupted};
use crate::ride::{devices_config, first_actions, prepared, recorded};
use crate::scene::{Scene, source};
use crate::simulation::{Frame, Simulation, Tour};
use crate::views::Gaze;
use input::devices::Devices;
use input::{Clock, Key, Nanos, SECOND, Sample, VehicleKind};
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
    let seconds = options.seconds.unwrap_or(if options.replay.is_some() { f64::INFINITY } else { SECONDS });
    let (scene, gazes) = match &options.replay {
        Some(recording) => {
            let (scene, mut replay) = recorded(recording, &options.world.scene)?;
            let spinner = progress::spinner(format!("riding {} again", recording.display()));
            let mut reel = Reel::new(seconds);
            while let Some(replayed) = replay.next_frame()? {
                if !reel.add(&replayed.frame)? {
                    break;
                }
            }
            spinner.finish_and_clear();
            (scene, reel.gazes)
        }
        None => {
            let scene = source::load(&options.world.scene)?;
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
            (scene, reel.gazes)
        }
    };
    let scene = source::refined(&scene, options.world.edge)?;
    let mut camera = Cameraman::new(&gpu, &scene, &options.picture)?;
    camera.film(gazes.into_iter(), f64::from(FRAMES_PER_SECOND), path)
}

/// What the film will show: the observer at each picture's time.
struct Reel {
    gazes: Vec<Gaze>,
    last: Option<Gaze>,
    seconds: f64,
}

impl Reel {
    fn new(seconds: f64) -> Self {
        Self { gazes: Vec::new(), last: None, seconds }
    }

    /// When the next picture is due.
    fn due(&self) -> Nanos {
        self.gazes.len() as Nanos * SECOND / Nanos::from(FRAMES_PER_SECOND)
    }

    /// Takes a frame; pictures that were due before it show the frame before. Returns false once the film is full.
    fn add(&mut self, frame: &Frame) -> Result<bool, Error> {
        let newest = gaze(frame)?;
        while self.due() < frame.record.at {
            self.gazes.push(self.last.unwrap_or(newest));
        }
        if self.due() == frame.record.at {
            self.gazes.push(newest);
        }
        self.last = Some(newest);
        Ok(self.due() as f64 <= self.seconds * SECOND as f64)
    }
}

/// Follows somebody who rides now, as the clock goes.
fn follow(options: &RideOptions, simulation: Simulation, log: Log, seconds: f64) -> Result<Reel, Error> {
    let clock = Clock::start();
    let devices = Devices::open(&devices_config(options), clock)?;
    let mut live = Live::present(simulation, devices, clock, log, Some(seconds));
    for action in first_actions(options) {
        live.say(|at| Sample::action(at, &action));
    }
    let stop = interrupted();
    let spinner = progress::spinner("riding");
    let mut reel = Reel::new(seconds);
    let period = SECOND / Nanos::from(FRAMES_PER_SECOND * FRAMES_PER_PICTURE);
    while !stop.load(Ordering::Relaxed) {
        let Some(frame) = live.frame()? else { break };
        reel.add(&frame)?;
        let next = (frame.record.at / period + 1) * period;
        std::thread::sleep(Duration::from_nanos(next.saturating_sub(clock.now())));
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
    let mut reel = Reel::new(seconds);
    loop {
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
