//! Lenses of projectors: the direction of the light of each place in the picture, and the inverse.
//!
//! Directions are in the projector's axes: x right, y up as in its upright picture, −z along the optical axis. Places
//! run from 0 to 1, x right and y down from the upper left of the picture as it leaves the projector.

use crate::net::{EvenGrid, TriangleNet};
use crate::picture_plane;
use glam::{DVec2, DVec3};
use view::Tangents;

/// Lens of a projector: the map φ_p of B eq. 4.1 from places of the picture to directions.
#[derive(Clone, Debug, PartialEq)]
pub enum ProjectorLens {
    /// A flat picture from one point, as most projectors make it.
    ///
    /// The rectangle is that of the picture in the plane one unit ahead, projector's axes. A shifted lens has its
    /// middle off the axis.
    Pinhole(Tangents),
    /// A laser beam that mirrors turn by even steps, with an optic that multiplies the angle to the axis (B eq. 4.6,
    /// 4.7).
    Scan {
        /// Angle of the mirrors from the picture's middle to its right edge, radians.
        half_width_rad: f64,
        /// Angle of the mirrors from the picture's middle to its upper edge, radians.
        half_height_rad: f64,
        /// Angle to the axis behind the optic, divided by the angle before it.
        magnification: f64,
    },
    /// A measured lens.
    Table(LensTable),
}

/// Measured lens, known at an even grid of places; yaw and pitch are piecewise linear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct LensTable {
    grid: EvenGrid,
    /// Yaw (to the left) and pitch (up), radians. Rows begin at the top, each from the left.
    angles: Vec<DVec2>,
    back: TriangleNet,
}

impl LensTable {
    /// Creates a lens from yaw and pitch in radians at `columns` × `rows` places, at least two each way, the top row
    /// first.
    pub fn new(columns: u32, rows: u32, angles: Vec<DVec2>) -> Self {
        let grid = EvenGrid { columns, rows };
        let back = TriangleNet::new(angles.clone(), &grid.triangles());
        Self { grid, angles, back }
    }
}

impl ProjectorLens {
    /// Creates a pinhole lens from its throw ratio.
    ///
    /// # Arguments
    /// * `throw_ratio` — distance to a wall, divided by the picture's width there.
    /// * `aspect` — width of the picture, divided by its height.
    /// * `shift` — shift of the picture's middle from the axis, in widths to the right and heights upwards.
    pub fn pinhole(throw_ratio: f64, aspect: f64, shift: DVec2) -> Self {
        let size = DVec2::new(1.0 / throw_ratio, 1.0 / (throw_ratio * aspect));
        Self::Pinhole(Tangents { low: (shift - 0.5) * size, high: (shift + 0.5) * size })
    }

    /// Creates a laser scanner's lens with `size` pixels, `step_rad` apart at the mirrors.
    pub fn scan(size: [u32; 2], step_rad: f64, magnification: f64) -> Self {
        let [half_width_rad, half_height_rad] = size.map(|side| 0.5 * f64::from(side) * step_rad);
        Self::Scan { half_width_rad, half_height_rad, magnification }
    }

    /// Unit vector along the light of a place; `None` outside a table. Pinhole and scanner continue beyond the
    /// picture's edges.
    pub fn direction(&self, place: DVec2) -> Option<DVec3> {
        match self {
            Self::Pinhole(picture) => Some(picture_plane::ahead(picture, place).normalize()),
            Self::Scan { half_width_rad, half_height_rad, magnification } => {
                let x = (2.0 * place.x - 1.0) * half_width_rad;
                let y = (1.0 - 2.0 * place.y) * half_height_rad;

                // a = √(1 − cos²κx cos²κy), written so that it does not cancel near the axis.
                let a = x.sin().hypot(x.cos() * y.sin());
                let alpha = a.atan2(x.cos() * y.cos());
                let (sin, cos) = (magnification * alpha).sin_cos();
                let stretch = if a > 0.0 { sin / a } else { *magnification };
                Some(DVec3::new(stretch * x.sin(), stretch * x.cos() * y.sin(), -cos))
            }
            Self::Table(table) => {
                let angles = table.grid.find(place)?.mix(&table.angles);
                let ((sin_yaw, cos_yaw), (sin_pitch, cos_pitch)) = (angles.x.sin_cos(), angles.y.sin_cos());
                let direction = DVec3::new(-sin_yaw * cos_pitch, sin_pitch, -cos_yaw * cos_pitch);
                direction.is_finite().then_some(direction)
            }
        }
    }

    /// Place whose light goes along `direction` (any length), inside the picture or not; `None` if there is none.
    pub fn place(&self, direction: DVec3) -> Option<DVec2> {
        match self {
            Self::Pinhole(picture) => picture_plane::place(picture, direction),
            Self::Scan { half_width_rad, half_height_rad, magnification } => {
                let across = direction.truncate();
                let alpha = across.length().atan2(-direction.z) / magnification;
                let (sin, cos) = alpha.sin_cos();
                let before = (across.normalize_or_zero() * sin).extend(-cos);
                let x = before.x.clamp(-1.0, 1.0).asin();
                let y = before.y.atan2(-before.z);
                // Mirrors turn by less than a quarter turn.
                (cos > 0.0).then(|| DVec2::new(0.5 + 0.5 * x / half_width_rad, 0.5 - 0.5 * y / half_height_rad))
            }
            Self::Table(table) => {
                let yaw = (-direction.x).atan2(-direction.z);
                let pitch = direction.y.atan2(direction.x.hypot(direction.z));
                let within = table.back.find(DVec2::new(yaw, pitch))?;
                Some(table.grid.place_within(&within))
            }
        }
    }

    /// Solid angle filled by the picture's light at a place, per unit of the picture's area, steradians.
    ///
    /// *Accuracy.* Differences over 1e-4 of the picture: 1e-7 for pinhole and scanner.
    pub fn solid_angle(&self, place: DVec2) -> Option<f64> {
        let reach = match self {
            Self::Table(table) => DVec2::new(1.0 / f64::from(table.grid.columns), 1.0 / f64::from(table.grid.rows)),
            _ => DVec2::splat(1e-4),
        };
        let side = |step: DVec2| {
            // A table ends at the picture's edges; the other lenses may go beyond.
            let (mut from, mut to) = (place - step, place + step);
            if matches!(self, Self::Table(_)) {
                (from, to) = (from.clamp(DVec2::ZERO, DVec2::ONE), to.clamp(DVec2::ZERO, DVec2::ONE));
            }
            Some((self.direction(to)? - self.direction(from)?) / (to - from).length())
        };
        Some(side(DVec2::new(reach.x, 0.0))?.cross(side(DVec2::new(0.0, reach.y))?).length())
    }
}
