//! Bicycle, car or spaceship, at the present end of its worldline.

use glam::DVec3;
use input::{Controls, HeadState, VehicleKind};
use physics::Celerity;
use physics::worldline::{Control, DormandPrince, Exact, Integrator, Rk4, Thrust, WorldlineError, WorldlineState};
use scene::{Surroundings, Wall};
use view::Gaze;

use super::bicycle::{BicycleControl, roll};
use super::flight::{FlightControl, level};
use super::ground::{GroundCourse, heading, placed, upright};
use super::hull::Hull;
use super::light_speed::LightSpeed;
use super::notice::{Notice, RAPIDITY_CAP};
use super::odometer::Odometer;
use super::safe_controls::SafeControls;
use super::settings::{IntegratorKind, SettingsError, VehicleSettings};
use super::walls;

/// Longest piece that a step is cut into, seconds of own time.
const LONGEST_STEP_S: f64 = 1.0 / 240.0;
/// Largest number of pieces of one step.
const MOST_PIECES: f64 = 64.0;
/// Largest change of the rapidity, plus turn in radians, within a step of RK4: about that of the row of RK4 in
/// ACCURACY.md. The error of a journey grows with its fourth power.
const LARGEST_CHANGE: f64 = 0.005;
/// Sine of a slope steeper than any road.
const STEEPEST_ROAD: f64 = 0.9;
/// Largest number of strides between walls for one piece of a step.
const MOST_STRIDES: usize = 64;

/// Bicycle, car or spaceship, at the present end of its worldline.
#[derive(Clone, Debug)]
pub struct Vehicle {
    light_speed: LightSpeed,
    kind: VehicleKind,
    settings: VehicleSettings,
    state: WorldlineState,
    odometer: Odometer,
    /// True if a wall blocks the way ahead.
    blocked: bool,
    resistance: f64,
    /// Acceleration and turn at the end of the last step.
    thrust: Thrust,
    notices: Vec<Notice>,
}

impl Vehicle {
    /// Creates a vehicle in the given state, with its odometer at zero.
    ///
    /// # Errors
    /// [`SettingsError`] for a setting that cannot be used.
    pub fn new(
        light_speed: LightSpeed,
        kind: VehicleKind,
        state: WorldlineState,
        settings: VehicleSettings,
    ) -> Result<Self, SettingsError> {
        settings.check()?;
        let odometer = Odometer::default();
        Ok(Self {
            light_speed,
            kind,
            settings,
            state,
            odometer,
            blocked: false,
            resistance: 0.0,
            thrust: Thrust::default(),
            notices: Vec::new(),
        })
    }

    /// State of the reference point in spacetime. A bicycle's and a car's is on the ground; in flight it is the pilot's
    /// eye. The orientation is that of the pilot's axes: right, up, backward.
    pub fn state(&self) -> &WorldlineState {
        &self.state
    }

    /// Level unit vector along which the nose points.
    pub fn heading(&self) -> DVec3 {
        heading(self.state.orientation)
    }

    /// Kind of vehicle: bicycle, drive or fly.
    pub fn kind(&self) -> VehicleKind {
        self.kind
    }

    /// Speed of light in the world.
    pub fn light_speed(&self) -> LightSpeed {
        self.light_speed
    }

    /// Settings of the vehicle's response.
    pub fn settings(&self) -> &VehicleSettings {
        &self.settings
    }

    /// Distances and times since the start.
    pub fn odometer(&self) -> &Odometer {
        &self.odometer
    }

    /// Acceleration and turn at the end of the last step, which carry the room along.
    pub fn thrust(&self) -> &Thrust {
        &self.thrust
    }

    /// Own time of the vehicle for each unit of own time of a head in it.
    pub fn time_ratio(&self, head: &HeadState) -> f64 {
        let celerity = Celerity::new(head.velocity_m_s / self.light_speed.speed_of_light_m_s()).unwrap_or_default();
        self.thrust.time_ratio(head.position_m, celerity)
    }

    /// Notices for the rider about the last step.
    pub fn notices(&self) -> &[Notice] {
        &self.notices
    }

    /// Resistance for the ergometer's brake, 0 to 1, from the lever and from the load on the bicycle (B 5.6.1).
    pub fn resistance(&self) -> f64 {
        self.resistance
    }

