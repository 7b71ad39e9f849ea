//! Stills and films of a scene, without a window, with progress and notices on the terminal.

use crate::commands::film_titles::FilmTitles;
use crate::error::Error;
use crate::output::progress;
use crate::output::say::tell;
use crate::session::interrupt::{interrupted, interruption};
use crate::session::reel::Told;
use command::{DialOptions, PictureOptions, map_scale_of_stills};
use filming::{
    DueFrame, FilmView, FrameFile, FramePictures, MakerOptions, Moment, Onlooker, PictureMaker, PictureSink, Shooting,
    StereoLayout,
};
use image::RgbaImage;
use indicatif::ProgressBar;
use picture_files::files::save;
use picture_files::film::{FilmForm, Written};
use picture_files::{FilmCodec, HdrCurve, SequenceName, exr};
use render::choice::Choice;
use render::{CutStats, Gpu, SceneRenderer};
use scene::Scene;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use studio::{Studio, largest_side};
use trace::RayTracer;
use view::{Dial, Occasion, Optics, Projection, RendererName};
use walls::StereoEyes;

/// Dial of pictures that are kept.
pub fn dial_of_stills(dial: &DialOptions, picture: &PictureOptions) -> Dial {
    dial.dial(Occasion::Still, map_scale_of_stills(picture.samples))
}

/// Projection, eyes and lens of a camera; those of a flat picture of one eye through a pinhole, unless set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Equipment {
    /// Map from places of the picture to directions.
    pub projection: Projection,
    /// Eyes of a stereo picture, and the arrangement of their pictures.
    pub stereo: Option<(StereoEyes, StereoLayout)>,
    /// Lens.
    pub optics: Optics,
    /// Largest number of turns of a ray.
    pub bounces: u32,
    /// Signal of films of a high dynamic range.
    pub hdr: Option<HdrCurve>,
}

/// Place of a film's pictures.
#[derive(Clone, Copy, Debug)]
pub enum FilmOut<'a> {
    /// A film of this codec, and its number of pictures per second.
    Film(&'a Path, FilmCodec, f64),
    /// Numbered pictures.
    Numbered(&'a SequenceName, FrameFile),
}

/// A scene, a device and targets, ready to take pictures.
pub struct Cameraman<'gpu> {
    gpu: &'gpu Gpu,
    maker: PictureMaker,
    equipment: Equipment,
    size: [u32; 2],
    dial: Dial,
    titles: Option<FilmTitles>,
}

impl<'gpu> Cameraman<'gpu> {
    /// Chooses how to draw the scene, says so, and uploads it.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the device cannot draw pictures of that size, [`Error::Refine`] if fixed edges cut the
    /// scene too finely.
    pub fn new(
        gpu: &'gpu Gpu,
        scene: Scene,
        picture: &PictureOptions,
        dial: Dial,
        equipment: Equipment,
    ) -> Result<Self, Error> {
        let (limit, size) = (largest_side(gpu), picture.size);
        if size.iter().any(|side| *side > limit) {
            return Err(Error::TooLarge { size, limit });
        }
        let Equipment { projection, stereo, optics, bounces, hdr } = equipment;
        let stereo = stereo.map(|(eyes, _)| eyes);
        let (samples, exposes_alone) = (picture.samples, hdr.is_some());
        let options = MakerOptions { size, samples, projection, stereo, optics, exposes_alone };
        if dial.renderer == RendererName::Raytrace {
            if interruption().load(Ordering::Relaxed) {
                return Err(Error::Interrupted);
            }
            tell(format_args!("{}: traced ray by ray, on the CPU", scene.name));
            let spinner = progress::spinner("sorting triangles");
            let tracer = RayTracer::new(scene, picture.background, picture.exact_light)?;
            let tracer = tracer.with_optics(optics).with_bounces(bounces);
            spinner.finish_and_clear();
            let maker = PictureMaker::traced(gpu, tracer, options, interruption());
            return Ok(Self { gpu, maker, equipment, size, dial, titles: None });
        }
        let spinner = progress::cutting(dial);
        let Choice { scene, dial, because } = Choice::of(scene, dial, Occasion::Still)?;
        spinner.finish_and_clear();
        tell(format_args!("{because}, on {}", gpu.description()));
        let spinner = progress::spinner("uploading");
        let renderer = SceneRenderer::new(gpu, scene, Studio::format(gpu), picture.background, dial, Occasion::Still)?;
        let maker = PictureMaker::drawn(gpu, renderer, options);
        gpu.wait()?;
        spinner.finish_and_clear();
        Ok(Self { gpu, maker, equipment, size, dial, titles: None })
    }

    /// Writes over the pictures what their moments tell.
    #[must_use]
    pub fn with_titles(self, titles: FilmTitles) -> Self {
        Self { titles: Some(titles), ..self }
    }

