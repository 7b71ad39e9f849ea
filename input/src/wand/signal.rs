//! Signals of a wand: what one message of a tracker says about it.

use super::held_buttons::HeldButtons;
use crate::head::tracked_pose::TrackedPose;

/// Most analog channels of a device, as in VRPN itself.
pub const MOST_AXES: usize = 128;

/// Signal of a wand.
#[derive(Clone, Debug, PartialEq)]
pub enum WandSignal {
    /// Pose of one of the sensors of the wand's device.
    Pose(TrackedPose),
    /// A button that was pressed or released.
    Button {
        /// Number of the button, from 0.
        button: u32,
        /// True if it is held now.
        held: bool,
    },
    /// State of all buttons.
    Buttons(HeldButtons),
    /// Values of all axes, at most those that a wand has room for.
    Axes(Vec<f64>),
}
