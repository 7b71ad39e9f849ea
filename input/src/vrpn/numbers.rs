//! Which numbers stand for which names, on one connection.

use super::types::{PING, PONG, POSE, VELOCITY};
use super::wire::{DESCRIBES_SENDER, DESCRIBES_TYPE, VrpnError, VrpnMessage};

/// Senders that are remembered by name, for those who have mistaken it.
pub(super) const MOST_SENDERS: usize = 16;

/// The numbers that the other side has given to the names that matter.
#[derive(Clone, Debug, Default)]
pub struct VrpnNumbers {
    /// Name of the device that we listen to.
    device: String,
    sender: Option<i32>,
    /// Of [`Self::TYPES`].
    types: [Option<i32>; 4],
    senders: Vec<String>,
}

impl VrpnNumbers {
    const TYPES: [&str; 4] = [POSE, VELOCITY, PING, PONG];

    /// Nothing described yet.
    pub fn new(device: &str) -> Self {
        Self { device: device.to_owned(), ..Self::default() }
    }

    /// Forgets what was described.
    pub fn forget(&mut self) {
        *self = Self::new(&self.device);
    }

    /// Takes a description; whether the message was one.
    ///
    /// # Errors
    /// If its name cannot be read.
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

    /// Which of the types that matter this message of our device is; `None` for all others.
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

    /// Whether our device has been described.
    pub fn has_device(&self) -> bool {
        self.sender.is_some()
    }
}

/// A number goes to a name, and is taken from the name that had it.
fn give(number: &mut Option<i32>, described: i32, is_ours: bool) {
    if is_ours {
        *number = Some(described);
    } else if *number == Some(described) {
        *number = None;
    }
}
