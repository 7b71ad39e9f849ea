//! Progress bars for long waits: drawn on the standard error of a terminal, silent elsewhere.

use indicatif::{ProgressBar, ProgressStyle};
use std::sync::OnceLock;
use std::time::{Duration, Instant};
use view::Dial;

/// Spinner with a sentence, for work of unknown length.
pub fn spinner(what: impl Into<String>) -> ProgressBar {
    let bar = ProgressBar::new_spinner().with_message(what.into());
    bar.set_style(style("{spinner} {msg} {elapsed}"));
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

/// Spinner for the cutting of edges, if the dial asks for it.
pub fn cutting(dial: Dial) -> ProgressBar {
    match dial.edge {
        Some(edge_m) => spinner(format!("cutting triangles to {edge_m} m")),
        None => ProgressBar::hidden(),
    }
}

/// Progress bar that counts to `length`.
pub fn bar(what: impl Into<String>, length: u64) -> ProgressBar {
    let bar = ProgressBar::new(length).with_message(what.into());
    bar.set_style(style("{msg} {wide_bar} {pos}/{len} {eta}"));
    bar
}

/// Progress in percent that is shown only once the work has taken a second. It may be told from any thread.
pub struct LateBar {
    began: Instant,
    bar: OnceLock<ProgressBar>,
    what: &'static str,
}

impl LateBar {
    /// Waiting time before anything is shown.
    const PATIENCE: Duration = Duration::from_secs(1);

    /// Bar for work that begins now.
    pub fn new(what: &'static str) -> Self {
        Self { began: Instant::now(), bar: OnceLock::new(), what }
    }

    /// Shows that `done` of `total` parts are finished.
    pub fn told(&self, done: usize, total: usize) {
        if self.began.elapsed() > Self::PATIENCE {
            let bar = self.bar.get_or_init(|| {
                let bar = ProgressBar::new(total as u64).with_message(self.what);
                bar.set_style(style("{msg} {wide_bar} {percent} %"));
                bar
            });
            bar.set_position(done as u64);
        }
    }

    /// Removes the bar.
    pub fn finish(self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is well formed")
}
