//! Stills and films of a scene, without a window, with progress and notices on the terminal.

use crate::commands::film_titles::FilmTitles;
use crate::error::Error;
use crate::output::progress;
use crate::output::say::tell;
use crate::session::interrupt::{interrupted, interruption};
use crate::session::reel::Moment;
use command::{DialOptions, PictureOptions, RayOptions, map_scale_of_stills};
use image::RgbaImage;
use picture_files::exr;
use picture_files::files::save;
use picture_files::film::{Film, Written};
use render::choice::Choice;
use render::picture::{Studio, largest_side};
use render::{CutStats, Gpu, Pending, SceneRenderer};
use scene::Scene;
use std::path::Path;
use std::sync::atomic::Ordering;
use trace::{CameraLens, Optics, RayTracer, Traced};
use view::{Dial, Occasion, RendererName, Shot};

/// Dial of pictures that are kept.
pub fn dial_of_stills(dial: &DialOptions, picture: &PictureOptions) -> Dial {
    dial.dial(Occasion::Still, map_scale_of_stills(picture.samples))
}

/// Maker of the pictures.
enum Maker {
    Drawn(Box<SceneRenderer>),
    Traced(Box<RayTracer>),
}

/// A scene, a device and targets, ready to take pictures.
pub struct Cameraman<'gpu> {
    gpu: &'gpu Gpu,
    maker: Maker,
    studio: Studio,
    options: PictureOptions,
    dial: Dial,
    titles: Option<FilmTitles>,
}

impl<'gpu> Cameraman<'gpu> {
    /// Chooses how to draw the scene, says so, and uploads it.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the device cannot draw pictures of that size, [`Error::Refine`] if fixed edges cut the
    /// scene too finely.
    pub fn new(gpu: &'gpu Gpu, scene: Scene, options: &PictureOptions, dial: Dial) -> Result<Self, Error> {
        let limit = largest_side(gpu);
        if options.size.iter().any(|side| *side > limit) {
            return Err(Error::TooLarge { size: options.size, limit });
        }
        if dial.renderer == RendererName::Raytrace {
            if interruption().load(Ordering::Relaxed) {
                return Err(Error::Interrupted);
            }
            tell(format_args!("{}: traced ray by ray, on the CPU", scene.name));
            let spinner = progress::spinner("sorting triangles");
            let tracer = RayTracer::new(scene, options.background, options.exact_light)?;
            spinner.finish_and_clear();
            let studio = Studio::new(gpu, options.size, 1);
            let maker = Maker::Traced(Box::new(tracer));
            return Ok(Self { gpu, maker, studio, options: options.clone(), dial, titles: None });
        }
        let spinner = progress::cutting(dial);
        let Choice { scene, dial, because } = Choice::of(scene, dial, Occasion::Still)?;
        spinner.finish_and_clear();
        tell(format_args!("{because}, on {}", gpu.description()));
        let spinner = progress::spinner("uploading");
        let renderer = SceneRenderer::new(gpu, scene, Studio::format(gpu), options.background, dial, Occasion::Still)?;
        let studio = Studio::new(gpu, options.size, options.samples);
        gpu.wait()?;
        spinner.finish_and_clear();
        let maker = Maker::Drawn(Box::new(renderer));
        Ok(Self { gpu, maker, studio, options: options.clone(), dial, titles: None })
    }

    /// Adds a lens, a shutter and mirrors, if this cameraman traces rays. `speed_of_light`: metres per second.
    #[must_use]
    pub fn with_rays(mut self, rays: &RayOptions, speed_of_light: f64) -> Self {
        if let Maker::Traced(tracer) = self.maker {
            let lens = rays.aperture.zip(rays.focus).map(|(aperture_m, focus_m)| CameraLens { aperture_m, focus_m });
            let optics = Optics { lens, exposure_m: rays.shutter.unwrap_or(0.0) * speed_of_light };
            let tracer = tracer.with_optics(optics).with_bounces(rays.bounces.unwrap_or(0));
            self.maker = Maker::Traced(Box::new(tracer));
        }
        self
    }

    /// Writes over the pictures what their moments tell.
    #[must_use]
    pub fn with_titles(self, titles: FilmTitles) -> Self {
        Self { titles: Some(titles), ..self }
    }

    fn shot(&self, moment: &Moment) -> Shot {
        let shot = moment.gaze.shot(moment.look.fov_deg, moment.look.effects);
        // Rays all end at the eye.
        let outside = moment.look.outside.filter(|_| matches!(self.maker, Maker::Drawn(_)));
        outside.map_or(shot, |outside| shot.from_outside(&outside))
    }

    /// Takes one picture and writes it as PNG.
    ///
    /// # Errors
    /// A lost device, a place that cannot be written, or [`Error::Interrupted`].
    pub fn still(&mut self, moment: &Moment, path: &Path) -> Result<(), Error> {
        let pending = self.submit(moment)?;
        let picture = self.take(moment, pending, None)?;
        self.tell_of_quality(moment);
        save(&picture, path)?;
        tell(format_args!("wrote {}", path.display()));
        Ok(())
    }

