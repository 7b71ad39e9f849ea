//! Journeys of extreme speed, step and length, against one matrix exponential.
//!
//! A step is a time on the vehicle's clock in a world whose light travels `LIGHT_M_PER_S` in a second: slow enough
//! for ordinary thrust to be relativistic. Unless a row says otherwise, the integrator is the exact one, so that the
//! errors are those of rounding and not of a method's order.

use std::f64::consts::TAU;

use exact_reference::random::direction;
use exact_reference::real::{Real, RealVec, gamma, real, relative, to_f64};
use glam::{DQuat, DVec3};
use physics::worldline::{Exact, Integrator, Rk4, Thrust, WorldlineError, WorldlineState};
use physics::{Celerity, CelerityError, Event};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use thiserror::Error;

use super::motion::Motion;
use super::row::{ExtremesRow, RK4_LIMIT, Worst};

/// Speed of light, metres per second.
const LIGHT_M_PER_S: f64 = 10.0;
/// Ordinary thrust, m/s².
const THRUST_M_PER_S2: f64 = 9.81;
/// Rate of the simulation, steps per second.
const STEPS_PER_S: f64 = 240.0;

const RAPIDITY: &str = "rapidity";
const CELERITY: &str = "celerity, share of γ";
const PLACE: &str = "place, share of the way of light";
const CLOCK: &str = "the world's clock, share";
const OWN_CLOCK: &str = "its own clock, share";
const ORIENTATION: &str = "orientation, rad";
const MASS_SHELL: &str = "u², share";

/// Lengths of the journeys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lengths {
    /// Number of steps of coasting.
    pub coasting: u64,
    /// Number of turns of the circle.
    pub turns: u32,
    /// Number of reversals of the thrust.
    pub reversals: u32,
    /// Number of random starts of each kind.
    pub cases: u32,
    /// Largest number of steps of one size.
    pub steps: u64,
}

