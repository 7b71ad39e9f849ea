//! The cost of each effect in the old town, over speed and over the map's resolution, and in memory.
//!
//! Each table begins with the default path: the method that `auto` chooses, all effects. In each table the alternatives
//! take turns, a few frames each, so that other load on the machine affects all alike; ratios are of frame times in one
//! round, over those of the row that is drawn plainly. A frame is drawn as in a window, without the window.
//!
//! `cargo bench -p rapidity --bench light`, or with words after `--`: `beta=.9` for another speed than 0.8 c, `640x360`
//! for another size, `scene=lattice` or `scene=FILE.glb` for another scene, `5s` for seconds for each table.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use glam::DVec3;
use physics::{Beta, Celerity, Event, Observer};
use render::display::{Adaptation, Developer, Development, Seen};
use render::target::{Format, Radiance, texture};
use render::{Gpu, GpuError, SceneRenderer};
use scene::Scene;
use scene::refine::refine;
use std::error::Error;
use std::time::Duration;
use support::default_path::{self, DefaultPath, method};
use support::figures::{commit, milliseconds, processor};
use support::frame_times::{FrameTimes, rounds, turn};
use support::words::Words;
use view::{Camera, Dial, Effects, Occasion, PixelSample, Shot};

/// Width and height of a frame, pixels.
const SIZE: [u32; 2] = [1280, 720];
/// Speed, fraction of c.
const SPEED: f64 = 0.8;
/// Number of frames drawn in one way before the next way has its turn.
const FRAMES: usize = 4;
/// Time for which each table is measured, seconds.
const SECONDS: f64 = 15.0;
/// Longest edge of a triangle that is cut once, metres.
const EDGE_M: f64 = 0.5;
const WORDS: &str = "beta=V, a size, as in 640x360, scene=town, lattice or a file, and seconds, as in 5s";

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = Words::given();
    let time = Duration::from_secs_f64(words.seconds().unwrap_or(SECONDS));
    let speed = words.speeds(&[SPEED])?[0];
    let size = words.size().unwrap_or(SIZE);
    let name = words.list("scene")?.first().cloned().unwrap_or_else(|| "town".to_owned());
    words.end(WORDS)?;

    let gpu = Gpu::new()?;
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores", commit(), processor());
    let scene = default_path::scene(&name)?;
    let default = DefaultPath::of(&gpu, &scene)?;
    println!("{}, {} x {} pixels, {} from its start", gpu.description(), size[0], size[1], scene.name);
    println!("medians; ratio = frame time over that of the plain row, with its quartiles");

    let refined = refine(&scene, EDGE_M as f32)?;
    let stage = |scene: &Scene, dial| Stage::new(&gpu, scene, dial, (default.format, size));
    let (doppler, searchlight) =
        (Effects { doppler: true, ..Effects::GEOMETRY }, Effects { searchlight: true, ..Effects::GEOMETRY });
    let effects = [
        ("none (drawn plainly)", Effects::NONE),
        ("geometry", Effects::GEOMETRY),
        ("geometry, doppler", doppler),
        ("geometry, searchlight", searchlight),
        ("all", Effects::ALL),
    ];

    // The photo-surface stays the same in this table; the benchmark `frames` measures its cost.
    println!("\nwhat each effect costs at {speed} c, {} triangles", scene.triangle_count());
    let mut usual = stage(&scene, default.dial)?;
    let others = [default.other(), Dial::edge(EDGE_M)];
    let scenes = [&scene, &refined];
    let mut stages = Vec::new();
    for (dial, scene) in others.into_iter().zip(scenes) {
        stages.push((dial, stage(scene, dial)?));
    }
    let mut rows = vec![Row::new(default.name(), 0, speed, default.effects)];
    rows.extend(effects[..4].iter().map(|(name, effects)| Row::new((*name).to_owned(), 0, speed, *effects)));
    table(&mut rows, time, 1, |row| usual.frame(row.speed, row.effects))?;
    for (dial, stage) in &mut stages {
        println!("\n{} beside it, {} triangles", method(*dial), stage.renderer.triangle_count());
        let mut rows = vec![Row::new(default.name(), 0, speed, default.effects)];
        rows.extend(effects.iter().map(|(name, effects)| Row::new((*name).to_owned(), 1, speed, *effects)));
        table(&mut rows, time, 1, |row| match row.stage {
            0 => usual.frame(row.speed, row.effects),
            _ => stage.frame(row.speed, row.effects),
        })?;
    }

    println!("\nwhat speed costs on the default path");
    let speeds = [speed, 0.0, 0.5, 0.8, 0.95, 0.99, 0.999];
    let mut rows: Vec<_> = speeds.map(|speed| Row::new(format!("{speed} c"), 0, speed, default.effects)).into();
    rows[0].name = format!("{}, {speed} c", default.name());
    rows.insert(1, Row::new("plain".to_owned(), 0, speed, Effects::NONE));
    table(&mut rows, time, 1, |row| usual.frame(row.speed, row.effects))?;
    for row in rows.iter().filter(|row| row.effects != Effects::NONE) {
        usual.frame(row.speed, row.effects)?;
        println!("  {:>42}: {}", row.name, usual.costs());
    }

    println!("\nimage renderer, all effects, at {speed} c: what the map's fineness costs");
    let mut stages = vec![usual];
    let mut rows = vec![
        Row::new(default.name(), 0, speed, default.effects),
        Row::new("plain".to_owned(), 0, speed, Effects::NONE),
    ];
    for texels_per_pixel in [0.5, 0.7, 0.9, 1.5, 3.0] {
        rows.push(Row::new(format!("{texels_per_pixel} texels a pixel"), stages.len(), speed, Effects::ALL));
        stages.push(stage(&scene, Dial::map(texels_per_pixel))?);
    }
    table(&mut rows, time, 1, |row| stages[row.stage].frame(row.speed, row.effects))?;
    for row in rows.iter().filter(|row| row.effects != Effects::NONE) {
        println!("  {:>42}: {}", row.name, stages[row.stage].costs());
    }
    Ok(())
}

