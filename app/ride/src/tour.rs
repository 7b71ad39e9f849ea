//! Built-in tour: a simulated rider on a closed route round a scene, for films and demonstrations without a person on
//! the bicycle.
//!
//! The rider takes no short cut through the program: it produces the lines of the `B1` protocol ([`input::bicycle`])
//! that the sensors of an instrumented bicycle would send. These pass through the real decoder and may be recorded.
//! The rider steers towards a point of the route a little ahead (pure pursuit: δ = atan(2 L sin α / l), α the bearing
//! of that point at the distance l), slows down before bends, and pulls the brake where coasting is not enough. Its
//! samples depend on the vehicle and the time alone, so a tour repeats to the bit.

use glam::{DQuat, DVec3};
use input::line::sealed;
use input::{BicycleConfig, Nanos, SECOND, Sample, SampleSource};

use crate::route::Route;
use crate::vehicle::Vehicle;

/// Number of sensor lines per second.
const LINES_PER_SECOND: u64 = 100;
/// Usual rates at which the pedalled wheel gains (pedal) and loses (ease) speed, m/s².
const PEDAL_M_S2: f64 = 1.0;
const EASE_M_S2: f64 = 1.5;
/// Fastest turn in bends, radians per second of own time.
const BEND_RAD_S: f64 = 0.9;
/// Deceleration assumed when slowing down before a bend, m/s²: a little more than the bicycle's own.
const FORESIGHT_M_S2: f64 = 0.6;
/// Distance ahead within which bends are looked for, and spacing of the places examined, metres.
const OUTLOOK_M: f64 = 24.0;
const OUTLOOK_SPACING_M: f64 = 1.5;
/// Time after which the point aimed at is reached, seconds, and its smallest distance ahead, metres.
const AIM_S: f64 = 0.4;
const AIM_M: f64 = 1.8;
/// Pull of the brake lever per m/s of excess speed, and its largest pull, which stays within the first stage.
const LEVER_PER_M_S: f64 = 0.3;
const FARTHEST_LEVER: f64 = 0.45;
/// Largest angle of the handlebar, radians.
const FARTHEST_STEER_RAD: f64 = 0.8;

/// Simulated rider that follows a closed route.
#[derive(Clone, Debug)]
pub struct Tour {
    route: Route,
    bicycle: BicycleConfig,
    /// Number of lines produced so far.
    lines: u64,
    /// Speed of the pedalled wheel, m/s.
    wheel_m_s: f64,
    wheel: Magnet,
    crank: Magnet,
    /// Present length along the route, metres.
    along_m: f64,
    /// Top speed, m/s, and rate at which the pedalled wheel gains speed, m/s².
    top_m_s: f64,
    gain_m_s2: f64,
}

impl Tour {
    /// Top speed of the rider, m/s: 25 km/h, a celerity of 5/6 in the old town.
    pub const CRUISE_M_S: f64 = 25.0 / 3.6;

    /// Creates a rider for a closed route, a polyline on the ground, on a bicycle whose sensors are calibrated as
    /// `bicycle` says. `None` if the route has fewer than three different corners, or one that is not finite.
    pub fn new(circuit: &[DVec3], bicycle: &BicycleConfig) -> Option<Self> {
        Some(Self {
            route: Route::new(circuit)?,
            lines: 0,
            wheel_m_s: 0.0,
            wheel: Magnet::new(bicycle.metres_per_pulse()),
            crank: Magnet::new(bicycle.metres_per_crank_turn / bicycle.pulses_per_crank_turn),
            along_m: f64::NAN,
            top_m_s: Self::CRUISE_M_S,
            gain_m_s2: PEDAL_M_S2,
            bicycle: bicycle.clone(),
        })
    }

    /// Changes the top speed, m/s of road per second of the rider's own time, and the rate at which the rider gains
    /// speed, m/s².
    pub fn ride_at(&mut self, top_m_s: f64, gain_m_s2: f64) {
        (self.top_m_s, self.gain_m_s2) = (top_m_s, gain_m_s2);
    }

    /// Length along the route at the last samples, metres; NaN before them.
    pub fn along_m(&self) -> f64 {
        self.along_m
    }

    /// Samples of the sensors up to the time `until`, following those returned before. `vehicle` is the rider's
    /// vehicle at present.
    pub fn samples(&mut self, vehicle: &Vehicle, until: Nanos) -> Vec<Sample> {
        let mut samples = Vec::new();
        if self.lines == 0 {
            samples.push(Sample::opened(0, SampleSource::Bicycle));
        }
        let due = until / (SECOND / LINES_PER_SECOND) + 1;
        if self.lines < due {
            let (steer_rad, brake, wanted_m_s) = self.decide(vehicle);
            for line in self.lines..due {
                let at = line * (SECOND / LINES_PER_SECOND);
                self.pedal(at, wanted_m_s);
                samples.push(Sample::bytes(
                    at,
                    SampleSource::Bicycle,
                    self.line(line, at, steer_rad, brake).into_bytes(),
                ));
            }
            self.lines = due;
        }
        samples
    }

