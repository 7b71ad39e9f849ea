//! Flicks of a stick to a side: one for each way out of the middle.

/// Deflection from which on a stick counts as flicked, and up to which it is back in the middle.
const FLICKED: f64 = 0.7;
const MIDDLE: f64 = 0.35;

/// Watch over a stick. It is armed in the middle alone, so a stick that is held to a side flicks once, and one that
/// is first seen there does not.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StickFlick {
    armed: bool,
}

impl StickFlick {
    /// Disarms it: nobody holds the stick, or another program has it.
    pub(crate) fn let_go(&mut self) {
        self.armed = false;
    }

    /// Side to which the stick has been flicked: 1 to the left, −1 to the right, 0 if it has not. `right` and `ahead`
    /// are its deflections, each −1 to 1; one that goes ahead or back more than aside is no flick.
    pub(crate) fn take(&mut self, right: f64, ahead: f64) -> i32 {
        if right.abs() <= MIDDLE && ahead.abs() <= MIDDLE {
            self.armed = true;
            return 0;
        }
        let flicked = self.armed && right.abs() >= FLICKED && right.abs() > ahead.abs();
        if !flicked {
            return 0;
        }
        self.armed = false;
        if right < 0.0 { 1 } else { -1 }
    }
}

#[cfg(test)]
mod tests {
    //! Law: a way out of the middle to a side is one flick to that side, however long the stick stays there and
    //! whatever it does on the way back.
    use super::*;

    #[test]
    fn a_stick_flicks_once_for_each_way_out_of_the_middle() {
        let mut flick = StickFlick::default();
        let way = [1.0, 0.0, 0.5, 0.71, 1.0, 0.6, 0.9, 0.36, 0.9, -0.9, 0.3, -0.69, -0.7, -1.0, 0.0, 0.0];
        let flicks = way.map(|right| flick.take(right, 0.0));
        assert_eq!(flicks, [0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]);
    }

    #[test]
    fn a_stick_that_goes_ahead_does_not_flick_and_takes_part_in_arming() {
        let mut flick = StickFlick::default();
        assert_eq!([(0.0, 0.0), (0.75, 0.8), (0.75, -0.76)].map(|(right, ahead)| flick.take(right, ahead)), [0; 3]);
        assert_eq!(flick.take(-0.8, 0.1), 1);
        assert_eq!([(0.0, 1.0), (0.9, 0.0)].map(|(right, ahead)| flick.take(right, ahead)), [0; 2]);
    }
}
