//! Stance of a rider: seated on the vehicle's seat, or standing on its floor.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Stance of a rider whose head is tracked, which says what of a straight pose is the seat's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stance {
    /// Seated: the straight pose is the seat's, whatever its height was; a headset's keeps what is upright.
    #[default]
    Seated,
    /// Standing: place in the plane and heading are the seat's; the height above the tracker's floor is kept, and what
    /// is upright stays so. The vehicle's floor is the tracker's.
    Standing,
}

/// Error for a text that names no stance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("expected seated or standing")]
pub struct StanceError;

impl Stance {
    /// All stances.
    pub const ALL: [Self; 2] = [Self::Seated, Self::Standing];

    /// Name of the stance on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Seated => "seated",
            Self::Standing => "standing",
        }
    }

    pub(super) fn is_seated(&self) -> bool {
        *self == Self::Seated
    }
}

impl Display for Stance {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for Stance {
    type Err = StanceError;

    fn from_str(text: &str) -> Result<Self, StanceError> {
        Self::ALL.into_iter().find(|stance| stance.name() == text).ok_or(StanceError)
    }
}
