//! The observers of a ride at the times of a film's pictures.

use crate::error::Error;
use crate::output::progress;
use crate::output::say::tell;
use crate::session::gaps::ShownTimes;
use crate::session::outside_look::OutsideLook;
use crate::session::start::{PRESENTATION, recorded};
use crate::session::tour_ride::TourMark;
use command::WorldOptions;
use input::recording::RecordingError;
use input::{Action, Nanos, SECOND};
use interface::Caption;
use presentation::Presentation;
use render::display::Development;
use ride::{ReplayError, Replayed, RideFrame};
use scene::{Scene, Start};
use std::path::Path;
use std::sync::Arc;
use view::{Effects, Gaze, OutsideView};

/// Pictures per second of a film of a ride.
pub const FRAMES_PER_SECOND: u32 = 30;

/// How a moment is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Effects of relativity.
    pub effects: Effects,
    /// Vertical field of view, degrees.
    pub fov_deg: f64,
    /// Development of radiance into the picture.
    pub development: Development,
    /// Camera outside of the eye.
    pub outside: Option<OutsideView>,
}

/// Observer of one picture, its time by the observer's own clock, and how it is shown.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Observer and direction of view.
    pub gaze: Gaze,
    /// Proper time of the observer, seconds.
    pub own_s: f64,
    /// How it is shown.
    pub look: Look,
    /// What is written over it.
    pub told: Option<Arc<Told>>,
}

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

impl Look {
    /// Look of a presentation, with its camera outside of the eye.
    pub fn of(shown: &Presentation, outside: Option<OutsideView>) -> Self {
        let Presentation { effects, fov_deg, development, .. } = *shown;
        Self { effects, fov_deg, development, outside }
    }
}

/// Recorded ride that was ridden again.
pub struct Ridden {
    /// Scene of the ride.
    pub scene: Scene,
    /// Speed of light in it, metres per second.
    pub speed_of_light: f64,
    /// Observers at the times of the pictures.
    pub reel: Reel,
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
    let mut reel = Reel::new(frames_per_second, seconds.unwrap_or(f64::INFINITY), shown);
    reel.follows = !is_given;
    let mut differed = false;
    loop {
        match replay.next_frame() {
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
            Err(error) if reel.len() == 0 => return Err(error.into()),
            Err(error) => {
                tell(error);
                break;
            }
        }
    }
    spinner.finish_and_clear();
    if let Some(gaps) = reel.times.sentence() {
        tell(format_args!("{}: {gaps}", recording.display()));
    }
    Ok(Ridden { scene, speed_of_light, reel })
}

/// Observer at the time of each picture of a film. Memory is taken for each frame of the ride, not for each picture.
pub struct Reel {
    /// Moments of the ride, each with its number of pictures.
    moments: Vec<(Moment, u64)>,
    /// Number of pictures so far.
    count: u64,
    last: Option<Moment>,
    times: ShownTimes,
    frames_per_second: f64,
    end: Nanos,
    /// How the ride is shown at present.
    shown: Presentation,
    outside: OutsideLook,
    /// True if the rider's actions change it.
    follows: bool,
}

impl Reel {
    /// Reel for a film of `seconds` at `frames_per_second` that begins as `shown`.
    pub fn new(frames_per_second: f64, seconds: f64, shown: Presentation) -> Self {
        let end = (seconds * SECOND as f64) as Nanos;
        Self {
            moments: Vec::new(),
            count: 0,
            last: None,
            times: ShownTimes::default(),
            frames_per_second,
            end,
            shown,
            outside: OutsideLook::default(),
            follows: true,
        }
    }

    /// Time at which the next picture is due.
    pub fn due(&self) -> Nanos {
        (self.count as f64 * SECOND as f64 / self.frames_per_second) as Nanos
    }

    /// Takes a frame; pictures that were due before it show the frame before. Returns false once the film is full.
    pub fn add(&mut self, frame: &RideFrame) -> bool {
        self.add_told(frame, |_| None)
    }

    /// Takes a frame, with what is written over it. Returns false once the film is full.
    pub fn add_told(&mut self, frame: &RideFrame, told: impl FnOnce(&Presentation) -> Option<Told>) -> bool {
        for action in frame.controls.actions.iter().filter(|action| self.follows && Presentation::repeats(action)) {
            match action {
                Action::Orbit { turn_rad, closer } => self.outside.orbit(*turn_rad, *closer),
                action => drop(self.shown.act(action)),
            }
        }
        let (gaze, outside) = self.outside.follow(&frame.gaze, &self.shown);
        let own_s = frame.vehicle.odometer().own_s;
        let newest =
            Moment { gaze, own_s, look: Look::of(&self.shown, outside), told: told(&self.shown).map(Arc::new) };
        let at = self.times.shown(frame.record.at);
        self.put(self.last.clone().unwrap_or_else(|| newest.clone()), |due, end| due < at.min(end));
        self.put(newest.clone(), |due, end| due == at && due < end);
        self.last = Some(newest);
        self.due() < self.end
    }

