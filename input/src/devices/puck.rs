//! A SpaceMouse, read as raw HID if that is allowed, else through spacenavd's socket.

use std::ffi::CString;
use std::io;
use std::path::PathBuf;

use hidapi::{HidApi, HidDevice};

use super::fault::DeviceFault;
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
#[cfg(unix)]
use super::spnav_places::usual_places;
use crate::sample::SampleSource;

/// Vendor number of the older devices.
const LOGITECH: u16 = 0x046d;
/// Vendor number of the newer ones.
const CONNEXION: u16 = 0x256f;
/// Usage page and usage of a multi-axis controller.
const MULTI_AXIS: (u16, u16) = (1, 8);
/// Product numbers of mice, keyboards and numpads of the same makers.
const NOT_A_PUCK: [u16; 12] =
    [0xc62c, 0xc641, 0xc650, 0xc651, 0xc654, 0xc655, 0xc656, 0xc657, 0xc658, 0xc664, 0xc665, 0xc668];
/// Longest wait of one read of a single interface, milliseconds.
const READ_WAIT_MS: i32 = 100;
/// Length of the buffer, bytes, that of the longest report over USB.
const BUFFER: usize = 64;

/// Interface that may be that of a SpaceMouse.
pub(super) struct SpaceMouseInterface {
    pub(super) name: String,
    pub(super) path: CString,
}

impl SpaceMouseInterface {
    /// Opens the interface.
    ///
    /// # Errors
    /// The reason, with what to do.
    pub(super) fn open(&self, api: &HidApi) -> Result<HidDevice, DeviceFault> {
        api.open_path(&self.path).map_err(|error| DeviceFault::SpaceMouseForbidden {
            name: self.name.clone(),
            path: self.path.to_string_lossy().into_owned(),
            reason: error.to_string(),
        })
    }
}

/// All interfaces that may be that of a SpaceMouse.
pub(super) fn candidates(api: &HidApi) -> Vec<SpaceMouseInterface> {
    api.device_list()
        .filter(|device| [LOGITECH, CONNEXION].contains(&device.vendor_id()))
        .filter(|device| (device.usage_page(), device.usage()) == MULTI_AXIS)
        .filter(|device| !NOT_A_PUCK.contains(&device.product_id()))
        .map(|device| {
            let ids = (device.vendor_id(), device.product_id());
            let nameless = || format!("SpaceMouse {:04x}:{:04x}", ids.0, ids.1);
            let name = device.product_string().filter(|name| !name.is_empty()).map_or_else(nameless, str::to_owned);
            SpaceMouseInterface { name, path: device.path().to_owned() }
        })
        .collect()
}

/// Places where a SpaceMouse may be found.
pub(super) struct PuckPort {
    /// Socket of spacenavd; `None` for the usual places.
    socket: Option<PathBuf>,
}

impl PuckPort {
    pub(super) fn new(socket: Option<PathBuf>) -> Self {
        Self { socket }
    }

    #[cfg(unix)]
    fn through_daemon(&self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        super::socket::SpacenavdLink::connect(
            &self.socket.as_ref().map_or_else(usual_places, |socket| vec![socket.clone()]),
        )
    }

    #[cfg(not(unix))]
    fn through_daemon(&self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let place = self.socket.as_ref().map_or(String::new(), |socket| format!(" ({})", socket.display()));
        Err(DeviceFault::NeverSpacenavd(place))
    }
}

impl DevicePort for PuckPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let both = |raw, daemon| DeviceFault::Both(Box::new(raw), Box::new(daemon));
        open_raw().or_else(|raw| self.through_daemon().map_err(|daemon| both(raw, daemon)))
    }
}

/// Opens all interfaces that may be the right one: a wireless receiver has several, and only the first report tells
/// which.
fn open_raw() -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
    let api = HidApi::new().map_err(|error| DeviceFault::NoHidList(error.to_string()))?;
    let mut interfaces = Vec::new();
    let mut found = None;
    let mut why = DeviceFault::NoSpaceMouse;
    for candidate in candidates(&api) {
        match candidate.open(&api) {
            Ok(device) => {
                interfaces.push(device);
                found = Some(candidate);
            }
            Err(error) => why = error,
        }
    }
    let Some(SpaceMouseInterface { name, path }) = found else {
        return Err(why);
    };
    let place = OpenedDevice { source: SampleSource::SpaceMouse, name, path: path.to_string_lossy().into_owned() };
    Ok((place, Box::new(HidInterfaces { interfaces })))
}

/// Open interfaces; a single one after the first report.
struct HidInterfaces {
    interfaces: Vec<HidDevice>,
}

impl DeviceConnection for HidInterfaces {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        let wait_ms = READ_WAIT_MS / i32::try_from(self.interfaces.len().max(1)).unwrap_or(READ_WAIT_MS);
        let mut buffer = [0; BUFFER];
        let mut speaker = None;
        let mut gone = None;
        for (index, interface) in self.interfaces.iter().enumerate() {
            match interface.read_timeout(&mut buffer, wait_ms) {
                Ok(0) => {}
                Ok(length) => {
                    bytes.extend_from_slice(&buffer[..length]);
                    speaker = (buffer[0] == 1).then_some(index);
                    break;
                }
                Err(error) => gone = Some((index, error)),
            }
        }
        if let Some(index) = speaker {
            self.interfaces = vec![self.interfaces.swap_remove(index)];
        } else if let Some((index, error)) = gone {
            self.interfaces.swap_remove(index);
            if self.interfaces.is_empty() {
                return Err(io::Error::other(error));
            }
        }
        Ok(())
    }
}
