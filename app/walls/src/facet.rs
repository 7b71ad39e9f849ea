//! Flat pictures that together show a surface that is not flat.
//!
//! The view of a curved screen is drawn into as few flat pictures as possible: into one, if all of it lies within a
//! pyramid around its middle; else into those faces of a cube around the eye on which it is seen. Each picture is as
//! fine as all but the finest pixels of the screen need.

use glam::{DMat3, DVec2, DVec3};
use view::Tangents;

/// Largest tangent that a single flat picture shows. Beyond it, six faces of a cube need fewer texels.
const WIDEST: f64 = 1.75;
/// Share of a screen's pixels that may be finer than the flat pictures. At a grazing angle pixels become arbitrarily
/// fine.
const COARSER_SHARE: f64 = 0.05;
/// Factor by which a cube's faces extend beyond their edges, so that texels beside an edge can be interpolated.
const SEAM: f64 = 1.0 + 1e-3;
/// Step of texture sizes. With multiples of it, a moving head does not need new textures for every frame.
const STEP: u32 = 32;
/// Step of texture sizes where no head moves.
const FINER_STEP: u32 = 8;

/// Points of a surface at an even grid of a viewport's places: rows from above, columns from the left.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceGrid {
    /// Number of columns and rows.
    pub size: [usize; 2],
    /// Points in room axes, metres; `None` where nothing is lit.
    pub points: Vec<Option<DVec3>>,
    /// Distance between neighbouring columns and rows, pixels of the viewport.
    pub pixels: DVec2,
    /// Side of a pixel for which flat pictures are fine enough.
    pub fineness: PixelSide,
}

/// Side of a pixel that is not square.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelSide {
    /// Side of a square of the same area: nothing is lost of the picture's pixels.
    Mean,
    /// The longer side. Beside the poles of a sphere's picture many pixels share what one shows elsewhere, and flat
    /// pictures as fine as these would be many times as large.
    Longer,
}

impl PixelSide {
    /// Side of a pixel whose sides are these.
    fn side(self, right: DVec2, down: DVec2) -> f64 {
        match self {
            Self::Mean => right.perp_dot(down).abs().sqrt(),
            Self::Longer => right.length().max(down.length()),
        }
    }

    /// Step of texture sizes, texels.
    fn step(self) -> u32 {
        match self {
            Self::Mean => STEP,
            // The eyes of these pictures do not move before them.
            Self::Longer => FINER_STEP,
        }
    }
}

/// Flat picture of a part of what an eye sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// Rotation from the facet's axes (x right, y up, −z ahead) to the room's.
    pub room_from_facet: DMat3,
    /// Rectangle of the plane ahead that the facet shows, as tangents.
    pub tangents: Tangents,
    /// Width and height, texels.
    pub size: [u32; 2],
    /// Largest tangent, to either side, of the directions that this facet shows.
    pub limit: f64,
}

impl Facet {
    /// Tangents of a direction of the room; `None` if this facet does not show it.
    fn place(&self, direction: DVec3) -> Option<DVec2> {
        let seen = self.room_from_facet.transpose() * direction;
        let place = seen.truncate() / -seen.z;
        (seen.z < 0.0 && place.abs().max_element() <= self.limit).then_some(place)
    }
}

/// Facets for an eye.
///
/// # Arguments
/// * `density` — texels for each pixel of the viewport, along each axis, where the pixels are finest.
/// * `largest` — largest side of a facet, texels. More would be needed only where a surface is seen at a grazing
///   angle.
pub fn facets(grid: &SurfaceGrid, eye: DVec3, density: f64, largest: u32) -> Vec<Facet> {
    let directions: Vec<_> =
        grid.points.iter().map(|point| Some((point.as_ref()? - eye).normalize_or_zero())).collect();
    let middle = directions.iter().flatten().sum::<DVec3>();
    let room_from_facet = towards(middle.try_normalize().unwrap_or(DVec3::NEG_Z));
    let unbound = Tangents { low: DVec2::ZERO, high: DVec2::ZERO };
    let facet =
        |turn: DMat3, limit| Facet { room_from_facet: room_from_facet * turn, tangents: unbound, size: [0, 0], limit };

    // A single facet is used if it can show all directions.
    let single = facet(DMat3::IDENTITY, WIDEST);
    let all = directions.iter().flatten().all(|direction| single.place(*direction).is_some());
    let candidates = if all { vec![single] } else { cube().map(|turn| facet(turn, SEAM)).to_vec() };
    candidates.into_iter().filter_map(|facet| sized(facet, grid, &directions, density, largest)).collect()
}

