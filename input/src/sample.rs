//! Samples: the bytes of a device, with their time.
//!
//! A [`Sample`] is the only thing that may influence a ride: raw bytes as they came, a time stamp, and the device.
//! All that is decoded from samples is a pure function of them, so a recording of samples and frame times replays to
//! the same bits. The switches of the interface pass as samples, too ([`SampleSource::Settings`]).

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::clock::Nanos;
use crate::head::mouse_event::MouseEvent;
use crate::key::KeyboardKey;

/// Device of a sample, which decides the decoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SampleSource {
    /// Keys of the window: [`crate::keyboard`].
    Keyboard,
    /// A gamepad or joystick: [`crate::gamepad`].
    Gamepad,
    /// A SpaceMouse read as raw HID reports: [`crate::spacemouse`].
    SpaceMouse,
    /// A SpaceMouse read through the spacenavd daemon: [`crate::spacenavd`].
    Spacenavd,
    /// An instrumented bicycle on a serial port: [`crate::bicycle`].
    Bicycle,
    /// A motor-braked trainer over the network: [`crate::trainer`].
    Trainer,
    /// A tracker through a VRPN server: [`crate::vrpn`].
    Vrpn,
    /// A tracker of ART: [`crate::dtrack`].
    Dtrack,
    /// A head that opentrack follows: [`crate::opentrack`].
    Opentrack,
    /// A headset through an OpenXR runtime: [`crate::openxr`].
    Openxr,
    /// The mouse in the window: it moves the head ([`crate::head::MouseDecoder`]) or turns the look
    /// ([`crate::LookDecoder`]).
    Mouse,
    /// The program's own interface: [`crate::settings`].
    Settings,
}

impl SampleSource {
    /// All sources, in the order of the listing.
    pub const ALL: [Self; 12] = [
        Self::Keyboard,
        Self::Gamepad,
        Self::SpaceMouse,
        Self::Spacenavd,
        Self::Bicycle,
        Self::Trainer,
        Self::Vrpn,
        Self::Dtrack,
        Self::Opentrack,
        Self::Openxr,
        Self::Mouse,
        Self::Settings,
    ];

    /// Name in recordings and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Keyboard => "keyboard",
            Self::Gamepad => "gamepad",
            Self::SpaceMouse => "space_mouse",
            Self::Spacenavd => "spacenavd",
            Self::Bicycle => "bicycle",
            Self::Trainer => "trainer",
            Self::Vrpn => "vrpn",
            Self::Dtrack => "dtrack",
            Self::Opentrack => "opentrack",
            Self::Openxr => "openxr",
            Self::Mouse => "mouse",
            Self::Settings => "settings",
        }
    }
}

impl fmt::Display for SampleSource {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

/// Signal of a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Signal {
    /// The device was plugged in, or the connection stands again: nothing earlier holds any more.
    Opened,
    /// Bytes in the device's own format, cut wherever the transport cut them.
    Bytes(Box<[u8]>),
    /// The device is gone: everything that it held is released.
    Closed,
}

/// Signal of one device at one time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sample {
    /// Time of arrival at this machine.
    pub at: Nanos,
    /// Device that sent the signal.
    pub source: SampleSource,
    /// Signal of the device.
    pub signal: Signal,
}

impl Sample {
    /// Sample of a device that has just been opened.
    pub fn opened(at: Nanos, source: SampleSource) -> Self {
        Self { at, source, signal: Signal::Opened }
    }

    /// Sample of bytes from a device.
    pub fn bytes(at: Nanos, source: SampleSource, bytes: impl Into<Box<[u8]>>) -> Self {
        Self { at, source, signal: Signal::Bytes(bytes.into()) }
    }

    /// Sample of a device that has gone. For the keyboard: the window lost the focus.
    pub fn closed(at: Nanos, source: SampleSource) -> Self {
        Self { at, source, signal: Signal::Closed }
    }

    /// Sample of a key of the window, pressed or released.
    pub fn key(at: Nanos, key: KeyboardKey, pressed: bool) -> Self {
        Self::bytes(at, SampleSource::Keyboard, key.to_bytes(pressed))
    }

    /// Sample of the window's mouse.
    pub fn mouse(at: Nanos, event: MouseEvent) -> Self {
        Self::bytes(at, SampleSource::Mouse, event.to_bytes())
    }

    /// Sample of an action of the interface.
    pub fn action(at: Nanos, action: &Action) -> Self {
        Self::bytes(at, SampleSource::Settings, action.to_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_the_serialised_names() {
        for source in SampleSource::ALL {
            assert_eq!(serde_json::to_value(source).unwrap(), source.name());
        }
    }
}
