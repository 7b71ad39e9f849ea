//! Maker of pictures: one scene, one method of drawing, one projection.

use crate::moment::FilmView;
use image::{Rgb32FImage, RgbaImage};
use render::certainty::Certainty;
use render::display::Seen;
use render::{Gpu, GpuError, Pending, SceneRenderer};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use studio::{Darkroom, Developing, Studio, light, upload};
use thiserror::Error;
use trace::{RayTracer, Traced};
use view::{Field, Framing, Optics, Projection, Shot, TurningEye};
use walls::{ProjectedPicture, ProjectedView, Quality, StereoEyes};

/// Reason why a picture was not made.
#[derive(Debug, Error)]
pub enum MakerError {
    /// A graphics device that is missing or lost.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// An interruption before anything of the picture was there.
    #[error("interrupted before anything was traced, so nothing was written")]
    Interrupted,
}

/// Size and projection of the pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MakerOptions {
    /// Width and height for each eye, pixels.
    pub size: [u32; 2],
    /// Samples of each pixel.
    pub samples: u32,
    /// Map from places of the picture to directions.
    pub projection: Projection,
    /// Eyes of a stereo picture.
    pub stereo: Option<StereoEyes>,
    /// Lens of the camera.
    pub optics: Optics,
    /// True if light is exposed alone, for a screen of a high dynamic range.
    pub exposes_alone: bool,
}

impl MakerOptions {
    /// Shots of a flat picture that is drawn once for each place of the lens and moment of the exposure; `None` if one
    /// is enough.
    fn many(&self, shot: &Shot, view: &FilmView) -> Option<Vec<Shot>> {
        if shot.outside.is_some() || self.optics.is_pinhole() && view.exposure.is_instant() {
            return None;
        }
        let samples = self.samples.max(Optics::LEAST_SAMPLES);
        Some((0..samples).map(|sample| self.optics.shot(shot, &view.exposure, self.size, sample)).collect())
    }

    fn darkroom(&self, gpu: &Gpu) -> Darkroom {
        let format = Studio::format(gpu).colour;
        if self.exposes_alone {
            Darkroom::exposing(gpu, self.size, format)
        } else {
            Darkroom::new(gpu, self.size, format)
        }
    }
}

/// Share of a traced picture that is finished: tiles done, and all tiles.
pub type TracedPart = (usize, usize);

/// Maker of the pictures of one scene.
pub struct PictureMaker {
    options: MakerOptions,
    way: Way,
}

/// Way in which the light of a picture is found.
enum Way {
    /// Flat picture of one eye, drawn on the device.
    Flat(Box<SceneRenderer>, Box<Studio>),
    /// Picture of any other kind, drawn on the device.
    Projected(Box<SceneRenderer>, Box<ProjectedPicture>, Box<Darkroom>),
    /// Rays, on the CPU.
    Rays(Box<RayTracer>, Box<Darkroom>, Arc<AtomicBool>),
}

/// Picture that is being made: what is not there yet is on its way from the device.
#[must_use = "what is not finished was drawn in vain"]
pub struct Taking {
    developing: Developing,
    /// Finished share of a picture whose tracing was interrupted.
    pub interrupted: Option<TracedPart>,
}

impl Taking {
    /// Waits for the pictures of the eyes, the left one first.
    ///
    /// # Errors
    /// [`GpuError`] if the device went away.
    pub fn finish(self, gpu: &Gpu) -> Result<Vec<RgbaImage>, GpuError> {
        self.developing.finish(gpu)
    }

    /// Waits for light that was exposed alone.
    ///
    /// # Errors
    /// [`GpuError`] if the device went away.
    pub fn finish_exposed(self, gpu: &Gpu) -> Result<Vec<Rgb32FImage>, GpuError> {
        self.developing.finish_exposed(gpu)
    }
}

impl PictureMaker {
    /// Maker that draws on the device, by a renderer that draws into [`Studio::format`].
    pub fn drawn(gpu: &Gpu, renderer: SceneRenderer, options: MakerOptions) -> Self {
        let MakerOptions { size, samples, projection, stereo, .. } = options;
        let darkroom = options.darkroom(gpu);
        let renderer = Box::new(renderer);
        let way = if projection == Projection::Flat && stereo.is_none() {
            let studio = Studio::with_darkroom(gpu, size, samples, Studio::format(gpu), darkroom);
            Way::Flat(renderer, Box::new(studio))
        } else {
            let format = Studio::format(gpu);
            // With one sample a pixel has the colour of the nearest of many rays; else rays are mixed.
            let (density, smooth) = if samples == 1 { (3.0, false) } else { (1.5, true) };
            let quality = Quality { format, samples, density, smooth };
            let picture = ProjectedPicture::new(gpu, projection, size, stereo, quality);
            Way::Projected(renderer, Box::new(picture), Box::new(darkroom))
        };
        Self { options, way }
    }

