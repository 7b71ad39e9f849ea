//! `rapidity ride`: prepares the ride, and opens a window on it, or films it if there is no graphical session.

use crate::commands::ride_film;
use crate::error::Error;
use crate::output::progress;
use crate::output::say::{say, tell};
use crate::session::preferences;
use crate::session::start::{RideRoom, has_display, recorded};
use crate::session::waiting::WaitingRide;
use crate::window;
use command::RideOptions;
use input::recording::RecordingError;
use picture_files::files::writable;
use std::path::{Path, PathBuf};

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
        return window::run(WaitingRide::of(options, room)?);
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
