//! Intake of a picture: all that its reader needs besides the bytes, and the way from its pixels to a panorama.

use regular_file::Budget;
use std::path::Path;
use std::sync::Arc;

use super::canvas::PanoramaCanvas;
use super::error::PanoramaError;
use super::shape::PanoramaShape;
use super::turn::PictureTurn;
use scene::Panorama;

/// Largest part of a picture that is unpacked at a time, bytes.
pub(super) const BAND_BYTES: usize = 32 << 20;

/// Intake of one picture.
pub(super) struct PictureIntake<'a> {
    /// Path of the picture, for messages.
    pub(super) path: &'a Path,
    /// Largest width of the panorama, pixels.
    pub(super) max_width: u32,
    /// Memory that the picture may take.
    pub(super) budget: &'a Budget,
    /// Sentences on what was changed.
    pub(super) notices: Vec<String>,
}

/// Picture whose pixels are being read.
pub(super) struct PictureInWork {
    /// Canvas for its pixels, in the order in which they are stored.
    pub(super) canvas: PanoramaCanvas,
    stored: [u32; 2],
    kept: [u32; 2],
    shape: PanoramaShape,
    turn: PictureTurn,
}

impl PictureIntake<'_> {
    /// Takes memory from the budget.
    pub(super) fn take(&self, bytes: u64) -> Result<(), PanoramaError> {
        self.budget.take(bytes).map_err(|fault| PanoramaError::TooLarge { path: self.path.into(), fault })
    }

    /// Error for a picture that cannot be decoded.
    pub(super) fn damaged(&self, fault: impl ToString) -> PanoramaError {
        PanoramaError::Damaged { path: self.path.into(), fault: fault.to_string() }
    }

    /// Layout of a picture of this size.
    pub(super) fn shape(&self, size: [u32; 2]) -> Result<PanoramaShape, PanoramaError> {
        let [width, height] = size;
        PanoramaShape::of(size).ok_or_else(|| PanoramaError::Shape { path: self.path.into(), width, height })
    }

    /// Canvas for a picture of this size, as it is stored; the layout is that of the shown picture.
    pub(super) fn begin(
        &self,
        stored: [u32; 2],
        shape: PanoramaShape,
        turn: PictureTurn,
    ) -> Result<PictureInWork, PanoramaError> {
        let kept = turn.size(shape.reduced(turn.size(stored), self.max_width));
        self.take(PanoramaCanvas::bytes(kept))?;
        Ok(PictureInWork { canvas: PanoramaCanvas::new(stored, kept), stored, kept, shape, turn })
    }

    /// Panorama of a picture whose pixels have all come, and the name of its layout.
    pub(super) fn finish(&mut self, work: PictureInWork) -> Result<(Panorama, &'static str), PanoramaError> {
        let PictureInWork { canvas, stored, kept, shape, turn } = work;
        let bytes = PanoramaCanvas::bytes(kept);
        let (mut rgb, faults) = canvas.finish();
        let ([width, height], [kept_width, kept_height]) = (turn.size(stored), turn.size(kept));
        if stored != kept {
            self.notices.push(format!(
                "the panorama of {width} × {height} pixels was scaled down to {kept_width} × {kept_height}"
            ));
        }
        if faults.replaced > 0 {
            self.notices.push(format!(
                "numbers of the panorama that are negative, not finite or too large for light: {}; they were replaced",
                faults.replaced
            ));
        }
        if faults.cut > 0 {
            self.notices.push(format!(
                "numbers of the panorama above {}, the greatest that is drawn: {}; they were reduced to it",
                Panorama::BRIGHTEST,
                faults.cut
            ));
        }
        if turn.transposed {
            self.take(bytes)?;
            rgb = turn.shown(kept, rgb);
            self.budget.give_back(bytes);
        } else {
            rgb = turn.shown(kept, rgb);
        }
        let picture = Panorama { width: kept_width, height: kept_height, rgb: Arc::new(rgb) };
        let PanoramaShape::Cube(unfolding) = shape else {
            return Ok((picture, shape.name()));
        };
        if !unfolding.corners_are_empty(&picture) {
            return Err(PanoramaError::Photo { path: self.path.into(), width, height });
        }
        self.take(PanoramaCanvas::bytes(unfolding.size_of_panorama(&picture)))?;
        let panorama = unfolding.equirectangular(&picture);
        drop(picture);
        self.budget.give_back(bytes);
        Ok((panorama, shape.name()))
    }
}
