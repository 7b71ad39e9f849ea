//! The cost of the image renderer and of each effect in the old town, over speed and over the map's resolution, and
//! in memory.
//!
//! In each table the alternatives take turns, a few frames each, so that other load on the machine affects all alike;
//! ratios are of frame times in one round. A frame is drawn as in a window, without the window.
//!
//! `cargo bench -p rapidity --bench light`
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use built_in::town;
use glam::DVec3;
use physics::{Beta, Celerity, Event, Observer};
use render::display::{Adaptation, Developer, Development, Seen};
use render::target::{Format, Radiance, texture};
use render::{Gpu, GpuError, SceneRenderer};
use scene::Scene;
use scene::refine::refine;
use std::error::Error;
use std::time::{Duration, Instant};
use support::{commit, median, milliseconds, processor, quantile};
use view::{Camera, Dial, EYE_HEIGHT_M, Effects, Occasion, PixelSample, Shot};

/// Width and height of a frame, pixels.
const SIZE: [u32; 2] = [1280, 720];
/// Texels of the map for each pixel in a window that the CPU draws.
const MAP_SCALE: f64 = 0.9;
/// Number of frames drawn in one way before the next way has its turn.
const FRAMES: usize = 3;
/// Time for which each table is measured.
const TIME: Duration = Duration::from_secs(15);
/// Longest edge of a triangle of the polygon renderer, metres: the program's default.
const EDGE_M: f64 = 0.5;

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::new()?;
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores", commit(), processor());
    println!("{}, {} x {} pixels, the old town from its start", gpu.description(), SIZE[0], SIZE[1]);
    println!("medians; ratio = frame time over that of the table's first row, with its quartiles");

    let town = town::build(1);
    let refined = refine(&town, EDGE_M as f32)?;
    let mut image = Stage::new(&gpu, &town, Dial::map(MAP_SCALE))?;
    let mut polygon = Stage::new(&gpu, &refined, Dial::edge(EDGE_M))?;
    let (doppler, searchlight) =
        (Effects { doppler: true, ..Effects::GEOMETRY }, Effects { searchlight: true, ..Effects::GEOMETRY });

    println!("\nimage renderer at 0.8 c: what each effect costs");
    let rows = [
        ("none (drawn plainly)", Effects::NONE),
        ("geometry", Effects::GEOMETRY),
        ("geometry, doppler", doppler),
        ("geometry, searchlight", searchlight),
        ("all", Effects::ALL),
    ];
    table(&rows, |effects| image.frame(0.8, *effects))?;
    println!("\npolygon renderer at 0.8 c, {} triangles; the photo-surface is not counted", refined.triangle_count());
    table(&rows, |effects| polygon.frame(0.8, *effects))?;

    println!("\nimage renderer, all effects: what speed costs");
    let speeds = [0.0, 0.5, 0.8, 0.95, 0.99, 0.999].map(|beta| (format!("{beta} c"), beta));
    table(&speeds, |beta| image.frame(*beta, Effects::ALL))?;
    for (name, beta) in &speeds {
        image.frame(*beta, Effects::ALL)?;
        println!("  {name:>8}: {}", image.memory());
    }

    println!("\nimage renderer, all effects, at 0.8 c: what the map's fineness costs");
    let scales = [0.5, 0.7, 0.9, 1.5, 3.0].map(|scale| (format!("{scale} texels a pixel"), scale));
    let mut stages = Vec::new();
    for (_, texels_per_pixel) in &scales {
        stages.push(Stage::new(&gpu, &town, Dial::map(*texels_per_pixel))?);
    }
    let numbered: Vec<_> = scales.iter().enumerate().map(|(number, (name, _))| (name.clone(), number)).collect();
    table(&numbered, |number| stages[*number].frame(0.8, Effects::ALL))?;
    for ((name, _), stage) in scales.iter().zip(&stages) {
        println!("  {name:>22}: {}", stage.memory());
    }
    Ok(())
}

