//! `rapidity render`: stills and films, without a window.
//!
//! A film without a recording shows what an inertial observer sees: his eye moves on a straight worldline, and the
//! frames are taken at equal steps of his own time. A recorded ride is seen with the rider's eyes.

use crate::command::{Output, PictureOptions, RayOptions, RenderOptions, Renderer, Viewpoint};
use crate::error::Error;
use crate::exr;
use crate::film::{Film, Written};
use crate::film_ride;
use crate::gpu::Gpu;
use crate::progress;
use crate::render_walls;
use crate::renderers::choice::{Bending, Choice};
use crate::renderers::picture::{Studio, largest_side};
use crate::renderers::polygon::{CutStats, Pace};
use crate::renderers::raytrace::{Lens, Optics, RayTracer, Traced};
use crate::renderers::{Effects, SceneRenderer, Shot};
use crate::scene::{Scene, Start, source};
use crate::views::{Camera, Field, Gaze};
use glam::DVec3;
use image::RgbaImage;
use physics::photo_surface::Eye;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

/// Metres from the ground to the eye of a standing visitor.
const EYE_HEIGHT_M: f64 = 1.6;
/// Seconds of a film for which `--seconds` says nothing.
const FILM_SECONDS: f64 = 10.0;

/// Carries out `rapidity render`.
///
/// # Errors
/// Whatever keeps the picture from being drawn or written.
pub fn render(options: &RenderOptions) -> Result<(), Error> {
    // Only rays are worth interrupting, but for them it counts from the beginning.
    if options.picture.renderer == Renderer::Raytrace {
        interrupted();
    }
    let gpu = Gpu::new()?;
    if let (Some(display), Output::Folder(folder)) = (&options.room.display, &options.out) {
        return render_walls::render(options, &gpu, display, folder);
    }
    writable(options.out.path())?;
    if let Some(recording) = &options.replay {
        return recorded_ride(options, &gpu, recording);
    }
    let scene = source::load(&options.world.scene, options.world.speed_of_light)?;
    let start = scene.start;
    let speed_of_light = options.world.speed_of_light;
    let camera = Cameraman::new(&gpu, scene, &options.picture, options.world.bending(Pace::Still))?;
    let mut camera = camera.with_rays(&options.rays, speed_of_light);
    match &options.out {
        Output::Picture(path) => camera.still(inertial(&options.viewpoint, start, 0.0)?, path),
        Output::Light(path) => camera.light(inertial(&options.viewpoint, start, 0.0)?, path),
        Output::Folder(path) => writable(path),
        Output::Film(path) => {
            let rate = options.frames_per_second();
            let count = (options.seconds.unwrap_or(FILM_SECONDS) * rate).round().max(1.0);
            let moment = |frame: u64| {
                let own_s = frame as f64 / rate;
                Ok(Moment { gaze: inertial(&options.viewpoint, start, own_s * speed_of_light)?, own_s })
            };
            camera.film((0..count as u64).map(moment), count as u64, rate, path)
        }
    }
}

/// The same with the eyes of a recorded rider.
fn recorded_ride(options: &RenderOptions, gpu: &Gpu, recording: &Path) -> Result<(), Error> {
    let rate = options.frames_per_second();
    let (scene, speed_of_light, moments) = film_ride::reel(recording, &options.world.scene, rate, options.seconds)?;
    let camera = Cameraman::new(gpu, scene, &options.picture, options.world.bending(Pace::Still))?;
    let mut camera = camera.with_rays(&options.rays, speed_of_light);
    match &options.out {
        Output::Picture(path) => camera.still(moments.last().ok_or(Error::NothingRidden)?.gaze, path),
        Output::Light(path) => camera.light(moments.last().ok_or(Error::NothingRidden)?.gaze, path),
        Output::Folder(path) => writable(path),
        Output::Film(path) => {
            let count = moments.len() as u64;
            camera.film(moments.into_iter().map(Ok), count, rate, path)
        }
    }
}

/// What an observer in uniform motion sees, `proper_time` metres of light travel after the start.
fn inertial(viewpoint: &Viewpoint, start: Start, proper_time: f64) -> Result<Gaze, Error> {
    let position = viewpoint.position.unwrap_or(start.position + DVec3::Y * EYE_HEIGHT_M);
    let celerity = viewpoint.celerity();
    let eye = Eye::new(position + celerity.vector() * proper_time, celerity.vector())?;
    let look = viewpoint.look.unwrap_or(start.look);
    let ct = celerity.gamma() * proper_time;
    Ok(Gaze { eye, ct, observer_from_eye: Camera::looking(look, viewpoint.up, 1.0).observer_from_eye })
}

/// What an observer sees, and when by his own clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// What he sees from where.
    pub gaze: Gaze,
    /// Seconds.
    pub own_s: f64,
}

/// Who makes the pictures.
enum Way {
    Drawn(Box<SceneRenderer>),
    Traced(Box<RayTracer>),
}

