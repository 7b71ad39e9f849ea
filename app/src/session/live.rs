//! A ride without its picture: where samples come from, the simulation they drive, the log they leave.
//!
//! Frames come from live devices and the window's keys, as the clock goes; or from a recording, shown at the pace at
//! which it was ridden. Either way the caller asks once a frame and gets the observer.

use crate::error::Error;
use crate::log::Log;
use crate::simulation::{Frame, Replay, ReplayError, Replayed, Simulation};
use crate::views::Gaze;
use input::devices::{Devices, State};
use input::{Action, Clock, Desk, DeskConfig, Nanos, SECOND, Sample};
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
    Recorded { replay: Box<Replay>, next: Option<Box<Frame>>, shown: Option<Box<Frame>>, differed: bool },
}

impl Live {
    /// A rider at `devices`, whose clock must be `clock`; the ride ends after `seconds`, if given.
    pub fn present(simulation: Simulation, devices: Devices, clock: Clock, log: Log, seconds: Option<f64>) -> Self {
        let rider = Rider::Present { simulation: Box::new(simulation), devices: Box::new(devices), log: Box::new(log) };
        Self::new(rider, clock, seconds)
    }

    /// A recorded rider, from now on.
    pub fn recorded(replay: Replay, seconds: Option<f64>) -> Self {
        let replay = Box::new(replay);
        Self::new(Rider::Recorded { replay, next: None, shown: None, differed: false }, Clock::start(), seconds)
    }

    fn new(rider: Rider, clock: Clock, seconds: Option<f64>) -> Self {
        let end = seconds.map(|seconds| (seconds * SECOND as f64) as Nanos);
        Self { clock, rider, end, said: Vec::new(), told: Vec::new() }
    }

    /// The ride's time.
    pub fn now(&self) -> Nanos {
        self.clock.now()
    }

    /// Takes what the window or the panel says, stamped with the time it is said at.
    pub fn say(&mut self, sample: impl FnOnce(Nanos) -> Sample) {
        self.said.push(sample(self.clock.now()));
    }

    /// Tells the rider something.
    pub fn tell(&mut self, sentence: impl Into<String>) {
        let sentence = sentence.into();
        self.told.retain(|(_, told)| *told != sentence);
        self.told.push((self.clock.now() + NOTICE_TIME, sentence));
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
            Rider::Recorded { replay, next, shown, differed } => {
                let said = std::mem::take(&mut self.said);
                // Frames that were ridden since the last look are gone through, and the last of them is shown.
                let ended = loop {
                    let frame = match next.take() {
                        Some(frame) => *frame,
                        None => match replay.next_frame() {
                            Ok(Some(Replayed { frame, difference })) => {
                                if let (Some(difference), false) = (difference, *differed) {
                                    *differed = true;
                                    let frame = frame.record.frame;
                                    let sentence = ReplayError::Differs { frame, difference }.to_string();
                                    self.told.push((Nanos::MAX, sentence));
                                }
                                frame
                            }
                            Ok(None) => break true,
                            Err(error) if shown.is_none() => return Err(error.into()),
                            Err(error) => {
                                eprintln!("{error}");
                                break true;
                            }
                        },
                    };
                    let due = frame.record.at <= now;
                    if due || shown.is_none() {
                        *shown = Some(Box::new(frame));
                    } else {
                        *next = Some(Box::new(frame));
                    }
                    if !due {
                        break false;
                    }
                };
                // What the rider pressed then is not done again; what the onlooker presses now is.
                let mut frame = if ended && next.is_none() { None } else { shown.as_deref().cloned() };
                if let Some(frame) = &mut frame {
                    frame.controls.actions = onlooker(&said);
                }
                frame
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

/// The actions that an onlooker of a recorded ride may want: they concern the window alone.
fn onlooker(said: &[Sample]) -> Vec<Action> {
    let mut desk = Desk::new(DeskConfig::default()).expect("the default settings are sound");
    said.iter().for_each(|sample| desk.feed(sample));
    let actions = desk.controls(said.last().map_or(0, |sample| sample.at)).actions;
    actions.into_iter().filter(|action| matches!(action, Action::ToggleHelp | Action::Photo)).collect()
}

/// What the observer of a frame sees from where.
///
/// # Errors
/// A place that is not finite, which a simulation never yields.
pub fn gaze(frame: &Frame) -> Result<Gaze, Error> {
    let observer = frame.eye.observer;
    let eye = Eye::new(observer.event.position, observer.celerity.vector())?;
    Ok(Gaze { eye, ct: observer.event.ct, observer_from_eye: frame.eye.orientation })
}

/// The first of `stem-001.extension`, `stem-002.extension`, … that is not there yet.
pub fn unused(stem: &str, extension: &str) -> PathBuf {
    (1_u32..)
        .map(|number| PathBuf::from(format!("{stem}-{number:03}.{extension}")))
        .find(|path| !path.exists())
        .expect("there are more numbers than files")
}
