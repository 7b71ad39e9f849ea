//! Progress bars for long waits: drawn on the standard error of a terminal, silent elsewhere.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;
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

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is well formed")
}
