//! What is plugged in, whether it is used or not.

use hidapi::HidApi;

use super::puck::candidates;
use super::serial;
use crate::sample::SampleSource;

/// A device that the machine has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PluggedDevice {
    /// What could read it.
    pub source: SampleSource,
    /// What it calls itself.
    pub name: String,
    /// Where it is.
    pub path: String,
    /// Why it may not be read, and what to do; `None` if it may, or if only use would tell.
    pub refused: Option<String>,
}

/// Every device of the machine that could be used: serial ports, SpaceMice, gamepads.
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
