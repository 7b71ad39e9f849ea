//! The cost of relativity in a window, as it opens without options: all effects, on the default path.
//!
//! The old town is drawn plainly, by the method that `auto` chooses, and by the other one, from the same eye at the
//! same moment. The ways take turns within one run, so that other load on the machine affects all alike. The eye moves
//! on from frame to frame, along the street, by its own time of a frame at 30 frames per second. Time is counted twice:
//! by the clock, and as time of all processors, where a software driver draws. Pictures are compared with 64 traced
//! rays a pixel by FLIP, developed alike.
//!
//! `cargo bench -p rapidity --bench windows`, or with `-- 640x360` for another size, `-- lattice` for another scene,
//! `-- quick` for no comparison with rays, `-- 60s` for
//! more time, `-- map=1.5` for a finer map besides.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use built_in::lattice::Lattice;
use built_in::town;
use glam::DVec3;
use measure::reference::Reference;
use measure::views::further;
use physics::{Beta, Celerity, Observer};
use render::picture::{SCREEN_FORMAT, light};
use render::target::{Format, Radiance};
use render::{DrawCounts, Gpu, Pending, SceneRenderer};
use scene::Scene;
use std::error::Error;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};
use support::{commit, median, milliseconds, processor};
use trace::RayTracer;
use view::{Camera, Dial, Effects, Occasion, PixelSample, Shot};
use walls::FlatPicture;

/// Speeds, fractions of c.
const SPEEDS: [f64; 5] = [0.0, 0.5, 0.8, 0.9, 0.99];
/// Number of frames drawn in one way before the next way has its turn.
const FRAMES: u32 = 4;
/// Time for which each speed is measured, seconds.
const SECONDS: f64 = 12.0;
/// Rays a pixel of the picture that the others are compared with.
const RAYS: u32 = 64;
/// Own time of a frame, metres of light travel at 30 km/h.
const OWN_M: f64 = 30.0 / 3.6 / 30.0;
/// Vertical field of view, degrees.
const FOV_DEG: f64 = 60.0;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| words.iter().any(|given| given == word);
    let sized = words.iter().find_map(|word| {
        let (width, height) = word.split_once('x')?;
        Some([width.parse().ok()?, height.parse().ok()?])
    });
    let size = sized.unwrap_or([1280, 720]);
    let seconds = words.iter().find_map(|word| word.strip_suffix('s')?.parse().ok()).unwrap_or(SECONDS);
    let gpu = Gpu::new()?;
    let scene = if has("lattice") { Lattice::default().build() } else { town::build(town::TOWN_SEED) };
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores", commit(), processor());
    println!("{}, {} at {} x {} pixels", gpu.description(), scene.name, size[0], size[1]);
    println!("medians; ratios to the first way of the same speed\n");
    println!("   v/c  way                      ms  ratio  processors ms  ratio    FLIP  triangles  calls");
    let tracer = if has("quick") { None } else { Some(RayTracer::new(scene.clone(), None, false)?) };
    let scales: Vec<f64> = words.iter().filter_map(|word| word.strip_prefix("map=")?.parse().ok()).collect();
    let mut ways = ways(&gpu, &scene, size, &scales)?;
    for speed in SPEEDS {
        let shot = shot(&scene, speed)?;
        let stop = AtomicBool::new(false);
        let reference = tracer.as_ref().map(|tracer| Reference::trace(tracer, &shot, size, RAYS, &stop));
        for way in &mut ways {
            way.begin(&gpu, &shot, reference.as_ref())?;
        }
        let resting = reference.as_ref().map(|reference| resting(&gpu, &scene, &shot, size, reference)).transpose()?;
        let started = Instant::now();
        while started.elapsed().as_secs_f64() < seconds {
            for way in &mut ways {
                way.turn(&gpu, &shot)?;
            }
        }
        let first = ways[0].times();
        for way in &ways {
            let [clock, processors] = way.times();
            println!(
                "  {speed:4}  {:20} {clock:6.1} {:6.2} {processors:14.1} {:6.2}  {}  {:9}  {:5}",
                way.name,
                clock / first[0],
                processors / first[1],
                way.flip.map_or("      ".to_owned(), |flip| format!("{flip:6.4}")),
                way.drawn.triangles,
                way.drawn.calls,
            );
        }
        if let Some(flip) = resting {
            println!("  {speed:4}  image, nothing changes {:>37} {flip:6.4}", "");
        }
    }
    Ok(())
}

/// FLIP of a window in which nothing has changed for a while.
fn resting(
    gpu: &Gpu,
    scene: &Scene,
    shot: &Shot,
    size: [u32; 2],
    reference: &Reference,
) -> Result<f64, Box<dyn Error>> {
    let (format, map) = (Format::fast(1), window_map(gpu));
    let mut renderer = SceneRenderer::new(gpu, scene.clone(), format, None, Dial::map(map), Occasion::Ride)?;
    let mut picture = FlatPicture::new(gpu, size, format, SCREEN_FORMAT, map);
    picture.draw(gpu, &mut renderer, shot, Pending::default())?;
    std::thread::sleep(Duration::from_millis(300));
    for _ in 0..20 {
        picture.draw(gpu, &mut renderer, shot, Pending::default())?;
    }
    let stored = renderer.stored(shot);
    let (whole, _) = picture.whole(gpu, &mut renderer);
    Ok(reference.compare(&light(gpu, whole, &stored)?).flip)
}

