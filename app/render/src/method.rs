//! Interface of a method of drawing.
//!
//! A method draws a scene with relativity's geometry; everything else (the plain picture, light on what moves, the
//! estimate of errors) is common, and is in [`SceneRenderer`](crate::SceneRenderer). A new method is a file that
//! implements [`Method`], and a line in `scene_renderer.rs` that makes it.

use crate::certainty::{Certainty, Edges, EdgesDrawn};
use crate::gpu::{Gpu, GpuError};
use crate::moving_objects::Axes;
use crate::outside::Marks;
use crate::pending::{Pending, Transformed};
use crate::stats::{CutStats, DrawCounts, MapStats};
use crate::subject::Subject;
use crate::target::{Format, Radiance};
use crate::world::{Draws, Mode, TargetPart, VertexSource, World};
use glam::DVec2;
use physics::Observer;
use scene::cut::{Cut, SeenFrom};
use view::{Effects, Occasion, Shot, Sides};

/// One way of drawing a scene as a moving observer sees it.
///
/// For a picture the functions are called in this order: [`submit`](Method::submit) and [`show`](Method::show), where
/// other work may lie between them; [`prepare_eye`](Method::prepare_eye) once for all pictures of one eye;
/// [`prepare_picture`](Method::prepare_picture) once for each of them; [`draw`](Method::draw) for each of its samples.
pub trait Method {
    /// Name on the command line.
    fn name(&self) -> &'static str;

    /// Axes of the apparent positions of moving objects.
    fn axes(&self) -> Axes;

    /// Begins the photo-surface for an observer, in parallel with other drawing. `observers` are the observer in the
    /// world, then in the frame of each motion.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    fn submit(&mut self, _gpu: &Gpu, _observers: Vec<Observer>) -> Result<Pending, GpuError> {
        Ok(Pending::default())
    }

    /// Sets the photo-surface from which the next pictures are drawn.
    fn show(&mut self, _gpu: &Gpu, _transformed: Transformed) {}

    /// Computes everything that all pictures of one eye at one moment share. Each has its size in pixels.
    fn prepare_eye(&mut self, _gpu: &Gpu, _world: &mut World, _shots: &[(Shot, [u32; 2])]) {}

    /// True if the method can draw the whole picture of a screen that is not flat at once, so that each of its pixels
    /// is looked up once.
    fn shows_bent_screens(&self) -> bool {
        false
    }

    /// Computes everything that all samples of one picture share. Several flat pictures, each with its size, stand for
    /// the one of a screen that is not flat, which has `pixels` pixels.
    fn prepare_picture(
        &mut self,
        _gpu: &Gpu,
        _world: &mut World,
        _shots: &[(Shot, [u32; 2])],
        _pixels: f64,
        _subject: Subject,
    ) {
    }

    /// True if the method draws a map of the world around the eye, which cannot be looked at from outside.
    fn maps(&self) -> bool {
        false
    }

    /// True if the method can draw now. Until then the plain world is drawn.
    fn is_ready(&self) -> bool {
        true
    }

    /// Draws one sample.
    fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, sample: Sample<'_>);

    /// Errors of the picture drawn last. `edges` are a sample of the edges of the scene as it was uploaded; `estimate`
    /// tells the errors of a picture with these edges.
    fn certainty(&self, edges: &Edges, estimate: &dyn Fn(&Edges, EdgesDrawn) -> Certainty) -> Certainty;

    /// Cost of the newest map, if the method has one.
    fn map_stats(&self) -> Option<MapStats> {
        None
    }

    /// Triangles that the method drew from a world of its own since the last call of this function.
    fn take_drawn(&self) -> DrawCounts {
        DrawCounts::default()
    }

    /// Newest cut of the scene, whose triangles the world shows; `None` for a scene that is drawn as it is.
    fn shown_cut(&self) -> Option<&Cut> {
        None
    }

    /// Size and accuracy of the newest cut, if the scene is cut for every picture.
    fn cut_stats(&self) -> Option<CutStats> {
        None
    }

    /// Sets the texels of the map for each pixel, if the method has a map, and their shift, parts of a texel, from the
    /// next picture on.
    fn set_map_texels(&mut self, _texels_per_pixel: f64, _shift: DVec2) {}

    /// Waits for the work that goes on beside the drawing.
    fn settle(&self) {}

    /// Draws into targets of another format from now on. A map is then made anew for this occasion, with so many texels
    /// for each pixel.
    fn draw_in(&mut self, _gpu: &Gpu, _format: Format, _occasion: Occasion, _map_scale: Option<f64>) {}
}

/// One sample of a picture that is drawn with relativity's geometry.
pub struct Sample<'a> {
    /// Scene on the device.
    pub world: &'a mut World,
    /// Target of the sample.
    pub target: &'a Radiance,
    /// Picture that the sample belongs to.
    pub shot: &'a Shot,
    /// View 0 is of the resting scene, view 1 + i of motion i.
    pub views: Vec<shaders::ViewUniforms>,
    /// Sight of the resting scene, then of each motion, by the observer.
    pub sights: &'a [SeenFrom],
    /// Sides of the picture, observer's axes.
    pub sides: Sides,
    /// Points of the room that the pixels show, if the screen is not flat.
    pub points: Option<&'a wgpu::TextureView>,
    /// Marks of the observer, in a picture from outside.
    pub marks: Option<&'a Marks>,
    /// Content of the picture.
    pub subject: Subject,
    /// Format of the target.
    pub format: Format,
}

impl Sample<'_> {
    /// Mode in which surfaces are drawn.
    pub fn mode(&self) -> Mode {
        match self.subject {
            Subject::Light => match self.shot.outside {
                Some(outside) if self.shot.effects.bend() => Mode::Outside(outside.colouring, self.shot.effects),
                // Light that arrives at the eye has no place outside of it in other views.
                Some(_) => Mode::Light(Effects { doppler: false, searchlight: false, ..self.shot.effects }),
                None => Mode::Light(self.shot.effects),
            },
            Subject::Places => Mode::Places,
        }
    }

    /// Number of pixels of the target.
    pub fn pixels(&self) -> f64 {
        self.target.size.map(f64::from).iter().product()
    }

    /// Whole target, with the view written first.
    pub fn whole(&self) -> TargetPart {
        TargetPart { view: 0, place: None, sides: self.sides }
    }

    /// Draws the scene with the apparent positions in `streams`; with the positions of the plain world if there are
    /// none. `bends`: the vertex stage bends what the streams do not hold.
    pub fn draw_streams(
        self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        streams: Option<&wgpu::Buffer>,
        bends: bool,
    ) {
        let mode = self.mode();
        let source = match streams {
            None => VertexSource::Plain,
            Some(_) if bends => VertexSource::Bent,
            Some(_) => VertexSource::Streams,
        };
        self.world.prepare(gpu, mode, source, self.format);
        self.world.write_views(gpu, &self.views);
        let draws = Draws {
            streams,
            bends,
            mode,
            format: self.format,
            sights: self.sights,
            outside: self.shot.outside.map(|outside| outside.place),
            pixels: self.pixels(),
            further_carrier: None,
            // The sky has no place that could be seen from outside.
            sky: self.shot.outside.is_none(),
        };
        let mut pass = self.target.begin(encoder);
        self.world.draw(gpu, &mut pass, &draws, &[self.whole()]);
        if let Some(marks) = self.marks {
            marks.draw(&mut pass, self.format);
        }
    }
}
