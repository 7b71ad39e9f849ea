//! Revolutions of wheel and crank: the notifications of speed sensors (CSC 1.0, 3.1) and power meters (CPS 1.1, 3.2).
//!
//! Counts are cumulative, and each comes with the time of its last turn on the sensor's clock, 16 bits that wrap every
//! half minute or minute. So a lost notification loses nothing, and the speed is that of the turns, not of arrivals.

use thiserror::Error;

use crate::clock::{Nanos, seconds_between};

/// Ticks a second of the clocks that time the turns: of all but one, and of the wheel's clock in a power meter.
const TICKS_PER_S: f64 = 1024.0;
const WHEEL_TICKS_PER_S_OF_POWER: f64 = 2048.0;
/// Time between notifications beyond which a clock of 16 bits may have wrapped, seconds.
const LONGEST_GAP_S: f64 = 20.0;
/// Fields of a power measurement before the revolutions, in order: bit of their flag, and length, bytes.
const BEFORE_REVOLUTIONS: [(u16, usize); 2] = [(0, 1), (2, 2)];

/// Measurement that is shorter than its flags say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("a measurement of revolutions of {0} bytes, which is shorter than its flags say")]
pub(super) struct ShortMeasurement(usize);

/// Number of turns so far, and the time of the last one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turns {
    /// Number of turns; wraps at a number that depends on the field.
    count: u32,
    /// Bits of the count.
    bits: u32,
    /// Time of the last turn, ticks; wraps.
    ticks: u16,
    /// Ticks a second.
    ticks_per_s: f64,
}

/// Measurement of a speed sensor or a power meter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct RevolutionsData {
    /// Turns of the wheel.
    pub(super) wheel: Option<Turns>,
    /// Turns of the crank.
    pub(super) crank: Option<Turns>,
    /// Power of the rider, watts.
    pub(super) power_w: Option<f64>,
}

impl RevolutionsData {
    /// Parses the value of a Cycling Speed and Cadence Measurement.
    ///
    /// # Errors
    /// [`ShortMeasurement`] if fields are missing that the flags announce.
    pub(super) fn of_speed(value: &[u8]) -> Result<Self, ShortMeasurement> {
        let mut fields = Fields { rest: value, whole: value.len() };
        let [flags] = fields.take()?;
        let wheel = if flags & 1 != 0 { Some(fields.wheel(TICKS_PER_S)?) } else { None };
        let crank = if flags & 2 != 0 { Some(fields.crank()?) } else { None };
        Ok(Self { wheel, crank, power_w: None })
    }

    /// Parses the value of a Cycling Power Measurement. What stands behind the revolutions is passed over.
    ///
    /// # Errors
    /// [`ShortMeasurement`] if fields are missing that the flags announce.
    pub(super) fn of_power(value: &[u8]) -> Result<Self, ShortMeasurement> {
        let mut fields = Fields { rest: value, whole: value.len() };
        let flags = u16::from_le_bytes(fields.take()?);
        let power_w = Some(f64::from(i16::from_le_bytes(fields.take()?)));
        for (bit, length) in BEFORE_REVOLUTIONS {
            if flags & 1 << bit != 0 {
                fields.skip(length)?;
            }
        }
        let wheel = if flags & 1 << 4 != 0 { Some(fields.wheel(WHEEL_TICKS_PER_S_OF_POWER)?) } else { None };
        let crank = if flags & 1 << 5 != 0 { Some(fields.crank()?) } else { None };
        Ok(Self { wheel, crank, power_w })
    }
}

/// Fields of a value that are not yet read.
struct Fields<'a> {
    rest: &'a [u8],
    whole: usize,
}

impl Fields<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], ShortMeasurement> {
        let (field, rest) = self.rest.split_first_chunk().ok_or(ShortMeasurement(self.whole))?;
        self.rest = rest;
        Ok(*field)
    }

    fn skip(&mut self, length: usize) -> Result<(), ShortMeasurement> {
        self.rest = self.rest.get(length..).ok_or(ShortMeasurement(self.whole))?;
        Ok(())
    }

    fn wheel(&mut self, ticks_per_s: f64) -> Result<Turns, ShortMeasurement> {
        let count = u32::from_le_bytes(self.take()?);
        Ok(Turns { count, bits: 32, ticks: u16::from_le_bytes(self.take()?), ticks_per_s })
    }

    fn crank(&mut self) -> Result<Turns, ShortMeasurement> {
        let count = u32::from(u16::from_le_bytes(self.take()?));
        Ok(Turns { count, bits: 16, ticks: u16::from_le_bytes(self.take()?), ticks_per_s: TICKS_PER_S })
    }
}

/// Rate of turns, from one measurement to the next.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TurnRate {
    /// Last measurement with a new turn, and its arrival.
    last: Option<(Turns, Nanos)>,
    rate_hz: f64,
}

