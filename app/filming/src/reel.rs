//! The observers of a ride at the times of a film's pictures: each picture shows the ride as it was at its own time,
//! whatever the times of the ride's frames, and through the tracked head if there is one.

use crate::moment::{Look, Moment};
use crate::outside_look::OutsideLook;
use input::{Action, Nanos, SECOND};
use presentation::Presentation;
use ride::{FrameTaker, RideFrame, ShownTimes};
use std::sync::Arc;
use view::OpenShutter;

/// Observer at the time of each picture of a film, taken on the way from one frame of a ride to the next. Memory is
/// taken for what differs: pictures of a ride that waits share one moment.
pub struct Reel<T = ()> {
    /// Moments of the ride, each with its number of pictures.
    moments: Vec<(Moment<T>, u64)>,
    /// Number of pictures so far.
    count: u64,
    times: ShownTimes,
    frames_per_second: f64,
    end: Nanos,
    /// How the ride is shown at present.
    shown: Presentation,
    outside: OutsideLook,
    /// True if the rider's actions change how it is shown.
    pub follows: bool,
    /// Number of actions that have been performed since the ride's last frame.
    acted: usize,
}

impl<T> Reel<T> {
    /// Reel for a film of `seconds` at `frames_per_second` that begins as `shown`.
    pub fn new(frames_per_second: f64, seconds: f64, shown: Presentation) -> Self {
        let end = (seconds * SECOND as f64) as Nanos;
        Self {
            moments: Vec::new(),
            count: 0,
            times: ShownTimes::default(),
            frames_per_second,
            end,
            shown,
            outside: OutsideLook::default(),
            follows: true,
            acted: 0,
        }
    }

    /// Time at which the next picture is due.
    pub fn due(&self) -> Nanos {
        self.due_after(self.count)
    }

    fn due_after(&self, pictures: u64) -> Nanos {
        (pictures as f64 * SECOND as f64 / self.frames_per_second) as Nanos
    }

    /// Takes note of a frame of the ride, whose pictures have been taken. Returns false once the film is full.
    pub fn add(&mut self, frame: &RideFrame) -> bool {
        self.follow(frame);
        self.acted = 0;
        self.due() < self.end
    }

    /// Takes a picture of a frame that is due, with what is written over it. Returns false once the film is full.
    pub fn add_told(&mut self, frame: &RideFrame, told: impl FnOnce(&Presentation) -> Option<T>) -> bool {
        let moment = self.follow(frame);
        let told = told(&self.shown).map(Arc::new);
        self.put(Moment { told, ..moment });
        self.acted = 0;
        self.due() < self.end
    }

    /// Performs the frame's actions that decide what is shown and have not been performed, and returns its moment.
    fn follow(&mut self, frame: &RideFrame) -> Moment<T> {
        let actions = frame.controls.actions.get(self.acted..).unwrap_or_default();
        self.acted = frame.controls.actions.len();
        for action in actions.iter().filter(|action| self.follows && Presentation::repeats(action)) {
            match action {
                Action::Orbit { turn_rad, closer } => self.outside.orbit(*turn_rad, *closer),
                action => drop(self.shown.act(action)),
            }
        }
        let (gaze, outside) = self.outside.follow(&frame.head_gaze(), &self.shown);
        Moment {
            gaze,
            own_s: frame.vehicle.odometer().own_s,
            look: Look::of(&self.shown, outside),
            exposure: OpenShutter::default(),
            told: None,
        }
    }

    /// Adds a picture of a moment.
    fn put(&mut self, moment: Moment<T>) {
        self.count += 1;
        match self.moments.last_mut() {
            Some((last, pictures)) if last.is_as(&moment) => *pictures += 1,
            _ => self.moments.push((moment, 1)),
        }
    }

    /// Sentence about gaps of the ride, which are shown shorter, if there were any.
    pub fn gaps(&self) -> Option<String> {
        self.times.sentence()
    }

    /// True if there are no pictures.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Number of pictures.
    pub fn len(&self) -> u64 {
        self.count
    }

    /// Moment of the last picture.
    pub fn last(&self) -> Option<Moment<T>> {
        self.moments.last().map(|(moment, _)| moment.clone())
    }

