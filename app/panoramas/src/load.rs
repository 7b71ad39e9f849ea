//! Pictures as scenes without meshes.

use regular_file::{Budget, FileFault};
use std::io::Read;
use std::path::Path;

use super::decode::{PanoramaRead, decode};
use super::error::PanoramaError;
use super::kind::PictureKind;
use scene::{Lighting, Scene};

/// File name endings of pictures.
const ENDINGS: [&str; 10] = ["png", "jpg", "jpeg", "webp", "tif", "tiff", "hdr", "pic", "rgbe", "exr"];

/// True if a file is a picture, judged by its name.
pub fn is_picture(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

/// Loads a picture as a scene without meshes: the observer is in its middle and looks at the middle of the picture.
/// The file, too, is taken from the budget, as long as it is read.
///
/// # Errors
/// [`PanoramaError`].
pub fn load(path: &Path, budget: &Budget) -> Result<Scene, PanoramaError> {
    Ok(load_described(path, budget)?.0)
}

/// Scene of a picture, with a description of the file: its kind, and the layout of the picture.
pub fn load_described(path: &Path, budget: &Budget) -> Result<(Scene, String), PanoramaError> {
    let fault = |fault| match fault {
        FileFault::System(error) => PanoramaError::Read { path: path.into(), error },
        FileFault::NotAFile => PanoramaError::Format { path: path.into() },
        FileFault::TooLarge { .. } => PanoramaError::Damaged { path: path.into(), fault: format!("{fault}") },
    };
    let system = |error| PanoramaError::Read { path: path.into(), error };

    // Look at the kind and the size before reading the file.
    let file = regular_file::open(path).map_err(fault)?;
    let length = file.metadata().map_err(system)?.len();
    let mut first = Vec::new();
    file.take(64).read_to_end(&mut first).map_err(system)?;
    if PictureKind::of(&first).is_none() {
        return Err(PanoramaError::Format { path: path.into() });
    }
    budget.take(length).map_err(|fault| PanoramaError::TooLarge { path: path.into(), fault })?;
    let bytes = regular_file::read(path, length).map_err(fault)?;

    let PanoramaRead { panorama, description, notices } = decode(&bytes, path, budget)?;
    drop(bytes);
    budget.give_back(length);
    let scene = Scene {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        panorama: Some(panorama),
        light: Lighting { shadows: false, ..Lighting::default() },
        notices,
        ..Scene::default()
    };
    Ok((scene, description))
}