    /// Maker that follows rays until `stop` is set.
    pub fn traced(gpu: &Gpu, tracer: RayTracer, options: MakerOptions, stop: Arc<AtomicBool>) -> Self {
        Self { options, way: Way::Rays(Box::new(tracer), Box::new(options.darkroom(gpu)), stop) }
    }

    /// Renderer on the device, if one draws.
    pub fn renderer(&self) -> Option<&SceneRenderer> {
        match &self.way {
            Way::Flat(renderer, _) | Way::Projected(renderer, ..) => Some(renderer),
            Way::Rays(..) => None,
        }
    }

    /// Number of tiles of all traced pictures of a moment; 0 if none are traced.
    pub fn tiles(&self) -> u64 {
        let eyes = if self.options.stereo.is_some() { 2 } else { 1 };
        if self.renderer().is_some() { 0 } else { eyes * RayTracer::tile_count(self.options.size) }
    }

    /// Begins what can be worked out of a picture beside other drawing.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn submit(&mut self, gpu: &Gpu, view: &FilmView) -> Result<Pending, GpuError> {
        match &mut self.way {
            Way::Flat(renderer, _) if self.options.many(&view.shot(), view).is_none() => {
                renderer.submit(gpu, &view.gaze.observer, view.effects)
            }
            Way::Flat(..) => Ok(Pending::default()),
            Way::Projected(renderer, picture, _) => picture.submit(gpu, renderer, &projected(view)),
            Way::Rays(..) => Ok(Pending::default()),
        }
    }

    /// Begins to make the pictures of all eyes. `pending` is what [`submit`](Self::submit) gave for the view;
    /// `tile_done` is called for each tile that is traced.
    ///
    /// # Errors
    /// [`MakerError`]: a lost device, or an interruption before the first tile.
    pub fn begin(
        &mut self,
        gpu: &Gpu,
        view: &FilmView,
        pending: Pending,
        tile_done: &(dyn Fn() + Sync),
    ) -> Result<Taking, MakerError> {
        let FilmView { development, elapsed_s, .. } = *view;
        let options = self.options;
        match &mut self.way {
            Way::Flat(renderer, studio) => {
                let shot = view.drawn_shot();
                if let Some(shots) = options.many(&shot, view) {
                    let developing = studio.begin_of_many(gpu, renderer, &shots, &development, elapsed_s)?;
                    return Ok(Taking { developing, interrupted: None });
                }
                let developing = studio.begin(gpu, renderer, &shot, pending, &development, elapsed_s)?;
                Ok(Taking { developing, interrupted: None })
            }
            Way::Projected(renderer, picture, darkroom) => {
                picture.draw(gpu, renderer, &projected(view), pending)?;
                let stored = picture.stored();
                let lights = picture.lights();
                let seen: Vec<_> = lights.into_iter().map(|radiance| Seen { radiance, stored, elapsed_s }).collect();
                Ok(Taking { developing: darkroom.begin(gpu, &seen, &development), interrupted: None })
            }
            Way::Rays(tracer, darkroom, stop) => {
                let traced = trace(tracer, &options, view, stop, tile_done)?;
                let format = Studio::format(gpu).colour;
                let upload = |traced: &Traced| (upload(gpu, traced.size, &traced.texels(), format), traced.stored);
                let lights: Vec<_> = traced.iter().map(upload).collect();
                let seen: Vec<_> =
                    lights.iter().map(|(radiance, stored)| Seen { radiance, stored: *stored, elapsed_s }).collect();
                Ok(Taking { developing: darkroom.begin(gpu, &seen, &development), interrupted: unfinished(&traced) })
            }
        }
    }

    /// Light of the pictures of all eyes, the left one first: linear sRGB in cd/m². With the finished share, if the
    /// tracing was interrupted.
    ///
    /// # Errors
    /// Those of [`begin`](Self::begin).
    pub fn light(
        &mut self,
        gpu: &Gpu,
        view: &FilmView,
        pending: Pending,
        tile_done: &(dyn Fn() + Sync),
    ) -> Result<(Vec<Rgb32FImage>, Option<TracedPart>), MakerError> {
        let options = self.options;
        match &mut self.way {
            Way::Flat(renderer, studio) => {
                let shot = view.drawn_shot();
                let light = match options.many(&shot, view) {
                    Some(shots) => studio.expose_many(gpu, renderer, &shots)?,
                    None => studio.expose(gpu, renderer, &shot, pending)?,
                };
                Ok((vec![light], None))
            }
            Way::Projected(renderer, picture, _) => {
                picture.draw(gpu, renderer, &projected(view), pending)?;
                let stored = picture.stored();
                let lights = picture.lights().into_iter().map(|radiance| light(gpu, radiance, &stored));
                Ok((lights.collect::<Result<_, _>>()?, None))
            }
            Way::Rays(tracer, _, stop) => {
                let traced = trace(tracer, &options, view, stop, tile_done)?;
                Ok((traced.iter().map(Traced::image).collect(), unfinished(&traced)))
            }
        }
    }

    /// Estimated errors of directions in the picture drawn last. `None` if it was traced.
    pub fn certainty(&self, view: &FilmView) -> Option<Certainty> {
        match &self.way {
            Way::Flat(renderer, _) => Some(renderer.certainty(&view.drawn_shot(), self.options.size)),
            Way::Projected(_, picture, _) => Some(picture.certainty()),
            Way::Rays(..) => None,
        }
    }
}