    /// Moments of all pictures, one after the other.
    pub fn pictures(self) -> impl Iterator<Item = Moment<T>> {
        self.moments.into_iter().flat_map(|(moment, pictures)| std::iter::repeat_n(moment, pictures as usize))
    }

    /// Moments of pictures through a shutter that is open for `shutter_s` seconds of own time. The reel must have
    /// `finer` moments for each picture: the eye's worldline while the shutter is open is taken from them.
    pub fn exposed(self, finer: u64, shutter_s: f64) -> impl Iterator<Item = Moment<T>> {
        /// Parts of an exposure between gazes.
        const PARTS: i32 = 8;
        let rate = self.frames_per_second;
        let all: Vec<Moment<T>> = self.pictures().collect();
        let gaze = move |all: &[Moment<T>], place: f64| {
            let place = place.clamp(0.0, (all.len() - 1) as f64);
            let first = place.floor() as usize;
            all[first].gaze.towards(&all[(first + 1).min(all.len() - 1)].gaze, place - first as f64)
        };
        (0..all.len()).step_by(finer as usize).map(move |number| {
            let share = |part: i32| (f64::from(part) / f64::from(PARTS) - 0.5) * shutter_s * rate;
            let gazes = (0..=PARTS).map(|part| gaze(&all, number as f64 + share(part))).collect();
            Moment { exposure: OpenShutter::along(gazes), ..all[number].clone() }
        })
    }

