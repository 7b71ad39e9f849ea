//! Decoder of the bicycle's lines.

use super::belief::SpeedBelief;
use super::config::{BareNumber, BicycleConfig, SpeedSource};
use super::protocol::{BicycleLine, PulseCount};
use crate::clock::{Nanos, seconds_between};
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::glide::Glide;
use crate::line::{LineError, Lines};
use crate::pulses::PulseRate;

/// Fastest possible turns of the crank, Hz: 300 a minute.
const FASTEST_CADENCE_HZ: f64 = 5.0;
/// Largest possible jump of the counter; beyond it the box has restarted.
const MOST_PULSES_AT_ONCE: u32 = 1000;
/// Time for which a bare speed that does not glide holds before it begins to fade, seconds.
const BARE_SPEED_HOLDS_S: f64 = 0.5;

/// Cumulative counter and the rate that it gives.
#[derive(Debug)]
struct PulseCounter {
    rate: PulseRate,
    last: Option<PulseCount>,
}

impl PulseCounter {
    fn new(shortest_interval_s: f64, config: &BicycleConfig) -> Self {
        Self { rate: PulseRate::new(shortest_interval_s, config.stop_after_s, config.late_s), last: None }
    }

    fn reset(&mut self) {
        self.rate.reset();
        self.last = None;
    }

    /// Takes a count that arrived at `at`, when the box's clock showed `now_us`.
    fn update(&mut self, at: Nanos, now_us: u32, count: PulseCount) {
        let Some(last) = self.last.replace(count) else {
            return;
        };
        let pulses = count.pulses.wrapping_sub(last.pulses);
        if pulses == 0 {
            self.last = Some(last);
            return;
        }
        if pulses > MOST_PULSES_AT_ONCE {
            self.rate.reset();
            return;
        }
        // A pulse between reading the clock and sending the line has a negative age: count it as new.
        let age_us = match now_us.wrapping_sub(count.last_us) {
            age_us if age_us > u32::MAX / 2 => 0,
            age_us => age_us,
        };
        let pulse_at = at.saturating_sub(u64::from(age_us) * 1000);
        let interval_s = f64::from(count.last_us.wrapping_sub(last.last_us)) * 1e-6;
        if !self.rate.pulses(pulse_at, pulses, interval_s) {
            // A bounce counts, but the next interval starts at the pulse before it.
            self.last = Some(PulseCount { last_us: last.last_us, ..count });
        }
    }
}

/// Source of the wheel speed, by the kind of the last line.
#[derive(Clone, Copy, Debug, PartialEq)]
enum WheelSpeed {
    Unknown,
    Pulses,
    Cadence,
    Bare { metres_per_second: f64, at: Nanos },
    Glides,
}

/// Decoder of [`SampleSource::Bicycle`](crate::SampleSource::Bicycle).
#[derive(Debug)]
pub struct BicycleDecoder {
    config: BicycleConfig,
    lines: Lines,
    faults: Faults,
    wheel: PulseCounter,
    crank: PulseCounter,
    has_crank: bool,
    belief: SpeedBelief,
    speed: WheelSpeed,
    /// Speed between bare numbers, m/s.
    glide: Glide,
    steer_rad: f64,
    brake: f64,
}

impl BicycleDecoder {
    /// Decoder without any line yet.
    pub fn new(config: BicycleConfig) -> Self {
        let wheel = PulseCounter::new(config.metres_per_pulse() / config.fastest_m_s, &config);
        let crank = PulseCounter::new(1.0 / (FASTEST_CADENCE_HZ * config.pulses_per_crank_turn), &config);
        Self {
            glide: Glide::new(config.stop_after_s),
            config,
            lines: Lines::default(),
            faults: Faults::default(),
            wheel,
            crank,
            has_crank: false,
            belief: SpeedBelief::default(),
            speed: WheelSpeed::Unknown,
            steer_rad: 0.0,
            brake: 0.0,
        }
    }

    /// Speed of the wheel, m/s; `None` until a first good line.
    pub fn wheel_speed(&self, at: Nanos) -> Option<f64> {
        match self.speed {
            WheelSpeed::Unknown => None,
            WheelSpeed::Pulses => Some(self.wheel.rate.rate_hz(at) * self.config.metres_per_pulse()),
            WheelSpeed::Cadence => {
                let config = &self.config;
                let turns_hz = self.crank.rate.rate_hz(at) / config.pulses_per_crank_turn;
                Some((turns_hz * config.metres_per_crank_turn).min(config.fastest_m_s))
            }
            WheelSpeed::Glides => self.glide.speed(at),
            WheelSpeed::Bare { metres_per_second, at: said_at } => {
                let fading_s = (self.config.stop_after_s - BARE_SPEED_HOLDS_S).max(f64::MIN_POSITIVE);
                let left_s = self.config.stop_after_s - seconds_between(said_at, at);
                Some(metres_per_second * (left_s / fading_s).clamp(0.0, 1.0))
            }
        }
    }