    /// Takes the picture of a moment, and writes it as PNG or its light as OpenEXR.
    ///
    /// # Errors
    /// A lost device, a place that cannot be written, or [`Error::Interrupted`].
    pub fn still(&mut self, moment: &Moment<Told>, path: &Path, kind: FrameFile) -> Result<(), Error> {
        let mut view = moment.view(None);
        // Rays all end at the eye.
        view.outside = view.outside.filter(|_| self.maker.renderer().is_some());
        let pending = self.maker.submit(self.gpu, &view)?;
        let bar = tile_bar(self.maker.tiles());
        let tile_done = || bar.inc(1);
        let layout = self.equipment.layout();
        let (pictures, interrupted) = match kind {
            FrameFile::Png | FrameFile::Hdr(_) => {
                let taking = self.maker.begin(self.gpu, &view, pending, &tile_done)?;
                let interrupted = taking.interrupted;
                let mut pictures = taking.finish(self.gpu)?;
                if let (Some(titles), Some(told)) = (&mut self.titles, &moment.told) {
                    pictures.iter_mut().try_for_each(|picture| titles.write(self.gpu, told, picture))?;
                }
                (FramePictures::Developed(pictures), interrupted)
            }
            FrameFile::Exr => {
                let (lights, interrupted) = self.maker.light(self.gpu, &view, pending, &tile_done)?;
                (FramePictures::Light(lights), interrupted)
            }
        };
        bar.finish_and_clear();
        if let Some((done, tiles)) = interrupted {
            tell(format_args!("interrupted: {done} of {tiles} tiles are done, the others are black"));
        }
        self.tell_of_quality(&view);
        let paths = filming::eye_paths(path, layout);
        match pictures.arranged(layout) {
            FramePictures::Developed(pictures) => {
                for (picture, path) in pictures.into_iter().zip(&paths) {
                    save(picture, path)?;
                }
            }
            FramePictures::Light(lights) => {
                for (light, path) in lights.iter().zip(&paths) {
                    exr::save(light, path)?;
                }
            }
            FramePictures::Deep(_) => {}
        }
        paths.iter().for_each(|path| tell(format_args!("wrote {}", path.display())));
        Ok(())
    }

    /// Films one picture per moment, each with its number. Ctrl-C ends the film early and keeps what there is.
    ///
    /// # Errors
    /// A lost device, an encoder that fails, or a place that cannot be written.
    pub fn film(
        &mut self,
        moments: impl Iterator<Item = Result<(u64, Moment<Told>), Error>>,
        count: u64,
        out: FilmOut<'_>,
    ) -> Result<(), Error> {
        // An interruption that ended the ride does not end its film; that of tracing counts from the beginning.
        if self.maker.renderer().is_some() {
            interrupted();
        }
        let mut roll = FilmRoll::open(self.gpu, self.equipment, self.size, out, count)?;
        let shot = self.shoot(moments, &mut roll);
        roll.finish(shot)
    }

    /// Adds a picture per moment to a film.
    ///
    /// # Errors
    /// A lost device, or [`Error::Interrupted`] before the first traced picture was finished.
    pub fn shoot(
        &mut self,
        moments: impl Iterator<Item = Result<(u64, Moment<Told>), Error>>,
        roll: &mut FilmRoll<'_>,
    ) -> Result<(), Error> {
        if self.maker.renderer().is_none() && interruption().load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        let drawn = self.maker.renderer().is_some();
        let mut before = None;
        let alone = roll.alone;
        let frames = moments.map(|moment| {
            let (number, mut moment) = moment?;
            let elapsed_s = before.replace(moment.own_s).map(|before| moment.own_s - before).filter(|_| !alone);
            // Rays all end at the eye.
            moment.look.outside = moment.look.outside.filter(|_| drawn);
            Ok(DueFrame { number, view: moment.view(elapsed_s), told: moment.told })
        });
        roll.watch.titles = self.titles.take();
        roll.watch.tiles = tile_bar(self.maker.tiles());
        let (layout, stop) = (self.equipment.layout(), interruption());
        let FilmRoll { sink, kind, watch, .. } = roll;
        let mut shooting = Shooting { gpu: self.gpu, maker: &mut self.maker, layout, kind: *kind, sink, stop: &stop };
        let outcome = shooting.shoot(frames, watch);
        watch.tiles.finish_and_clear();
        self.titles = watch.titles.take();
        outcome.map(drop)
    }

    /// Says how the picture was cut, if its map could not be as fine as was wanted, and if it is more than a pixel
    /// off.
    fn tell_of_quality(&self, view: &FilmView) {
        let (Some(renderer), Some(certainty)) = (self.maker.renderer(), self.maker.certainty(view)) else { return };
        if certainty.error_px() > 1.0 {
            tell(certainty.sentence());
        }
        if let Some(CutStats { tolerance_px, triangles, duration }) = renderer.cut_stats()
            && triangles > 0
        {
            tell(format_args!(
                "cut into {triangles} triangles for {tolerance_px} pixels in {:.0} ms",
                1000.0 * duration.as_secs_f64()
            ));
        }
        let wanted = self.dial.map_scale.unwrap_or(1.0);
        if let Some(stats) = renderer.map_stats()
            && stats.panes > 0
            && stats.texels_per_pixel < 0.99 * wanted
        {
            tell(format_args!(
                "the map had room for {:.1} texels a pixel along each axis instead of {wanted}; a smaller --size has more",
                stats.texels_per_pixel
            ));
        }
    }
}