    /// View of the rider, driver or pilot, whose eye rests in the vehicle, turns with it, and looks along the nose.
    pub fn gaze(&self) -> Gaze {
        let eye = self.state.aboard(self.eye_offset(), Celerity::ZERO, &self.thrust);
        Gaze { observer: eye.observer(), observer_from_eye: eye.orientation }
    }

    /// Changes the speed of light. Celerity and place stay unchanged.
    pub fn set_light_speed(&mut self, light_speed: LightSpeed) {
        self.light_speed = light_speed;
    }

    /// Changes the kind of vehicle. At take-off the eye stays in place. A bicycle and a car are set upright on the
    /// ground below, where there is any, and keep the part of their celerity that their constraints allow.
    pub fn set_kind(&mut self, kind: VehicleKind, surroundings: &dyn Surroundings) {
        if kind == self.kind {
            return;
        }
        if kind == VehicleKind::Fly {
            let event = self.gaze().observer.event;
            (self.state.ct, self.state.position) = (event.ct, event.position);
        }
        (self.kind, self.thrust) = (kind, Thrust::default());
        self.settle(surroundings);
    }

    /// Puts a bicycle or a car upright on the ground.
    pub fn settle(&mut self, surroundings: &dyn Surroundings) {
        self.blocked = false;
        if self.kind == VehicleKind::Fly {
            return;
        }
        self.state.position = placed(surroundings, self.state.position);
        self.state.orientation = upright(heading(self.state.orientation));
        self.constrain();
    }

    /// Moves on by `own_s` seconds of the vehicle's own time.
    ///
    /// The state stays finite for any controls: a control that is not a number counts as released, and a step that
    /// cannot be integrated is not taken ([`Vehicle::notices`]). A step longer than 1/240 s is cut into pieces of at
    /// most that length; at most 64 pieces are taken.
    pub fn step(&mut self, own_s: f64, controls: &Controls, surroundings: &dyn Surroundings) {
        self.notices.clear();
        let controls = SafeControls::new(controls);
        if controls.contained || !(own_s.is_finite() && own_s >= 0.0) {
            self.tell(Notice::ControlsNotFinite);
        }
        if !(own_s.is_finite() && own_s > 0.0) {
            return;
        }
        /// Excess over a whole number that counts as rounding.
        const ROUNDING: f64 = 1e-9;
        let own_s = own_s.min(MOST_PIECES * LONGEST_STEP_S);
        let pieces = (own_s / LONGEST_STEP_S - ROUNDING).ceil().max(1.0);
        for _ in 0..pieces as usize {
            match self.kind {
                VehicleKind::Fly => self.fly(own_s / pieces, &controls, surroundings),
                VehicleKind::Bicycle | VehicleKind::Drive => self.ride(own_s / pieces, &controls, surroundings),
            }
        }
    }

    /// Takes one piece of a step in flight, in strides in which no surface can be reached.
    fn fly(&mut self, own_s: f64, controls: &SafeControls, surroundings: &dyn Surroundings) {
        self.resistance = 0.0;
        let hull = Hull { radius_m: self.settings.flight.hull_m };
        if hull.radius_m == 0.0 {
            return self.fly_on(own_s, controls);
        }
        let mut left_s = own_s;
        let mut surface = hull.nearest(surroundings, self.state.position, self.farthest_m(own_s));
        for stride in 1..=MOST_STRIDES {
            let celerity = self.state.celerity.vector();
            let slid = surface.map_or(celerity, |surface| hull.slid(&surface, celerity, self.light_speed));
            if slid != celerity {
                self.state.celerity = Celerity::new(slid).unwrap_or(Celerity::ZERO);
            }
            let farthest_m = self.farthest_m(left_s);
            let free_m = hull.stride_m(surface, farthest_m);
            let is_last = stride == MOST_STRIDES || farthest_m <= free_m;
            let span_s = if is_last { left_s } else { left_s * (free_m / farthest_m) };

            let before = self.state.position;
            self.fly_on(span_s, controls);
            if surface.is_none() {
                return;
            }
            let moved = self.state.position - before;
            if moved.length() > free_m {
                self.state.position = before + hull.held(surface, moved * (free_m / moved.length()));
                self.state.celerity = walls::slowed(self.state.celerity, free_m, span_s, self.light_speed);
                self.tell(Notice::HeldByWalls);
            }
            let end = self.state.position;
            match hull.landed(surroundings, surface, end, self.state.celerity, self.farthest_m(left_s)) {
                Some(landing) => {
                    self.state.position = landing.position;
                    if landing.celerity != self.state.celerity.vector() {
                        self.state.celerity = Celerity::new(landing.celerity).unwrap_or(Celerity::ZERO);
                    }
                    surface = landing.surface;
                }
                None => {
                    self.state.position = before;
                    self.state.celerity = Celerity::ZERO;
                }
            }
            if is_last {
                return;
            }
            left_s -= span_s;
        }
    }

