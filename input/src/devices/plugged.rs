//! Devices of the machine, used or not.

use hidapi::HidApi;

use super::fault::DeviceFault;
use super::puck::candidates;
use super::serial;
use crate::sample::SampleSource;

/// Device that is plugged in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PluggedDevice {
    /// Decoder that could read the device.
    pub source: SampleSource,
    /// Name that the device gives itself.
    pub name: String,
    /// Path of the device.
    pub path: String,
    /// Reason why it may not be read, and what to do; `None` if it may, or if only an attempt would tell.
    pub refused: Option<DeviceFault>,
}

/// All devices of the machine that could be used: serial ports, SpaceMice, gamepads.
pub fn plugged_in() -> Vec<PluggedDevice> {
    let mut plugged: Vec<PluggedDevice> = serial::ports()
        .into_iter()
        .map(|(path, name)| PluggedDevice { source: SampleSource::Bicycle, name, path, refused: None })
        .collect();
    if let Ok(api) = HidApi::new() {
        plugged.extend(candidates(&api).into_iter().map(|candidate| {
            let refused = candidate.open(&api).err();
            let path = candidate.path.to_string_lossy().into_owned();
            PluggedDevice { source: SampleSource::SpaceMouse, name: candidate.name, path, refused }
        }));
    }
    #[cfg(target_os = "linux")]
    plugged.extend(super::pad::pads().into_iter().map(|(path, device)| PluggedDevice {
        source: SampleSource::Gamepad,
        name: super::pad::name(&device),
        path: path.display().to_string(),
        refused: None,
    }));
    plugged
}
