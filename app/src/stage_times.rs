//! Timing of the stages of a frame, smoothed for reading.

use std::time::{Duration, Instant};
use words::{Language, Phrase};

/// Share of the older value in the smoothed one, per frame.
const KEPT: f64 = 0.9;

/// Timers for a sequence of frames.
#[derive(Debug, Default)]
pub struct StageTimes {
    began: Option<Instant>,
    stage_began: Option<Instant>,
    frame_ms: f64,
    stages: Vec<(Phrase, f64)>,
}

impl StageTimes {
    /// Marks the beginning of a frame, which is also the end of the previous one.
    pub fn begin(&mut self) {
        let now = Instant::now();
        if let Some(began) = self.began.replace(now) {
            let milliseconds = (now - began).as_secs_f64() * 1e3;
            self.frame_ms = if self.frame_ms == 0.0 { milliseconds } else { mixed(self.frame_ms, milliseconds) };
        }
        self.stage_began = Some(now);
    }

    /// Marks the end of the stage `name`; the next stage begins.
    pub fn stage(&mut self, name: Phrase) {
        let now = Instant::now();
        if let Some(began) = self.stage_began.replace(now) {
            self.note(name, now - began);
        }
    }

    /// Records the time of the transform, which runs in parallel with the other stages.
    pub fn transformed(&mut self, duration: Duration) {
        self.note(Phrase::StageTransform, duration);
    }

    /// Records the time of something else than a stage.
    pub fn note(&mut self, name: Phrase, duration: Duration) {
        let milliseconds = duration.as_secs_f64() * 1e3;
        match self.stages.iter_mut().find(|stage| stage.0 == name) {
            Some(stage) => stage.1 = mixed(stage.1, milliseconds),
            None => self.stages.push((name, milliseconds)),
        }
    }

    /// Number of frames per second.
    pub fn frame_rate(&self) -> f64 {
        if self.frame_ms > 0.0 { 1e3 / self.frame_ms } else { 0.0 }
    }

    /// Name and duration of each stage, milliseconds.
    pub fn stages_ms(&self, language: Language) -> Vec<(&'static str, f64)> {
        self.stages.iter().map(|(name, ms)| (language.text(*name), *ms)).collect()
    }
}

fn mixed(old: f64, new: f64) -> f64 {
    KEPT * old + (1.0 - KEPT) * new
}
