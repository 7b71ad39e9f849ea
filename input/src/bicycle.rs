//! The instrumented bicycle: lines of text to wheel speed, cadence, handlebar and brake.
//!
//! The sensors' box should send when pulses happened, not a speed it made up: only so is a slow wheel measured as well as a
//! fast one. Three kinds of line are understood, and may be mixed:
//!
//! | line | from |
//! |---|---|
//! | `B1,seq,t_us,wheel_count,wheel_t_us,crank_count,crank_t_us,steer,brake*HH` | our own boxes: counts and times of the last pulses on the box's clock, readings of the converters, checksum |
//! | `interval_us,age_us,steer,brake` | simple sketches: the last interval, how long ago it ended, steering −1 to 1, brake |
//! | `23.4` | anything that knows its speed ([`BareNumber`]) |
//!
//! Counts and microseconds are 32 bits and wrap. Since counts are cumulative, a lost line loses nothing. A line that cannot be
//! understood is counted and skipped; the state of before stands. In silence the wheel runs down and stops.

use crate::config::{BareNumber, BicycleConfig};
use crate::decoder::{Actions, Decoder, Faults};
use crate::line::{LineError, Lines, unseal};
use crate::pulses::PulseRate;
use crate::sample::{Nanos, seconds_between};

/// Nobody pedals at 300 turns a minute.
const FASTEST_CADENCE_HZ: f64 = 5.0;
/// A jump of the counter beyond this is a box that has restarted, not a ride.
const MOST_PULSES_AT_ONCE: u32 = 1000;
/// A bare speed holds for this long before it begins to fade, seconds.
const BARE_SPEED_HOLDS_S: f64 = 0.5;

/// A line that has been understood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Line {
    /// A `B1` line.
    Pulses {
        /// The box's clock when it was sent, µs.
        now_us: u32,
        /// Pulses of the wheel so far, and when the last one was.
        wheel: Count,
        /// Pulses of the crank so far, and when the last one was.
        crank: Count,
        /// Reading of the steering sensor.
        steer: f64,
        /// Reading of the brake sensor.
        brake: f64,
    },
    /// A four-field line.
    Interval {
        /// Between the last two pulses of the wheel, µs.
        interval_us: u32,
        /// Since the last pulse, µs.
        age_us: u32,
        /// Steering.
        steer: f64,
        /// Brake.
        brake: f64,
    },
    /// A single number.
    Bare(f64),
}

/// Pulses counted so far, and when the last one was, on the box's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// Number of pulses; wraps.
    pub pulses: u32,
    /// Time of the last one, µs; wraps.
    pub last_us: u32,
}

impl Line {
    /// Reads a line without its end.
    ///
    /// # Errors
    /// If it is none of the three kinds, or a field cannot be read.
    pub fn parse(line: &str) -> Result<Self, LineError> {
        let line = line.trim();
        if line.starts_with("B1,") {
            return Self::parse_pulses(unseal(line)?);
        }
        let fields: Vec<&str> = line.split(',').map(str::trim).collect();
        match fields[..] {
            [speed] => Ok(Self::Bare(finite("speed", speed)?)),
            [interval, age, steer, brake] => Ok(Self::Interval {
                interval_us: whole("interval_us", interval)?,
                age_us: whole("age_us", age)?,
                steer: finite("steer", steer)?,
                brake: finite("brake", brake)?,
            }),
            _ => Err(LineError::Fields {
                line: line.to_owned(),
                found: fields.len(),
                expected: "1 or 4, or a line that begins with `B1,`",
            }),
        }
    }

    fn parse_pulses(text: &str) -> Result<Self, LineError> {
        let fields: Vec<&str> = text.split(',').collect();
        let [
            _,
            sequence,
            now,
            wheel,
            wheel_last,
            crank,
            crank_last,
            steer,
            brake,
        ] = fields[..]
        else {
            return Err(LineError::Fields {
                line: text.to_owned(),
                found: fields.len(),
                expected: "9",
            });
        };
        whole("seq", sequence)?;
        Ok(Self::Pulses {
            now_us: whole("t_us", now)?,
            wheel: Count {
                pulses: whole("wheel_count", wheel)?,
                last_us: whole("wheel_t_us", wheel_last)?,
            },
            crank: Count {
                pulses: whole("crank_count", crank)?,
                last_us: whole("crank_t_us", crank_last)?,
            },
            steer: finite("steer_raw", steer)?,
            brake: finite("brake_raw", brake)?,
        })
    }
}

fn whole(field: &'static str, text: &str) -> Result<u32, LineError> {
    text.parse().map_err(|_| LineError::Field {
        field,
        text: text.to_owned(),
        expected: "a whole number from 0 to 4294967295",
    })
}

fn finite(field: &'static str, text: &str) -> Result<f64, LineError> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(LineError::Field {
            field,
            text: text.to_owned(),
            expected: "a number",
        }),
    }
}

/// A cumulative counter and the rate it gives.
#[derive(Debug)]
struct Counter {
    rate: PulseRate,
    last: Option<Count>,
}

impl Counter {
    fn new(shortest_interval_s: f64, stop_after_s: f64) -> Self {
        Self {
            rate: PulseRate::new(shortest_interval_s, stop_after_s),
            last: None,
        }
    }

    fn reset(&mut self) {
        self.rate.reset();
        self.last = None;
    }