    /// Handlebar angle (radians), brake lever (0 to 1) and wanted speed (m/s).
    fn decide(&mut self, vehicle: &Vehicle) -> (f64, f64, f64) {
        let state = vehicle.state();
        let speed = vehicle.light_speed().metres_per_own_second(state.celerity.magnitude());
        self.along_m = self.route.nearest(state.position, self.along_m);

        // The rider steers towards a point ahead.
        let wheelbase_m = vehicle.settings().bicycle.wheelbase_m;
        let aim = self.route.point(self.along_m + AIM_M.max(AIM_S * speed));
        let (ahead, left) = in_plane(state.orientation, aim - state.position);
        let steer_rad = libm::atan(2.0 * wheelbase_m * left / (ahead * ahead + left * left).max(f64::MIN_POSITIVE));
        // A point behind is turned to as sharply as possible.
        let steer_rad = if ahead > 0.0 { steer_rad } else { FARTHEST_STEER_RAD.copysign(left) };

        // The rider slows down in time for the bends ahead.
        let looks = (0..).map(|n| f64::from(n) * OUTLOOK_SPACING_M).take_while(|&distance| distance < OUTLOOK_M);
        let wanted_m_s = looks.fold(self.top_m_s, |slowest, distance| {
            let bend_m_s = BEND_RAD_S / self.route.curvature(self.along_m + distance, OUTLOOK_SPACING_M);
            slowest.min(libm::hypot(bend_m_s, (2.0 * FORESIGHT_M_S2 * distance).sqrt()))
        });
        let brake = (LEVER_PER_M_S * (speed - wanted_m_s)).clamp(0.0, FARTHEST_LEVER);
        (steer_rad.clamp(-FARTHEST_STEER_RAD, FARTHEST_STEER_RAD), brake, wanted_m_s)
    }

    /// Turns the wheel during the time of one line that ends at `at`.
    fn pedal(&mut self, at: Nanos, wanted_m_s: f64) {
        let span_s = 1.0 / LINES_PER_SECOND as f64;
        let change = wanted_m_s - self.wheel_m_s;
        self.wheel_m_s += change.clamp(-EASE_M_S2.max(self.gain_m_s2) * span_s, self.gain_m_s2 * span_s);
        let end_us = at / 1000;
        self.wheel.roll(self.wheel_m_s * span_s, span_s, end_us);
        self.crank.roll(self.wheel_m_s * span_s, span_s, end_us);
    }

    fn line(&self, sequence: u64, at: Nanos, steer_rad: f64, brake: f64) -> String {
        let BicycleConfig { steer_straight, steer_rad_per_unit, brake_released, brake_full, .. } = self.bicycle;
        let BicycleConfig { steer_dead_rad, brake_curve, .. } = self.bicycle;
        // Through the dead zone, and along the lever's curve.
        let turned = if steer_dead_rad > 0.0 { steer_rad + steer_dead_rad.copysign(steer_rad) } else { steer_rad };
        let brake = if brake_curve == 1.0 { brake } else { libm::pow(brake, brake_curve.recip()) };
        let steer = steer_straight + turned / steer_rad_per_unit;
        let brake = brake_released + brake * (brake_full - brake_released);
        // The numbers of the bicycle's box wrap at 32 bits.
        let (sequence, now_us) = (sequence as u32, (at / 1000) as u32);
        let (wheel, crank) = (&self.wheel, &self.crank);
        sealed(&format!(
            "B1,{sequence},{now_us},{},{},{},{},{steer:.2},{brake:.1}",
            wheel.pulses, wheel.last_us, crank.pulses, crank.last_us
        ))
    }
}

/// Distances ahead and to the left of a displacement, on the level, metres.
fn in_plane(orientation: DQuat, displacement: DVec3) -> (f64, f64) {
    let nose = orientation * DVec3::NEG_Z;
    let ahead = DVec3 { y: 0.0, ..nose }.normalize_or(DVec3::NEG_Z);
    (displacement.dot(ahead), displacement.dot(DVec3::Y.cross(ahead)))
}

/// Magnet on a wheel, and the sensor that counts its passes.
#[derive(Clone, Debug)]
struct Magnet {
    /// Distance between two pulses, metres.
    spacing_m: f64,
    /// Distance since the last pulse, metres.
    since_m: f64,
    pulses: u32,
    last_us: u32,
}

impl Magnet {
    /// Creates a wheel that stands just before the magnet, so that its first pulse comes soon.
    fn new(spacing_m: f64) -> Self {
        Self { spacing_m, since_m: 0.95 * spacing_m, pulses: 0, last_us: 0 }
    }

    /// Rolls `way_m` metres at a steady speed in the `span_s` seconds before `end_us`.
    fn roll(&mut self, way_m: f64, span_s: f64, end_us: u64) {
        self.since_m += way_m;
        while self.since_m >= self.spacing_m {
            self.since_m -= self.spacing_m;
            self.pulses = self.pulses.wrapping_add(1);
            let ago_us = (self.since_m / way_m * span_s * 1e6) as u64;
            self.last_us = end_us.saturating_sub(ago_us) as u32;
        }
    }
}
