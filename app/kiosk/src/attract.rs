//! Attract ride: the built-in tour as samples, or the foot on the pedal where the scene has no circuit.

use glam::DVec3;
use input::{DeskConfig, KeyboardKey, Nanos, SECOND, Sample, SampleSource, VehicleKind};
use ride::{Tour, Vehicle};

/// Rider that nobody is.
pub struct Attract {
    /// Way round the scene.
    circuit: Vec<DVec3>,
    /// Vehicle of rides without a tour.
    usual: VehicleKind,
    /// Settings of the devices, which the rider's samples have to fit.
    desk: DeskConfig,
    /// Beginning of the ride, while it is shown.
    from: Nanos,
    rider: Option<Rider>,
}

enum Rider {
    /// Cyclist that follows the circuit.
    Cyclist(Box<Tour>),
    /// Foot on the pedal; true once it is down.
    Foot(bool),
}

impl Attract {
    /// Time between the return to the start and the first sample, in which the vehicle is put there.
    const PAUSE: Nanos = SECOND / 2;
    /// Longest time of a ride along the circuit, and of one straight ahead.
    const TOUR: Nanos = 600 * SECOND;
    const STRAIGHT: Nanos = 20 * SECOND;

    /// Attract rides round a circuit; `usual` is the vehicle of those who have none, and `desk` says how the samples
    /// of the rider are decoded.
    pub fn new(circuit: &[DVec3], usual: VehicleKind, desk: &DeskConfig) -> Self {
        let circuit = if Tour::new(circuit, &desk.bicycle).is_some() { circuit.to_vec() } else { Vec::new() };
        Self { circuit, usual, desk: desk.clone(), from: 0, rider: None }
    }

    /// Longest time of a ride, after which the next begins.
    pub fn longest(&self) -> Nanos {
        if self.circuit.is_empty() { Self::STRAIGHT } else { Self::TOUR }
    }

    /// Vehicle of the ride.
    pub fn vehicle(&self) -> VehicleKind {
        if self.circuit.is_empty() { self.usual } else { VehicleKind::Bicycle }
    }

    /// Begins a ride at the time `now`.
    pub fn begin(&mut self, now: Nanos) -> Vec<Sample> {
        let left = self.end(now);
        self.from = now + Self::PAUSE;
        self.rider = Some(match Tour::new(&self.circuit, &self.desk.bicycle) {
            Some(tour) => Rider::Cyclist(Box::new(tour)),
            None => Rider::Foot(false),
        });
        left
    }

    /// Samples of the rider up to the time `now`.
    pub fn samples(&mut self, vehicle: &Vehicle, now: Nanos) -> Vec<Sample> {
        let Some(until) = now.checked_sub(self.from) else { return Vec::new() };
        match &mut self.rider {
            Some(Rider::Cyclist(tour)) => {
                let mut samples = tour.samples(vehicle, until);
                samples.iter_mut().for_each(|sample| sample.at += self.from);
                samples
            }
            Some(Rider::Foot(down)) if !*down => {
                *down = true;
                self.pedal(now, true)
            }
            _ => Vec::new(),
        }
    }

    /// Sample of the foot: a key that pedals, if one does.
    fn pedal(&self, now: Nanos, down: bool) -> Vec<Sample> {
        self.desk.keys.key_for(KeyboardKey::W).map(|key| Sample::key(now, key, down)).into_iter().collect()
    }

    /// Ends the ride at the time `now`: whatever it holds is released.
    pub fn end(&mut self, now: Nanos) -> Vec<Sample> {
        match self.rider.take() {
            Some(Rider::Cyclist(_)) => vec![Sample::closed(now, SampleSource::Bicycle)],
            Some(Rider::Foot(_)) => self.pedal(now, false),
            None => Vec::new(),
        }
    }
}
