//! The cost of walls and eyes in the old town at 0.8 c, and the cost of a bent screen.
//!
//! The alternatives take turns, a few frames each, so that other load on the machine affects all alike; ratios are of
//! times in one round. A frame is drawn as in windows, without the windows.
//!
//! `cargo bench -p rapidity --bench walls`
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use built_in::town;
use glam::{DQuat, DVec3};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Beta, Event};
use render::display::Development;
use render::target::{Format, texture};
use render::{Gpu, SceneRenderer};
use room::{Display, EyeSide, file};
use scene::Scene;
use scene::refine::refine;
use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};
use support::{commit, median, milliseconds, processor, quantile};
use view::{Camera, Dial, Effects, Occasion};
use walls::{Occupant, Quality, RoomHead, Walls};

/// Side of a wall, pixels.
const SIDE: u32 = 320;
/// Number of frames drawn in one way before the next way has its turn.
const FRAMES: usize = 3;
/// Time for which each table is measured.
const TIME: Duration = Duration::from_secs(20);
/// Longest edge of a triangle, metres.
const EDGE_M: f64 = 0.5;
/// Map of windows that the CPU draws.
const MAP: Dial = Dial::map(0.9);
const SCREEN: wgpu::TextureFormat = wgpu::TextureFormat::Bgra8Unorm;

fn main() -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::new()?;
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores", commit(), processor());
    println!("{}, the old town from its start at 0.8 c, walls of {SIDE} x {SIDE} pixels", gpu.description());
    println!("medians; ratio = frame time over that of the table's first row, with its quartiles");

    let town = town::build(1);
    let refined = refine(&town, EDGE_M as f32)?;
    for (name, dial, scene) in [("polygon", Dial::edge(EDGE_M), &refined), ("image", MAP, &town)] {
        let mut rows = Vec::new();
        for (walls, eyes) in [(1, 1), (2, 1), (3, 1), (4, 1), (1, 2), (4, 2)] {
            rows.push(Row::new(&gpu, &format!("walls: {walls}, eyes: {eyes}"), cave(walls, eyes), dial, scene)?);
        }
        println!("\n{name} renderer, {} triangles: walls and eyes of cave4", scene.triangle_count());
        table(&gpu, &mut rows)?;

        let mut rows = Vec::new();
        for (what, screen) in [("flat", FLAT), ("bent", BENT)] {
            let text = format!("{screen}\n{CHANNEL}");
            rows.push(Row::new(&gpu, what, file::parse(&text, what, Path::new("."))?, dial, scene)?);
        }
        println!("\n{name} renderer: one screen of 960 x 540 pixels, flat, and bent so that each pixel is looked up");
        table(&gpu, &mut rows)?;
    }
    Ok(())
}

const FLAT: &str = "[[screen]]\nname = \"s\"\nlower_left = [-2.0, 0.5, -2.0]\nlower_right = [2.0, 0.5, -2.0]\nupper_left = [-2.0, 2.75, -2.0]\n";
const BENT: &str =
    "[[screen]]\nname = \"s\"\ncylinder = { radius = 2.83, left = 45.0, right = -45.0, bottom = 0.5, top = 2.75 }\n";
const CHANNEL: &str = "[[window]]\nname = \"w\"\nsize = [960, 540]\n[[channel]]\nname = \"c\"\nscreen = \"s\"\neye = \"centre\"\nwindow = \"w\"\n";

/// Built-in cave, reduced to some walls and eyes.
fn cave(walls: usize, eyes: usize) -> Display {
    let mut display = Display::built_in("cave4").expect("it comes with the program");
    let screens = [1, 0, 2, 3];
    let wanted =
        |eye: EyeSide, screen: usize| screens[..walls].contains(&screen) && (eyes == 2 || eye == EyeSide::Left);
    display.channels.retain(|channel| wanted(channel.eye, channel.screen));
    for (channel, place) in display.channels.iter_mut().zip(0..) {
        channel.viewport = [SIDE * place, 0, SIDE, SIDE];
        channel.window = 0;
    }
    display.windows[0].size = [SIDE * display.channels.len() as u32, SIDE];
    display
}

/// One way to draw a frame.
struct Row {
    name: String,
    renderer: SceneRenderer,
    walls: Walls,
    occupant: Occupant,
    screens: Vec<wgpu::TextureView>,
    /// Medians of the frames and of the photo-surfaces in each round, milliseconds.
    frames: Vec<f64>,
    transforms: Vec<f64>,
}

impl Row {
    fn new(gpu: &Gpu, name: &str, display: Display, dial: Dial, scene: &Scene) -> Result<Self, Box<dyn Error>> {
        let format = Format::fast(1);
        let look = scene.start.look;
        let celerity = Beta::new(look * 0.8)?.celerity();
        let orientation: DQuat = Camera::looking(look, DVec3::Y, 1.0).observer_from_eye;
        let vehicle = WorldlineState::new(Event { ct: 0.0, position: scene.start.position }, celerity, orientation);
        let screens = display.windows.iter();
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let screens = screens.map(|window| texture(gpu, "screen", window.size, SCREEN, 1, usage)).collect();
        let quality = Quality { format, samples: 1, density: 1.0, smooth: true };
        Ok(Self {
            name: name.to_owned(),
            renderer: SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?,
            occupant: Occupant { vehicle, thrust: Thrust::default(), head: RoomHead::at_rest(display.viewer.head_m) },
            walls: Walls::new(gpu, display, quality, SCREEN),
            screens,
            frames: Vec::new(),
            transforms: Vec::new(),
        })
    }

    /// Draws a frame, and returns the time of its photo-surfaces, milliseconds.
    fn frame(&mut self, gpu: &Gpu) -> Result<f64, Box<dyn Error>> {
        let submitted = self.walls.submit(gpu, &mut self.renderer, &self.occupant, Effects::ALL)?;
        let drawn = self.walls.draw(gpu, &mut self.renderer, submitted)?;
        let development = Development::default();
        self.walls.adapt(gpu, &development, Some(0.05));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for (window, screen) in self.screens.iter().enumerate() {
            self.walls.show_window(gpu, &mut encoder, window, &development, screen, [0, 0]);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.wait()?;
        Ok(milliseconds(drawn.transform))
    }
}

/// Measures the rows in turns, and prints them.
fn table(gpu: &Gpu, rows: &mut [Row]) -> Result<(), Box<dyn Error>> {
    let started = Instant::now();
    let mut warm = false;
    while !warm || started.elapsed() < TIME {
        for row in &mut *rows {
            let (mut frames, mut transforms) = (Vec::new(), Vec::new());
            for _ in 0..FRAMES {
                let begun = Instant::now();
                transforms.push(row.frame(gpu)?);
                frames.push(milliseconds(begun.elapsed()));
            }
            // The first round compiles shaders and touches memory, so it does not count.
            if warm {
                row.frames.push(median(&frames));
                row.transforms.push(median(&transforms));
            }
        }
        warm = true;
    }
    for row in &*rows {
        let ratios: Vec<f64> = row.frames.iter().zip(&rows[0].frames).map(|(time, first)| time / first).collect();
        let [low, middle, high] = [0.25, 0.5, 0.75].map(|share| quantile(&ratios, share));
        let (frame, transform) = (median(&row.frames), median(&row.transforms));
        println!(
            "  {:>18}: {frame:7.1} ms, ratio {middle:.3} ({low:.3} to {high:.3}); photo-surfaces {transform:5.2} ms",
            row.name
        );
    }
    Ok(())
}
