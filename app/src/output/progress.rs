//! Bars on long waits: drawn on a terminal's standard error, silent elsewhere.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// A spinner with a sentence, for work whose length is not known.
pub fn spinner(what: impl Into<String>) -> ProgressBar {
    let bar = ProgressBar::new_spinner().with_message(what.into());
    bar.set_style(style("{spinner} {msg} {elapsed}"));
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

/// A bar that counts to `length`.
pub fn bar(what: impl Into<String>, length: u64) -> ProgressBar {
    let bar = ProgressBar::new(length).with_message(what.into());
    bar.set_style(style("{msg} {wide_bar} {pos}/{len} {eta}"));
    bar
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is well formed")
}
