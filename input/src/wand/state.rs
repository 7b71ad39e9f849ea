//! State of the wand at one moment.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::held_buttons::HeldButtons;
use crate::head::rigid::Rigid;
use crate::head::state::Tracking;

/// State of the wand at one moment.
///
/// *Frames, units*: the room's axes: x right, y up, z backward; metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WandState {
    /// Place of the wand, metres; of no meaning while `tracked` is [`Tracking::Never`].
    pub position_m: DVec3,
    /// Turn `room_from_wand`: the wand points along its −z, and its right side is at +x.
    pub orientation: DQuat,
    /// Reliability of the pose. Buttons and axes do not depend on it.
    pub tracked: Tracking,
    /// Buttons that are held.
    pub buttons: HeldButtons,
    /// Deflection of the stick to the right and ahead, each −1 to 1.
    pub stick: [f64; 2],
    /// Trigger, 0 released to 1 pulled through.
    pub trigger: f64,
}

impl WandState {
    /// Wand after a move of the room; a pose that has never been seen stays.
    pub(crate) fn placed(self, room_from_straight: Rigid) -> Self {
        if self.tracked == Tracking::Never || room_from_straight == Rigid::IDENTITY {
            return self;
        }
        let pose = room_from_straight * Rigid { position: self.position_m, orientation: self.orientation };
        Self { position_m: pose.position, orientation: pose.orientation, ..self }
    }
}
