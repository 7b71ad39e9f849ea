//! Decoding of pictures of all directions, in any layout, to equirectangular panoramas.

use regular_file::Budget;
use std::path::Path;

use super::error::{MAX_WIDTH, PanoramaError};
use super::intake::PictureIntake;
use super::kind::PictureKind;
use super::{common, open_exr, radiance};
use scene::Panorama;

/// Panorama that was read, and what is to be said of it.
#[derive(Debug)]
pub struct PanoramaRead {
    /// Panorama, equirectangular.
    pub panorama: Panorama,
    /// Kind of the file, and layout of the picture in it.
    pub description: String,
    /// Changes that were needed, a sentence each.
    pub notices: Vec<String>,
}

/// Decodes a picture of any of the kinds and layouts. `path` is for messages. The memory of the panorama stays taken
/// from the budget.
///
/// # Errors
/// [`PanoramaError`].
pub fn decode(bytes: &[u8], path: &Path, budget: &Budget) -> Result<PanoramaRead, PanoramaError> {
    decode_up_to(MAX_WIDTH, bytes, path, budget)
}

/// Decodes a picture to a panorama that is not wider than `max_width`.
pub(super) fn decode_up_to(
    max_width: u32,
    bytes: &[u8],
    path: &Path,
    budget: &Budget,
) -> Result<PanoramaRead, PanoramaError> {
    let kind = PictureKind::of(bytes).ok_or_else(|| PanoramaError::Format { path: path.into() })?;
    let mut intake = PictureIntake { path, max_width, budget, notices: Vec::new() };
    let (panorama, layout) = match kind {
        PictureKind::Common(format) => common::read(bytes, format, &mut intake)?,
        PictureKind::Radiance => radiance::read(bytes, &mut intake)?,
        PictureKind::OpenExr => open_exr::read(bytes, &mut intake)?,
    };
    Ok(PanoramaRead { panorama, description: format!("{kind}, {layout}"), notices: intake.notices })
}
