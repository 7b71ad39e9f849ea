//! The cost of relativity in a window, as it opens without options: all effects, on the default path.
//!
//! The old town is drawn by the method that `auto` chooses (the default path), plainly, and by the other method, from
//! the same eye at the same moment, with every pixel of the window (`--frame-rate off`). The ways take turns within one
//! run, so that other load on the machine affects all alike. The eye moves on from frame to frame, along the street, by
//! its own time of a frame at 30 frames per second. Time is counted twice: by the clock, and as time of all processors,
//! where a software driver draws. Pictures are compared with 64 traced rays a pixel by FLIP, developed alike.
//!
//! `cargo bench -p rapidity --bench windows`, or with words after `--`:
//! - `640x360`: size of the window; `beta=0,.8,.99`: speeds; `scene=lattice` or `scene=FILE.glb`: another scene;
//! - `quick`: no comparison with rays; `60s`: seconds for each speed; `map=1.5`: a finer map besides;
//! - `markdown`: only the default path and plain, without rays, as rows for Markdown.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use measure::reference::Reference;
use measure::views::further;
use physics::{Beta, Celerity, Observer};
use render::target::Radiance;
use render::{DrawCounts, Gpu, Pending, SceneRenderer};
use scene::Scene;
use std::error::Error;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};
use studio::{SCREEN_FORMAT, light};
use support::default_path::{self, DefaultPath, method};
use support::figures::{commit, median, milliseconds, processor};
use support::frame_times::{FrameTimes, rounds};
use support::words::Words;
use trace::RayTracer;
use view::{Camera, Dial, Effects, Occasion, PixelSample, RendererName, Shot};
use walls::FlatPicture;

/// Speeds, fractions of c.
const SPEEDS: [f64; 5] = [0.0, 0.5, 0.8, 0.9, 0.99];
/// Number of frames drawn in one way before the next way has its turn.
const FRAMES: u32 = 4;
/// Time for which each speed is measured, seconds.
const SECONDS: f64 = 12.0;
/// Pause after which a thread that cuts takes up the next cut.
const CUT_REST: Duration = Duration::from_millis(400);
/// Rays a pixel of the picture that the others are compared with.
const RAYS: u32 = 64;
/// Frames per second of the eye's own time.
const RATE_HZ: f64 = 30.0;
/// Speed of light where the scene does not say, m/s.
const LIGHT_M_S: f64 = 30.0 / 3.6;
/// Vertical field of view, degrees.
const FOV_DEG: f64 = 60.0;

const WORDS: &str =
    "a size, as in 640x360, beta=V,V…, scene=town, lattice or a file, map=N, quick, markdown, and seconds, as in 60s";

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = Words::given();
    let (quick, markdown) = (words.has("quick"), words.has("markdown"));
    let size = words.size().unwrap_or([1280, 720]);
    let seconds = words.seconds().unwrap_or(SECONDS);
    let speeds = words.speeds(&SPEEDS)?;
    let scales = words.list("map")?;
    let name = words.list("scene")?.first().cloned().unwrap_or_else(|| "town".to_owned());
    words.end(WORDS)?;

    let gpu = Gpu::new()?;
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores", commit(), processor());
    let scene = default_path::scene(&name)?;
    let default = DefaultPath::of(&gpu, &scene)?;
    println!("{}", gpu.description());
    let samples = default.format.samples;
    println!("{} at {} x {} pixels, {samples} samples a pixel", scene.name, size[0], size[1]);
    if !markdown {
        println!("medians; ratios to the plain way of the same speed\n");
        println!(
            "   v/c  way                             ms  95 % in  ratio  processors ms  ratio    FLIP  triangles  calls"
        );
    }
    let tracer = if quick || markdown { None } else { Some(RayTracer::new(scene.clone(), None, false)?) };
    let mut ways = ways(&gpu, &scene, size, default, &scales, markdown)?;
    for speed in speeds {
        let shot = shot(&scene, speed)?;
        let stop = AtomicBool::new(false);
        let reference = tracer.as_ref().map(|tracer| Reference::trace(tracer, &shot, size, RAYS, &stop));
        for way in &mut ways {
            way.begin(&gpu, &shot, reference.as_ref())?;
        }
        let resting = reference.as_ref().filter(|_| default.dial.renderer == RendererName::Image);
        let resting = resting.map(|rays| resting_flip(&gpu, &scene, &shot, size, default, rays)).transpose()?;
        rounds(Duration::from_secs_f64(seconds), |counts| {
            ways.iter_mut().try_for_each(|way| way.turn(&gpu, &shot, counts))
        })?;
        let plain = (ways[PLAIN].clock.clone(), median(&ways[PLAIN].processors));
        for way in &ways {
            if markdown {
                let size = format!("{} x {}", size[0], size[1]);
                let cells = [&scene.name, "one window", &size, &format!("{speed}"), &way.name];
                println!("{}", way.clock.markdown(&cells, &plain.0));
                continue;
            }
            let ([_, ratio, _], processors) = (way.clock.ratio(&plain.0), median(&way.processors));
            println!(
                "  {speed:4}  {:26} {:7.1} {:8.1} {ratio:6.2} {processors:14.1} {:6.2}  {}  {:9}  {:5}",
                way.name,
                way.clock.median_ms(),
                way.clock.slow_ms(),
                processors / plain.1,
                way.flip.map_or("      ".to_owned(), |flip| format!("{flip:6.4}")),
                way.drawn.triangles,
                way.drawn.calls,
            );
        }
        if let Some(flip) = resting {
            println!("  {speed:4}  image, nothing changes {:>47} {flip:6.4}", "");
        }
    }
    Ok(())
}

