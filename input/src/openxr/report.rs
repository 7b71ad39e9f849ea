//! Report on head and hands: 209 bytes, little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 0 | edition of this format, 2 |
//! | 1–8 | i64, time of the poses on the runtime's clock, nanoseconds |
//! | 9–61, 62–114, 115–167 | pose of the head, of the left and of the right hand |
//! | 168–187, 188–207 | u32 buttons that are held, f32 × 4 axes of the left and of the right hand |
//! | 208 | how often the runtime has moved its stage so far, modulo 256; edition 1 ends before it |
//!
//! | bytes of a pose | what |
//! |---|---|
//! | 0 | what is known: 1 turn, 2 place, 4 velocity, 8 rate of turn |
//! | 1–12 | f32 × 3 place, metres |
//! | 13–28 | f32 × 4 turn, a quaternion x, y, z, w |
//! | 29–40 | f32 × 3 velocity, m/s |
//! | 41–52 | f32 × 3 rate of turn about the axes, rad/s |

use thiserror::Error;

/// Length of a report, bytes.
pub const REPORT_LENGTH: usize = 209;
/// Number of the right hand among the sensors.
pub const RIGHT_HAND: i32 = 2;
/// Number of the trigger among a hand's axes.
pub const TRIGGER_AXIS: u32 = 2;
const EDITION: u8 = 2;
/// Length of a report of edition 1, bytes.
const FIRST_LENGTH: usize = 208;
const POSE_LENGTH: usize = 53;

/// Reason why bytes are no report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum XrReportError {
    /// Bytes of another length.
    #[error("a report of {0} bytes: edition 1 has {FIRST_LENGTH}, edition {EDITION} has {REPORT_LENGTH}")]
    Length(usize),
    /// Bytes of another edition.
    #[error("a report of edition {0}: this version reads editions 1 and {EDITION}")]
    Edition(u8),
    /// A number that is not finite.
    #[error("a number of the report is not finite")]
    Number,
}

/// Pose of the head or of a hand, with what the runtime knows of it.
///
/// *Frames, units*: the runtime's stage; metres, seconds, radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct XrPose {
    /// Place.
    pub position_m: Option<[f32; 3]>,
    /// Turn `stage_from_sensor`, a quaternion x, y, z, w.
    pub orientation: Option<[f32; 4]>,
    /// Velocity.
    pub velocity_m_s: Option<[f32; 3]>,
    /// Rate of turn about the stage's axes.
    pub turning_rad_s: Option<[f32; 3]>,
}

/// Hand with its controller.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct XrHand {
    /// Pose in which the hand aims.
    pub pose: XrPose,
    /// Buttons that are held, a bit each: 0 chooses, 1 the menu, 2 the stick's, 3 the grip's.
    pub buttons: u32,
    /// Stick to the right and ahead, −1 to 1; trigger and grip, 0 to 1.
    pub axes: [f32; 4],
}

/// Report on head and hands at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct XrReport {
    /// Time of the poses on the runtime's clock, nanoseconds.
    pub time_ns: i64,
    /// Pose of the head.
    pub head: XrPose,
    /// Left and right hand.
    pub hands: [XrHand; 2],
    /// Number of times that the runtime has moved its stage so far, modulo 256: by its own recentring, or as its room
    /// was set up anew.
    pub stage_moves: u8,
}

impl XrPose {
    fn write(&self, bytes: &mut Vec<u8>) {
        let known = [
            self.orientation.is_some(),
            self.position_m.is_some(),
            self.velocity_m_s.is_some(),
            self.turning_rad_s.is_some(),
        ];
        bytes.push(known.iter().enumerate().map(|(bit, is_known)| u8::from(*is_known) << bit).sum());
        for numbers in [
            &self.position_m.unwrap_or_default()[..],
            &self.orientation.unwrap_or_default(),
            &self.velocity_m_s.unwrap_or_default(),
            &self.turning_rad_s.unwrap_or_default(),
        ] {
            numbers.iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        }
    }

    fn read(bytes: &mut Bytes<'_>) -> Result<Self, XrReportError> {
        let [known] = bytes.take();
        let (position_m, orientation) = (bytes.numbers()?, bytes.numbers()?);
        let (velocity_m_s, turning_rad_s) = (bytes.numbers()?, bytes.numbers()?);
        Ok(Self {
            orientation: (known & 1 != 0).then_some(orientation),
            position_m: (known & 2 != 0).then_some(position_m),
            velocity_m_s: (known & 4 != 0).then_some(velocity_m_s),
            turning_rad_s: (known & 8 != 0).then_some(turning_rad_s),
        })
    }
}

