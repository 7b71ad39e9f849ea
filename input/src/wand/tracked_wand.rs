//! The tracked wand: signals in; pose, buttons, stick and trigger out.

use super::config::WandConfig;
use super::held_buttons::HeldButtons;
use super::signal::{MOST_AXES, WandSignal};
use super::state::WandState;
use crate::clock::{Nanos, seconds_between};
use crate::config_error::ConfigError;
use crate::head::config::HeadConfig;
use crate::head::tracked_head::TrackedHead;
use crate::head::url::TrackerUrl;

/// Silence after which a flystick is let go, seconds. Its frames repeat the buttons many times a second, but a frame
/// that says that a button is released may be lost.
const RELEASED_AFTER_S: f64 = 0.5;

/// Tracked wand. Signals are fed in the order in which they came, and the state is read once a frame.
#[derive(Debug)]
pub struct TrackedWand {
    config: WandConfig,
    /// Track of the hand, with the same checks as a head's.
    hand: TrackedHead,
    buttons: HeldButtons,
    axes: Vec<f64>,
    /// Time of the last word about buttons and axes.
    held_at: Nanos,
    /// True if the tracker repeats buttons and axes with every frame.
    repeats: bool,
}

impl TrackedWand {
    /// Wand that has not been seen yet, of the tracker that sees this head; `None` without `[tracker.wand]`.
    ///
    /// # Errors
    /// A setting that cannot be used.
    pub fn new(head: &HeadConfig) -> Result<Option<Self>, ConfigError> {
        let Some(config) = head.wand.clone() else {
            return Ok(None);
        };
        let hand = TrackedHead::new(HeadConfig {
            sensor: config.sensor,
            head_from_sensor: config.wand_from_sensor,
            recentre: Default::default(),
            wand: None,
            ..head.clone()
        })?;
        let repeats = matches!(head.url, TrackerUrl::Dtrack { .. } | TrackerUrl::Openxr);
        Ok(Some(Self { config, hand, buttons: HeldButtons::default(), axes: Vec::new(), held_at: 0, repeats }))
    }

    /// Settings of the wand.
    pub fn config(&self) -> &WandConfig {
        &self.config
    }

    /// Track of the wand's pose, with the poses that were rejected.
    pub fn hand(&self) -> &TrackedHead {
        &self.hand
    }

    /// Takes a signal that came at the time `at`.
    pub fn signal(&mut self, at: Nanos, signal: WandSignal) {
        match signal {
            WandSignal::Pose(pose) => return self.hand.pose(&pose),
            WandSignal::Button { button, held } => self.buttons.set(button, held),
            WandSignal::Buttons(buttons) => self.buttons = buttons,
            WandSignal::Axes(mut axes) => {
                axes.truncate(MOST_AXES);
                self.axes = axes;
            }
        }
        self.held_at = at;
    }

    /// Takes note that the tracker has moved its axes.
    pub fn axes_moved(&mut self) {
        self.hand.axes_moved();
    }

    /// Lets go of everything: the tracker came or went.
    pub fn gone(&mut self, at: Nanos) {
        self.hand.gone(at);
        (self.buttons, self.axes) = (HeldButtons::default(), Vec::new());
    }

