//! Commands of a test, a line each.

use openxr::sys::{Posef, Quaternionf, SessionState, Vector3f};

/// Command of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LayerCommand<'a> {
    /// Next state of the session.
    State(SessionState),
    /// End of the runtime, announced.
    InstanceLoss,
    /// Loss of the session, unannounced.
    SessionLost,
    /// Head in sight, or not.
    Head(bool),
    /// Velocity of the head, m/s.
    Velocity([f32; 3]),
    /// Action that the right hand holds, and how far.
    Hold(&'a str, [f32; 2]),
    /// Place of the stage's origin in the runtime's first stage.
    Recentre(Posef),
    /// Another space than the stage that is moved.
    RecentreLocal,
}

impl<'a> LayerCommand<'a> {
    /// Command of a line; `None` if it is none.
    pub(crate) fn of(line: &'a str) -> Option<Self> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let number = |word: &str| word.parse::<f32>().ok();
        Some(match words.as_slice() {
            ["ready"] => Self::State(SessionState::READY),
            ["synchronized"] => Self::State(SessionState::SYNCHRONIZED),
            ["visible"] => Self::State(SessionState::VISIBLE),
            ["focused"] => Self::State(SessionState::FOCUSED),
            ["stopping"] => Self::State(SessionState::STOPPING),
            ["loss_pending"] => Self::State(SessionState::LOSS_PENDING),
            ["exiting"] => Self::State(SessionState::EXITING),
            ["instance_loss"] => Self::InstanceLoss,
            ["session_lost"] => Self::SessionLost,
            ["head", "off"] => Self::Head(false),
            ["head", "on"] => Self::Head(true),
            ["velocity", x, y, z] => Self::Velocity([number(x)?, number(y)?, number(z)?]),
            ["hold", action, x, y] => Self::Hold(action, [number(x)?, number(y)?]),
            ["recentre", "local"] => Self::RecentreLocal,
            ["recentre", x, y, z, yaw] => {
                let half = number(yaw)?.to_radians() / 2.0;
                let orientation = Quaternionf { x: 0.0, y: half.sin(), z: 0.0, w: half.cos() };
                Self::Recentre(Posef {
                    orientation,
                    position: Vector3f { x: number(x)?, y: number(y)?, z: number(z)? },
                })
            }
            _ => return None,
        })
    }
}
