//! One ride in the hands of chance, and the laws that it has to keep.

use std::sync::Arc;

use glam::DVec3;
use input::recording::FrameRecord;
use input::{
    Action, DeskConfig, HeadConfig, KeyboardKey, Nanos, SECOND, Sample, SampleSource, TrackerUrl, VehicleKind,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use ride::{AssistMode, IntegratorKind, LightSpeed, Nose, RideFrame, RideStart, Setup, Simulation, VehicleSettings};
use scene::collision::Collision;
use scene::{Scene, Surroundings};

use super::devices::MadDevices;
use super::streets::Streets;

/// Least distance of a vehicle on the ground from a wall, metres: the reach of its body, save for rounding and for a
/// wall that begins where a wheel has been lifted.
const BODY_M: f64 = 0.38;
/// Greatest height of a vehicle above or below the ground, metres: a doorstep's, until its ramp is ridden.
const OFF_GROUND_M: f64 = 0.5;
/// Distance from walls that a start needs, metres.
const ROOM_M: f64 = 0.5;
/// Radius of a spaceship's hull, metres.
const HULL_M: f64 = 0.4;
/// Share of the hull that the surfaces of a corner, which are cleared in turns, may take.
const HULL_ROUNDING: f64 = 0.05;
/// Time in which chance rides, seconds.
const MAD_S: f64 = 1.0;
/// Time of a key until the vehicle has to have moved, seconds.
const FRESH_S: f64 = 0.5;
/// The same for a rider with patience, seconds: a wheel that turned forward has to stop before it turns backward.
const PATIENT_S: f64 = 5.0;
/// Distance that a fresh key has to move the vehicle, metres; less where light is slower than [`SLOW_M_S`].
const MOVED_M: f64 = 0.01;
/// Speed of light below which thrust moves a vehicle less, m/s.
const SLOW_M_S: f64 = 1.0;

/// Scene to ride in.
pub struct RidingGround {
    name: &'static str,
    /// Corners at which rides begin.
    corners: Vec<DVec3>,
    surroundings: Arc<Collision>,
    /// Streets of the scene; `None` where there is no ground.
    streets: Option<Streets>,
}

impl RidingGround {
    /// Prepares a scene.
    pub fn new(name: &'static str, scene: &Scene, surroundings: Arc<Collision>) -> Self {
        let streets = (!scene.circuit.is_empty()).then(|| Streets::of(&*surroundings));
        let corners = if scene.circuit.is_empty() { vec![scene.start.position] } else { scene.circuit.clone() };
        Self { name, corners, surroundings, streets }
    }

    /// Name of the scene, and the area of its streets.
    pub fn description(&self) -> String {
        match &self.streets {
            Some(streets) => format!("{}: streets of {:.0} m²", self.name, streets.area_m2()),
            None => format!("{}: no ground", self.name),
        }
    }
}

/// First thing that moved the vehicle after a mad ride.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MovedBy {
    /// The key W alone.
    Ahead,
    /// The key W with one of the keys to the side.
    Sideways,
    /// The key S.
    Backward,
    /// One of these, held for longer.
    Patience,
}

/// Figures of a ride that kept the laws.
#[derive(Clone, Debug)]
pub struct FuzzedRide {
    /// First thing that moved the vehicle afterwards.
    pub moved_by: MovedBy,
    /// True if the ride had to keep to the streets.
    pub in_streets: bool,
    /// Largest celerity.
    pub fastest: f64,
    /// Number of steps that could not be integrated.
    pub not_integrated: u64,
    /// Own time of the vehicle, in ticks.
    pub ticks: u64,
    /// Last frame of the mad part.
    pub last: FrameRecord,
}

