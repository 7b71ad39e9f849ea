//! The cost of a headset: a frame for both eyes that is handed to the runtime, against the same two views in a window,
//! and the time from a pose to its picture.
//!
//! The views, their sizes and the frames' times are the runtime's. Each way has one frame of the runtime in turn, so
//! that other load on the machine affects all alike; ratios are of times in one round. A frame is drawn as a ride draws
//! it without options, and its time ends when the graphics device has done its work; that the runtime makes a program
//! wait until the next frame is not counted. The vehicle moves on from frame to frame, by the headset's own rate.
//!
//! It needs an OpenXR runtime: `make bench-headset` simulates one. With words after `--`: `beta=.9` sets the speed,
//! `scene=lattice` or `scene=FILE.glb` the scene; `20s`: seconds for each method.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use glam::{DMat3, DQuat, DVec3};
use headset::{Headset, HeadsetDevice, HeadsetTurn};
use input::openxr::{XrRuntime, XrUse};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Beta, Celerity, Event};
use render::display::Development;
use render::target::texture;
use render::{Gpu, SceneRenderer};
use room::Display;
use scene::Scene;
use std::error::Error;
use std::time::{Duration, Instant};
use support::default_path::{self, DefaultPath, method};
use support::figures::{commit, median, milliseconds, processor, quantile};
use support::frame_times::{FrameTimes, rounds};
use support::words::Words;
use view::{Camera, Dial, Effects, Occasion};
use walls::{Occupant, Quality, RoomHead, Walls};

/// Speed, fraction of c.
const SPEED: f64 = 0.8;
/// Time for which each method is measured, seconds.
const SECONDS: f64 = 40.0;
/// Speed of light where the scene does not say, m/s.
const LIGHT_M_S: f64 = 30.0 / 3.6;
/// Time in which a session begins.
const PATIENCE: Duration = Duration::from_secs(20);
/// Frames of the vehicle's way, after which it begins again.
const WAY: u32 = 16;
const WORDS: &str = "beta=V, scene=town, lattice or a file, and seconds, as in 20s";

/// Ways to show the two views; the first is that of all ratios.
const WAYS: [(&str, Way); 5] = [
    ("in a window", Way::Window),
    ("in the headset", Way::Headset { in_one_pass: true, extras: true }),
    ("in a pass for each eye", Way::Headset { in_one_pass: false, extras: true }),
    ("without mask and depth", Way::Headset { in_one_pass: true, extras: false }),
    ("in a pass for each eye, without both", Way::Headset { in_one_pass: false, extras: false }),
];

/// Way to show two views.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    /// Beside each other in a window's picture.
    Window,
    /// In the pictures that the runtime lends; `extras`: depth for the runtime, and nothing where no lens shows
    /// anything.
    Headset { in_one_pass: bool, extras: bool },
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = Words::given();
    let seconds = words.seconds().unwrap_or(SECONDS);
    let speed = words.speeds(&[SPEED])?[0];
    let name = words.list("scene")?.first().cloned().unwrap_or_else(|| "town".to_owned());
    words.end(WORDS)?;

    let runtime = match XrRuntime::new(XrUse::Pictures) {
        Ok(runtime) => runtime,
        Err(fault) => {
            println!("left out, since there is no headset (make bench-headset simulates one): {fault}");
            return Ok(());
        }
    };
    let device = HeadsetDevice::open(&runtime)?;
    let mut headset = Headset::new(runtime, &device)?;
    let gpu = &device.gpu;
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores", commit(), processor());
    let (of, by) = headset.names();
    println!("{of}, by {by}, {:?} pixels, on {}", headset.sizes(), gpu.description());
    let scene = default_path::scene(&name)?;
    println!("{} from its start at {speed} c, {} triangles", scene.name, scene.triangle_count());
    println!("medians; ratio = frame time over that of the same two views in a window, with its quartiles");
    let default = DefaultPath::of(gpu, &scene)?;
    for (name, dial) in [(default.name(), default.dial), (method(default.other()), default.other())] {
        println!("\n{name}, {} samples a pixel", default.format.samples);
        let celerity = if speed > 0.0 { Beta::new(scene.start.look * speed)?.celerity() } else { Celerity::ZERO };
        let mut bench = Bench::new(gpu, &headset, &scene, (dial, &default), celerity)?;
        bench.measure(&mut headset, Duration::from_secs_f64(seconds))?;
        bench.tell();
    }
    Ok(())
}

/// One method's frames.
struct Bench<'a> {
    gpu: &'a Gpu,
    renderer: SceneRenderer,
    /// Channels for each of the ways.
    walls: Vec<Walls>,
    window: wgpu::TextureView,
    /// True if the device can draw both eyes in one pass.
    draws_views: bool,
    effects: Effects,
    /// Event, celerity and axes of the vehicle at the beginning of its way.
    start: (Event, Celerity, DQuat),
    light_m_s: f64,
    frames: u32,
    times: Vec<FrameTimes>,
    /// Times from pose to picture, and to light, milliseconds.
    pose_to_picture: Vec<f64>,
    pose_to_light: Vec<f64>,
}

