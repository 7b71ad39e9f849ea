//! Questions of the probe: each reads its keys, asks the physics, and names the results.

use physics::aberration::Aberration;
use physics::colour::rgb_from_xyz;
use physics::eyes::{Eyes, eyes};
use physics::glam::{DQuat, DVec3};
use physics::stereo_perception::{StereoPerception, perceived_place};
use physics::worldline::{DormandPrince, Exact, Integrator, Rk4, Thrust, WorldlineState, travel};
use physics::{Boost, Celerity, Composition, FourVector, PointSource, apparent, compose};
use serde_json::Value;

use ride::IntegratorKind;

use crate::error::ProbeError;
use crate::json::JsonNode;
use crate::keys::{QuestionKeys, QuestionValue};
use crate::limits::MOST_STEPS;
use crate::results::AnswerObject;

const QUESTIONS: &str = "one of aberration, boost, compose, apparent, eyes, worldline, perceived, colour";

/// Tolerance of an adaptive step, near the limit of f64, since the numbers are what a question is for.
const ADAPTIVE_TOLERANCE: f64 = 1e-12;

/// Answers the question in a tree.
pub(super) fn answer(question: &JsonNode) -> Result<Value, ProbeError> {
    let question = QuestionKeys::of_line(question)?;
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
    answer.map(AnswerObject::finish)
}

fn aberration(question: &QuestionKeys<'_>) -> Result<AnswerObject, ProbeError> {
    question.only(&["ask", "celerity", "beta", "direction"])?;
    let aberration = Aberration::new(question.velocity()?);
    let (direction, doppler) = aberration.observer_from_world(question.direction("direction")?);
    AnswerObject::default().vector("direction", direction)?.number("D", doppler)
}

fn boost(question: &QuestionKeys<'_>) -> Result<AnswerObject, ProbeError> {
    question.only(&["ask", "celerity", "beta", "event"])?;
    let observer_from_world = Boost::observer_from_world(question.velocity()?);
    const EVENT: &str = "a list of four numbers [t, x, y, z]";
    let [t, x, y, z] = question.required("event", EVENT)?.list_of(EVENT)?;
    let event = FourVector { t: t.number()?, r: DVec3::new(x.number()?, y.number()?, z.number()?) };
    AnswerObject::default().four_vector("event", observer_from_world.apply(event))
}

fn composition(question: &QuestionKeys<'_>) -> Result<AnswerObject, ProbeError> {
    question.only(&["ask", "vehicle", "head"])?;
    const VELOCITY: &str = "a celerity, three numbers [x, y, z], or an object {\"beta\": [x, y, z]}";
    let vehicle = question.required("vehicle", VELOCITY)?.velocity()?;
    let head = question.required("head", VELOCITY)?.velocity()?;
    let Composition { celerity, wigner } = compose(vehicle, head);
    AnswerObject::default().vector("celerity", celerity.vector())?.quaternion("wigner", wigner)
}

fn apparent_position(question: &QuestionKeys<'_>) -> Result<AnswerObject, ProbeError> {
    question.only(&["ask", "observer", "source"])?;
    let observer = question.observer("observer")?;
    let source = question.source("source")?;
    let celerity = source.optional_velocity()?.unwrap_or_default();
    let source = PointSource { position: source.vector("position")?, celerity };
    let seen = if source.celerity == Celerity::ZERO {
        apparent::at_rest(&observer, source.position)
    } else {
        apparent::moving(&observer, &source)
    };
    AnswerObject::default()
        .vector("position", seen.position)?
        .number("D", seen.doppler)?
        .number("emitted_at", seen.emitted_at)
}

fn both_eyes(question: &QuestionKeys<'_>) -> Result<AnswerObject, ProbeError> {
    question.only(&["ask", "observer", "separation", "right"])?;
    let observer = question.observer("observer")?;
    const SEPARATION: &str = "a distance: a number, 0 or more";
    let separation = question.required("separation", SEPARATION)?;
    let separation = separation.number_that(|separation| separation >= 0.0, SEPARATION)?;
    let Eyes { left, right } = eyes(&observer, separation, question.direction("right")?)?;
    AnswerObject::default().event("left", left)?.event("right", right)
}

fn perceived_position(question: &QuestionKeys<'_>) -> Result<AnswerObject, ProbeError> {
    question.only(&["ask", "eyes", "source", "time"])?;
    const EYES: &str = "a list of two places [[x, y, z], [x, y, z]]";
    let [left, right] = question.required("eyes", EYES)?.list_of(EYES)?;
    let source = question.source("source")?;
    let source = PointSource { position: source.vector("position")?, celerity: source.velocity()? };
    let StereoPerception { position, gap } =
        perceived_place([left.vector()?, right.vector()?], &source, question.number("time")?)?;
    AnswerObject::default().vector("position", position)?.number("gap", gap)
}

fn colour(question: &QuestionKeys<'_>) -> Result<AnswerObject, ProbeError> {
    question.only(&["ask", "spectrum", "D"])?;
    const DOPPLER: &str = "a Doppler factor: a number above 0";
    let doppler = question.required("D", DOPPLER)?.number_that(|doppler| doppler > 0.0, DOPPLER)?;
    let xyz = question.spectrum("spectrum")?.xyz(doppler);
    AnswerObject::default().vector("xyz", xyz)?.vector("rgb", rgb_from_xyz() * xyz)
}

/// Follows a worldline leg by leg. Each leg has a constant acceleration in the axes of the pure boost from the world.
///
/// A leg is divided into equal steps, the fewest that are not longer than `step`.
fn worldline(question: &QuestionKeys<'_>) -> Result<AnswerObject, ProbeError> {
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
    let mut state = WorldlineState::new(start.event, start.celerity, DQuat::IDENTITY);
    for (index, &(duration, acceleration)) in legs.iter().enumerate() {
        let control = |state: &WorldlineState| Thrust::in_boost_axes(state, acceleration);
        state = travel(integrator.as_ref(), &state, duration, step, &control)
            .map_err(|reason| ProbeError::Worldline { leg: index, reason })?;
    }
    AnswerObject::default()
        .vector("position", state.position)?
        .number("time", state.ct)?
        .vector("celerity", state.celerity.vector())?
        .number("proper_time", state.proper_time)
}

fn integrator_of(name: &QuestionValue<'_>) -> Result<Box<dyn Integrator>, ProbeError> {
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
