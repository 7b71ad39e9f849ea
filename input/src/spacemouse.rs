//! Decoder of a SpaceMouse as raw HID reports.
//!
//! The first byte is the number of the report; values are little-endian 16-bit integers, about ±350 at full
//! deflection. Report 1 carries the shifts, and on newer devices the turns as well; on older ones these come in
//! report 2. The length of report 1 tells the two kinds apart, not the product's number, because firmware differs.
//! Report 3 holds the buttons as bits, the first in the lowest. Devices with many buttons (SpaceMouse Enterprise) name
//! those that are held in report 28 (0x1c) as well: up to six numbers of 16 bits, from 1, and zeros. Both reports
//! together say what is held.
//!
//! A deflected cap reports at 60 Hz and more, and a released one ends with zeros. If these are lost, flight must not
//! continue: after half a second of silence the cap counts as released.

use crate::action::Action;
use crate::axis_table::AxisTable;
use crate::clock::{Nanos, seconds_between};
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::filters::with_dead_zone;

/// Nominal full deflection; a hard push exceeds it.
const FULL_DEFLECTION: f64 = 350.0;
/// Part of the range within which a cap counts as centred, since caps drift.
const DEAD_ZONE: f64 = 0.03;
/// Silence after which a cap counts as released, seconds.
const RELEASED_AFTER_S: f64 = 0.5;

/// Report of the numbers of the buttons that are held.
const HELD_REPORT: u8 = 0x1c;
/// Length of the longest report, bytes, as the transport gives it.
const LONGEST_REPORT: usize = 64;
/// Bytes for the bits of all buttons; numbers go up to 255.
const BUTTON_BYTES: usize = 32;

/// Actions of the first buttons.
const BUTTONS: [Action; 2] = [Action::TogglePause, Action::ToggleHelp];

/// Action of button `index` when pressed, on either back end.
pub(crate) fn button(index: usize) -> Option<Action> {
    BUTTONS.get(index).cloned()
}

/// Six controls for a device's axes and their full deflection.
pub(crate) fn deflection(table: AxisTable, axes: [i32; 6], full: f64) -> [f64; 6] {
    table.controls(axes.map(|axis| with_dead_zone(f64::from(axis) / full, DEAD_ZONE)))
}

/// Bits of the buttons, the first in the lowest of the first byte.
type ButtonBits = [u8; BUTTON_BYTES];

/// Decoder of [`SampleSource::SpaceMouse`](crate::SampleSource::SpaceMouse): one report a sample.
#[derive(Debug)]
pub struct SpaceMouseDecoder {
    table: AxisTable,
    /// True if reports of many buttons count.
    many_buttons: bool,
    axes: [i32; 6],
    last_motion: Nanos,
    /// Bits of the buttons that are held, by report 3 and by report 28.
    by_bits: ButtonBits,
    by_numbers: ButtonBits,
    faults: Faults,
}

impl SpaceMouseDecoder {
    /// SpaceMouse at rest. `many_buttons`: reports of more than 64 buttons, and those of their numbers, count.
    pub fn new(table: AxisTable, many_buttons: bool) -> Self {
        Self {
            table,
            many_buttons,
            axes: [0; 6],
            last_motion: 0,
            by_bits: [0; _],
            by_numbers: [0; _],
            faults: Faults::default(),
        }
    }

    /// Thrust right, up, backward and turn nose up, nose left, roll left, each −1 to 1.
    pub fn deflection(&self, at: Nanos) -> [f64; 6] {
        if seconds_between(self.last_motion, at) > RELEASED_AFTER_S {
            return [0.0; 6];
        }
        deflection(self.table, self.axes, FULL_DEFLECTION)
    }

    fn motion(&mut self, at: Nanos, first: usize, values: &[u8]) {
        for (axis, bytes) in self.axes[first..].iter_mut().zip(values.as_chunks::<2>().0) {
            *axis = i32::from(i16::from_le_bytes(*bytes));
        }
        self.last_motion = at;
    }

    /// Numbers of the buttons that are held, from 0.
    pub fn held(&self) -> impl Iterator<Item = usize> {
        (0..8 * BUTTON_BYTES).filter(|&index| self.holds(index))
    }

    fn holds(&self, index: usize) -> bool {
        (self.by_bits[index / 8] | self.by_numbers[index / 8]) >> (index % 8) & 1 == 1
    }

