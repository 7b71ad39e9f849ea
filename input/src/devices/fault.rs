//! Reasons why a device is not open, and notes on one that is open and yet does not do all that it should.
//!
//! They are things, so that an interface can word them in any language; their [`Display`](std::fmt::Display) is the
//! English of the terminal. Reasons of the operating system and of libraries are texts, as these word them.

use std::io;

use thiserror::Error;

use super::trainer_error::TrainerError;
use crate::openxr::XrFault;
use crate::trainer::control::ControlRefusal;

/// Rule of udev that makes a SpaceMouse readable, and the file for it.
pub const UDEV_RULE: (&str, &str) =
    ("KERNEL==\"hidraw*\", ATTRS{idVendor}==\"046d|256f\", TAG+=\"uaccess\"", "/etc/udev/rules.d/70-spacemouse.rules");

/// Reason why a device is not open.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum DeviceFault {
    /// A first search that has not ended yet.
    #[error("being looked for")]
    Sought,
    /// The end of the program.
    #[error("the program ends")]
    ProgramEnds,
    /// A device that was open, with the reason of its loss.
    #[error("it has gone ({0}); it will be used again when it is back")]
    Gone(Box<Self>),
    /// A reason as the operating system or a library words it.
    #[error("{0}")]
    System(String),
    /// No gamepad or joystick.
    #[error("no gamepad is plugged in")]
    NoGamepad,
    /// A gamepad, by its path, without the right to read it.
    #[error("{0} may not be read: `sudo usermod -aG input $USER`, then log in again")]
    GamepadForbidden(String),
    /// A serial port, by its path, that does not exist.
    #[error("there is no {0}: plug the bicycle in, or name another port")]
    NoSerialPort(String),
    /// A serial port, by its path, without the right to open it.
    #[error("{0} may not be opened: `sudo usermod -aG dialout $USER`, then log in again")]
    SerialPortForbidden(String),
    /// Path of a serial port that cannot be opened, and the reason.
    #[error("{0} cannot be opened as a serial port: {1}")]
    SerialPort(String, String),
    /// A list of HID devices that cannot be had, with the reason.
    #[error("HID devices cannot be listed: {0}")]
    NoHidList(String),
    /// No SpaceMouse.
    #[error("no SpaceMouse is plugged in")]
    NoSpaceMouse,
    /// A SpaceMouse without the right to read it.
    #[error(
        "{name} may not be read at {path} ({reason}): as root, put `{}` into {} and plug it in again",
        UDEV_RULE.0,
        UDEV_RULE.1
    )]
    SpaceMouseForbidden {
        /// Name that the device gives itself.
        name: String,
        /// Path of the device.
        path: String,
        /// Reason, as the library words it.
        reason: String,
    },
    /// Socket of spacenavd that refuses, and the reason.
    #[error("spacenavd cannot be reached at {0}: {1}")]
    SpacenavdRefuses(String, String),
    /// Places where spacenavd's socket would be.
    #[error("spacenavd does not run ({0})")]
    NoSpacenavd(String),
    /// A system that has no spacenavd; the socket that was named in brackets, or nothing.
    #[error("there is no spacenavd here{0}")]
    NeverSpacenavd(String),
    /// Reasons of two ways to the same device.
    #[error("{0}; {1}")]
    Both(Box<Self>, Box<Self>),
    /// Sender of datagrams, and a place of this machine at which another program listens.
    #[error("another program listens at {1}: end it, or have {0} send to another port")]
    PortTaken(&'static str, String),
    /// A place that is not of this machine.
    #[error("{0} is no address of this machine: name one that is, or none")]
    NotOurAddress(String),
    /// Place that cannot be listened at, and the reason.
    #[error("cannot listen at {0}: {1}")]
    Deaf(String, Box<Self>),
    /// A group of receivers that no network of this machine leads to.
    #[error("this machine has no network interface for it")]
    NoInterface,
    /// Name of a host that is not known, and the reason.
    #[error("there is no host {0:?} ({1}): name another")]
    NoHost(String, String),
    /// Place without a VRPN server, and the reason.
    #[error("no VRPN server at {0}: {1}")]
    NoVrpnServer(String, Box<Self>),
    /// Place at which the greeting of a VRPN server fails, and the reason.
    #[error("{0}: {1}")]
    At(String, Box<Self>),
    /// Place without a trainer, and the reason.
    #[error("no trainer at {0}: {1}")]
    NoTrainer(String, Box<Self>),
    /// A host without an address.
    #[error("it has no address")]
    NoAddress,
    /// A port at which no VRPN server listens.
    #[error("nothing listens there: start the VRPN server, or name another port")]
    NoVrpnThere,
    /// A port at which no trainer listens.
    #[error("nothing listens there: switch the trainer on, or name another port")]
    NoTrainerThere,
    /// A host that does not answer.
    #[error("nothing answers there: is it switched on, and in this network?")]
    NothingThere,
    /// A server that says nothing at first.
    #[error("it says nothing; is it a VRPN server?")]
    NoGreeting,
    /// Silence of a device, seconds.
    #[error("silent for {0} s")]
    Silent(u64),
    /// Silence, seconds, of a server that has described no device.
    #[error("silent for {0} s; it has described no device")]
    SilentWithoutDevices(u64),
    /// Silence, seconds, of a server, and the devices that it has instead of the one that is listened to.
    #[error("silent for {0} s; it has no such device, but {1}")]
    SilentWithOthers(u64, String),
    /// A trainer that cannot be used.
    #[error("{0}")]
    Trainer(TrainerError),
    /// A headset that cannot be used.
    #[error("{0}")]
    Headset(XrFault),
}

impl From<io::Error> for DeviceFault {
    /// Fault that the error carries, else the error's own text.
    fn from(error: io::Error) -> Self {
        match error.get_ref().and_then(|inner| inner.downcast_ref::<Self>()) {
            Some(fault) => fault.clone(),
            None => Self::System(error.to_string()),
        }
    }
}

impl From<XrFault> for DeviceFault {
    fn from(fault: XrFault) -> Self {
        Self::Headset(fault)
    }
}

impl From<TrainerError> for io::Error {
    fn from(error: TrainerError) -> Self {
        DeviceFault::Trainer(error).io(io::ErrorKind::InvalidData)
    }
}

impl DeviceFault {
    /// Error that carries this fault.
    pub(super) fn io(self, kind: io::ErrorKind) -> io::Error {
        io::Error::new(kind, self)
    }
}

/// Note on a device that is open and yet does not do all that it should.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum DeviceNote {
    /// A trainer without a control point.
    #[error("the trainer takes no commands (it has no control point 2ad9): its brake does not follow the road")]
    NoControlPoint,
    /// A trainer that does not obey.
    #[error("the trainer cannot be controlled ({0}): its brake does not follow the road")]
    NoControl(ControlRefusal),
}

#[cfg(test)]
mod tests {
    //! Law: what an error of the system carries comes out as the thing that it is; a text stays a text.
    use super::*;

    #[test]
    fn a_fault_passes_through_an_error_of_the_system() {
        let fault = DeviceFault::SilentWithOthers(10, "Head".to_owned());
        let error = fault.clone().io(io::ErrorKind::TimedOut);
        assert_eq!(error.to_string(), "silent for 10 s; it has no such device, but Head");
        assert_eq!(DeviceFault::from(error), fault);
        let ended = DeviceFault::from(io::Error::from(io::ErrorKind::UnexpectedEof));
        assert_eq!(ended, DeviceFault::System("unexpected end of file".to_owned()));
    }
}