/// A scene, a device and targets, ready to take pictures.
pub struct Cameraman<'gpu> {
    gpu: &'gpu Gpu,
    way: Way,
    studio: Studio,
    options: PictureOptions,
}

impl<'gpu> Cameraman<'gpu> {
    /// Chooses how to draw the scene, says so, and uploads it.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the device cannot draw pictures of that size, [`Error::Refine`] if fixed edges cut the scene too finely.
    pub fn new(gpu: &'gpu Gpu, scene: Scene, options: &PictureOptions, bending: Bending) -> Result<Self, Error> {
        let limit = largest_side(gpu);
        if options.size.iter().any(|side| *side > limit) {
            return Err(Error::TooLarge { size: options.size, limit });
        }
        if options.renderer == Renderer::Raytrace {
            if interruption().load(Ordering::Relaxed) {
                return Err(Error::Interrupted);
            }
            eprintln!("{}: traced ray by ray, on the CPU", scene.name);
            let spinner = progress::spinner("sorting triangles");
            let tracer = RayTracer::new(scene, options.background, options.exact_light)?;
            spinner.finish_and_clear();
            let studio = Studio::new(gpu, options.size, 1);
            return Ok(Self { gpu, way: Way::Traced(Box::new(tracer)), studio, options: options.clone() });
        }
        let Choice { scene, method, because } =
            Choice::of(scene, options.renderer, bending, options.map_of_pictures())?;
        eprintln!("{because}, on {}", gpu.description());
        let spinner = progress::spinner("uploading");
        let renderer = SceneRenderer::new(gpu, &scene, Studio::format(gpu), options.background, method)?;
        let studio = Studio::new(gpu, options.size, options.samples);
        gpu.wait()?;
        spinner.finish_and_clear();
        Ok(Self { gpu, way: Way::Drawn(Box::new(renderer)), studio, options: options.clone() })
    }

    /// The same with a lens, a shutter and mirrors, if it traces rays. `speed_of_light`: metres per second.
    #[must_use]
    pub fn with_rays(mut self, rays: &RayOptions, speed_of_light: f64) -> Self {
        if let Way::Traced(tracer) = self.way {
            let lens = rays.aperture.zip(rays.focus).map(|(aperture_m, focus_m)| Lens { aperture_m, focus_m });
            let optics = Optics { lens, exposure_m: rays.shutter.unwrap_or(0.0) * speed_of_light };
            let tracer = tracer.with_optics(optics).with_bounces(rays.bounces.unwrap_or(0));
            self.way = Way::Traced(Box::new(tracer));
        }
        self
    }

    /// Takes one picture and writes it as PNG.
    ///
    /// # Errors
    /// A lost device, a place that cannot be written, or [`Error::Interrupted`].
    pub fn still(&mut self, gaze: Gaze, path: &Path) -> Result<(), Error> {
        self.submit(&gaze)?;
        let picture = self.take(&gaze, None)?;
        self.tell_of_quality(&gaze);
        save(&picture, path)?;
        eprintln!("wrote {}", path.display());
        Ok(())
    }