impl Equipment {
    fn layout(&self) -> Option<StereoLayout> {
        self.stereo.map(|(_, layout)| layout)
    }
}

/// Film on its way into its files.
pub struct FilmRoll<'gpu> {
    sink: PictureSink,
    kind: FrameFile,
    /// Place of the pictures, for messages.
    name: String,
    /// True if each picture is exposed by itself, so that it is the same whoever draws it: numbered pictures.
    alone: bool,
    watch: FilmWatch<'gpu>,
}

impl<'gpu> FilmRoll<'gpu> {
    /// Opens the files of a film of `count` pictures of `size` pixels for each eye.
    ///
    /// # Errors
    /// An encoder that cannot be started.
    pub fn open(
        gpu: &'gpu Gpu,
        equipment: Equipment,
        size: [u32; 2],
        out: FilmOut<'_>,
        count: u64,
    ) -> Result<Self, Error> {
        let layout = equipment.layout();
        let (sink, kind, name) = match out {
            FilmOut::Film(path, codec, frames_per_second) => {
                let size = layout.map_or(size, |layout| layout.size(size));
                let tags = filming::film_tags(equipment.projection, layout);
                let paths = filming::eye_paths(path, layout);
                let sink =
                    PictureSink::films(&paths, size, frames_per_second, FilmForm { codec, hdr: equipment.hdr, tags })?;
                (sink, equipment.hdr.map_or(FrameFile::Png, FrameFile::Hdr), path.display().to_string())
            }
            FilmOut::Numbered(name, kind) => {
                let sink = PictureSink::numbered(filming::eye_names(name, layout));
                (sink, kind, name.pattern().display().to_string())
            }
        };
        let watch = FilmWatch {
            gpu,
            titles: None,
            bar: progress::bar(name.clone(), count),
            tiles: ProgressBar::hidden(),
            lines: !std::io::IsTerminal::is_terminal(&std::io::stderr()),
            done: 0,
            count,
        };
        Ok(Self { sink, kind, name, alone: matches!(out, FilmOut::Numbered(..)), watch })
    }

    /// Completes the files after `shot`, the outcome of shooting, and says what there is.
    ///
    /// # Errors
    /// The fault of shooting or of writing; [`Error::CutShort`] if pictures are missing that nobody asked to leave out.
    pub fn finish(self, shot: Result<(), Error>) -> Result<(), Error> {
        let FilmWatch { bar, done, count, .. } = self.watch;
        bar.finish_and_clear();
        if done == 0 && matches!(shot, Err(Error::Interrupted)) {
            // The encoder of a film without pictures has nothing to tell but a complaint.
            let _ = self.sink.finish();
            return shot;
        }
        match shot {
            Err(Error::Interrupted) => {}
            shot => shot?,
        }
        let was_stopped = interruption().load(Ordering::Relaxed);
        let written = self.sink.finish()?;
        if done < count && was_stopped {
            tell(format_args!("interrupted: the film ends after {done} of {count} pictures"));
        }
        for written in written {
            match written {
                Written::Film(path) => tell(format_args!("wrote {}", path.display())),
                Written::Pictures(folder) => tell(format_args!(
                    "wrote numbered pictures into {}, because ffmpeg is not installed; install it to get a film",
                    folder.display()
                )),
            }
        }
        if self.alone {
            tell(format_args!("wrote {done} pictures as {}", self.name));
        }
        if done < count && !was_stopped { Err(Error::CutShort { done, count }) } else { Ok(()) }
    }
}

/// Progress of a film, and what is written over its pictures.
struct FilmWatch<'gpu> {
    gpu: &'gpu Gpu,
    titles: Option<FilmTitles>,
    bar: ProgressBar,
    tiles: ProgressBar,
    /// True if a line tells of each picture, where no bar can be drawn.
    lines: bool,
    done: u64,
    count: u64,
}

impl Onlooker<Option<Arc<Told>>, Error> for FilmWatch<'_> {
    fn write_over(&mut self, told: &Option<Arc<Told>>, pictures: &mut [RgbaImage]) -> Result<(), Error> {
        if let (Some(titles), Some(told)) = (&mut self.titles, told) {
            pictures.iter_mut().try_for_each(|picture| titles.write(self.gpu, told, picture))?;
        }
        Ok(())
    }

    fn tile_done(&self) {
        self.tiles.inc(1);
    }

    fn picture_done(&mut self, number: u64) {
        self.done += 1;
        self.bar.inc(1);
        self.tiles.set_position(0);
        if self.lines {
            tell(format_args!("picture {number}: {} of {}", self.done, self.count));
        }
    }
}

/// Progress bar of a traced picture; hidden if none is traced.
fn tile_bar(tiles: u64) -> ProgressBar {
    if tiles > 0 { progress::bar("tracing rays", tiles) } else { ProgressBar::hidden() }
}
