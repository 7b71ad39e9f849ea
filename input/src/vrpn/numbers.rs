//! Numbers of the names on one connection.

use super::types::{BUTTON, BUTTONS, CHANNELS, PING, PONG, POSE, VELOCITY};
use super::wire::{DESCRIBES_SENDER, DESCRIBES_TYPE, VrpnError, VrpnMessage};

/// Number of senders whose names are kept, to list what they send.
pub(super) const MOST_SENDERS: usize = 64;

/// Numbers that the other side has given to the names that are needed.
///
/// A description of a device proves nothing: the stock server repeats those that any client has made. A device
/// exists if it sends something, the answer to a ping if nothing else.
#[derive(Clone, Debug, Default)]
pub struct VrpnNumbers {
    /// Devices that are listened to, the one of the pose first. No flood of others crowds them out.
    listened: Vec<ListenedDevice>,
    /// Number of each of [`Self::TYPES`].
    types: [Option<i32>; 7],
    /// Senders by number, as they were described.
    senders: Vec<(i32, String)>,
}

/// Device that is listened to.
#[derive(Clone, Debug, Default)]
struct ListenedDevice {
    name: String,
    number: Option<i32>,
    /// True if it has sent something.
    exists: bool,
}

impl VrpnNumbers {
    const TYPES: [&str; 7] = [POSE, VELOCITY, PING, PONG, BUTTON, BUTTONS, CHANNELS];

    /// Numbers before any description, of a device alone.
    pub fn new(device: &str) -> Self {
        Self::of_devices([device])
    }

    /// Numbers before any description, of a device and others that are listened to.
    pub fn of_devices<'a>(devices: impl IntoIterator<Item = &'a str>) -> Self {
        let mut numbers = Self::default();
        for name in devices {
            if !numbers.listened.iter().any(|known| known.name == name) {
                numbers.listened.push(ListenedDevice { name: name.to_owned(), ..Default::default() });
            }
        }
        numbers
    }

    /// Forgets all descriptions.
    pub fn forget(&mut self) {
        for device in &mut self.listened {
            (device.number, device.exists) = (None, false);
        }
        (self.types, self.senders) = (Default::default(), Vec::new());
    }

    /// Takes a description; false for any other message, whose sender then is known to exist.
    ///
    /// # Errors
    /// A name that cannot be read.
    pub fn describe(&mut self, message: &VrpnMessage<'_>) -> Result<bool, VrpnError> {
        match message.kind {
            DESCRIBES_SENDER => {
                let name = message.name()?;
                for device in &mut self.listened {
                    give(&mut device.number, message.sender, name == device.name);
                }
                // A name has one number, a number one name: the newest.
                self.senders.retain(|(number, known)| *number != message.sender && known != name);
                if self.senders.len() < MOST_SENDERS {
                    self.senders.push((message.sender, name.to_owned()));
                }
            }
            DESCRIBES_TYPE => {
                let name = message.name()?;
                for (number, known) in self.types.iter_mut().zip(Self::TYPES) {
                    give(number, message.sender, name == known);
                }
            }
            kind => {
                let mut listened = self.listened.iter_mut();
                if let Some(device) = listened.find(|device| kind >= 0 && device.number == Some(message.sender)) {
                    device.exists = true;
                }
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Type of a message, if it is one of the known types; `None` for all others.
    pub fn kind(&self, message: &VrpnMessage<'_>) -> Option<&'static str> {
        let index = self.types.iter().position(|number| *number == Some(message.kind))?;
        Some(Self::TYPES[index])
    }

    /// Name of a message's sender, if it has been described.
    pub fn sender(&self, message: &VrpnMessage<'_>) -> Option<&str> {
        let listened = self.listened.iter().find(|device| device.number == Some(message.sender));
        let others = || self.senders.iter().find(|(number, _)| *number == message.sender).map(|(_, name)| name);
        listened.map(|device| &device.name).or_else(others).map(String::as_str)
    }

    /// True if the message comes from a device that is listened to.
    pub fn is_listened(&self, message: &VrpnMessage<'_>) -> bool {
        self.listened.iter().any(|device| device.number == Some(message.sender))
    }

    /// Names of the senders that have been described, the first few.
    pub fn senders(&self) -> Vec<String> {
        self.senders.iter().map(|(_, name)| name.clone()).collect()
    }

    /// True if the device of the pose has been described.
    pub fn has_device(&self) -> bool {
        self.listened.first().is_some_and(|device| device.number.is_some())
    }

    /// Names of the devices that are listened to and have not sent anything, not even the answer to a ping.
    pub fn missing(&self) -> impl Iterator<Item = &str> {
        self.listened.iter().filter(|device| !device.exists).map(|device| device.name.as_str())
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
