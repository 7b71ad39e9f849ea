//! The menu: all that a rider can ask for, on five pages, of which one is open.
//!
//! The same contents are shown in a window over the picture and on a panel that floats in the vehicle.

use crate::controls::Controls;
use crate::menu_pages::{picture, program, ride, understand};
use crate::menu_ride::MenuRide;
use crate::menu_world::world;
use egui::{Align2, Color32, Frame, RichText, Stroke, Ui, Vec2, Window};
use input::{Action, Switch};
use presentation::Presentation;
use words::Phrase;

/// Page of the menu.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MenuPage {
    /// Vehicle, speed of light, clock.
    #[default]
    Ride,
    /// Scenes, tours, places.
    World,
    /// Effects, brightness, colours, field of view.
    Picture,
    /// Views, view from outside, map, diagram.
    Understand,
    /// Language, devices, end.
    Program,
}

/// Pages, with their names.
const PAGES: [(MenuPage, Phrase, Phrase); 5] = [
    (MenuPage::Ride, Phrase::Ride, Phrase::RidePurpose),
    (MenuPage::World, Phrase::World, Phrase::WorldPurpose),
    (MenuPage::Picture, Phrase::Picture, Phrase::PicturePurpose),
    (MenuPage::Understand, Phrase::Understand, Phrase::UnderstandPurpose),
    (MenuPage::Program, Phrase::Program, Phrase::ProgramPurpose),
];

/// Margins of a sheet's frame, left and right or above and below, points.
const SHEET_MARGIN: f32 = 14.0;
/// Radius and colour of the pointer on a sheet.
const POINTER_POINTS: f32 = 5.0;
const POINTER_INK: Color32 = Color32::from_rgb(0xff, 0xb3, 0x47);

/// Shows the menu's contents. What is asked for is returned as actions.
pub fn show(ui: &mut Ui, page: &mut MenuPage, presentation: &Presentation, state: &MenuRide) -> Vec<Action> {
    contents(ui, page, presentation, (state, false))
}

/// Shows the menu's contents, with a button that closes it if it `closes`.
fn contents(
    ui: &mut Ui,
    page: &mut MenuPage,
    presentation: &Presentation,
    (state, closes): (&MenuRide, bool),
) -> Vec<Action> {
    let mut actions = Vec::new();
    let language = presentation.language;
    ui.horizontal(|ui| {
        ui.label(RichText::new(language.text(Phrase::MenuTitle)).strong().heading());
        ui.add_space(10.0);
        for (other, name, purpose) in PAGES {
            if Controls::new(ui, language).choice(*page == other, name, purpose) {
                *page = other;
            }
        }
        ui.add_space(10.0);
        if closes && Controls::new(ui, language).button(Phrase::CloseMenu, Phrase::CloseMenuPurpose) {
            actions.push(Action::Toggle(Switch::Menu));
        }
    });
    ui.separator();
    match page {
        MenuPage::Ride => ride(ui, presentation, state, &mut actions),
        MenuPage::World => world(ui, language, state, &mut actions),
        MenuPage::Picture => picture(ui, presentation, state, &mut actions),
        MenuPage::Understand => understand(ui, presentation, &mut actions),
        MenuPage::Program => program(ui, presentation, state, &mut actions),
    }
    actions
}

/// Shows the menu on a sheet of its own, which it fills.
pub fn sheet(ui: &mut Ui, page: &mut MenuPage, presentation: &Presentation, state: &MenuRide) -> Vec<Action> {
    let mut actions = Vec::new();
    let whole = ui.max_rect();
    Frame::window(ui.style()).show(ui, |ui| {
        ui.set_min_size(whole.size() - Vec2::splat(SHEET_MARGIN));
        actions = contents(ui, page, presentation, (state, true));
    });
    if let Some(pointer) = ui.ctx().pointer_latest_pos() {
        ui.ctx().debug_painter().circle(pointer, POINTER_POINTS, POINTER_INK, Stroke::new(1.0, Color32::BLACK));
    }
    actions
}

/// Shows the menu in a window over the picture.
pub fn window(ui: &Ui, page: &mut MenuPage, presentation: &Presentation, state: &MenuRide) -> Vec<Action> {
    let mut actions = Vec::new();
    let title = presentation.language.text(Phrase::MenuTitle);
    let width = ui.ctx().content_rect().width();
    let window = Window::new(title).id(egui::Id::unique("menu")).title_bar(false).resizable(false);
    window.anchor(Align2::RIGHT_TOP, [-12.0, 40.0]).show(ui.ctx(), |ui| {
        ui.set_max_width((width - 60.0).min(520.0));
        actions = contents(ui, page, presentation, (state, true));
    });
    actions
}
