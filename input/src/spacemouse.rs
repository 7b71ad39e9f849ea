//! Decoder of a SpaceMouse as raw HID reports.
//!
//! The first byte is the number of the report; values are little-endian 16-bit integers, about ±350 at full
//! deflection. Report 1 carries the shifts, and on newer devices the turns as well; on older ones these come in
//! report 2. The length of report 1 tells the two kinds apart, not the product's number, because firmware differs.
//! Report 3 holds the buttons.
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

/// Actions of the first buttons.
const BUTTONS: [Action; 2] = [Action::TogglePause, Action::ToggleHelp];

/// Action of button `index` when pressed, on either back end.
pub(crate) fn button(index: usize) -> Option<Action> {
    BUTTONS.get(index).copied()
}

/// Six controls for a device's axes and their full deflection.
pub(crate) fn deflection(table: AxisTable, axes: [i32; 6], full: f64) -> [f64; 6] {
    table.controls(axes.map(|axis| with_dead_zone(f64::from(axis) / full, DEAD_ZONE)))
}

/// Decoder of [`SampleSource::SpaceMouse`](crate::SampleSource::SpaceMouse): one report a sample.
#[derive(Debug)]
pub struct SpaceMouseDecoder {
    table: AxisTable,
    axes: [i32; 6],
    last_motion: Nanos,
    buttons: u64,
    faults: Faults,
}

impl SpaceMouseDecoder {
    /// SpaceMouse at rest.
    pub fn new(table: AxisTable) -> Self {
        Self { table, axes: [0; 6], last_motion: 0, buttons: 0, faults: Faults::default() }
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

    fn buttons(&mut self, bits: &[u8], actions: &mut Actions) {
        let held = bits.iter().rev().fold(0_u64, |held, &byte| held << 8 | u64::from(byte));
        let pressed = held & !self.buttons;
        self.buttons = held;
        (0..BUTTONS.len()).filter(|index| pressed >> index & 1 == 1).filter_map(button).for_each(|it| actions.push(it));
    }
}

impl Decoder for SpaceMouseDecoder {
    fn reset(&mut self, _at: Nanos) {
        self.axes = [0; 6];
        self.buttons = 0;
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], actions: &mut Actions) {
        match bytes {
            [1, values @ ..] if matches!(values.len(), 6 | 12) => self.motion(at, 0, values),
            [2, values @ ..] if values.len() == 6 => self.motion(at, 3, values),
            [3, bits @ ..] if (1..=8).contains(&bits.len()) => self.buttons(bits, actions),
            [1..=3, ..] => {
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
        (SpaceMouseDecoder::new(AxisTable::RAW), Actions::default())
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
        for report in ["01", "01 00", "02 00 00 00 00 00 00 00", "03", "03 00 00 00 00 00 00 00 00 00"] {
            mouse.bytes(0, &hex(report), &mut actions);
        }
        mouse.bytes(0, &[], &mut actions);
        assert_eq!(mouse.faults().number(), 6);
        mouse.bytes(0, &hex("17 64"), &mut actions);
        assert_eq!(mouse.faults().number(), 6);
    }
}
