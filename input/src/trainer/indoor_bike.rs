//! Indoor Bike Data: the notification of a trainer's speed, cadence and power (FTMS 1.0, 4.9).
//!
//! A field of 16 flags says which fields follow, in the order of its bits and with the low byte first. Bit 0, "more
//! data", is the other way round: the speed is there where it is *clear*. A trainer with more fields than fit divides
//! them among several notifications, of which the last has the speed.

use thiserror::Error;

/// Bit of the flags that says that there is no speed.
const MORE_DATA: u16 = 1;
/// Lengths of the fields from bit 1 on, bytes: average speed, cadence, average cadence, distance, resistance, power,
/// average power, energy (in all, each hour, each minute), heart rate, metabolic equivalent, elapsed and remaining
/// time.
const LENGTHS: [usize; 12] = [2, 2, 2, 3, 2, 2, 2, 5, 1, 1, 2, 2];
/// Bits of the fields that are read, or whose length varies.
const CADENCE: usize = 2;
const RESISTANCE: usize = 5;
const POWER: usize = 6;

/// Bike data that are shorter than their flags say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("indoor bike data of {found} bytes, whose flags {flags:#06x} ask for {expected}")]
pub(super) struct ShortBikeData {
    /// Flags of the data.
    flags: u16,
    /// Number of bytes that there are.
    found: usize,
    /// Number of bytes that the flags ask for.
    expected: usize,
}

/// Part of the bike data that a ride uses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct IndoorBikeData {
    /// Speed, m/s.
    pub(super) speed_m_s: Option<f64>,
    /// Turns of the crank a second.
    pub(super) cadence_hz: Option<f64>,
    /// Power of the rider, watts.
    pub(super) power_w: Option<f64>,
}

impl IndoorBikeData {
    /// Parses a notification's value. Bytes behind the known fields are passed over.
    ///
    /// # Errors
    /// [`ShortBikeData`] if fields are missing that the flags announce.
    pub(super) fn parse(value: &[u8]) -> Result<Self, ShortBikeData> {
        let short = |flags, expected| ShortBikeData { flags, found: value.len(), expected };
        let (flags, mut rest) = value.split_first_chunk().ok_or(short(0, 2))?;
        let flags = u16::from_le_bytes(*flags);
        let has = |bit: usize| flags & 1 << bit != 0;
        let lengths = (1..).zip(LENGTHS).filter(|(bit, _)| has(*bit));
        let speed_length = if flags & MORE_DATA == 0 { 2 } else { 0 };
        let expected = 2 + speed_length + lengths.clone().map(|(_, length)| length).sum::<usize>();
        // Later editions of the service give the resistance one byte.
        let missing = expected.saturating_sub(value.len());
        let narrow = missing == 1 && has(RESISTANCE);
        if missing > usize::from(narrow) {
            return Err(short(flags, expected));
        }

        let mut data = Self::default();
        if speed_length > 0 {
            data.speed_m_s = Some(f64::from(u16::from_le_bytes(word(&mut rest))) * 0.01 / 3.6);
        }
        for (bit, length) in lengths {
            match bit {
                CADENCE => data.cadence_hz = Some(f64::from(u16::from_le_bytes(word(&mut rest))) * 0.5 / 60.0),
                POWER => data.power_w = Some(f64::from(i16::from_le_bytes(word(&mut rest)))),
                RESISTANCE if narrow => rest = &rest[1..],
                _ => rest = &rest[length..],
            }
        }
        Ok(data)
    }
}

/// Next two bytes, which are there because the length was checked.
fn word(rest: &mut &[u8]) -> [u8; 2] {
    let (word, behind) = rest.split_first_chunk().expect("the length was checked");
    *rest = behind;
    *word
}

#[cfg(test)]
mod tests {
    //! Law: whatever else a trainer sends, its speed, cadence and power are found; data that are cut are refused.
    use super::*;

    /// Value with the fields of the flags: 36 km/h, 90 turns a minute, 250 W, and odd bytes in all others.
    fn value(flags: u16, resistance: usize) -> Vec<u8> {
        let mut value = flags.to_le_bytes().to_vec();
        if flags & MORE_DATA == 0 {
            value.extend(3600_u16.to_le_bytes());
        }
        for (bit, length) in (1..).zip(LENGTHS).filter(|(bit, _)| flags & 1 << bit != 0) {
            match bit {
                CADENCE => value.extend(180_u16.to_le_bytes()),
                POWER => value.extend(250_i16.to_le_bytes()),
                RESISTANCE => value.extend([0x9b, 0xf3].iter().take(resistance)),
                _ => value.extend(vec![0xe7; length]),
            }
        }
        value
    }

    #[test]
    fn recorded_data_are_read() {
        // As a simulator sent them at 36 km/h, 82 turns a minute and 150 W, with a heart rate.
        let heard = [0x44, 0x02, 0x10, 0x0e, 0xa4, 0x00, 0x96, 0x00, 0x8c];
        let data = IndoorBikeData::parse(&heard).unwrap();
        assert!((data.speed_m_s.unwrap() - 10.0).abs() < 1e-12);
        assert!((data.cadence_hz.unwrap() - 82.0 / 60.0).abs() < 1e-12);
        assert_eq!(data.power_w, Some(150.0));
    }

    #[test]
    fn every_set_of_fields_is_skipped_to_the_byte() {
        for flags in 0..1 << 13 {
            for resistance in [2, 1] {
                let value = value(flags, resistance);
                let data = IndoorBikeData::parse(&value).unwrap();
                let has = |bit: usize| flags & 1 << bit != 0;
                assert_eq!(data.speed_m_s, (flags & MORE_DATA == 0).then_some(3600.0 * 0.01 / 3.6), "{flags:#x}");
                assert_eq!(data.cadence_hz, has(CADENCE).then_some(1.5), "{flags:#x}");
                assert_eq!(data.power_w, has(POWER).then_some(250.0), "{flags:#x}");
                // What a later edition appends changes nothing, unless it could be the resistance.
                if resistance == 2 {
                    assert_eq!(IndoorBikeData::parse(&[&value[..], &[1, 2, 3]].concat()), Ok(data));
                    let cut = if has(RESISTANCE) { 2 } else { 1 };
                    assert!(IndoorBikeData::parse(&value[..value.len() - cut]).is_err(), "{flags:#x}");
                }
            }
        }
    }

    #[test]
    fn a_power_below_zero_and_flags_of_the_future_are_read() {
        let data = IndoorBikeData::parse(&[0x40, 0xe0, 0, 0, 0xff, 0xff, 9, 9]).unwrap();
        assert_eq!((data.speed_m_s, data.power_w), (Some(0.0), Some(-1.0)));
        let short = IndoorBikeData::parse(&[0x44]).unwrap_err().to_string();
        assert_eq!(short, "indoor bike data of 1 bytes, whose flags 0x0000 ask for 2");
    }
}
