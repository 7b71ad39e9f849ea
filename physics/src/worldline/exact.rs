//! The exact step for thrust and turn rate that are constant in the pilot's own axes.
//!
//! The motion in the frame that moves along at the start of the step is exp(τ G) for a constant generator G of boosts
//! and rotations: four-velocity and displacement are its Taylor series on the time axis, and the change of orientation
//! is the unitary part of the spinor exp(τ (a − iω)·σ/2). Boosting the three by the tetrad at the start gives the end.
//! Nothing is approximated but by rounding, at every γ; and rounding is at 106 bits, because a circle multiplies an
//! error of celerity or orientation by γ².

use glam::DQuat;

use super::control::{Control, finite_thrust};
use super::error::WorldlineError;
use super::integrator::Integrator;
use super::rotation::Rotation;
use super::state::{Increment, LowParts, WorldlineState};
use super::thrust::Thrust;
use crate::double_double::{DoubleDouble, DoubleDoubleVec3};

/// Integrator that is exact for constant thrust and turn rate; a control that varies is taken at the middle of the
/// step (second order).
///
/// *Accuracy:* rapidity to 3e-14 over 10 units (`tests/physics/worldline.rs`); celerity, place and orientation to
/// 6e-14 after a thousand turns at γ = 1000 (`rapidity measure --extremes`).
#[derive(Clone, Copy, Debug, Default)]
pub struct Exact;

/// The longest span of one series, in units of 1/(|a| + |ω|).
const LONGEST_SPAN: f64 = 0.6;

/// The most spans a step is cut into: 1e6 of them are a rapidity or a turn that no picture can follow.
const MOST_SPANS: f64 = 1e6;

impl Integrator for Exact {
    fn step(&self, state: &WorldlineState, step: f64, control: &dyn Control) -> Result<WorldlineState, WorldlineError> {
        if !step.is_finite() {
            return Err(WorldlineError::StepNotFinite { step });
        }
        let mut thrust = finite_thrust(control, state)?;
        if !control.is_constant() {
            let middle = constant_thrust(state, 0.5 * step, &thrust)?;
            thrust = finite_thrust(control, &middle)?;
        }
        constant_thrust(state, step, &thrust)
    }
}

/// The state after a step of constant thrust, taken in as many spans as the series needs to converge.
fn constant_thrust(start: &WorldlineState, step: f64, thrust: &Thrust) -> Result<WorldlineState, WorldlineError> {
    let rate = thrust.acceleration.length() + thrust.turn_rate.length();
    let spans = (step.abs() * rate / LONGEST_SPAN).ceil().max(1.0);
    if spans > MOST_SPANS || spans.is_nan() {
        return Err(WorldlineError::Overflow { proper_time: start.proper_time, step });
    }
    let mut state = *start;
    let span = step / spans;
    let motion = SpanMotion::of(thrust, span);
    for _ in 0..spans as u64 {
        state = motion.applied(&state, span)?;
    }
    Ok(state)
}

/// The motion over one span, seen from the comoving frame and in the pilot's axes at its start, to about 106 bits.
struct SpanMotion {
    /// Time dt, metres.
    time: DoubleDouble,
    /// Displacement dx, metres.
    way: DoubleDoubleVec3,
    /// Celerity v reached.
    celerity: DoubleDoubleVec3,
    /// Rotation q₂ that remains when the boost to v is taken off.
    rotation: Rotation,
}

impl SpanMotion {
    fn of(thrust: &Thrust, span: f64) -> Self {
        let (time, way, celerity) = four_velocity_series(thrust, span);
        Self { time, way, celerity, rotation: rotation(thrust, span) }
    }

    /// Boosts the motion by the tetrad B(u) R(q) of the state.
    fn applied(&self, state: &WorldlineState, span: f64) -> Result<WorldlineState, WorldlineError> {
        let one = DoubleDouble::from(1.0);
        let gamma_of = |u: DoubleDoubleVec3| (one + u.dot(u)).sqrt();
        let (u, orientation) = (state.precise_celerity(), state.precise_orientation());
        let v = orientation.turn(self.celerity);
        let dx = orientation.turn(self.way);
        let (gamma, gamma_v) = (gamma_of(u), gamma_of(v));
        let (inverse, inverse_v) = (one / (one + gamma), one / (one + gamma_v));
        // |v| is below 1, so that nothing cancels in the Wigner rotation (see `composition`).
        let (t1, t2) = (u.scaled(inverse), v.scaled(inverse_v));
        let wigner = Rotation { vector: t2.precise_cross(t1), scalar: one + t1.dot(t2) }.normalised();
        let celerity = u.scaled(gamma_v + u.dot(v) * inverse) + v;
        let (orientation, orientation_rest) = wigner.after(orientation).after(self.rotation).split();
        let increment = Increment {
            ct: (gamma * self.time + u.dot(dx)).rounded(),
            position: (dx + u.scaled(self.time + u.dot(dx) * inverse)).rounded(),
            celerity: celerity.high,
            orientation: DQuat::from_vec4(orientation),
            rest: LowParts { celerity: celerity.low, orientation: orientation_rest },
        };
        state.advanced(span, &increment)
    }
}

