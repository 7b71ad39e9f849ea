//! The beginning of a ride: its scene, its setup, its devices, its log; or a recorded ride.

use crate::error::Error;
use crate::output::progress;
use crate::output::say::tell;
use crate::session::live::Live;
use crate::session::scenes::{self, World};
use command::{HEADSET, RideOptions, SceneChoice, VehicleName, WorldOptions};
use directories::ProjectDirs;
use glam::DVec3;
use hardware::{SetUp, head_config, usual_display};
use input::devices::{Devices, DevicesConfig};
use input::recording::{Recording, RideHeader};
use input::{Action, Clock, DeskConfig, HeadConfig, Sample, TrackerUrl, VehicleKind};
use kiosk::{DayLog, Kiosk};
use ride::{LightSpeed, Replay, RideLog, RideStart, Setup, Simulation, VehicleSettings};
use room::{Display, HeadsetEye};
use scene::Scene;
use scene::collision::Collision;
use scene::motion::Ball;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tours::TourPlan;

/// Key of the recording's setting that identifies its scene.
const FINGERPRINT: &str = "scene_fingerprint";
/// Key of the recording's setting that says how the ride was shown at its beginning.
pub const PRESENTATION: &str = "presentation";

fn fingerprint(scene: &Scene) -> String {
    format!("{:016x}", scene.fingerprint())
}

/// Room in which a ride is shown, and the tracking of the head in it.
#[derive(Clone)]
pub struct RideRoom {
    /// Display, if the ride is shown in a room. A tracked head without a named display gets a built-in window.
    pub display: Option<Display>,
    /// Name or file of the display, as it was asked for.
    pub display_name: Option<String>,
    /// Tracking of the head, if it is tracked.
    pub head: Option<HeadConfig>,
    /// Set-up of the rider's hardware.
    pub set_up: SetUp,
}

impl RideRoom {
    /// Room that the options ask for. The display's file is read here, once.
    ///
    /// # Errors
    /// A display or a tracker that cannot be used.
    pub fn of(options: &RideOptions) -> Result<Self, Error> {
        let file = options.devices.set_up.as_deref();
        let own = SetUp::of(None, file)?;
        let url = options.devices.tracker.clone().or_else(|| own.tracker_url());
        let tracked = url.as_ref().map(usual_display).map(str::to_owned);
        let display_name = options.display.clone().or(tracked);
        let budget = options.world.reading.budget();
        let named = |name: &str| match name {
            HEADSET => Ok(Display::headset(name, &HeadsetEye::usual(2), &[[1024; 2]; 2])),
            name => Display::named_or_file_within(name, &budget),
        };
        let display = display_name.as_deref().map(named).transpose()?;
        let set_up = SetUp::of(display.as_ref(), file)?;
        set_up.check()?;
        // The head in a headset is tracked by its runtime.
        let own = (display_name.as_deref() == Some(HEADSET)).then_some(TrackerUrl::Openxr);
        let url = own.as_ref().or(options.devices.tracker.as_ref());
        let mut head = head_config(display.as_ref(), &set_up, url)?;
        if let Some(head) = head.as_mut().filter(|head| head.url == TrackerUrl::Openxr) {
            head.stance = options.comfort.stance.unwrap_or(head.stance);
            head.snap_turn_deg = options.comfort.snap_turn.unwrap_or(head.snap_turn_deg);
        }
        Ok(Self { display, display_name, head, set_up })
    }

    /// True if the ride is shown in a headset.
    pub fn is_headset(&self) -> bool {
        self.display_name.as_deref() == Some(HEADSET)
    }

    /// True if the mouse moves the head.
    pub fn mouse_moves_head(&self) -> bool {
        self.head.as_ref().is_some_and(|head| head.url == TrackerUrl::Mouse)
    }
}

/// Kiosk that the options ask for, for rides in `scene`.
///
/// # Errors
/// A folder for the day's log that cannot be made, if it was named.
pub fn kiosk(options: &RideOptions, setup: &Setup, scene: &Scene) -> Result<Option<Kiosk>, Error> {
    if !options.kiosk.kiosk {
        return Ok(None);
    }
    let log = match &options.kiosk.log {
        Some(folder) => Some(DayLog::in_folder(folder)?),
        None => usual_log_folder().and_then(|folder| DayLog::in_folder(&folder).map_err(tell).ok()),
    };
    let scale = options.vehicle.time_scale;
    let kiosk = Kiosk::new(options.kiosk.idle_s, setup, scale, &scene.circuit, log)?;
    let start = DVec3::from_array(setup.start.position);
    Ok(Some(match scene.extent() {
        Some(Ball { centre, radius }) => kiosk.round_scene(centre, radius, start),
        None => kiosk,
    }))
}