/// FLIP of a window in which nothing has changed for a while.
fn resting_flip(
    gpu: &Gpu,
    scene: &Scene,
    shot: &Shot,
    size: [u32; 2],
    default: DefaultPath,
    reference: &Reference,
) -> Result<f64, Box<dyn Error>> {
    let DefaultPath { dial, format, .. } = default;
    let map = dial.map_scale.unwrap_or(1.0);
    let mut renderer = SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?;
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

/// Picture at a speed, from the scene's start.
fn shot(scene: &Scene, speed: f64) -> Result<Shot, Box<dyn Error>> {
    let look = scene.start.look;
    let celerity = if speed > 0.0 { Beta::new(look * speed)?.celerity() } else { Celerity::ZERO };
    let event = physics::Event { ct: 0.0, position: scene.start.eye() };
    let camera = Camera::looking(look, scene.start.up, FOV_DEG.to_radians());
    Ok(Shot {
        camera,
        observer: Observer { event, celerity },
        effects: Effects::ALL,
        stored_scale: None,
        outside: None,
    })
}

/// One way to draw a frame.
struct Way {
    name: String,
    renderer: SceneRenderer,
    radiance: Radiance,
    effects: Effects,
    pending: Pending,
    /// Own time of a frame, metres of light travel.
    own_m: f64,
    frames: u32,
    /// Times of the frames by the clock.
    clock: FrameTimes,
    /// Times of all processors for a frame, a median for each turn, milliseconds.
    processors: Vec<f64>,
    flip: Option<f64>,
    /// Triangles and calls of the frame drawn last.
    drawn: DrawCounts,
}

/// Number of the way that draws plainly.
const PLAIN: usize = 1;

/// The default path, plain, and, unless these are all, the other method and maps of other scales.
fn ways(
    gpu: &Gpu,
    scene: &Scene,
    size: [u32; 2],
    default: DefaultPath,
    scales: &[f64],
    all: bool,
) -> Result<Vec<Way>, Box<dyn Error>> {
    let DefaultPath { dial, format, effects } = default;
    let mut named = vec![(default.name(), dial, effects), ("plain".to_owned(), dial, Effects::NONE)];
    if !all {
        named.push((method(default.other()), default.other(), effects));
    }
    named.extend(scales.iter().map(|scale| (method(Dial::map(*scale)), Dial::map(*scale), effects)));
    let way = |(name, dial, effects)| {
        Ok(Way {
            name,
            renderer: SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?,
            radiance: Radiance::new(gpu, size, format),
            effects,
            pending: Pending::default(),
            own_m: scene.speed_of_light_m_s.unwrap_or(LIGHT_M_S) / RATE_HZ,
            frames: 0,
            clock: FrameTimes::default(),
            processors: Vec::new(),
            flip: None,
            drawn: DrawCounts::default(),
        })
    };
    named.into_iter().map(way).collect()
}

impl Way {
    /// Draws the first frame at a speed, and compares it with rays.
    fn begin(&mut self, gpu: &Gpu, shot: &Shot, reference: Option<&Reference>) -> Result<(), Box<dyn Error>> {
        (self.frames, self.clock, self.processors) = (0, FrameTimes::default(), Vec::new());
        // The first frames compile pipelines. The thread that cuts rests after each cut; then it makes one for this
        // speed.
        for _ in 0..5 {
            self.draw(gpu, shot)?;
            self.renderer.settle();
            std::thread::sleep(CUT_REST);
        }
        self.flip = None;
        if let Some(reference) = reference.filter(|_| self.effects == Effects::ALL) {
            let stored = self.renderer.stored(shot);
            self.flip = Some(reference.compare(&light(gpu, self.radiance.result(), &stored)?).flip);
        }
        Ok(())
    }

    /// Draws the frames of a turn; the first one, which comes after another way's, is not counted.
    fn turn(&mut self, gpu: &Gpu, shot: &Shot, counts: bool) -> Result<(), Box<dyn Error>> {
        let (mut clock, mut processors) = (Vec::new(), Vec::new());
        for number in 0..=FRAMES {
            let shot = further(shot, f64::from(self.frames % 16) * self.own_m);
            let (started, before) = (Instant::now(), processor_time());
            self.draw(gpu, &shot)?;
            if number > 0 {
                clock.push(milliseconds(started.elapsed()));
                processors.push(milliseconds(processor_time().saturating_sub(before)));
            }
            self.frames += 1;
        }
        self.renderer.settle();
        if counts {
            self.clock.add(&clock);
            self.processors.push(median(&processors));
        }
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
