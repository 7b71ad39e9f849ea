//! Decoder of the window's mouse where it turns the look, with the look's share of keys and sticks.

use std::f64::consts::{PI, TAU};

use super::free_look::{FreeLook, STEEPEST_LOOK_RAD};
use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::head::mouse_event::{MouseButton, MouseEvent};
use crate::ramp::Ramp;

/// Turn for a drag by one pixel, radians: 0.15 degrees, as for a head that the mouse moves.
const TURN_PER_PIXEL: f64 = 0.15 * PI / 180.0;
/// Turn to the side while a key is held, radians a second.
const YAW_RAD_S: f64 = PI / 2.0;
/// Turn up or down while a key is held, radians a second.
const PITCH_RAD_S: f64 = PI / 4.0;
/// Rate at which the look returns to the nose, radians a second.
const RETURN_RAD_S: f64 = TAU;
/// Yaw that no key reaches while it is held, radians. The same for every key, so that the yaw stays exact.
const ENDLESS_RAD: f64 = 1e6;
/// Yaw and pitch of a stick that is pushed to its end, radians: to a side, it looks back.
const STICK_YAW_RAD: f64 = PI;
/// Pitch of a stick that is pulled to its end, radians.
const STICK_PITCH_RAD: f64 = PI / 3.0;

/// Decoder of [`SampleSource::Mouse`](crate::SampleSource::Mouse) where no head is moved by it.
#[derive(Debug, Default)]
pub struct LookDecoder {
    dragged: bool,
    /// Directions of the held keys: to the left and up, each −1, 0 or 1.
    keys: [f64; 2],
    /// Deflection of the stick: to the left and up, each −1 to 1.
    stick: [f64; 2],
    back: bool,
    yaw: Ramp,
    pitch: Ramp,
    faults: Faults,
}

impl LookDecoder {
    /// Look at the time `at`.
    pub fn look(&self, at: Nanos) -> FreeLook {
        if self.back {
            return FreeLook { yaw_rad: PI, pitch_rad: 0.0 };
        }
        let yaw_rad = wrapped(self.yaw.value(at) + self.stick[0] * STICK_YAW_RAD);
        let pitch_rad = self.pitch.value(at) + self.stick[1] * STICK_PITCH_RAD;
        FreeLook { yaw_rad, pitch_rad: pitch_rad.clamp(-STEEPEST_LOOK_RAD, STEEPEST_LOOK_RAD) }
    }

    /// Takes the held keys at `at`: directions to the left and up, each −1, 0 or 1, and true to look back.
    pub fn hold(&mut self, at: Nanos, keys: [f64; 2], back: bool) {
        self.back = back;
        if keys != self.keys {
            self.keys = keys;
            self.aim(at);
        }
    }

    /// Takes the deflection of the second stick: to the left and up, each −1 to 1.
    pub fn push(&mut self, stick: [f64; 2]) {
        self.stick = stick;
    }

    /// Turns the look back to the nose, the shorter way.
    pub fn look_ahead(&mut self, at: Nanos) {
        let (yaw, pitch) = (wrapped(self.yaw.value(at)), self.pitch.value(at));
        for (ramp, from) in [(&mut self.yaw, yaw), (&mut self.pitch, pitch)] {
            *ramp = Ramp::resting(at, from);
            ramp.aim(at, 0.0, RETURN_RAD_S);
        }
    }

    /// Aims both angles at the ends to which the held keys turn them; without a key they stay.
    fn aim(&mut self, at: Nanos) {
        let yaw = wrapped(self.yaw.value(at));
        let pitch = self.pitch.value(at);
        let [left, up] = self.keys;
        self.yaw = Ramp::resting(at, yaw);
        self.pitch = Ramp::resting(at, pitch);
        if left != 0.0 {
            self.yaw.aim(at, ENDLESS_RAD.copysign(left), YAW_RAD_S);
        }
        if up != 0.0 {
            self.pitch.aim(at, STEEPEST_LOOK_RAD.copysign(up), PITCH_RAD_S);
        }
    }

    /// Turns the look by these angles at once, radians.
    fn turn(&mut self, at: Nanos, left: f64, up: f64) {
        let yaw = wrapped(self.yaw.value(at) + left);
        let pitch = (self.pitch.value(at) + up).clamp(-STEEPEST_LOOK_RAD, STEEPEST_LOOK_RAD);
        (self.yaw, self.pitch) = (Ramp::resting(at, yaw), Ramp::resting(at, pitch));
        self.aim(at);
    }

    fn event(&mut self, at: Nanos, event: MouseEvent) {
        match event {
            MouseEvent::Moved { right, down } if self.dragged => {
                self.turn(at, -f64::from(right) * TURN_PER_PIXEL, -f64::from(down) * TURN_PER_PIXEL);
            }
            MouseEvent::Button { button: MouseButton::Left, pressed } => self.dragged = pressed,
            MouseEvent::Button { button: MouseButton::Middle, pressed: true } | MouseEvent::Reset => {
                self.look_ahead(at);
            }
            MouseEvent::Moved { .. } | MouseEvent::Button { .. } | MouseEvent::Shift(_) | MouseEvent::Wheel(_) => {}
        }
    }
}

/// Angle of the same direction, −π to π.
fn wrapped(angle: f64) -> f64 {
    let rest = angle % TAU;
    if rest > PI {
        rest - TAU
    } else if rest < -PI {
        rest + TAU
    } else {
        rest
    }
}

