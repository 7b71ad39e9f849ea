//! The observers of a ride at the times of a film's pictures.

use crate::command::WorldOptions;
use crate::error::Error;
use crate::output::progress;
use crate::session::start::recorded;
use input::{Nanos, SECOND};
use ride::{ReplayError, Replayed, RideFrame};
use scene::Scene;
use std::path::Path;
use view::Gaze;

/// Observer of one picture, and its time by the observer's own clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Observer and direction of view.
    pub gaze: Gaze,
    /// Proper time of the observer, seconds.
    pub own_s: f64,
}

/// Scene of a recorded ride, its speed of light in metres per second, and the observer at each picture's time.
///
/// A recording that is damaged or differs is followed as far as possible, with a line on standard error.
///
/// # Errors
/// A recording or a scene that cannot be read at all.
pub fn reel(
    recording: &Path,
    options: &WorldOptions,
    frames_per_second: f64,
    seconds: Option<f64>,
) -> Result<(Scene, f64, Vec<Moment>), Error> {
    let (scene, mut replay) = recorded(recording, options)?;
    let speed_of_light = replay.simulation().setup().light_speed.speed_of_light_m_s();
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
                if !reel.add(&frame) {
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

/// Observer at the time of each picture of a film.
pub struct Reel {
    /// Observers of the pictures so far.
    pub moments: Vec<Moment>,
    last: Option<Moment>,
    frames_per_second: f64,
    end: Nanos,
}

impl Reel {
    /// Reel for a film of `seconds` at `frames_per_second`.
    pub fn new(frames_per_second: f64, seconds: f64) -> Self {
        Self { moments: Vec::new(), last: None, frames_per_second, end: (seconds * SECOND as f64) as Nanos }
    }

    /// Time at which the next picture is due.
    pub fn due(&self) -> Nanos {
        (self.moments.len() as f64 * SECOND as f64 / self.frames_per_second) as Nanos
    }

    /// Takes a frame; pictures that were due before it show the frame before. Returns false once the film is full.
    pub fn add(&mut self, frame: &RideFrame) -> bool {
        let newest = Moment { gaze: frame.gaze, own_s: frame.vehicle.odometer().own_s };
        while self.due() < frame.record.at.min(self.end) {
            self.moments.push(self.last.unwrap_or(newest));
        }
        if self.due() == frame.record.at && self.due() < self.end {
            self.moments.push(newest);
        }
        self.last = Some(newest);
        self.due() < self.end
    }
}
