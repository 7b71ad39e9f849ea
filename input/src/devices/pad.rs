//! A gamepad or joystick through Linux's evdev.

use std::io;
use std::path::{Path, PathBuf};

use evdev::{AbsoluteAxisCode, Device, KeyCode};
use rustix::event::{PollFd, PollFlags, Timespec, poll};

use super::fault::DeviceFault;
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use crate::gamepad::GamepadItem;
use crate::gamepad_codes as codes;
use crate::sample::SampleSource;

/// Longest wait of a read: a tenth of a second.
const READ_WAIT: Timespec = Timespec { tv_sec: 0, tv_nsec: 100_000_000 };
/// Directory in which the system names joysticks, also those that may not be read.
const NAMES: &str = "/dev/input/by-id";

/// Search for a pad.
pub(super) struct PadPort;

impl DevicePort for PadPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let (path, device) = pads().into_iter().next().ok_or_else(|| match unreadable() {
            Some(path) => DeviceFault::GamepadForbidden(path.display().to_string()),
            None => DeviceFault::NoGamepad,
        })?;
        let place =
            OpenedDevice { source: SampleSource::Gamepad, name: name(&device), path: path.display().to_string() };
        Ok((place, Box::new(EvdevPad { device, report_all: true })))
    }
}

/// Name that a pad gives itself.
pub(super) fn name(device: &Device) -> String {
    device.name().unwrap_or("gamepad").to_owned()
}

/// All pads that may be read, in a fixed order.
pub(super) fn pads() -> Vec<(PathBuf, Device)> {
    let mut pads: Vec<_> = evdev::enumerate().filter(|(_, device)| layout(device).is_some()).collect();
    pads.sort_by(|(a, _), (b, _)| a.cmp(b));
    pads
}

/// Path of a joystick that is there but may not be read.
fn unreadable() -> Option<PathBuf> {
    let names = Path::new(NAMES).read_dir().ok()?;
    names
        .flatten()
        .map(|entry| entry.path())
        .find(|path| path.to_string_lossy().ends_with("-event-joystick") && std::fs::File::open(path).is_err())
}

/// Layout of a device as gamepad or joystick; `None` for other devices.
fn layout(device: &Device) -> Option<GamepadItem> {
    let has_stick = device.supported_absolute_axes()?.contains(AbsoluteAxisCode::ABS_X);
    let buttons = device.supported_keys()?;
    if has_stick && buttons.contains(KeyCode(codes::SOUTH)) {
        Some(GamepadItem::Gamepad)
    } else if has_stick && buttons.contains(KeyCode(codes::TRIGGER)) {
        Some(GamepadItem::Joystick)
    } else {
        None
    }
}

/// Open gamepad or joystick.
struct EvdevPad {
    device: Device,
    report_all: bool,
}

impl EvdevPad {
    /// Writes the layout, every axis and every held button.
    fn describe(&self, bytes: &mut Vec<u8>) -> io::Result<()> {
        if let Some(layout) = layout(&self.device) {
            layout.encode(bytes);
        }
        for (axis, info) in self.device.get_absinfo()? {
            let item =
                GamepadItem::Axis { code: axis.0, value: info.value(), least: info.minimum(), most: info.maximum() };
            item.encode(bytes);
        }
        for key in self.device.get_key_state()?.iter() {
            GamepadItem::Event { kind: codes::KEY, code: key.0, value: 1 }.encode(bytes);
        }
        Ok(())
    }
}

impl DeviceConnection for EvdevPad {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        if std::mem::take(&mut self.report_all) {
            return self.describe(bytes);
        }
        let mut waiting = [PollFd::new(&self.device, PollFlags::IN)];
        match poll(&mut waiting, Some(&READ_WAIT)) {
            Ok(0) | Err(rustix::io::Errno::INTR) => return Ok(()),
            Ok(_) => {}
            Err(error) => return Err(error.into()),
        }
        for event in self.device.fetch_events()? {
            let item = GamepadItem::Event { kind: event.event_type().0, code: event.code(), value: event.value() };
            item.encode(bytes);
        }
        Ok(())
    }

    fn report_all(&mut self) {
        self.report_all = true;
    }
}
