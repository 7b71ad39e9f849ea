//! Maps from a channel's viewport to its picture, where the two differ: nudged corners and measured grids.

use crate::net::{EvenGrid, TriangleNet};
use crate::unit_square::inside;
use glam::{DMat3, DVec2, DVec3};
use std::sync::Arc;
use thiserror::Error;

/// Corners that do not form a convex quadrilateral.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the corners make no convex quadrilateral in the order upper left, upper right, lower right, lower left")]
pub struct NotConvex;

/// Map from places of the viewport to places of the picture; both 0 to 1, x right, y down.
#[derive(Clone, Debug, PartialEq)]
pub enum Warp {
    /// A picture drawn into a quadrilateral, as a keystone correction does.
    Corners(CornerWarp),
    /// A map measured at an even grid.
    Grid(MeasuredWarp),
}

/// Projective map that takes the picture's corners to given places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CornerWarp {
    /// Places in the viewport of the picture's upper left, upper right, lower right and lower left corners.
    pub places: [DVec2; 4],
    picture_from_viewport: DMat3,
    viewport_from_picture: DMat3,
}

impl CornerWarp {
    /// Creates a map from the places in the viewport of the picture's upper left, upper right, lower right and lower
    /// left corners.
    ///
    /// *Equation.* Heckbert, Fundamentals of Texture Mapping and Image Warping (1989), 2.2.3.
    ///
    /// # Errors
    /// [`NotConvex`].
    pub fn new(places: [DVec2; 4]) -> Result<Self, NotConvex> {
        let convex = (0..4).all(|i| {
            let [a, b, c] = [places[i], places[(i + 1) % 4], places[(i + 2) % 4]];
            // y points down, so clockwise on the screen is positive here.
            (b - a).perp_dot(c - b) > 1e-9
        });
        if !convex {
            return Err(NotConvex);
        }
        let [p0, p1, p2, p3] = places;
        let (d1, d2, sum) = (p1 - p2, p3 - p2, p0 - p1 + p2 - p3);
        let denominator = d1.perp_dot(d2);
        let (g, h) = (sum.perp_dot(d2) / denominator, d1.perp_dot(sum) / denominator);
        let viewport_from_picture =
            DMat3::from_cols((p1 - p0 + g * p1).extend(g), (p3 - p0 + h * p3).extend(h), p0.extend(1.0));
        Ok(Self { places, picture_from_viewport: viewport_from_picture.inverse(), viewport_from_picture })
    }
}

/// Measured map: piecewise linear over an even grid, the first sample in the viewport's upper left corner. Copies share
/// their samples.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredWarp {
    grid: EvenGrid,
    places: Arc<Vec<DVec2>>,
    back: Arc<TriangleNet>,
}

impl MeasuredWarp {
    /// Creates a map from `columns` × `rows` places in the picture, at least two each way, the top row first. A place
    /// that is not finite is unknown.
    pub fn new(columns: u32, rows: u32, places: Vec<DVec2>) -> Self {
        let grid = EvenGrid { columns, rows };
        let places = Arc::new(places);
        let back = Arc::new(TriangleNet::new(Arc::clone(&places), &grid.triangles()));
        Self { grid, places, back }
    }
}

impl Warp {
    /// Place of the picture at a place of the viewport; `None` if the picture does not reach there.
    pub fn picture(&self, viewport: DVec2) -> Option<DVec2> {
        let place = match self {
            Self::Corners(corners) => project(corners.picture_from_viewport, viewport)?,
            Self::Grid(measured) => measured.grid.find(viewport)?.mix(&measured.places),
        };
        inside(place).then_some(place)
    }

    /// Place of the viewport that shows a place of the picture, if there is one.
    pub fn viewport(&self, picture: DVec2) -> Option<DVec2> {
        let place = match self {
            Self::Corners(corners) => project(corners.viewport_from_picture, picture)?,
            Self::Grid(measured) => {
                let within = measured.back.find(picture)?;
                measured.grid.place_within(&within)
            }
        };
        inside(place).then_some(place)
    }
}

fn project(matrix: DMat3, place: DVec2) -> Option<DVec2> {
    let DVec3 { x, y, z } = matrix * place.extend(1.0);
    (z > 0.0).then(|| DVec2::new(x, y) / z)
}