    /// Takes a count that arrived at `at`, when the box's clock showed `now_us`.
    fn update(&mut self, at: Nanos, now_us: u32, count: Count) {
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
        // A pulse between reading the clock and sending the line has a negative age: take it for new.
        let age_us = match now_us.wrapping_sub(count.last_us) {
            age_us if age_us > u32::MAX / 2 => 0,
            age_us => age_us,
        };
        let pulse_at = at.saturating_sub(u64::from(age_us) * 1000);
        let interval_s = f64::from(count.last_us.wrapping_sub(last.last_us)) * 1e-6;
        if !self.rate.pulses(pulse_at, pulses, interval_s) {
            // A bounce counts, but the next interval starts at the pulse before it.
            self.last = Some(Count {
                last_us: last.last_us,
                ..count
            });
        }
    }
}

/// Where the wheel speed comes from, by the kind of line that came last.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Speed {
    Unknown,
    Pulses,
    Bare { metres_per_second: f64, at: Nanos },
}

/// Decoder of [`Source::Bicycle`](crate::Source::Bicycle).
#[derive(Debug)]
pub struct Bicycle {
    config: BicycleConfig,
    lines: Lines,
    faults: Faults,
    wheel: Counter,
    crank: Counter,
    has_crank: bool,
    speed: Speed,
    steer_rad: f64,
    brake: f64,
}

impl Bicycle {
    /// A decoder that has seen nothing yet.
    pub fn new(config: BicycleConfig) -> Self {
        let wheel = Counter::new(
            config.metres_per_pulse() / config.fastest_m_s,
            config.stop_after_s,
        );
        let crank = Counter::new(
            1.0 / (FASTEST_CADENCE_HZ * config.pulses_per_crank_turn),
            config.stop_after_s,
        );
        Self {
            config,
            lines: Lines::default(),
            faults: Faults::default(),
            wheel,
            crank,
            has_crank: false,
            speed: Speed::Unknown,
            steer_rad: 0.0,
            brake: 0.0,
        }
    }

    /// Speed of the wheel, m/s; `None` until a first good line.
    pub fn wheel_speed(&self, at: Nanos) -> Option<f64> {
        match self.speed {
            Speed::Unknown => None,
            Speed::Pulses => Some(self.wheel.rate.rate_hz(at) * self.config.metres_per_pulse()),
            Speed::Bare {
                metres_per_second,
                at: said_at,
            } => {
                let fading_s =
                    (self.config.stop_after_s - BARE_SPEED_HOLDS_S).max(f64::MIN_POSITIVE);
                let left_s = self.config.stop_after_s - seconds_between(said_at, at);
                Some(metres_per_second * (left_s / fading_s).clamp(0.0, 1.0))
            }
        }
    }

    /// Turns of the crank a second; `None` until a crank has been seen to turn.
    pub fn cadence_hz(&self, at: Nanos) -> Option<f64> {
        self.has_crank
            .then(|| self.crank.rate.rate_hz(at) / self.config.pulses_per_crank_turn)
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
    fn line(&mut self, at: Nanos, line: Line) -> Result<(), LineError> {
        match line {
            Line::Pulses {
                now_us,
                wheel,
                crank,
                steer,
                brake,
            } => {
                self.wheel.update(at, now_us, wheel);
                self.crank.update(at, now_us, crank);
                self.has_crank |= self.crank.rate.last_pulse().is_some();
                self.speed = Speed::Pulses;
                let config = &self.config;
                self.turn_handlebar((steer - config.steer_straight) * config.steer_rad_per_unit);
                let config = &self.config;
                self.pull_brake(
                    (brake - config.brake_released) / (config.brake_full - config.brake_released),
                );
            }
            Line::Interval {
                interval_us,
                age_us,
                steer,
                brake,
            } => {
                let pulse_at = at.saturating_sub(u64::from(age_us) * 1000);
                let interval_s = f64::from(interval_us) * 1e-6;
                // The line repeats the last pulse until there is a new one, which comes a whole interval later; lines
                // are late by much less.
                let is_new = self.wheel.rate.last_pulse().is_none_or(|last| {
                    interval_us > 0 && seconds_between(last, pulse_at) > interval_s / 2.0
                });
                if is_new {
                    self.wheel.rate.pulses(pulse_at, 1, interval_s);
                }
                self.speed = Speed::Pulses;
                self.turn_handlebar(steer * self.config.four_field_steer_rad);
                self.pull_brake(brake / self.config.four_field_brake_full);
            }
            Line::Bare(number) => {
                let metres_per_second = match self.config.bare_number {
                    BareNumber::KilometresPerHour => number / 3.6,
                    BareNumber::WheelTurnsPerMinute => {
                        number / 60.0 * self.config.wheel_circumference_m
                    }
                };
                if !(0.0..=self.config.fastest_m_s).contains(&metres_per_second) {
                    return Err(LineError::Field {
                        field: "speed",
                        text: number.to_string(),
                        expected: "a speed from 0 to the fastest that can be ridden",
                    });
                }
                self.speed = Speed::Bare {
                    metres_per_second,
                    at,
                };
            }
        }
        Ok(())
    }

    /// No handlebar turns further than a right angle.
    fn turn_handlebar(&mut self, steer_rad: f64) {
        self.steer_rad = steer_rad.clamp(-std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2);
    }

    fn pull_brake(&mut self, brake: f64) {
        self.brake = brake.clamp(0.0, 1.0);
    }
}

impl Decoder for Bicycle {
    fn reset(&mut self, _at: Nanos) {
        self.lines.reset();
        self.wheel.reset();
        self.crank.reset();
        self.has_crank = false;
        self.speed = Speed::Unknown;
        self.steer_rad = 0.0;
        self.brake = 0.0;
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        let mut lines = std::mem::take(&mut self.lines);
        lines.push(bytes, |line| {
            let outcome = line
                .and_then(Line::parse)
                .and_then(|line| self.line(at, line));
            if let Err(error) = outcome {
                self.faults.count(error.to_string());
            }
        });
        self.lines = lines;
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}