impl XrReport {
    /// Bytes of the report.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(REPORT_LENGTH);
        bytes.push(EDITION);
        bytes.extend(self.time_ns.to_le_bytes());
        self.head.write(&mut bytes);
        self.hands.iter().for_each(|hand| hand.pose.write(&mut bytes));
        for hand in &self.hands {
            bytes.extend(hand.buttons.to_le_bytes());
            hand.axes.iter().for_each(|axis| bytes.extend(axis.to_le_bytes()));
        }
        bytes.push(self.stage_moves);
        bytes
    }

    /// Report after which nothing is seen or held: the headset rests, or the hands are another program's.
    pub fn at_rest(&self) -> Self {
        Self { time_ns: self.time_ns, stage_moves: self.stage_moves, ..Self::default() }
    }

    /// Report of these bytes.
    ///
    /// # Errors
    /// Bytes that are no report.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, XrReportError> {
        match (bytes.len(), bytes.first()) {
            (FIRST_LENGTH, Some(1)) | (REPORT_LENGTH, Some(&EDITION)) => {}
            (FIRST_LENGTH | REPORT_LENGTH, Some(&edition)) if !(1..=EDITION).contains(&edition) => {
                return Err(XrReportError::Edition(edition));
            }
            (length, _) => return Err(XrReportError::Length(length)),
        }
        let mut bytes = Bytes(bytes);
        let [_edition] = bytes.take();
        let time_ns = i64::from_le_bytes(bytes.take());
        let poses = [XrPose::read(&mut bytes)?, XrPose::read(&mut bytes)?, XrPose::read(&mut bytes)?];
        let mut hands = [poses[1], poses[2]].map(|pose| XrHand { pose, ..XrHand::default() });
        for hand in &mut hands {
            hand.buttons = u32::from_le_bytes(bytes.take());
            hand.axes = bytes.numbers()?;
        }
        let [stage_moves] = bytes.take();
        Ok(Self { time_ns, head: poses[0], hands, stage_moves })
    }
}

/// Rest of a report whose length has been checked.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    /// Next `N` bytes; zeros behind the end.
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (first, rest) = self.0.split_first_chunk::<N>().unwrap_or((&[0; N], &[]));
        self.0 = rest;
        *first
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f32; N], XrReportError> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = f32::from_le_bytes(self.take());
        }
        if numbers.iter().all(|number| number.is_finite()) { Ok(numbers) } else { Err(XrReportError::Number) }
    }
}

const _: () = assert!(1 + 8 + 3 * POSE_LENGTH + 2 * 20 == FIRST_LENGTH && FIRST_LENGTH + 1 == REPORT_LENGTH);

#[cfg(test)]
pub(super) mod tests {
    //! Law: a report survives its bytes, whatever is known of each pose; reports of edition 1 are read; what is no
    //! report is told from one.
    use super::*;

    /// Report in which every number differs.
    pub fn report() -> XrReport {
        let mut count = 0.0_f32;
        let mut next = || {
            count += 1.0;
            count / 64.0
        };
        let mut pose = || XrPose {
            position_m: Some([next(), next(), next()]),
            orientation: Some([0.0, 0.6, 0.0, 0.8]),
            velocity_m_s: Some([next(), next(), next()]),
            turning_rad_s: Some([next(), next(), next()]),
        };
        let head = pose();
        let hands = [1, 2].map(|hand| XrHand { pose: pose(), buttons: hand, axes: [0.25, -0.5, 0.75, 1.0] });
        XrReport { time_ns: -7_000_000_001, head, hands, stage_moves: 3 }
    }

    #[test]
    fn a_report_survives_its_bytes() {
        let whole = report();
        for known in 0..16_u32 {
            let mut report = whole;
            for (bit, pose) in [&mut report.hands[0].pose, &mut report.head].into_iter().enumerate() {
                let has = |number: usize| known.rotate_left(bit as u32) >> number & 1 == 1;
                pose.orientation = pose.orientation.filter(|_| has(0));
                pose.position_m = pose.position_m.filter(|_| has(1));
                pose.velocity_m_s = pose.velocity_m_s.filter(|_| has(2));
                pose.turning_rad_s = pose.turning_rad_s.filter(|_| has(3));
            }
            let bytes = report.to_bytes();
            assert_eq!((bytes.len(), XrReport::from_bytes(&bytes)), (REPORT_LENGTH, Ok(report)));
        }
    }

    #[test]
    fn the_layout_is_the_one_that_is_written_down() {
        let bytes = report().to_bytes();
        let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!((bytes[0], bytes[9], bytes[208]), (2, 15, 3));
        assert_eq!(i64::from_le_bytes(bytes[1..9].try_into().unwrap()), -7_000_000_001);
        assert_eq!([number(10), number(14), number(18)], report().head.position_m.unwrap());
        assert_eq!(number(10 + 12 + 4), 0.6);
        assert_eq!(number(63), report().hands[0].pose.position_m.unwrap()[0]);
        assert_eq!((bytes[168], number(172), bytes[188], number(204)), (1, 0.25, 2, 1.0));
    }

    #[test]
    fn a_report_of_edition_1_is_one_without_moves() {
        let mut bytes = report().to_bytes();
        bytes.truncate(208);
        bytes[0] = 1;
        assert_eq!(XrReport::from_bytes(&bytes), Ok(XrReport { stage_moves: 0, ..report() }));
    }

    #[test]
    fn what_is_no_report_is_told() {
        let good = report().to_bytes();
        let changed = |at: usize, with: &[u8]| {
            let mut bytes = good.clone();
            bytes[at..at + with.len()].copy_from_slice(with);
            XrReport::from_bytes(&bytes)
        };
        assert_eq!(XrReport::from_bytes(&good[2..]), Err(XrReportError::Length(207)));
        assert_eq!(XrReport::from_bytes(&good[..208]), Err(XrReportError::Length(208)));
        assert_eq!(changed(0, &[1]), Err(XrReportError::Length(209)));
        assert_eq!(changed(0, &[3]), Err(XrReportError::Edition(3)));
        for at in [10, 30, 63, 204] {
            assert_eq!(changed(at, &f32::NAN.to_le_bytes()), Err(XrReportError::Number), "{at}");
        }
    }
}
