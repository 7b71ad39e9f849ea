//! Formats of display files, told apart by the ending of the file's name.

use std::path::Path;

/// Endings of display files, for messages.
pub const FILE_ENDINGS: &str = ".toml, .pvx, .mpcdi, .mpcdi.xml, .ndisplay";

/// Format of a display's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DisplayFormat {
    /// Display file of this program, `.toml`.
    Toml,
    /// Walls of ParaView, `.pvx`.
    Pvx,
    /// Projector calibration, `.mpcdi` or `.mpcdi.xml`.
    Mpcdi,
    /// Cluster of Unreal Engine, `.ndisplay`.
    NDisplay,
}

impl DisplayFormat {
    /// Format by the ending of a file's name; `None` if it is not that of a display's file.
    pub fn of(path: &Path) -> Option<Self> {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        // The description of a container that has been unpacked is called mpcdi.xml.
        if name.ends_with(".mpcdi") || name.ends_with(".mpcdi.xml") || name == "mpcdi.xml" {
            return Some(Self::Mpcdi);
        }
        match path.extension()?.to_string_lossy().to_ascii_lowercase().as_str() {
            "toml" => Some(Self::Toml),
            "pvx" => Some(Self::Pvx),
            "ndisplay" => Some(Self::NDisplay),
            _ => None,
        }
    }
}
