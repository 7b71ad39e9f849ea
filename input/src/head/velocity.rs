//! Velocity from the places of a track, and the filters that reduce its noise.
//!
//! A difference of places that are uncertain by half a millimetre, 17 ms apart, is uncertain by 4 cm/s; at 200 Hz by
//! 14 cm/s. Every filter trades some of that for latency. All treat the three axes alike, so that a turned room gives
//! the turned velocity.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use super::config::VelocityFilter;

/// Shortest interval to the last place, seconds. A closer place is passed over, because its difference would be noise
/// alone.
const SHORTEST_S: f64 = 5e-4;

/// Place, metres, and its time, seconds before now.
type TimedPlace = (f64, DVec3);

/// Velocity of a track.
#[derive(Clone, Debug)]
pub struct TrackVelocity {
    filter: VelocityFilter,
    /// Places of the track, the newest last.
    track: VecDeque<TimedPlace>,
    /// Acceleration for the One Euro filter, low-passed.
    acceleration: DVec3,
    /// True if `value` comes from differences of this track.
    begun: bool,
    value: DVec3,
}

impl TrackVelocity {
    /// Track without places.
    pub fn new(filter: VelocityFilter) -> Self {
        Self { filter, track: VecDeque::new(), acceleration: DVec3::ZERO, begun: false, value: DVec3::ZERO }
    }

    /// Velocity after the last place, m/s.
    pub fn value(&self) -> DVec3 {
        self.value
    }

    /// Begins a new track at this place. Until its second place the velocity is `value`.
    pub fn restart(&mut self, position: DVec3, value: DVec3) {
        *self = Self { value, ..Self::new(self.filter) };
        self.track.push_back((0.0, position));
    }

    /// Turns the track about a point, with its velocity: the axes have turned, and nothing has moved.
    pub fn turn(&mut self, about: DVec3, turn: DQuat) {
        self.track.iter_mut().for_each(|(_, place)| *place = about + turn * (*place - about));
        self.acceleration = turn * self.acceleration;
        self.value = turn * self.value;
    }

    /// Takes the next place, `interval_s` after the last.
    pub fn push(&mut self, interval_s: f64, position: DVec3) {
        self.track.iter_mut().for_each(|(time, _)| *time -= interval_s);
        let Some(&(last_s, last)) = self.track.back() else {
            return self.restart(position, self.value);
        };
        let interval_s = -last_s;
        if interval_s < SHORTEST_S {
            return;
        }
        self.track.push_back((0.0, position));
        let raw = (position - last) / interval_s;
        self.value = match self.filter {
            VelocityFilter::Mean { frames } => {
                while self.track.len() > frames as usize + 1 {
                    self.track.pop_front();
                }
                self.mean().unwrap_or(raw)
            }
            VelocityFilter::LeastSquares { window_s } => {
                // The window of a slow tracker holds no more than two places.
                while self.track.len() > 2 && self.track[0].0 < -window_s * (1.0 + 1e-9) {
                    self.track.pop_front();
                }
                self.slope().unwrap_or(raw)
            }
            VelocityFilter::OneEuro { minimum_cutoff_hz, acceleration_coefficient, acceleration_cutoff_hz } => {
                self.keep_last();
                let share = |cutoff_hz: f64| 1.0 / (1.0 + 1.0 / (TAU * cutoff_hz * interval_s));
                if self.begun {
                    let acceleration = (raw - self.value) / interval_s;
                    self.acceleration += share(acceleration_cutoff_hz) * (acceleration - self.acceleration);
                    let cutoff_hz = minimum_cutoff_hz + acceleration_coefficient * self.acceleration.length();
                    self.value + share(cutoff_hz) * (raw - self.value)
                } else {
                    raw
                }
            }
            VelocityFilter::Off => {
                self.keep_last();
                raw
            }
        };
        self.begun = true;
    }

    fn keep_last(&mut self) {
        let last = self.track.len().saturating_sub(1);
        self.track.drain(..last);
    }

    /// Difference of the last and the first place over the time between: the mean of the differences, each weighted
    /// by its time.
    fn mean(&self) -> Option<DVec3> {
        let (&(begin, from), &(end, to)) = (self.track.front()?, self.track.back()?);
        (end > begin).then(|| (to - from) / (end - begin))
    }

    /// Slope of the line of least squares.
    ///
    /// *Equation*: v = Σ (tᵢ − t̄) xᵢ / Σ (tᵢ − t̄)².
    fn slope(&self) -> Option<DVec3> {
        let count = self.track.len() as f64;
        let mean_s = self.track.iter().map(|(time, _)| time).sum::<f64>() / count;
        // Relative to the newest place, or rounding far from the origin would count.
        let (_, newest) = *self.track.back()?;
        let (mut along, mut square) = (DVec3::ZERO, 0.0);
        for (time, position) in &self.track {
            along += (time - mean_s) * (*position - newest);
            square += (time - mean_s) * (time - mean_s);
        }
        (square > 0.0).then(|| along / square)
    }
}

#[cfg(test)]
mod tests {
    //! Every filter must give a steady motion its exact velocity, whatever the intervals, and turn with the room; the
    //! One Euro filter must agree with that of `filters`.
    use super::*;
    use crate::filters::OneEuro;

    /// Rounding of sums of a few hundred terms, m/s.
    const ROUNDING: f64 = 1e-9;

