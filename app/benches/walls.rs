//! The cost of walls and eyes, as `rapidity ride --display cave4` draws them without options, and the cost of a bent
//! screen.
//!
//! Each table begins with the default path: the method that `auto` chooses, all effects. The same walls drawn plainly,
//! as if light were infinitely fast, are beside it. The alternatives take turns, a few frames each, so that other load
//! on the machine affects all alike; ratios are of times in one round. A frame is drawn as in windows, without the
//! windows. The vehicle moves on from frame to frame, by its own time of a frame at 30 frames per second.
//!
//! `cargo bench -p rapidity --bench walls`, or with words after `--`:
//! - `beta=.9` sets the speed, `side=1920` the pixels of a wall, `scene=lattice`, `scene=table1` to `table3` (of the
//!   sizes of W table 6.1) or `scene=FILE.glb` the scene;
//! - `walls=4` or `walls=6`: only four or six walls, for two eyes;
//! - `quick`: only the first table; `5s`: seconds for each table; `markdown`: rows of the first table for Markdown.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use glam::{DQuat, DVec3};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Beta, Celerity, Event};
use render::display::Development;
use render::target::texture;
use render::{DrawCounts, Gpu, SceneRenderer};
use room::{Display, EyeSide, file};
use scene::Scene;
use scene::refine::refine;
use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};
use support::default_path::{self, DefaultPath, method};
use support::figures::{commit, median, milliseconds, processor};
use support::frame_times::{FrameTimes, rounds, turn};
use support::words::Words;
use view::{Camera, Dial, Effects, Occasion};
use walls::{Occupant, Quality, RoomHead, SubmittedRoom, Walls};

/// Side of a wall, pixels.
const SIDE: u32 = 320;
/// Speed, fraction of c.
const SPEED: f64 = 0.8;
/// Number of frames drawn in one way before the next way has its turn.
const FRAMES: usize = 4;
/// Time for which each table is measured, seconds.
const SECONDS: f64 = 20.0;
/// Longest edge of a triangle that is cut once, metres.
const EDGE_M: f64 = 0.5;
/// Frames of the vehicle's way, after which it begins again.
const WAY: u32 = 16;
/// Frames per second of the vehicle's own time.
const RATE_HZ: f64 = 30.0;
/// Speed of light where the scene does not say, m/s.
const LIGHT_M_S: f64 = 30.0 / 3.6;
const SCREEN: wgpu::TextureFormat = wgpu::TextureFormat::Bgra8Unorm;
const WORDS: &str = "beta=V, side=N, walls=4 or 6, scene=town, lattice, table1 to table3 or a file, quick, markdown, and seconds, as in 5s";

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = Words::given();
    let (quick, markdown) = (words.has("quick"), words.has("markdown"));
    let seconds = words.seconds().unwrap_or(SECONDS);
    let speed = words.speeds(&[SPEED])?[0];
    let side = words.list("side")?.first().copied().unwrap_or(SIDE).clamp(1, 8192);
    let only: Option<usize> = words.list("walls")?.first().copied();
    if only.is_some_and(|walls| ![4, 6].contains(&walls)) {
        return Err("walls=: a room of 4 or 6 walls can be measured".into());
    }
    let name = words.list("scene")?.first().cloned().unwrap_or_else(|| "town".to_owned());
    words.end(WORDS)?;

    let gpu = Gpu::new()?;
    let cores = std::thread::available_parallelism()?;
    println!("commit {}, {}, {cores} cores", commit(), processor());
    let scene = default_path::scene(&name)?;
    let bench = Bench { default: DefaultPath::of(&gpu, &scene)?, gpu, scene, speed, seconds };
    println!("{}", bench.gpu.description());
    println!(
        "{} from its start at {speed} c, {} triangles, walls of {side} x {side} pixels, {} samples a pixel",
        bench.scene.name,
        bench.scene.triangle_count(),
        bench.default.format.samples
    );
    println!("medians; ratio = frame time over that of the same walls drawn plainly, with its quartiles");

    let walls = only.unwrap_or(4);
    let mut rows = bench.rows(&format!("{walls} walls, 2 eyes"), || cave(walls, 2, side), markdown)?;
    bench.measure(&mut rows)?;
    if markdown {
        for row in &rows {
            let cells = [&bench.scene.name, &row.room, &format!("{side} x {side}"), &format!("{speed}"), &row.name];
            println!("{}", row.times.markdown(&cells.map(String::as_str), &rows[row.plain].times));
        }
        return Ok(());
    }
    println!("\n{walls} walls for two eyes");
    bench.tell(&mut rows, true)?;
    if quick || only.is_some() {
        return Ok(());
    }

    let mut rows = Vec::new();
    for (walls, eyes) in [(1, 1), (2, 1), (3, 1), (4, 1), (1, 2), (4, 2)] {
        let room = format!("{walls} x {eyes}");
        rows.extend(bench.pair(&room, || cave(walls, eyes, side), rows.len())?);
    }
    println!("\nwalls x eyes of cave4, on the default path");
    bench.measure(&mut rows)?;
    bench.tell(&mut rows, false)?;

    let refined = refine(&bench.scene, EDGE_M as f32)?;
    let mut rows = bench.pair("4 x 2", || cave(4, 2, side), 0)?;
    for (walls, eyes) in [(1, 1), (2, 1), (3, 1), (4, 1), (1, 2), (4, 2)] {
        let (room, dial) = (format!("{walls} x {eyes}"), Dial::edge(EDGE_M));
        rows.push(bench.row(&room, method(dial), cave(walls, eyes, side), dial, Effects::ALL, &refined)?.of_plain(1));
    }
    println!("\nwalls x eyes, edges cut once, {} triangles", refined.triangle_count());
    bench.measure(&mut rows)?;
    bench.tell(&mut rows, false)?;

    let screen = |shape: &str| file::parse(&format!("{shape}\n{CHANNEL}"), "screen", Path::new("."));
    let mut rows = Vec::new();
    for (what, shape) in [("bent", BENT), ("flat", FLAT)] {
        for dial in [bench.default.dial, bench.default.other()] {
            let name = if rows.is_empty() { bench.default.name() } else { method(dial) };
            rows.push(bench.row(what, name, screen(shape)?, dial, bench.default.effects, &bench.scene)?);
        }
    }
    rows.push(bench.row("flat", "plain".to_owned(), screen(FLAT)?, bench.default.dial, Effects::NONE, &bench.scene)?);
    let plain = rows.len() - 1;
    rows.iter_mut().for_each(|row| row.plain = plain);
    println!("\none screen of 960 x 540 pixels, flat, and bent so that each pixel is looked up");
    bench.measure(&mut rows)?;
    bench.tell(&mut rows, false)
}