    /// Turns of the crank a second; `None` until the crank has turned.
    pub fn cadence_hz(&self, at: Nanos) -> Option<f64> {
        self.has_crank.then(|| self.crank.rate.rate_hz(at) / self.config.pulses_per_crank_turn)
    }

    /// Angle of the handlebar, radians, positive to the left.
    pub fn steer_rad(&self) -> f64 {
        self.steer_rad
    }

    /// Brake lever, 0 to 1.
    pub fn brake(&self) -> f64 {
        self.brake
    }

    /// Takes a line that arrived at `at`.
    fn line(&mut self, at: Nanos, line: BicycleLine) -> Result<(), LineError> {
        match line {
            BicycleLine::Pulses { now_us, wheel, crank, steer, brake } => {
                self.wheel.update(at, now_us, wheel);
                self.crank.update(at, now_us, crank);
                self.has_crank |= self.crank.rate.last_pulse().is_some();
                self.speed = match self.config.speed_from {
                    SpeedSource::Wheel => WheelSpeed::Pulses,
                    SpeedSource::Cadence => WheelSpeed::Cadence,
                };
                let config = &self.config;
                self.turn_handlebar((steer - config.steer_straight) * config.steer_rad_per_unit);
                let config = &self.config;
                self.pull_brake((brake - config.brake_released) / (config.brake_full - config.brake_released));
            }
            BicycleLine::Interval { interval_us, age_us, steer, brake } => {
                let pulse_at = at.saturating_sub(u64::from(age_us) * 1000);
                let interval_s = f64::from(interval_us) * 1e-6;
                // The line repeats the last pulse until there is a new one, a whole interval later; lines are late by
                // much less.
                let is_new = self
                    .wheel
                    .rate
                    .last_pulse()
                    .is_none_or(|last| interval_us > 0 && seconds_between(last, pulse_at) > interval_s / 2.0);
                if is_new {
                    self.wheel.rate.pulses(pulse_at, 1, interval_s);
                }
                self.speed = WheelSpeed::Pulses;
                self.turn_handlebar(steer * self.config.four_field_steer_rad);
                self.pull_brake(brake / self.config.four_field_brake_full);
            }
            BicycleLine::Bare(number) => {
                let metres_per_second = match self.config.bare_number {
                    BareNumber::KilometresPerHour => number / 3.6,
                    BareNumber::WheelTurnsPerMinute => number / 60.0 * self.config.wheel_circumference_m,
                };
                if !(0.0..=self.config.fastest_m_s).contains(&metres_per_second) {
                    self.belief.noise();
                    return Err(LineError::Field {
                        field: "speed",
                        text: number.to_string(),
                        expected: "a speed from 0 to the fastest that can be ridden",
                    });
                }
                if !self.belief.believes(metres_per_second, at) {
                    return Err(LineError::Field {
                        field: "speed",
                        text: number.to_string(),
                        expected: "a speed that a rider reaches from the one before, or the same again in three lines",
                    });
                }
                self.speed = if self.config.bare_number_glides {
                    self.glide.read(at, metres_per_second);
                    WheelSpeed::Glides
                } else {
                    WheelSpeed::Bare { metres_per_second, at }
                };
            }
        }
        Ok(())
    }

    /// Sets the angle of the handlebar, radians, less its dead zone and limited to a right angle.
    fn turn_handlebar(&mut self, steer_rad: f64) {
        if !self.config.handlebar {
            return;
        }
        let dead_rad = self.config.steer_dead_rad;
        // Without a dead zone, −0 stays what it is.
        let beyond = if dead_rad > 0.0 { steer_rad - steer_rad.clamp(-dead_rad, dead_rad) } else { steer_rad };
        self.steer_rad = beyond.clamp(-std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2);
    }

    /// Sets the brake from the lever's way, 0 to 1.
    fn pull_brake(&mut self, way: f64) {
        let (way, curve) = (way.clamp(0.0, 1.0), self.config.brake_curve);
        self.brake = if curve == 1.0 { way } else { libm::pow(way, curve) };
    }
}

impl Decoder for BicycleDecoder {
    fn reset(&mut self, _at: Nanos) {
        self.lines.reset();
        self.wheel.reset();
        self.crank.reset();
        self.has_crank = false;
        self.belief = SpeedBelief::default();
        self.speed = WheelSpeed::Unknown;
        self.glide.reset();
        self.steer_rad = 0.0;
        self.brake = 0.0;
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        let mut lines = std::mem::take(&mut self.lines);
        lines.push(bytes, |line| {
            let parsed = line.and_then(BicycleLine::parse).inspect_err(|_| self.belief.noise());
            if let Err(error) = parsed.and_then(|line| self.line(at, line)) {
                self.faults.count(error.to_string());
            }
        });
        self.lines = lines;
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
#[path = "decoder_tests.rs"]
mod tests;