/// Share of a sum below which a term changes no digit of it.
const NEGLIGIBLE: f64 = 0.25 * f64::EPSILON * f64::EPSILON;

/// The Taylor series of exp(τ G) (1, 0) and of its integral: displacement in time and space, and celerity, in the
/// comoving frame.
fn four_velocity_series(thrust: &Thrust, span: f64) -> (DoubleDouble, DoubleDoubleVec3, DoubleDoubleVec3) {
    /// Number of terms after which 0.6ⁿ/n! has fallen below rounding.
    const MOST_TERMS: u32 = 32;
    let acceleration = DoubleDoubleVec3::from(thrust.acceleration);
    let turn_rate = DoubleDoubleVec3::from(thrust.turn_rate);
    let over = |order: u32| DoubleDouble::from(span) / DoubleDouble::from(f64::from(order));
    let (mut term_t, mut term_r) = (DoubleDouble::from(1.0), DoubleDoubleVec3::default());
    let mut velocity = DoubleDoubleVec3::default();
    let (mut time, mut way) = (DoubleDouble::from(span), DoubleDoubleVec3::default());
    let mut factor = over(1);
    for order in 1..=MOST_TERMS {
        (term_t, term_r) = (
            factor * acceleration.dot(term_r),
            (acceleration.scaled(term_t) + turn_rate.precise_cross(term_r)).scaled(factor),
        );
        factor = over(order + 1);
        velocity = velocity + term_r;
        time = time + factor * term_t;
        way = way + term_r.scaled(factor);
        let largest = term_t.high.abs().max(term_r.high.abs().max_element());
        if largest <= NEGLIGIBLE * velocity.high.abs().max_element() {
            break;
        }
    }
    (time, way, velocity)
}

/// The rotation in exp(z·σ) = cosh s + (sinh s)/s z·σ, z = τ (a − iω)/2, s² = z·z.
///
/// A boost times a rotation (w, n) has the real scalar and the imaginary vector in proportion w : −n. Both entire
/// functions of s² are summed as series, so that s = 0 is nothing special.
fn rotation(thrust: &Thrust, span: f64) -> Rotation {
    type Complex = (DoubleDouble, DoubleDouble);
    const MOST_TERMS: u32 = 18;
    let half = DoubleDouble::from(0.5 * span);
    let a = DoubleDoubleVec3::from(thrust.acceleration).scaled(half);
    let omega = DoubleDoubleVec3::from(thrust.turn_rate).scaled(half);
    // s² as a complex number.
    let (real, imaginary) = (a.dot(a) - omega.dot(omega), a.dot(omega) * DoubleDouble::from(-2.0));
    let one: Complex = (DoubleDouble::from(1.0), DoubleDouble::default());
    let next = |(x, y): Complex, divisor: f64| -> Complex {
        let inverse = DoubleDouble::from(1.0) / DoubleDouble::from(divisor);
        ((x * real - y * imaginary) * inverse, (x * imaginary + y * real) * inverse)
    };
    let sum = |a: Complex, b: Complex| -> Complex { (a.0 + b.0, a.1 + b.1) };
    let (mut cosh, mut cosh_term, mut sinhc, mut sinhc_term) = (one, one, one, one);
    for order in 1..=MOST_TERMS {
        let twice = 2.0 * f64::from(order);
        cosh_term = next(cosh_term, twice * (twice - 1.0));
        sinhc_term = next(sinhc_term, twice * (twice + 1.0));
        cosh = sum(cosh, cosh_term);
        sinhc = sum(sinhc, sinhc_term);
        if cosh_term.0.high.abs().max(cosh_term.1.high.abs()) <= NEGLIGIBLE {
            break;
        }
    }
    // −Im(sinhc (a − iω)) = Re(sinhc) ω − Im(sinhc) a.
    Rotation { vector: omega.scaled(sinhc.0) - a.scaled(sinhc.1), scalar: cosh.0 }.normalised()
}
