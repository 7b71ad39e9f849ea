//! Reasons why a path cannot be flown.

use regular_file::FileFault;
use std::path::PathBuf;
use thiserror::Error;

/// Reason why a camera cannot fly along a path.
#[derive(Debug, Error)]
pub enum CameraPathError {
    /// A file that cannot be read.
    #[error("{}: {fault}", path.display())]
    File {
        /// File of the path.
        path: PathBuf,
        /// Reason.
        fault: FileFault,
    },
    /// Bytes that are no text.
    #[error("{name}: it is no UTF-8 text; save it as a text file")]
    NoText {
        /// File of the path.
        name: String,
    },
    /// A key or a value that is not understood.
    #[error("{name}, line {line}: {fault}")]
    Line {
        /// File of the path.
        name: String,
        /// Line in the file, from 1.
        line: usize,
        /// Description, with the key and what to do.
        fault: String,
    },
    /// A camera that would be as fast as light.
    #[error(
        "{name}: {place} the camera moves at {speed_m_s:.4} m/s, and light at {light_m_s:.4} m/s; give it more time or a \
         shorter way, or make light faster"
    )]
    TooFast {
        /// File of the path, or name of the camera.
        name: String,
        /// Part, and key or circle, where the camera is too fast.
        place: String,
        /// Speed there, m/s.
        speed_m_s: f64,
        /// Speed of light, m/s.
        light_m_s: f64,
    },
    /// A thrust that leads beyond what can be computed.
    #[error(
        "{name}: {place} leads to a rapidity of {rapidity:.1}, and at most {most} can be shown; thrust less or shorter"
    )]
    Rapidity {
        /// File of the path.
        name: String,
        /// Part and leg.
        place: String,
        /// Rapidity at the leg's end.
        rapidity: f64,
        /// Largest rapidity.
        most: f64,
    },
    /// A speed of light that is none.
    #[error("{name}: light at {light_m_s} m/s is no speed of light; expected a number above 0")]
    Light {
        /// File of the path, or name of the camera.
        name: String,
        /// Speed that was given, m/s.
        light_m_s: f64,
    },
    /// A camera that is not animated.
    #[error("the camera \"{name}\" of the scene is not animated; animate its node, or write a path file")]
    NotAnimated {
        /// Name of the camera.
        name: String,
    },
    /// Scenes of another number than the path has parts.
    #[error("{name}: the path has {parts} parts, and {given} scenes were given for them")]
    Scenes {
        /// File of the path.
        name: String,
        /// Number of parts.
        parts: usize,
        /// Number of scenes.
        given: usize,
    },
}