    /// Moments of `count` pictures, evenly spread, each from the middle of its part; of all pictures if there are
    /// fewer.
    pub fn evenly(&self, count: u32) -> impl Iterator<Item = Moment<T>> {
        let count = u64::from(count).min(self.count);
        let mut moments = self.moments.iter();
        let (mut moment, mut end): (Option<&Moment<T>>, u128) = (None, 0);
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

impl<T> FrameTaker for Reel<T> {
    fn wanted(&mut self, at: Nanos) -> Vec<Nanos> {
        let shown = self.times.shown(at);
        let due = (self.count..).map(|pictures| self.due_after(pictures));
        due.take_while(|due| *due <= shown && *due < self.end).map(|due| self.times.recorded(due, at)).collect()
    }

    fn take(&mut self, frame: RideFrame) {
        let moment = self.follow(&frame);
        self.put(moment);
    }
}

#[cfg(test)]
mod tests {
    //! Law: a film has as many pictures as the ride has time, and shows in each the ride at its own time; the work is
    //! bounded by the frames of the ride, whatever times they bear.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use glam::DVec3;
    use input::{DeskConfig, KeyboardKey, Sample, VehicleKind};
    use ride::{LightSpeed, RideStart, Setup, Simulation, VehicleSettings};
    use scene::OpenPlane;
    use std::sync::Arc;
    use view::Gaze;

    const YEAR: Nanos = 365 * 24 * 3600 * SECOND;

    /// Film of a flight with these samples and frame times.
    fn filmed(frames_per_second: f64, seconds: f64, times: &[Nanos], samples: &[Sample]) -> Reel {
        let setup = Setup {
            light_speed: LightSpeed::OLD_TOWN,
            kind: VehicleKind::Fly,
            start: RideStart::at_rest(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y),
            vehicle: VehicleSettings::default(),
            desk: DeskConfig::default(),
        };
        let mut ride = Simulation::new(setup, Arc::new(OpenPlane)).unwrap();
        let mut reel = Reel::new(frames_per_second, seconds, Presentation::default());
        let mut before = None;
        for at in times {
            let due = samples.iter().filter(|sample| before < Some(sample.at) && sample.at <= *at);
            let due: Vec<Sample> = due.cloned().collect();
            before = Some(*at);
            let frame = ride.frame_for(*at, &due, Some(&mut reel));
            if !reel.add(&frame) {
                break;
            }
        }
        reel
    }

    fn reel(frames_per_second: f64, seconds: f64, times: &[Nanos]) -> Reel {
        filmed(frames_per_second, seconds, times, &[])
    }

    /// Own times that the pictures show, seconds: at rest those of the ride, less the time for which the world waited.
    #[track_caller]
    fn assert_shows(reel: Reel, expected: &[f64]) {
        let shown: Vec<f64> = reel.pictures().map(|moment| moment.own_s).collect();
        let differs = |(shown, expected): (&f64, &f64)| (shown - expected).abs() > 1e-7;
        assert!(
            shown.len() == expected.len() && !shown.iter().zip(expected).any(differs),
            "{shown:?} for {expected:?}"
        );
    }

    #[test]
    fn each_picture_shows_its_own_time() {
        let times = [0, SECOND / 4, SECOND / 2, SECOND];
        assert_shows(reel(8.0, f64::INFINITY, &times[..3]), &[0.0, 0.125, 0.25, 0.375, 0.5]);
        assert_shows(reel(8.0, 0.3, &times), &[0.0, 0.125, 0.25]);
        // The world waits for a late frame, but for the last quarter of a second.
        let waited = 0.5 + 1.0 / 240.0;
        assert_shows(reel(8.0, 1.0, &times), &[0.0, 0.125, 0.25, 0.375, 0.5, waited, waited, 0.625]);
        assert_shows(reel(2.0, f64::INFINITY, &times), &[0.0, 0.5, 0.75]);
    }

    #[test]
    fn a_film_is_as_smooth_as_its_own_rate_whatever_that_of_the_ride() {
        let thrust = [Sample::key(SECOND / 10, KeyboardKey::W, true)];
        let film = |ride: u64| {
            let times: Vec<Nanos> = (0..=ride).map(|frame| frame * SECOND / ride).collect();
            filmed(120.0, f64::INFINITY, &times, &thrust)
        };
        let gazes: Vec<Gaze> = film(30).pictures().map(|moment| moment.gaze).collect();
        let direct: Vec<Gaze> = film(120).pictures().map(|moment| moment.gaze).collect();
        assert_eq!(gazes.len(), 121);
        assert!(gazes == direct, "the frames of the ride are seen in the film");
        let steps: Vec<f64> = gazes[40..]
            .windows(2)
            .map(|two| -(two[1].observer.event.position.z - two[0].observer.event.position.z))
            .collect();
        assert!(
            steps.iter().all(|step| *step > 0.0)
                && steps.windows(3).all(|three| { (three[2] - 2.0 * three[1] + three[0]).abs() < 3e-3 * three[1] }),
            "{steps:?}"
        );
    }

    #[test]
    fn what_a_rider_changes_is_shown_from_its_own_time_on() {
        let press = |key, at| [Sample::key(at, key, true), Sample::key(at + 1, key, false)];
        let toggles = press(KeyboardKey::Y, SECOND / 3);
        let times = [0, SECOND / 4, SECOND / 2];
        let reel = filmed(100.0, f64::INFINITY, &times, &toggles);
        let outside: Vec<bool> = reel.pictures().map(|moment| moment.look.outside.is_some()).collect();
        assert_eq!((outside.len(), outside.iter().position(|outside| *outside)), (51, Some(34)));
        assert!(outside[34..].iter().all(|outside| *outside));
    }

    #[test]
    fn a_year_between_two_frames_is_a_second_of_film() {
        let reel = reel(1000.0, f64::INFINITY, &[0, YEAR, 2 * YEAR]);
        assert_eq!(reel.len(), 2001);
        // The world waits for three quarters of each second, in one moment.
        assert!((480..=510).contains(&reel.moments.len()), "{}", reel.moments.len());
        assert!((reel.last().unwrap().own_s - 0.5).abs() < 1e-7);
        assert!(reel.times.sentence().unwrap().contains("2 gaps"));
    }

    #[test]
    fn pictures_are_taken_evenly() {
        let times: Vec<Nanos> = (0..=400).map(|frame| frame * SECOND / 4).collect();
        let evenly = |rate: f64, count| {
            let reel = reel(rate, 99.5, &times);
            reel.evenly(count).map(|moment| moment.own_s.round() as u64).collect::<Vec<_>>()
        };
        assert_eq!(evenly(1.0, 5), [10, 30, 50, 70, 90]);
        assert_eq!(evenly(1.0, 1000).len(), 100);
        assert_eq!(evenly(10.0, 5), [10, 30, 50, 70, 90]);
    }
}
