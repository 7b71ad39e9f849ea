//! `rapidity ride --kiosk`: rides that visitors take one after the other.

use std::path::PathBuf;

use clap::Args;

use super::values;

/// Options of a kiosk.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "Kiosk")]
pub struct KioskOptions {
    /// Ride in full screen for visitors, one after the other.
    ///
    /// A touch of any control begins a fresh ride at the start. When nobody has touched one for a while, the tour is
    /// shown. There are no settings, no photos, and no way out but a signal (SIGTERM or Ctrl-C), which completes the
    /// log and the recording. --record records the whole day, the tour included.
    #[arg(long)]
    #[arg(conflicts_with_all = ["replay", "verify", "out", "realtime", "seconds", "preview"])]
    pub kiosk: bool,
    /// Time without a touch after which a visitor has left, seconds.
    #[arg(long, value_name = "N", default_value = "60", value_parser = values::within(1.0, 86_400.0), requires = "kiosk")]
    pub idle_s: f64,
    /// Folder of the day's log, a file of JSON lines a day [default: rapidity in the user's folder for states,
    /// ~/.local/state on Linux, or XDG_STATE_HOME].
    #[arg(long, value_name = "DIR", requires = "kiosk")]
    pub log: Option<PathBuf>,
}
