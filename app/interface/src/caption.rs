//! Caption of a tour, with its question and what goes on.

use crate::controls::Controls;
use egui::{Align2, Area, Color32, Frame, Id, Order, Pos2, Rangef, RichText, Ui};
use input::Action;
use words::{Language, Phrase};

/// Caption of a tour at present.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Caption {
    /// Title of the tour.
    pub title: String,
    /// Text on what is seen; empty if there is none.
    pub text: String,
    /// Question that waits for an answer, or whose answer is explained.
    pub question: Option<CaptionQuestion>,
    /// True if the tour waits for the visitor.
    pub waits: bool,
}

/// Question of a tour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CaptionQuestion {
    /// Question itself.
    pub ask: String,
    /// Answers to choose from.
    pub answers: Vec<String>,
    /// Answer that was chosen last.
    pub chosen: Option<ChosenAnswer>,
}

/// Answer that was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenAnswer {
    /// Number of the answer, from 0.
    pub number: usize,
    /// True if it is right.
    pub is_right: bool,
    /// Explanation.
    pub why: String,
}

const RIGHT: Color32 = Color32::from_rgb(0x8f, 0xd1, 0x7f);
const WRONG: Color32 = Color32::from_rgb(0xff, 0xb3, 0x47);

/// Widest caption, points, and its distance from the lower edge, above the readings.
const WIDTH: f32 = 620.0;
/// Narrowest room for a caption between panels, points.
const NARROWEST: f32 = 320.0;
const ABOVE: f32 = 108.0;
/// Distance from the lower edge of a film, points.
const IN_FILM: f32 = 24.0;

/// Shows a caption's texts and answers. What is asked for is returned as actions.
fn texts(ui: &mut Ui, language: Language, caption: &Caption) -> Vec<Action> {
    let mut actions = Vec::new();
    ui.label(RichText::new(&caption.title).small().weak());
    if !caption.text.is_empty() {
        ui.label(RichText::new(&caption.text).size(18.0).strong());
    }
    if let Some(CaptionQuestion { ask, answers, chosen }) = &caption.question {
        ui.label(RichText::new(ask).size(18.0).color(WRONG));
        for (number, answer) in answers.iter().enumerate() {
            let is_chosen = chosen.as_ref().is_some_and(|chosen| chosen.number == number);
            if Controls::new(ui, language).named_choice(is_chosen, answer, Phrase::AnswerPurpose) {
                actions.push(Action::Answer(u8::try_from(number).unwrap_or(u8::MAX)));
            }
        }
        if let Some(ChosenAnswer { is_right, why, .. }) = chosen {
            let (verdict, colour) = if *is_right { (Phrase::Right, RIGHT) } else { (Phrase::Wrong, WRONG) };
            ui.label(RichText::new(format!("{} {why}", language.text(verdict))).color(colour));
        }
    }
    actions
}

/// Shows a caption with its buttons. What is asked for is returned as actions.
pub fn show(ui: &mut Ui, language: Language, caption: &Caption) -> Vec<Action> {
    let mut actions = texts(ui, language, caption);
    let can_go_on = caption.waits && caption.question.as_ref().is_none_or(|question| question.chosen.is_some());
    if can_go_on && Controls::new(ui, language).button(Phrase::GoOn, Phrase::GoOnPurpose) {
        actions.push(Action::GoOn);
    }
    if !caption.waits && Controls::new(ui, language).button(Phrase::LookAround, Phrase::LookAroundPurpose) {
        actions.push(Action::GoOn);
    }
    actions
}

/// Shows a caption above the lower edge of a picture, by so many points, in the middle of what is `free` from left to
/// right.
fn over(ui: &Ui, above: f32, free: Rangef, contents: impl FnOnce(&mut Ui)) {
    let screen = ui.ctx().content_rect();
    // Between panels that leave no room it stands over them.
    let free = if free.span() >= NARROWEST { free } else { Rangef::new(screen.left(), screen.right()) };
    let at = Pos2::new(free.center(), screen.bottom() - above);
    let area = Area::new(Id::unique("caption")).order(Order::Foreground);
    area.fixed_pos(at).pivot(Align2::CENTER_BOTTOM).show(ui.ctx(), |ui| {
        Frame::window(ui.style()).show(ui, |ui| {
            ui.set_max_width((free.span() - 40.0).min(WIDTH));
            contents(ui);
        });
    });
}

/// Shows a caption above the readings of a window, where panels leave what is `free` from left to right.
pub fn window(ui: &Ui, free: Rangef, language: Language, caption: &Caption) -> Vec<Action> {
    let mut actions = Vec::new();
    over(ui, ABOVE, free, |ui| actions = show(ui, language, caption));
    actions
}

/// Shows a caption in a film, where nobody presses buttons.
pub fn film(ui: &Ui, free: Rangef, language: Language, caption: &Caption) {
    over(ui, IN_FILM, free, |ui| {
        texts(ui, language, caption);
    });
}

/// Shows a caption on a sheet of its own.
pub fn sheet(ui: &mut Ui, language: Language, caption: &Caption) -> Vec<Action> {
    let mut actions = Vec::new();
    Frame::window(ui.style()).show(ui, |ui| {
        ui.set_min_width(ui.available_width());
        actions = show(ui, language, caption);
    });
    actions
}