impl TurnRate {
    /// Takes the turns that arrived at `at`. Returns turns a second, `None` while they are not known.
    ///
    /// A measurement without a new turn says that a turn takes at least as long as the silence.
    pub(super) fn measure(&mut self, at: Nanos, turns: Turns) -> Option<f64> {
        let Some((last, last_at)) = self.last else {
            self.last = Some((turns, at));
            return None;
        };
        let silence_s = seconds_between(last_at, at);
        let mask = u32::MAX >> (32 - turns.bits);
        let count = turns.count.wrapping_sub(last.count) & mask;
        let elapsed_s = f64::from(turns.ticks.wrapping_sub(last.ticks)) / turns.ticks_per_s;
        if count == 0 {
            self.rate_hz = self.rate_hz.min(1.0 / silence_s);
            return Some(self.rate_hz);
        }
        self.last = Some((turns, at));
        // After a long rest the clock may have wrapped; a counter that went back has begun anew.
        if silence_s > LONGEST_GAP_S || count > mask / 2 || elapsed_s <= 0.0 {
            return Some(self.rate_hz);
        }
        self.rate_hz = f64::from(count) / elapsed_s;
        Some(self.rate_hz)
    }
}

#[cfg(test)]
mod tests {
    //! Law: a wheel and a crank of known speed read that speed across wrapping counts and clocks; cut data are
    //! refused; a wheel that stands reads zero.
    use super::*;
    use crate::clock::SECOND;

    /// Speed measurement of a wheel with 4 turns a second and a crank with 1.5, after `s` seconds. The counts wrap.
    fn speed(s: u32) -> Vec<u8> {
        let mut value = vec![3];
        value.extend((u32::MAX - 30).wrapping_add(4 * s).to_le_bytes());
        value.extend(((65_000 + 1024 * s) as u16).to_le_bytes());
        // Two seconds give three turns of the crank.
        value.extend((65_530 + s / 2 * 3).to_le_bytes()[..2].iter());
        value.extend(((s / 2 * 2048) as u16).to_le_bytes());
        value
    }

    #[test]
    fn known_turns_are_read_across_wraps() {
        let (mut wheel, mut crank) = (TurnRate::default(), TurnRate::default());
        for s in 0..80 {
            let data = RevolutionsData::of_speed(&speed(s)).unwrap();
            let at = u64::from(s) * SECOND;
            let rates = (wheel.measure(at, data.wheel.unwrap()), crank.measure(at, data.crank.unwrap()));
            if s > 2 {
                assert_eq!(rates.0, Some(4.0), "after {s} s");
                // Every other second has no new turn: at 1.5 a second there would be one.
                assert!(rates.1 == Some(1.5) || (s % 2 == 1 && rates.1 == Some(1.0)), "{rates:?} after {s} s");
            }
        }
    }

    #[test]
    fn a_power_meter_is_read_behind_its_other_fields() {
        // Balance, torque, wheel at 2048 ticks a second, crank, and angles behind: -2 W.
        let value = |turns: u32, ticks: u16| {
            let mut value = vec![0x35, 0x01, 0xfe, 0xff, 50, 7, 7];
            value.extend(turns.to_le_bytes());
            value.extend(ticks.to_le_bytes());
            value.extend([9, 0, 0, 4, 1, 2, 3]);
            value
        };
        let mut rate = TurnRate::default();
        let first = RevolutionsData::of_power(&value(10, 65_000)).unwrap();
        assert_eq!((first.power_w, first.crank.map(|turns| turns.count)), (Some(-2.0), Some(9)));
        assert_eq!(rate.measure(0, first.wheel.unwrap()), None);
        let second = RevolutionsData::of_power(&value(13, 65_000_u16.wrapping_add(1024))).unwrap();
        assert_eq!(rate.measure(SECOND / 2, second.wheel.unwrap()), Some(6.0));
    }

    #[test]
    fn data_that_are_cut_are_refused() {
        let value = speed(1);
        (0..value.len()).for_each(|length| assert!(RevolutionsData::of_speed(&value[..length]).is_err()));
        let value = [0x35, 0, 1, 0, 50, 7, 7, 1, 0, 0, 0, 2, 0, 9, 0, 0, 4];
        (0..value.len()).for_each(|length| assert!(RevolutionsData::of_power(&value[..length]).is_err()));
        assert!(RevolutionsData::of_power(&value).is_ok());
    }

    #[test]
    fn a_wheel_that_stands_reads_less_and_less() {
        let mut rate = TurnRate::default();
        let turns = |count, ticks| Turns { count, bits: 32, ticks, ticks_per_s: TICKS_PER_S };
        rate.measure(0, turns(0, 0));
        assert_eq!(rate.measure(SECOND, turns(4, 1024)), Some(4.0));
        assert_eq!(rate.measure(2 * SECOND, turns(4, 1024)), Some(1.0));
        assert_eq!(rate.measure(11 * SECOND, turns(4, 1024)), Some(0.1));
        // A sensor that restarts is no speed.
        assert_eq!(rate.measure(12 * SECOND, turns(0, 0)), Some(0.1));
    }
}
