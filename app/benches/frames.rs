//! The cost of relativity for a frame: the photo-surface against the plain draw of the same scene (W table 6.1).
//!
//! Three scenes have as many vertices and triangles as Weiskopf's. Each is drawn by the default path (the method that
//! `auto` chooses, all effects), and plainly. Then, with edges that are not cut and geometry alone, it is drawn with
//! the transform of the next frame overlapping the draw of this one, and with both in sequence (`--latency low`). The
//! ways take turns within one run, so that other load on the machine affects all alike. The eye moves at a hundredth
//! of c: the kernel does all of its work, and the pictures show the same triangles. Surfaces are unlit, so that little
//! drawing hides the cost.
//!
//! `cargo bench -p rapidity --bench frames`, or with words after `--`: `beta=.9` for another speed, `640x480` for
//! another size, `5s` for seconds for each scene.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use glam::DVec3;
use physics::photo_surface::Kernel;
use physics::{Beta, Celerity, Event, Observer};
use render::target::{Format, Radiance};
use render::{Gpu, GpuError, Pending, SceneRenderer, TransformReport};
use scene::Scene;
use std::error::Error;
use std::time::Duration;
use support::default_path::DefaultPath;
use support::figures::{commit, median, milliseconds, processor};
use support::frame_times::{FrameTimes, rounds, turn};
use support::table_scenes::{SIZES, scene_of};
use support::words::Words;
use view::{Camera, Dial, Effects, Occasion, PixelSample, Shot};

/// Width and height of a frame, pixels.
const SIZE: [u32; 2] = [1280, 1024];

/// Edge of the scene's triangles, metres: they are drawn as they are.
const EDGE_M: f64 = 1.0;

/// Target for the frame time of the overlapped relativistic draw, as a share of the plain one's.
const GOAL: f64 = 1.02;

/// Number of frames drawn in one way before the next way has its turn.
const FRAMES: usize = 4;

/// Time for which each scene is measured, seconds.
const SECONDS: f64 = 20.0;

/// Speed of the eye, fraction of c.
const SPEED: f64 = 0.01;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = Words::given();
    let time = Duration::from_secs_f64(words.seconds().unwrap_or(SECONDS));
    let speed = words.speeds(&[SPEED])?[0];
    let size = words.size().unwrap_or(SIZE);
    words.end("beta=V, a size, as in 640x480, and seconds, as in 5s")?;

    let gpu = Gpu::new()?;
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores, kernel {:?}", commit(), processor(), Kernel::default().instructions());
    println!("{}, {} x {} pixels, {speed} c", gpu.description(), size[0], size[1]);
    if gpu.is_software() {
        println!("a software driver draws on the cores that transform: what overlaps also competes");
    }
    println!(
        "medians; ratio = frame time over that of the plain draw, with its quartiles; goal when overlapped: {GOAL}"
    );
    for [vertices, triangles] in SIZES {
        let scene = scene_of(vertices, triangles)?;
        assert_eq!([scene.vertex_count(), scene.triangle_count()], [vertices, triangles]);
        println!("\n{vertices} vertices, {triangles} triangles");
        let default = DefaultPath::of(&gpu, &scene)?;
        let eye = Eye::new(speed)?;
        let uncut = Dial::edge(EDGE_M);
        let mut ways = [
            Way::new(&gpu, &scene, (default.name(), default.dial, default.effects), true, (default.format, size))?,
            Way::new(&gpu, &scene, ("plain".to_owned(), uncut, Effects::NONE), true, (default.format, size))?,
            Way::new(
                &gpu,
                &scene,
                ("uncut, overlapped".to_owned(), uncut, Effects::GEOMETRY),
                true,
                (default.format, size),
            )?,
            Way::new(
                &gpu,
                &scene,
                ("uncut, in sequence".to_owned(), uncut, Effects::GEOMETRY),
                false,
                (default.format, size),
            )?,
        ];
        rounds(time, |counts| ways.iter_mut().try_for_each(|way| way.turn(&gpu, &eye, counts)))?;
        for way in &ways {
            let transform = match &way.transforms[..] {
                [] => String::new(),
                times => format!("; transform {:.3} ms", median(times)),
            };
            println!("{}{transform}", way.times.line(&way.name, &ways[PLAIN].times));
        }
    }
    Ok(())
}

/// Eye in the middle of a scene.
struct Eye {
    camera: Camera,
    observer: Observer,
}

impl Eye {
    fn new(speed: f64) -> Result<Self, Box<dyn Error>> {
        let celerity = if speed > 0.0 { Beta::new(DVec3::NEG_Z * speed)?.celerity() } else { Celerity::ZERO };
        Ok(Self {
            camera: Camera::looking(DVec3::NEG_Z, DVec3::Y, 70.0_f64.to_radians()),
            observer: Observer { event: Event { ct: 0.0, position: DVec3::new(0.3, 0.2, 0.1) }, celerity },
        })
    }
}

/// Number of the way that draws plainly.
const PLAIN: usize = 1;

/// One way to draw a scene, and its target.
struct Way {
    name: String,
    renderer: SceneRenderer,
    target: Radiance,
    effects: Effects,
    /// True if the transform of the next frame runs beside the draw of this one.
    overlaps: bool,
    under_way: Option<Pending>,
    times: FrameTimes,
    /// Times of the transforms, a median for each turn, milliseconds.
    transforms: Vec<f64>,
}

impl Way {
    fn new(
        gpu: &Gpu,
        scene: &Scene,
        (name, dial, effects): (String, Dial, Effects),
        overlaps: bool,
        (format, size): (Format, [u32; 2]),
    ) -> Result<Self, Box<dyn Error>> {
        Ok(Self {
            name,
            renderer: SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?,
            target: Radiance::new(gpu, size, format),
            effects,
            overlaps,
            under_way: None,
            times: FrameTimes::default(),
            transforms: Vec::new(),
        })
    }

    fn turn(&mut self, gpu: &Gpu, eye: &Eye, counts: bool) -> Result<(), GpuError> {
        let mut transforms = Vec::new();
        if self.overlaps {
            self.under_way = Some(self.renderer.submit(gpu, &eye.observer, self.effects)?);
        }
        let times = turn(FRAMES, || {
            transforms.push(milliseconds(self.frame(gpu, eye)?.duration));
            Ok::<_, GpuError>(())
        })?;
        if let Some(last) = self.under_way.take() {
            self.renderer.show(gpu, last)?;
        }
        self.renderer.settle();
        if counts {
            self.times.add(&times);
            if transforms.iter().any(|time| *time > 0.0) {
                self.transforms.push(median(&transforms));
            }
        }
        Ok(())
    }

    fn frame(&mut self, gpu: &Gpu, eye: &Eye) -> Result<TransformReport, GpuError> {
        let newest = self.renderer.submit(gpu, &eye.observer, self.effects)?;
        let shown = if self.overlaps { self.under_way.replace(newest).unwrap_or_default() } else { newest };
        let report = self.renderer.show(gpu, shown)?;
        let shot = Shot {
            camera: eye.camera,
            observer: eye.observer,
            effects: self.effects,
            stored_scale: None,
            outside: None,
        };
        self.renderer.prepare(gpu, &shot, self.target.size);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.renderer.draw(gpu, &mut encoder, &self.target, &shot, PixelSample::WHOLE);
        gpu.queue.submit([encoder.finish()]);
        gpu.wait()?;
        Ok(report)
    }
}
