//! A scene cut for each single picture: no place of it is drawn farther from its exact place than a part of a pixel.
//!
//! A still waits for its cut. A ride does not: a separate thread cuts for the newest picture. Its cut is shown as a
//! whole as soon as it is ready; until then every frame bends the vertices of the cut before. Such a cut is a little
//! late. So it is a little finer than promised and wider than the picture, and edges close to the limit stay as they
//! were, so that nothing flickers.
//!
//! A mesh of which nothing is cut is drawn from the scene's own arrays. What is added is kept in f64. All vertices are
//! transformed here in f64, not by the kernel, and are accurate at every speed.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, bounded};
use scene::Scene;
use scene::cut::{Cut, CutFineness, CutViewpoint, SeenFrom};
use view::{Occasion, Shot};

use crate::certainty::{Certainty, Edges, EdgesDrawn};
use crate::gpu::Gpu;
use crate::method::{Method, Sample};
use crate::moving_objects::Axes;
use crate::stats::CutStats;
use crate::world::{DrawList, World};

use super::vertex_places::{place_streams, write_places};

/// Largest number of triangles of a still.
const STILL_TRIANGLES: usize = 8_000_000;

/// Largest number of triangles while riding.
const RIDE_TRIANGLES: usize = 1_000_000;

/// Share of the tolerance at which edges are cut in a ride, since the picture has changed a little when the cut is
/// shown.
const RIDE_SHARE: f64 = 0.7;

/// Angle by which the rider may turn until the next cut, radians.
const RIDE_TURN_RAD: f64 = 0.15;

/// Pause of the cutting thread after each cut, in durations of that cut. It leaves the processor to the threads that
/// draw.
const REST: u32 = 2;

/// Accuracy and timing of a scene's cuts.
#[derive(Clone, Copy, Debug)]
struct Tolerance {
    /// Largest distance of anything drawn from its exact place, pixels.
    pixels: f64,
    /// A still waits for its cut; a frame of a ride takes the newest one.
    occasion: Occasion,
}

/// The `polygon` method for triangles that are cut for every picture: a scene with its newest cut.
pub struct Adaptive {
    scene: Arc<Scene>,
    tolerance: Tolerance,
    shown: Option<Shown>,
    cutter: Option<Cutter>,
}

/// Cut that is drawn.
struct Shown {
    cut: Arc<Cut>,
    stats: CutStats,
    /// Sample of the edges of the cut.
    edges: Edges,
    /// Apparent positions: x, y and z streams, [`stream_stride`] bytes apart; if anything is animated, also a stream
    /// of log2 D.
    streams: wgpu::Buffer,
}

/// A cut that is ready to be uploaded.
struct Made {
    cut: Arc<Cut>,
    list: DrawList,
    stats: CutStats,
}

impl Adaptive {
    /// Adaptive cuts of `scene`, whose surfaces must be those that the world shows. `tolerance_px` is the largest
    /// distance of anything drawn from its exact place, pixels.
    pub fn new(scene: Arc<Scene>, tolerance_px: f64, occasion: Occasion) -> Self {
        let tolerance = Tolerance { pixels: tolerance_px, occasion };
        let cutter = (occasion == Occasion::Ride).then(|| Cutter::start(Arc::clone(&scene), tolerance));
        Self { scene, tolerance, shown: None, cutter }
    }

    /// Makes or takes the cut for all pictures of one eye, and bends its vertices.
    pub fn cut(&mut self, gpu: &Gpu, world: &mut World, shots: &[(Shot, [u32; 2])]) {
        let Some((first, _)) = shots.first() else { return };
        let pictures = shots.iter().map(|(shot, size)| (shot.camera, *size)).collect();
        let viewpoint =
            CutViewpoint { observer: first.observer, pictures, outside: first.outside.map(|outside| outside.place) };
        let made = match (&mut self.cutter, &self.shown) {
            (Some(cutter), Some(shown)) => cutter.follow(&viewpoint, &shown.cut),
            _ => Some(make(&self.scene, &viewpoint, self.tolerance, None)),
        };
        if let Some(Made { cut, list, stats }) = made {
            world.replace(gpu, &self.scene, &cut, list);
            let streams = place_streams(gpu, &self.scene, Some(&cut));
            let edges = Edges::of_cut(&self.scene, &cut);
            self.shown = Some(Shown { cut, stats, edges, streams });
        }
        if let Some(shown) = &self.shown {
            let motions = std::iter::once(None).chain((0..self.scene.motions.len()).map(Some));
            let sight = |motion| SeenFrom::new(&self.scene, &viewpoint.observer, motion);
            let sights: Vec<SeenFrom> = motions.map(sight).collect();
            write_places(gpu, &self.scene, Some(&shown.cut), &sights, &shown.streams);
        }
    }

