//! Pictures on the surfaces around a viewer: every channel of a display, drawn for a head in the vehicle.
//!
//! # How it works
//! 1. An [`Occupant`] gives the place of each eye, in the world and in the room (`head`).
//! 2. The photo-surface of an eye does not depend on the direction of view, so it is computed once for all channels
//!    of that eye (W 6.4.1).
//! 3. A channel on a flat screen is drawn through the screen's own off-axis frustum. Any other channel is drawn into
//!    flat pictures around the eye (`facet`), in which every pixel of the channel then looks up its place
//!    (`curved`).
//! 4. Both eyes adapt to all channels together, so that no edge between two screens shows. Then each channel is
//!    developed, multiplied by its projector's gains, and put into its window.
//!
//! Sheets (`room_sheet`) float in the room over these pictures: menus and readings, which no speed bends or shifts.
//! Below them a veil (`veil`) may darken the edges of a headset's pictures, and another darken all.
//!
//! A window that is no room has one flat picture (`flat_picture`), with as many pixels as its frame rate allows
//! (`governor`). A room draws as many of its channels' pixels (`governed`), and enlarges their light
//! (`enlarged_light`).
//!
//! All windows of a display present the same frame (`in_step`), and none keeps the others waiting (`texture_waiter`).

pub mod calibration;
mod combine;
mod curved;
mod enlarged_light;
mod facet;
mod flat_picture;
mod frame_cost;
mod gains;
mod governed;
mod governor;
mod head;
mod headset;
mod in_step;
mod picture;
mod picture_shares;
pub mod preview;
mod projected;
mod projected_view;
mod quality;
mod room_rest;
mod room_sheet;
mod scene_depth;
mod sheet_passes;
mod show;
mod sphere_taker;
mod test_grid;
mod texture_waiter;
mod veil;
mod views;
mod walls;

pub use flat_picture::FlatPicture;
pub use governor::Governor;
pub use head::{Occupant, OccupantEye, RoomHead};
pub use in_step::{TextureAnswer, WindowsInStep};
pub use picture_shares::{Drawing, PictureShares};
pub use projected::ProjectedPicture;
pub use projected_view::{ProjectedView, StereoEyes};
pub use quality::Quality;
pub use room_sheet::{RoomSheet, SheetHit, meet};
pub use texture_waiter::{TextureWaiter, WaiterGone};
pub use veil::Veil;
pub use views::draws_views;
pub use walls::{DrawnChannels, SubmittedRoom, Walls};
