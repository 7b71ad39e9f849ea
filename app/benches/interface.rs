//! The cost of what explains a ride: menu, map and diagram, in a window and in a room of four walls for two eyes, on
//! the default path, beside frames with the head-up display alone.
//!
//! A cyclist rides through the old town for a minute; the frames after it are drawn with and without them, in turns, so
//! that other load on the machine affects both alike. Everything is open at once, and the readings change from frame to
//! frame, so every picture of the interface is drawn anew.
//!
//! `cargo bench -p rapidity --bench interface`, or with words after `--`: a size of the window, as in `640x360`;
//! `side=320`: pixels of a wall; `10s`: seconds for each table.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a benchmark prints its figures")]

mod support;

use cabin::{Guide, RoomInterface, Shown};
use input::{DeskConfig, SECOND};
use interface::{MenuPage, MenuRide, Painter, Readings};
use presentation::Presentation;
use render::display::Development;
use render::target::texture;
use render::{Gpu, SceneRenderer};
use ride::{LightSpeed, RideFrame, RideStart, Setup, Simulation, Tour, VehicleSettings};
use room::Display;
use scene::Scene;
use scene::collision::Collision;
use std::error::Error;
use std::sync::Arc;
use std::time::Duration;
use studio::SCREEN_FORMAT;
use support::default_path::{self, DefaultPath};
use support::figures::{commit, processor};
use support::frame_times::{FrameTimes, rounds, turn};
use support::words::Words;
use view::{Effects, Occasion};
use walls::{FlatPicture, Occupant, Quality, RoomHead, Walls};

/// Number of frames drawn in one way before the other has its turn.
const FRAMES: usize = 6;
/// Time for which each table is measured, seconds.
const SECONDS: f64 = 30.0;
/// Side of a wall, pixels.
const SIDE: u32 = 640;
/// Vertical field of view of the window, degrees.
const FOV_DEG: f64 = 60.0;
/// Frames per second of the ride, and the time that is ridden before any is drawn, seconds.
const RATE: u64 = 30;
const BEFORE_S: u64 = 60;
/// Frames after which the ride's end is shown again.
const WAY: usize = 32;
const WORDS: &str = "a size, as in 640x360, side=N, and seconds, as in 10s";

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = Words::given();
    let size = words.size().unwrap_or([1920, 1080]);
    let side = words.list("side")?.first().copied().unwrap_or(SIDE).clamp(1, 8192);
    let seconds = Duration::from_secs_f64(words.seconds().unwrap_or(SECONDS));
    words.end(WORDS)?;

    let gpu = Gpu::new()?;
    println!("commit {}, {}, {}", commit(), processor(), gpu.description());
    let scene = default_path::scene("town")?;
    let frames = ridden(&scene)?;
    let default = DefaultPath::of(&gpu, &scene)?;
    println!("{}, menu, map and diagram; ratio to the same frames with the display alone", default.name());

    for (name, place) in
        [(format!("window of {} x {}", size[0], size[1]), None), (format!("cave4, walls of {side}"), Some(side))]
    {
        let mut bench = Bench::new(&gpu, &scene, &frames, default, (size, place))?;
        let (mut without, mut with) = (FrameTimes::default(), FrameTimes::default());
        rounds(seconds, |counts| {
            for (explains, times) in [(false, &mut without), (true, &mut with)] {
                let took = turn(FRAMES, || bench.frame(&gpu, explains))?;
                if counts {
                    times.add(&took);
                }
            }
            Ok::<_, Box<dyn Error>>(())
        })?;
        println!("\n{name}\n{}\n{}", without.line("without", &without), with.line("with", &without));
    }
    Ok(())
}

/// Frames at the end of a ride round the town.
fn ridden(scene: &Scene) -> Result<Vec<RideFrame>, Box<dyn Error>> {
    let setup = Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind: input::VehicleKind::Bicycle,
        start: RideStart::at_rest(scene.start.position, scene.start.look, scene.start.up),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig::default(),
    };
    let mut cyclist = Tour::new(&scene.circuit, &setup.desk.bicycle).ok_or("the town has no circuit")?;
    let mut simulation = Simulation::new(setup, Arc::new(Collision::new(scene)?))?;
    let frame = |number: u64| {
        let at = number * SECOND / RATE;
        let samples = cyclist.samples(simulation.vehicle(), at);
        simulation.frame(at, &samples)
    };
    Ok((0..BEFORE_S * RATE + WAY as u64).map(frame).collect())
}

/// Target of the frames.
enum Target {
    Window(Box<FlatPicture>, egui::Context, Box<Painter>),
    Room(Box<Walls>, Box<RoomInterface>),
}

/// One place in which a ride is shown.
struct Bench<'a> {
    frames: &'a [RideFrame],
    renderer: SceneRenderer,
    target: Target,
    screens: Vec<wgpu::TextureView>,
    guide: Guide,
    page: MenuPage,
    /// Presentation with the display alone, and with everything.
    shown: [Presentation; 2],
    number: usize,
}

