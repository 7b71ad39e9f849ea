//! Recorded ride that is shown at the pace at which it was ridden.

use crate::output::say::tell;
use input::{Action, Desk, DeskConfig, KeyMap, Nanos, Sample};
use presentation::Presentation;
use ride::{Replay, ReplayError, Replayed, RideFrame, ShownTimes};

/// Recorded ride in progress.
pub struct RecordedRide {
    /// Replay of the recording.
    pub replay: Replay,
    next: Option<(RideFrame, Nanos)>,
    shown: Option<RideFrame>,
    differed: bool,
    times: ShownTimes,
    /// Keys of the onlooker that do other work than their own.
    keys: KeyMap,
    /// True while the onlooker or a tour holds the ride; the time for which it was held, and the time of the last call.
    holds: bool,
    held: Nanos,
    last: Nanos,
}

/// Frame of a recorded ride.
pub struct RecordedStep {
    /// Frame that is shown; `None` at the ride's end.
    pub frame: Option<RideFrame>,
    /// Difference between replay and recording, the first time that there is one.
    pub difference: Option<ReplayError>,
}

impl RecordedRide {
    /// Ride before its first frame. `keys`: keys of the onlooker that do other work than their own.
    pub fn new(replay: Replay, keys: KeyMap) -> Self {
        let times = ShownTimes::default();
        Self { replay, next: None, shown: None, differed: false, times, keys, holds: false, held: 0, last: 0 }
    }

    /// Frame at the time `now`; `said`: what an onlooker has asked for since the last.
    ///
    /// # Errors
    /// [`ReplayError`] of a recording that is damaged before its first frame.
    pub fn frame(&mut self, now: Nanos, said: &[Sample]) -> Result<RecordedStep, ReplayError> {
        let (mut repeated, mut differs) = (Vec::new(), None);
        let asked = self.onlooker(said);
        let passed = now.saturating_sub(std::mem::replace(&mut self.last, now));
        self.held += if self.holds { passed } else { 0 };
        for action in &asked {
            match action {
                Action::TogglePause => self.holds = !self.holds,
                Action::Hold(hold) => self.holds = *hold,
                _ => {}
            }
        }
        let now = now.saturating_sub(self.held);
        // The frames that were ridden since the last call are simulated, and the last of them is shown.
        let ended = loop {
            let (frame, due_at) = match self.next.take() {
                Some(next) => next,
                None => match self.replay.next_frame() {
                    Ok(Some(Replayed { frame, difference })) => {
                        if let Some(difference) = difference.filter(|_| !std::mem::replace(&mut self.differed, true)) {
                            differs = Some(ReplayError::Differs { frame: frame.record.frame, difference });
                        }
                        let due_at = self.times.shown(frame.record.at);
                        (frame, due_at)
                    }
                    Ok(None) => break true,
                    Err(error) if self.shown.is_none() => return Err(error),
                    Err(error) => {
                        tell(error);
                        break true;
                    }
                },
            };
            let due = due_at <= now;
            if due || self.shown.is_none() {
                let actions = frame.controls.actions.iter().filter(|action| Presentation::repeats(action));
                repeated.extend(actions.cloned());
                self.shown = Some(frame);
            } else {
                self.next = Some((frame, due_at));
            }
            if !due {
                break false;
            }
        };
        // Of the recorded rider's actions, those are performed again that decide what is shown. Actions that the
        // onlooker asks for now follow.
        let mut frame = if ended && self.next.is_none() { None } else { self.shown.clone() };
        if let Some(frame) = &mut frame {
            repeated.extend(asked);
            frame.controls.actions = repeated;
            frame.paused |= self.holds;
        }
        Ok(RecordedStep { frame, difference: differs })
    }

    /// Actions of an onlooker that concern the window alone, or hold the ride.
    fn onlooker(&self, said: &[Sample]) -> Vec<Action> {
        let keys = DeskConfig { keys: self.keys.clone(), ..DeskConfig::default() };
        let mut desk = Desk::new(keys).expect("keys are checked where they are read");
        said.iter().for_each(|sample| desk.feed(sample));
        let actions = desk.controls(said.last().map_or(0, |sample| sample.at)).actions;
        let of_window = |action: &Action| {
            matches!(
                action,
                Action::ToggleHelp
                    | Action::Photo
                    | Action::PhotoSphere
                    | Action::ToggleFullScreen
                    | Action::ToggleCalibration
                    | Action::Leave
                    | Action::TogglePause
                    | Action::Hold(_)
                    | Action::GoOn
                    | Action::Choose
                    | Action::Answer(_)
                    | Action::Toggle(_)
                    | Action::Set(..)
                    | Action::Next(_)
                    | Action::Stance(_)
                    | Action::SnapTurn(_)
                    | Action::Recentre
            )
        };
        actions.into_iter().filter(|action| of_window(action) || Presentation::repeats(action)).collect()
    }
}
