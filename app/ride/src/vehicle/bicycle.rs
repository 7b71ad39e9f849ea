//! The bicycle (B 5.6.1): what pedals, lever and handlebar do to the worldline.
//!
//! The commanded celerity is the speed of the pedalled wheel, road by the rider's own clock, over c. The wheel may turn as fast as anybody can pedal:
//! dx/dτ has no limit, dx/dt stays below c. A heavy bicycle takes the command up with one time constant and gives way to a slower one with another,
//! since it rolls on. With u the celerity forward, w the commanded one and v = u c,
//!
//! - pedals: du/dτ = (w − u)/T, the felt acceleration of which is (du/dτ)/γ;
//! - brake: a felt deceleration, in two stages: dη/dτ = −b(lever)/c, which stops any celerity in finite time;
//! - handlebar: dψ/dτ = v tan δ / L. The bend's radius is L/tan δ metres of the world at any speed;
//! - road: the pitch follows the ground ([`super::ground`]).
//!
//! A motion that turns at Ω (about pilot's up and right) is felt as the acceleration a = Ω × u, and as a turn Ω − (a × u)/(1 + γ) = γ Ω against
//! gyroscopes, Thomas precession included. These are fed to the integrator. Wheels roll where the frame points: [`roll`] takes away what rounding adds across.

use glam::DVec3;
use physics::Celerity;
use physics::worldline::{Control, State, Thrust};

use super::ground::{Course, upright};
use super::settings::BicycleSettings;
use super::wishes::Wishes;
use super::world::World;

/// Below this speed a held brake decelerates in proportion to it, as a tyre gives way before it slips, m/s. The bicycle comes to rest smoothly.
const STICTION_M_S: f64 = 0.15;
/// What slows a bicycle that nobody pedals down to a stop at last, m/s².
const ROLLING_M_S2: f64 = 0.05;
/// No front wheel turns a bicycle faster than this, radians per second: it slips.
const FASTEST_YAW_RAD_S: f64 = 20.0;
/// Against a wall the front wheel is walked round at this speed at most, m/s.
const WALK_M_S: f64 = 1.5;

/// The controls of a bicycle during one step.
pub(super) struct Bicycle<'a> {
    settings: &'a BicycleSettings,
    world: World,
    wishes: &'a Wishes,
    /// Where the ground leads.
    course: Course,
    /// Whether a wall keeps it from going where it points.
    blocked: bool,
    /// Time constant of the answer to the pedals. It is chosen once a step: a kink within would cost the integrator its order.
    response_s: f64,
}

impl<'a> Bicycle<'a> {
    /// The controls of a step that begins with the forward celerity `u`.
    pub(super) fn new(
        settings: &'a BicycleSettings,
        world: World,
        wishes: &'a Wishes,
        course: Course,
        blocked: bool,
        u: f64,
    ) -> Self {
        let wanted = world.celerity(wishes.wheel_speed_m_s);
        let driving = (wanted - u) * wanted > 0.0;
        let response_s = if driving { settings.pedal_response_s } else { settings.coast_response_s };
        Self { settings, world, wishes, course, blocked, response_s }
    }

    /// Forward proper acceleration in rapidity per second of own time, at the forward celerity `u`.
    fn forward_per_s(&self, u: f64) -> f64 {
        let gamma = u.hypot(1.0);
        let lever = self.wishes.brake;
        // Nobody pedals against the second stage.
        let pedals = self.pedals_per_s(u) * (1.0 - 2.0 * lever).max(0.0);
        let rolling = if self.wishes.wheel_speed_m_s == 0.0 { ROLLING_M_S2 } else { 0.0 };
        let deceleration = self.world.celerity(brake_m_s2(self.settings, lever) + rolling);
        let stiction = self.world.celerity(STICTION_M_S);
        pedals / gamma - deceleration * (u / stiction).clamp(-1.0, 1.0)
    }

    /// du/dτ that the pedals want.
    fn pedals_per_s(&self, u: f64) -> f64 {
        (self.world.celerity(self.wishes.wheel_speed_m_s) - u) / self.response_s
    }

    /// dψ/dτ in radians per second.
    fn yaw_rad_s(&self, u: f64) -> f64 {
        let speed = self.world.metres_per_own_second(u);
        let wheel = self.wishes.wheel_speed_m_s;
        // One who stands against a wall lifts the front wheel round.
        let speed = if self.blocked && wheel.abs() > speed.abs() { wheel.clamp(-WALK_M_S, WALK_M_S) } else { speed };
        let rate = speed * self.wishes.steer_rad.tan() / self.settings.wheelbase_m;
        rate.clamp(-FASTEST_YAW_RAD_S, FASTEST_YAW_RAD_S)
    }

    /// What the ergometer's brake should do, 0 to 1: the lever, the wall, and the inertia of what is being accelerated.
    pub(super) fn resistance(&self, u: f64) -> f64 {
        /// A wheel that turns freely on the level.
        const ROLLING: f64 = 0.05;
        /// A wheel that turns against a wall.
        const WALL: f64 = 0.6;
        /// Acceleration that is felt as a full load, m/s².
        const HEAVY_M_S2: f64 = 8.0;
        let lever = brake_m_s2(self.settings, self.wishes.brake) / self.settings.stop_m_s2;
        let inertia = self.world.metres_per_own_second(self.pedals_per_s(u) / u.hypot(1.0)).abs() / HEAVY_M_S2;
        let pedalled = if self.wishes.wheel_speed_m_s.abs() > self.world.metres_per_own_second(u).abs() {
            if self.blocked { WALL } else { inertia.min(WALL) }
        } else {
            0.0
        };
        (ROLLING + pedalled).max(lever).min(1.0)
    }
}

impl Control for Bicycle<'_> {
    fn thrust(&self, state: &State) -> Thrust {
        let nose = state.orientation * DVec3::NEG_Z;
        let u = state.orientation.inverse() * state.celerity.vector();
        let speed = self.world.metres_per_own_second(u.z.abs());
        let pitch = self.course.pitch_rate_rad_s(nose.y.clamp(-1.0, 1.0).asin(), speed);
        let turn = DVec3::new(pitch, self.yaw_rad_s(-u.z), 0.0);
        // Bend the way with the frame, about the same axis and by the same celerity, or at large γ the one would run away from the other.
        let acceleration = DVec3::NEG_Z * self.forward_per_s(-u.z) + turn.cross(u);
        let thomas = acceleration.cross(u) / (1.0 + state.celerity.gamma());
        let c = self.world.speed_of_light_m_s();
        Thrust { acceleration: acceleration / c, turn_rate: (turn - thomas) / c }
    }
}

/// Felt deceleration of the two-stage brake: a drag up to half the lever's way, a firm stop beyond, m/s².
fn brake_m_s2(settings: &BicycleSettings, lever: f64) -> f64 {
    let first = (2.0 * lever).min(1.0);
    let second = (2.0 * lever - 1.0).max(0.0);
    settings.drag_m_s2 * first + (settings.stop_m_s2 - settings.drag_m_s2) * second
}

/// Puts the celerity along the nose and takes away roll: wheels do not slip sideways, and the rider keeps upright.
pub(super) fn roll(state: &mut State) {
    /// A lean that rounding makes.
    const ROUNDING: f64 = 1e-14;
    let nose = state.orientation * DVec3::NEG_Z;
    let right = state.orientation * DVec3::X;
    if right.y.abs() > ROUNDING {
        state.orientation = upright(nose);
    }
    state.celerity = Celerity::new(nose * state.celerity.vector().dot(nose)).unwrap_or(state.celerity);
}
