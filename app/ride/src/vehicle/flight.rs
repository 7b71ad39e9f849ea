//! Driving and flying (W 6.2, 6.3): three proper accelerations, roll, rudder and brake.
//!
//! The stick's three shifts are proper accelerations along the pilot's right, up and backward axes. Its twist rolls
//! about the axis of motion. The nose is turned to face the motion by lateral acceleration, or held by gyroscopes
//! ([`Transport`]). For devices that cannot shift sideways, nose up and nose left steer like a rudder: a turn Ω of
//! the motion is the acceleration Ω × u, limited to full thrust. Near rest the nose then turns on the spot, and at
//! high celerity the motion bends slowly. Driving is flying without vertical thrust, level, and on the ground where
//! there is any.

use glam::DVec3;
use physics::worldline::{Control, FacingMotion, Thrust, Transport, WorldlineState};

use super::ground::{GroundCourse, heading, upright};
use super::light_speed::LightSpeed;
use super::safe_controls::SafeControls;
use super::settings::{FlightSettings, Nose};

/// Celerity below which the nose no longer follows the motion.
const SOFTENING: f64 = 0.05;
/// Decay rate of the angle between nose and motion, per second of own time.
const ALIGNMENT_PER_S: f64 = 2.0;
/// Deceleration of a pulled brake, in full thrusts.
const BRAKE_THRUSTS: f64 = 2.0;
/// Celerity below which the brake fades, so that the vehicle comes to rest smoothly.
const STICTION: f64 = 0.02;

/// Controls of a driven or flown vehicle during one step.
pub(super) struct FlightControl<'a> {
    settings: &'a FlightSettings,
    light_speed: LightSpeed,
    controls: &'a SafeControls,
    transport: Transport,
    /// Course along the ground ahead; `None` in flight.
    course: Option<GroundCourse>,
}

impl<'a> FlightControl<'a> {
    pub(super) fn new(
        settings: &'a FlightSettings,
        light_speed: LightSpeed,
        controls: &'a SafeControls,
        course: Option<GroundCourse>,
    ) -> Self {
        let alignment = ALIGNMENT_PER_S / light_speed.speed_of_light_m_s();
        let transport = match settings.nose {
            Nose::FacesMotion => Transport::FacingMotion(FacingMotion { softening: SOFTENING, alignment }),
            Nose::Gyroscopic => Transport::Gyroscopic,
        };
        Self { settings, light_speed, controls, transport, course }
    }

    /// Acceleration that turns the motion with the rudder, pilot's axes, per second of own time.
    fn rudder_per_s(&self, rudder: DVec3, u: DVec3) -> DVec3 {
        let full = self.settings.thrust_per_s;
        let wanted = rudder.cross(u);
        wanted * (full / libm::hypot(full, wanted.length()))
    }

    /// Acceleration that keeps a driven vehicle on the ground, world axes, per second of own time.
    fn ground_per_s(&self, course: &GroundCourse, state: &WorldlineState) -> DVec3 {
        let Some(direction) = state.celerity.direction() else { return DVec3::ZERO };
        let u = state.celerity.magnitude();
        let slope = libm::asin(direction.y.clamp(-1.0, 1.0));
        let rate = course.pitch_rate_rad_s(slope, self.light_speed.metres_per_own_second(u));
        (DVec3::Y - direction * direction.y) * (rate * u)
    }
}

impl Control for FlightControl<'_> {
    fn thrust(&self, state: &WorldlineState) -> Thrust {
        let c = self.light_speed.speed_of_light_m_s();
        let pilot_from_world = state.orientation.inverse();
        let u = pilot_from_world * state.celerity.vector();
        let turn = self.controls.turn * self.settings.turn_rad_s;
        let mut thrust = self.controls.thrust * self.settings.thrust_per_s;
        if self.course.is_some() {
            thrust.y = 0.0;
        }

        // Brake against the motion.
        thrust -= u * (BRAKE_THRUSTS * self.settings.thrust_per_s * self.controls.brake / u.length().max(STICTION));

        let on_the_spot = match self.settings.nose {
            Nose::Gyroscopic => turn,
            Nose::FacesMotion => {
                let rudder = DVec3 { z: 0.0, ..turn };
                thrust += self.rudder_per_s(rudder, u);
                let still = SOFTENING * SOFTENING / (SOFTENING * SOFTENING + u.length_squared());
                rudder * still + DVec3::Z * turn.z
            }
        };
        let mut thrust = self.transport.thrust(state, thrust / c);
        thrust.turn_rate += on_the_spot / c;
        if let Some(course) = &self.course {
            thrust.acceleration += pilot_from_world * self.ground_per_s(course, state) / c;
        }
        thrust
    }
}

/// Keeps a driven vehicle level, whatever the ground does.
pub(super) fn level(state: &mut WorldlineState) {
    /// Largest tilt that rounding makes; a smaller one is left alone.
    const ROUNDING: f64 = 1e-14;
    let up = state.orientation * DVec3::Y;
    if libm::hypot(up.x, up.z) > ROUNDING {
        state.orientation = upright(heading(state.orientation));
    }
}
