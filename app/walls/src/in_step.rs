//! Windows of one display, in step: all that are seen show the same frame.
//!
//! A frame is drawn once every window has a texture for it, and is then presented in all of them. While one window has
//! none yet, the others hold theirs: none is presented, and none is given away, since a texture that is dropped is lost
//! to its surface. Two kinds of windows do not stop the others and are left out: those that nobody sees, at once, and
//! those that have had no texture for [`PATIENCE`] turns. A window that was left out comes back with the first frame
//! that it shows together with the others.
//!
//! Nothing here knows a surface, a clock or a device: textures are of any type, and turns are counted.

use std::fmt::Display;
use std::time::Duration;

/// Number of turns for which a window without a texture stops the others.
pub const PATIENCE: u32 = 10;

/// Answer of a window that was asked for the texture of its next frame.
#[derive(Debug)]
pub enum TextureAnswer<T> {
    /// The texture.
    Texture(T),
    /// No texture in this turn: the surface is busy, or was just made anew.
    NotYet,
    /// No texture, because nobody sees the window: it is hidden, or has no area.
    Unseen,
}

/// Windows of a display, each with the texture that it holds for the next frame.
#[derive(Debug)]
pub struct WindowsInStep<T> {
    windows: Vec<SteppedWindow<T>>,
    /// Number of frames presented.
    frames: u64,
    /// Number of turns in which windows held their textures because another had none.
    held_turns: u64,
    /// Time between the first and the last present of the newest frame, and the longest such time.
    skew: Duration,
    longest_skew: Duration,
}

/// One window in the step.
#[derive(Debug)]
struct SteppedWindow<T> {
    texture: Option<T>,
    /// Number of turns without a texture since the frame presented last.
    missed: u32,
    /// True from the turn that leaves the window out to the frame that it presents again.
    left_out: bool,
}

impl<T> WindowsInStep<T> {
    /// This many windows, none of which has a texture yet.
    pub fn new(count: usize) -> Self {
        let windows = (0..count).map(|_| SteppedWindow { texture: None, missed: 0, left_out: false }).collect();
        Self { windows, frames: 0, held_turns: 0, skew: Duration::ZERO, longest_skew: Duration::ZERO }
    }

    /// Windows that hold no texture, in order. Each is asked for one, once in every turn.
    pub fn lacking(&self) -> Vec<usize> {
        (0..self.windows.len()).filter(|&window| self.windows[window].texture.is_none()).collect()
    }

    /// True if the others go on without this window. Nobody waits for its answer.
    pub fn is_left_out(&self, window: usize) -> bool {
        self.windows[window].left_out
    }

    /// Takes the answer of a window that lacks a texture.
    pub fn answer(&mut self, window: usize, answer: TextureAnswer<T>) {
        let window = &mut self.windows[window];
        match answer {
            TextureAnswer::Texture(texture) => window.texture = Some(texture),
            TextureAnswer::NotYet => {
                window.missed = window.missed.saturating_add(1);
                window.left_out |= window.missed > PATIENCE;
            }
            TextureAnswer::Unseen => window.left_out = true,
        }
    }

    /// Drops the texture that a window holds, before its surface changes.
    pub fn release(&mut self, window: usize) {
        self.windows[window].texture = None;
    }

    /// Textures of the frame that is drawn and presented in this turn, each with its window, in order; `None` if
    /// nothing is presented in this turn, and textures are held.
    pub fn turn(&mut self) -> Option<Vec<(usize, T)>> {
        let holding = self.windows.iter().any(|window| window.texture.is_some());
        let stopped = self.windows.iter().any(|window| window.texture.is_none() && !window.left_out);
        if stopped || !holding {
            self.held_turns += u64::from(stopped && holding);
            return None;
        }
        self.frames += 1;
        let windows = self.windows.iter_mut().enumerate();
        let textures = windows.filter_map(|(number, window)| {
            let texture = window.texture.take()?;
            (window.missed, window.left_out) = (0, false);
            Some((number, texture))
        });
        Some(textures.collect())
    }

    /// Notes the time between the first and the last present of a frame.
    pub fn presented(&mut self, skew: Duration) {
        self.skew = skew;
        self.longest_skew = self.longest_skew.max(skew);
    }

    /// Sentence on how well the windows keep step; `None` for a single window. `fill`: sentence of the number of
    /// windows, that of the frame, its skew and the longest one (milliseconds), windows left out, turns held.
    pub fn sentence(&self, fill: impl FnOnce(&[&dyn Display; 6]) -> String) -> Option<String> {
        let count = self.windows.len();
        if count < 2 {
            return None;
        }
        let left_out = self.windows.iter().filter(|window| window.left_out).count();
        let [skew, longest] = [self.skew, self.longest_skew].map(|time| format!("{:.2}", time.as_secs_f64() * 1e3));
        Some(fill(&[&count, &self.frames, &skew, &longest, &left_out, &self.held_turns]))
    }
}

#[cfg(test)]
mod tests;
