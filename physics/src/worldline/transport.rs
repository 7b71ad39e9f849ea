//! Transport of the pilot's axes: like gyroscopes, or turned so that the front window faces the motion.

use glam::DVec3;

use super::state::WorldlineState;
use super::thrust::Thrust;

/// The pilot's forward direction, in the pilot's axes.
const NOSE: DVec3 = DVec3::NEG_Z;

/// Rule by which the vehicle turns of itself under a thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transport {
    /// Fermi–Walker transport: no turn against gyroscopes. Against the world the axes precess (Thomas).
    Gyroscopic,
    /// Transport with the nose on the direction of motion (W 6.2).
    FacingMotion(FacingMotion),
}

/// Parameters of the transport with the nose on the direction of motion, or right against it in reverse.
///
/// The nose is exactly there while |u| is well above `softening`. Near rest the direction of motion has no meaning and
/// may turn at any rate: the turn fades to nothing, and the angle that is left when speed returns decays at the rate
/// `alignment`, towards whichever end of the vehicle is nearer. The turn rate is thus a smooth function of the state
/// everywhere: a stop, a start and a reversal turn nothing suddenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacingMotion {
    /// Celerity below which the nose no longer follows, above zero. The turn rate stays below |a| / (2 softening) +
    /// alignment / 2.
    pub softening: f64,
    /// Rate at which a left-over angle decays, radians per radian and metre of proper time. 0 leaves it.
    pub alignment: f64,
}

impl Transport {
    /// The thrust for this acceleration (pilot's axes), with the turn rate that this transport wants in this state.
    pub fn thrust(&self, state: &WorldlineState, acceleration: DVec3) -> Thrust {
        let turn_rate = match self {
            Self::Gyroscopic => DVec3::ZERO,
            Self::FacingMotion(facing) => facing.turn_rate(state, acceleration),
        };
        Thrust { acceleration, turn_rate }
    }
}

impl FacingMotion {
    /// Turn rate in the pilot's axes, radians per metre of proper time.
    ///
    /// *Equation:* in the axes of the pure boost the direction of motion e turns at e × a/w. Less the Thomas rate (a ×
    /// u)/(1 + γ), which the axes turn by in any case, that is γ (u × a)/w². Softened, w² + s² stands for w²; the
    /// nose f is drawn to ±e by (f × u)(f·u)/(w² + s²).
    pub fn turn_rate(&self, state: &WorldlineState, acceleration: DVec3) -> DVec3 {
        let (u, gamma) = (state.celerity.vector(), state.celerity.gamma());
        let acceleration = state.orientation * acceleration;
        let nose = state.orientation * NOSE;
        let following = gamma * u.cross(acceleration);
        let aligning = self.alignment * nose.dot(u) * nose.cross(u);
        let softened = u.length_squared() + self.softening * self.softening;
        state.orientation.inverse() * ((following + aligning) / softened)
    }
}
