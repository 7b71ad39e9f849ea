//! Decoder of the mouse that moves the head, used without a tracker.
//!
//! Dragging with the left button turns the head. Dragging with the right button, or with Shift held, moves it
//! sideways and up; the wheel moves it ahead and back. The middle button, or the window's [`MouseEvent::Reset`],
//! returns it to its start. The head glides after the mouse, so that its velocity is smooth. Place and velocity are
//! functions of the last event's time and the time of asking, so the number of calls does not matter.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec3, EulerRot};

use super::mouse_event::{MouseButton, MouseEvent};
use super::state::{HeadState, Tracking};
use crate::clock::{Nanos, seconds_between};
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;

/// Turn for a drag by one pixel, radians: 0.15 degrees.
const TURN_PER_PIXEL: f64 = 0.15 * std::f64::consts::PI / 180.0;
/// Distance for a drag by one pixel, metres.
const METRES_PER_PIXEL: f64 = 0.002;
/// Distance for one notch of the wheel, metres.
const METRES_PER_NOTCH: f64 = 0.1;
/// Largest pitch, up or down, radians.
const STEEPEST: f64 = FRAC_PI_2 * 0.95;
/// Largest distance of the head from its start along each axis, metres.
const REACH_M: f64 = 5.0;
/// Rate at which the head approaches the goal of the mouse, 1/s: a time of a tenth of a second.
const EAGERNESS: f64 = 10.0;

/// Place that follows a goal like a critically damped spring.
///
/// *Equation*: x = g + (d + (v₀ + ω d) t) e^(−ωt), d = x₀ − g: place and velocity are continuous whenever the goal g
/// changes.
#[derive(Clone, Copy, Debug)]
struct Glide {
    since: Nanos,
    from: DVec3,
    velocity: DVec3,
    goal: DVec3,
}

impl Glide {
    fn resting(position: DVec3) -> Self {
        Self { since: 0, from: position, velocity: DVec3::ZERO, goal: position }
    }

    /// Place, metres, and velocity, m/s, at the time `at`.
    fn at(&self, at: Nanos) -> (DVec3, DVec3) {
        let time_s = seconds_between(self.since, at);
        let decay = libm::exp(-EAGERNESS * time_s);
        let away = self.from - self.goal;
        let drift = self.velocity + EAGERNESS * away;
        let position = self.goal + (away + drift * time_s) * decay;
        (position, (self.velocity - EAGERNESS * drift * time_s) * decay)
    }

    fn aim(&mut self, at: Nanos, goal: DVec3) {
        let (from, velocity) = self.at(at);
        *self = Self { since: at.max(self.since), from, velocity, goal };
    }
}

/// Decoder of [`SampleSource::Mouse`](crate::SampleSource::Mouse).
#[derive(Debug)]
pub struct MouseDecoder {
    home: DVec3,
    held: [bool; 3],
    shift: bool,
    yaw: f64,
    pitch: f64,
    place: Glide,
    faults: Faults,
}

impl MouseDecoder {
    /// Head that rests at `home` in the room's axes and looks ahead.
    pub fn new(home: DVec3) -> Self {
        Self {
            home,
            held: [false; 3],
            shift: false,
            yaw: 0.0,
            pitch: 0.0,
            place: Glide::resting(home),
            faults: Faults::default(),
        }
    }

    /// Head at the time `at`.
    pub fn state(&self, at: Nanos) -> HeadState {
        let (position_m, velocity_m_s) = self.place.at(at);
        // A mouse turns the head in leaps, which are no motion.
        let orientation = DQuat::from_euler(EulerRot::YXZ, self.yaw, self.pitch, 0.0);
        HeadState { position_m, orientation, velocity_m_s, turn_rad_s: DVec3::ZERO, tracked: Tracking::Tracked }
    }

