//! Turns of a headset: its head and hands come into the ride, its pictures go to its runtime.

use super::open::Open;
use crate::error::Error;
use crate::output::say::tell;
use hardware::heard;
use headset::{HeadsetError, HeadsetTurn};
use input::{Sample, SampleSource};
use render::display::Development;
use walls::Veil;
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
                    walls.headset = Some(turn.eyes);
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
        let Some(worn) = &mut self.worn else { return Ok(()) };
        let Some(session) = &mut worn.session else { return Ok(()) };
        let (gpu, canvas) = (&self.gpu, &mut self.canvas);
        // The window's copy does not fade.
        let fade = Veil::everywhere(worn.fade.after(turn.report.time_ns, turn.sees_head));
        canvas.walls_mut().into_iter().for_each(|walls| walls.fade = fade);
        let shown = session.show(turn, |eye, view| {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            canvas.show(gpu, &mut encoder, eye, development, view, [0, 0]);
            gpu.queue.submit([encoder.finish()]);
        });
        canvas.walls_mut().into_iter().for_each(|walls| walls.fade = Veil::NONE);
        if let Err(error) = shown {
            self.lose_headset(&error);
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