/// Texels of the map for each pixel of a window, along each axis, without options.
fn window_map(gpu: &Gpu) -> f64 {
    if gpu.is_software() { 0.9 } else { 1.5 }
}

/// Picture at a speed, from the scene's start or the outside of a lattice.
fn shot(scene: &Scene, speed: f64) -> Result<Shot, Box<dyn Error>> {
    let look = scene.start.look;
    let celerity = if speed > 0.0 { Beta::new(look * speed)?.celerity() } else { Celerity::ZERO };
    let event = physics::Event { ct: 0.0, position: scene.start.eye() };
    let camera = Camera::looking(look, DVec3::Y, FOV_DEG.to_radians());
    Ok(Shot { camera, observer: Observer { event, celerity }, effects: Effects::ALL, stored_scale: None })
}

/// One way to draw a frame.
struct Way {
    name: String,
    renderer: SceneRenderer,
    radiance: Radiance,
    effects: Effects,
    pending: Pending,
    frames: u32,
    /// Times of the frames by the clock and of all processors, milliseconds.
    clock: Vec<f64>,
    processors: Vec<f64>,
    flip: Option<f64>,
    /// Triangles and calls of the frame drawn last.
    drawn: DrawCounts,
}

fn ways(gpu: &Gpu, scene: &Scene, size: [u32; 2], scales: &[f64]) -> Result<Vec<Way>, Box<dyn Error>> {
    let mut ways = Vec::new();
    let map = window_map(gpu);
    let mut named = vec![
        ("plain", Dial::map(map), Effects::NONE, 1),
        ("image", Dial::map(map), Effects::ALL, 1),
        ("polygon", Dial::tolerance(1.5), Effects::ALL, 1),
    ];
    let finer: Vec<_> = scales.iter().map(|scale| (format!("image {scale}"), *scale)).collect();
    named.extend(finer.iter().map(|(name, scale)| (name.as_str(), Dial::map(*scale), Effects::ALL, 1)));
    for (name, dial, effects, samples) in named {
        let format = Format::fast(samples);
        ways.push(Way {
            name: name.to_owned(),
            renderer: SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?,
            radiance: Radiance::new(gpu, size, format),
            effects,
            pending: Pending::default(),
            frames: 0,
            clock: Vec::new(),
            processors: Vec::new(),
            flip: None,
            drawn: DrawCounts::default(),
        });
    }
    Ok(ways)
}

impl Way {
    /// Draws the first frame at a speed, and compares it with rays.
    fn begin(&mut self, gpu: &Gpu, shot: &Shot, reference: Option<&Reference>) -> Result<(), Box<dyn Error>> {
        (self.frames, self.clock, self.processors) = (0, Vec::new(), Vec::new());
        // The first frames compile pipelines and wait for a cut of their own.
        for _ in 0..3 {
            self.draw(gpu, shot)?;
            self.renderer.settle();
        }
        self.flip = None;
        if let Some(reference) = reference.filter(|_| self.effects == Effects::ALL) {
            let stored = self.renderer.stored(shot);
            self.flip = Some(reference.compare(&light(gpu, self.radiance.result(), &stored)?).flip);
        }
        Ok(())
    }

    fn turn(&mut self, gpu: &Gpu, shot: &Shot) -> Result<(), Box<dyn Error>> {
        let (mut clock, mut processors) = (Vec::new(), Vec::new());
        for _ in 0..FRAMES {
            let shot = further(shot, f64::from(self.frames % 16) * OWN_M);
            let (started, before) = (Instant::now(), processor_time());
            self.draw(gpu, &shot)?;
            clock.push(milliseconds(started.elapsed()));
            processors.push(milliseconds(processor_time().saturating_sub(before)));
            self.frames += 1;
        }
        self.renderer.settle();
        self.clock.push(median(&clock));
        self.processors.push(median(&processors));
        Ok(())
    }

    fn draw(&mut self, gpu: &Gpu, shot: &Shot) -> Result<(), Box<dyn Error>> {
        let shot = Shot { effects: self.effects, ..*shot };
        let before = std::mem::take(&mut self.pending);
        self.pending = self.renderer.submit(gpu, &shot.observer, self.effects)?;
        self.renderer.show(gpu, before)?;
        self.renderer.prepare(gpu, &shot, self.radiance.size);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.renderer.draw(gpu, &mut encoder, &self.radiance, &shot, PixelSample::WHOLE);
        gpu.queue.submit([encoder.finish()]);
        self.drawn = self.renderer.take_drawn();
        Ok(gpu.wait()?)
    }

    fn times(&self) -> [f64; 2] {
        [median(&self.clock), median(&self.processors)]
    }
}

/// Time that all processors have spent on this process, from Linux; zero elsewhere.
fn processor_time() -> Duration {
    let mut total = 0_u64;
    if let Ok(tasks) = std::fs::read_dir("/proc/self/task") {
        for task in tasks.flatten() {
            let text = std::fs::read_to_string(task.path().join("schedstat")).unwrap_or_default();
            total += text.split(' ').next().and_then(|number| number.parse::<u64>().ok()).unwrap_or(0);
        }
    }
    Duration::from_nanos(total)
}
