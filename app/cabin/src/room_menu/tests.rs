//! Laws: a wand of a VRPN server chooses every control of the menu that floats in a room of four walls, by pointing at
//! it and pressing; the ride that this makes replays to the bit, with the same actions in the same order.
//!
//! A wrong program points beside the controls, presses twice, or makes a ride whose replay is another.

use super::*;
use input::head::Stance;
use input::recording::Recording;
use input::{
    DeskConfig, HeadConfig, SECOND, Sample, SampleSource, Setting, Switch, TrackingMode, VehicleKind, WandConfig,
};
use interface::MenuComfort;
use ride::{LightSpeed, Replay, Replayed, RideLog, RideStart, Setup, Simulation, VehicleSettings};
use scene::OpenPlane;
use std::collections::BTreeSet;
use std::sync::Arc;
use view::{Dial, RendererName};
use words::Language;

/// Numbers of the stock server for its tracker's poses and its buttons.
const POSE: i32 = 4;
const BUTTON: i32 = 10;

fn message(at: u64, sender: i32, kind: i32, payload: &[u8]) -> Vec<u8> {
    let (seconds, microseconds) = (at / SECOND, at % SECOND / 1000);
    let mut bytes = Vec::new();
    for word in [24 + payload.len() as u32, seconds as u32, microseconds as u32, sender as u32, kind as u32, 0] {
        bytes.extend_from_slice(&word.to_be_bytes());
    }
    bytes.extend_from_slice(payload);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

fn description(kind: i32, number: i32, name: &str) -> Vec<u8> {
    let length = name.len() as u32 + 1;
    message(0, number, kind, &[&length.to_be_bytes(), name.as_bytes(), &[0]].concat())
}

/// What the stock server says first.
fn greeting() -> Vec<u8> {
    let mut cookie = b"vrpn: ver. 07.38 0".to_vec();
    cookie.resize(24, 0);
    let described = [
        description(-1, 1, "Head"),
        description(-2, POSE, "vrpn_Tracker Pos_Quat"),
        description(-2, BUTTON, "vrpn_Button Change"),
    ];
    [cookie, described.concat()].concat()
}

/// Ride of a person with a wand in the room.
struct Visit {
    gpu: Gpu,
    simulation: Simulation,
    log: RideLog,
    interface: RoomInterface,
    guide: Guide,
    page: MenuPage,
    presentation: Presentation,
    said: Vec<Action>,
    chosen: Vec<Action>,
    /// Actions of the ride, in their order.
    acted: Vec<Action>,
    at: u64,
}

impl Visit {
    fn bytes(&mut self, bytes: Vec<u8>) {
        self.step(vec![Sample::bytes(self.at + SECOND / 40, SampleSource::Vrpn, bytes)]);
    }

    /// One frame: samples to the ride, the menu, and what was chosen to the next frame.
    fn step(&mut self, mut samples: Vec<Sample>) {
        self.at += SECOND / 20;
        let at = self.at;
        samples.extend(std::mem::take(&mut self.said).iter().map(|action| Sample::action(at, action)));
        let frame = self.simulation.frame(at, &samples);
        self.log.frame(&samples, &frame).unwrap();
        for action in &frame.controls.actions {
            self.presentation.act(action);
        }
        self.acted.extend(frame.controls.actions.iter().cloned());
        let ride = MenuRide {
            tracking: self.simulation.desk().tracking(),
            places: vec![("there".to_owned(), input::Place { position_m: [5.0, 0.0, -3.0], look: [1.0, 0.0, 0.0] })],
            tours: vec![("The twins".to_owned(), "twins")],
            drawn_by: RendererName::Polygon,
            overlaps: true,
            is_flat: true,
            has_lines: true,
            comfort: Some(MenuComfort { snap_turn_deg: 30.0, stance: Stance::Seated }),
            ..MenuRide::default()
        };
        let ray = frame.controls.wand.as_deref().and_then(|wand| of_wand(wand, &WandButtons::default()));
        let readings = Readings::default();
        let shown = Shown {
            presentation: &self.presentation,
            readings: &readings,
            menu: Some(&ride),
            caption: None,
            clocks: &[],
            keys: &[],
            now_s: at as f64 / SECOND as f64,
        };
        let (_, actions) = self.interface.draw(&self.gpu, &shown, &self.guide, &mut self.page, ray);
        self.chosen.extend(actions.iter().cloned());
        self.said = actions;
    }

    /// Points the wand at a point of the room, presses its first button, and lets it go.
    fn choose(&mut self, point: DVec3) {
        let hand = self.interface.head_m + DVec3::new(0.25, -0.35, -0.2);
        let turn = DQuat::from_rotation_arc(DVec3::NEG_Z, (point - hand).normalize());
        let mut payload = 1_i32.to_be_bytes().to_vec();
        payload.extend([0; 4]);
        for value in [hand.x, hand.y, hand.z, turn.x, turn.y, turn.z, turn.w] {
            payload.extend_from_slice(&value.to_be_bytes());
        }
        self.bytes(message(self.at + SECOND, 1, POSE, &payload));
        self.step(Vec::new());
        for held in [1_i32, 0] {
            self.bytes(message(self.at + SECOND, 1, BUTTON, &[0_i32.to_be_bytes(), held.to_be_bytes()].concat()));
            self.step(Vec::new());
        }
    }
}

#[test]
fn a_wand_chooses_every_control_and_the_ride_replays_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("visit.mcap");
    let display = Display::built_in("cave4").unwrap();
    let wand = WandConfig { sensor: 1, ..WandConfig::default() };
    let head = HeadConfig { wand: Some(wand), ..HeadConfig::new("vrpn://127.0.0.1/Head".parse().unwrap()) };
    let setup = Setup {
        light_speed: LightSpeed::OLD_TOWN,
        kind: VehicleKind::Bicycle,
        start: RideStart::at_rest(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y),
        vehicle: VehicleSettings::default(),
        desk: DeskConfig { head: Some(head), ..Default::default() },
    };
    let mut log = RideLog::new(setup.header("test", "plane"));
    log.record(&path).unwrap();
    let gpu = Gpu::new().unwrap();
    let mut visit = Visit {
        simulation: Simulation::new(setup, Arc::new(OpenPlane)).unwrap(),
        log,
        interface: RoomInterface::new(&gpu, &display),
        guide: Guide::new(&built_in::lattice::Lattice { count: [1, 1, 1], spacing: 4.0, side: 1.0 }.build()),
        page: MenuPage::default(),
        presentation: Presentation { menu: true, ..Presentation::default() },
        said: Vec::new(),
        chosen: Vec::new(),
        acted: Vec::new(),
        at: SECOND,
        gpu,
    };
    visit.step(vec![Sample::opened(SECOND, SampleSource::Vrpn)]);
    visit.bytes(greeting());

    // Every control of each page, as it is laid out before the wand comes.
    for page in [MenuPage::Ride, MenuPage::World, MenuPage::Picture, MenuPage::Understand, MenuPage::Program] {
        visit.page = page;
        visit.step(Vec::new());
        visit.step(Vec::new());
        let controls = visit.interface.menu_controls();
        assert!(controls.len() > 5, "{page:?} has {} controls", controls.len());
        for point in controls {
            visit.choose(point);
            // Whatever was chosen, the page stays open, in English.
            visit.page = page;
            visit.presentation.menu = true;
            visit.presentation.language = Language::English;
        }
    }
    let chosen: BTreeSet<String> = visit.chosen.iter().map(|action| format!("{action:?}")).collect();
    for action in [
        Action::Vehicle(VehicleKind::Drive),
        Action::Vehicle(VehicleKind::Fly),
        Action::SpeedOfLight(100.0 / 3.6),
        Action::Scene("dice".to_owned()),
        Action::Tour("twins".to_owned()),
        Action::Jump(input::Place { position_m: [5.0, 0.0, -3.0], look: [1.0, 0.0, 0.0] }),
        Action::TogglePause,
        Action::Step,
        Action::Restart,
        Action::Photo,
        Action::PhotoSphere,
        Action::ToggleRecording,
        Action::Toggle(Switch::Doppler),
        Action::Toggle(Switch::Searchlight),
        Action::Set(Setting::Exposure, "white".to_owned()),
        Action::Set(Setting::Tone, "filmic".to_owned()),
        Action::Set(Setting::Gamut, "clamp".to_owned()),
        Action::Set(Setting::Latency, "low".to_owned()),
        Action::Tracking(TrackingMode::Position),
        Action::Recentre,
        Action::Set(Setting::Renderer, Dial { renderer: RendererName::Image, ..Dial::default() }.to_string()),
        Action::Set(Setting::Renderer, Dial { renderer: RendererName::Auto, ..Dial::tolerance(0.5) }.to_string()),
        Action::Set(Setting::View, "measured".to_owned()),
        Action::Set(Setting::Colouring, "delay".to_owned()),
        Action::Toggle(Switch::Outside),
        Action::Toggle(Switch::Frozen),
        Action::Toggle(Switch::Miniature),
        Action::Toggle(Switch::Diagram),
        Action::Toggle(Switch::DiagramOfVehicle),
        Action::Toggle(Switch::Clocks),
        Action::Toggle(Switch::Planner),
        Action::Toggle(Switch::Cockpit),
        Action::Set(Setting::Vignette, "strong".to_owned()),
        Action::SnapTurn(45.0),
        Action::Stance(Stance::Standing),
        Action::Toggle(Switch::Readings),
        Action::ToggleHelp,
        Action::Set(Setting::Language, "de".to_owned()),
        Action::Leave,
        Action::Toggle(Switch::Menu),
    ] {
        assert!(chosen.contains(&format!("{action:?}")), "{action:?} was not chosen: {chosen:#?}");
    }
    let fields = chosen.iter().filter(|action| action.contains("Fov") || action.contains("TimeScale"));
    assert!(fields.count() >= 2, "sliders");

    visit.log.finish().unwrap();
    let mut replay = Replay::new(Recording::open(&path).unwrap(), Arc::new(OpenPlane)).unwrap();
    let (mut acted, mut frames) = (Vec::new(), 0);
    while let Some(Replayed { frame, difference }) = replay.next_frame().unwrap() {
        assert!(difference.is_none(), "{difference:?}");
        acted.extend(frame.controls.actions);
        frames += 1;
    }
    assert!(frames > 400, "{frames}");
    // A presentation is a function of its beginning and of these.
    assert_eq!(acted, visit.acted);
}