    /// Apparent positions of the newest cut.
    pub fn streams(&self) -> Option<&wgpu::Buffer> {
        self.shown.as_ref().map(|shown| &shown.streams)
    }

    /// Sample of the edges of the newest cut.
    pub fn edges(&self) -> Option<&Edges> {
        self.shown.as_ref().map(|shown| &shown.edges)
    }
}

impl Method for Adaptive {
    fn name(&self) -> &'static str {
        "polygon"
    }

    fn axes(&self) -> Axes {
        Axes::Observer
    }

    fn prepare_eye(&mut self, gpu: &Gpu, world: &mut World, shots: &[(Shot, [u32; 2])]) {
        self.cut(gpu, world, shots);
    }

    fn is_ready(&self) -> bool {
        self.shown.is_some()
    }

    fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, sample: Sample<'_>) {
        sample.draw_streams(gpu, encoder, self.streams(), false);
    }

    fn certainty(&self, edges: &Edges, estimate: &dyn Fn(&Edges, EdgesDrawn) -> Certainty) -> Certainty {
        estimate(self.edges().unwrap_or(edges), EdgesDrawn::InFull)
    }

    fn shown_cut(&self) -> Option<&Cut> {
        self.shown.as_ref().map(|shown| shown.cut.as_ref())
    }

    fn cut_stats(&self) -> Option<CutStats> {
        self.shown.as_ref().map(|shown| shown.stats)
    }

    fn settle(&self) {
        if let Some(cutter) = &self.cutter {
            while cutter.busy && cutter.made.is_empty() {
                std::thread::sleep(Duration::from_millis(1));
            }
        }
    }
}

/// Cuts a scene for one viewpoint.
fn make(scene: &Scene, viewpoint: &CutViewpoint, tolerance: Tolerance, before: Option<&Cut>) -> Made {
    let started = Instant::now();
    let fineness = match tolerance.occasion {
        Occasion::Still => CutFineness { tolerance_px: tolerance.pixels, turn_rad: 0.0, triangles: STILL_TRIANGLES },
        Occasion::Ride => CutFineness {
            tolerance_px: RIDE_SHARE * tolerance.pixels,
            turn_rad: RIDE_TURN_RAD,
            triangles: RIDE_TRIANGLES,
        },
    };
    let cut = Cut::new(scene, viewpoint, fineness, before);
    let list = DrawList::of(scene, Some(&cut));
    let kept = cut.tolerance_px / fineness.tolerance_px * tolerance.pixels;
    let stats = CutStats { tolerance_px: kept, triangles: cut.triangles, duration: started.elapsed() };
    Made { cut: Arc::new(cut), list, stats }
}

/// Thread that cuts while others draw, with its channels.
struct Cutter {
    wanted: Sender<(CutViewpoint, Arc<Cut>)>,
    made: Receiver<Made>,
    busy: bool,
    /// Viewpoint of the cut requested last.
    asked: Option<CutViewpoint>,
    /// Earliest time of the next request.
    due: Instant,
}

impl Cutter {
    fn start(scene: Arc<Scene>, tolerance: Tolerance) -> Self {
        let (wanted, wishes) = bounded::<(CutViewpoint, Arc<Cut>)>(1);
        let (makes, made) = bounded(1);
        std::thread::Builder::new()
            .name("cut".to_owned())
            .spawn(move || {
                for (viewpoint, before) in wishes {
                    if makes.send(make(&scene, &viewpoint, tolerance, Some(&before))).is_err() {
                        return;
                    }
                }
            })
            .expect("the system can start a thread");
        Self { wanted, made, busy: false, asked: None, due: Instant::now() }
    }

    /// Returns the newest cut, if there is a new one, and requests the next one.
    fn follow(&mut self, viewpoint: &CutViewpoint, shown: &Arc<Cut>) -> Option<Made> {
        let made = self.made.try_recv().ok();
        if let Some(made) = &made {
            self.busy = false;
            self.due = Instant::now() + REST * made.stats.duration;
        }
        if !self.busy && Instant::now() >= self.due && self.asked.as_ref() != Some(viewpoint) {
            let before = made.as_ref().map_or(shown, |made| &made.cut);
            self.busy = self.wanted.try_send((viewpoint.clone(), Arc::clone(before))).is_ok();
            self.asked = Some(viewpoint.clone());
        }
        made
    }
}