/// Rides with this seed.
///
/// # Errors
/// A sentence on the first law that was broken.
pub fn ride(seed: u64, grounds: &[RidingGround]) -> Result<FuzzedRide, String> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let ground = &grounds[random.random_range(0..grounds.len())];
    let setup = setup(&mut random, ground);
    let told = |law: String| {
        let at = format!("{:?}, c = {:.3e} m/s", setup.kind, setup.light_speed.speed_of_light_m_s());
        format!("seed {seed}, {}, {at}: {law}", ground.name)
    };
    let changes_vehicle = random.random_range(0..3) == 0;
    let laws = Laws::of(&setup, ground, changes_vehicle);
    let surroundings: Arc<dyn Surroundings> = ground.surroundings.clone();
    let simulation = Simulation::new(setup.clone(), surroundings).map_err(|error| told(error.to_string()))?;
    let mut rider = Rider { simulation, at: 0, laws, fastest: 0.0, not_integrated: 0, before: None };

    // Chance rides.
    let mut frame = rider.frame(0, &[]).map_err(told)?;
    while rider.at < (MAD_S * SECOND as f64) as Nanos {
        let at = rider.at + step(&mut random);
        let samples = MadDevices { random: &mut random, changes_vehicle }.samples(at);
        frame = rider.frame(at, &samples).map_err(told)?;
    }
    let last = frame.record.clone();

    // What has been sent last is done; then all devices are let go, and a fresh rider presses a key.
    frame = rider.frame(rider.at + SECOND / 60, &[]).map_err(told)?;
    let moved_by = rider.freed(&frame).map_err(told)?;
    let in_streets = rider.laws.streets.is_some();
    let (fastest, not_integrated) = (rider.fastest, rider.not_integrated);
    let ticks = (240.0 * rider.simulation.vehicle().odometer().own_s) as u64;
    Ok(FuzzedRide { ticks, moved_by, in_streets, fastest, not_integrated, last })
}

/// Time until the next frame.
fn step(random: &mut ChaCha8Rng) -> Nanos {
    match random.random_range(0..32) {
        0 => 0,
        1 => SECOND / 3,
        2 => 1,
        n => SECOND / (10 + 4 * n),
    }
}

fn setup(random: &mut ChaCha8Rng, ground: &RidingGround) -> Setup {
    const LIGHT_M_S: [f64; 5] = [1.0, 30.0 / 3.6, 100.0 / 3.6, 299_792_458.0, 0.0];
    const TRACKERS: [&str; 4] = ["vrpn://h/Head", "dtrack://:5000", "opentrack://:4242", "mouse"];
    let light_m_s = match LIGHT_M_S[random.random_range(0..LIGHT_M_S.len())] {
        0.0 => libm::exp10(random.random_range(-0.3..9.0)),
        usual => usual,
    };
    let kind = match random.random_range(0..3) {
        _ if ground.streets.is_none() => VehicleKind::Fly,
        0 => VehicleKind::Bicycle,
        1 => VehicleKind::Drive,
        _ => VehicleKind::Fly,
    };
    let corner = random.random_range(0..ground.corners.len());
    let (here, next) = (ground.corners[corner], ground.corners[(corner + 1) % ground.corners.len()]);
    let up = if kind == VehicleKind::Fly { 1.6 } else { 0.0 };
    // A start between walls that leave no room for a vehicle is none.
    let between = here.lerp(next, random.random_range(0.0..1.0));
    let has_room = ground.surroundings.nearest_wall(between, ROOM_M).is_none();
    let position = if has_room { between } else { here } + DVec3::Y * up;
    let look = match random.random_range(0..3) {
        0 => next - here,
        _ => DVec3::new(random.random_range(-1.0..1.0), random.random_range(-0.2..0.2), random.random_range(-1.0..1.0)),
    };
    let mut start = RideStart::at_rest(position, look, DVec3::Y);
    if random.random_range(0..6) == 0 {
        let celerity = look.normalize_or(DVec3::X) * libm::exp10(random.random_range(-1.0..8.0));
        start.celerity = celerity.to_array();
    }
    let integrators = [IntegratorKind::Rk4, IntegratorKind::Rk4, IntegratorKind::Exact, IntegratorKind::DormandPrince];
    let integrator = integrators[random.random_range(0..4)];
    let mut vehicle = VehicleSettings { integrator, ..VehicleSettings::default() };
    vehicle.flight.nose = [Nose::FacesMotion, Nose::Gyroscopic][random.random_range(0..2)];
    vehicle.flight.hull_m = if random.random_range(0..4) == 0 { 0.0 } else { HULL_M };
    vehicle.assist = [AssistMode::Off, AssistMode::On, AssistMode::Auto][random.random_range(0..3)];
    let tracker = TRACKERS.get(random.random_range(0..8)).and_then(|url| url.parse().ok());
    let has_wand = |url: &TrackerUrl| matches!(url, TrackerUrl::Vrpn { .. } | TrackerUrl::Dtrack { .. });
    let head = tracker.map(|url| HeadConfig { wand: has_wand(&url).then(Default::default), ..HeadConfig::new(url) });
    let light_speed = LightSpeed::new(light_m_s).unwrap_or(LightSpeed::OLD_TOWN);
    Setup { light_speed, kind, start, vehicle, desk: DeskConfig { head, ..DeskConfig::default() } }
}

