//! Flysticks in the lines `6df2` and `6df`.

use glam::{DMat3, DVec3};

use super::bodies::DtrackBody;
use super::wire::{DtrackError, block, count, finite, numbers};
use crate::wand::held_buttons::HeldButtons;

/// Most buttons of a flystick that are accepted; ART's have 16 at most.
const MOST_BUTTONS: usize = 256;
/// Most axes of a flystick that are accepted; ART's have 8 at most.
const MOST_STICK_AXES: usize = 64;
/// Buttons of one word.
const WORD: usize = 32;

/// Flystick in a frame.
pub(super) struct Flystick {
    pub(super) number: i32,
    /// Pose of the flystick; `None` if the cameras do not see it. Its buttons come by radio.
    pub(super) body: Option<DtrackBody>,
    pub(super) buttons: HeldButtons,
    pub(super) axes: Vec<f64>,
}

/// Flysticks of a `6df2` line.
pub(super) fn flysticks(line: &str) -> Result<Vec<Flystick>, DtrackError> {
    const BAD: DtrackError = DtrackError::Line {
        line: "6df2",
        expected: "two numbers of flysticks and as many [id quality buttons axes][3 numbers][9 numbers][words axes]",
    };
    let (_calibrated, rest) = count(line).ok_or(BAD)?;
    let (count, mut rest) = count(rest).ok_or(BAD)?;
    let mut flysticks = Vec::new();
    while !rest.trim_start().is_empty() {
        let mut fields = block(&mut rest).ok_or(BAD)?.split_ascii_whitespace();
        let mut next = || fields.next().ok_or(BAD);
        let number = next()?.parse().map_err(|_| BAD)?;
        let quality = finite(next()?).ok_or(BAD)?;
        let button_count: usize = next()?.parse().map_err(|_| BAD)?;
        let axis_count: usize = next()?.parse().map_err(|_| BAD)?;
        let position_mm = block(&mut rest).and_then(numbers::<3>).map(DVec3::from_array).ok_or(BAD)?;
        let rotation = block(&mut rest).and_then(numbers::<9>).ok_or(BAD)?;
        let controls = block(&mut rest).ok_or(BAD)?;
        if button_count > MOST_BUTTONS || axis_count > MOST_STICK_AXES {
            return Err(BAD);
        }

        let words = button_count.div_ceil(WORD);
        let fields: Vec<&str> = controls.split_ascii_whitespace().collect();
        if fields.len() != words + axis_count {
            return Err(BAD);
        }
        let mut buttons = HeldButtons::default();
        for (index, word) in fields[..words].iter().enumerate() {
            let word = word_bits(word).ok_or(BAD)?;
            for button in (WORD * index..button_count).take(WORD) {
                buttons.set(button as u32, word >> (button % WORD) & 1 == 1);
            }
        }
        let axes = fields[words..].iter().map(|axis| finite(axis)).collect::<Option<_>>().ok_or(BAD)?;

        let seen = DtrackBody { number, position_mm, rotation: DMat3::from_cols_array(&rotation) };
        flysticks.push(Flystick { number, body: (quality >= 0.0).then_some(seen), buttons, axes });
    }
    if flysticks.len() == count { Ok(flysticks) } else { Err(BAD) }
}