    fn event(&mut self, at: Nanos, event: MouseEvent) {
        match event {
            MouseEvent::Moved { right, down } => {
                let (right, down) = (f64::from(right), f64::from(down));
                let [turns, moves, _] = self.held;
                if moves || (turns && self.shift) {
                    let sideways = DQuat::from_rotation_y(self.yaw) * DVec3::X;
                    self.shift_by(at, (sideways * right - DVec3::Y * down) * METRES_PER_PIXEL);
                } else if turns {
                    self.yaw = (self.yaw - right * TURN_PER_PIXEL) % std::f64::consts::TAU;
                    self.pitch = (self.pitch - down * TURN_PER_PIXEL).clamp(-STEEPEST, STEEPEST);
                }
            }
            MouseEvent::Button { button, pressed } => {
                self.held[button as usize] = pressed;
                if pressed && button == MouseButton::Middle {
                    self.go_home(at);
                }
            }
            MouseEvent::Shift(held) => self.shift = held,
            MouseEvent::Wheel(ahead) => {
                let forward = DQuat::from_rotation_y(self.yaw) * DVec3::NEG_Z;
                self.shift_by(at, forward * f64::from(ahead) * METRES_PER_NOTCH);
            }
            MouseEvent::Reset => self.go_home(at),
        }
    }

    fn shift_by(&mut self, at: Nanos, way: DVec3) {
        let reach = DVec3::splat(REACH_M);
        self.place.aim(at, (self.place.goal + way).clamp(self.home - reach, self.home + reach));
    }

    /// Takes the head back to its start.
    pub(crate) fn go_home(&mut self, at: Nanos) {
        (self.yaw, self.pitch) = (0.0, 0.0);
        self.place.aim(at, self.home);
    }
}

