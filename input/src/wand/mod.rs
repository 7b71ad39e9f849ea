//! The wand: a tracked hand with buttons and a stick, as VRPN servers and DTrack's flysticks give it.
//!
//! Decoders turn a tracker's bytes into [`WandSignal`]s; a [`TrackedWand`] holds the state that they leave, and the
//! desk gives it with the controls of each frame. The pose passes the same checks as the head's.

pub(crate) mod config;
pub(crate) mod held_buttons;
pub(crate) mod signal;
pub(crate) mod state;
pub(crate) mod stick_flick;
pub(crate) mod tracked_wand;
pub(crate) mod work;

pub use config::WandConfig;
pub use held_buttons::HeldButtons;
pub use signal::WandSignal;
pub use state::WandState;
pub use tracked_wand::TrackedWand;
pub use work::WandButtons;