const FLAT: &str = "[[screen]]\nname = \"s\"\nlower_left = [-2.0, 0.5, -2.0]\nlower_right = [2.0, 0.5, -2.0]\nupper_left = [-2.0, 2.75, -2.0]\n";
const BENT: &str =
    "[[screen]]\nname = \"s\"\ncylinder = { radius = 2.83, left = 45.0, right = -45.0, bottom = 0.5, top = 2.75 }\n";
const CHANNEL: &str = "[[window]]\nname = \"w\"\nsize = [960, 540]\n[[channel]]\nname = \"c\"\nscreen = \"s\"\neye = \"centre\"\nwindow = \"w\"\n";

/// Room of some walls for some eyes, from the built-in rooms. The first wall is in front.
fn cave(walls: usize, eyes: usize, side: u32) -> Display {
    let name = if walls > 4 { "cave6" } else { "cave4" };
    let mut display = Display::built_in(name).expect("it comes with the program");
    let screens = if walls > 4 { &[1, 0, 2, 3, 4, 5][..] } else { &[1, 0, 2, 3] };
    let wanted =
        |eye: EyeSide, screen: usize| screens[..walls].contains(&screen) && (eyes == 2 || eye == EyeSide::Left);
    display.channels.retain(|channel| wanted(channel.eye, channel.screen));
    // A window for each eye holds its walls in two lines, which devices allow where one long line would be too wide.
    let columns = (walls as u32).div_ceil(2);
    display.windows.truncate(eyes);
    for window in &mut display.windows {
        window.size = [side * columns, side * 2];
    }
    let mut places = [0; 2];
    for channel in &mut display.channels {
        channel.window = usize::from(channel.eye == EyeSide::Right);
        let place = &mut places[channel.window];
        channel.viewport = [side * (*place % columns), side * (*place / columns), side, side];
        *place += 1;
    }
    display
}

