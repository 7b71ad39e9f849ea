//! Pictures of a film one after the other, in stages that overlap: the photo-surface of the next picture is worked out
//! and this one is drawn while the one before is fetched, and those before that are written.

use crate::high_range::signal;
use crate::layout::StereoLayout;
use crate::maker::{MakerError, PictureMaker, Taking};
use crate::moment::FilmView;
use crate::sink::{FrameFile, FramePictures, PictureSink};
use image::RgbaImage;
use rayon::prelude::*;
use render::{Gpu, GpuError};
use std::sync::atomic::{AtomicBool, Ordering};

/// Where a film's pictures come from and go.
pub struct Shooting<'a> {
    /// Graphics device.
    pub gpu: &'a Gpu,
    /// Maker of the pictures.
    pub maker: &'a mut PictureMaker,
    /// Arrangement of the eyes' pictures.
    pub layout: Option<StereoLayout>,
    /// Kind of what the sink takes.
    pub kind: FrameFile,
    /// Place of the pictures.
    pub sink: &'a PictureSink,
    /// Set by whoever wants the film to end.
    pub stop: &'a AtomicBool,
}

/// Picture of a film that is due: its number, its view, and what goes with it.
pub struct DueFrame<T> {
    /// Number of the picture.
    pub number: u64,
    /// Eye, direction and look.
    pub view: FilmView,
    /// What is written over it.
    pub told: T,
}

/// What follows a film's pictures.
pub trait Onlooker<T, E> {
    /// Writes over the developed pictures of a moment, one for each eye.
    ///
    /// # Errors
    /// A device that went away.
    fn write_over(&mut self, told: &T, pictures: &mut [RgbaImage]) -> Result<(), E>;
    /// Notes that a tile of a picture was traced.
    fn tile_done(&self);
    /// Notes that the pictures of a moment are on their way to their files.
    fn picture_done(&mut self, number: u64);
}

impl Shooting<'_> {
    /// Takes all pictures, until the film is to end or nothing can be written any more. Returns how many were taken.
    ///
    /// # Errors
    /// Those of the frames, of the maker and of the onlooker.
    pub fn shoot<T, E>(
        &mut self,
        mut frames: impl Iterator<Item = Result<DueFrame<T>, E>>,
        onlooker: &mut (impl Onlooker<T, E> + Sync),
    ) -> Result<u64, E>
    where
        E: From<MakerError> + From<GpuError>,
    {
        let mut done = 0;
        let mut before: Option<(DueFrame<T>, Taking)> = None;
        let mut next = frames.next().transpose()?;
        let mut pending = next.as_ref().map(|frame| self.maker.submit(self.gpu, &frame.view)).transpose()?;
        while let Some(frame) = next {
            let submitted = pending.take().unwrap_or_default();
            next = if self.stop.load(Ordering::Relaxed) { None } else { frames.next().transpose()? };
            pending = next.as_ref().map(|frame| self.maker.submit(self.gpu, &frame.view)).transpose()?;
            let tile_done = || onlooker.tile_done();
            if self.kind == FrameFile::Exr {
                let (lights, interrupted) = self.maker.light(self.gpu, &frame.view, submitted, &tile_done)?;
                if interrupted.is_some() {
                    break;
                }
                if !self.sink.add(frame.number, FramePictures::Light(lights).arranged(self.layout)) {
                    break;
                }
                done += 1;
                onlooker.picture_done(frame.number);
                continue;
            }
            let taking = match self.maker.begin(self.gpu, &frame.view, submitted, &tile_done) {
                Err(MakerError::Interrupted) if done > 0 || before.is_some() => break,
                taking => taking?,
            };
            // A picture that was interrupted may be half black.
            if taking.interrupted.is_some() {
                break;
            }
            if let Some(taken) = before.replace((frame, taking)) {
                if !self.finish(taken, onlooker)? {
                    return Ok(done);
                }
                done += 1;
            }
        }
        if let Some(taken) = before
            && self.finish(taken, onlooker)?
        {
            done += 1;
        }
        Ok(done)
    }

    /// Waits for the pictures of a moment and gives them to the sink. Returns false if it takes none any more.
    fn finish<T, E>(
        &self,
        (frame, taking): (DueFrame<T>, Taking),
        onlooker: &mut impl Onlooker<T, E>,
    ) -> Result<bool, E>
    where
        E: From<GpuError>,
    {
        let pictures = if let FrameFile::Hdr(curve) = self.kind {
            let lights = taking.finish_exposed(self.gpu)?;
            FramePictures::Deep(lights.par_iter().map(|light| signal(light, curve)).collect())
        } else {
            let mut pictures = taking.finish(self.gpu)?;
            onlooker.write_over(&frame.told, &mut pictures)?;
            FramePictures::Developed(pictures)
        };
        let taken = self.sink.add(frame.number, pictures.arranged(self.layout));
        if taken {
            onlooker.picture_done(frame.number);
        }
        Ok(taken)
    }
}