impl<'a> Bench<'a> {
    /// A window of a size, or a room with walls of so many pixels.
    fn new(
        gpu: &Gpu,
        scene: &Scene,
        frames: &'a [RideFrame],
        default: DefaultPath,
        (size, side): ([u32; 2], Option<u32>),
    ) -> Result<Self, Box<dyn Error>> {
        let DefaultPath { dial, format, effects } = default;
        let mut sizes = vec![size];
        let target = match side {
            None => {
                let picture = FlatPicture::new(gpu, size, format, SCREEN_FORMAT, dial.map_scale.unwrap_or(1.0));
                Target::Window(Box::new(picture), interface::layouts(), Box::new(Painter::new(gpu, SCREEN_FORMAT)))
            }
            Some(side) => {
                let mut display = Display::built_in("cave4").ok_or("cave4 is built in")?;
                let wall = display.channels[0].viewport[2];
                let scaled = |pixels: u32| pixels * side / wall;
                for channel in &mut display.channels {
                    channel.viewport = channel.viewport.map(scaled);
                }
                display.windows.iter_mut().for_each(|window| window.size = window.size.map(scaled));
                sizes = display.windows.iter().map(|window| window.size).collect();
                let interface = RoomInterface::new(gpu, &display);
                let quality = Quality { format, samples: 1, density: 1.0, smooth: true };
                Target::Room(Box::new(Walls::new(gpu, display, quality, SCREEN_FORMAT)), Box::new(interface))
            }
        };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let mut guide = Guide::new(scene);
        let plain = Presentation { effects, ..Presentation::default() };
        let shown = [plain, Presentation { menu: true, miniature: true, diagram: true, ..plain }];
        frames.iter().for_each(|frame| guide.note(frame, &shown[0], 1.5));
        Ok(Self {
            frames,
            renderer: SceneRenderer::new(gpu, scene.clone(), format, None, dial, Occasion::Ride)?,
            target,
            screens: sizes.into_iter().map(|size| texture(gpu, "screen", size, SCREEN_FORMAT, 1, usage)).collect(),
            guide,
            page: MenuPage::Ride,
            shown,
            number: 0,
        })
    }

    /// Draws a frame, with menu, map and diagram if it `explains`.
    fn frame(&mut self, gpu: &Gpu, explains: bool) -> Result<(), Box<dyn Error>> {
        self.number += 1;
        let frame = &self.frames[self.frames.len() - WAY + self.number % WAY];
        let development = Development::default();
        let shown = &self.shown[usize::from(explains)];
        let effects: Effects = shown.effects;
        let odometer = frame.vehicle.odometer();
        let celerity = frame.gaze.observer.celerity;
        let readings = Readings {
            beta: celerity.beta().vector().length(),
            gamma: celerity.gamma(),
            rapidity: celerity.rapidity(),
            speed_of_light: LightSpeed::OLD_TOWN.speed_of_light_m_s(),
            own_clock_s: odometer.own_s,
            world_clock_s: odometer.world_s,
            road_m: odometer.road_m,
            own_m: odometer.own_m,
            ..Readings::default()
        };
        let menu = MenuRide {
            speed_of_light: readings.speed_of_light,
            time_scale: 1.0,
            places: self.guide.places(shown.language),
            overlaps: true,
            is_flat: true,
            ..MenuRide::default()
        };
        self.guide.note(frame, shown, 1.5);
        let clocks = self.guide.wanted_clocks(frame, shown);
        let now_s = self.number as f64 / RATE as f64;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        match &mut self.target {
            Target::Window(picture, context, painter) => {
                let shot = frame.gaze.shot(FOV_DEG, effects);
                let pending = self.renderer.submit(gpu, &shot.observer, effects)?;
                picture.draw(gpu, &mut self.renderer, &shot, pending)?;
                picture.adapt(gpu, &development, Some(0.03));
                picture.show(gpu, &mut encoder, &development, &self.screens[0]);
                let (guide, page) = (&self.guide, &mut self.page);
                let [width, height] = [self.screens[0].texture().width(), self.screens[0].texture().height()];
                let screen = egui::Vec2::new(width as f32, height as f32);
                let input = egui::RawInput {
                    screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, screen)),
                    time: Some(now_s),
                    ..Default::default()
                };
                let output = context.run_ui(input, |ui| {
                    interface::show_readings(ui, &readings);
                    guide.show(ui, shown, &clocks);
                    if explains {
                        interface::menu_window(ui, page, shown, &menu);
                    }
                });
                let shapes = context.tessellate(output.shapes, output.pixels_per_point);
                painter.take_textures(gpu, &output.textures_delta);
                let mut pass = render::display::over(&mut encoder, &self.screens[0]);
                painter.paint(gpu, &mut pass, &shapes, ([width, height], output.pixels_per_point));
                drop(pass);
                painter.forget_textures(&output.textures_delta);
            }
            Target::Room(walls, interface) => {
                let (vehicle, thrust) = (*frame.vehicle.state(), *frame.vehicle.thrust());
                let occupant = Occupant { vehicle, thrust, head: RoomHead::at_rest(walls.display.viewer.head_m) };
                let submitted = walls.submit(gpu, &mut self.renderer, &occupant, effects)?;
                walls.draw(gpu, &mut self.renderer, submitted)?;
                walls.adapt(gpu, &development, Some(0.03));
                let shown = Shown {
                    presentation: shown,
                    readings: &readings,
                    menu: Some(&menu).filter(|_| explains),
                    caption: None,
                    clocks: &clocks,
                    keys: &[],
                    now_s,
                };
                (walls.sheets, _) = interface.draw(gpu, &shown, &self.guide, &mut self.page, None);
                for (window, screen) in self.screens.iter().enumerate() {
                    walls.show_window(gpu, &mut encoder, window, &development, screen, [0, 0]);
                }
            }
        }
        gpu.queue.submit([encoder.finish()]);
        Ok(gpu.wait()?)
    }
}