    /// Largest distance that a flight may cover in a time, metres, whatever the controls do.
    fn farthest_m(&self, own_s: f64) -> f64 {
        /// Largest proper acceleration, in full thrusts: three thrusts, two of the brake, the rudder and its turn.
        const THRUSTS: f64 = 8.0;
        let gain = THRUSTS * self.settings.flight.thrust_per_s * own_s;
        let u = self.state.celerity.magnitude();
        let fastest = u * libm::cosh(gain) + libm::hypot(u, 1.0) * libm::sinh(gain);
        self.light_speed.metres(own_s) * fastest
    }

    /// Takes one stride through free space.
    fn fly_on(&mut self, own_s: f64, controls: &SafeControls) {
        let settings = self.settings;
        self.integrate(own_s, &FlightControl::new(&settings.flight, self.light_speed, controls, None));
    }

    /// Takes one piece of a step on the ground, in strides shorter than any wall is thick.
    fn ride(&mut self, own_s: f64, controls: &SafeControls, surroundings: &dyn Surroundings) {
        let mut left_s = own_s;
        let mut wall = walls::nearest(surroundings, self.state.position, self.distance_m(own_s));
        for stride in 1.. {
            self.keep_clear(wall, left_s);
            // The stride goes as far as the space is free, or to the end of the step.
            let free_m = walls::stride_m(wall, self.distance_m(left_s));
            if stride == MOST_STRIDES && self.distance_m(left_s) > free_m {
                self.state.celerity = walls::slowed(self.state.celerity, free_m, left_s, self.light_speed);
                self.tell(Notice::HeldByWalls);
            }
            let distance_m = self.distance_m(left_s);
            let span_s = if distance_m > free_m { left_s * (free_m / distance_m) } else { left_s };

            let before = self.state.position;
            self.drive_on(span_s, controls, surroundings);
            match walls::settled(surroundings, wall, self.state.position, self.distance_m(left_s)) {
                Some((position, wall_there)) => {
                    self.state.position = position;
                    wall = wall_there;
                }
                None => {
                    self.state.position = before;
                    self.state.celerity = Celerity::ZERO;
                }
            }
            if span_s >= left_s || stride == MOST_STRIDES {
                return;
            }
            left_s -= span_s;
        }
    }

    /// Takes one stride on the ground, without regard to walls.
    fn drive_on(&mut self, own_s: f64, controls: &SafeControls, surroundings: &dyn Surroundings) {
        let (direction, backward) = self.road_direction();
        let course = GroundCourse::ahead(surroundings, self.state.position, direction, self.distance_m(own_s));
        let settings = self.settings;
        if self.kind == VehicleKind::Drive {
            self.resistance = 0.0;
            self.integrate(own_s, &FlightControl::new(&settings.flight, self.light_speed, controls, Some(course)));
        } else {
            let course = if backward { course.reversed() } else { course };
            let forward = self.forward();
            let control =
                BicycleControl::new(&settings.bicycle, self.light_speed, controls, course, self.blocked, forward);
            self.resistance = control.resistance(forward);
            self.integrate(own_s, &control);
        }
        self.constrain();
    }

    /// Integrates the worldline, caps the rapidity, and advances the odometer.
    fn integrate(&mut self, own_s: f64, control: &dyn Control) {
        let before = self.state.celerity;
        let step = self.light_speed.metres(own_s);
        let taken = match self.settings.integrator {
            IntegratorKind::Rk4 => self.in_short_steps(step, control),
            IntegratorKind::Exact => Exact.step(&self.state, step, control),
            IntegratorKind::DormandPrince => DormandPrince::default().step(&self.state, step, control),
        };
        let taken = taken.or_else(|_| {
            self.tell(Notice::TakenByRk4);
            Rk4.step(&self.state, step, control)
        });
        match taken {
            Ok(state) => self.state = state,
            Err(_) => return self.tell(Notice::NotIntegrated),
        }
        self.thrust = control.thrust(&self.state);
        let capped = self.state.celerity.capped(RAPIDITY_CAP);
        if capped != self.state.celerity {
            self.state.celerity = capped;
            self.tell(Notice::RapidityCapped);
        }
        self.odometer.count(self.light_speed, own_s, before, self.state.celerity);
    }

