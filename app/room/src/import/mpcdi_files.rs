//! Files of an MPCDI container: a zip with the description and the maps it names, or a bare description with the maps
//! beside it.

use crate::read;
use regular_file::Budget;
use std::collections::HashMap;
use std::io::{Cursor, Read};
use std::path::Path;

/// Source of the description and the maps.
pub(super) enum MpcdiFiles<'a> {
    /// A container, and the position of each of its files by its name in lower case.
    Zip {
        /// The container.
        archive: Box<zip::ZipArchive<Cursor<Vec<u8>>>>,
        /// Positions of the files.
        positions: HashMap<String, usize>,
    },
    /// A description, and the folder of its maps.
    Bare {
        /// Description.
        xml: Vec<u8>,
        /// Folder of the description.
        folder: &'a Path,
    },
}

impl<'a> MpcdiFiles<'a> {
    /// Opens a container or a bare description. An error's text is worded to follow the file's name.
    pub fn open(bytes: Vec<u8>, folder: &'a Path) -> Result<Self, String> {
        if !bytes.starts_with(b"PK") {
            return Ok(Self::Bare { xml: bytes, folder });
        }
        let archive =
            zip::ZipArchive::new(Cursor::new(bytes)).map_err(|error| format!("it is no good zip: {error}"))?;
        let mut positions = HashMap::new();
        for (position, name) in archive.file_names().enumerate() {
            if let Ok(name) = name {
                positions.entry(plain(&name)).or_insert(position);
            }
        }
        Ok(Self::Zip { archive: Box::new(archive), positions })
    }

    /// Description of the display.
    pub fn description(&mut self, budget: &Budget) -> Result<Vec<u8>, String> {
        match self {
            Self::Bare { xml, .. } => Ok(std::mem::take(xml)),
            Self::Zip { .. } => self.read("mpcdi.xml", budget),
        }
    }

    /// Contents of a file by its name, in upper or lower case, with slashes of any system. The budget pays for them
    /// before they are unpacked.
    pub fn read(&mut self, name: &str, budget: &Budget) -> Result<Vec<u8>, String> {
        match self {
            Self::Bare { folder, .. } => {
                // A bare description may name only files in its own folder.
                if Path::new(name).components().count() != 1 || Path::new(name).file_name().is_none() {
                    return Err(format!("{name:?} is not beside it"));
                }
                read::bytes(&folder.join(name), budget).map_err(|reason| format!("{name:?} {reason}"))
            }
            Self::Zip { archive, positions } => {
                let position = positions.get(&plain(name));
                let position = *position.ok_or_else(|| format!("there is no {name:?} in it"))?;
                let wrong = |error: &dyn std::fmt::Display| format!("{name:?} cannot be unpacked: {error}");
                let file = archive.by_index(position).map_err(|error| wrong(&error))?;
                let claimed = file.size();
                budget.take(claimed).map_err(|error| wrong(&error))?;
                let mut bytes = Vec::new();
                file.take(claimed.saturating_add(1)).read_to_end(&mut bytes).map_err(|error| wrong(&error))?;
                if bytes.len() as u64 > claimed {
                    return Err(wrong(&format!("it is larger than the {claimed} bytes that it claims")));
                }
                Ok(bytes)
            }
        }
    }
}

/// Name of a file in a container, in lower case and with the slashes of a zip.
fn plain(name: &str) -> String {
    let name = name.to_lowercase().replace('\\', "/");
    name.strip_prefix("./").unwrap_or(&name).to_owned()
}
