//! Turns of a kiosk: a visitor's ride, or the attract ride that is shown while nobody rides. A function of time and
//! touches alone.

use input::Nanos;

/// Ride that begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// Attract ride, for nobody in particular.
    Attract,
    /// Ride of a visitor, at the start.
    Visitor,
}

/// Clock that gives each his turn.
#[derive(Clone, Debug)]
pub struct Turns {
    /// Time without a touch after which a visitor has left.
    idle: Nanos,
    /// Longest time of an attract ride, after which the next begins.
    longest: Nanos,
    present: Option<Turn>,
    /// Time of the last touch, or the beginning of the attract ride.
    since: Nanos,
}

impl Turns {
    /// Clock before the first turn.
    pub fn new(idle: Nanos, longest: Nanos) -> Self {
        Self { idle, longest, present: None, since: 0 }
    }

    /// True while the attract ride is shown.
    pub fn attracts(&self) -> bool {
        self.present == Some(Turn::Attract)
    }

    /// Time of the visitor's last touch.
    pub fn last_touch(&self) -> Nanos {
        self.since
    }

    /// Turn that begins at the time `now`, if one does; `touched`: a control was touched since the last call;
    /// `strayed`: the ride has left the scene behind, and ends like that of a visitor who has left.
    pub fn step(&mut self, now: Nanos, touched: bool, strayed: bool) -> Option<Turn> {
        let waited = now.saturating_sub(self.since);
        let begins = match (self.present, touched) {
            (Some(Turn::Visitor), _) if strayed => Some(Turn::Attract),
            (Some(Turn::Visitor), true) => {
                self.since = now;
                None
            }
            (Some(Turn::Visitor), false) => (waited >= self.idle).then_some(Turn::Attract),
            (Some(Turn::Attract) | None, true) => Some(Turn::Visitor),
            (Some(Turn::Attract), false) => (strayed || waited >= self.longest).then_some(Turn::Attract),
            (None, false) => Some(Turn::Attract),
        };
        if begins.is_some() {
            (self.present, self.since) = (begins, now);
        }
        begins
    }
}

#[cfg(test)]
mod tests {
    //! Laws: a visitor keeps the ride as long as the touches are less than the idle time apart, and loses it exactly
    //! then; whoever touches a control while nobody rides gets a fresh ride at once; no touch restarts one's own ride;
    //! a ride that has left the scene behind ends at once.

    use super::*;
    use input::SECOND;
    use rand::{RngExt, SeedableRng};

    const IDLE: Nanos = 60 * SECOND;
    const LONGEST: Nanos = 600 * SECOND;

    #[test]
    fn nobody_is_there_at_first() {
        assert_eq!(Turns::new(IDLE, LONGEST).step(0, false, false), Some(Turn::Attract));
        assert_eq!(Turns::new(IDLE, LONGEST).step(0, true, false), Some(Turn::Visitor));
    }

    #[test]
    fn a_visitor_has_left_after_the_idle_time_and_not_before() {
        let mut turns = Turns::new(IDLE, LONGEST);
        turns.step(0, false, false);
        assert_eq!(turns.step(5 * SECOND, true, false), Some(Turn::Visitor));
        assert_eq!(turns.step(5 * SECOND + IDLE - 1, false, false), None);
        assert_eq!(turns.step(5 * SECOND + IDLE, false, false), Some(Turn::Attract));
    }

    #[test]
    fn attract_rides_begin_anew_before_they_go_too_far() {
        let mut turns = Turns::new(IDLE, LONGEST);
        turns.step(0, false, false);
        assert_eq!(turns.step(LONGEST - 1, false, false), None);
        assert_eq!(turns.step(LONGEST, false, false), Some(Turn::Attract));
    }

    #[test]
    fn a_ride_that_has_strayed_ends_whoever_rides() {
        for touched in [false, true] {
            let mut turns = Turns::new(IDLE, LONGEST);
            assert_eq!(turns.step(0, true, false), Some(Turn::Visitor));
            assert_eq!(turns.step(SECOND, touched, true), Some(Turn::Attract));
            assert_eq!(turns.step(2 * SECOND, false, true), Some(Turn::Attract));
            // A key that is still held begins a fresh ride.
            assert_eq!(turns.step(3 * SECOND, true, false), Some(Turn::Visitor));
        }
    }

    #[test]
    fn whatever_is_touched_when_the_laws_hold() {
        let mut dice = dice();
        let mut turns = Turns::new(IDLE, LONGEST);
        let (mut now, mut touch, mut riding) = (0, 0, false);
        for _ in 0..100_000 {
            now += dice.random_range(0..10 * SECOND);
            let touched = dice.random_range(0..6) == 0;
            let turn = turns.step(now, touched, false);
            match (riding, touched) {
                (true, true) => assert_eq!(turn, None, "one's own ride goes on"),
                (true, false) => assert_eq!(turn == Some(Turn::Attract), now - touch >= IDLE),
                (false, true) => assert_eq!(turn, Some(Turn::Visitor)),
                (false, false) => assert_ne!(turn, Some(Turn::Visitor)),
            }
            if touched {
                (touch, riding) = (now, true);
            } else if turn == Some(Turn::Attract) {
                riding = false;
            }
            assert_eq!(turns.attracts(), !riding);
        }
    }

    fn dice() -> rand::rngs::StdRng {
        rand::rngs::StdRng::seed_from_u64(1)
    }
}
