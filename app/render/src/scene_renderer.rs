//! A scene, and whichever method draws it.

use super::certainty::{Certainty, Drawn, Edges};
use super::display::Stored;
use super::image::{ImageRenderer, MapQuality, MapStats, Movers};
use super::moving::{self, Axes};
use super::polygon::{Adaptive, CutStats, PhotoSurface, Tolerance, Transformed, VertexStage};
use super::target::{Format, Radiance};
use super::world::{Draws, Mode, Part, World};
use super::{Effects, polygon};
use crate::gpu::{Gpu, GpuError};
use scene::Scene;
use scene::cut::Sight;
use scene::motion::Motion;
use crate::view_matrix::{matrix, shader_view};
use glam::{DMat4, DVec2, Vec4};
use physics::photo_surface::{Eye, PhotoSurfaceError};
use physics::{Celerity, Event, Observer};

/// What a picture shows of the surfaces that are seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// Their light.
    #[default]
    Light,
    /// Their places: x, y and z in metres, relative to the scene's origin, and 1; zeros where no surface is. Of what has motion i, in its own
    /// frame, and 2 + i.
    Places,
}

/// How a scene is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// The photo-surface of every vertex, worked out beside the drawing.
    Polygon,
    /// The same, worked out by the GPU's vertex stage but for what lies astern.
    VertexStage,
    /// The same, of a scene that is cut for every picture.
    Adaptive(Tolerance),
    /// A map of the world around the eye, of this quality; what moves is drawn over it as polygons.
    Image(MapQuality),
}

/// A scene, ready to be drawn by one method into targets of one format.
///
/// A picture takes three steps: [`SceneRenderer::submit`] begins the photo-surface beside whatever is drawn meanwhile and
/// [`SceneRenderer::show`] waits for it (where the method has one); [`SceneRenderer::prepare`] draws what every sample of the picture
/// shares; [`SceneRenderer::draw`] draws a sample.
pub struct SceneRenderer {
    world: World,
    way: Way,
    /// Some edges of the scene, and what moves in it.
    edges: Edges,
    motions: Vec<Motion>,
    format: Format,
    /// What pictures show.
    pub subject: Subject,
}

enum Way {
    Polygon(Box<PhotoSurface>),
    VertexStage(Box<VertexStage>),
    Adaptive(Box<Adaptive>),
    Image(Box<ImageRenderer>, Option<Box<Movers>>),
}

impl SceneRenderer {
    /// Uploads `scene`. `background`: linear radiance instead of the scene's sky.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Origin`] if the scene's origin is not finite.
    pub fn new(
        gpu: &Gpu,
        scene: &Scene,
        format: Format,
        background: Option<[f32; 3]>,
        method: Method,
    ) -> Result<Self, PhotoSurfaceError> {
        let way = match method {
            Method::Polygon => Way::Polygon(Box::new(PhotoSurface::new(gpu, scene)?)),
            // What is animated is solved on the CPU, and the rest goes with it.
            Method::VertexStage if scene.motions.iter().any(|motion| motion.animated().is_some()) => {
                Way::Polygon(Box::new(PhotoSurface::new(gpu, scene)?))
            }
            Method::VertexStage => Way::VertexStage(Box::new(VertexStage::new(gpu, scene)?)),
            Method::Adaptive(tolerance) => Way::Adaptive(Box::new(Adaptive::new(scene, tolerance))),
            Method::Image(quality) => {
                let movers = Movers::of(gpu, scene, quality).map(Box::new);
                Way::Image(Box::new(ImageRenderer::new(gpu, format, quality, movers.is_some())), movers)
            }
        };
        let edges = if matches!(way, Way::Image(..)) { Edges::of_resting(scene) } else { Edges::of(scene) };
        let motions = scene.motions.clone();
        Ok(Self { world: World::new(gpu, scene, background), way, edges, motions, format, subject: Subject::Light })
    }

    /// Triangles that a draw of everything takes.
    pub fn triangle_count(&self) -> u64 {
        self.world.triangle_count()
    }

