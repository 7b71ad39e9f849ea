//! Recorded rides, ridden again for pictures.

use crate::error::Error;
use crate::output::progress;
use crate::output::say::tell;
use crate::session::start::{PRESENTATION, recorded};
use crate::session::tour_ride::TourMark;
use command::WorldOptions;
use filming::Reel;
use input::recording::RecordingError;
use interface::Caption;
use presentation::Presentation;
use ride::{ReplayError, Replayed, RideFrame};
use scene::{Scene, Start};
use std::path::Path;

/// Pictures per second of a film of a ride.
pub const FRAMES_PER_SECOND: u32 = 30;

/// What a film writes over its pictures.
#[derive(Clone, Debug)]
pub struct Told {
    /// Frame of the ride, for the instruments.
    pub frame: RideFrame,
    /// Instruments that are shown, and the language.
    pub presentation: Presentation,
    /// Caption of a tour.
    pub caption: Option<Caption>,
    /// Events of the tour, each told once.
    pub marks: Vec<TourMark>,
}

/// Recorded ride that was ridden again.
pub struct Ridden {
    /// Scene of the ride.
    pub scene: Scene,
    /// Speed of light in it, metres per second.
    pub speed_of_light: f64,
    /// Observers at the times of the pictures.
    pub reel: Reel<Told>,
}

/// Rides a recorded ride again, for pictures at the rate of a film.
///
/// The ride is shown as its rider saw it, or by `shown` if the pictures are to look otherwise. A recording that is
/// damaged or differs is followed as far as possible, with a line on standard error.
///
/// # Errors
/// A recording or a scene that cannot be read at all.
pub fn reel(
    recording: &Path,
    options: &WorldOptions,
    (frames_per_second, seconds): (f64, Option<f64>),
    shown: impl FnOnce(&Start) -> (Presentation, bool),
) -> Result<Ridden, Error> {
    let (scene, mut replay) = recorded(recording, options)?;
    let (shown, is_given) = shown(&scene.start);
    let of_rider = replay.header_setting(PRESENTATION).filter(|_| !is_given);
    let shown = of_rider.map_or(shown, |json| shown.with_json(json));
    let speed_of_light = replay.simulation().setup().light_speed.speed_of_light_m_s();
    let spinner = progress::spinner(format!("riding {} again", recording.display()));
    let mut reel: Reel<Told> = Reel::new(frames_per_second, seconds.unwrap_or(f64::INFINITY), shown);
    reel.follows = !is_given;
    let mut differed = false;
    loop {
        match replay.next_frame_for(Some(&mut reel)) {
            Ok(Some(Replayed { frame, difference })) => {
                if let (Some(difference), false) = (difference, differed) {
                    differed = true;
                    tell(ReplayError::Differs { frame: frame.record.frame, difference });
                }
                if !reel.add(&frame) {
                    break;
                }
            }
            Ok(None) => {
                if let Some(offset) = replay.another() {
                    tell(RecordingError::Another { path: recording.to_owned(), offset });
                }
                break;
            }
            Err(error) if reel.is_empty() => return Err(error.into()),
            Err(error) => {
                tell(error);
                break;
            }
        }
    }
    spinner.finish_and_clear();
    if let Some(gaps) = reel.gaps() {
        tell(format_args!("{}: {gaps}", recording.display()));
    }
    Ok(Ridden { scene, speed_of_light, reel })
}
