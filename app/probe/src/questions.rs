//! Questions of the probe: each reads its keys, asks the physics, and names the results.

use physics::aberration::Aberration;
use physics::colour::rgb_from_xyz;
use physics::eyes::{Eyes, eyes};
use physics::glam::{DQuat, DVec3};
use physics::stereo_perception::{StereoPerception, perceived_place};
use physics::worldline::{DormandPrince, Exact, Integrator, Rk4, State, Thrust, travel};
use physics::{Boost, Celerity, Composition, FourVector, Source, apparent, compose};
use serde_json::Value;

use ride::IntegratorKind;

use crate::error::ProbeError;
use crate::json::Node;
use crate::keys::{Keys, Place};
use crate::limits::MOST_STEPS;
use crate::results::Answer;

const QUESTIONS: &str = "one of aberration, boost, compose, apparent, eyes, worldline, perceived, colour";

/// Tolerance of an adaptive step, near the limit of f64, since the numbers are what a question is for.
const ADAPTIVE_TOLERANCE: f64 = 1e-12;

/// Answers the question in a tree.
pub(super) fn answer(question: &Node) -> Result<Value, ProbeError> {
    let question = Keys::of_line(question)?;
    let ask = question.required("ask", QUESTIONS)?;
    let answer = match ask.text(QUESTIONS)? {
        "aberration" => aberration(&question),
        "boost" => boost(&question),
        "compose" => composition(&question),
        "apparent" => apparent_position(&question),
        "eyes" => both_eyes(&question),
        "worldline" => worldline(&question),
        "perceived" => perceived_position(&question),
        "colour" => colour(&question),
        _ => Err(ask.wrong(QUESTIONS)),
    };
    answer.map(Answer::finish)
}

fn aberration(question: &Keys<'_>) -> Result<Answer, ProbeError> {
    question.only(&["ask", "celerity", "beta", "direction"])?;
    let aberration = Aberration::new(question.velocity()?);
    let (direction, doppler) = aberration.observer_from_world(question.direction("direction")?);
    Answer::default().vector("direction", direction)?.number("D", doppler)
}

fn boost(question: &Keys<'_>) -> Result<Answer, ProbeError> {
    question.only(&["ask", "celerity", "beta", "event"])?;
    let observer_from_world = Boost::observer_from_world(question.velocity()?);
    const EVENT: &str = "a list of four numbers [t, x, y, z]";
    let [t, x, y, z] = question.required("event", EVENT)?.list_of(EVENT)?;
    let event = FourVector { t: t.number()?, r: DVec3::new(x.number()?, y.number()?, z.number()?) };
    Answer::default().four_vector("event", observer_from_world.apply(event))
}

fn composition(question: &Keys<'_>) -> Result<Answer, ProbeError> {
    question.only(&["ask", "vehicle", "head"])?;
    const VELOCITY: &str = "a celerity, three numbers [x, y, z], or an object {\"beta\": [x, y, z]}";
    let vehicle = question.required("vehicle", VELOCITY)?.velocity()?;
    let head = question.required("head", VELOCITY)?.velocity()?;
    let Composition { celerity, wigner } = compose(vehicle, head);
    Answer::default().vector("celerity", celerity.vector())?.quaternion("wigner", wigner)
}

fn apparent_position(question: &Keys<'_>) -> Result<Answer, ProbeError> {
    question.only(&["ask", "observer", "source"])?;
    let observer = question.observer("observer")?;
    let source = question.source("source")?;
    let celerity = source.optional_velocity()?.unwrap_or_default();
    let source = Source { position: source.vector("position")?, celerity };
    let seen = if source.celerity == Celerity::ZERO {
        apparent::at_rest(&observer, source.position)
    } else {
        apparent::moving(&observer, &source)
    };
    Answer::default()
        .vector("position", seen.position)?
        .number("D", seen.doppler)?
        .number("emitted_at", seen.emitted_at)
}