    /// Takes one picture and writes its light as OpenEXR.
    ///
    /// # Errors
    /// A lost device, or a place that cannot be written.
    pub fn light(&mut self, moment: &Moment, path: &Path) -> Result<(), Error> {
        let pending = self.submit(moment)?;
        let shot = self.shot(moment);
        let light = match &mut self.maker {
            Maker::Drawn(renderer) => self.studio.expose(self.gpu, renderer, &shot, pending)?,
            Maker::Traced(tracer) => traced(tracer, &shot, &self.options)?.image(),
        };
        self.tell_of_quality(moment);
        exr::save(&light, path)?;
        tell(format_args!("wrote {}", path.display()));
        Ok(())
    }

    /// Films one frame per moment. Ctrl-C ends the film early and keeps what there is.
    ///
    /// # Errors
    /// A lost device, an encoder that fails, or a place that cannot be written.
    pub fn film(
        &mut self,
        mut moments: impl Iterator<Item = Result<Moment, Error>>,
        count: u64,
        frames_per_second: f64,
        path: &Path,
    ) -> Result<(), Error> {
        let traces = matches!(self.maker, Maker::Traced(_));
        let stop = if traces { interruption() } else { interrupted() };
        if traces && stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        let film = Film::create(path, self.options.size, frames_per_second)?;
        let bar = progress::bar(path.display().to_string(), count);

        // The photo-surface of the next frame is computed while this one is drawn.
        let mut before = None;
        let mut next = self.begin(moments.next().transpose()?)?;
        let mut done = 0;
        while let Some((moment, pending)) = next {
            next = self.begin(if stop.load(Ordering::Relaxed) { None } else { moments.next().transpose()? })?;
            let elapsed_s = before.replace(moment.own_s).map(|before| moment.own_s - before);
            let picture = match self.take(&moment, pending, elapsed_s) {
                Err(Error::Interrupted) => break,
                picture => picture?,
            };
            // A picture that was interrupted may be half black.
            if (traces && stop.load(Ordering::Relaxed)) || !film.add(picture) {
                break;
            }
            done += 1;
            bar.inc(1);
        }
        bar.finish_and_clear();
        if traces && done == 0 && stop.load(Ordering::Relaxed) {
            // The encoder of a film without pictures has nothing to tell but a complaint.
            let _ = film.finish();
            return Err(Error::Interrupted);
        }
        if done < count && stop.load(Ordering::Relaxed) {
            tell(format_args!("interrupted: the film ends after {done} of {count} pictures"));
        }
        match film.finish()? {
            Written::Film(path) => tell(format_args!("wrote {}", path.display())),
            Written::Pictures(folder) => tell(format_args!(
                "wrote numbered pictures into {}, because ffmpeg is not installed; install it to get a film",
                folder.display()
            )),
        }
        Ok(())
    }

    /// Says how the picture was cut, if its map could not be as fine as was wanted, and if it is more than a pixel
    /// off.
    fn tell_of_quality(&self, moment: &Moment) {
        let Maker::Drawn(renderer) = &self.maker else { return };
        let shot = self.shot(moment);
        let certainty = renderer.certainty(&shot, self.options.size);
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

    /// Begins the next picture of a film.
    fn begin(&mut self, next: Option<Moment>) -> Result<Option<(Moment, Pending)>, Error> {
        next.map(|moment| {
            let pending = self.submit(&moment)?;
            Ok((moment, pending))
        })
        .transpose()
    }

    fn submit(&mut self, moment: &Moment) -> Result<Pending, Error> {
        Ok(match &mut self.maker {
            Maker::Drawn(renderer) => renderer.submit(self.gpu, &moment.gaze.observer, moment.look.effects)?,
            Maker::Traced(_) => Pending::default(),
        })
    }

    fn take(&mut self, moment: &Moment, pending: Pending, elapsed_s: Option<f64>) -> Result<RgbaImage, Error> {
        let shot = self.shot(moment);
        let development = moment.look.development;
        let mut picture = match &mut self.maker {
            Maker::Drawn(renderer) => {
                self.studio.photograph(self.gpu, renderer, &shot, pending, &development, elapsed_s)?
            }
            Maker::Traced(tracer) => {
                let traced = traced(tracer, &shot, &self.options)?;
                self.studio.develop(self.gpu, &traced.texels(), traced.stored, &development, elapsed_s)?
            }
        };
        if let (Some(titles), Some(told)) = (&mut self.titles, &moment.told) {
            titles.write(self.gpu, told, &mut picture)?;
        }
        Ok(picture)
    }
}

/// Traces a picture, and says how much of it is finished if it was interrupted.
fn traced(tracer: &RayTracer, shot: &Shot, options: &PictureOptions) -> Result<Traced, Error> {
    let bar = progress::bar("tracing rays", RayTracer::tile_count(options.size));
    let traced = tracer.trace(shot, options.size, options.samples, &interruption(), || bar.inc(1));
    bar.finish_and_clear();
    if traced.done == 0 {
        return Err(Error::Interrupted);
    }
    if traced.done < traced.tiles {
        tell(format_args!("interrupted: {} of {} tiles are done, the others are black", traced.done, traced.tiles));
    }
    Ok(traced)
}
