//! Controls: the rider's wishes, whatever the device.

use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::head::state::HeadState;
use crate::look::free_look::FreeLook;
use crate::wand::state::WandState;

/// State of all controls at one moment, and the actions since the moment before.
///
/// # Frames, units
/// The pilot's own axes, right-handed: x to the right, y up, z backward, so that forward is −z. Turns are about these
/// axes by the right-hand rule.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Controls {
    /// Speed of the driven wheel on the rider's own clock, m/s; negative backward. `None` while there is neither a
    /// bicycle nor a key or trigger that has pedalled.
    pub wheel_speed: Option<f64>,
    /// Turns of the crank a second. `None` where no sensor measures them.
    pub cadence_hz: Option<f64>,
    /// Angle of the handlebar, radians, positive to the left (counter-clockwise from above).
    pub steer_rad: f64,
    /// Brake lever, 0 released to 1 pulled through.
    pub brake: f64,
    /// Thrust as a fraction of the vehicle's largest, each −1 to 1: right, up, backward.
    pub thrust: [f64; 3],
    /// Turn rate as a fraction of the vehicle's largest, each −1 to 1: nose up, nose to the left, roll to the left.
    pub turn: [f64; 3],
    /// Head in the room. `None` without a tracker.
    #[serde(default)]
    pub head: Option<HeadState>,
    /// Wand in the room, in a box because few rides have one. `None` without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wand: Option<Box<WandState>>,
    /// Turn of the gaze against the nose; along the nose in recordings made before one could look round.
    #[serde(default)]
    pub look: FreeLook,
    /// Actions since the controls were last asked for, in order.
    pub actions: Vec<Action>,
}
