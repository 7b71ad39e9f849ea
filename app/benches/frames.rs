//! The cost of relativity for a frame: the photo-surface against the plain draw of the same scene (W table 6.1).
//!
//! Three scenes have as many vertices and triangles as Weiskopf's. Each is drawn plainly, with the transform of the
//! next frame overlapping the draw of this one, and with both in sequence (`--latency low`). The three ways take
//! turns within one run, so that other load on the machine affects all alike. The eye moves at a hundredth of c: the
//! kernel does all of its work, and the pictures show the same triangles. Surfaces are unlit, so that little drawing
//! hides the cost.
//!
//! `cargo bench -p rapidity --bench frames`
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use built_in::lattice::Lattice;
use glam::{DVec3, Vec3};
use physics::photo_surface::Kernel;
use physics::{Beta, Event, Observer};
use render::target::{Format, Radiance};
use render::{Gpu, GpuError, Pending, SceneRenderer, TransformReport};
use scene::refine::{RefineError, refine};
use scene::{Mesh, Scene};
use std::error::Error;
use std::time::{Duration, Instant};
use support::{commit, median, milliseconds, processor, quantile};
use view::{Camera, Dial, Effects, Occasion, Shot};

/// Width and height of a frame, pixels.
const SIZE: [u32; 2] = [1280, 1024];

/// Edge of the scene's triangles, metres: they are drawn as they are.
const EDGE_M: f64 = 1.0;

/// Numbers of vertices and triangles in W table 6.1.
const SIZES: [[usize; 2]; 3] = [[21_198, 18_770], [135_907, 113_397], [20_786, 19_864]];

/// Target for the frame rate of the overlapped relativistic draw, as a share of the plain one's.
const GOAL: f64 = 0.98;

/// Number of frames drawn in one way before the next way has its turn.
const FRAMES: usize = 4;

/// Time for which each scene is measured.
const TIME: Duration = Duration::from_secs(15);

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::new()?;
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores, kernel {:?}", commit(), processor(), Kernel::default().instructions());
    println!("{}, {} x {} pixels", gpu.description(), SIZE[0], SIZE[1]);
    if gpu.is_software() {
        println!("a software driver draws on the cores that transform: what overlaps also competes");
    }
    println!(
        "medians; ratio = frame rate over that of the plain draw, with its quartiles; goal when overlapped: {GOAL}"
    );
    println!();
    println!(
        "vertices triangles | plain ms | overlap ms ratio               | low ms  ratio               | transform ms"
    );
    for [vertices, triangles] in SIZES {
        let scene = scene_of(vertices, triangles)?;
        assert_eq!([scene.vertex_count(), scene.triangle_count()], [vertices, triangles]);
        let [plain, overlap, low, transform] = Bench::new(&gpu, &scene)?.run()?;
        let (hidden, shown) = (ratios(&plain, &overlap), ratios(&plain, &low));
        println!(
            "{vertices:8} {triangles:9} | {:8.2} | {:7.2}  {hidden} | {:7.2} {shown} | {:6.3}",
            median(&plain),
            median(&overlap),
            median(&low),
            median(&transform)
        );
    }
    Ok(())
}

/// A scene on the device, an eye in its middle, and a target.
struct Bench<'gpu> {
    gpu: &'gpu Gpu,
    renderer: SceneRenderer,
    target: Radiance,
    camera: Camera,
    observer: Observer,
}

impl<'gpu> Bench<'gpu> {
    fn new(gpu: &'gpu Gpu, scene: &Scene) -> Result<Self, Box<dyn Error>> {
        let format = Format::fast(1);
        Ok(Self {
            gpu,
            renderer: SceneRenderer::new(gpu, scene.clone(), format, None, Dial::edge(EDGE_M), Occasion::Ride)?,
            target: Radiance::new(gpu, SIZE, format),
            camera: Camera::looking(DVec3::NEG_Z, DVec3::Y, 70.0_f64.to_radians()),
            observer: Observer {
                event: Event { ct: 0.0, position: DVec3::new(0.3, 0.2, 0.1) },
                celerity: Beta::new(DVec3::NEG_Z * 0.01)?.celerity(),
            },
        })
    }