/// Laws of a ride besides finite numbers.
struct Laws<'a> {
    surroundings: &'a Collision,
    /// Streets that the vehicle has to keep to.
    streets: Option<&'a Streets>,
    /// Least distance from any surface in flight, metres.
    hull_m: f64,
}

impl<'a> Laws<'a> {
    fn of(setup: &Setup, ground: &'a RidingGround, changes_vehicle: bool) -> Self {
        let surroundings = &*ground.surroundings;
        let flies = setup.kind == VehicleKind::Fly;
        let streets = ground.streets.as_ref().filter(|_| !flies && !changes_vehicle);
        // A flight that begins nearer to a surface keeps that distance.
        let start = DVec3::from_array(setup.start.position);
        let first_m = surroundings.nearest_surface(start, HULL_M).map_or(HULL_M, |surface| surface.distance);
        let has_hull = flies && !changes_vehicle && setup.vehicle.flight.hull_m > 0.0;
        let hull_m = if has_hull { (1.0 - HULL_ROUNDING) * first_m } else { 0.0 };
        Self { surroundings, streets, hull_m }
    }

    fn check(&self, position: DVec3, before: Option<DVec3>) -> Result<(), String> {
        let from = before.map_or_else(String::new, |before| format!(", from {before}"));
        if let Some(surface) = self.surroundings.nearest_surface(position, self.hull_m)
            && self.hull_m > 0.0
        {
            return Err(format!("{} m from a surface at {position}{from}", surface.distance));
        }
        let Some(streets) = self.streets else { return Ok(()) };
        if !streets.hold(position) {
            return Err(format!("has left the streets at {position}{from}"));
        }
        let ground = self.surroundings.height_below(position).map_or(f64::NEG_INFINITY, |ground| ground.height);
        let is_near = (position.y - ground).abs() < OFF_GROUND_M;
        if !is_near {
            return Err(format!("at {position}, and the ground at {ground}{from}"));
        }
        match self.surroundings.nearest_wall(position, BODY_M) {
            Some(wall) => Err(format!("{} m from a wall at {position}{from}", wall.distance)),
            None => Ok(()),
        }
    }
}

/// Ride in progress.
struct Rider<'a> {
    simulation: Simulation,
    at: Nanos,
    laws: Laws<'a>,
    fastest: f64,
    not_integrated: u64,
    before: Option<DVec3>,
}

