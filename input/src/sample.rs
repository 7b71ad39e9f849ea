//! What a device said, and when.
//!
//! A [`Sample`] is the only thing that may influence a ride: raw bytes as they came, a time stamp,
//! and which device spoke. Whatever is decoded from samples is a pure function of them, so a
//! recording of samples and frame times replays to the same bits. Even the switches of the
//! interface pass as samples ([`SampleSource::Settings`]).

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::clock::Nanos;
use crate::head::mouse_event::MouseEvent;
use crate::key::KeyboardKey;

/// Which device a sample comes from, and so which decoder reads its bytes.
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
    /// A tracker through a VRPN server: [`crate::vrpn`].
    Vrpn,
    /// A tracker of ART: [`crate::dtrack`].
    Dtrack,
    /// The mouse in the window, where it moves the head: [`crate::head::MouseDecoder`].
    Mouse,
    /// The program's own interface: [`crate::settings`].
    Settings,
}

impl SampleSource {
    /// Every source, in the order of the listing.
    pub const ALL: [Self; 9] = [
        Self::Keyboard,
        Self::Gamepad,
        Self::SpaceMouse,
        Self::Spacenavd,
        Self::Bicycle,
        Self::Vrpn,
        Self::Dtrack,
        Self::Mouse,
        Self::Settings,
    ];

    /// The name in recordings and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Keyboard => "keyboard",
            Self::Gamepad => "gamepad",
            Self::SpaceMouse => "space_mouse",
            Self::Spacenavd => "spacenavd",
            Self::Bicycle => "bicycle",
            Self::Vrpn => "vrpn",
            Self::Dtrack => "dtrack",
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

/// What happened on a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Signal {
    /// It was plugged in, or the connection stands again: nothing earlier holds any more.
    Opened,
    /// Bytes arrived, in the device's own format, cut wherever the transport cut them.
    Bytes(Box<[u8]>),
    /// It is gone: everything it held is released.
    Closed,
}

/// One thing one device said at one time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sample {
    /// When it arrived at this machine.
    pub at: Nanos,
    /// Who said it.
    pub source: SampleSource,
    /// What it said.
    pub signal: Signal,
}

impl Sample {
    /// A device that has just been opened.
    pub fn opened(at: Nanos, source: SampleSource) -> Self {
        Self { at, source, signal: Signal::Opened }
    }

    /// Bytes from a device.
    pub fn bytes(at: Nanos, source: SampleSource, bytes: impl Into<Box<[u8]>>) -> Self {
        Self { at, source, signal: Signal::Bytes(bytes.into()) }
    }

    /// A device that has gone. For the keyboard: the window lost the focus.
    pub fn closed(at: Nanos, source: SampleSource) -> Self {
        Self { at, source, signal: Signal::Closed }
    }

    /// A key of the window pressed or released.
    pub fn key(at: Nanos, key: KeyboardKey, pressed: bool) -> Self {
        Self::bytes(at, SampleSource::Keyboard, key.to_bytes(pressed))
    }

    /// The mouse of the window, where it moves the head.
    pub fn mouse(at: Nanos, event: MouseEvent) -> Self {
        Self::bytes(at, SampleSource::Mouse, event.to_bytes())
    }

    /// A switch of the interface.
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
