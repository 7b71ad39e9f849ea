//! Planner in the interface: felt acceleration, and when to turn round.

use egui::{Align2, FontId, Painter, Pos2, Rect};

use crate::figures::{gravities, length, time};
use crate::pen::{self, ACCENT, FAINT, INK, TEXT};
use crate::trail::PresentMoment;
use crate::turn_plan::{PlannedJourney, TurnPlan, felt_g};
use crate::words::InstrumentWords;

/// Own time before the turn from which on the planner says "now", seconds.
const NOW_S: f64 = 0.5;
/// Standard acceleration of free fall, m/s².
const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Draws the planner into `area`: what the rider feels at present, and the plan of a journey to a place of this name,
/// if there is one.
pub fn planner(
    painter: &Painter,
    area: Rect,
    now: &PresentMoment,
    (aim, journey): (&str, Option<&PlannedJourney>),
    words: &InstrumentWords,
) {
    let inner = pen::frame(painter, area, words.planner, aim);
    let label = painter.text(inner.min, Align2::LEFT_TOP, words.felt, FontId::proportional(TEXT), FAINT);
    let felt = gravities(felt_g(&now.thrust, now.light_speed), words);
    let felt = painter.text(label.left_bottom(), Align2::LEFT_TOP, felt, FontId::proportional(22.0), INK);
    let mut y = felt.bottom() + 6.0;
    for (sentence, is_due) in sentences(journey, words) {
        let colour = if is_due { ACCENT } else { INK };
        let galley = painter.layout(sentence, FontId::proportional(TEXT), colour, inner.width());
        let height = galley.size().y;
        painter.galley(Pos2::new(inner.left(), y), galley, colour);
        y += height + 3.0;
    }
}

/// Sentences of the plan, each true if it is urgent.
pub fn sentences(journey: Option<&PlannedJourney>, words: &InstrumentWords) -> Vec<(String, bool)> {
    let plan = journey.and_then(|journey| Some((journey, journey.plan()?)));
    let Some((journey, plan)) = plan else { return vec![(words.no_destination.to_owned(), false)] };
    let acceleration = gravities(journey.acceleration_m_s2 / STANDARD_GRAVITY_M_S2, words);
    let aim = InstrumentWords::filled(words.plan_for, &[&length(journey.distance_m, words), &acceleration]);
    match plan {
        TurnPlan::Turn { turn_m, turn_own_s, own_s, world_s, .. } => {
            let is_due = turn_own_s < NOW_S;
            let turn = InstrumentWords::filled(words.turn_in, &[&length(turn_m, words), &time(turn_own_s, words)]);
            let turn = if is_due { words.turn_now.to_owned() } else { turn };
            let arrival = InstrumentWords::filled(words.arrive_in, &[&time(own_s, words), &time(world_s, words)]);
            vec![(aim, false), (turn, is_due), (arrival, false)]
        }
        TurnPlan::Overshoot { beyond_m, .. } => {
            let beyond = InstrumentWords::filled(words.overshoot, &[&length(beyond_m, words)]);
            vec![(aim, false), (words.turn_now.to_owned(), true), (beyond, true)]
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law: the planner's sentences are those of its plan. A wrong program lets a rider fly past.

    use super::*;
    use ride::LightSpeed;

    fn told(distance_m: f64, celerity: f64) -> Vec<(String, bool)> {
        // 2 g at c = 8 m/s.
        let journey = PlannedJourney {
            distance_m,
            celerity,
            acceleration_m_s2: 2.0 * STANDARD_GRAVITY_M_S2,
            light_speed: LightSpeed::new(8.0).unwrap(),
        };
        sentences(Some(&journey), &InstrumentWords::ENGLISH)
    }

    #[test]
    fn a_plan_is_told_in_sentences() {
        // a = 19.6133/64 per metre; half way at 50 m: γ = 16.32, η = 3.485: 2.275 s, twice that until arrival.
        let sentences = told(100.0, 0.0);
        assert_eq!(sentences[0].0, "100 m ahead, at 2.00 g");
        assert_eq!(sentences[1], ("turn round after 50.0 m, in 1.42 s of your time".to_owned(), false));
        assert_eq!(sentences[2].0, "arrival in 2.84 s of your time, 13.3 s of the world's");
    }

    #[test]
    fn a_turn_that_is_due_and_one_that_is_too_late_are_urgent() {
        // γ = 1.25: the way to stop is 0.25 · 64/19.6133 = 0.816 m.
        assert_eq!(told(0.82, 0.75)[1], ("turn round now".to_owned(), true));
        assert_eq!(told(0.5, 0.75)[2], ("too fast to stop there: you will miss it by 31.6 cm".to_owned(), true));
        assert_eq!(sentences(None, &InstrumentWords::GERMAN), [("kein Ziel gewählt".to_owned(), false)]);
    }
}
