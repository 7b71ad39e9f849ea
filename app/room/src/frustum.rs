//! Off-axis frusta for flat screens: the picture plane is the screen itself, and no map is needed.

use crate::picture_plane::ahead;
use crate::surface::flat::FlatSurface;
use glam::{DMat3, DVec2, DVec3};
use thiserror::Error;
use view::Tangents;

/// Eye behind a screen, or in its plane.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the eye at {eye_m} m is {:.3} m behind the screen's plane; turn the screen round or move the head before it", -distance_m)]
pub struct EyeBehind {
    /// Place of the eye, room axes, metres.
    pub eye_m: DVec3,
    /// Distance before the screen, metres: zero or less.
    pub distance_m: f64,
}

/// View of an eye through a flat screen, as through a pane of glass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Rotation from the eye's axes (x along the screen's rows, y along its columns, −z straight towards it) to the
    /// room's.
    pub room_from_eye: DMat3,
    /// Rectangle of the screen in the plane one unit ahead, eye axes.
    pub tangents: Tangents,
}

impl Frustum {
    /// Direction in which the eye sees a place of the picture (0 to 1, x right, y down from the upper left); room
    /// axes. Its length is such that its component along the screen's normal is 1.
    pub fn ray(&self, place: DVec2) -> DVec3 {
        self.room_from_eye * ahead(&self.tangents, place)
    }
}

/// Frustum of an eye in front of a flat screen.
///
/// *Equation.* Kooima, Generalized Perspective Projection (2008); B eq. A.7–A.10, whose vanishing points are at
/// infinity for a rectangle and whose shear s is then 0.
///
/// # Errors
/// [`EyeBehind`].
pub fn frustum(flat: &FlatSurface, eye_m: DVec3) -> Result<Frustum, EyeBehind> {
    let (x, y) = (flat.right.normalize(), flat.up.normalize());
    let z = x.cross(y);
    let distance_m = (eye_m - flat.lower_left).dot(z);
    if distance_m.is_nan() || distance_m <= 0.0 {
        return Err(EyeBehind { eye_m, distance_m });
    }
    let corner = flat.lower_left - eye_m;
    let low = DVec2::new(corner.dot(x), corner.dot(y)) / distance_m;
    let high = low + flat.size_m() / distance_m;
    Ok(Frustum { room_from_eye: DMat3::from_cols(x, y, z), tangents: Tangents { low, high } })
}