fn both_eyes(question: &Keys<'_>) -> Result<Answer, ProbeError> {
    question.only(&["ask", "observer", "separation", "right"])?;
    let observer = question.observer("observer")?;
    const SEPARATION: &str = "a distance: a number, 0 or more";
    let separation = question.required("separation", SEPARATION)?;
    let separation = separation.number_that(|separation| separation >= 0.0, SEPARATION)?;
    let Eyes { left, right } = eyes(&observer, separation, question.direction("right")?)?;
    Answer::default().event("left", left)?.event("right", right)
}

fn perceived_position(question: &Keys<'_>) -> Result<Answer, ProbeError> {
    question.only(&["ask", "eyes", "source", "time"])?;
    const EYES: &str = "a list of two places [[x, y, z], [x, y, z]]";
    let [left, right] = question.required("eyes", EYES)?.list_of(EYES)?;
    let source = question.source("source")?;
    let source = Source { position: source.vector("position")?, celerity: source.velocity()? };
    let StereoPerception { position, gap } =
        perceived_place([left.vector()?, right.vector()?], &source, question.number("time")?)?;
    Answer::default().vector("position", position)?.number("gap", gap)
}

fn colour(question: &Keys<'_>) -> Result<Answer, ProbeError> {
    question.only(&["ask", "spectrum", "D"])?;
    const DOPPLER: &str = "a Doppler factor: a number above 0";
    let doppler = question.required("D", DOPPLER)?.number_that(|doppler| doppler > 0.0, DOPPLER)?;
    let xyz = question.spectrum("spectrum")?.xyz(doppler);
    Answer::default().vector("xyz", xyz)?.vector("rgb", rgb_from_xyz() * xyz)
}

/// Follows a worldline leg by leg. Each leg has a constant acceleration in the axes of the pure boost from the world.
///
/// A leg is divided into equal steps, the fewest that are not longer than `step`.
fn worldline(question: &Keys<'_>) -> Result<Answer, ProbeError> {
    question.only(&["ask", "start", "legs", "step", "integrator"])?;
    const STEP: &str = "a number above 0";
    const LEGS: &str = "a list of objects with the keys duration, acceleration";
    const DURATION: &str = "a number, 0 or more";
    let start = question.observer("start")?;
    let step = question.required("step", STEP)?.number_that(|step| step > 0.0, STEP)?;
    let integrator = question.optional("integrator").map_or(Ok(Box::new(Rk4) as _), |name| integrator_of(&name))?;
    let legs = question.required("legs", LEGS)?.list(LEGS)?;
    let legs = legs.iter().map(|leg| {
        let leg = leg.object("an object with the keys duration, acceleration", &["duration", "acceleration"])?;
        let duration = leg.required("duration", DURATION)?.number_that(|duration| duration >= 0.0, DURATION)?;
        Ok((duration, leg.vector("acceleration")?))
    });
    let legs = legs.collect::<Result<Vec<_>, ProbeError>>()?;
    let steps = legs.iter().map(|(duration, _)| duration / step).sum();
    if steps > MOST_STEPS {
        return Err(ProbeError::TooManySteps { steps });
    }
    let mut state = State::new(start.event, start.celerity, DQuat::IDENTITY);
    for (index, &(duration, acceleration)) in legs.iter().enumerate() {
        let control = |state: &State| Thrust::in_boost_axes(state, acceleration);
        state = travel(integrator.as_ref(), &state, duration, step, &control)
            .map_err(|reason| ProbeError::Worldline { leg: index, reason })?;
    }
    Answer::default()
        .vector("position", state.position)?
        .number("time", state.ct)?
        .vector("celerity", state.celerity.vector())?
        .number("proper_time", state.proper_time)
}

fn integrator_of(name: &Place<'_>) -> Result<Box<dyn Integrator>, ProbeError> {
    const NAMES: &str = "\"rk4\", \"exact\" or \"dopri5\"";
    match IntegratorKind::from_name(name.text(NAMES)?).ok_or_else(|| name.wrong(NAMES))? {
        IntegratorKind::Rk4 => Ok(Box::new(Rk4)),
        IntegratorKind::Exact => Ok(Box::new(Exact)),
        IntegratorKind::DormandPrince => {
            let adaptive = DormandPrince::new(ADAPTIVE_TOLERANCE).expect("the tolerance is within its range");
            Ok(Box::new(adaptive))
        }
    }
}
