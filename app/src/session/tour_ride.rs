//! Tour in a live ride: its rider's samples, the changes of what is shown, and its captions.

use input::{Action, Nanos, Sample, SampleSource, VehicleKind};
use interface::{Caption, CaptionQuestion, ChosenAnswer};
use physics::Event;
use ride::Simulation;
use tours::{TourChange, TourEvent, TourPlayer, TourQuestion, TourText};
use words::Language;

/// Tour that is being played.
pub struct TourRide {
    player: TourPlayer,
    marks: Vec<TourMark>,
    /// True once the visitor was told that it is over.
    ended: bool,
}

/// Event of a tour, for the diagram.
#[derive(Clone, Debug)]
pub struct TourMark {
    /// Name of the event.
    pub name: TourText,
    /// Event, world axes.
    pub event: Event,
}

impl TourRide {
    /// Tour from its beginning.
    pub fn new(player: TourPlayer) -> Self {
        Self { player, marks: Vec::new(), ended: false }
    }

    /// Samples of the tour up to the time `now`, in the order of their times.
    pub fn samples(&mut self, now: Nanos, ride: &Simulation) -> Vec<Sample> {
        let step = self.player.step(now, ride);
        let mut samples = step.samples;
        let vehicle = ride.vehicle();
        for change in &step.changes {
            if let TourChange::Mark(TourEvent { name, position, after_s }) = change {
                let ct = vehicle.state().ct + vehicle.light_speed().metres(*after_s);
                self.marks.push(TourMark { name: name.clone(), event: Event { ct, position: *position } });
            }
        }
        let actions = step.changes.iter().flat_map(TourChange::actions);
        samples.extend(actions.map(|action| Sample::action(now, &action)));
        samples
    }

    /// True once, after the last station.
    pub fn has_ended(&mut self) -> bool {
        self.player.is_over() && !std::mem::replace(&mut self.ended, true)
    }

    /// Events that have been named since the last call.
    pub fn take_marks(&mut self) -> Vec<TourMark> {
        std::mem::take(&mut self.marks)
    }

    /// True if this source of samples is the tour's own rider as long as the tour lasts.
    pub fn replaces(&self, source: SampleSource) -> bool {
        let rides = self.player.plan().vehicle == VehicleKind::Bicycle;
        rides && !self.player.is_over() && matches!(source, SampleSource::Bicycle | SampleSource::Trainer)
    }

    /// Carries out an action that concerns the tour.
    pub fn act(&mut self, action: &Action) {
        match action {
            Action::GoOn if self.player.is_waiting() => self.player.go_on(),
            Action::GoOn => self.player.stop(),
            Action::Answer(number) => self.player.answer(usize::from(*number)),
            _ => {}
        }
    }

    /// Right answer to the question that is open; `None` without one.
    pub fn right_answer(&self) -> Option<Action> {
        let question = self.player.question().filter(|_| self.player.answered().is_none())?;
        let number = question.answers.iter().position(|answer| answer.right)?;
        Some(Action::Answer(u8::try_from(number).ok()?))
    }

    /// Caption at present; `None` once the tour is over.
    pub fn caption(&self, language: Language) -> Option<Caption> {
        if self.player.is_over() {
            return None;
        }
        let code = language.code();
        let question = self.player.question().map(|TourQuestion { ask, answers }| {
            let texts = answers.iter().map(|answer| answer.text.in_language(code).to_owned()).collect();
            let chosen = self.player.answered().and_then(|chosen| {
                let number = answers.iter().position(|answer| answer == chosen)?;
                Some(ChosenAnswer { number, is_right: chosen.right, why: chosen.why.in_language(code).to_owned() })
            });
            CaptionQuestion { ask: ask.in_language(code).to_owned(), answers: texts, chosen }
        });
        Some(Caption {
            title: self.player.plan().title.in_language(code).to_owned(),
            text: self.player.caption().map_or_else(String::new, |text| text.in_language(code).to_owned()),
            question,
            waits: self.player.is_waiting(),
        })
    }
}