/// Flysticks of a `6df` line. The upper four of the eight buttons are the directions of a switch: down, left, up,
/// right. They count as buttons and as two axes, as in ART's own library.
pub(super) fn old_flysticks(line: &str) -> Result<Vec<Flystick>, DtrackError> {
    const BAD: DtrackError = DtrackError::Line {
        line: "6df",
        expected: "a number of flysticks and as many [id quality buttons][6 numbers][9 numbers]",
    };
    let (count, mut rest) = count(line).ok_or(BAD)?;
    let mut flysticks = Vec::new();
    while !rest.trim_start().is_empty() {
        let mut fields = block(&mut rest).ok_or(BAD)?.split_ascii_whitespace();
        let mut next = || fields.next().ok_or(BAD);
        let number = next()?.parse().map_err(|_| BAD)?;
        let quality = finite(next()?).ok_or(BAD)?;
        let bits = word_bits(next()?).ok_or(BAD)? & 0xff;
        let [x, y, z, ..] = block(&mut rest).and_then(numbers::<6>).ok_or(BAD)?;
        let rotation = block(&mut rest).and_then(numbers::<9>).ok_or(BAD)?;
        let direction = |negative: u32, positive: u32| {
            f64::from(u8::from(bits & positive != 0)) - f64::from(u8::from(bits & negative != 0))
        };
        let axes = vec![direction(0x20, 0x80), direction(0x10, 0x40)];
        let seen = DtrackBody { number, position_mm: DVec3::new(x, y, z), rotation: DMat3::from_cols_array(&rotation) };
        let body = (quality >= 0.0).then_some(seen);
        flysticks.push(Flystick { number, body, buttons: HeldButtons(u64::from(bits)), axes });
    }
    if flysticks.len() == count { Ok(flysticks) } else { Err(BAD) }
}

/// Word of 32 buttons, which may be printed with or without a sign.
fn word_bits(text: &str) -> Option<u32> {
    text.parse::<u32>().or_else(|_| text.parse::<i32>().map(i32::cast_unsigned)).ok()
}

#[cfg(test)]
mod tests {
    //! Laws: each bit is its button and each number its axis; a count that lies gives nothing.
    use super::*;

    const EYE: &str = "[1 0 0 0 1 0 0 0 1]";

    #[test]
    fn buttons_are_packed_by_thirty_two() {
        let line = format!("2 2 [0 1.000 6 2][1 2 3]{EYE}[5 0.50 -1.00] [1 -1.000 34 0][0 0 0]{EYE}[-2147483648 2]");
        let [first, second] = &flysticks(&line).unwrap()[..] else { panic!() };
        assert_eq!((first.number, first.buttons, first.axes.as_slice()), (0, HeldButtons(5), &[0.5, -1.0][..]));
        assert_eq!(first.body.as_ref().unwrap().position_mm, DVec3::new(1.0, 2.0, 3.0));
        // A flystick that is not seen has its buttons all the same.
        assert_eq!((second.number, second.buttons, second.body.is_none()), (1, HeldButtons(1 << 31 | 1 << 33), true));
        assert!(flysticks("0 0 ").unwrap().is_empty() && flysticks("2 0").unwrap().is_empty());
        // Bits beyond the number of buttons are none.
        let line = format!("1 1 [0 1.000 2 0][1 2 3]{EYE}[255]");
        assert_eq!(flysticks(&line).unwrap()[0].buttons, HeldButtons(3));
        let line = format!("1 1 [0 1.000 0 0][1 2 3]{EYE}[]");
        assert_eq!(flysticks(&line).unwrap()[0].buttons, HeldButtons(0));
    }

    #[test]
    fn an_older_flystick_has_eight_buttons_and_a_switch() {
        let line = format!("1 [3 1.000 {}][1 2 3 0 0 0]{EYE}", 0x81 | 0x10);
        let flystick = &old_flysticks(&line).unwrap()[0];
        assert_eq!(
            (flystick.number, flystick.buttons, flystick.axes.as_slice()),
            (3, HeldButtons(0x91), &[1.0, -1.0][..])
        );
        assert!(old_flysticks("1 ").is_err() && old_flysticks("x").is_err());
    }

    #[test]
    fn a_count_that_lies_gives_nothing() {
        for head in
            ["[0 1.000 6 3]", "[0 1.000 33 2]", "[0 1.000 4294967295 2]", "[0 1.000 6]", "[0 x 6 2]", "[0 1 -6 2]"]
        {
            assert!(flysticks(&format!("1 1 {head}[1 2 3]{EYE}[5 0.5 -1]")).is_err(), "{head}");
        }
        for count in ["2", "0", "-1", "4294967296000000000000"] {
            assert!(flysticks(&format!("1 {count} [0 1.000 6 2][1 2 3]{EYE}[5 0.5 -1]")).is_err(), "{count}");
        }
        assert!(flysticks(&format!("1 1 [0 1.000 6 2][1 2 3]{EYE}[5 nan -1]")).is_err());
    }
}