impl<'a> Bench<'a> {
    fn new(
        gpu: &'a Gpu,
        headset: &Headset,
        scene: &Scene,
        (dial, default): (Dial, &DefaultPath),
        celerity: Celerity,
    ) -> Result<Self, Box<dyn Error>> {
        let sizes = headset.sizes();
        let quality = Quality { format: default.format, samples: 1, density: 1.0, smooth: true };
        let channels = |(_, way): &(&str, Way)| {
            let mut display = Display::headset("headset", &room::HeadsetEye::usual(sizes.len()), sizes);
            if *way == Way::Window {
                beside_each_other(&mut display);
            }
            let mut walls = Walls::new(gpu, display, quality, headset.format());
            if matches!(way, Way::Headset { extras: true, .. }) {
                (0..sizes.len()).for_each(|view| walls.hide(gpu, view, &headset.hidden(view)));
                walls.keep_depth(gpu);
            }
            walls
        };
        let width = sizes.iter().map(|size| size[0]).sum();
        let height = sizes.iter().map(|size| size[1]).max().unwrap_or_default();
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let orientation = Camera::looking(scene.start.look, scene.start.up, 1.0).observer_from_eye;
        Ok(Self {
            renderer: SceneRenderer::new(gpu, scene.clone(), default.format, None, dial, Occasion::Ride)?,
            walls: WAYS.iter().map(channels).collect(),
            window: texture(gpu, "window", [width, height], headset.format(), 1, usage),
            draws_views: walls::draws_views(gpu),
            effects: default.effects,
            start: (Event { ct: 0.0, position: scene.start.position }, celerity, orientation),
            light_m_s: scene.speed_of_light_m_s.unwrap_or(LIGHT_M_S),
            frames: 0,
            times: vec![FrameTimes::default(); WAYS.len()],
            pose_to_picture: Vec::new(),
            pose_to_light: Vec::new(),
            gpu,
        })
    }

    fn measure(&mut self, headset: &mut Headset, time: Duration) -> Result<(), Box<dyn Error>> {
        rounds(time, |counts| {
            for (number, (_, way)) in WAYS.into_iter().enumerate() {
                // The first frame of a way comes after that of another, and makes its cut or map.
                for warm in [false, true] {
                    let took = self.frame(headset, number, way, counts && warm)?;
                    if counts && warm {
                        self.times[number].add(&[took]);
                    }
                }
            }
            Ok(())
        })
    }

    /// Draws and shows a frame. Returns its time, milliseconds.
    fn frame(&mut self, headset: &mut Headset, number: usize, way: Way, counts: bool) -> Result<f64, Box<dyn Error>> {
        let turn = next(headset)?;
        let occupant = self.occupant(&turn);
        let (gpu, development) = (self.gpu, Development::default());
        let walls = &mut self.walls[number];
        walls.headset = Some(turn.eyes.clone());
        let began = Instant::now();
        let submitted = walls.submit(gpu, &mut self.renderer, &occupant, self.effects)?;
        walls.draw(gpu, &mut self.renderer, submitted)?;
        walls.adapt(gpu, &development, Some(0.05));
        let took = match way {
            Way::Window => {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                walls.show_window(gpu, &mut encoder, 0, &development, &self.window, [0, 0]);
                gpu.queue.submit([encoder.finish()]);
                gpu.wait()?;
                let took = began.elapsed();
                headset.show(&turn, |_| false)?;
                took
            }
            Way::Headset { in_one_pass, .. } => {
                headset.in_one_pass = in_one_pass && self.draws_views;
                headset.show(&turn, |pictures| pictures.show(gpu, walls, &development))?;
                let handed_over = turn.asked.elapsed();
                gpu.wait()?;
                let took = began.elapsed();
                if counts {
                    self.pose_to_picture.push(milliseconds(handed_over));
                    self.pose_to_light.extend(turn.lead.map(milliseconds));
                }
                took
            }
        };
        self.renderer.settle();
        gpu.wait()?;
        Ok(milliseconds(took))
    }

    /// Occupant at the next frame, with the headset's head.
    fn occupant(&mut self, turn: &HeadsetTurn) -> Occupant {
        let own_m = self.light_m_s * turn.period.as_secs_f64() * f64::from(self.frames % WAY);
        self.frames += 1;
        let (event, celerity, orientation) = self.start;
        let position: DVec3 = event.position + celerity.vector() * own_m;
        let vehicle =
            WorldlineState::new(Event { ct: event.ct + celerity.gamma() * own_m, position }, celerity, orientation);
        let pose = turn.report.head;
        let place_m = DVec3::from_array(pose.position_m.unwrap_or([0.0, 1.2, 0.0]).map(f64::from));
        let turned = DQuat::from_array(pose.orientation.unwrap_or([0.0, 0.0, 0.0, 1.0]).map(f64::from));
        let head = RoomHead { room_from_head: DMat3::from_quat(turned.normalize()), ..RoomHead::at_rest(place_m) };
        Occupant { vehicle, thrust: Thrust::default(), head }
    }

    fn tell(&self) {
        for ((name, _), times) in WAYS.iter().zip(&self.times) {
            println!("{}", times.line(name, &self.times[0]));
        }
        let line = |name: &str, times: &[f64]| match times {
            [] => println!("  {name}: the runtime's clock cannot be read"),
            _ => println!("  {name}: {:.2} ms, 95 % in {:.2} ms", median(times), quantile(times, 0.95)),
        };
        line("from a pose to its picture, handed over", &self.pose_to_picture);
        line("from a pose to its light, as the runtime foresees", &self.pose_to_light);
    }
}

/// Puts the pictures of a headset beside each other in one window.
fn beside_each_other(display: &mut Display) {
    let mut x = 0;
    for channel in &mut display.channels {
        channel.window = 0;
        channel.viewport[0] = x;
        x += channel.viewport[2];
    }
    display.windows[0].size[0] = x;
    display.windows.truncate(1);
}

/// Next turn that will be seen.
fn next(headset: &mut Headset) -> Result<HeadsetTurn, Box<dyn Error>> {
    let began = Instant::now();
    while began.elapsed() < PATIENCE {
        match headset.wait()? {
            Some(turn) if turn.is_seen => return Ok(turn),
            Some(turn) => headset.show(&turn, |_| false)?,
            None => {}
        }
    }
    Err("the session does not begin".into())
}
