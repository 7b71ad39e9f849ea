//! Bicycle, car or spaceship, at the present end of its worldline.

use glam::DVec3;
use input::{Controls, HeadState, VehicleKind};
use physics::Celerity;
use physics::worldline::{Thrust, WorldlineState};
use scene::Surroundings;
use view::Gaze;

use super::bicycle::roll;
use super::flight::level;
use super::ground::{heading, placed, upright};
use super::light_speed::LightSpeed;
use super::notice::Notice;
use super::odometer::Odometer;
use super::safe_controls::SafeControls;
use super::settings::{SettingsError, VehicleSettings};

/// Longest piece that a step is cut into, seconds of own time.
const LONGEST_STEP_S: f64 = 1.0 / 240.0;
/// Largest number of pieces of one step.
const MOST_PIECES: f64 = 64.0;

/// Bicycle, car or spaceship, at the present end of its worldline.
#[derive(Clone, Debug)]
pub struct Vehicle {
    pub(super) light_speed: LightSpeed,
    pub(super) kind: VehicleKind,
    pub(super) settings: VehicleSettings,
    pub(super) state: WorldlineState,
    pub(super) odometer: Odometer,
    /// True if a wall blocks the way ahead.
    pub(super) blocked: bool,
    /// True if the ground ends ahead.
    pub(super) at_edge: bool,
    pub(super) resistance: f64,
    /// Acceleration and turn at the end of the last step.
    pub(super) thrust: Thrust,
    pub(super) notices: Vec<Notice>,
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
            at_edge: false,
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

    /// Slope of the road along a bicycle's nose, rise over run, positive uphill; zero for what is not pedalled.
    pub fn slope(&self) -> f64 {
        let nose = self.state.orientation * DVec3::NEG_Z;
        let run = libm::hypot(nose.x, nose.z).max(f64::MIN_POSITIVE);
        if self.kind == VehicleKind::Bicycle { nose.y / run } else { 0.0 }
    }

    /// View of the rider, driver or pilot, whose eye rests in the vehicle, turns with it, and looks along the nose.
    pub fn gaze(&self) -> Gaze {
        let eye = self.state.aboard(self.eye_offset(), Celerity::ZERO, &self.thrust);
        Gaze { observer: eye.observer(), observer_from_eye: eye.orientation }
    }

    /// Changes the speed of light. Celerity and place stay unchanged, and so do the times of all clocks in seconds.
    pub fn set_light_speed(&mut self, light_speed: LightSpeed) {
        if self.settings.keeps_seconds {
            let longer = light_speed.speed_of_light_m_s() / self.light_speed.speed_of_light_m_s();
            (self.state.ct, self.state.proper_time) = (self.state.ct * longer, self.state.proper_time * longer);
        }
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

    /// Puts the vehicle at rest at a point on the ground, world axes, metres, with its nose along `look`; in flight
    /// the eye is above the point as a rider's would be. Its clocks run on.
    pub fn jump(&mut self, position: DVec3, look: DVec3, surroundings: &dyn Surroundings) {
        let level = DVec3 { y: 0.0, ..look };
        let flies = self.kind == VehicleKind::Fly;
        self.state.position = if flies { position + DVec3::from_array(self.settings.eye_m) } else { position };
        self.state.orientation = upright(level.normalize_or(self.heading()));
        self.state.celerity = Celerity::ZERO;
        self.thrust = Thrust::default();
        self.settle(surroundings);
    }

    /// Puts a bicycle or a car upright on the ground.
    pub fn settle(&mut self, surroundings: &dyn Surroundings) {
        (self.blocked, self.at_edge) = (false, false);
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

    /// Removes motions that are impossible on the ground: slipping sideways, leaning, tilting.
    pub(super) fn constrain(&mut self) {
        match self.kind {
            VehicleKind::Bicycle => roll(&mut self.state),
            VehicleKind::Drive => level(&mut self.state),
            VehicleKind::Fly => {}
        }
    }

    fn eye_offset(&self) -> DVec3 {
        if self.kind == VehicleKind::Fly { DVec3::ZERO } else { DVec3::from_array(self.settings.eye_m) }
    }

    pub(super) fn tell(&mut self, notice: Notice) {
        if !self.notices.contains(&notice) {
            self.notices.push(notice);
        }
    }
}
