//! Belief in speeds that come as bare numbers: noise can look like a number, but not like a rider.
//!
//! A wrong baud rate or a loose plug makes short lines of chance characters, and some of them are digits. A bare number
//! has no checksum, so it is held against the speed before it: a rider gains a few metres a second each second, and
//! brakes no harder than the tyres hold. A number that jumps is taken only when the lines after it say the same. The
//! first number is taken at once, unless the line before it could not be read.

use crate::clock::{Nanos, seconds_between};

/// Largest gain of speed, m/s²: what a sprinter reaches from a standing start.
const FASTEST_GAIN: f64 = 5.0;
/// Largest loss of speed, m/s²: what a tyre holds on the road.
const FASTEST_LOSS: f64 = 10.0;
/// Change of speed that is always believed, m/s: rounding to whole km/h, and lines that come in clusters.
const ALWAYS: f64 = 0.5;
/// Longest time over which a speed may have changed unseen, seconds.
const LONGEST_GAP_S: f64 = 1.0;
/// Number of lines in a row that must agree before a jump is believed.
const AGREEING: u32 = 3;

/// Speed that was said, m/s, and its time.
type Said = (f64, Nanos);

/// Judge of bare speeds.
#[derive(Clone, Copy, Debug, Default)]
pub struct SpeedBelief {
    /// Last speed that was believed.
    believed: Option<Said>,
    /// Last speed that jumped, and the number of lines in a row that agree with it.
    doubted: Option<(Said, u32)>,
    /// True if the line before could not be read.
    after_noise: bool,
}

impl SpeedBelief {
    /// Notes a line that could not be read: what comes next may be noise too.
    pub fn noise(&mut self) {
        self.after_noise = true;
        self.doubted = None;
    }

    /// Takes a speed, m/s, that came at `at`. True if it is believed.
    pub fn believes(&mut self, speed: f64, at: Nanos) -> bool {
        let follows = match self.believed {
            Some(before) => is_reached(before, (speed, at)),
            None => !self.after_noise,
        };
        let agreeing = match self.doubted {
            Some((before, agreeing)) if is_reached(before, (speed, at)) => agreeing + 1,
            _ => 1,
        };
        let believes = follows || agreeing >= AGREEING;
        if believes {
            *self = Self { believed: Some((speed, at)), doubted: None, after_noise: false };
        } else {
            self.doubted = Some(((speed, at), agreeing));
        }
        believes
    }
}

/// True if a rider may come from one speed to the other in the time between them.
fn is_reached((before, then): Said, (speed, now): Said) -> bool {
    let gap_s = seconds_between(then, now).clamp(0.0, LONGEST_GAP_S);
    (-(ALWAYS + FASTEST_LOSS * gap_s)..=ALWAYS + FASTEST_GAIN * gap_s).contains(&(speed - before))
}

#[cfg(test)]
mod tests {
    //! Law: a speed that a rider reaches is taken at once, one that nobody reaches only when it stays.
    use super::*;
    use crate::clock::SECOND;

    /// Answers to speeds that come every 50 ms.
    fn answers(belief: &mut SpeedBelief, from: Nanos, speeds: &[f64]) -> Vec<bool> {
        (0..).zip(speeds).map(|(n, &speed)| belief.believes(speed, from + n * SECOND / 20)).collect()
    }

    #[test]
    fn a_rider_is_believed() {
        let mut belief = SpeedBelief::default();
        assert_eq!(answers(&mut belief, 0, &[5.0, 5.3, 5.6, 5.4, 4.9, 4.2]), [true; 6]);
        // A sprint of a second between two lines, and an emergency stop.
        assert!(belief.believes(9.0, 2 * SECOND) && belief.believes(0.0, 3 * SECOND));
    }

    #[test]
    fn a_jump_is_believed_only_when_it_stays() {
        let mut belief = SpeedBelief::default();
        assert_eq!(answers(&mut belief, 0, &[5.0, 25.0, 5.1, 0.0, 5.0]), [true, false, true, false, true]);
        assert_eq!(answers(&mut belief, SECOND, &[20.0, 20.1, 20.0, 20.2]), [false, false, true, true]);
        // Jumps to and fro never agree.
        assert!(!answers(&mut belief, 2 * SECOND, &[3.0, 9.0, 1.0, 28.0, 6.0, 4.0]).contains(&true));
    }

    #[test]
    fn the_first_number_after_noise_must_stay() {
        let mut belief = SpeedBelief::default();
        belief.noise();
        assert!(!belief.believes(7.0, 0));
        belief.noise();
        assert!(!belief.believes(7.0, 1));
        assert_eq!(answers(&mut belief, 2, &[7.0, 7.1]), [false, true]);
    }
}
