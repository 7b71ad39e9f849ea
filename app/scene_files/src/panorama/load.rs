//! Pictures as scenes without meshes.

use regular_file::FileFault;
use std::path::Path;

use super::decode::decode;
use super::error::PanoramaError;
use scene::{Lighting, Scene};

/// Largest file that is read, bytes.
const MAX_FILE: u64 = 4 << 30;

/// File name endings of pictures.
const ENDINGS: [&str; 5] = ["png", "jpg", "jpeg", "hdr", "exr"];

/// True if a file is a picture, judged by its name.
pub fn is_picture(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

/// Loads a picture as a scene without meshes: the observer is in its middle and looks at the middle of the picture.
///
/// # Errors
/// [`PanoramaError`].
pub fn load(path: &Path) -> Result<Scene, PanoramaError> {
    let bytes = regular_file::read(path, MAX_FILE).map_err(|fault| match fault {
        FileFault::System(error) => PanoramaError::Read { path: path.into(), error },
        FileFault::NotAFile => PanoramaError::Format { path: path.into() },
        FileFault::TooLarge { .. } => PanoramaError::Damaged { path: path.into(), fault: fault.to_string() },
    })?;
    let mut notices = Vec::new();
    let panorama = decode(&bytes, path, |notice| notices.push(notice))?;
    Ok(Scene {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        panorama: Some(panorama),
        light: Lighting { shadows: false, ..Lighting::default() },
        notices,
        ..Scene::default()
    })
}