    /// Wand at the time `at`.
    pub fn state(&self, at: Nanos) -> WandState {
        let hand = self.hand.state(at);
        let silent = self.repeats && seconds_between(self.held_at, at) > RELEASED_AFTER_S;
        let axis = |number: u32, least: f64| {
            let value = self.axes.get(number as usize).copied().filter(|value| !silent && value.is_finite());
            value.unwrap_or(0.0).clamp(least, 1.0)
        };
        WandState {
            position_m: hand.position_m,
            orientation: hand.orientation,
            tracked: hand.tracked,
            buttons: if silent { HeldButtons::default() } else { self.buttons },
            stick: self.config.stick.0.map(|number| axis(number, -1.0)),
            trigger: self.config.trigger.map_or(0.0, |number| axis(number, 0.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    //! Laws: what is pressed is held until it is released or the tracker goes; a wand that is not seen keeps its
    //! buttons; no number leaves its range.
    use super::*;
    use crate::clock::SECOND;
    use crate::head::state::Tracking;
    use crate::head::tracked_pose::TrackedPose;
    use glam::{DQuat, DVec3};

    fn wand(url: &str) -> TrackedWand {
        let wand = WandConfig { sensor: 1, trigger: Some(2), ..Default::default() };
        let mut head = HeadConfig::new(url.parse().unwrap());
        head.room_from_tracker.position = [0.0, 1.0, 0.0];
        TrackedWand::new(&HeadConfig { wand: Some(wand), ..head }).unwrap().unwrap()
    }

    fn pose(sensor: i32, at: Nanos, x: f64) -> WandSignal {
        let position_m = DVec3::new(x, 0.25, 0.0);
        let orientation = DQuat::IDENTITY;
        WandSignal::Pose(TrackedPose {
            sensor,
            at,
            measured_s: None,
            latency_s: None,
            position_m,
            orientation,
            velocity_m_s: None,
        })
    }

    #[test]
    fn buttons_are_held_until_they_are_released_or_the_server_goes() {
        let mut wand = wand("vrpn://x/Head");
        wand.signal(0, WandSignal::Button { button: 1, held: true });
        wand.signal(0, WandSignal::Button { button: 3, held: true });
        wand.signal(SECOND, WandSignal::Button { button: 1, held: false });
        // A server reports changes alone, so silence has no meaning.
        let held: Vec<u32> = wand.state(100 * SECOND).buttons.numbers().collect();
        assert_eq!(held, [3]);
        wand.signal(0, WandSignal::Buttons(HeldButtons(0b101)));
        assert_eq!(wand.state(100 * SECOND).buttons, HeldButtons(0b101));
        wand.gone(101 * SECOND);
        assert_eq!(wand.state(101 * SECOND).buttons, HeldButtons(0));
    }

    #[test]
    fn a_flystick_whose_frames_end_is_let_go() {
        let mut wand = wand("dtrack://");
        wand.signal(SECOND, WandSignal::Buttons(HeldButtons(1)));
        wand.signal(SECOND, WandSignal::Axes(vec![0.5, -0.5, 1.0]));
        let state = wand.state(SECOND + SECOND / 2);
        assert_eq!((state.buttons, state.stick, state.trigger), (HeldButtons(1), [0.5, -0.5], 1.0));
        let state = wand.state(SECOND + SECOND / 2 + 1);
        assert_eq!((state.buttons, state.stick, state.trigger), (HeldButtons(0), [0.0; 2], 0.0));
    }

    #[test]
    fn the_pose_is_that_of_its_own_sensor_in_the_room() {
        let mut wand = wand("vrpn://x/Head");
        wand.signal(0, pose(0, 0, 0.7));
        assert_eq!(wand.state(0).tracked, Tracking::Never);
        wand.signal(0, pose(1, 0, 0.5));
        let state = wand.state(0);
        assert_eq!((state.position_m, state.tracked), (DVec3::new(0.5, 1.25, 0.0), Tracking::Tracked));
        wand.signal(0, WandSignal::Button { button: 0, held: true });
        let state = wand.state(10 * SECOND);
        assert_eq!((state.position_m.x, state.tracked, state.buttons), (0.5, Tracking::Lost, HeldButtons(1)));
    }

    #[test]
    fn axes_stay_in_their_range() {
        let mut wand = wand("vrpn://x/Head");
        for (sent, stick, trigger) in [
            (vec![], [0.0; 2], 0.0),
            (vec![2.0], [1.0, 0.0], 0.0),
            (vec![f64::NAN, -9.0, -1.0], [0.0, -1.0], 0.0),
            (vec![f64::INFINITY, 0.25, 7.0], [0.0, 0.25], 1.0),
        ] {
            wand.signal(0, WandSignal::Axes(sent));
            assert_eq!((wand.state(0).stick, wand.state(0).trigger), (stick, trigger));
        }
        wand.signal(0, WandSignal::Axes(vec![1.0; 100_000]));
        assert_eq!(wand.axes.len(), MOST_AXES);
    }
}