/// What is measured.
struct Bench {
    gpu: Gpu,
    scene: Scene,
    default: DefaultPath,
    speed: f64,
    seconds: f64,
}

impl Bench {
    /// The default path and the plain row of a room, as rows `first` and `first + 1`.
    fn pair(&self, room: &str, display: impl Fn() -> Display, first: usize) -> Result<Vec<Row>, Box<dyn Error>> {
        let DefaultPath { dial, effects, .. } = self.default;
        let row = |name, effects| self.row(room, name, display(), dial, effects, &self.scene);
        let rows = [row(self.default.name(), effects)?, row("plain".to_owned(), Effects::NONE)?];
        Ok(rows.map(|row| row.of_plain(first + 1)).into())
    }

    /// The default path, plain, and, unless that is all, the other method.
    fn rows(&self, room: &str, display: impl Fn() -> Display, all: bool) -> Result<Vec<Row>, Box<dyn Error>> {
        let mut rows = self.pair(room, &display, 0)?;
        if !all {
            let dial = self.default.other();
            rows.push(self.row(room, method(dial), display(), dial, self.default.effects, &self.scene)?.of_plain(1));
        }
        Ok(rows)
    }

    fn row(
        &self,
        room: &str,
        name: String,
        display: Display,
        dial: Dial,
        effects: Effects,
        scene: &Scene,
    ) -> Result<Row, Box<dyn Error>> {
        let (gpu, format) = (&self.gpu, self.default.format);
        let celerity =
            if self.speed > 0.0 { Beta::new(scene.start.look * self.speed)?.celerity() } else { Celerity::ZERO };
        let orientation: DQuat = Camera::looking(scene.start.look, scene.start.up, 1.0).observer_from_eye;
        // An eye in mid-air is the head's; one above the ground stands on it.
        let head_m = display.viewer.head_m;
        let ground = scene.start.position;
        let position = if scene.start.eye_height_m > 0.0 { ground } else { ground - orientation * head_m };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let screens =
            display.windows.iter().map(|window| texture(gpu, "screen", window.size, SCREEN, 1, usage)).collect();
        let quality = Quality { format, samples: 1, density: 1.0, smooth: true };
        Ok(Row {
            room: room.to_owned(),
            name,
            renderer: SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?,
            walls: Walls::new(gpu, display, quality, SCREEN),
            screens,
            effects,
            start: (Event { ct: 0.0, position }, celerity, orientation),
            head: RoomHead::at_rest(head_m),
            own_m: scene.speed_of_light_m_s.unwrap_or(LIGHT_M_S) / RATE_HZ,
            frames: 0,
            under_way: None,
            plain: 0,
            times: FrameTimes::default(),
        })
    }

    /// Draws the rows in turns.
    fn measure(&self, rows: &mut [Row]) -> Result<(), Box<dyn Error>> {
        rounds(Duration::from_secs_f64(self.seconds), |counts| {
            for row in &mut *rows {
                let times = turn(FRAMES, || row.frame(&self.gpu))?;
                row.rest(&self.gpu)?;
                if counts {
                    row.times.add(&times);
                }
            }
            Ok(())
        })
    }

    /// Prints the rows; `stages`: with the times of their stages.
    fn tell(&self, rows: &mut [Row], stages: bool) -> Result<(), Box<dyn Error>> {
        for row in &*rows {
            let plain = &rows[row.plain].times;
            println!("{}", row.times.line(&format!("{}, {}", row.room, row.name), plain));
        }
        for row in rows {
            if stages || row.effects != Effects::NONE {
                let stages = row.stages(&self.gpu)?;
                println!("  {:>42}: {stages}", row.name);
            }
        }
        Ok(())
    }
}

/// One way to draw a frame.
struct Row {
    room: String,
    name: String,
    renderer: SceneRenderer,
    walls: Walls,
    screens: Vec<wgpu::TextureView>,
    effects: Effects,
    /// Event, celerity and axes of the vehicle at the beginning of its way.
    start: (Event, Celerity, DQuat),
    head: RoomHead,
    /// Own time of a frame, metres of light travel.
    own_m: f64,
    frames: u32,
    under_way: Option<SubmittedRoom>,
    /// Number of the row that is drawn plainly.
    plain: usize,
    times: FrameTimes,
}