    /// Times of a frame drawn plainly, overlapped and in sequence, and of a transform alone, milliseconds: a median
    /// for each turn.
    fn run(&mut self) -> Result<[Vec<f64>; 4], Box<dyn Error>> {
        let mut medians = [const { Vec::new() }; 4];
        let started = Instant::now();
        let mut warm = false;
        while !warm || started.elapsed() < TIME {
            let plain = self.turn(|bench| bench.draw(Effects::NONE))?;

            // The transform of the next frame begins before this one is drawn.
            let mut next = self.submit()?;
            let overlap = self.turn(|bench| {
                let after = bench.submit()?;
                bench.show(std::mem::replace(&mut next, after)).map(drop)
            })?;
            self.show(next)?;

            let mut transforms = Vec::new();
            let low = self.turn(|bench| {
                let pending = bench.submit()?;
                transforms.push(milliseconds(bench.show(pending)?.duration));
                Ok(())
            })?;

            // The first turn compiles shaders and touches memory, so it does not count.
            if warm {
                for (turns, frames) in medians.iter_mut().zip([plain, overlap, low, transforms]) {
                    turns.push(median(&frames));
                }
            }
            warm = true;
        }
        Ok(medians)
    }

    /// Times of the frames of a turn, milliseconds.
    fn turn(&mut self, mut frame: impl FnMut(&mut Self) -> Result<(), GpuError>) -> Result<Vec<f64>, GpuError> {
        let time = |_| {
            let started = Instant::now();
            frame(self)?;
            Ok(milliseconds(started.elapsed()))
        };
        (0..FRAMES).map(time).collect()
    }

    fn submit(&mut self) -> Result<Pending, GpuError> {
        self.renderer.submit(self.gpu, &self.observer, Effects::GEOMETRY)
    }

    fn show(&mut self, pending: Pending) -> Result<TransformReport, GpuError> {
        let report = self.renderer.show(self.gpu, pending)?;
        self.draw(Effects::GEOMETRY)?;
        Ok(report)
    }

    fn draw(&mut self, effects: Effects) -> Result<(), GpuError> {
        let shot = Shot { camera: self.camera, observer: self.observer, effects, stored_scale: None };
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.renderer.draw(self.gpu, &mut encoder, &self.target, &shot, view::PixelSample::WHOLE);
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait()
    }
}

/// Boxes around the origin with exactly this many vertices and triangles.
///
/// A box with whole faces has 24 and 12, one with faces of four by four squares 150 and 192: two equations for the
/// numbers of both. Whole numbers leave a rest of less than a percent, which vertices without triangles and triangles
/// drawn twice make up.
fn scene_of(vertices: usize, triangles: usize) -> Result<Scene, RefineError> {
    let cut = (2 * triangles - vertices) / 234;
    let whole = (vertices - 150 * cut) / 24;
    let side = ((cut + whole) as f64).cbrt().ceil() as u32;
    let lattice = Lattice { count: [side; 3], ..Default::default() };
    let whole_box = Lattice { count: [1; 3], ..lattice }.build();
    let cut_box = refine(&whole_box, 0.36 * lattice.side)?;

    let mut mesh = Mesh::default();
    for index in 0..cut + whole {
        let column = index as u32;
        let centre = lattice.centre([column % side, column / side % side, column / (side * side)]);
        append(&mut mesh, &if index < cut { &cut_box } else { &whole_box }.meshes[0], centre);
    }
    for last in vec![mesh.positions.len() - 1; vertices - mesh.positions.len()] {
        mesh.positions.push(mesh.positions[last]);
        mesh.normals.push(mesh.normals[last]);
        mesh.uvs.push(mesh.uvs[last]);
        mesh.colours.push(mesh.colours[last]);
    }
    mesh.indices.extend_from_within(..3 * triangles - mesh.indices.len());
    Ok(Scene { meshes: vec![mesh], ..whole_box })
}

/// Adds a copy of `source`, moved by `offset`.
fn append(mesh: &mut Mesh, source: &Mesh, offset: Vec3) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(source.positions.iter().map(|&position| position + offset));
    mesh.normals.extend(&source.normals);
    mesh.uvs.extend(&source.uvs);
    mesh.colours.extend(&source.colours);
    mesh.indices.extend(source.indices.iter().map(|index| first + index));
}

/// Ratios of the second frame rate to the first, turn by turn, as text: median and quartiles.
fn ratios(plain: &[f64], other: &[f64]) -> String {
    let ratios: Vec<f64> = plain.iter().zip(other).map(|(plain, other)| plain / other).collect();
    let [low, middle, high] = [0.25, 0.5, 0.75].map(|share| quantile(&ratios, share));
    format!("{middle:.3} ({low:.3} to {high:.3})")
}
