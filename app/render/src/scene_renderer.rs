//! A scene, and the method that draws it.

use crate::certainty::{Certainty, Edges, EdgesDrawn};
use crate::gpu::{Gpu, GpuError};
use crate::image::{ImageRenderer, MapQuality};
use crate::method::{Method, Sample};
use crate::moving_objects;
use crate::outside::{Marks, outside_views};
use crate::pending::Pending;
use crate::polygon::{Adaptive, PhotoSurface, VertexStage, place_streams, write_places};
use crate::stats::{CutStats, DrawCounts, MapStats};
use crate::subject::Subject;
use crate::target::{Format, Radiance};
use crate::view_matrix::{matrix, shader_view};
use crate::world::{World, gather};
use glam::{DMat4, DQuat, DVec2, DVec3, Vec4};
use physics::photo_surface::PhotoSurfaceError;
use physics::{Celerity, Observer};
use scene::Scene;
use scene::cut::SeenFrom;
use scene::motion::{Animated, Motion};
use std::sync::Arc;
use std::time::Duration;
use view::{Dial, Effects, Occasion, PixelSample, Places, RendererName, Shot, Sides, Stored, Transform};

/// Pixels by which pictures are taken to be wider than they are, so that nothing is left out that a sample beside the
/// middle of its pixel sees.
const MARGIN_PIXELS: f64 = 4.0;

/// Texels of the map per pixel, along each axis, if the dial does not say.
const USUAL_MAP_SCALE: f64 = 1.0;

/// A scene, ready to be drawn by one method into targets of one format.
///
/// A picture takes three steps. [`SceneRenderer::submit`] begins the photo-surface, in parallel with other drawing,
/// and [`SceneRenderer::show`] waits for it; a method without a photo-surface is ready at once.
/// [`SceneRenderer::prepare`] draws everything that all samples of the picture share. [`SceneRenderer::draw`] draws a
/// sample.
pub struct SceneRenderer {
    world: World,
    method: Box<dyn Method>,
    /// Sample of the scene's edges.
    edges: Edges,
    motions: Vec<Motion>,
    /// Meshes of the scene, if it may be drawn in another way than the method's: if anything is animated, each vertex
    /// is measured at its own event, and a map is seen from outside by `polygon`.
    scene: Option<Arc<Scene>>,
    /// Measured places of all vertices, if more than clockwork is animated and the pictures show what is measured.
    measured: Option<wgpu::Buffer>,
    /// Method by which a map's scene is drawn from outside, while it is. The world then shows its cut.
    outside: Option<Adaptive>,
    /// Marks of the observer, once a picture was drawn from outside.
    marks: Option<Marks>,
    format: Format,
    occasion: Occasion,
    /// Tolerance of cuts, pixels.
    tolerance_px: f64,
    /// Content of pictures.
    pub subject: Subject,
}

/// Screen that is not flat, as an eye in a room sees it.
#[derive(Clone, Copy, Debug)]
pub struct BentScreen<'a> {
    /// Point of the room that each pixel of the picture shows, metres, as four f32; the last is 0 where nothing is lit.
    pub points: &'a wgpu::TextureView,
    /// Eye in the room, metres.
    pub eye_m: DVec3,
    /// Rotation from the room's axes to the observer's.
    pub observer_from_room: DQuat,
}

/// Cost of a photo-surface, and its flaws.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TransformReport {
    /// Time that the transform took.
    pub duration: Duration,
    /// Vertices without a finite apparent position, which are not drawn.
    pub not_finite: usize,
}