    fn every_filter() -> [VelocityFilter; 4] {
        [VelocityFilter::default(), VelocityFilter::least_squares(), VelocityFilter::one_euro(), VelocityFilter::Off]
    }

    /// Intervals of a 60 Hz tracker after a network.
    fn intervals() -> impl Iterator<Item = f64> {
        (0..400).map(|index| (1.0 + 0.4 * (f64::from(index) * 1.7).sin()) / 60.0)
    }

    #[test]
    fn steady_motion_has_its_exact_velocity() {
        let expected = DVec3::new(1.2, -0.1, -0.7);
        for filter in every_filter() {
            let mut velocity = TrackVelocity::new(filter);
            let mut position = DVec3::new(100.0, 2.0, -300.0);
            velocity.restart(position, DVec3::ZERO);
            for interval_s in intervals() {
                position += expected * interval_s;
                velocity.push(interval_s, position);
                assert!((velocity.value() - expected).length() < ROUNDING, "{filter:?}: {}", velocity.value());
            }
        }
    }

    #[test]
    fn a_turned_track_has_the_turned_velocity() {
        let turn = DQuat::from_euler(glam::EulerRot::YXZ, 0.3, -1.1, 2.0);
        for filter in every_filter() {
            let (mut plain, mut turned) = (TrackVelocity::new(filter), TrackVelocity::new(filter));
            let mut time: f64 = 0.0;
            for interval_s in intervals() {
                time += interval_s;
                let position = DVec3::new((3.0 * time).sin(), (7.0 * time).cos(), (time * time).sin());
                plain.push(interval_s, position);
                turned.push(interval_s, turn * position);
                let difference = turn * plain.value() - turned.value();
                assert!(difference.length() < ROUNDING, "{filter:?}: {difference}");
            }
        }
    }

    #[test]
    fn the_mean_is_over_its_frames_and_not_over_more() {
        let mut velocity = TrackVelocity::new(VelocityFilter::Mean { frames: 4 });
        velocity.restart(DVec3::ZERO, DVec3::ZERO);
        let mut x = 0.0;
        // Speeds 0, 0, 4, 8, 12, 16 m/s at 100 Hz.
        let means: Vec<f64> = [0.0, 0.0, 4.0, 8.0, 12.0, 16.0]
            .into_iter()
            .map(|speed| {
                x += 0.01 * speed;
                velocity.push(0.01, DVec3::X * x);
                velocity.value().x
            })
            .collect();
        for (mean, expected) in means.into_iter().zip([0.0, 0.0, 4.0 / 3.0, 3.0, 6.0, 10.0]) {
            assert!((mean - expected).abs() < ROUNDING, "{mean} for {expected}");
        }
    }

    #[test]
    fn the_slope_has_the_velocity_of_the_middle_of_its_window() {
        let mut velocity = TrackVelocity::new(VelocityFilter::LeastSquares { window_s: 0.1 });
        for step in 0..100 {
            // A fall: x = t².
            let time = 0.005 * f64::from(step);
            velocity.push(0.005, DVec3::X * time * time);
        }
        let expected = 2.0 * (0.005 * 99.0 - 0.05);
        assert!((velocity.value().x - expected).abs() < ROUNDING, "{}", velocity.value());
    }

    #[test]
    fn one_euro_is_that_of_the_authors_on_the_differences() {
        let mut velocity = TrackVelocity::new(VelocityFilter::OneEuro {
            minimum_cutoff_hz: 1.0,
            acceleration_coefficient: 0.1,
            acceleration_cutoff_hz: 1.0,
        });
        let mut authors = OneEuro::new(1.0, 0.1, 1.0);
        velocity.restart(DVec3::ZERO, DVec3::ZERO);
        let mut last = 0.0;
        for step in 1..200 {
            let x = (0.3 * f64::from(step)).sin() + 0.01 * f64::from(step % 7);
            velocity.push(1.0 / 120.0, DVec3::Y * x);
            let expected = authors.filter((x - last) * 120.0, 1.0 / 120.0);
            last = x;
            assert!((velocity.value().y - expected).abs() < ROUNDING, "{} for {expected}", velocity.value());
        }
    }

    #[test]
    fn two_places_at_one_time_are_one() {
        for filter in every_filter() {
            let mut velocity = TrackVelocity::new(filter);
            for step in 0..50 {
                let x = 0.01 * f64::from(step);
                velocity.push(0.01, DVec3::X * x);
                // A jitter that would be 1000 m/s.
                velocity.push(1e-6, DVec3::X * (x + 1e-3));
                velocity.push(0.0, DVec3::X * x);
                assert!(velocity.value().x < 1.2, "{filter:?}: {}", velocity.value());
            }
            assert!((velocity.value().x - 1.0).abs() < 2e-4, "{filter:?}: {}", velocity.value());
            // A faster track than needed, but with a true velocity.
            for step in 0..5000 {
                velocity.push(1e-4, DVec3::X * (0.49 + 1e-4 * f64::from(step)));
            }
            assert!((velocity.value().x - 1.0).abs() < 2e-3, "{filter:?}: {}", velocity.value());
        }
    }

    #[test]
    fn a_track_holds_no_more_than_it_needs() {
        for filter in every_filter() {
            let mut velocity = TrackVelocity::new(filter);
            for _ in 0..10_000 {
                velocity.push(1e-3, DVec3::ZERO);
                assert!(velocity.track.len() <= 52, "{filter:?}: {}", velocity.track.len());
            }
        }
    }
}
