//! Turns of a headset: its head and hands come into the ride, its pictures go to its runtime.

use super::open::Open;
use crate::error::Error;
use crate::output::say::tell;
use hardware::heard;
use headset::{HeadsetError, HeadsetTurn};
use input::{Sample, SampleSource};
use render::display::Development;
use words::{Language, Phrase};

impl Open {
    /// Waits until the headset wants a frame, and brings its head and hands into the ride; `None` without a headset, or
    /// while it rests.
    pub(super) fn headset_turn(&mut self) -> Option<HeadsetTurn> {
        let session = self.worn.as_mut()?.session.as_mut()?;
        match session.wait() {
            Ok(None) => None,
            Ok(Some(turn)) => {
                let report = turn.report.to_bytes();
                if self.ride.live.is_recorded() {
                    // Whoever watches a recorded ride looks round in it.
                    self.ride.viewer = self.worn.as_mut().map(|worn| worn.follow(&report));
                } else {
                    self.ride.live.say(|at| Sample::bytes(at, SampleSource::Openxr, report));
                }
                if !turn.period.is_zero() {
                    self.ride.hold_rate(turn.period.as_secs_f64().recip());
                }
                if let Some(walls) = self.canvas.walls_mut() {
                    walls.headset = Some(turn.eyes.clone());
                }
                Some(turn)
            }
            Err(error) => {
                self.lose_headset(&error);
                None
            }
        }
    }

    /// Hands the pictures of a turn over.
    ///
    /// # Errors
    /// A lost graphics device.
    pub(super) fn show_in_headset(&mut self, turn: &HeadsetTurn, development: &Development) -> Result<(), Error> {
        let Some(session) = self.worn.as_mut().and_then(|worn| worn.session.as_mut()) else { return Ok(()) };
        let Some(walls) = self.canvas.walls_mut() else { return Ok(()) };
        let gpu = &self.gpu;
        match session.show(turn, |pictures| pictures.show(gpu, walls, development)) {
            Ok(()) => {
                self.ride.times.note(Phrase::StagePose, turn.asked.elapsed());
                if let Some(lead) = turn.lead {
                    self.ride.times.note(Phrase::StageSeen, lead);
                }
            }
            Err(error) => self.lose_headset(&error),
        }
        Ok(self.gpu.lost()?)
    }

    /// Ends the session with the headset. The ride goes on in the window.
    fn lose_headset(&mut self, error: &HeadsetError) {
        if let Some(worn) = &mut self.worn {
            worn.session = None;
        }
        self.ride.viewer = None;
        self.ride.live.say(|at| Sample::closed(at, SampleSource::Openxr));
        tell(Language::English.fill(Phrase::HeadsetLost, &[&sentence(error, Language::English)]));
        let language = self.presentation.language;
        let told = language.fill(Phrase::HeadsetLost, &[&sentence(error, language)]);
        self.ride.live.tell(told);
    }
}

/// Sentence on a headset that cannot be used.
fn sentence(error: &HeadsetError, language: Language) -> String {
    match error {
        HeadsetError::Runtime(fault) => heard::fault(&fault.clone().into(), language),
        HeadsetError::Device(_) | HeadsetError::Views(_) | HeadsetError::Format => error.to_string(),
    }
}