impl Rider<'_> {
    /// Next frame, if it keeps the laws.
    fn frame(&mut self, at: Nanos, samples: &[Sample]) -> Result<RideFrame, String> {
        self.at = at;
        let frame = self.simulation.frame(at, samples);
        self.not_integrated += u64::from(frame.notices.contains(&ride::Notice::NotIntegrated));
        finite(&frame)?;
        let state = frame.vehicle.state();
        self.fastest = self.fastest.max(state.celerity.magnitude());
        self.laws.check(state.position, self.before)?;
        self.before = Some(state.position);
        Ok(frame)
    }

    /// Frames with these samples at their beginning, for a time in seconds. True if they move the vehicle by
    /// [`MOVED_M`], or by what its own time leaves of that: a head far ahead of a vehicle that speeds up has a faster
    /// clock.
    fn moves_with(&mut self, samples: &[Sample], time_s: f64) -> Result<bool, String> {
        let vehicle = self.simulation.vehicle();
        let (from, light_m_s) = (vehicle.state().position, vehicle.light_speed().speed_of_light_m_s());
        let mut farthest_m: f64 = 0.0;
        let mut own_s = 0.0;
        let mut before_s = vehicle.odometer().own_s;
        for number in 0..(60.0 * time_s) as usize {
            let at = self.at + SECOND / 60;
            let frame = self.frame(at, if number == 0 { samples } else { &[] })?;
            farthest_m = farthest_m.max(frame.vehicle.state().position.distance(from));
            let now_s = frame.vehicle.odometer().own_s;
            own_s += (now_s - before_s).max(0.0);
            before_s = now_s;
        }
        let share = (own_s / time_s).min(1.0);
        Ok(farthest_m > MOVED_M * (light_m_s / SLOW_M_S).min(1.0) * share * share)
    }

    /// Moves on with fresh keys after a mad ride. Returns what it took.
    fn freed(&mut self, frame: &RideFrame) -> Result<MovedBy, String> {
        let at = self.at;
        let mut clear: Vec<Sample> = SampleSource::ALL.iter().map(|&source| Sample::closed(at, source)).collect();
        if frame.paused {
            clear.push(Sample::action(at, &Action::TogglePause));
        }
        clear.push(Sample::action(at, &Action::TimeScale(1.0)));
        let trials: [(MovedBy, f64, &[KeyboardKey]); 8] = [
            (MovedBy::Ahead, FRESH_S, &[KeyboardKey::W]),
            (MovedBy::Sideways, FRESH_S, &[KeyboardKey::W, KeyboardKey::A]),
            (MovedBy::Sideways, FRESH_S, &[KeyboardKey::W, KeyboardKey::D]),
            (MovedBy::Backward, FRESH_S, &[KeyboardKey::S]),
            (MovedBy::Patience, PATIENT_S, &[KeyboardKey::S]),
            (MovedBy::Patience, PATIENT_S, &[KeyboardKey::W]),
            (MovedBy::Patience, PATIENT_S, &[KeyboardKey::W, KeyboardKey::A]),
            (MovedBy::Patience, PATIENT_S, &[KeyboardKey::W, KeyboardKey::D]),
        ];
        for (moved_by, time_s, keys) in trials {
            clear.push(Sample::closed(self.at, SampleSource::Keyboard));
            clear.extend(keys.iter().map(|&key| Sample::key(self.at, key, true)));
            if self.moves_with(&clear, time_s)? {
                return Ok(moved_by);
            }
            clear.clear();
        }
        let vehicle = self.simulation.vehicle();
        let (place, celerity) = (vehicle.state().position, vehicle.state().celerity.vector());
        Err(format!("sticks at {place} with the celerity {celerity}"))
    }
}

/// All numbers of a frame, if they are finite.
fn finite(frame: &RideFrame) -> Result<(), String> {
    let record = &frame.record;
    let (observer, eye) = (frame.gaze.observer, frame.gaze.observer_from_eye);
    let thrust = frame.vehicle.thrust();
    let odometer = frame.vehicle.odometer();
    let numbers = [
        record.proper_time,
        record.ct,
        record.rapidity,
        record.doppler_ahead,
        record.road,
        record.odometer,
        odometer.own_s,
        odometer.world_s,
        observer.event.ct,
        frame.vehicle.resistance(),
        frame.vehicle.slope(),
        frame.time_scale,
    ];
    let vectors = [
        DVec3::from_array(record.position),
        DVec3::from_array(record.celerity),
        observer.event.position,
        observer.celerity.vector(),
        thrust.acceleration,
        thrust.turn_rate,
    ];
    let turn = (eye.length() - 1.0).abs() < 1e-6 && glam::DQuat::from_array(record.orientation).is_finite();
    let head =
        frame.controls.head.as_ref().is_none_or(|head| head.position_m.is_finite() && head.velocity_m_s.is_finite());
    let is_finite = turn && head && numbers.iter().all(|n| n.is_finite()) && vectors.iter().all(|v| v.is_finite());
    if is_finite { Ok(()) } else { Err(format!("not finite: {record:?}, {numbers:?}, {vectors:?}, {eye:?}")) }
}
