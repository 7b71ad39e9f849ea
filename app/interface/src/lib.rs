//! What is written over a ride: the head-up display, the help, the menu.
//!
//! Everything here draws into an [`egui::Ui`], in a window or on a panel in the vehicle, and returns
//! [`input::Action`]s: nothing is changed here.

mod controls;
mod drawn_sheet;
mod help;
mod hud;
mod menu;
mod menu_pages;
mod notices;

pub use drawn_sheet::{DrawnSheet, SheetPointer};
pub use help::show as show_help;
pub use hud::{Readings, show as show_readings};
pub use menu::{MenuPage, MenuRide, sheet as menu_sheet, window as menu_window};
pub use notices::notice;
