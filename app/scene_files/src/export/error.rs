//! Reasons why a scene cannot be written.

use std::path::PathBuf;

use scene::SceneFault;

/// Reason why a scene cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A file that the operating system cannot write.
    #[error("cannot write {path}: {error}; check the folder, its permissions and the space left")]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
    /// A scene without triangles, which glTF does not allow.
    #[error("scene \"{scene}\" has no triangles to write")]
    Nothing {
        /// Name of the scene.
        scene: String,
    },
    /// A scene that breaks a promise of its types.
    #[error(transparent)]
    Damaged(#[from] SceneFault),
    /// A value that glTF cannot express.
    #[error("glTF cannot express {what} of \"{name}\": {fault}")]
    Value {
        /// Name of the property.
        what: &'static str,
        /// Name of its mesh, material or scene.
        name: String,
        /// Reason why it cannot be expressed.
        fault: &'static str,
    },
    /// A file beyond 4 GiB: a `.glb` counts bytes with 32 bits.
    #[error("{path} would have {bytes} bytes, and a .glb holds {} at most; write fewer meshes at a time", u32::MAX)]
    TooLarge {
        /// Path of the file.
        path: PathBuf,
        /// Size of the file, bytes.
        bytes: u64,
    },
}