/// Measures the rows in turns, and prints them.
fn table<Row>(
    rows: &[(impl AsRef<str>, Row)],
    mut frame: impl FnMut(&Row) -> Result<(), GpuError>,
) -> Result<(), GpuError> {
    let mut rounds = vec![Vec::new(); rows.len()];
    let started = Instant::now();
    let mut warm = false;
    while !warm || started.elapsed() < TIME {
        for ((_, row), medians) in rows.iter().zip(&mut rounds) {
            let mut times = Vec::new();
            for _ in 0..FRAMES {
                let begun = Instant::now();
                frame(row)?;
                times.push(milliseconds(begun.elapsed()));
            }
            // The first round compiles shaders and touches memory, so it does not count.
            if warm {
                medians.push(median(&times));
            }
        }
        warm = true;
    }
    for ((name, _), medians) in rows.iter().zip(&rounds) {
        let ratios: Vec<f64> = medians.iter().zip(&rounds[0]).map(|(time, first)| time / first).collect();
        let [low, middle, high] = [0.25, 0.5, 0.75].map(|share| quantile(&ratios, share));
        println!("  {:>22}: {:7.1} ms, ratio {middle:.3} ({low:.3} to {high:.3})", name.as_ref(), median(medians));
    }
    Ok(())
}

/// A scene on the device, an eye at its start, and a target.
struct Stage<'gpu> {
    gpu: &'gpu Gpu,
    renderer: SceneRenderer,
    target: Radiance,
    developer: Developer,
    adaptation: Adaptation,
    screen: wgpu::TextureView,
    eye: DVec3,
    look: DVec3,
}

impl<'gpu> Stage<'gpu> {
    fn new(gpu: &'gpu Gpu, scene: &Scene, dial: Dial) -> Result<Self, Box<dyn Error>> {
        let format = Format::fast(1);
        let eye = scene.start.position + DVec3::Y * EYE_HEIGHT_M;
        let mut renderer = SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?;
        // The photo-surface stays the same; the benchmark `frames` measures its cost.
        let celerity = Celerity::new(scene.start.look * 0.8 / 0.6)?;
        let observer = Observer { event: Event { ct: 0.0, position: eye }, celerity };
        let pending = renderer.submit(gpu, &observer, Effects::ALL)?;
        renderer.show(gpu, pending)?;
        let screen = wgpu::TextureFormat::Bgra8Unorm;
        Ok(Self {
            gpu,
            renderer,
            target: Radiance::new(gpu, SIZE, format),
            developer: Developer::new(gpu, format.colour, screen),
            adaptation: Adaptation::new(gpu),
            screen: texture(gpu, "screen", SIZE, screen, 1, wgpu::TextureUsages::RENDER_ATTACHMENT),
            eye,
            look: scene.start.look,
        })
    }

    fn frame(&mut self, beta: f64, effects: Effects) -> Result<(), GpuError> {
        let celerity = Beta::new(self.look * beta).expect("a speed below light's").celerity();
        let observer = Observer { event: Event { ct: 0.0, position: self.eye }, celerity };
        let camera = Camera::looking(self.look, DVec3::Y, 60.0_f64.to_radians());
        let shot = Shot { camera, observer, effects, stored_scale: None };
        self.renderer.prepare(self.gpu, &shot, SIZE);
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.renderer.draw(self.gpu, &mut encoder, &self.target, &shot, PixelSample::WHOLE);
        self.gpu.queue.submit([encoder.finish()]);

        // Show the frame on the screen.
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let development = Development::default();
        let radiance = self.target.result();
        let seen = Seen { radiance, stored: self.renderer.stored(&shot), elapsed_s: Some(0.05) };
        self.developer.adapt(self.gpu, &mut encoder, &mut self.adaptation, &seen, &development);
        self.developer.show(self.gpu, &mut encoder, radiance, &self.adaptation, &development, &self.screen);
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.wait()
    }

    fn memory(&self) -> String {
        let stats = self.renderer.map_stats().unwrap_or_default();
        format!(
            "{} panes, {:.2} million texels, {:.1} MB, planned in {:.2} ms",
            stats.panes,
            stats.texels as f64 / 1e6,
            stats.bytes as f64 / 1e6,
            stats.plan_ms
        )
    }
}
