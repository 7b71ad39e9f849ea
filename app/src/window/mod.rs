//! The window: events in, frames out.
//!
//! winit calls `application` for each event. A redraw advances the ride by one frame
//! ([`RideInProgress::frame`](crate::frame::RideInProgress::frame)), shows it (`show`) and asks for the next. Keys go
//! to the ride as samples (`events`), so that they are recorded like any device's, and come back as actions
//! (`actions`). A lost surface is made again. A room with screens has one window
//! or several for its channels; they are drawn and presented together ([`WindowsInStep`](walls::WindowsInStep)), and
//! the first has the interface. A headset takes turns of its own (`headset_turns`), and the window shows its left
//! picture.

mod actions;
mod application;
mod calibrate;
mod calibrating;
mod events;
mod headset;
mod headset_turns;
mod next;
mod open;
mod operator;
mod photo;
mod place;
mod readings;
mod server_loss;
mod show;
mod surface_interface;
mod window_surface;

pub use application::run;
