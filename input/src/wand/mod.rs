//! The wand: a tracked hand with buttons and a stick, as VRPN servers and DTrack's flysticks give it.

pub(crate) mod held_buttons;

pub use held_buttons::HeldButtons;