    /// Takes one picture and writes its light as OpenEXR.
    ///
    /// # Errors
    /// A lost device, or a place that cannot be written.
    pub fn light(&mut self, gaze: Gaze, path: &Path) -> Result<(), Error> {
        self.submit(&gaze)?;
        let shot = shot(&gaze, self.options.fov, self.options.effects);
        let light = match &mut self.way {
            Way::Drawn(renderer) => self.studio.expose(self.gpu, renderer, &shot)?,
            Way::Traced(tracer) => traced(tracer, &shot, &self.options)?.image(),
        };
        self.tell_of_quality(&gaze);
        exr::save(&light, path)?;
        eprintln!("wrote {}", path.display());
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
        let traces = matches!(self.way, Way::Traced(_));
        let stop = if traces { interruption() } else { interrupted() };
        if traces && stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        let film = Film::create(path, self.options.size, frames_per_second)?;
        let bar = progress::bar(path.display().to_string(), count);

        // The photo-surface of the next frame is worked out while this one is drawn.
        let mut before = None;
        let mut next = moments.next().transpose()?;
        if let Some(moment) = &next {
            self.submit(&moment.gaze)?;
        }
        let mut done = 0;
        while let Some(moment) = next {
            next = if stop.load(Ordering::Relaxed) { None } else { moments.next().transpose()? };
            if let Some(moment) = &next {
                self.submit(&moment.gaze)?;
            }
            let elapsed_s = before.replace(moment.own_s).map(|before| moment.own_s - before);
            let picture = match self.take(&moment.gaze, elapsed_s) {
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
            // Of a film without pictures nothing comes but the encoder's complaint.
            let _ = film.finish();
            let _ = std::fs::remove_file(path);
            return Err(Error::Interrupted);
        }
        if done < count && stop.load(Ordering::Relaxed) {
            eprintln!("interrupted: the film ends after {done} of {count} pictures");
        }
        match film.finish()? {
            Written::Film(path) => eprintln!("wrote {}", path.display()),
            Written::Pictures(folder) => eprintln!(
                "wrote numbered pictures into {}, because ffmpeg is not installed; install it to get a film",
                folder.display()
            ),
        }
        Ok(())
    }

    /// Says how the picture was cut, if its map could not be as fine as was wanted, and if it is more than a pixel off.
    fn tell_of_quality(&self, gaze: &Gaze) {
        let Way::Drawn(renderer) = &self.way else { return };
        let shot = shot(gaze, self.options.fov, self.options.effects);
        let certainty = renderer.certainty(&shot, self.options.size);
        if certainty.error_px() > 1.0 {
            eprintln!("{}", certainty.sentence());
        }
        if let Some(CutStats { tolerance_px, triangles, duration }) = renderer.cut_stats()
            && triangles > 0
        {
            eprintln!(
                "cut into {triangles} triangles for {tolerance_px} pixels in {:.0} ms",
                1000.0 * duration.as_secs_f64()
            );
        }
        let wanted = self.options.map_of_pictures().texels_per_pixel;
        if let Some(stats) = renderer.map_stats()
            && stats.panes > 0
            && stats.texels_per_pixel < 0.99 * wanted
        {
            eprintln!(
                "the map had room for {:.1} texels a pixel along each axis instead of {wanted}; a smaller --size has more",
                stats.texels_per_pixel
            );
        }
    }

    fn submit(&mut self, gaze: &Gaze) -> Result<(), Error> {
        if let Way::Drawn(renderer) = &mut self.way
            && renderer.transforms(self.options.effects)
        {
            renderer.submit(self.gpu, gaze.eye, gaze.ct)?;
        }
        Ok(())
    }

    fn take(&mut self, gaze: &Gaze, elapsed_s: Option<f64>) -> Result<RgbaImage, Error> {
        let shot = shot(gaze, self.options.fov, self.options.effects);
        let development = self.options.development();
        Ok(match &mut self.way {
            Way::Drawn(renderer) => self.studio.photograph(self.gpu, renderer, &shot, &development, elapsed_s)?,
            Way::Traced(tracer) => {
                let traced = traced(tracer, &shot, &self.options)?;
                self.studio.develop(self.gpu, &traced.texels(), traced.stored, &development, elapsed_s)?
            }
        })
    }
}

/// Traces a picture, and says how much of it there is if it was interrupted.
fn traced(tracer: &RayTracer, shot: &Shot, options: &PictureOptions) -> Result<Traced, Error> {
    let bar = progress::bar("tracing rays", RayTracer::tile_count(options.size));
    let traced = tracer.trace(shot, options.size, options.samples, &interruption(), || bar.inc(1));
    bar.finish_and_clear();
    if traced.done == 0 {
        return Err(Error::Interrupted);
    }
    if traced.done < traced.tiles {
        eprintln!("interrupted: {} of {} tiles are done, the others are black", traced.done, traced.tiles);
    }
    Ok(traced)
}

/// A gaze through a camera of `fov` degrees.
pub fn shot(gaze: &Gaze, fov: f64, effects: Effects) -> Shot {
    let field = Field::Ahead { fov_y_rad: fov.to_radians() };
    let camera = Camera { observer_from_eye: gaze.observer_from_eye, field };
    Shot { camera, eye: gaze.eye, ct: gaze.ct, effects, stored_scale: None }
}

/// Looks before long work whether its result can be put there.
///
/// # Errors
/// [`Error::Write`]: a folder of that name is in the way, or the folder that it belongs in is missing.
pub fn writable(path: &Path) -> Result<(), Error> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let reason = if path.is_dir() {
        "it is a folder".to_owned()
    } else if !folder.is_dir() {
        format!("there is no folder {}", folder.display())
    } else {
        return Ok(());
    };
    Err(Error::Write { path: path.to_owned(), reason })
}

/// Writes a picture as PNG.
///
/// # Errors
/// [`Error::Write`] with the path and the reason.
pub fn save(picture: &RgbaImage, path: &Path) -> Result<(), Error> {
    picture
        .save_with_format(path, image::ImageFormat::Png)
        .map_err(|error| Error::Write { path: path.to_owned(), reason: error.to_string() })
}

/// A flag that Ctrl-C (or a request to end) sets, so that what was done so far can be finished; the second one ends at once.
pub fn interrupted() -> Arc<AtomicBool> {
    let flag = interruption();
    flag.store(false, Ordering::Relaxed);
    flag
}

/// The same flag as it is, for work that began before.
fn interruption() -> Arc<AtomicBool> {
    static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    let flag = FLAG.get_or_init(|| {
        let flag = Arc::new(AtomicBool::new(false));
        let set = Arc::clone(&flag);
        // Fails only if there is a handler already, and there is no other than this one.
        let _ = ctrlc::set_handler(move || {
            if set.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        flag
    });
    Arc::clone(flag)
}
