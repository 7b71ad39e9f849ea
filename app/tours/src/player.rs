//! Player of a tour: a pure function of time and of the vehicle.

use crate::change::TourChange;
use crate::plan::{StationRide, TourAnswer, TourPlan, TourQuestion, TourText};
use crate::rider::Rider;
use crate::tour_error::PlayError;
use glam::DVec3;
use input::{Action, DeskConfig, Nanos, SECOND, Sample};
use ride::Vehicle;
use std::sync::Arc;

/// Output of the player for one frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TourStep {
    /// Samples for the ride, since the frame before.
    pub samples: Vec<Sample>,
    /// Changes of what is shown.
    pub changes: Vec<TourChange>,
}

/// State of a tour that is played.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Progress {
    /// Ride under way.
    Riding,
    /// End of a station with a pause: the tour waits for the visitor.
    Waiting,
    /// Open question; the chosen answer, once there is one.
    Asking(Option<usize>),
    /// End of the tour.
    Over,
}

/// Player of a tour.
pub struct TourPlayer {
    plan: Arc<TourPlan>,
    rider: Rider,
    station: usize,
    progress: Progress,
    /// True while the visitor has stopped the tour.
    stopped: bool,
    /// True if the ride is paused by the player.
    paused: bool,
    /// True if the changes of the present station have been given out.
    announced: bool,
    /// Time of the tour: the ride's without its pauses.
    tour_time: Nanos,
    /// Time of the tour at which the present station began.
    began: Nanos,
    /// Time of the ride at the last step.
    now: Option<Nanos>,
    /// Time of the ride when the tour's was 0, and all pauses since.
    late: Nanos,
}

impl TourPlayer {
    /// Player of a plan in a scene with this circuit; `desk` says how samples are decoded.
    ///
    /// # Errors
    /// [`PlayError`] if there is no route.
    pub fn new(plan: Arc<TourPlan>, circuit: &[DVec3], desk: &DeskConfig) -> Result<Self, PlayError> {
        let rider = Rider::new(&plan, circuit, desk)?;
        Ok(Self {
            plan,
            rider,
            station: 0,
            progress: Progress::Riding,
            stopped: false,
            paused: false,
            announced: false,
            tour_time: 0,
            began: 0,
            now: None,
            late: 0,
        })
    }

    /// Plan that is played.
    pub fn plan(&self) -> &TourPlan {
        &self.plan
    }

    /// Step to the time `now` of the ride, which never runs backward. `vehicle`: as it is at present.
    pub fn step(&mut self, now: Nanos, vehicle: &Vehicle) -> TourStep {
        let mut step = TourStep::default();
        let before = self.now.replace(now).unwrap_or(now);
        if self.tour_time == 0 && !self.announced {
            self.late = now;
        } else if self.runs() && !self.paused {
            self.tour_time += now.saturating_sub(before);
        } else {
            self.late += now.saturating_sub(before);
        }
        if self.runs() {
            self.pass_stations();
        }
        self.announce(&mut step.changes);

        // Hold the ride while the tour waits.
        let is_over = self.progress == Progress::Over;
        let should_pause = !self.runs() && !is_over;
        if should_pause != self.paused {
            self.paused = should_pause;
            step.samples.push(Sample::action(now, &Action::TogglePause));
        }
        if is_over {
            step.samples.extend(self.rider.end(now));
        } else if self.runs() {
            let ride = self.plan.stations.get(self.station).map_or(StationRide::Coast, |station| station.ride);
            step.samples.extend(self.rider.samples(ride, vehicle, self.tour_time, self.late));
        }
        step
    }

    /// True while the tour's own time runs.
    fn runs(&self) -> bool {
        self.progress == Progress::Riding && !self.stopped
    }

    /// Goes on to the next station where the present one is over.
    fn pass_stations(&mut self) {
        let Some(station) = self.plan.stations.get(self.station) else {
            self.progress = Progress::Over;
            return;
        };
        let length = (station.seconds * SECOND as f64) as Nanos;
        let arrived = station.until_m.is_some_and(|until_m| self.rider.along_m() >= until_m);
        if self.tour_time - self.began < length && !arrived {
            return;
        }
        self.progress = match (&station.question, station.pause) {
            (Some(_), _) => Progress::Asking(None),
            (None, true) => Progress::Waiting,
            (None, false) => {
                self.next_station();
                return;
            }
        };
    }

    fn next_station(&mut self) {
        self.station += 1;
        self.began = self.tour_time;
        self.announced = false;
        let is_last = self.station >= self.plan.stations.len();
        self.progress = if is_last { Progress::Over } else { Progress::Riding };
    }

    /// Gives out the changes of a station that begins.
    fn announce(&mut self, changes: &mut Vec<TourChange>) {
        if std::mem::replace(&mut self.announced, true) {
            return;
        }
        let Some(station) = self.plan.stations.get(self.station) else { return };
        changes.extend(station.effects.map(TourChange::Effects));
        changes.extend(station.view.map(TourChange::View));
        changes.extend(station.show.clone().map(TourChange::Show));
    }

    /// Caption to show; `None` if there is none at present.
    pub fn caption(&self) -> Option<&TourText> {
        let station = self.plan.stations.get(self.station)?;
        (!station.caption.0.is_empty()).then_some(&station.caption)
    }

    /// Question that waits for an answer, or whose answer is being explained.
    pub fn question(&self) -> Option<&TourQuestion> {
        let open = matches!(self.progress, Progress::Asking(_));
        self.plan.stations.get(self.station)?.question.as_ref().filter(|_| open)
    }

    /// Answer that was chosen last, for its explanation.
    pub fn answered(&self) -> Option<&TourAnswer> {
        let Progress::Asking(Some(chosen)) = self.progress else { return None };
        self.question()?.answers.get(chosen)
    }

    /// Chooses an answer, by its number from 0; another one may be chosen afterwards. Other numbers change nothing.
    pub fn answer(&mut self, chosen: usize) {
        if self.question().is_some_and(|question| chosen < question.answers.len()) {
            self.progress = Progress::Asking(Some(chosen));
        }
    }

    /// True if the tour waits for the visitor: to go on, or to answer first.
    pub fn is_waiting(&self) -> bool {
        self.stopped || !matches!(self.progress, Progress::Riding | Progress::Over)
    }

    /// Goes on after a pause, an answered question or a stop. An open question stays until it is answered.
    pub fn go_on(&mut self) {
        if std::mem::take(&mut self.stopped) {
            return;
        }
        if matches!(self.progress, Progress::Waiting | Progress::Asking(Some(_))) {
            self.next_station();
        }
    }

    /// Stops the tour where it is, for looking around, until [`TourPlayer::go_on`].
    pub fn stop(&mut self) {
        self.stopped = self.progress == Progress::Riding;
    }

    /// True after the last station.
    pub fn is_over(&self) -> bool {
        self.progress == Progress::Over
    }

    /// Number of the present station, from 0; that of all stations after the last.
    pub fn station(&self) -> usize {
        self.station
    }

    /// Time of the tour, without its pauses, seconds.
    pub fn tour_s(&self) -> f64 {
        self.tour_time as f64 / SECOND as f64
    }
}
