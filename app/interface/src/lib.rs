//! What is written over a ride: the head-up display, the help, the menu.
//!
//! Everything here draws into an [`egui::Ui`], in a window or on a panel in the vehicle, and returns
//! [`input::Action`]s: nothing is changed here.

mod caption;
mod clock_table;
mod controls;
mod drawn_sheet;
mod help;
mod hud;
mod menu;
mod menu_comfort;
mod menu_drawing;
mod menu_pages;
mod menu_ride;
mod menu_rows;
mod menu_world;
mod notices;
mod painter;

pub use caption::{
    Caption, CaptionQuestion, ChosenAnswer, film as caption_film, sheet as caption_sheet, window as caption_window,
};
pub use clock_table::{ClockRow, show as show_clocks};
pub use drawn_sheet::{DrawnSheet, FORMAT as SHEET_FORMAT, SheetPointer, key_events};
pub use help::{cap, sheet as help_sheet, show as show_help};
pub use hud::{Readings, pace_line, show as show_readings, speed_line};
pub use menu::{MenuPage, sheet as menu_sheet, show as menu_contents, window as menu_window};
pub use menu_ride::{MenuComfort, MenuRide};
pub use notices::{accuracy, log_fault, notice, replay_fault, uncertainty};
pub use painter::{Painter, layouts};