impl Decoder for LookDecoder {
    /// Ends a drag: the window lost the focus. The look stays where it is.
    fn reset(&mut self, _at: Nanos) {
        self.dragged = false;
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        for event in MouseEvent::all(bytes) {
            match event {
                Some(event) => self.event(at, event),
                None => self.faults.count("an event of the mouse that cannot be read"),
            }
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! Keys must turn the look smoothly and stop it where they are released, a drag must turn it to where the mouse
    //! goes, and nothing may look beyond the zenith. A wrong program jumps, drifts, or looks upside down.
    use super::*;
    use crate::clock::SECOND;
    use glam::DVec3;

    const DRAG: MouseEvent = MouseEvent::Button { button: MouseButton::Left, pressed: true };

    fn moved(right: f32, down: f32) -> MouseEvent {
        MouseEvent::Moved { right, down }
    }

    fn dragged(events: &[(Nanos, MouseEvent)]) -> LookDecoder {
        let mut look = LookDecoder::default();
        for (at, event) in events {
            look.bytes(*at, &event.to_bytes(), &mut Actions::default());
        }
        assert_eq!(look.faults().number(), 0);
        look
    }

    fn degrees(look: FreeLook) -> [f64; 2] {
        [look.yaw_rad, look.pitch_rad].map(|angle| (angle.to_degrees() * 1e9).round() / 1e9)
    }

    #[test]
    fn a_held_key_turns_at_its_rate_and_a_released_one_leaves_the_look_there() {
        let mut look = LookDecoder::default();
        look.hold(SECOND, [1.0, -1.0], false);
        assert_eq!(degrees(look.look(SECOND + SECOND / 2)), [45.0, -22.5]);
        look.hold(2 * SECOND, [0.0; 2], false);
        assert_eq!(degrees(look.look(9 * SECOND)), [90.0, -45.0]);
        // Up to the end, and round past the back.
        look.hold(10 * SECOND, [1.0, 1.0], false);
        assert_eq!(degrees(look.look(12 * SECOND)), [-90.0, 45.0]);
        assert_eq!(degrees(look.look(14 * SECOND)), [90.0, 85.0]);
    }

    #[test]
    fn a_drag_turns_to_where_the_mouse_goes_and_not_beyond_the_end() {
        let look = dragged(&[(0, moved(50.0, 50.0)), (0, DRAG), (1, moved(100.0, -40.0))]).look(SECOND);
        assert_eq!(degrees(look), [-15.0, 6.0]);
        let forward = look.nose_from_gaze() * DVec3::NEG_Z;
        assert!(forward.x > 0.25 && forward.y > 0.1 && forward.z < 0.0, "{forward}");
        let far = dragged(&[(0, DRAG), (1, moved(0.0, 1e4)), (2, moved(0.0, -10.0))]).look(SECOND);
        assert_eq!(degrees(far), [0.0, -83.5]);
    }

    #[test]
    fn a_drag_and_a_key_add_up() {
        let mut look = dragged(&[(0, DRAG)]);
        look.hold(0, [1.0, 0.0], false);
        look.bytes(SECOND / 2, &moved(-100.0, 0.0).to_bytes(), &mut Actions::default());
        assert_eq!(degrees(look.look(SECOND)), [105.0, 0.0]);
    }

    #[test]
    fn looking_back_lasts_as_long_as_it_is_held() {
        let mut look = dragged(&[(0, DRAG), (1, moved(-100.0, -100.0))]);
        let before = look.look(SECOND);
        look.hold(SECOND, [0.0; 2], true);
        assert_eq!(degrees(look.look(SECOND)), [180.0, 0.0]);
        assert!((look.look(SECOND).nose_from_gaze() * DVec3::NEG_Z - DVec3::Z).length() < 1e-12);
        look.hold(2 * SECOND, [0.0; 2], false);
        assert_eq!(look.look(2 * SECOND), before);
    }

    #[test]
    fn the_way_ahead_is_the_shorter_one_and_ends_exactly_ahead() {
        let mut look = LookDecoder::default();
        // Two and a half turns and 36° more to the left, which is 144° to the right of the nose.
        look.hold(0, [1.0, 1.0], false);
        let at = 104 * SECOND / 10;
        look.hold(at, [0.0; 2], false);
        assert_eq!(degrees(look.look(at)), [-144.0, 85.0]);
        look.look_ahead(at);
        assert_eq!(degrees(look.look(at + SECOND / 5)), [-72.0, 13.0]);
        assert!(look.look(at + SECOND / 2).is_ahead());
    }

    #[test]
    fn the_stick_looks_as_far_as_it_is_pushed_and_lets_go() {
        let mut look = LookDecoder::default();
        look.push([0.5, -1.0]);
        assert_eq!(degrees(look.look(SECOND)), [90.0, -60.0]);
        look.push([-1.0, 0.0]);
        assert_eq!(degrees(look.look(SECOND)), [-180.0, 0.0]);
        look.push([0.0; 2]);
        assert!(look.look(SECOND).is_ahead());
    }

    #[test]
    fn losing_the_focus_ends_the_drag_and_nonsense_is_counted() {
        let mut look = dragged(&[(0, DRAG), (1, moved(10.0, 0.0))]);
        let before = look.look(SECOND);
        look.reset(SECOND);
        look.bytes(SECOND, &moved(10.0, 0.0).to_bytes(), &mut Actions::default());
        assert_eq!(look.look(SECOND), before);
        look.bytes(SECOND, &[9], &mut Actions::default());
        assert_eq!((look.look(SECOND), look.faults().number()), (before, 1));
    }
}