/// Folder of a kiosk's log in the user's folder for states; `None` if the system names none.
fn usual_log_folder() -> Option<PathBuf> {
    let directories = ProjectDirs::from("", "", "rapidity")?;
    Some(directories.state_dir().unwrap_or_else(|| directories.data_local_dir()).to_owned())
}

/// Live ride whose clock starts now; for visitors, if there is a kiosk.
///
/// # Errors
/// Devices that cannot be read.
pub fn present(
    options: &RideOptions,
    set_up: &SetUp,
    simulation: Simulation,
    log: RideLog,
    kiosk: Option<Kiosk>,
) -> Result<Live, Error> {
    let clock = Clock::start();
    let devices = Devices::open(&devices_config(options, set_up, &simulation.setup().desk)?, clock)?;
    let mut live = Live::present(simulation, devices, clock, log, options.seconds);
    if let Some(kiosk) = kiosk {
        return Ok(live.for_visitors(kiosk));
    }
    for action in first_actions(options) {
        live.say(|at| Sample::action(at, &action));
    }
    Ok(live)
}

/// Scene of a recording, and a replay of the ride in it.
///
/// # Errors
/// A recording or a scene that cannot be read.
pub fn recorded(path: &Path, options: &WorldOptions) -> Result<(Scene, Replay), Error> {
    let recording = Recording::open(path)?;
    // A scene that is named overrides the recorded one, whose file may have moved.
    let choice = options.scene.clone().unwrap_or_else(|| SceneChoice::from_name(&recording.header().scene));
    let scene = scenes::load_recorded(&choice, options, recording.header().speed_of_light_m_s)?;
    if recording.header().settings.get(FINGERPRINT).is_some_and(|recorded| *recorded != fingerprint(&scene)) {
        tell(format_args!(
            "{}: {} is not the scene that was ridden through; expect another ride",
            path.display(),
            choice.name()
        ));
    }
    let collision = Arc::new(Collision::new(&scene)?);
    Ok((scene, Replay::new(recording, collision)?))
}

/// Simulation at its beginning, and an empty log for it.
///
/// # Errors
/// Settings that cannot be used, or a scene without sound geometry.
pub fn prepared(
    options: &RideOptions,
    world: &World,
    set_up: &SetUp,
    head: Option<HeadConfig>,
) -> Result<(Simulation, RideLog), Error> {
    let setup = setup(options, world, desk(options, set_up, head)?)?;
    prepared_with(options, world, setup)
}

/// Simulation of a tour that has not begun, and its log.
///
/// # Errors
/// Those of [`prepared`].
pub fn prepared_for_tour(
    options: &RideOptions,
    world: &World,
    set_up: &SetUp,
    head: Option<HeadConfig>,
    plan: &TourPlan,
) -> Result<(Simulation, RideLog), Error> {
    let light_speed = LightSpeed::new(world.speed_of_light_m_s)?;
    let setup = plan.setup(&world.scene.start, light_speed, desk(options, set_up, head)?);
    prepared_with(options, world, setup)
}

/// Settings of the devices.
fn desk(options: &RideOptions, set_up: &SetUp, head: Option<HeadConfig>) -> Result<DeskConfig, Error> {
    let mut desk = DeskConfig { head, ..set_up.desk()? };
    if desk.keys.is_empty() {
        desk.keys = options.keys.clone();
    }
    Ok(desk)
}

fn prepared_with(options: &RideOptions, world: &World, setup: Setup) -> Result<(Simulation, RideLog), Error> {
    let scene = &world.scene;
    let mut header = setup.header(env!("CARGO_PKG_VERSION"), &options.world.scene().name());
    header.settings.insert(FINGERPRINT.to_owned(), fingerprint(scene));
    header.settings.insert(PRESENTATION.to_owned(), options.presentation(&scene.start).to_json());
    let collision = Arc::new(Collision::new(scene)?);
    // What flies without a hull asks for nothing.
    if setup.kind != VehicleKind::Fly || setup.vehicle.flight.hull_m > 0.0 {
        let spinner = progress::spinner("finding ground and walls");
        collision.prepare();
        spinner.finish_and_clear();
    }
    Ok((Simulation::new(setup, collision)?, log(header)))
}

