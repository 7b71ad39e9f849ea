//! Reasons why a file gives no scene.

use crate::panorama::PanoramaError;
use std::fmt;
use std::path::{Path, PathBuf};

/// Reason why a file gives no scene. Every message says what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum GltfError {
    /// A file that the operating system cannot read.
    #[error("cannot read {path}: {error}; check the name and the permissions")]
    Read {
        /// Path of the scene or of a file it refers to.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
    /// A directory or a device.
    #[error("{path} is not a file; name a .gltf or .glb file")]
    NotAFile {
        /// Path of the scene or of a file it refers to.
        path: PathBuf,
    },
    /// An empty file.
    #[error("{path} is empty; export or download it again")]
    Empty {
        /// Path of the scene.
        path: PathBuf,
    },
    /// A file of another format, or of another version of glTF.
    #[error("{path} is not glTF 2.0: {fault}; export the scene as .glb or .gltf")]
    NotGltf {
        /// Path of the scene.
        path: PathBuf,
        /// Description of what is wrong.
        fault: String,
    },
    /// A required extension that this program lacks.
    #[error("{path} requires the extension {name}, which this program does not know; export the scene without it")]
    Extension {
        /// Path of the scene.
        path: PathBuf,
        /// Name of the extension, as in `extensionsRequired`.
        name: String,
    },
    /// A file that contradicts itself or the format.
    #[error("{path} is damaged at {place}: {fault}; export the scene again")]
    Damaged {
        /// Path of the scene.
        path: PathBuf,
        /// Place of the excess in its JSON.
        place: String,
        /// Description of what is wrong.
        fault: String,
    },
    /// A scene beyond the limits of this program.
    #[error("{path} is too large at {place}: {fault}; export a smaller part or a coarser version of the scene")]
    TooLarge {
        /// Path of the scene.
        path: PathBuf,
        /// Place of the excess in its JSON.
        place: String,
        /// Description of what is too large, and the limit.
        fault: String,
    },
    /// A scene without triangles.
    #[error("{path} has nothing to draw: no triangles in its scene; export meshes, not only {found}")]
    Nothing {
        /// Path of the scene.
        path: PathBuf,
        /// Objects found instead of triangles.
        found: &'static str,
    },
    /// Spectra that are not valid, with a sentence for each.
    #[error("{}", sentences(path, faults))]
    Spectra {
        /// Path of the scene.
        path: PathBuf,
        /// Faults of all invalid spectra, in the file's order.
        faults: Vec<SpectrumFault>,
    },
    /// A panorama that cannot be used.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
}

fn sentences(path: &Path, faults: &[SpectrumFault]) -> String {
    let sentence = |fault| format!("{} has a spectrum that cannot be used: {fault}", path.display());
    faults.iter().map(sentence).collect::<Vec<_>>().join("\n")
}

/// Fault of one spectrum of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpectrumFault {
    /// Material, light, node or scene of the spectrum, with its number and name in the file.
    pub owner: String,
    /// Path of keys from the owner to the fault, joined by dots.
    pub key: String,
    /// Description of what is wrong, and what was expected.
    pub fault: String,
}

impl fmt::Display for SpectrumFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}: {}", self.owner, self.key, self.fault)
    }
}
