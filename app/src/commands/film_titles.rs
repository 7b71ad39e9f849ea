//! What a film writes over its pictures: captions, map, diagram, clocks.

use crate::session::reel::Told;
use crate::session::tour_ride::TourMark;
use cabin::Guide;
use image::RgbaImage;
use interface::{DrawnSheet, SHEET_FORMAT, SheetPointer};
use render::{Gpu, GpuError};
use scene::Scene;
use studio::Sheet;

/// Height of a picture on which a point is a pixel.
const HEIGHT: f32 = 720.0;

/// Interface over the pictures of a film.
pub struct FilmTitles {
    sheet: DrawnSheet,
    readback: Sheet,
    guide: Guide,
    aspect: f64,
    /// Number of the frame whose events are marked.
    marked: Option<u64>,
}

impl FilmTitles {
    /// Titles for pictures of `size` pixels of rides in a scene.
    pub fn new(gpu: &Gpu, scene: &Scene, size: [u32; 2]) -> Self {
        let pixels_per_point = (size[1] as f32 / HEIGHT).max(0.5);
        Self {
            sheet: DrawnSheet::new(gpu, size.map(|side| side as f32 / pixels_per_point), pixels_per_point),
            readback: Sheet::new(gpu, size, SHEET_FORMAT),
            guide: Guide::new(scene),
            aspect: f64::from(size[0]) / f64::from(size[1]),
            marked: None,
        }
    }

    /// Writes over a picture what is told at its moment.
    ///
    /// # Errors
    /// [`GpuError`] if the device went away.
    pub fn write(&mut self, gpu: &Gpu, told: &Told, picture: &mut RgbaImage) -> Result<(), GpuError> {
        let Told { frame, presentation, caption, marks } = told;
        for TourMark { name, event } in marks.iter().filter(|_| self.marked != Some(frame.record.frame)) {
            self.guide.mark(name.in_language(presentation.language.code()), *event);
        }
        self.marked = Some(frame.record.frame);
        self.guide.note(frame, presentation, self.aspect);
        let language = presentation.language;
        let clocks = self.guide.wanted_clocks(frame, presentation);
        let guide = &self.guide;
        self.sheet.draw(gpu, frame.record.at as f64 * 1e-9, (SheetPointer::default(), &[]), |ui| {
            guide.show(ui, presentation, &clocks);
            if let Some(caption) = caption {
                interface::caption_film(ui, guide.free_width(ui, presentation), language, caption);
            }
        });
        let encoder = gpu.device.create_command_encoder(&Default::default());
        let drawn = self.readback.fetch_from(gpu, encoder, self.sheet.picture().texture(), 0)?;
        for (under, over) in picture.pixels_mut().zip(drawn.chunks_exact(4)) {
            let through = 255 - u32::from(over[3]);
            for (under, over) in under.0.iter_mut().zip(&over[..3]) {
                let mixed = u32::from(*over) + (u32::from(*under) * through + 127) / 255;
                *under = u8::try_from(mixed).unwrap_or(u8::MAX);
            }
        }
        Ok(())
    }
}
