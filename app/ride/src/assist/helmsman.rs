//! Steering of the assist: from the way that is free to the vehicle's controls.
//!
//! The vehicle is steered towards a point ahead (pure pursuit: the circle through it has the curvature
//! κ = 2 sin α / l, α the bearing of that point at the distance l). The speed is at most that at which the bend
//! ahead is ridden comfortably, with the deceleration of a firm hand on the way to it.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use input::{Controls, VehicleKind};
use scene::Surroundings;

use super::ways;
use crate::route::Route;
use crate::vehicle::Vehicle;

/// Number of ticks from one look at the walls to the next.
const TICKS_PER_LOOK: u32 = 8;
/// Time in which the assist comes back in after a hand has steered, seconds of own time.
const RETURN_S: f64 = 1.5;
/// Deflection of a hand that counts as steering.
const HAND: f64 = 1e-3;
/// Distance from the circuit within which it is followed, metres.
const NEAR_CIRCUIT_M: f64 = 8.0;
/// Time in which the point aimed at is reached, seconds, and its least distance, metres.
const AIM_S: f64 = 0.5;
const AIM_M: f64 = 2.2;
/// Fastest comfortable turn, radians per second of own time.
const BEND_RAD_S: f64 = 1.0;
/// Deceleration before bends and walls, m/s².
const EASE_M_S2: f64 = 1.2;
/// Speed at which any bend is ridden, m/s.
const CRAWL_M_S: f64 = 2.0;
/// Length of the ways that are compared, metres, and distance within which bends are looked for.
const OUTLOOK_M: f64 = 14.0;
const FARTHEST_M: f64 = 60.0;
/// Longest way that is followed, metres. Nothing in a street goes so fast that it aims further, and where nothing ends
/// a way it would be followed for hours.
const LONGEST_WAY_M: f64 = 200.0;
/// Spacing of the places of the circuit whose bends are looked at, metres.
const SPACING_M: f64 = 2.0;
/// Largest angle of the handlebar, radians.
const FARTHEST_STEER_RAD: f64 = 0.9;
/// Pull of the lever for each m/s of excess speed, and its largest pull.
const LEVER_PER_M_S: f64 = 0.25;
const FARTHEST_LEVER: f64 = 0.65;
/// Speed below which a vehicle stands, m/s.
const STANDING_M_S: f64 = 0.3;
/// Bearing beyond which a car turns on the spot, radians.
const ON_THE_SPOT_RAD: f64 = 0.7;

/// Wish of the assist, from its last look at the walls.
#[derive(Clone, Copy, Debug)]
struct Course {
    /// Direction to steer for, a level unit vector.
    direction: DVec3,
    /// Fastest speed, metres of road per second of own time.
    fastest_m_s: f64,
}

/// Assisted steering of one ride.
#[derive(Clone, Debug)]
pub struct Assist {
    route: Option<Route>,
    along_m: f64,
    /// Direction in which the circuit is followed: 1, −1, or 0 where it is not.
    sense: f64,
    ticks: u32,
    course: Option<Course>,
    /// Share of the assist in the steering, 0 to 1.
    share: f64,
}

impl Assist {
    /// Assist that follows the closed polyline `circuit` where it is near; walls alone if that is no polyline.
    pub fn new(circuit: &[DVec3]) -> Self {
        Self { route: Route::new(circuit), along_m: f64::NAN, sense: 0.0, ticks: 0, course: None, share: 1.0 }
    }

    /// Forgets the way so far: the vehicle is somewhere else.
    pub fn restart(&mut self) {
        *self = Self { route: self.route.take(), ..Self::new(&[]) };
    }

