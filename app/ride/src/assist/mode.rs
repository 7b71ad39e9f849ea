//! Setting of the assisted steering.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// Condition for assisted steering. Recordings made before there was any are without.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum AssistMode {
    /// Never assisted.
    #[default]
    Off,
    /// Always assisted.
    On,
    /// Assisted as long as keys alone steer: not with a handlebar, and not after a stick or a SpaceMouse was moved.
    Auto,
}
