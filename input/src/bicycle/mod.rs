//! The instrumented bicycle: lines of text to wheel speed, cadence, handlebar and brake.
//!
//! The sensors' box should send the times of pulses, not a speed that it has computed: only then is a slow wheel
//! measured as well as a fast one. Three kinds of line are understood, and may be mixed:
//!
//! | line | from |
//! |---|---|
//! | `B1,seq,t_us,wheel_count,wheel_t_us,crank_count,crank_t_us,steer,brake*HH` | boxes made for this program |
//! | `interval_us,age_us,steer,brake` | simple sketches |
//! | `23.4` | anything that knows its speed ([`BareNumber`](crate::BareNumber)) |
//!
//! A `B1` line gives counts and times of the last pulses on the box's clock, the readings of the converters, and a
//! checksum. Four fields give the last interval, the time since its end, steering from −1 to 1 and the brake.
//!
//! Counts and microseconds are 32 bits and wrap. Counts are cumulative, so a lost line loses nothing. A line that
//! cannot be understood is counted and skipped; the state before it stands. So is a bare number that nobody reaches
//! from the speed before it, until three lines in a row say it. In silence the wheel slows down and stops.

mod belief;
mod calibration;
pub(crate) mod config;
pub(crate) mod decoder;
mod protocol;

pub use calibration::{BicycleLineKind, BicyclePositions, CalibrationError, RawReadings, SteadyReading};
pub use decoder::BicycleDecoder;
pub use protocol::{BicycleLine, PulseCount};