    /// Controls of the vehicle for the next `own_s` seconds of own time, made of the rider's.
    pub fn steered(
        &mut self,
        rider: &Controls,
        vehicle: &Vehicle,
        surroundings: &dyn Surroundings,
        own_s: f64,
    ) -> Controls {
        let mut controls = rider.clone();
        let speed_m_s = forward_m_s(vehicle);
        if steers(rider) || !goes_ahead(rider, vehicle.kind(), speed_m_s) {
            (self.share, self.ticks, self.course) = (0.0, 0, None);
            return controls;
        }
        self.share = (self.share + own_s / RETURN_S).min(1.0);
        if self.ticks == 0 {
            self.course = self.look(vehicle, surroundings, speed_m_s);
        }
        self.ticks = (self.ticks + 1) % TICKS_PER_LOOK;
        let Some(course) = self.course else { return controls };

        let nose = vehicle.heading();
        let bearing = libm::atan2(course.direction.dot(DVec3::Y.cross(nose)), course.direction.dot(nose));
        let aim_m = AIM_M.max(AIM_S * speed_m_s.abs());
        let curvature = 2.0 * libm::sin(bearing.clamp(-FRAC_PI_2, FRAC_PI_2)) / aim_m;
        let bend_m_s = (BEND_RAD_S / curvature.abs().max(1e-6)).max(CRAWL_M_S);
        let fastest_m_s = course.fastest_m_s.min(bend_m_s);
        match vehicle.kind() {
            VehicleKind::Bicycle => self.pedal(&mut controls, vehicle, [bearing, curvature, fastest_m_s]),
            VehicleKind::Drive => self.drive(&mut controls, vehicle, [bearing, curvature, fastest_m_s]),
            VehicleKind::Fly => {}
        }
        controls
    }

    /// Steers a bicycle, and eases off.
    fn pedal(&self, controls: &mut Controls, vehicle: &Vehicle, wish: [f64; 3]) {
        let [bearing, curvature, fastest_m_s] = wish;
        let speed_m_s = forward_m_s(vehicle);
        let wheelbase_m = vehicle.settings().bicycle.wheelbase_m;
        let sharpest = if bearing.abs() > FRAC_PI_2 {
            FARTHEST_STEER_RAD.copysign(bearing)
        } else {
            libm::atan(wheelbase_m * curvature).clamp(-FARTHEST_STEER_RAD, FARTHEST_STEER_RAD)
        };
        controls.steer_rad += self.share * sharpest;
        controls.wheel_speed = controls.wheel_speed.map(|wanted| wanted.min(fastest_m_s));
        let excess = (speed_m_s - fastest_m_s - 0.3).max(0.0);
        controls.brake = controls.brake.max((LEVER_PER_M_S * excess).min(FARTHEST_LEVER) * self.share);
    }

    /// Steers a car, eases off, and turns it on the spot where its way leads elsewhere.
    fn drive(&self, controls: &mut Controls, vehicle: &Vehicle, wish: [f64; 3]) {
        let [bearing, curvature, fastest_m_s] = wish;
        let speed_m_s = forward_m_s(vehicle);
        let full_m_s2 = vehicle.light_speed().metres_per_own_second(vehicle.settings().flight.thrust_per_s);
        // The tyres hold as much sideways as the drive gives: rudder and thrust together.
        let fastest_m_s =
            fastest_m_s.min((full_m_s2 / curvature.abs().max(1e-6)).sqrt()).max(CRAWL_M_S.min(fastest_m_s));
        let sideways = (speed_m_s * speed_m_s * curvature / full_m_s2).clamp(-1.0, 1.0);
        controls.turn[1] = (controls.turn[1] + self.share * (2.0 * bearing).clamp(-1.0, 1.0)).clamp(-1.0, 1.0);
        controls.thrust[0] = (controls.thrust[0] - self.share * sideways).clamp(-1.0, 1.0);
        let turns_first = bearing.abs() > ON_THE_SPOT_RAD && speed_m_s < STANDING_M_S;
        let wanted_m_s2 = if turns_first { 0.0 } else { 2.0 * (fastest_m_s - speed_m_s) };
        let ahead = (-controls.thrust[2]).max(0.0);
        controls.thrust[2] = -ahead.min((wanted_m_s2 / full_m_s2).clamp(0.0, 1.0));
        let brake = (-wanted_m_s2 / (2.0 * full_m_s2)).clamp(0.0, 1.0);
        controls.brake = controls.brake.max(brake * self.share);
    }

