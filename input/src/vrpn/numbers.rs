//! Numbers of the names on one connection.

use super::types::{PING, PONG, POSE, VELOCITY};
use super::wire::{DESCRIBES_SENDER, DESCRIBES_TYPE, VrpnError, VrpnMessage};

/// Number of senders whose names are kept, to report a mistaken name.
pub(super) const MOST_SENDERS: usize = 16;

/// Numbers that the other side has given to the names that are needed.
#[derive(Clone, Debug, Default)]
pub struct VrpnNumbers {
    /// Name of the device that is listened to.
    device: String,
    sender: Option<i32>,
    /// Number of each of [`Self::TYPES`].
    types: [Option<i32>; 4],
    senders: Vec<String>,
}

impl VrpnNumbers {
    const TYPES: [&str; 4] = [POSE, VELOCITY, PING, PONG];

    /// Numbers before any description.
    pub fn new(device: &str) -> Self {
        Self { device: device.to_owned(), ..Self::default() }
    }

    /// Forgets all descriptions.
    pub fn forget(&mut self) {
        *self = Self::new(&self.device);
    }

    /// Takes a description; false for any other message.
    ///
    /// # Errors
    /// A name that cannot be read.
    pub fn describe(&mut self, message: &VrpnMessage<'_>) -> Result<bool, VrpnError> {
        match message.kind {
            DESCRIBES_SENDER => {
                let name = message.name()?;
                give(&mut self.sender, message.sender, name == self.device);
                if self.senders.len() < MOST_SENDERS && !self.senders.iter().any(|known| known == name) {
                    self.senders.push(name.to_owned());
                }
            }
            DESCRIBES_TYPE => {
                let name = message.name()?;
                for (number, known) in self.types.iter_mut().zip(Self::TYPES) {
                    give(number, message.sender, name == known);
                }
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Type of a message of the device, if it is one of the known types; `None` for all others.
    pub fn of_device(&self, message: &VrpnMessage<'_>) -> Option<&'static str> {
        if self.sender != Some(message.sender) {
            return None;
        }
        let index = self.types.iter().position(|number| *number == Some(message.kind))?;
        Some(Self::TYPES[index])
    }

    /// Names of the senders that have been described, the first few.
    pub fn senders(&self) -> &[String] {
        &self.senders
    }

    /// True if the device has been described.
    pub fn has_device(&self) -> bool {
        self.sender.is_some()
    }
}

/// Gives a number to a name, and takes it from the name that had it.
fn give(number: &mut Option<i32>, described: i32, is_ours: bool) {
    if is_ours {
        *number = Some(described);
    } else if *number == Some(described) {
        *number = None;
    }
}
