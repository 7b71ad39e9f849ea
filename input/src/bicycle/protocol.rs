//! The three kinds of line that a bicycle may send, described in [the module](super).

use crate::line::{LineError, unseal};

/// Line of the bicycle, parsed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BicycleLine {
    /// A `B1` line: counts and times of pulses.
    Pulses {
        /// Reading of the box's clock at sending, µs.
        now_us: u32,
        /// Pulses of the wheel: number so far, and time of the last one.
        wheel: PulseCount,
        /// Pulses of the crank: number so far, and time of the last one.
        crank: PulseCount,
        /// Reading of the steering sensor.
        steer: f64,
        /// Reading of the brake sensor.
        brake: f64,
    },
    /// A four-field line: the last interval.
    Interval {
        /// Time between the last two pulses of the wheel, µs.
        interval_us: u32,
        /// Time since the last pulse, µs.
        age_us: u32,
        /// Steering, −1 to 1.
        steer: f64,
        /// Brake, in the sensor's units.
        brake: f64,
    },
    /// A single number, the speed.
    Bare(f64),
}

/// Number of pulses so far, and time of the last one on the box's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PulseCount {
    /// Number of pulses; wraps.
    pub pulses: u32,
    /// Time of the last one, µs; wraps.
    pub last_us: u32,
}

impl BicycleLine {
    /// Parses a line without its end.
    ///
    /// # Errors
    /// A line of none of the three kinds, or a field that cannot be read.
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
        let [_, sequence, now, wheel, wheel_last, crank, crank_last, steer, brake] = fields[..] else {
            return Err(LineError::Fields { line: text.to_owned(), found: fields.len(), expected: "9" });
        };
        whole("seq", sequence)?;
        Ok(Self::Pulses {
            now_us: whole("t_us", now)?,
            wheel: PulseCount { pulses: whole("wheel_count", wheel)?, last_us: whole("wheel_t_us", wheel_last)? },
            crank: PulseCount { pulses: whole("crank_count", crank)?, last_us: whole("crank_t_us", crank_last)? },
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
        _ => Err(LineError::Field { field, text: text.to_owned(), expected: "a number" }),
    }
}
