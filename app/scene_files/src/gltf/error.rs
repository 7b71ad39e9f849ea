//! Reasons why a file gives no scene.

use panoramas::PanoramaError;
use regular_file::OverBudget;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reason why a file gives no scene. Every message says what is wrong, where, and what to do.
#[derive(Clone, Debug, thiserror::Error)]
pub enum GltfError {
    /// A file that the operating system cannot read.
    #[error("cannot read {path}: {error}; check the name and the permissions")]
    Read {
        /// Path of the scene or of a file it refers to.
        path: PathBuf,
        /// Error of the operating system.
        error: Arc<std::io::Error>,
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
    /// A scene that needs more memory than it may take.
    #[error("{path} is too large at {place}: {fault}")]
    OverBudget {
        /// Path of the scene or of a file it refers to.
        path: PathBuf,
        /// Place of the excess in its JSON.
        place: String,
        /// Memory that was asked for, and the limit.
        fault: OverBudget,
    },
    /// A scene without triangles.
    #[error("{}", nothing(path, found, fault.as_deref()))]
    Nothing {
        /// Path of the scene.
        path: PathBuf,
        /// Objects found instead of triangles.
        found: &'static str,
        /// First part that is left out, with its place.
        fault: Option<String>,
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
    Panorama(Arc<PanoramaError>),
}

impl From<PanoramaError> for GltfError {
    fn from(error: PanoramaError) -> Self {
        Self::Panorama(Arc::new(error))
    }
}

impl GltfError {
    /// Fault of a part that can be left out, with its place.
    ///
    /// # Errors
    /// The error itself, if the scene is too large: leaving a part out would hide it.
    pub(super) fn part_fault(self) -> Result<String, Self> {
        match self {
            Self::Damaged { place, fault, .. } => Ok(format!("{place}: {fault}")),
            Self::Read { path, error } => Ok(format!("{}: {error}", path.display())),
            Self::NotAFile { path } => Ok(format!("{} is not a file", path.display())),
            too_large => Err(too_large),
        }
    }
}

fn sentences(path: &Path, faults: &[SpectrumFault]) -> String {
    let sentence = |fault| format!("{} has a spectrum that cannot be used: {fault}", path.display());
    faults.iter().map(sentence).collect::<Vec<_>>().join("\n")
}

fn nothing(path: &Path, found: &str, fault: Option<&str>) -> String {
    let path = path.display();
    match fault {
        None => format!("{path} has nothing to draw: no triangles in its scene; export meshes, not only {found}"),
        Some(fault) => format!(
            "{path} has nothing to draw, as a part is missing or faulty: {fault}; put missing files beside the scene, \
             or export it again"
        ),
    }
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