impl SceneRenderer {
    /// Uploads `scene`, to be drawn as `dial` says. `background`: linear radiance instead of the scene's sky. What the
    /// device holds is dropped from memory on the way.
    ///
    /// The dial must come from [`Choice`](crate::choice::Choice), or name its method: `Auto` is drawn by `polygon`. The
    /// scene is drawn as it is, even if the dial has an edge: cutting it once is the caller's.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Origin`] if the scene's origin is not finite.
    pub fn new(
        gpu: &Gpu,
        mut scene: Scene,
        format: Format,
        background: Option<[f32; 3]>,
        dial: Dial,
        occasion: Occasion,
    ) -> Result<Self, PhotoSurfaceError> {
        let image = dial.renderer == RendererName::Image;
        // The map shows the resting scene; moving bodies have edges of their own there.
        let edges = if image { Edges::of_resting(&scene) } else { Edges::of(&scene) };
        let motions = scene.motions.clone();
        let method = fixed_method(gpu, &scene, format, dial, occasion)?;
        let textures = std::mem::take(&mut scene.textures);
        gather(&mut scene);
        let scene = Arc::new(scene);
        let animated = motions.iter().any(|motion| motion.animated().is_some());
        let kept = (animated || image).then(|| Arc::clone(&scene));
        let tolerance_px = dial.tolerance.unwrap_or(occasion.usual_tolerance());
        let (world, method) = match method {
            Some(method) => (World::new(gpu, &scene, textures, background), method),
            None => {
                let world = World::to_be_cut(gpu, &scene, textures, background);
                let method: Box<dyn Method> = Box::new(Adaptive::new(scene, tolerance_px, occasion));
                (world, method)
            }
        };
        Ok(Self {
            world,
            method,
            edges,
            motions,
            scene: kept,
            measured: None,
            outside: None,
            marks: None,
            format,
            occasion,
            tolerance_px,
            subject: Subject::Light,
        })
    }

    /// Number of triangles that a draw of everything takes.
    pub fn triangle_count(&self) -> u64 {
        self.world.triangle_count()
    }