/// Log of a ride, whose long past is kept in the user's folder for caches.
fn log(header: RideHeader) -> RideLog {
    let log = RideLog::new(header);
    match ProjectDirs::from("", "", "rapidity") {
        Some(directories) => log.keep_past_in(directories.cache_dir().join("rides")),
        None => log,
    }
}

/// True if there is a graphical session to open a window in.
pub fn has_display() -> bool {
    !cfg!(all(unix, not(target_os = "macos")))
        || ["DISPLAY", "WAYLAND_DISPLAY"]
            .iter()
            .any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()))
}

fn setup(options: &RideOptions, world: &World, desk: DeskConfig) -> Result<Setup, Error> {
    let start = &world.scene.start;
    // A bicycle belongs to scenes made for it; other places are to show something within seconds.
    let usual = match (start.is_on_ground(), world.scene.speed_of_light_m_s) {
        (true, None) => VehicleName::Bicycle,
        (true, Some(_)) => VehicleName::Drive,
        (false, _) => VehicleName::Fly,
    };
    let kind = match options.vehicle.vehicle.unwrap_or(usual) {
        VehicleName::Bicycle => VehicleKind::Bicycle,
        VehicleName::Drive => VehicleKind::Drive,
        VehicleName::Fly => VehicleKind::Fly,
    };
    let mut vehicle = VehicleSettings { integrator: options.vehicle.integrator, ..Default::default() };
    vehicle.flight.nose = options.vehicle.transport;
    vehicle.assist = options.vehicle.assist;
    vehicle.flight.hull_m = if options.vehicle.through_walls { 0.0 } else { hull_m(&world.scene) };
    if start.is_on_ground() {
        vehicle.eye_m = [0.0, start.eye_height_m, 0.0];
    }
    // A flight begins at the eye, other rides on the ground.
    let place = if kind == VehicleKind::Fly { start.eye() } else { start.position };
    Ok(Setup {
        light_speed: LightSpeed::new(world.speed_of_light_m_s)?,
        kind,
        start: RideStart::at_rest(place, start.look, start.up),
        vehicle,
        desk,
    })
}

/// Radius of a spaceship's hull, metres: that of a person, and less in a scene that is small.
fn hull_m(scene: &Scene) -> f64 {
    const USUAL_M: f64 = 0.4;
    /// Share of the scene's extent.
    const SHARE: f64 = 0.01;
    let solid = scene.meshes.iter().filter(|mesh| mesh.solid);
    let corners = solid.flat_map(|mesh| &mesh.positions).map(|corner| corner.as_dvec3()).filter(|c| c.is_finite());
    let bounds = corners.fold(None, |bounds: Option<(DVec3, DVec3)>, corner| {
        let (least, most) = bounds.unwrap_or((corner, corner));
        Some((least.min(corner), most.max(corner)))
    });
    bounds.map_or(0.0, |(least, most)| (SHARE * least.distance(most)).min(USUAL_M))
}

/// Actions at the start of the ride, from the command line.
pub fn first_actions(options: &RideOptions) -> Vec<Action> {
    let scale = options.vehicle.time_scale;
    if scale == 1.0 { Vec::new() } else { vec![Action::TimeScale(scale)] }
}

/// Devices that the command line or the set-up names.
fn devices_config(options: &RideOptions, set_up: &SetUp, desk: &DeskConfig) -> Result<DevicesConfig, Error> {
    let (port, trainer) = (set_up.port()?, set_up.trainer()?);
    let usual = DevicesConfig::default();
    let slope_felt = options.devices.slope_felt.or(trainer.slope_felt_percent);
    if options.devices.slope_felt.is_some() && options.devices.trainer.is_none() && trainer.url.is_none() {
        tell("--slope-felt has no effect: the set-up names no trainer");
    }
    Ok(DevicesConfig {
        bicycle: options.devices.bicycle.clone().or(port.port),
        baud: port.baud.unwrap_or(usual.baud),
        trainer: options.devices.trainer.clone().or(trainer.url),
        slope_felt_percent: slope_felt.unwrap_or(usual.slope_felt_percent),
        space_mouse: options.devices.spacemouse || has_display(),
        // A headset that shows the ride reports with its pictures.
        tracker: desk.head.as_ref().filter(|_| !options.is_headset()).map(|head| head.url.clone()),
        wand_devices: desk.head.as_ref().map(HeadConfig::wand_devices).unwrap_or_default(),
        ..usual
    })
}