    /// Looks for the way; `None` where neither walls nor a circuit show one.
    fn look(&mut self, vehicle: &Vehicle, surroundings: &dyn Surroundings, speed_m_s: f64) -> Option<Course> {
        let from = vehicle.state().position;
        let nose = vehicle.heading();
        let (wanted, bends_m_s) = match self.on_circuit(from, nose, speed_m_s) {
            Some((aim, bends_m_s)) => (DVec3 { y: 0.0, ..aim - from }.normalize_or(nose), Some(bends_m_s)),
            None => (nose, None),
        };
        // A circuit is followed as far as the point that is aimed at; walls alone show their way from further off.
        let most_m = if bends_m_s.is_some() { AIM_M.max(AIM_S * speed_m_s).min(LONGEST_WAY_M) } else { OUTLOOK_M };
        let (direction, free) = ways::best(surroundings, from, wanted, most_m);
        let ease = |distance_m: f64| libm::hypot(CRAWL_M_S, (2.0 * EASE_M_S2 * distance_m).sqrt());
        let fastest_m_s = match bends_m_s {
            Some(bends_m_s) if free >= most_m => bends_m_s,
            Some(bends_m_s) => bends_m_s.min(ease(free)),
            None => {
                let far_m = (speed_m_s * speed_m_s / EASE_M_S2).clamp(OUTLOOK_M, FARTHEST_M);
                let free = if free < most_m { free } else { ways::free_m(surroundings, from, direction, far_m) };
                // Where nothing is in the way and nothing beside it, nobody needs help.
                if free >= far_m && surroundings.nearest_wall(from, OUTLOOK_M).is_none() {
                    return None;
                }
                ease(free)
            }
        };
        Some(Course { direction, fastest_m_s })
    }

    /// Point of the circuit to aim at, and the fastest speed for its bends; `None` where the circuit is not near.
    fn on_circuit(&mut self, from: DVec3, nose: DVec3, speed_m_s: f64) -> Option<(DVec3, f64)> {
        /// Cosine of the angle to the circuit below which the sense of the ride stays what it was.
        const ACROSS: f64 = 0.3;
        let route = self.route.as_ref()?;
        self.along_m = route.nearest(from, self.along_m);
        let place = route.point(self.along_m);
        if place.distance(DVec3 { y: 0.0, ..from }) > NEAR_CIRCUIT_M {
            self.sense = 0.0;
            return None;
        }
        let tangent = route.point(self.along_m + 0.5) - route.point(self.along_m - 0.5);
        let along = nose.dot(tangent.normalize_or_zero());
        if self.sense == 0.0 || along.abs() > ACROSS {
            self.sense = if along < 0.0 { -1.0 } else { 1.0 };
        }
        let aim_m = AIM_M.max(AIM_S * speed_m_s);
        let aim = route.point(self.along_m + self.sense * aim_m);
        let looks = (0..).map(|n| f64::from(n) * SPACING_M).take_while(|&distance| distance < FARTHEST_M);
        let fastest = looks.fold(f64::INFINITY, |fastest, distance_m| {
            let bend = route.curvature(self.along_m + self.sense * distance_m, SPACING_M);
            let bend_m_s = (BEND_RAD_S / bend.max(1e-6)).max(CRAWL_M_S);
            fastest.min(libm::hypot(bend_m_s, (2.0 * EASE_M_S2 * distance_m).sqrt()))
        });
        Some((aim, fastest.min(libm::hypot(CRAWL_M_S, (2.0 * EASE_M_S2 * FARTHEST_M).sqrt()))))
    }
}

/// Speed along the nose, metres of road per second of own time.
fn forward_m_s(vehicle: &Vehicle) -> f64 {
    let state = vehicle.state();
    let forward = state.celerity.vector().dot(state.orientation * DVec3::NEG_Z);
    vehicle.light_speed().metres_per_own_second(forward)
}

/// True if the rider's hand steers.
fn steers(rider: &Controls) -> bool {
    let turns = [rider.steer_rad, rider.thrust[0], rider.turn[1]];
    turns.iter().any(|turn| turn.abs() > HAND || turn.is_nan())
}

/// True if the vehicle goes ahead, or the rider wants it to.
fn goes_ahead(rider: &Controls, kind: VehicleKind, speed_m_s: f64) -> bool {
    match kind {
        VehicleKind::Bicycle => rider.wheel_speed.is_some_and(|wheel| wheel > 0.0 || (wheel == 0.0 && speed_m_s > 0.0)),
        VehicleKind::Drive => rider.thrust[2] < 0.0 || (rider.thrust[2] == 0.0 && speed_m_s > STANDING_M_S),
        VehicleKind::Fly => false,
    }
}