/// Reason for which a journey did not begin or end.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum Refused {
    /// A step that was refused.
    #[error(transparent)]
    Step(#[from] WorldlineError),
    /// A start too fast.
    #[error(transparent)]
    Speed(#[from] CelerityError),
}

/// Thrust in units of 1/m.
fn thrust_per_m() -> f64 {
    THRUST_M_PER_S2 / (LIGHT_M_PER_S * LIGHT_M_PER_S)
}

/// Rows of all journeys but [`coasting`].
///
/// # Errors
///
/// [`Refused`] if a step or a start is refused.
pub fn rows(lengths: Lengths) -> Result<Vec<ExtremesRow>, Refused> {
    let mut rows = Vec::new();
    rows.extend(resting(lengths.steps)?);
    for step_s in [1e-6, 1e-4, 1e-2, 1.0, 10.0] {
        rows.extend(steps_of(step_s, lengths.steps)?);
    }
    rows.extend(steps_of_a_ride()?);
    rows.extend(any_speed(lengths.cases)?);
    rows.extend(reversals(lengths.reversals)?);
    rows.extend(circle(lengths.turns)?);
    Ok(rows)
}

/// Errors of a journey that ought to end in `exact`.
fn errors(start: &WorldlineState, end: &WorldlineState, exact: &Motion) -> [(&'static str, f64); 5] {
    let (u, exact_u) = (end.celerity, exact.celerity());
    let exact_gamma = gamma(&exact_u);
    let rapidity = (&exact_gamma + exact_u.length()).ln();
    let way = exact.ct() - real(start.ct);
    let share =
        |computed: DVec3, exact: &RealVec, of: &Real| to_f64(&((&RealVec::new(computed) - exact).length() / of));
    [
        (RAPIDITY, to_f64(&(real(u.rapidity()) - rapidity)).abs()),
        (CELERITY, share(u.vector(), &exact_u, &exact_gamma)),
        (CLOCK, to_f64(&((real(end.ct) - exact.ct()) / &way)).abs()),
        (PLACE, share(end.position, &exact.position(), &way)),
        (ORIENTATION, exact.turn_from(end.orientation)),
    ]
}

/// State after `count` equal steps.
fn steps(
    integrator: &dyn Integrator,
    start: &WorldlineState,
    step: f64,
    count: u64,
    thrust: &Thrust,
) -> Result<WorldlineState, WorldlineError> {
    (0..count).try_fold(*start, |state, _| integrator.step(&state, step, thrust))
}

/// Errors at rest, where nothing changes but the clocks.
fn resting(count: u64) -> Result<Vec<ExtremesRow>, Refused> {
    let mut worst = Worst::new(format!("resting, {} steps, exact step and RK4", sized(count)));
    let step = LIGHT_M_PER_S / STEPS_PER_S;
    for integrator in [&Exact as &dyn Integrator, &Rk4] {
        let place = DVec3::new(1e9, 1.6, -0.1);
        let start =
            WorldlineState::new(Event { ct: 0.0, position: place }, Celerity::ZERO, DQuat::from_rotation_y(0.3));
        let end = steps(integrator, &start, step, count, &Thrust::default())?;
        let exact = real(step) * real(count as f64);
        worst.meet([
            ("moved, m", end.position.distance(start.position)),
            ("celerity", end.celerity.magnitude()),
            ("turned, rad", Motion::at(&start).turn_from(end.orientation)),
            (CLOCK, relative(end.ct, &exact)),
            (OWN_CLOCK, relative(end.proper_time, &exact)),
        ]);
    }
    Ok(worst.rows())
}

/// Errors of coasting by the default integrator, with every step taken.
///
/// # Errors
///
/// [`Refused`] if a step or a start is refused.
pub fn coasting(count: u64) -> Result<Vec<ExtremesRow>, Refused> {
    let mut worst = Worst::new(format!("coasting at γ = 1000, {} steps of 1/240 s, all taken, RK4", sized(count)));
    let step = LIGHT_M_PER_S / STEPS_PER_S;
    let celerity = Celerity::new(DVec3::new(999.9, 12.3, 1e-3))?;
    let event = Event { ct: 0.1, position: DVec3::new(0.7, -0.3, 0.1) };
    let start = WorldlineState::new(event, celerity, DQuat::from_rotation_y(0.3));
    let end = steps(&Rk4, &start, step, count, &Thrust::default())?;

    let tau = real(step) * real(count as f64);
    let u = RealVec::new(celerity.vector());
    let way = &u * &tau;
    let place = &RealVec::new(event.position) + &way;
    let end_u = RealVec::new(end.celerity.vector());
    worst.meet([
        (MASS_SHELL, to_f64(&(end_u.dot(&end_u) / u.dot(&u) - real(1.0))).abs()),
        (OWN_CLOCK, relative(end.proper_time, &tau)),
        (CLOCK, relative(end.ct, &(real(event.ct) + &tau * gamma(&u)))),
        (PLACE, to_f64(&((&RealVec::new(end.position) - &place).length() / way.length()))),
        (ORIENTATION, Motion::at(&start).turn_from(end.orientation)),
    ]);
    Ok(worst.rows())
}

/// Errors of ten seconds of thrust and turn in steps of one size, but at most `most` steps.
fn steps_of(step_s: f64, most: u64) -> Result<Vec<ExtremesRow>, Refused> {
    const JOURNEY_S: f64 = 10.0;
    let count = ((JOURNEY_S / step_s).round() as u64).min(most);
    let mut worst = Worst::new(format!("thrust of 1 g and turns, {} steps of {step_s:e} s, exact step", sized(count)));
    let step = step_s * LIGHT_M_PER_S;
    let straight = Thrust { acceleration: DVec3::new(0.0, 0.0, -thrust_per_m()), turn_rate: DVec3::ZERO };
    let turning = Thrust { turn_rate: DVec3::new(0.02, -0.05, 0.01), ..straight };
    for thrust in [straight, turning] {
        let start = WorldlineState::default();
        let end = steps(&Exact, &start, step, count, &thrust)?;
        let tau = real(step) * real(count as f64);
        let exact = Motion::at(&start).then(&Motion::under(&thrust, &tau));
        worst.meet(errors(&start, &end, &exact));
    }
    Ok(worst.rows())
}

/// Errors of ten seconds of thrust and turn by the default integrator, in the steps of a ride.
fn steps_of_a_ride() -> Result<Vec<ExtremesRow>, Refused> {
    const STEPS: u64 = 2400;
    let mut worst = Worst::within(RK4_LIMIT, "thrust of 1 g and turns, 2400 steps of 1/240 s, RK4");
    let step = LIGHT_M_PER_S / STEPS_PER_S;
    let straight = Thrust { acceleration: DVec3::new(0.0, 0.0, -thrust_per_m()), turn_rate: DVec3::ZERO };
    let turning = Thrust { turn_rate: DVec3::new(0.02, -0.05, 0.01), ..straight };
    for thrust in [straight, turning] {
        let start = WorldlineState::default();
        let end = steps(&Rk4, &start, step, STEPS, &thrust)?;
        let exact = Motion::at(&start).then(&Motion::under(&thrust, &(real(step) * real(STEPS as f64))));
        worst.meet(errors(&start, &end, &exact));
    }
    Ok(worst.rows())
}

/// Errors of one step of any size from any speed.
fn any_speed(cases: u32) -> Result<Vec<ExtremesRow>, Refused> {
    let mut random = ChaCha8Rng::seed_from_u64(32);
    let mut worst = Worst::new("one exact step of 1e-6 to 10 s from γ of 1 + 1e-12 to 1e12, any thrust and turn");
    for case in 0..cases {
        let power = if case == 0 { 12.0 } else { random.random_range(-5.849..12.0) };
        let celerity = Celerity::new(direction(&mut random) * 10.0_f64.powf(power))?;
        let orientation = DQuat::from_axis_angle(direction(&mut random), random.random_range(0.0..TAU));
        let start = WorldlineState::new(Event::default(), celerity, orientation);
        let thrust =
            Thrust { acceleration: direction(&mut random) * thrust_per_m(), turn_rate: direction(&mut random) * 0.05 };
        let step = LIGHT_M_PER_S * 10.0_f64.powf(random.random_range(-6.0..1.0));
        let end = Exact.step(&start, step, &thrust)?;
        let exact = Motion::at(&start).then(&Motion::under(&thrust, &real(step)));
        worst.meet(errors(&start, &end, &exact));
    }
    Ok(worst.rows())
}

/// Errors of a thrust that is reversed every second.
fn reversals(count: u32) -> Result<Vec<ExtremesRow>, Refused> {
    const LEG_STEPS: u64 = 240;
    let mut worst =
        Worst::new(format!("{} reversals of a thrust of 30 m/s², a second each, exact step", sized(u64::from(count))));
    let step = LIGHT_M_PER_S / STEPS_PER_S;
    let forth = Thrust { acceleration: DVec3::new(0.1, 0.02, -0.28), turn_rate: DVec3::ZERO };
    let back = Thrust { acceleration: -forth.acceleration, ..forth };
    let start = WorldlineState::default();
    let mut end = start;
    let mut exact = Motion::at(&start);
    let tau = real(step) * real(LEG_STEPS as f64);
    let legs = [&forth, &back].map(|thrust| (thrust, Motion::under(thrust, &tau)));
    for reversal in 0..=count {
        let (thrust, leg) = &legs[reversal as usize % 2];
        end = steps(&Exact, &end, step, LEG_STEPS, thrust)?;
        exact = exact.then(leg);
        worst.meet(errors(&start, &end, &exact));
    }
    Ok(worst.rows())
}

/// Errors of a circle with the nose along the motion: the thrust across it, and the turn that follows it, constant in
/// the pilot's axes.
fn circle(turns: u32) -> Result<Vec<ExtremesRow>, Refused> {
    const GAMMA: f64 = 1e3;
    const STEP_S: f64 = 10.0;
    let w = (GAMMA * GAMMA - 1.0).sqrt();
    let a = thrust_per_m();
    let step = STEP_S * LIGHT_M_PER_S;
    let start = WorldlineState::new(Event::default(), Celerity::new(DVec3::new(0.0, 0.0, -w))?, DQuat::IDENTITY);
    let thrust = Thrust { acceleration: DVec3::new(a, 0.0, 0.0), turn_rate: DVec3::new(0.0, -GAMMA * a / w, 0.0) };
    let count = (f64::from(turns) * TAU * w / (a * step)).ceil() as u64;
    let mut worst =
        Worst::new(format!("circle at γ = 1000, {turns} turns, {} steps of {STEP_S} s, exact step", sized(count)));
    let end = steps(&Exact, &start, step, count, &thrust)?;
    let tau = real(step) * real(count as f64);
    let exact = Motion::at(&start).then(&Motion::under(&thrust, &tau));
    worst.meet(errors(&start, &end, &exact));
    Ok(worst.rows())
}

/// Count as text, with a power of ten if there are many zeros.
fn sized(count: u64) -> String {
    if count >= 100_000 && count.is_multiple_of(10_000) { format!("{:e}", count as f64) } else { count.to_string() }
}
