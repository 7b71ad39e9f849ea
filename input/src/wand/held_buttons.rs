//! Buttons that are held.

use serde::{Deserialize, Serialize};

/// Set of the buttons that are held, by number from 0. Buttons beyond number 63 are passed over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct HeldButtons(pub u64);

impl HeldButtons {
    /// Number of buttons that have a place.
    pub const MOST: u32 = u64::BITS;

    /// True if this button is held.
    pub fn holds(self, button: u32) -> bool {
        button < Self::MOST && self.0 >> button & 1 == 1
    }

    /// Presses or releases a button.
    pub fn set(&mut self, button: u32, held: bool) {
        if button < Self::MOST {
            self.0 = self.0 & !(1 << button) | u64::from(held) << button;
        }
    }

    /// Numbers of the buttons that are held, in their order.
    pub fn numbers(self) -> impl Iterator<Item = u32> {
        (0..Self::MOST).filter(move |button| self.holds(*button))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_button_is_held_until_it_is_released() {
        let mut buttons = HeldButtons::default();
        for button in [0, 31, 32, 63, 64, u32::MAX] {
            buttons.set(button, true);
        }
        assert_eq!(buttons.numbers().collect::<Vec<_>>(), [0, 31, 32, 63]);
        buttons.set(31, false);
        assert_eq!(buttons.numbers().collect::<Vec<_>>(), [0, 32, 63]);
        assert!(!buttons.holds(64));
    }
}
