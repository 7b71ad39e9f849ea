//! What a rider finds in the vehicle: the keys, what explains the ride, and the sheets that float in a room.

mod cockpit;
mod corners;
mod guide;
mod keys;
mod room_interface;
mod unfelt;

pub use corners::{corner_place, corner_refused};
pub use guide::Guide;
pub use keys::key;
pub use room_interface::{PointerRay, RoomInterface, Shown, of_mouse, of_wand};
pub use unfelt::UnfeltMotion;
