//! The window: events in, frames out.
//!
//! winit calls `application` for each event. A redraw advances the ride by one frame
//! ([`RideInProgress::frame`](crate::frame::RideInProgress::frame)), shows it (`show`) and asks for the next. Keys go
//! to the ride as samples (`events`), so that they are recorded like any device's. Settings that change the picture
//! alone (field of view, effects, panels) stay here. A lost surface is made again. A room with screens has one window
//! or several for its channels; they are drawn and presented together ([`WindowsInStep`](walls::WindowsInStep)), and
//! the first has the interface.

mod application;
mod calibrate;
mod calibrating;
mod controls;
mod events;
mod help;
mod hud;
mod interface;
mod keys;
mod open;
mod panel;
mod photo;
mod place;
mod readings;
mod server_loss;
mod show;
mod window_surface;

pub use application::{Begin, run};
