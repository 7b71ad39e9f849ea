//! Reasons why a file gives no scene.

use crate::panorama::PanoramaError;
use std::fmt;
use std::path::{Path, PathBuf};

/// Why a file gives no scene. Every message says what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum GltfError {
    /// The operating system refuses.
    #[error("cannot read {path}: {error}; check the name and the permissions")]
    Read {
        /// The scene or a file it refers to.
        path: PathBuf,
        /// What the system says.
        error: std::io::Error,
    },
    /// A directory or a device.
    #[error("{path} is not a file; name a .gltf or .glb file")]
    NotAFile {
        /// The scene or a file it refers to.
        path: PathBuf,
    },
    /// Nothing in it.
    #[error("{path} is empty; export or download it again")]
    Empty {
        /// The scene.
        path: PathBuf,
    },
    /// Not this format, or another version of it.
    #[error("{path} is not glTF 2.0: {fault}; export the scene as .glb or .gltf")]
    NotGltf {
        /// The scene.
        path: PathBuf,
        /// What is wrong.
        fault: String,
    },
    /// The file cannot be shown without something that this program lacks.
    #[error("{path} requires the extension {name}, which this program does not know; export the scene without it")]
    Extension {
        /// The scene.
        path: PathBuf,
        /// As in `extensionsRequired`.
        name: String,
    },
    /// The file contradicts itself or the format.
    #[error("{path} is damaged at {place}: {fault}; export the scene again")]
    Damaged {
        /// The scene.
        path: PathBuf,
        /// Where in its JSON.
        place: String,
        /// What is wrong.
        fault: String,
    },
    /// More than this program takes.
    #[error("{path} is too large at {place}: {fault}; export a smaller part or a coarser version of the scene")]
    TooLarge {
        /// The scene.
        path: PathBuf,
        /// Where in its JSON.
        place: String,
        /// What is too large, and the limit.
        fault: String,
    },
    /// No triangles.
    #[error("{path} has nothing to draw: no triangles in its scene; export meshes, not only {found}")]
    Nothing {
        /// The scene.
        path: PathBuf,
        /// What there is instead.
        found: &'static str,
    },
    /// Spectra that are none: a sentence for each.
    #[error("{}", sentences(path, faults))]
    Spectra {
        /// The scene.
        path: PathBuf,
        /// All that are wrong, in the file's order.
        faults: Vec<SpectrumFault>,
    },
    /// A panorama that is none.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
}

fn sentences(path: &Path, faults: &[SpectrumFault]) -> String {
    let sentence = |fault| format!("{} has a spectrum that cannot be used: {fault}", path.display());
    faults.iter().map(sentence).collect::<Vec<_>>().join("\n")
}

/// What is wrong with one spectrum of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpectrumFault {
    /// The material, light, node or scene, as it is numbered and called in the file.
    pub owner: String,
    /// Keys from there to what is wrong, with dots between them.
    pub key: String,
    /// What is wrong, and what was expected.
    pub fault: String,
}

impl fmt::Display for SpectrumFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}: {}", self.owner, self.key, self.fault)
    }
}