    /// Adds pictures of a moment as long as `wanted` says so of the time at which one is due, and of the film's end.
    fn put(&mut self, moment: Moment, wanted: impl Fn(Nanos, Nanos) -> bool) {
        let before = self.count;
        while wanted(self.due(), self.end) {
            self.count += 1;
        }
        if self.count > before {
            self.moments.push((moment, self.count - before));
        }
    }

    /// Number of pictures.
    pub fn len(&self) -> u64 {
        self.count
    }

    /// Moment of the last picture.
    pub fn last(&self) -> Option<Moment> {
        self.moments.last().map(|(moment, _)| moment.clone())
    }

    /// Moments of all pictures, one after the other.
    pub fn pictures(self) -> impl Iterator<Item = Moment> {
        self.moments.into_iter().flat_map(|(moment, pictures)| std::iter::repeat_n(moment, pictures as usize))
    }

    /// Moments of `count` pictures, evenly spread, each from the middle of its part; of all pictures if there are
    /// fewer.
    pub fn evenly(&self, count: u32) -> impl Iterator<Item = Moment> {
        let count = u64::from(count).min(self.count);
        let mut moments = self.moments.iter();
        let (mut moment, mut end): (Option<&Moment>, u128) = (None, 0);
        (0..count).filter_map(move |number| {
            let place = u128::from(2 * number + 1) * u128::from(self.count) / u128::from(2 * count);
            while end <= place {
                let (next, pictures) = moments.next()?;
                (moment, end) = (Some(next), end + u128::from(*pictures));
            }
            moment.cloned()
        })
    }
}

#[cfg(test)]
mod tests {
    //! Law: a film has as many pictures as the ride has time, and shows in each the newest frame before it; the work is
    //! bounded by the frames of the ride, whatever times they bear.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use glam::DVec3;
    use input::{DeskConfig, VehicleKind};
    use ride::{LightSpeed, RideStart, Setup, Simulation, VehicleSettings};
    use scene::collision::Collision;
    use std::sync::Arc;

    const YEAR: Nanos = 365 * 24 * 3600 * SECOND;

    fn reel(frames_per_second: f64, seconds: f64, times: &[Nanos]) -> Reel {
        let setup = Setup {
            light_speed: LightSpeed::OLD_TOWN,
            kind: VehicleKind::Fly,
            start: RideStart::at_rest(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y),
            vehicle: VehicleSettings::default(),
            desk: DeskConfig::default(),
        };
        let lattice = built_in::lattice::Lattice::default().build();
        let mut ride = Simulation::new(setup, Arc::new(Collision::new(&lattice).unwrap())).unwrap();
        let mut reel = Reel::new(frames_per_second, seconds, Presentation::default());
        for at in times {
            let mut frame = ride.frame(*at, &[]);
            // The place tells the frame.
            frame.gaze.observer.event.ct = *at as f64;
            if !reel.add(&frame) {
                break;
            }
        }
        reel
    }

    /// Recorded times of the frames that the pictures show.
    fn shown(reel: Reel) -> Vec<u64> {
        reel.pictures().map(|moment| moment.gaze.observer.event.ct as u64).collect()
    }

    #[test]
    fn each_picture_shows_the_newest_frame_before_it() {
        let times = [0, SECOND / 4, SECOND / 2, SECOND];
        assert_eq!(shown(reel(4.0, f64::INFINITY, &times)), [0, SECOND / 4, SECOND / 2, SECOND / 2, SECOND]);
        assert_eq!(shown(reel(2.0, f64::INFINITY, &times)), [0, SECOND / 2, SECOND]);
        assert_eq!(shown(reel(4.0, 0.5, &times)), [0, SECOND / 4]);
    }

    #[test]
    fn a_year_between_two_frames_is_a_second_of_film() {
        let reel = reel(1000.0, f64::INFINITY, &[0, YEAR, 2 * YEAR]);
        assert_eq!((reel.len(), reel.moments.len()), (2001, 5));
        assert_eq!(reel.last().unwrap().gaze.observer.event.ct as u64, 2 * YEAR);
        assert!(reel.times.sentence().unwrap().contains("2 gaps"));
    }

    #[test]
    fn pictures_are_taken_evenly() {
        let times: Vec<Nanos> = (0..100).map(|frame| frame * SECOND).collect();
        let evenly = |rate: f64, count| {
            let reel = reel(rate, f64::INFINITY, &times);
            let moments: Vec<u64> = reel.evenly(count).map(|moment| moment.gaze.observer.event.ct as u64).collect();
            moments.into_iter().map(|at| at / SECOND).collect::<Vec<_>>()
        };
        assert_eq!(evenly(1.0, 5), [10, 30, 50, 70, 90]);
        assert_eq!(evenly(1.0, 1000).len(), 100);
        assert_eq!(evenly(10.0, 5), [9, 29, 49, 69, 89]);
    }
}