    /// State after a step by RK4, in parts in which the rapidity changes by [`LARGEST_CHANGE`] at most, while thrust
    /// and turn stay what they are now.
    fn in_short_steps(&self, step: f64, control: &dyn Control) -> Result<WorldlineState, WorldlineError> {
        let Thrust { acceleration, turn_rate } = control.thrust(&self.state);
        let change = (acceleration.length() + turn_rate.length()) * step;
        if change <= LARGEST_CHANGE || !change.is_finite() {
            return Rk4.step(&self.state, step, control);
        }
        let parts = (change / LARGEST_CHANGE).ceil().min(MOST_PIECES);
        (0..parts as usize).try_fold(self.state, |state, _| Rk4.step(&state, step / parts, control))
    }

    /// Removes motions that are impossible on the ground: slipping sideways, leaning, tilting.
    fn constrain(&mut self) {
        match self.kind {
            VehicleKind::Bicycle => roll(&mut self.state),
            VehicleKind::Drive => level(&mut self.state),
            VehicleKind::Fly => {}
        }
    }

    /// Removes the excess of celerity into the wall. A car slides along the wall. A bicycle's frame has to be turned
    /// first, and it turns while the bicycle rolls.
    fn keep_clear(&mut self, wall: Option<Wall>, own_s: f64) {
        let celerity = self.state.celerity.vector();
        let wall = wall.filter(|wall| walls::excess(wall, celerity, self.light_speed) > 0.0);
        self.blocked = wall.is_some();
        let Some(wall) = wall else { return };
        let slid = walls::slid(&wall, celerity, self.light_speed);
        let kept = if self.kind == VehicleKind::Bicycle {
            let rolled_m = self.light_speed.metres_per_own_second(slid.length()) * own_s;
            let angle_rad = (rolled_m / walls::DEFLECTION_RADIUS_M).min(walls::FASTEST_DEFLECTION_RAD_S * own_s);
            let motion = turned_towards(celerity, slid, angle_rad);
            self.state.orientation = upright(if self.forward() < 0.0 { -motion } else { motion });
            motion * walls::limited_along(&wall, motion, slid.length(), self.light_speed)
        } else {
            slid
        };
        self.state.celerity = Celerity::new(kept).unwrap_or(Celerity::ZERO);
    }

    /// Celerity along the nose.
    fn forward(&self) -> f64 {
        self.state.celerity.vector().dot(self.state.orientation * DVec3::NEG_Z)
    }

    /// Unit vector of the motion, or of the nose at rest or on a slope steeper than any road; and true if the motion
    /// is backward.
    fn road_direction(&self) -> (DVec3, bool) {
        let backward = self.forward() < 0.0;
        let nose = heading(self.state.orientation);
        let motion = self.state.celerity.direction().unwrap_or(nose);
        (if motion.y.abs() < STEEPEST_ROAD { motion } else { nose }, backward)
    }

    /// Distance covered in a time at the present celerity, metres of road.
    fn distance_m(&self, own_s: f64) -> f64 {
        self.light_speed.metres(own_s) * self.state.celerity.magnitude()
    }

    fn eye_offset(&self) -> DVec3 {
        if self.kind == VehicleKind::Fly { DVec3::ZERO } else { DVec3::from_array(self.settings.eye_m) }
    }

    fn tell(&mut self, notice: Notice) {
        if !self.notices.contains(&notice) {
            self.notices.push(notice);
        }
    }
}

/// Unit vector along `from`, turned towards `to` by `angle_rad`, but not beyond it.
fn turned_towards(from: DVec3, to: DVec3, angle_rad: f64) -> DVec3 {
    let from = from.normalize_or_zero();
    let Some(to) = to.try_normalize() else { return from };
    let Some(across) = (to - from * from.dot(to)).try_normalize() else { return from };
    let angle_rad = angle_rad.min(from.angle_between(to));
    from * libm::cos(angle_rad) + across * libm::sin(angle_rad)
}