/// Facet with its bounds and size set by the directions it shows; `None` if there are none.
fn sized(facet: Facet, grid: &SurfaceGrid, directions: &[Option<DVec3>], density: f64, largest: u32) -> Option<Facet> {
    let [columns, rows] = grid.size;
    let at = |column: usize, row: usize| facet.place(directions[row * columns + column]?);
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let mut widest = DVec2::ZERO;
    // Side of a pixel, in tangents, for each cell of the grid.
    let mut sides = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let Some(here) = at(column, row) else { continue };
            (low, high) = (low.min(here), high.max(here));
            let next = |wanted: bool, column, row| if wanted { at(column, row) } else { None };
            let right = next(column + 1 < columns, column + 1, row).map(|there| there - here);
            let down = next(row + 1 < rows, column, row + 1).map(|there| there - here);
            widest = [right, down].into_iter().flatten().map(DVec2::abs).fold(widest, DVec2::max);
            if let (Some(right), Some(down)) = (right, down) {
                sides.push(grid.fineness.side(right / grid.pixels.x, down / grid.pixels.y));
            }
        }
    }
    sides.sort_by(f64::total_cmp);
    let finest = sides.get((sides.len() as f64 * COARSER_SHARE) as usize).copied().filter(|side| *side > 0.0);
    if low.x > high.x {
        return None;
    }
    // Between the grid's points, the surface may extend up to one step beyond the last point that this facet shows,
    // and its pixels are slightly finer there than at the points.
    let margin = DVec2::select(widest.cmpgt(DVec2::ZERO), widest, DVec2::splat(facet.limit));
    let bound = DVec2::splat(facet.limit * SEAM);
    let (low, high) = ((low - margin).max(-bound), (high + margin).min(bound));
    let step = grid.fineness.step();
    let wanted = finest.map_or(f64::from(step), |side| density / side);
    let most = f64::from(largest / step * step) / (high - low).max_element();
    let focal_length = wanted.min(most);
    let size = ((high - low) * focal_length).ceil();
    let size = [size.x, size.y].map(|side| (side as u32).max(1).next_multiple_of(step));
    let half = 0.5 * DVec2::new(f64::from(size[0]), f64::from(size[1])) / focal_length;
    let middle = 0.5 * (low + high);
    Some(Facet { tangents: Tangents { low: middle - half, high: middle + half }, size, ..facet })
}

/// Rotation from the axes of a picture that looks along `forward`, with its columns as upright as possible.
fn towards(forward: DVec3) -> DMat3 {
    let right = [DVec3::Y, DVec3::NEG_Z].into_iter().map(|up| forward.cross(up)).find(|right| right.length() > 1e-3);
    let right = right.map_or(DVec3::X, DVec3::normalize);
    DMat3::from_cols(right, right.cross(forward), -forward)
}

/// Rotations to the six faces of a cube: ahead, right, behind, left, above, below.
fn cube() -> [DMat3; 6] {
    let of = |x, y| DMat3::from_cols(x, y, x.cross(y));
    [
        of(DVec3::X, DVec3::Y),
        of(DVec3::Z, DVec3::Y),
        of(DVec3::NEG_X, DVec3::Y),
        of(DVec3::NEG_Z, DVec3::Y),
        of(DVec3::X, DVec3::Z),
        of(DVec3::X, DVec3::NEG_Z),
    ]
}

#[cfg(test)]
mod tests {
    //! Law under test: every point of a surface is shown by a facet, within the facet's bounds and finely enough. A
    //! wrong program leaves black gaps between facets, or blurs.

    use super::*;

    /// Part of a sphere of radius 2 about the origin, seen as a picture of 640 × 480 pixels.
    fn sphere(width_rad: f64, height_rad: f64) -> SurfaceGrid {
        let size = [41, 31];
        let mut points = Vec::new();
        for row in 0..size[1] {
            for column in 0..size[0] {
                let longitude = width_rad * (column as f64 / 40.0 - 0.5);
                let latitude = height_rad * (0.5 - row as f64 / 30.0);
                let level = DVec3::new(longitude.sin(), 0.0, -longitude.cos()) * latitude.cos();
                points.push(Some(2.0 * (level + DVec3::Y * latitude.sin())));
            }
        }
        SurfaceGrid { size, points, pixels: DVec2::new(16.0, 16.0), fineness: PixelSide::Mean }
    }

    #[test]
    fn every_point_is_shown_finely_enough() {
        for (width, height, count) in [(1.0, 0.8, 1), (2.0, 1.0, 1), (4.0, 2.0, 5), (6.2, 3.1, 6)] {
            let grid = sphere(width, height);
            for eye in [DVec3::ZERO, DVec3::new(0.3, -0.2, 0.4)] {
                let facets = facets(&grid, eye, 1.0, 8192);
                assert!(facets.len() <= count, "{} facets for {width} × {height}", facets.len());
                // Number of cells, and number of cells with less than one texel per pixel.
                let mut counts = [0, 0];
                for row in 0..30 {
                    for column in 0..40 {
                        let at = |column: usize, row: usize| {
                            (grid.points[row * 41 + column].unwrap_or_default() - eye).normalize()
                        };
                        let seen = at(column, row).lerp(at(column + 1, row + 1), 0.37);
                        let shown: Vec<_> =
                            facets.iter().filter_map(|facet| Some((facet, facet.place(seen)?))).collect();
                        assert!(!shown.is_empty(), "nothing shows {seen}");
                        for (facet, place) in shown {
                            assert!(place.cmpge(facet.tangents.low).all() && place.cmple(facet.tangents.high).all());
                            let place = |column, row| facet.place(at(column, row));
                            if let (Some(here), Some(right), Some(down)) =
                                (place(column, row), place(column + 1, row), place(column, row + 1))
                            {
                                let side = ((right - here).perp_dot(down - here).abs() / 256.0).sqrt();
                                counts[0] += 1;
                                let texels = side * facet.tangents.focal_length(facet.size).x;
                                counts[1] += usize::from(texels < 0.99);
                            }
                        }
                    }
                }
                let share = counts[1] as f64 / counts[0] as f64;
                assert!(share <= 1.2 * COARSER_SHARE, "{share} of the pixels have less than a texel");
            }
        }
    }

    #[test]
    fn sizes_keep_to_their_limit() {
        for facet in facets(&sphere(6.0, 3.0), DVec3::new(1.9, 0.0, 0.0), 4.0, 512) {
            assert!(facet.size.iter().all(|side| *side <= 512), "{:?}", facet.size);
        }
    }
}
