//! Bicycle (B 5.6.1): how pedals, lever and handlebar change the worldline.
//!
//! The commanded celerity is the speed of the pedalled wheel, in metres of road per second of the rider's own clock,
//! divided by c. The wheel may turn as fast as a person can pedal: dx/dτ has no limit, while dx/dt stays below c. A
//! heavy bicycle follows a faster command with one time constant and a slower one with another, since it rolls on.
//! With u the celerity forward, w the commanded one and v = u c,
//!
//! - pedals: du/dτ = (w − u)/T, felt as the acceleration (du/dτ)/γ;
//! - brake: a felt deceleration, in two stages: dη/dτ = −b(lever)/c, which stops any celerity in finite time;
//! - handlebar: dψ/dτ = v tan δ / L. The bend's radius is L/tan δ metres of the world at any speed;
//! - road: the pitch follows the ground ([`super::ground`]).
//!
//! A motion that turns at Ω (about the pilot's up and right axes) is felt as the acceleration a = Ω × u, and against
//! gyroscopes as the turn Ω − (a × u)/(1 + γ) = γ Ω, Thomas precession included. Both go into the integrator. The
//! wheels roll along the frame: [`roll`] removes the sideways motion that rounding adds.

use glam::DVec3;
use physics::Celerity;
use physics::worldline::{Control, Thrust, WorldlineState};

use super::ground::{GroundCourse, upright};
use super::light_speed::LightSpeed;
use super::safe_controls::SafeControls;
use super::settings::BicycleSettings;

/// Speed below which a held brake decelerates in proportion to it, as a tyre deforms before it slips, m/s. The
/// bicycle then comes to rest smoothly.
const STICTION_M_S: f64 = 0.15;
/// Deceleration that finally stops a bicycle that is not pedalled, m/s².
const ROLLING_M_S2: f64 = 0.05;
/// Fastest turn of the bicycle, radians per second. Beyond it the front wheel would slip.
const FASTEST_YAW_RAD_S: f64 = 20.0;
/// Largest speed at which the front wheel is walked round at a wall, m/s.
const WALK_M_S: f64 = 1.5;

/// Controls of a bicycle during one step.
pub(super) struct BicycleControl<'a> {
    settings: &'a BicycleSettings,
    light_speed: LightSpeed,
    controls: &'a SafeControls,
    /// Course along the ground ahead.
    course: GroundCourse,
    /// True if a wall blocks the way ahead.
    blocked: bool,
    /// Time constant of the answer to the pedals, seconds. It is chosen once per step: a change within a step would
    /// cost the integrator its order.
    response_s: f64,
}

impl<'a> BicycleControl<'a> {
    /// Creates the controls of a step that begins with the forward celerity `u`.
    pub(super) fn new(
        settings: &'a BicycleSettings,
        light_speed: LightSpeed,
        controls: &'a SafeControls,
        course: GroundCourse,
        blocked: bool,
        u: f64,
    ) -> Self {
        let wanted = light_speed.celerity(controls.wheel_speed_m_s);
        let driving = (wanted - u) * wanted > 0.0;
        let response_s = if driving { settings.pedal_response_s } else { settings.coast_response_s };
        Self { settings, light_speed, controls, course, blocked, response_s }
    }

    /// Forward proper acceleration at the forward celerity `u`, as rapidity per second of own time.
    fn forward_per_s(&self, u: f64) -> f64 {
        let gamma = libm::hypot(u, 1.0);
        let lever = self.controls.brake;
        // Pedals have no effect during the brake's second stage.
        let pedals = self.pedals_per_s(u) * (1.0 - 2.0 * lever).max(0.0);
        let rolling = if self.controls.wheel_speed_m_s == 0.0 { ROLLING_M_S2 } else { 0.0 };
        let deceleration = self.light_speed.celerity(brake_m_s2(self.settings, lever) + rolling);
        let stiction = self.light_speed.celerity(STICTION_M_S);
        pedals / gamma - deceleration * (u / stiction).clamp(-1.0, 1.0)
    }

