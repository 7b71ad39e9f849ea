//! Tour in a live ride: its rider's samples, the changes of what is shown, and its captions.

use input::{Action, Nanos, Sample};
use interface::{Caption, CaptionQuestion, ChosenAnswer};
use ride::Vehicle;
use tours::{TourPlayer, TourQuestion, TourShown};
use words::Language;

/// Tour that is being played.
pub struct TourRide {
    player: TourPlayer,
    shown: TourShown,
}

impl TourRide {
    /// Tour from its beginning.
    pub fn new(player: TourPlayer) -> Self {
        Self { player, shown: TourShown::default() }
    }

    /// Samples of the tour up to the time `now`, in the order of their times.
    pub fn samples(&mut self, now: Nanos, vehicle: &Vehicle) -> Vec<Sample> {
        let step = self.player.step(now, vehicle);
        let mut samples = step.samples;
        for change in step.changes {
            let actions = change.actions(&self.shown);
            samples.extend(actions.iter().map(|action| Sample::action(now, action)));
            self.shown.take(&change);
        }
        samples
    }

    /// Carries out an action that concerns the tour. True if it was one.
    pub fn act(&mut self, action: &Action) -> bool {
        match action {
            Action::Choose if self.player.is_over() => return false,
            Action::Choose if self.player.is_waiting() => self.player.go_on(),
            Action::Choose => self.player.stop(),
            Action::Answer(number) => self.player.answer(usize::from(*number)),
            _ => return false,
        }
        true
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
