//! Decoder of the actions that the program's own interface sends.

use crate::action::Action;
use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;

/// Decoder of [`SampleSource::Settings`](crate::SampleSource::Settings): one JSON action a sample.
#[derive(Debug, Default)]
pub struct ActionDecoder {
    faults: Faults,
}

impl Decoder for ActionDecoder {
    fn reset(&mut self, _at: Nanos) {}

    fn bytes(&mut self, _at: Nanos, bytes: &[u8], actions: &mut Actions) {
        match serde_json::from_slice::<Action>(bytes) {
            Ok(action) if action.is_sound() => actions.push(action),
            Ok(action) => self.faults.count(format!("{action:?} is out of range")),
            Err(error) => self.faults.count(format!("not an action: {error}")),
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! An action must survive its own text, and a text that is no action must have no effect.
    use super::*;
    use crate::action::{Place, Setting, Switch, VehicleKind};
    use crate::head::tracking_mode::TrackingMode;

    fn decode(bytes: &[u8]) -> (Vec<Action>, u64) {
        let mut actions = Actions::default();
        let mut settings = ActionDecoder::default();
        settings.bytes(0, bytes, &mut actions);
        (actions.take(), settings.faults().number())
    }

    #[test]
    fn actions_survive_their_text() {
        for action in [
            Action::TogglePause,
            Action::Step,
            Action::TimeScale(0.1),
            Action::ScaleTime(0.5),
            Action::SpeedOfLight(30.0 / 3.6),
            Action::Vehicle(VehicleKind::Fly),
            Action::LookAhead,
            Action::Recentre,
            Action::Restart,
            Action::Tracking(TrackingMode::Position),
            Action::Jump(Place { position_m: [1.0, 0.0, -3.5], look: [0.0, 0.0, -1.0] }),
            Action::Scene("models/hall.glb".to_owned()),
            Action::Tour("twins".to_owned()),
            Action::Thrust([0.0, 0.5, -1.0]),
            Action::Hold(true),
            Action::Turn(Switch::Clocks, false),
            Action::Orbit { turn_rad: [0.1, -0.2], closer: 1.1 },
            Action::Set(Setting::Effects, "geometry,doppler".to_owned()),
            Action::Next(Setting::Tone),
            Action::Toggle(Switch::Outside),
            Action::Expose(-0.5),
        ] {
            assert_eq!(decode(&action.to_bytes()), (vec![action.clone()], 0));
            assert_eq!(Action::named(&String::from_utf8(action.to_bytes().into()).unwrap()), Some(action));
        }
    }

    #[test]
    fn texts_that_are_no_action_are_counted_and_do_nothing() {
        let endless = format!("{{\"scene\":\"{}\"}}", "x".repeat(5000));
        let bad: [&[u8]; 9] = [
            b"",
            b"\"fly\"",
            b"{\"time_scale\":-1}",
            b"{\"scale_time\":0}",
            b"{\"time_scale\":1e999}",
            b"\xff\xfe",
            b"{\"jump\":{\"position_m\":[0,0,1e13],\"look\":[0,0,1]}}",
            b"{\"jump\":{\"position_m\":[0,0,0],\"look\":[0,0,0]}}",
            endless.as_bytes(),
        ];
        for bytes in bad {
            assert_eq!(decode(bytes), (vec![], 1), "{bytes:?}");
        }
    }
}