    /// Rate du/dτ that the pedals ask for, per second.
    fn pedals_per_s(&self, u: f64) -> f64 {
        (self.light_speed.celerity(self.controls.wheel_speed_m_s) - u) / self.response_s
    }

    /// Turn rate dψ/dτ, radians per second.
    fn yaw_rad_s(&self, u: f64) -> f64 {
        let speed = self.light_speed.metres_per_own_second(u);
        let wheel = self.controls.wheel_speed_m_s;
        // A rider who stands against a wall lifts the front wheel round.
        let speed = if self.blocked && wheel.abs() > speed.abs() { wheel.clamp(-WALK_M_S, WALK_M_S) } else { speed };
        let rate = speed * libm::tan(self.controls.steer_rad) / self.settings.wheelbase_m;
        rate.clamp(-FASTEST_YAW_RAD_S, FASTEST_YAW_RAD_S)
    }

    /// Resistance for the ergometer's brake, 0 to 1: from the lever, the wall, and the inertia of an acceleration.
    pub(super) fn resistance(&self, u: f64) -> f64 {
        /// Resistance of a wheel that turns freely on level ground.
        const ROLLING: f64 = 0.05;
        /// Resistance of a wheel that turns against a wall.
        const WALL: f64 = 0.6;
        /// Acceleration that is felt as a full load, m/s².
        const HEAVY_M_S2: f64 = 8.0;
        let lever = brake_m_s2(self.settings, self.controls.brake) / self.settings.stop_m_s2;
        let inertia =
            self.light_speed.metres_per_own_second(self.pedals_per_s(u) / libm::hypot(u, 1.0)).abs() / HEAVY_M_S2;
        let pedalled = if self.controls.wheel_speed_m_s.abs() > self.light_speed.metres_per_own_second(u).abs() {
            if self.blocked { WALL } else { inertia.min(WALL) }
        } else {
            0.0
        };
        (ROLLING + pedalled).max(lever).min(1.0)
    }
}

impl Control for BicycleControl<'_> {
    fn thrust(&self, state: &WorldlineState) -> Thrust {
        let nose = state.orientation * DVec3::NEG_Z;
        let u = state.orientation.inverse() * state.celerity.vector();
        let speed = self.light_speed.metres_per_own_second(u.z.abs());
        let pitch = self.course.pitch_rate_rad_s(libm::asin(nose.y.clamp(-1.0, 1.0)), speed);
        let turn = DVec3::new(pitch, self.yaw_rad_s(-u.z), 0.0);
        // The motion is turned with the frame, about the same axis and by the same celerity. Otherwise the two would
        // drift apart at large γ.
        let acceleration = DVec3::NEG_Z * self.forward_per_s(-u.z) + turn.cross(u);
        let thomas = acceleration.cross(u) / (1.0 + state.celerity.gamma());
        let c = self.light_speed.speed_of_light_m_s();
        Thrust { acceleration: acceleration / c, turn_rate: (turn - thomas) / c }
    }
}

/// Felt deceleration of the two-stage brake, m/s²: a drag up to half the lever's travel, a firm stop beyond.
fn brake_m_s2(settings: &BicycleSettings, lever: f64) -> f64 {
    let first = (2.0 * lever).min(1.0);
    let second = (2.0 * lever - 1.0).max(0.0);
    settings.drag_m_s2 * first + (settings.stop_m_s2 - settings.drag_m_s2) * second
}

/// Puts the celerity along the nose and removes roll: wheels do not slip sideways, and the rider stays upright.
pub(super) fn roll(state: &mut WorldlineState) {
    /// Largest lean that rounding makes; a smaller one is left alone.
    const ROUNDING: f64 = 1e-14;
    let nose = state.orientation * DVec3::NEG_Z;
    let right = state.orientation * DVec3::X;
    if right.y.abs() > ROUNDING {
        state.orientation = upright(nose);
    }
    state.celerity = Celerity::new(nose * state.celerity.vector().dot(nose)).unwrap_or(state.celerity);
}
