//! Player of a tour: a pure function of time and of the vehicle.

use crate::change::TourChange;
use crate::plan::{StationRide, TourAnswer, TourPlan, TourQuestion, TourText};
use crate::rider::Rider;
use crate::tour_error::PlayError;
use glam::DVec3;
use input::{Action, DeskConfig, Nanos, SECOND, Sample};
use ride::Simulation;
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
    /// True if the changes of the present station have been given out.
    announced: bool,
    /// Own time of the tour, and that of the vehicle at the last step, seconds.
    own_s: f64,
    vehicle_s: f64,
    /// Own times of the tour at which the present station began, and at which the last one ended.
    began_s: f64,
    ended_s: f64,
    /// True while the ride is held by the tour.
    holds: bool,
    /// Time of the ride without its pauses, for the rider's samples.
    running: Nanos,
    /// Time of the ride at the last step.
    now: Option<Nanos>,
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
            announced: false,
            own_s: 0.0,
            vehicle_s: f64::INFINITY,
            began_s: 0.0,
            ended_s: 0.0,
            holds: false,
            running: 0,
            now: None,
        })
    }

    /// Plan that is played.
    pub fn plan(&self) -> &TourPlan {
        &self.plan
    }

    /// Step to the time `now` of the ride, which never runs backward. `ride`: as it is before its next frame.
    ///
    /// Stations are counted in the rider's own time, so that a station is as long however fast the clock runs, whoever
    /// holds the ride, and however late frames come. Its end within the frame to come is foreseen.
    pub fn step(&mut self, now: Nanos, ride: &Simulation) -> TourStep {
        let mut step = TourStep::default();
        let first = self.now.is_none();
        let before = self.now.replace(now).unwrap_or(now);
        let vehicle_s = ride.vehicle().odometer().own_s;
        self.own_s += (vehicle_s - std::mem::replace(&mut self.vehicle_s, vehicle_s)).max(0.0);
        let rate = if ride.is_paused() { 0.0 } else { ride.time_scale() };
        if self.runs() && !ride.is_paused() && !first {
            self.running += now - before;
        }
        let mut at = before;
        self.announce(&mut step.changes);
        while self.runs() {
            let motion = self.plan.stations.get(self.station).map_or(StationRide::Coast, |station| station.ride);
            step.samples.extend(self.rider.samples(motion, ride.vehicle(), at, [self.running, now]));
            let Some((end, own_s)) = self.end(before, now, rate) else { break };
            at = end;
            self.pass_station(own_s);
            self.announce(&mut step.changes);
        }

        // Hold the ride while the tour waits.
        if self.progress == Progress::Over {
            step.samples.extend(self.rider.end(at));
        } else if !self.runs() && !ride.is_paused() {
            step.samples.push(Sample::action(at, &Action::Hold(true)));
            self.holds = true;
        }
        if self.runs() && std::mem::take(&mut self.holds) {
            step.samples.push(Sample::action(now, &Action::Hold(false)));
        }
        step
    }

    /// True while the tour's own time runs.
    fn runs(&self) -> bool {
        self.progress == Progress::Riding && !self.stopped
    }

    /// Time of the ride and own time of the tour at which the present station ends, if that is in the frame from
    /// `before` to `now`. `rate`: own time per time of the ride.
    fn end(&self, before: Nanos, now: Nanos, rate: f64) -> Option<(Nanos, f64)> {
        let Some(station) = self.plan.stations.get(self.station) else { return Some((before, self.own_s)) };
        if station.until_m.is_some_and(|until_m| self.rider.along_m() >= until_m) {
            return Some((before, self.own_s));
        }
        let end_s = self.began_s + station.seconds;
        let left_s = (end_s - self.own_s).max(0.0);
        let ahead = left_s / rate * SECOND as f64;
        (left_s == 0.0 || ahead <= (now - before) as f64).then(|| (before + ahead.max(0.0) as Nanos, end_s))
    }

    /// Ends the present station, at this own time of the tour.
    fn pass_station(&mut self, own_s: f64) {
        self.ended_s = own_s;
        match self.plan.stations.get(self.station).map(|station| (&station.question, station.pause)) {
            Some((Some(_), _)) => self.progress = Progress::Asking(None),
            Some((None, true)) => self.progress = Progress::Waiting,
            Some((None, false)) | None => self.next_station(),
        }
    }

    fn next_station(&mut self) {
        self.station += 1;
        self.began_s = self.ended_s;
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
        changes.extend(station.events.iter().cloned().map(TourChange::Mark));
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

    /// Own time of the tour's rider, seconds.
    pub fn own_s(&self) -> f64 {
        self.own_s
    }
}
