//! Rider of a tour: samples of a bicycle's sensors along the route, or thrust.

use crate::plan::{StationRide, TourPlan, TourRoute};
use crate::tour_error::PlayError;
use glam::DVec3;
use input::{Action, DeskConfig, Nanos, Sample, SampleSource, VehicleKind};
use ride::{Tour, Vehicle};

/// Rider that nobody is.
pub(crate) struct Rider {
    gain_m_s2: f64,
    cyclist: Option<Box<Tour>>,
    /// Thrust at present: right, up, backward.
    pushed: [i8; 3],
}

impl Rider {
    /// Rider of a plan in a scene with this circuit.
    pub(crate) fn new(plan: &TourPlan, circuit: &[DVec3], desk: &DeskConfig) -> Result<Self, PlayError> {
        let title = || plan.title.in_language("en").to_owned();
        let rides = plan.vehicle == VehicleKind::Bicycle && plan.recording.is_none();
        let moves = plan
            .stations
            .iter()
            .any(|station| matches!(station.ride, StationRide::Along { speed_m_s } if speed_m_s > 0.0));
        let mut cyclist = None;
        if rides && moves {
            let route = match &plan.route {
                TourRoute::Circuit if circuit.is_empty() => return Err(PlayError::NoCircuit { title: title() }),
                TourRoute::Circuit => circuit.to_vec(),
                TourRoute::Points(points) => there_and_back(points),
            };
            let tour = Tour::new(&route, &desk.bicycle).ok_or_else(|| PlayError::NoRoute { title: title() })?;
            cyclist = Some(Box::new(tour));
        }
        Ok(Self { gain_m_s2: plan.gain_m_s2, cyclist, pushed: [0; 3] })
    }

    /// Length along the route, metres; NaN before the first samples and without a route.
    pub(crate) fn along_m(&self) -> f64 {
        self.cyclist.as_ref().map_or(f64::NAN, |cyclist| cyclist.along_m())
    }

    /// Samples for a motion from the time `at` of the ride on. A cyclist's are those up to `running`, the time of the
    /// ride without its pauses, which is `now` with them.
    pub(crate) fn samples(
        &mut self,
        motion: StationRide,
        vehicle: &Vehicle,
        at: Nanos,
        [running, now]: [Nanos; 2],
    ) -> Vec<Sample> {
        match (motion, &mut self.cyclist) {
            (StationRide::Along { speed_m_s }, Some(cyclist)) => {
                cyclist.ride_at(speed_m_s, self.gain_m_s2);
                let mut samples = cyclist.samples(vehicle, running);
                samples.iter_mut().for_each(|sample| sample.at += now - running);
                samples
            }
            (StationRide::Thrust(axes), _) => self.push(axes, at),
            _ => self.push([0; 3], at),
        }
    }

    /// Thrust along these axes from now on, where that is news.
    fn push(&mut self, axes: [i8; 3], at: Nanos) -> Vec<Sample> {
        if std::mem::replace(&mut self.pushed, axes) == axes {
            return Vec::new();
        }
        vec![Sample::action(at, &Action::Thrust(axes.map(f64::from)))]
    }

    /// Samples that release everything at the ride's time `now`.
    pub(crate) fn end(&mut self, now: Nanos) -> Vec<Sample> {
        let mut samples = self.push([0; 3], now);
        if self.cyclist.take().is_some() {
            samples.push(Sample::closed(now, SampleSource::Bicycle));
        }
        samples
    }
}

/// Closed route along an open one and back again. The rider stops before it turns.
fn there_and_back(points: &[DVec3]) -> Vec<DVec3> {
    let mut points = points.to_vec();
    points.dedup();
    if let [from, to] = points[..] {
        points.insert(1, 0.5 * (from + to));
    }
    let back: Vec<DVec3> = points.iter().rev().skip(1).take(points.len().saturating_sub(2)).copied().collect();
    points.extend(back);
    points
}