/// View without what only a flat picture of one eye can show.
fn projected(view: &FilmView) -> ProjectedView {
    ProjectedView { gaze: view.gaze, fov_deg: view.fov_deg, effects: view.effects }
}

/// Traced pictures of all eyes.
fn trace(
    tracer: &mut RayTracer,
    options: &MakerOptions,
    view: &FilmView,
    stop: &AtomicBool,
    tile_done: &(dyn Fn() + Sync),
) -> Result<Vec<Traced>, MakerError> {
    let MakerOptions { size, samples, projection, stereo, .. } = *options;
    let mut traced = Vec::new();
    for aside_m in stereo.map_or(vec![None], |eyes| [-0.5, 0.5].map(|side| Some(side * eyes.separation_m)).to_vec()) {
        let mut shot = view.shot();
        let mut eye = None;
        let mut exposure = view.exposure.clone();
        if let (Some(eyes), Some(aside_m)) = (stereo, aside_m) {
            if projection == Projection::Flat {
                shot = on_wall(&shot, size, aside_m, eyes.wall_m);
                exposure = exposure.aside(glam::DVec3::X * aside_m);
            } else {
                let upright = if matches!(projection, Projection::Fisheye { .. } | Projection::Cube) {
                    eyes.upright
                } else {
                    glam::DVec3::Y
                };
                eye = Some(TurningEye { aside_m, upright });
            }
        }
        tracer.framing = Framing { projection, eye };
        tracer.exposure = exposure;
        let picture = tracer.trace(&shot, size, samples, stop, tile_done);
        if picture.done == 0 {
            return Err(MakerError::Interrupted);
        }
        let is_interrupted = stop.load(Ordering::Relaxed);
        traced.push(picture);
        if is_interrupted && traced.len() == 1 && stereo.is_some() {
            // The other eye would be black.
            return Err(MakerError::Interrupted);
        }
    }
    Ok(traced)
}

/// Shot of an eye aside of the head's middle, through the window that a wall is in its picture.
fn on_wall(shot: &Shot, size: [u32; 2], aside_m: f64, wall_m: f64) -> Shot {
    let mut shot = *shot;
    let mut tangents = shot.camera.tangents(size);
    tangents.low.x -= aside_m / wall_m;
    tangents.high.x -= aside_m / wall_m;
    shot.observer = shot.observer.at_offset(shot.camera.observer_from_eye * (glam::DVec3::X * aside_m));
    shot.camera.field = Field::Screen(tangents);
    shot
}

/// Finished share of pictures, if any is unfinished.
fn unfinished(traced: &[Traced]) -> Option<TracedPart> {
    let (done, tiles) = traced.iter().fold((0, 0), |(done, tiles), one| (done + one.done, tiles + one.tiles));
    (done < tiles).then_some((done, tiles))
}
