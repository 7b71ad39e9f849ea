//! Plane one unit ahead of an eye or of a projector's lens, in which a flat picture lies.
//!
//! Places of the picture run from 0 to 1, x right and y down from the upper left; its rectangle in the plane is given
//! by [`Tangents`]. Axes: x right, y up, −z ahead.

use glam::{DVec2, DVec3};
use view::Tangents;

/// Vector to a place of the picture, (x, y, −1).
pub(crate) fn ahead(picture: &Tangents, place: DVec2) -> DVec3 {
    let Tangents { low, high } = picture;
    DVec3::new(low.x + place.x * (high.x - low.x), high.y + place.y * (low.y - high.y), -1.0)
}

/// Place of the picture that lies in a direction of any length, inside the picture or not; `None` for a direction that
/// does not go ahead.
pub(crate) fn place(picture: &Tangents, direction: DVec3) -> Option<DVec2> {
    let Tangents { low, high } = picture;
    let (x, y) = (-direction.x / direction.z, -direction.y / direction.z);
    (direction.z < 0.0).then(|| DVec2::new((x - low.x) / (high.x - low.x), (y - high.y) / (low.y - high.y)))
}
