//! A ride without its picture: where samples come from, the simulation they drive, the log they leave.
//!
//! Frames come from live devices and the window's keys, as the clock goes; or from a recording, shown at the pace at
//! which it was ridden. Either way the caller asks once a frame and gets the observer.

use crate::error::Error;
use crate::log::Log;
use crate::simulation::{Frame, Replay, Simulation};
use crate::views::Gaze;
use input::devices::{Devices, State};
use input::{Clock, Nanos, SECOND, Sample};
use physics::photo_surface::Eye;
use std::path::{Path, PathBuf};

/// How long a notice stays in sight.
const NOTICE_TIME: Nanos = 4 * SECOND;

/// A ride in progress.
pub struct Live {
    clock: Clock,
    rider: Rider,
    end: Option<Nanos>,
    said: Vec<Sample>,
    told: Vec<(Nanos, String)>,
}

/// Who rides.
enum Rider {
    /// Somebody at the devices.
    Present { simulation: Box<Simulation>, devices: Box<Devices>, log: Box<Log> },
    /// Somebody who was here before.
    Recorded { replay: Box<Replay>, next: Option<Box<Frame>> },
}

impl Live {
    /// A rider at `devices`, whose clock must be `clock`; the ride ends after `seconds`, if given.
    pub fn present(simulation: Simulation, devices: Devices, clock: Clock, log: Log, seconds: Option<f64>) -> Self {
        let rider = Rider::Present { simulation: Box::new(simulation), devices: Box::new(devices), log: Box::new(log) };
        Self::new(rider, clock, seconds)
    }

    /// A recorded rider, from now on.
    pub fn recorded(replay: Replay, seconds: Option<f64>) -> Self {
        Self::new(Rider::Recorded { replay: Box::new(replay), next: None }, Clock::start(), seconds)
    }

    fn new(rider: Rider, clock: Clock, seconds: Option<f64>) -> Self {
        let end = seconds.map(|seconds| (seconds * SECOND as f64) as Nanos);
        Self { clock, rider, end, said: Vec::new(), told: Vec::new() }
    }

    /// Takes what the window or the panel says, stamped with the time it is said at.
    pub fn say(&mut self, sample: impl FnOnce(Nanos) -> Sample) {
        self.said.push(sample(self.clock.now()));
    }

    /// Tells the rider something.
    pub fn tell(&mut self, sentence: impl Into<String>) {
        self.told.push((self.clock.now() + NOTICE_TIME, sentence.into()));
    }

    /// The ride now, or `None` at its end.
    ///
    /// # Errors
    /// A recording that differs or is damaged.
    pub fn frame(&mut self) -> Result<Option<Frame>, Error> {
        let now = self.clock.now();
        self.told.retain(|(until, _)| *until > now);
        if self.end.is_some_and(|end| now >= end) {
            return Ok(None);
        }
        let frame = match &mut self.rider {
            Rider::Present { simulation, devices, log } => {
                let mut samples = devices.drain();
                samples.append(&mut self.said);
                samples.sort_by_key(|sample| sample.at);
                let frame = simulation.frame(now, &samples);
                devices.brake(frame.vehicle.resistance());
                if let Err(error) = log.frame(&samples, &frame) {
                    self.told.push((now + NOTICE_TIME, error.to_string()));
                }
                Some(frame)
            }
            Rider::Recorded { replay, next } => {
                self.said.clear();
                // Frames that were ridden since the last look are gone through, and the last of them is shown.
                let mut shown = None;
                loop {
                    let frame = match next.take() {
                        Some(frame) => *frame,
                        None => match replay.next_frame()? {
                            Some(replayed) => replayed.frame,
                            None => break shown,
                        },
                    };
                    if frame.record.at > now {
                        let shown = shown.or_else(|| Some(frame.clone()));
                        *next = Some(Box::new(frame));
                        break shown;
                    }
                    shown = Some(frame);
                }
            }
        };
        if let Some(frame) = &frame {
            for notice in &frame.notices {
                self.tell(notice.to_string());
            }
        }
        Ok(frame)
    }

    /// Sentences for the rider, newest last.
    pub fn told(&self) -> Vec<String> {
        self.told.iter().map(|(_, sentence)| sentence.clone()).collect()
    }

    /// A sentence for each device.
    pub fn devices(&self) -> Vec<String> {
        match &self.rider {
            Rider::Recorded { .. } => vec!["a recorded ride".to_owned()],
            Rider::Present { simulation, devices, .. } => devices
                .status()
                .into_iter()
                .map(|status| match status.state {
                    State::Open => {
                        let bad = simulation.desk().faults(status.source).number();
                        format!("{}: {} at {:.0} Hz, {bad} bad", status.source, status.name, status.rate_hz)
                    }
                    State::Absent(why) => format!("{}: {why}", status.source),
                })
                .collect(),
        }
    }

    /// Whether a recording is being written.
    pub fn is_recording(&self) -> bool {
        matches!(&self.rider, Rider::Present { log, .. } if log.is_recording())
    }

    /// Records from the ride's beginning into `path`.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn record(&mut self, path: &Path) -> Result<(), Error> {
        match &mut self.rider {
            Rider::Present { log, .. } => log.record(path),
            Rider::Recorded { .. } => Ok(()),
        }
    }

    /// Starts or ends a recording, and tells the rider.
    pub fn toggle_recording(&mut self) {
        let told = if self.is_recording() {
            match self.finish() {
                Ok(()) => "the recording is complete".to_owned(),
                Err(error) => error.to_string(),
            }
        } else {
            let path = unused("ride", "mcap");
            match self.record(&path) {
                Ok(()) => format!("recording, from the ride's beginning, into {}", path.display()),
                Err(error) => error.to_string(),
            }
        };
        self.tell(told);
    }

    /// Completes the recording.
    ///
    /// # Errors
    /// The rest cannot be written.
    pub fn finish(&mut self) -> Result<(), Error> {
        match &mut self.rider {
            Rider::Present { log, .. } => log.finish(),
            Rider::Recorded { .. } => Ok(()),
        }
    }
}

/// What the observer of a frame sees from where.
///
/// # Errors
/// A place that is not finite, which a simulation never yields.
pub fn gaze(frame: &Frame) -> Result<Gaze, Error> {
    let observer = frame.eye.observer;
    let eye = Eye::new(observer.event.position, observer.celerity.vector())?;
    Ok(Gaze { eye, observer_from_eye: frame.eye.orientation })
}

/// The first of `stem-001.extension`, `stem-002.extension`, … that is not there yet.
pub fn unused(stem: &str, extension: &str) -> PathBuf {
    (1_u32..)
        .map(|number| PathBuf::from(format!("{stem}-{number:03}.{extension}")))
        .find(|path| !path.exists())
        .expect("there are more numbers than files")
}
