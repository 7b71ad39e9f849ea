//! Sheets that float in the room: rectangles with a picture on them, at rest in the vehicle.

use crate::head::RoomHead;
use glam::{DVec2, DVec3};

/// Rectangle in the room with a picture on it: a menu, readings, the beam of a pointer.
///
/// *Frames, units*: the room's axes, metres.
#[derive(Clone, Debug)]
pub struct RoomSheet {
    /// Lower left corner.
    pub corner_m: DVec3,
    /// Vector along the lower edge.
    pub right_m: DVec3,
    /// Vector along the left edge, at right angles to the lower one.
    pub up_m: DVec3,
    /// Picture on the sheet, upright: sRGB in 8 bits, times its opacity.
    pub picture: wgpu::TextureView,
}

impl RoomSheet {
    /// The sheet as a head sees it that has turned: in axes that have turned with the head, about its place.
    pub(crate) fn seen_by(&self, head: &RoomHead) -> Self {
        let turned = head.room_from_head.transpose();
        Self {
            corner_m: head.place_m + turned * (self.corner_m - head.place_m),
            right_m: turned * self.right_m,
            up_m: turned * self.up_m,
            picture: self.picture.clone(),
        }
    }
}

/// Place at which a ray meets a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetHit {
    /// Distance from the ray's origin, in lengths of its direction.
    pub way: f64,
    /// Place on the sheet, 0 to 1, from its upper left corner to the right and down.
    pub place: DVec2,
}

/// Meeting of a ray with a rectangle, given by its lower left corner and its edges; `None` if it misses it. A sheet is
/// met from either side.
pub fn meet(corner_m: DVec3, right_m: DVec3, up_m: DVec3, from_m: DVec3, direction: DVec3) -> Option<SheetHit> {
    let normal = right_m.cross(up_m);
    let way = (corner_m - from_m).dot(normal) / direction.dot(normal);
    let met = from_m + way * direction - corner_m;
    let place = DVec2::new(met.dot(right_m) / right_m.length_squared(), 1.0 - met.dot(up_m) / up_m.length_squared());
    let inside = place.cmpge(DVec2::ZERO).all() && place.cmple(DVec2::ONE).all();
    (way.is_finite() && way > 0.0 && inside).then_some(SheetHit { way, place })
}

#[cfg(test)]
mod tests {
    //! Law: a ray that is aimed at a place of a sheet meets it there, wherever both are; one that points away does not.

    use super::*;
    use glam::DQuat;

    #[test]
    fn a_ray_meets_the_place_that_it_is_aimed_at() {
        let turn = DQuat::from_rotation_y(0.7) * DQuat::from_rotation_x(-0.4);
        let corner = DVec3::new(-0.3, 1.1, -2.0);
        let (right, up) = (turn * DVec3::X * 1.5, turn * DVec3::Y * 0.8);
        for from in [DVec3::new(0.1, 1.7, 0.3), DVec3::new(0.8, 0.2, -6.0)] {
            for place in [DVec2::new(0.01, 0.99), DVec2::new(0.5, 0.25), DVec2::new(0.99, 0.02)] {
                let point = corner + place.x * right + (1.0 - place.y) * up;
                let hit = meet(corner, right, up, from, (point - from) * 0.5).unwrap();
                assert!((hit.place - place).length() < 1e-12 && (hit.way - 2.0).abs() < 1e-12);
                assert_eq!(meet(corner, right, up, from, from - point), None);
            }
            let beside = corner - 0.01 * right;
            assert_eq!(meet(corner, right, up, from, beside - from), None);
        }
        assert_eq!(meet(corner, right, up, DVec3::ZERO, right), None);
    }
}