    /// Takes what a report of buttons says, and acts on those that it adds.
    fn buttons(&mut self, take: impl FnOnce(&mut Self), actions: &mut Actions) {
        let before = [0, 1].map(|index| self.holds(index));
        take(self);
        let pressed = (0..BUTTONS.len()).filter(|&index| self.holds(index) && !before[index]);
        pressed.filter_map(button).for_each(|it| actions.push(it));
    }

    fn bits(&mut self, bits: &[u8]) {
        self.by_bits = [0; _];
        self.by_bits.iter_mut().zip(bits).for_each(|(known, byte)| *known = *byte);
    }

    fn numbers(&mut self, numbers: &[u8]) {
        self.by_numbers = [0; _];
        for number in numbers.as_chunks::<2>().0 {
            let index = usize::from(u16::from_le_bytes(*number)).wrapping_sub(1);
            if let Some(byte) = self.by_numbers.get_mut(index / 8) {
                *byte |= 1 << (index % 8);
            }
        }
    }
}

impl Decoder for SpaceMouseDecoder {
    fn reset(&mut self, _at: Nanos) {
        self.axes = [0; 6];
        (self.by_bits, self.by_numbers) = ([0; _], [0; _]);
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], actions: &mut Actions) {
        match bytes {
            [1, values @ ..] if matches!(values.len(), 6 | 12) => self.motion(at, 0, values),
            [2, values @ ..] if values.len() == 6 => self.motion(at, 3, values),
            // Recordings made before these reports were understood pass over the numbers, and refuse long ones.
            [HELD_REPORT, ..] if !self.many_buttons => {}
            [3, bits @ ..] if !self.many_buttons && bits.len() > 8 => {
                self.faults.count(format!("report 3 of {} bytes", bytes.len()));
            }
            [3, bits @ ..] if (1..LONGEST_REPORT).contains(&bits.len()) => self.buttons(|it| it.bits(bits), actions),
            [HELD_REPORT, numbers @ ..] if (2..LONGEST_REPORT).contains(&numbers.len()) && numbers.len() % 2 == 0 => {
                self.buttons(|it| it.numbers(numbers), actions);
            }
            [1..=3 | HELD_REPORT, ..] => {
                let what = format!("report {} of {} bytes", bytes[0], bytes.len());
                self.faults.count(what);
            }
            // Battery level and the like are passed over.
            [_, ..] => {}
            [] => self.faults.count("an empty report"),
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! Reports captured from real devices must give their push; a lost zero must not keep the flight going.
    use super::*;
    use crate::clock::SECOND;

    fn decoder() -> (SpaceMouseDecoder, Actions) {
        (SpaceMouseDecoder::new(AxisTable::RAW, true), Actions::default())
    }

    fn hex(text: &str) -> Vec<u8> {
        text.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
    }

    #[test]
    fn split_reports_of_a_compact() {
        let (mut mouse, mut actions) = decoder();
        mouse.bytes(0, &hex("01 12 00 00 00 f8 00"), &mut actions);
        mouse.bytes(0, &hex("02 20 00 00 00 17 00"), &mut actions);
        assert_eq!(mouse.axes, [18, 0, 248, 32, 0, 23]);
        let [right, up, back, nose_up, nose_left, roll_left] = mouse.deflection(0);
        assert_eq!([right, back, roll_left], [(18.0 / 350.0 - 0.03) / 0.97, 0.0, 0.0]);
        assert_eq!(up, -(248.0 / 350.0 - 0.03) / 0.97);
        assert!(nose_up > 0.0 && nose_left < 0.0);
    }

    #[test]
    fn combined_reports_of_a_wireless() {
        let (mut mouse, mut actions) = decoder();
        mouse.bytes(0, &hex("01 16 00 00 00 00 00 00 00 00 00 00 00"), &mut actions);
        assert_eq!(mouse.axes, [22, 0, 0, 0, 0, 0]);
        mouse.bytes(0, &hex("01 00 00 00 00 00 00 00 00 00 00 a2 fe"), &mut actions);
        assert_eq!(mouse.axes, [0, 0, 0, 0, 0, -350]);
        assert_eq!(mouse.deflection(0)[4], 1.0);
    }

    /// A decoder of today that reads a ride of yesterday must not press what was not pressed then.
    #[test]
    fn an_old_recording_knows_no_more_than_64_buttons_and_no_numbers() {
        let mut mouse = SpaceMouseDecoder::new(AxisTable::RAW, false);
        let mut actions = Actions::default();
        mouse.bytes(0, &hex("1c 01 00"), &mut actions);
        assert_eq!(mouse.faults().number(), 0);
        mouse.bytes(0, &hex("03 01 00 00 00 00 00 00 00 00"), &mut actions);
        assert_eq!((mouse.faults().number(), actions.take()), (1, vec![]));
        mouse.bytes(0, &hex("03 01 00 00 00 00 00 00 00"), &mut actions);
        assert_eq!(actions.take(), [Action::TogglePause]);
    }

    #[test]
    fn buttons_act_once_when_pressed() {
        let (mut mouse, mut actions) = decoder();
        for report in ["03 01 00", "03 01 00", "03 00 00", "03 03 00", "03 00 10 00 00 00 00"] {
            mouse.bytes(0, &hex(report), &mut actions);
        }
        assert_eq!(actions.take(), [Action::TogglePause, Action::TogglePause, Action::ToggleHelp]);
        assert_eq!(mouse.faults().number(), 0);
    }

    #[test]
    fn the_many_buttons_of_an_enterprise_come_as_bits_and_as_numbers() {
        let (mut mouse, mut actions) = decoder();
        // Bits of buttons 0, 30 and, in a longer report, 40; numbers of buttons 0, 35 and 104.
        mouse.bytes(0, &hex("03 01 00 00 40"), &mut actions);
        assert_eq!(mouse.held().collect::<Vec<_>>(), [0, 30]);
        mouse.bytes(0, &hex("1c 01 00 24 00 69 00 00 00 00 00 00 00"), &mut actions);
        assert_eq!(mouse.held().collect::<Vec<_>>(), [0, 30, 35, 104]);
        // Both reports name the first button, which acts once.
        assert_eq!(actions.take(), [Action::TogglePause]);
        mouse.bytes(0, &hex("03 00 00 00 00 00 01 00 00 00 00 00"), &mut actions);
        assert_eq!(mouse.held().collect::<Vec<_>>(), [0, 35, 40, 104]);
        mouse.bytes(0, &hex("1c 02 00 00 00 ff ff 00 02 01 02 00 00"), &mut actions);
        assert_eq!(mouse.held().collect::<Vec<_>>(), [1, 40]);
        mouse.bytes(0, &hex("1c 00 00 00 00 00 00 00 00 00 00 00 00"), &mut actions);
        assert_eq!((mouse.held().collect::<Vec<_>>(), actions.take()), (vec![40], vec![Action::ToggleHelp]));
        mouse.reset(0);
        assert_eq!((mouse.held().count(), mouse.faults().number()), (0, 0));
    }

    #[test]
    fn a_hard_push_is_clamped_and_a_drifting_cap_rests() {
        let (mut mouse, mut actions) = decoder();
        mouse.bytes(0, &hex("01 ff 7f 00 80 05 00"), &mut actions);
        assert_eq!(mouse.deflection(0)[..3], [1.0, 0.0, -1.0]);
    }

    #[test]
    fn a_lost_zero_stops_after_half_a_second() {
        let (mut mouse, mut actions) = decoder();
        mouse.bytes(SECOND, &hex("01 5e 01 00 00 00 00"), &mut actions);
        assert_eq!(mouse.deflection(SECOND + SECOND / 2)[0], 1.0);
        assert_eq!(mouse.deflection(SECOND + SECOND / 2 + 1)[0], 0.0);
    }

    #[test]
    fn unplugging_stops() {
        let (mut mouse, mut actions) = decoder();
        mouse.bytes(0, &hex("01 5e 01 00 00 00 00"), &mut actions);
        mouse.reset(0);
        assert_eq!(mouse.deflection(0), [0.0; 6]);
    }

    #[test]
    fn odd_reports_are_counted_and_others_passed_over() {
        let (mut mouse, mut actions) = decoder();
        for report in ["01", "01 00", "02 00 00 00 00 00 00 00", "03", "1c 01 00 02"] {
            mouse.bytes(0, &hex(report), &mut actions);
        }
        mouse.bytes(0, &[], &mut actions);
        assert_eq!(mouse.faults().number(), 6);
        mouse.bytes(0, &hex("17 64"), &mut actions);
        assert_eq!(mouse.faults().number(), 6);
    }
}