impl Row {
    fn of_plain(self, plain: usize) -> Self {
        Self { plain, ..self }
    }

    /// Occupant at the next frame.
    fn next(&mut self) -> Occupant {
        let own_m = self.own_m * f64::from(self.frames % WAY);
        self.frames += 1;
        let (event, celerity, orientation) = self.start;
        let position: DVec3 = event.position + celerity.vector() * own_m;
        let event = Event { ct: event.ct + celerity.gamma() * own_m, position };
        let vehicle = WorldlineState::new(event, celerity, orientation);
        Occupant { vehicle, thrust: Thrust::default(), head: self.head }
    }

    fn submit(&mut self, gpu: &Gpu) -> Result<SubmittedRoom, Box<dyn Error>> {
        let occupant = self.next();
        Ok(self.walls.submit(gpu, &mut self.renderer, &occupant, self.effects)?)
    }

    /// Draws a frame. Where photo-surfaces are computed, those of the next frame are under way meanwhile.
    fn frame(&mut self, gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        let newest = self.submit(gpu)?;
        let shown = if newest.is_under_way() {
            match self.under_way.replace(newest) {
                Some(before) => before,
                None => self.submit(gpu)?,
            }
        } else {
            newest
        };
        self.walls.draw(gpu, &mut self.renderer, shown)?;
        self.show(gpu);
        Ok(gpu.wait()?)
    }

    /// Ends the work that is under way, so that it does not go on in another way's turn.
    fn rest(&mut self, gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        if let Some(submitted) = self.under_way.take() {
            self.walls.draw(gpu, &mut self.renderer, submitted)?;
        }
        self.renderer.settle();
        Ok(gpu.wait()?)
    }

    /// Develops the light for the windows.
    fn show(&mut self, gpu: &Gpu) {
        let development = Development::default();
        self.walls.adapt(gpu, &development, Some(0.05));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for (window, screen) in self.screens.iter().enumerate() {
            self.walls.show_window(gpu, &mut encoder, window, &development, screen, [0, 0]);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Times of the stages of a frame, each waited for by itself, and sizes of what is drawn.
    fn stages(&mut self, gpu: &Gpu) -> Result<String, Box<dyn Error>> {
        let mut stages = [const { Vec::new() }; 4];
        let mut counts = DrawCounts::default();
        for _ in 0..FRAMES {
            let submitted = self.submit(gpu)?;
            self.renderer.take_drawn();
            let begun = Instant::now();
            let drawn = self.walls.draw(gpu, &mut self.renderer, submitted)?;
            let recorded = begun.elapsed().saturating_sub(drawn.transform);
            counts = self.renderer.take_drawn();
            gpu.wait()?;
            let light = begun.elapsed().saturating_sub(drawn.transform + recorded);
            let begun = Instant::now();
            self.show(gpu);
            gpu.wait()?;
            for (times, time) in stages.iter_mut().zip([drawn.transform, recorded, light, begun.elapsed()]) {
                times.push(milliseconds(time));
            }
        }
        let [transform, recorded, light, shown] = stages.map(|times| median(&times));
        let mut text = format!(
            "transform {transform:.2} ms, draw {:.2} ({recorded:.2} until all is submitted), development {shown:.2}; {} \
             triangles drawn in {} calls, of {}",
            recorded + light,
            counts.triangles,
            counts.calls,
            self.renderer.triangle_count()
        );
        if let Some(map) = self.renderer.map_stats().filter(|map| map.panes > 0) {
            text += &format!(
                "; map of {} panes, {:.2} million texels, planned in {:.2} ms",
                map.panes,
                map.texels as f64 / 1e6,
                map.plan_ms
            );
        }
        if let Some(cut) = self.renderer.cut_stats() {
            text += &format!(
                "; cut of {} triangles in {:.2} ms, to {:.2} px",
                cut.triangles,
                milliseconds(cut.duration),
                cut.tolerance_px
            );
        }
        Ok(text)
    }
}