    /// Name of the method.
    pub fn name(&self) -> &'static str {
        match self.way {
            Way::Polygon(_) | Way::VertexStage(_) | Way::Adaptive(_) => "polygon",
            Way::Image(..) => "image",
        }
    }

    /// Luminance that is white at rest, cd/m².
    pub fn white_luminance(&self) -> f64 {
        self.world.spectra.white_luminance
    }

    /// How targets hold the light of a shot.
    pub fn stored(&self, shot: &Shot) -> Stored {
        Stored {
            white: self.white_luminance(),
            scale: shot.scale(),
            shifted: shot.effects.shift_light() && (shot.celerity() != Celerity::ZERO || !self.motions.is_empty()),
        }
    }

    /// What the newest map cost, where the method has one.
    pub fn map_stats(&self) -> Option<MapStats> {
        match &self.way {
            Way::Image(image, _) => Some(image.stats()),
            Way::Polygon(_) | Way::VertexStage(_) | Way::Adaptive(_) => None,
        }
    }

    /// What the newest cut is, where the scene is cut for every picture.
    pub fn cut_stats(&self) -> Option<CutStats> {
        if let Way::Adaptive(adaptive) = &self.way { adaptive.stats() } else { None }
    }

    /// How far from their places things are drawn in the picture of a shot that was drawn last.
    pub fn certainty(&self, shot: &Shot, size: [u32; 2]) -> Certainty {
        if !shot.effects.geometry {
            return Certainty::default();
        }
        let (edges, drawn) = match &self.way {
            Way::Polygon(_) | Way::VertexStage(_) => (&self.edges, Drawn::ByKernel),
            Way::Adaptive(adaptive) => (adaptive.edges().unwrap_or(&self.edges), Drawn::InFull),
            Way::Image(image, _) => (&self.edges, Drawn::FromMap { texels_per_pixel: image.stats().texels_per_pixel }),
        };
        let observer = shot.observer();
        let sight = |motion| Sight::of(self.world.origin, &self.motions, &observer, motion);
        let certainty = Certainty::of(edges, sight, shot, size, drawn);
        match &self.way {
            Way::Image(_, Some(movers)) => movers
                .edges()
                .map_or(certainty, |edges| certainty.or_worse(Certainty::of(edges, sight, shot, size, Drawn::InFull))),
            _ => certainty,
        }
    }

    /// How the observer of a shot sees what rests, then each motion.
    pub fn sights(&self, shot: &Shot) -> Vec<Sight> {
        let observer = shot.observer();
        let sight = |motion| Sight::of(self.world.origin, &self.motions, &observer, motion);
        std::iter::once(None).chain((0..self.motions.len()).map(Some)).map(sight).collect()
    }

    /// Whether pictures with these effects need a photo-surface.
    pub fn transforms(&self, effects: Effects) -> bool {
        effects.geometry && matches!(self.way, Way::Polygon(_))
    }

    /// Begins the photo-surface for an eye at world time `ct`, beside whatever is drawn meanwhile.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn submit(&mut self, gpu: &Gpu, eye: Eye, ct: f64) -> Result<(), GpuError> {
        let (observer, eyes) = (observer(eye, ct), eyes(&self.motions, eye, ct));
        self.photo_surface_mut().map_or(Ok(()), |surface| surface.submit(gpu, observer, eyes))
    }

    /// Photo-surfaces begun and not yet received.
    pub fn pending(&self) -> usize {
        self.photo_surface().map_or(0, PhotoSurface::pending)
    }

    /// Waits for the oldest photo-surface begun and not yet drawn.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if there is none.
    pub fn receive(&mut self) -> Result<Transformed, GpuError> {
        let none = || GpuError::Lost("no photo-surface was asked for".to_owned());
        self.photo_surface_mut().ok_or_else(none)?.receive()
    }

    /// Waits for the oldest photo-surface begun, and throws it away.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if there is none.
    pub fn discard(&mut self) -> Result<(), GpuError> {
        self.photo_surface_mut().map_or(Ok(()), PhotoSurface::discard)
    }

    /// Makes a photo-surface the one that draws show.
    pub fn show(&self, gpu: &Gpu, transformed: Transformed) {
        if let Some(surface) = self.photo_surface() {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            surface.upload(&mut encoder, transformed);
            gpu.queue.submit([encoder.finish()]);
        }
    }

    fn photo_surface(&self) -> Option<&polygon::PhotoSurface> {
        if let Way::Polygon(surface) = &self.way { Some(surface) } else { None }
    }

    fn photo_surface_mut(&mut self) -> Option<&mut polygon::PhotoSurface> {
        if let Way::Polygon(surface) = &mut self.way { Some(surface) } else { None }
    }

    /// Waits for whatever goes on beside the drawing.
    pub fn settle(&self) {
        if let Way::Adaptive(adaptive) = &self.way {
            adaptive.settle();
        }
    }

    /// Draws into targets of another format from now on; a map, if there is one, is then made anew in this quality.
    pub fn draw_in(&mut self, gpu: &Gpu, format: Format, quality: Option<MapQuality>) {
        self.format = format;
        if let (Way::Image(image, movers), Some(quality)) = (&mut self.way, quality) {
            **image = ImageRenderer::new(gpu, format, quality, movers.is_some());
        }
    }

    /// Makes what all samples of a picture share: the map or the cut, where the method has one.
    pub fn prepare(&mut self, gpu: &Gpu, shot: &Shot, size: [u32; 2]) {
        self.prepare_eye(gpu, &[(*shot, size)]);
        self.prepare_picture(gpu, shot, size);
    }

    /// Makes what all pictures of one eye at one moment share, each of so many pixels.
    pub fn prepare_eye(&mut self, gpu: &Gpu, shots: &[(Shot, [u32; 2])]) {
        let Some((shot, _)) = shots.first() else { return };
        self.world.light_animated(gpu, &shot.observer(), shot.effects.geometry);
        match &mut self.way {
            Way::Image(_, Some(movers)) if shot.effects.geometry => movers.cut(gpu, shots),
            Way::VertexStage(stage) if shot.effects.geometry => {
                stage.bend(gpu, &eyes(&self.motions, shot.eye, shot.ct));
            }
            Way::Adaptive(adaptive) if shot.effects.geometry => adaptive.cut(gpu, &mut self.world, shots),
            _ => {}
        }
    }

    /// Makes what all samples of one picture share, after [`SceneRenderer::prepare_eye`].
    pub fn prepare_picture(&mut self, gpu: &Gpu, shot: &Shot, size: [u32; 2]) {
        if let Way::Image(image, _) = &mut self.way
            && shot.effects.geometry
        {
            image.draw_map(gpu, &mut self.world, shot, size, self.subject);
        }
    }

    /// Draws one sample of a picture, at `offset` pixels from each pixel's centre. One submission has room for one.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &Radiance,
        shot: &Shot,
        offset: DVec2,
    ) {
        let (celerity, geometry) = (shot.celerity(), shot.effects.geometry);
        let mut view = shot.camera.view(target.size, offset, celerity, geometry, shot.scale());
        let observer = shot.observer();
        let mut moving = Vec::with_capacity(self.motions.len());
        let mut bends = false;
        let streams = match &self.way {
            Way::Image(..) if geometry => {
                let of_motion = |motion| moving::view(&view, motion, &observer, Axes::Observer);
                moving.extend(self.motions.iter().map(of_motion));
                None
            }
            Way::Polygon(surface) if geometry => {
                let of_motion = |motion| moving::view(&view, motion, &observer, Axes::Group);
                moving.extend(self.motions.iter().map(of_motion));
                Some(surface.streams.clone())
            }
            Way::VertexStage(stage) if geometry => {
                let of_motion = |motion| moving::view(&view, motion, &observer, Axes::Group);
                moving.extend(self.motions.iter().map(of_motion));
                let eyes = eyes(&self.motions, shot.eye, shot.ct);
                for (view, eye) in std::iter::once(&mut view).chain(&mut moving).zip(&eyes) {
                    *view = stage.view(*view, eye);
                }
                bends = true;
                Some(stage.streams.clone())
            }
            Way::Adaptive(adaptive) if geometry && adaptive.streams().is_some() => {
                let of_motion = |motion| moving::view(&view, motion, &observer, Axes::Observer);
                moving.extend(self.motions.iter().map(of_motion));
                adaptive.streams().cloned()
            }
            _ => {
                // The plain world: positions are relative to its origin, not to the eye.
                let of_motion = |motion| moving::plain_view(&view, motion, &observer, self.world.origin);
                moving.extend(self.motions.iter().map(of_motion));
                let eye_from_origin = DMat4::from_translation(self.world.origin - shot.eye.position());
                view.clip_from_observer *= matrix(&eye_from_origin);
                None
            }
        };
        let mode = match self.subject {
            Subject::Light => Mode::Light(shot.effects),
            Subject::Places => Mode::Places,
        };
        let sights = &self.sights(shot)[1..];
        // Places say whose they are.
        let of =
            |(number, view): (usize, shaders::View)| shaders::View { layer: Vec4::X * (1 + number) as f32, ..view };
        let views: Vec<shaders::View> = std::iter::once(view).chain(moving.into_iter().enumerate().map(of)).collect();

        if let (Way::Image(image, movers), true) = (&mut self.way, geometry) {
            self.world.write_views(gpu, &views[..1]);
            if let Some(movers) = movers {
                movers.prepare(gpu, &views, mode, self.format);
            }
            let mut pass = target.begin(encoder);
            image.draw(gpu, &self.world, &mut pass, shot.effects, self.subject);
            if let Some(movers) = movers {
                movers.draw(gpu, &mut pass, shot, sights, mode, self.format);
            }
            return;
        }
        self.world.prepare(gpu, mode, bends, self.format);
        self.world.write_views(gpu, &views);
        let draws = Draws {
            streams: streams.as_ref(),
            bends,
            mode,
            format: self.format,
            eye: shot.eye.position(),
            moving: sights,
            sky: true,
        };
        self.world.draw(gpu, &mut target.begin(encoder), &draws, &[Part::WHOLE]);
    }
}

/// An eye as what rests has it, then as each motion has it.
fn eyes(motions: &[Motion], eye: Eye, ct: f64) -> Vec<Eye> {
    let observer = observer(eye, ct);
    let moving = motions.iter().map(|motion| moving::eye(motion, &observer).unwrap_or(eye));
    std::iter::once(eye).chain(moving).collect()
}

/// Who looks through an eye at world time `ct`.
fn observer(eye: Eye, ct: f64) -> Observer {
    let event = Event { ct, position: eye.position() };
    Observer { event, celerity: Celerity::new(eye.celerity()).unwrap_or_default() }
}