    /// Name of the method.
    pub fn name(&self) -> &'static str {
        self.method.name()
    }

    /// Luminance of what is white at rest, cd/m².
    pub fn white_luminance(&self) -> f64 {
        self.world.spectra.white_luminance
    }

    /// Scale in which targets hold the light of a shot.
    pub fn stored(&self, shot: &Shot) -> Stored {
        let moves = shot.observer.celerity != Celerity::ZERO || !self.motions.is_empty();
        Stored {
            white: self.white_luminance(),
            scale: shot.scale(),
            shifted: shot.shows_light() && shot.effects.shift_light() && moves,
        }
    }

    /// Triangles drawn since the last call of this function, and the calls that drew them, shadows not counted.
    pub fn take_drawn(&self) -> DrawCounts {
        let of_method = self.method.take_drawn();
        let DrawCounts { triangles, calls } = self.world.take_drawn();
        DrawCounts { triangles: triangles + of_method.triangles, calls: calls + of_method.calls }
    }

    /// Cost of the newest map, if the method has one.
    pub fn map_stats(&self) -> Option<MapStats> {
        self.method.map_stats()
    }

    /// Size and accuracy of the newest cut, if the scene is cut for every picture.
    pub fn cut_stats(&self) -> Option<CutStats> {
        self.method.cut_stats()
    }

    /// Estimated errors of directions in the picture of a shot that was drawn last.
    pub fn certainty(&self, shot: &Shot, size: [u32; 2]) -> Certainty {
        // From outside there are no directions of sight.
        if !shot.effects.bend() || shot.outside.is_some() {
            return Certainty::default();
        }
        let sight = |motion| SeenFrom::of(self.world.origin, &self.motions, &shot.observer, motion);
        let estimate = |edges: &Edges, drawn: EdgesDrawn| Certainty::of(edges, sight, shot, size, drawn);
        self.method.certainty(&self.edges, &estimate)
    }

    /// View of the resting scene from the observer of a shot, then the view of each motion: as measured, if the shot
    /// shows that, else as seen.
    pub fn sights(&self, shot: &Shot) -> Vec<SeenFrom> {
        let of = if shot.effects.places == Places::Measured { SeenFrom::measured } else { SeenFrom::of };
        let sight = |motion| of(self.world.origin, &self.motions, &shot.observer, motion);
        std::iter::once(None).chain((0..self.motions.len()).map(Some)).map(sight).collect()
    }

    /// Begins the photo-surface for an observer, in parallel with other drawing. Empty if pictures with these effects
    /// need none.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn submit(&mut self, gpu: &Gpu, observer: &Observer, effects: Effects) -> Result<Pending, GpuError> {
        if !effects.bend() {
            return Ok(Pending::default());
        }
        self.method.submit(gpu, moving_objects::observers(&self.motions, observer))
    }

    /// Waits for a photo-surface of this renderer, and has the next pictures drawn from it.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if its memory went away with the device.
    pub fn show(&mut self, gpu: &Gpu, pending: Pending) -> Result<TransformReport, GpuError> {
        let Some(transformed) = pending.wait()? else { return Ok(TransformReport::default()) };
        let report = TransformReport { duration: transformed.duration, not_finite: transformed.stats.not_finite() };
        self.method.show(gpu, transformed);
        Ok(report)
    }

    /// True if nothing in the scene moves, so that an observer at rest sees the same at all times.
    pub fn is_still(&self) -> bool {
        self.motions.is_empty()
    }

    /// True if nothing that moves can be seen in the picture of a shot, so that an observer at rest sees the same in it
    /// at all times.
    pub fn is_still_in(&self, shot: &Shot, size: [u32; 2]) -> bool {
        let sides = Sides::of(&shot.camera, size, MARGIN_PIXELS);
        let at_rest = Observer { celerity: Celerity::ZERO, ..shot.observer };
        let sight = match shot.effects.places {
            Places::Seen => SeenFrom::of(DVec3::ZERO, &[], &shot.observer, None),
            Places::Measured => SeenFrom::measured(DVec3::ZERO, &[], &shot.observer, None),
            Places::Instant => SeenFrom::of(DVec3::ZERO, &[], &at_rest, None),
        };
        let may_show = |motion: &Motion| {
            let here = |body: &&Arc<Animated>| body.carrier().is_none() && shot.outside.is_none();
            let Some(body) = motion.animated().filter(here) else { return true };
            let pose = body.at(shot.observer.event.ct);
            let eye = shot.observer.event.position;
            // Clockwork shows one side.
            let behind = pose.world_from_body.matrix3.z_axis.dot(eye - pose.world_from_body.translation) < 0.0;
            if body.is_clockwork() && behind {
                return false;
            }
            let reach = body.reach(body.ball());
            sight.cone(reach.centre, reach.radius).is_none_or(|cone| sides.may_show(&cone))
        };
        !self.motions.iter().any(may_show)
    }

    /// Sets the texels of the map for each pixel, if the method has a map, and their shift, parts of a texel, from the
    /// next picture on.
    pub fn set_map_texels(&mut self, texels_per_pixel: f64, shift: DVec2) {
        self.method.set_map_texels(texels_per_pixel, shift);
    }

    /// Waits for the work that goes on beside the drawing.
    pub fn settle(&self) {
        self.method.settle();
    }

    /// Draws into targets of another format from now on. A map is then made anew for this occasion, with so many texels
    /// for each pixel.
    pub fn draw_in(&mut self, gpu: &Gpu, format: Format, occasion: Occasion, map_scale: Option<f64>) {
        self.format = format;
        self.occasion = occasion;
        self.close_outside(gpu);
        self.method.draw_in(gpu, format, occasion, map_scale);
    }

    /// Computes everything that all samples of a picture of `size` pixels share: the map or the cut, if the method
    /// has one.
    pub fn prepare(&mut self, gpu: &Gpu, shot: &Shot, size: [u32; 2]) {
        self.prepare_eye(gpu, &[(*shot, size)]);
        self.prepare_picture(gpu, &[(*shot, size)], size);
    }

    /// Computes everything that all pictures of one eye at one moment share. Each has its size in pixels.
    pub fn prepare_eye(&mut self, gpu: &Gpu, shots: &[(Shot, [u32; 2])]) {
        let Some((shot, _)) = shots.first() else { return };
        self.world.light_animated(gpu, &shot.observer, shot.effects.places);
        let bends = shot.effects.bend();
        if let Some(scene) = self.scene.as_ref().filter(|_| bends && shot.outside.is_some() && self.method.maps()) {
            let cuts = || Adaptive::new(Arc::clone(scene), self.tolerance_px, self.occasion);
            self.outside.get_or_insert_with(cuts).prepare_eye(gpu, &mut self.world, shots);
        } else {
            self.close_outside(gpu);
            if bends {
                self.method.prepare_eye(gpu, &mut self.world, shots);
            } else {
                self.world.complete(gpu);
            }
        }
        self.measured = self.measure(gpu, shot);
    }

    /// Ends the drawing of a map's scene from outside.
    fn close_outside(&mut self, gpu: &Gpu) {
        if let (Some(_), Some(scene)) = (self.outside.take(), &self.scene) {
            self.world.restore(gpu, scene);
        }
    }

    /// Method that draws now.
    fn drawing(&self) -> &dyn Method {
        match &self.outside {
            Some(cuts) => cuts,
            None => self.method.as_ref(),
        }
    }

    /// Measured places of all vertices of a scene with animated bodies. A matrix does for all others, and for
    /// clockwork.
    fn measure(&mut self, gpu: &Gpu, shot: &Shot) -> Option<wgpu::Buffer> {
        let solved = |motion: &Motion| motion.animated().is_some_and(|body| !body.is_clockwork());
        let animated = self.motions.iter().any(solved);
        let scene = self.scene.as_ref().filter(|_| animated && shot.effects.places == Places::Measured)?;
        let cut = self.method.shown_cut();
        let before = self.measured.take();
        let buffer = before.unwrap_or_else(|| place_streams(gpu, scene, cut));
        write_places(gpu, scene, cut, &self.sights(shot), &buffer);
        Some(buffer)
    }

    /// Computes everything that all samples of one picture of `size` pixels share, after
    /// [`SceneRenderer::prepare_eye`]. Several flat pictures, each with its size, stand for the one of a screen that is
    /// not flat.
    pub fn prepare_picture(&mut self, gpu: &Gpu, shots: &[(Shot, [u32; 2])], size: [u32; 2]) {
        if self.outside.is_none() && shots.iter().all(|(shot, _)| shot.effects.bend()) {
            let pixels = f64::from(size[0]) * f64::from(size[1]);
            self.method.prepare_picture(gpu, &mut self.world, shots, pixels, self.subject);
        }
    }

    /// True if the whole picture of a screen that is not flat can be [drawn at once](Self::draw_bent).
    pub fn shows_bent_screens(&self, effects: Effects) -> bool {
        effects.bend() && self.method.shows_bent_screens()
    }

    /// True if the picture of a shot has the depth of what it shows.
    pub fn has_depth(&self, shot: &Shot) -> bool {
        shot.outside.is_none() && !(shot.effects.bend() && self.method.maps())
    }

    /// Draws one sample of a picture. One submission has room for one.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &Radiance,
        shot: &Shot,
        sample: PixelSample,
    ) {
        let observer = &shot.observer;
        let view = shader_view(&shot.camera, target.size, sample, observer.celerity, shot.effects.places, shot.scale());
        self.draw_view(gpu, encoder, target, (shot, view), None);
    }

    /// Draws one sample of the picture of a screen that is not flat, prepared from flat pictures of which `shot` is
    /// one. Only for methods that [can](Self::shows_bent_screens).
    pub fn draw_bent(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &Radiance,
        shot: &Shot,
        sample: PixelSample,
        screen: &BentScreen<'_>,
    ) {
        let celerity = shot.observer.celerity;
        let view = shader_view(&shot.camera, target.size, sample, celerity, shot.effects.places, shot.scale());
        let axis = |axis: DVec3| (screen.observer_from_room * axis).as_vec3().extend(0.0);
        let view = shaders::ViewUniforms {
            right: axis(DVec3::X),
            up: axis(DVec3::Y),
            forward: axis(DVec3::Z),
            eye: screen.eye_m.as_vec3().extend(0.0),
            eye_rest: sample.offset.as_vec2().extend(0.0).extend(0.0),
            ..view
        };
        self.draw_view(gpu, encoder, target, (shot, view), Some(screen.points));
    }

    fn draw_view(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &Radiance,
        (shot, mut resting): (&Shot, shaders::ViewUniforms),
        points: Option<&wgpu::TextureView>,
    ) {
        let bent = shot.effects.bend() && self.drawing().is_ready();
        if let Some(outside) = &shot.outside {
            resting.clip_from_observer *= matrix(&DMat4::from_translation(-outside.place));
            let marks = self.marks.get_or_insert_with(|| Marks::new(gpu));
            let clip_from_observer = resting.clip_from_observer.as_dmat4();
            marks.prepare(gpu, (target.size, self.format), outside, &clip_from_observer, shot.scale());
        }
        let measured = shot.effects.places == Places::Measured;
        let (observer, origin) = (&shot.observer, self.world.origin);

        // There is a view for the resting scene, then one for each motion; places say which it is.
        let mut views = vec![resting];
        for (number, motion) in self.motions.iter().enumerate() {
            let view = if bent {
                moving_objects::view(&resting, motion, observer, self.drawing().axes())
            } else if measured {
                moving_objects::measured_view(&resting, Some(motion), observer, origin)
            } else {
                moving_objects::plain_view(&resting, motion, observer, origin)
            };
            views.push(shaders::ViewUniforms { layer: resting.layer + Vec4::X * (1 + number) as f32, ..view });
        }
        // Positions of the plain world are relative to its origin, not to the eye.
        if measured {
            views[0] = moving_objects::measured_view(&resting, None, observer, origin);
        } else if !bent {
            let eye_from_origin = DMat4::from_translation(origin - observer.event.position);
            views[0].clip_from_observer *= matrix(&eye_from_origin);
        }
        if self.measured.is_some() {
            // Measured places are about the eye, in the observer's axes.
            views.iter_mut().for_each(|view| view.clip_from_observer = resting.clip_from_observer);
        }

        let mut sights = self.sights(shot);
        if !bent && !measured {
            let at_rest = Observer { celerity: Celerity::ZERO, ..*observer };
            sights[0] = SeenFrom::of(origin, &self.motions, &at_rest, None);
        }
        if let Some(outside) = shot.outside.as_ref().filter(|_| bent) {
            outside_views(&mut views, &sights, outside);
        }
        let sides = Sides::of(&shot.camera, target.size, MARGIN_PIXELS);
        let Self { world, method, outside, format, subject, measured, marks, .. } = self;
        let (subject, format) = (*subject, *format);
        let method: &mut dyn Method = match outside {
            Some(cuts) => cuts,
            None => method.as_mut(),
        };
        let marks = marks.as_ref().filter(|_| shot.outside.is_some() && subject == Subject::Light);
        let sample = Sample { world, target, shot, views, sights: &sights, sides, points, marks, subject, format };
        if bent {
            method.draw(gpu, encoder, sample);
        } else {
            sample.draw_streams(gpu, encoder, measured.as_ref(), false);
        }
    }
}

/// Method that a dial names; `None` if it is the one that cuts the scene for every picture. A new method has its line
/// here.
fn fixed_method(
    gpu: &Gpu,
    scene: &Scene,
    format: Format,
    dial: Dial,
    occasion: Occasion,
) -> Result<Option<Box<dyn Method>>, PhotoSurfaceError> {
    // Animated vertices are solved for on the CPU, and the others go with them.
    let animated = scene.motions.iter().any(|motion| motion.animated().is_some());
    let method: Box<dyn Method> = match (dial.renderer, dial.edge, dial.transform) {
        (RendererName::Image, ..) => {
            let texels_per_pixel = dial.map_scale.unwrap_or(USUAL_MAP_SCALE);
            let quality = MapQuality { texels_per_pixel, smooth: occasion == Occasion::Ride };
            Box::new(ImageRenderer::new(gpu, scene, format, quality))
        }
        (_, Some(_), Some(Transform::Gpu)) if !animated => Box::new(VertexStage::new(gpu, scene)?),
        (_, Some(_), _) => Box::new(PhotoSurface::new(gpu, scene)?),
        (_, None, _) => return Ok(None),
    };
    Ok(Some(method))
}
