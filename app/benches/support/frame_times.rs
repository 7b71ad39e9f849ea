//! Times of frames that are drawn in one way, in turns with other ways.

use super::figures::{median, milliseconds, quantile};
use std::time::{Duration, Instant};

/// Times of one way's frames, milliseconds.
#[derive(Clone, Debug, Default)]
pub struct FrameTimes {
    /// Median of each turn.
    turns: Vec<f64>,
    /// Frames of all turns.
    frames: Vec<f64>,
}

impl FrameTimes {
    /// Adds the frames of a turn.
    pub fn add(&mut self, turn: &[f64]) {
        self.turns.push(median(turn));
        self.frames.extend(turn);
    }

    /// Median of the turns.
    pub fn median_ms(&self) -> f64 {
        median(&self.turns)
    }

    /// Time that 95 of 100 frames keep to.
    pub fn slow_ms(&self) -> f64 {
        quantile(&self.frames, 0.95)
    }

    /// Ratio to the times of another way, turn by turn: quartile, median, quartile.
    pub fn ratio(&self, other: &Self) -> [f64; 3] {
        let ratios: Vec<f64> = self.turns.iter().zip(&other.turns).map(|(own, other)| own / other).collect();
        [0.25, 0.5, 0.75].map(|share| quantile(&ratios, share))
    }

    /// Line of a table, with the ratio to another way.
    pub fn line(&self, name: &str, other: &Self) -> String {
        let [low, middle, high] = self.ratio(other);
        let (median, slow) = (self.median_ms(), self.slow_ms());
        format!("  {name:>42}: {median:7.2} ms, 95 % in {slow:7.2} ms, ratio {middle:.3} ({low:.3} to {high:.3})")
    }

    /// Row of a Markdown table: `cells`, frames per second at the median and at the 95 % quantile, ratio to another
    /// way.
    pub fn markdown(&self, cells: &[&str], other: &Self) -> String {
        let [_, ratio, _] = self.ratio(other);
        let [usual, slow] = [self.median_ms(), self.slow_ms()].map(|ms| 1e3 / ms);
        format!("| {} | {usual:.2} | {slow:.2} | {ratio:.2} |", cells.join(" | "))
    }
}

/// Times of the frames of a turn, milliseconds. The first one, which comes after another way's, is not counted.
pub fn turn<E>(frames: usize, mut frame: impl FnMut() -> Result<(), E>) -> Result<Vec<f64>, E> {
    frame()?;
    let mut times = Vec::with_capacity(frames);
    for _ in 0..frames {
        let started = Instant::now();
        frame()?;
        times.push(milliseconds(started.elapsed()));
    }
    Ok(times)
}

/// Lets each way have its turn until the time is over, at least twice. The first round compiles shaders and touches
/// memory, so it does not count.
pub fn rounds<E>(time: Duration, mut round: impl FnMut(bool) -> Result<(), E>) -> Result<(), E> {
    round(false)?;
    let started = Instant::now();
    loop {
        round(true)?;
        if started.elapsed() >= time {
            return Ok(());
        }
    }
}