impl Decoder for MouseDecoder {
    /// Releases the buttons: the window lost the focus. The head stays where it is.
    fn reset(&mut self, _at: Nanos) {
        (self.held, self.shift) = ([false; 3], false);
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
    //! The head must follow the mouse without a jump of place or velocity, and its velocity must be the derivative of
    //! its place.
    use super::*;
    use crate::clock::SECOND;
    use crate::head::mouse_event::{BUTTON, MOVED, SHIFT, WHEEL};

    const HOME: DVec3 = DVec3::new(0.0, 1.7, 0.5);
    const RIGHT: MouseEvent = MouseEvent::Moved { right: 100.0, down: 0.0 };

    fn button(button: MouseButton, pressed: bool) -> MouseEvent {
        MouseEvent::Button { button, pressed }
    }

    fn mouse(events: &[(Nanos, MouseEvent)]) -> MouseDecoder {
        let mut mouse = MouseDecoder::new(HOME);
        for (at, event) in events {
            mouse.bytes(*at, &event.to_bytes(), &mut Actions::default());
        }
        assert_eq!(mouse.faults().number(), 0);
        mouse
    }

    fn near(found: DVec3, expected: DVec3) {
        assert!((found - expected).length() < 1e-9, "{found} for {expected}");
    }

    #[test]
    fn the_left_button_turns_to_where_the_mouse_goes() {
        let up = MouseEvent::Moved { right: 0.0, down: -100.0 };
        let head = mouse(&[(0, RIGHT), (0, button(MouseButton::Left, true)), (1, RIGHT), (2, up)]).state(SECOND);
        let forward = head.orientation * DVec3::NEG_Z;
        let (sin, cos) = 15_f64.to_radians().sin_cos();
        near(forward, DVec3::new(sin * cos, sin, -cos * cos));
        assert_eq!((head.position_m, head.velocity_m_s), (HOME, DVec3::ZERO));
    }

    #[test]
    fn the_right_button_or_shift_moves_and_the_wheel_goes_ahead() {
        let later = 10 * SECOND;
        let up = MouseEvent::Moved { right: 0.0, down: -50.0 };
        let right_button = mouse(&[(0, button(MouseButton::Right, true)), (1, RIGHT), (2, up)]).state(later);
        near(right_button.position_m, HOME + DVec3::new(0.2, 0.1, 0.0));
        let shift = [(0, button(MouseButton::Left, true)), (0, MouseEvent::Shift(true)), (1, RIGHT), (2, up)];
        near(mouse(&shift).state(later).position_m, right_button.position_m);
        assert_eq!(mouse(&shift).state(later).orientation, DQuat::IDENTITY);
        // A quarter turn to the left, then three notches ahead.
        let left = MouseEvent::Moved { right: -600.0, down: 0.0 };
        let events = [(0, button(MouseButton::Left, true)), (1, left), (2, MouseEvent::Wheel(3.0))];
        near(mouse(&events).state(later).position_m, HOME + DVec3::new(-0.3, 0.0, 0.0));
    }

    #[test]
    fn place_and_velocity_are_continuous_and_belong_together() {
        let mut head = MouseDecoder::new(HOME);
        let mut at = 0;
        let step = SECOND / 1000;
        let mut last = head.state(0);
        for tick in 0..3000_u64 {
            if tick % 40 == 0 {
                let notches = if tick % 80 == 0 { 2.0 } else { -1.0 };
                head.bytes(at, &MouseEvent::Wheel(notches).to_bytes(), &mut Actions::default());
            }
            at += step;
            let now = head.state(at);
            let mean = (now.position_m - last.position_m) / 1e-3;
            let middle = head.state(at - step / 2).velocity_m_s;
            assert!((mean - middle).length() < 1e-4, "{tick}: {mean} for {middle}");
            // Bound: ω² times the distance to the goal, times a millisecond.
            assert!((now.velocity_m_s - last.velocity_m_s).length() < 0.1, "{tick}");
            last = now;
        }
    }

    #[test]
    fn it_does_not_matter_how_often_one_asks() {
        let events = [(0, MouseEvent::Wheel(5.0)), (SECOND / 20, MouseEvent::Wheel(-3.0))];
        let often = mouse(&events);
        for at in 0..100 {
            often.state(at * SECOND / 500);
        }
        assert_eq!(often.state(SECOND / 5), mouse(&events).state(SECOND / 5));
    }

    #[test]
    fn it_stays_within_reach_and_goes_home() {
        let far = [(0, MouseEvent::Wheel(1e4)), (1, MouseEvent::Wheel(1e4))];
        near(mouse(&far).state(20 * SECOND).position_m, HOME - DVec3::Z * REACH_M);
        for reset in [MouseEvent::Reset, button(MouseButton::Middle, true)] {
            let events = [far[0], (1, button(MouseButton::Left, true)), (2, RIGHT), (3, reset)];
            let head = mouse(&events).state(20 * SECOND);
            near(head.position_m, HOME);
            assert_eq!(head.orientation, DQuat::IDENTITY);
        }
    }

    #[test]
    fn losing_the_focus_lets_go_but_does_not_move() {
        let mut head = mouse(&[(0, button(MouseButton::Right, true)), (0, RIGHT)]);
        let before = head.state(SECOND);
        head.reset(SECOND);
        assert_eq!(head.state(SECOND), before);
        head.bytes(SECOND, &RIGHT.to_bytes(), &mut Actions::default());
        assert_eq!(head.state(SECOND), before);
    }

    #[test]
    fn nonsense_is_counted_and_moves_nothing() {
        let nan = [&[WHEEL][..], &f32::NAN.to_le_bytes()].concat();
        for bytes in [&[9][..], &[BUTTON, 3, 1], &[BUTTON, 0, 2], &[MOVED, 0], &nan, &[SHIFT]] {
            let mut head = MouseDecoder::new(HOME);
            head.bytes(0, bytes, &mut Actions::default());
            assert_eq!(head.faults().number(), 1, "{bytes:?}");
            assert_eq!(head.state(SECOND), MouseDecoder::new(HOME).state(SECOND));
        }
    }
}
