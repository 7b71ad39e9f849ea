//! Turns of a headset: its head and hands come into the ride, its pictures go to its runtime.

use super::open::Open;
use crate::error::Error;
use crate::output::say::tell;
use hardware::heard;
use headset::{HeadsetError, HeadsetTurn};
use input::{Nanos, SECOND, Sample, SampleSource};
use render::display::Development;
use ride::TICKS_PER_SECOND;
use walls::Veil;
use words::{Language, Phrase};

/// Time of a tick of the ride, not less.
const TICK: Nanos = SECOND / TICKS_PER_SECOND as Nanos + 1;

impl Open {
    /// Waits until the headset wants a frame, and brings its head and hands into the ride; `None` without a headset, or
    /// while it rests.
    pub(super) fn headset_turn(&mut self) -> Option<HeadsetTurn> {
        let session = self.worn.as_mut()?.session.as_mut()?;
        match session.wait() {
            Ok(None) => {
                self.rest_headset();
                None
            }
            Ok(Some(turn)) => {
                self.worn.as_mut()?.last = Some(turn.report);
                let report = turn.report.to_bytes();
                if self.ride.live.is_recorded() {
                    // Whoever watches a recorded ride looks round in it.
                    self.ride.viewer = self.worn.as_mut().map(|worn| worn.follow(&report));
                } else {
                    self.say_in_time(|at| Sample::bytes(at, SampleSource::Openxr, report));
                }
                if !turn.period.is_zero() {
                    self.ride.hold_rate(turn.period.as_secs_f64().recip());
                }
                if let Some((walls, worn)) = self.canvas.walls_mut().zip(self.worn.as_mut()) {
                    walls.headset = Some(turn.eyes.clone());
                    if turn.masks_changed || !worn.is_drawn_for {
                        worn.fit(&self.gpu, walls);
                    }
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
        let Some((session, walls)) = worn.session.as_mut().zip(self.canvas.walls_mut()) else { return Ok(()) };
        let gpu = &self.gpu;
        // The window's copy does not fade.
        walls.fade = Veil::everywhere(worn.fade.after(turn.report.time_ns, turn.sees_head));
        let shown = session.show(turn, |pictures| pictures.show(gpu, walls, development));
        walls.fade = Veil::NONE;
        match shown {
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

    /// Lets go of all that the hands held when the headset was put down. The ride goes on in the window, whole.
    fn rest_headset(&mut self) {
        // A headset that has not been put on yet rests, too.
        if self.worn.as_ref().is_some_and(|worn| worn.is_drawn_for) {
            self.draw_for_window();
        }
        let Some(last) = self.worn.as_mut().and_then(|worn| worn.last.take()) else { return };
        self.ride.viewer = None;
        self.say_in_time(|at| Sample::bytes(at, SampleSource::Openxr, last.at_rest().to_bytes()));
    }

    /// Brings what the headset says into this frame of the ride: it is dated a tick back, since a frame takes what
    /// came before its last tick, and what is said now would move the head of the next picture alone.
    fn say_in_time(&mut self, sample: impl FnOnce(Nanos) -> Sample) {
        self.ride.live.say(|at| sample(at.saturating_sub(TICK)));
    }

    /// Draws what a window shows, whole and as bright as it is, until the headset wants a frame again.
    pub(super) fn draw_for_window(&mut self) {
        if let Some((worn, walls)) = self.worn.as_mut().zip(self.canvas.walls_mut()) {
            worn.leave(walls);
        }
    }

    /// Ends the session with the headset. The ride goes on in the window.
    fn lose_headset(&mut self, error: &HeadsetError) {
        if let Some(worn) = &mut self.worn {
            worn.session = None;
        }
        self.draw_for_window();
        self.ride.viewer = None;
        self.say_in_time(|at| Sample::closed(at, SampleSource::Openxr));
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