/// Row of a table.
struct Row {
    name: String,
    /// Number of the stage that draws it.
    stage: usize,
    speed: f64,
    effects: Effects,
    times: FrameTimes,
}

impl Row {
    fn new(name: String, stage: usize, speed: f64, effects: Effects) -> Self {
        Self { name, stage, speed, effects, times: FrameTimes::default() }
    }
}

/// Measures the rows in turns, and prints them, with ratios to row number `plain`.
fn table(
    rows: &mut [Row],
    time: Duration,
    plain: usize,
    mut frame: impl FnMut(&Row) -> Result<(), GpuError>,
) -> Result<(), GpuError> {
    rounds(time, |counts| {
        for row in &mut *rows {
            let times = turn(FRAMES, || frame(row))?;
            if counts {
                row.times.add(&times);
            }
        }
        Ok(())
    })?;
    for row in &*rows {
        println!("{}", row.times.line(&row.name, &rows[plain].times));
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
    up: DVec3,
}

impl<'gpu> Stage<'gpu> {
    fn new(
        gpu: &'gpu Gpu,
        scene: &Scene,
        dial: Dial,
        (format, size): (Format, [u32; 2]),
    ) -> Result<Self, Box<dyn Error>> {
        let (eye, look, up) = (scene.start.eye(), scene.start.look, scene.start.up);
        let mut renderer = SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?;
        let celerity = Celerity::new(look * SPEED / (1.0 - SPEED * SPEED).sqrt())?;
        let observer = Observer { event: Event { ct: 0.0, position: eye }, celerity };
        let pending = renderer.submit(gpu, &observer, Effects::ALL)?;
        renderer.show(gpu, pending)?;
        let screen = wgpu::TextureFormat::Bgra8Unorm;
        Ok(Self {
            gpu,
            renderer,
            target: Radiance::new(gpu, size, format),
            developer: Developer::new(gpu, format.colour, screen),
            adaptation: Adaptation::new(gpu),
            screen: texture(gpu, "screen", size, screen, 1, wgpu::TextureUsages::RENDER_ATTACHMENT),
            eye,
            look,
            up,
        })
    }

    fn frame(&mut self, beta: f64, effects: Effects) -> Result<(), GpuError> {
        let celerity = Beta::new(self.look * beta).expect("a speed below light's").celerity();
        let observer = Observer { event: Event { ct: 0.0, position: self.eye }, celerity };
        let camera = Camera::looking(self.look, self.up, 60.0_f64.to_radians());
        let shot = Shot { camera, observer, effects, stored_scale: None, outside: None };
        self.renderer.prepare(self.gpu, &shot, self.target.size);
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

    /// Sizes of what was drawn last.
    fn costs(&self) -> String {
        let mut text = format!("{} triangles in all", self.renderer.triangle_count());
        if let Some(map) = self.renderer.map_stats() {
            text += &format!(
                "; {} panes, {:.2} million texels, {:.1} MB, planned in {:.2} ms",
                map.panes,
                map.texels as f64 / 1e6,
                map.bytes as f64 / 1e6,
                map.plan_ms
            );
        }
        if let Some(cut) = self.renderer.cut_stats() {
            text += &format!("; cut of {} triangles in {:.2} ms", cut.triangles, milliseconds(cut.duration));
        }
        text
    }
}
