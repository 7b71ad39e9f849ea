//! Piecewise linear maps of the plane: the triangle in which a place lies, and the place's weights within it.
//!
//! Grids and meshes are linear within each triangle in both directions, so the inverse map undoes the map up to
//! rounding.

use crate::unit_square::inside;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Largest amount by which rounding may take a barycentric coordinate below 0.
pub(crate) const EDGE: f64 = 1e-9;

/// Largest number of entries in a net's buckets, for each triangle. Triangles that lie on top of one another get
/// larger buckets, so that the entries stay in proportion to the triangles.
const ENTRIES: usize = 8;

/// Largest number of triangles that are tried at one place. A net in which more lie on top of one another is none that
/// was measured, and what lies deeper is not found.
const DEEPEST: usize = 1 << 16;

/// Place within a triangle: the indices of the corners, and their weights, which sum to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WithinTriangle {
    pub corners: [u32; 3],
    pub weights: DVec3,
}

impl WithinTriangle {
    /// Weighted mean of the corners' values. A corner with weight 0 does not count, even if its value is unknown.
    pub fn mix<T>(&self, values: &[T]) -> T
    where
        T: Copy + Default + std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>,
    {
        let weighted = self.corners.iter().zip(self.weights.to_array()).filter(|(_, weight)| *weight != 0.0);
        weighted.fold(T::default(), |sum, (&corner, weight)| sum + values[corner as usize] * weight)
    }
}

/// Even grid over the unit square, row by row, with the first sample at (0, 0). Each cell is cut from its first
/// corner to the opposite one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EvenGrid {
    /// Number of samples along a row.
    pub columns: u32,
    /// Number of rows.
    pub rows: u32,
}

impl EvenGrid {
    /// Triangle at a place, and the weights there; `None` outside 0 to 1.
    pub fn find(self, place: DVec2) -> Option<WithinTriangle> {
        if !inside(place) {
            return None;
        }
        let cells = DVec2::new(f64::from(self.columns - 1), f64::from(self.rows - 1));
        let scaled = place.clamp(DVec2::ZERO, DVec2::ONE) * cells;
        let cell = scaled.floor().min(cells - 1.0);
        let (f, column, row) = (scaled - cell, cell.x as u32, cell.y as u32);
        let first = row * self.columns + column;
        let last = first + self.columns + 1;
        Some(if f.x >= f.y {
            WithinTriangle { corners: [first, first + 1, last], weights: DVec3::new(1.0 - f.x, f.x - f.y, f.y) }
        } else {
            WithinTriangle { corners: [first, last, last - 1], weights: DVec3::new(1.0 - f.y, f.x, f.y - f.x) }
        })
    }

    /// Place of a sample in the unit square.
    pub fn place(self, sample: u32) -> DVec2 {
        DVec2::new(f64::from(sample % self.columns), f64::from(sample / self.columns))
            / DVec2::new(f64::from(self.columns - 1), f64::from(self.rows - 1))
    }

    /// Place with the given weights within a triangle of samples.
    pub fn place_within(self, within: &WithinTriangle) -> DVec2 {
        let [a, b, c] = within.corners.map(|sample| self.place(sample));
        a * within.weights.x + b * within.weights.y + c * within.weights.z
    }

    /// Triangles of all cells, with the corners in the same order as in [`find`](Self::find).
    pub fn triangles(self) -> Vec<[u32; 3]> {
        let cells = (0..self.rows - 1).flat_map(|row| (0..self.columns - 1).map(move |column| (row, column)));
        cells
            .flat_map(|(row, column)| {
                let first = row * self.columns + column;
                let last = first + self.columns + 1;
                [[first, first + 1, last], [first, last, last - 1]]
            })
            .collect()
    }
}

/// Triangles in the plane, sorted into buckets so that the triangle at a place is found quickly.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TriangleNet {
    corners: Arc<Vec<DVec2>>,
    triangles: Vec<[u32; 3]>,
    lowest: DVec2,
    /// Number of buckets per unit of length, along each axis.
    scale: DVec2,
    side: usize,
    /// Index in `sorted` at which each bucket's triangles begin; one entry more than there are buckets.
    starts: Vec<u32>,
    sorted: Vec<u32>,
}

impl TriangleNet {
    /// Sorts triangles into buckets. A triangle without area, or with a corner that is not finite, is left out.
    pub fn new(corners: impl Into<Arc<Vec<DVec2>>>, triangles: &[[u32; 3]]) -> Self {
        let corners = corners.into();
        let good = |triangle: &&[u32; 3]| {
            let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
            let area = (b - a).perp_dot(c - a);
            area.is_finite() && area != 0.0
        };
        let triangles: Vec<[u32; 3]> = triangles.iter().filter(good).copied().collect();
        let used = || triangles.iter().flatten().map(|&corner| corners[corner as usize]);
        let lowest = used().fold(DVec2::INFINITY, DVec2::min);
        let highest = used().fold(DVec2::NEG_INFINITY, DVec2::max);
        let size = (highest - lowest).max(DVec2::splat(f64::MIN_POSITIVE));
        let mut side = ((triangles.len() as f64 / 2.0).sqrt() as usize).clamp(1, 2048);
        let mut net = Self {
            corners,
            triangles,
            lowest,
            scale: side as f64 / size,
            side,
            starts: Vec::new(),
            sorted: Vec::new(),
        };
        while side > 1 && net.entries() > ENTRIES * net.triangles.len() + side * side {
            side /= 2;
            (net.side, net.scale) = (side, side as f64 / size);
        }
        net.starts = vec![0; side * side + 1];

        // Counting sort: count, add up, fill.
        for index in 0..net.triangles.len() {
            for bucket in net.buckets(index) {
                net.starts[bucket + 1] += 1;
            }
        }
        for bucket in 0..side * side {
            net.starts[bucket + 1] += net.starts[bucket];
        }
        let mut next = net.starts.clone();
        net.sorted = vec![0; net.starts[side * side] as usize];
        for index in 0..net.triangles.len() {
            for bucket in net.buckets(index) {
                net.sorted[next[bucket] as usize] = index as u32;
                next[bucket] += 1;
            }
        }
        net
    }

    /// Triangle at a place, and the weights there. If several triangles overlap, it is the first in the given order.
    pub fn find(&self, place: DVec2) -> Option<WithinTriangle> {
        let scaled = (place - self.lowest) * self.scale;
        let [column, row] = self.bucket(scaled)?;
        let bucket = row * self.side + column;
        let range = self.starts[bucket] as usize..self.starts[bucket + 1] as usize;
        self.sorted[range].iter().take(DEEPEST).find_map(|&index| {
            let corners = self.triangles[index as usize];
            let [a, b, c] = corners.map(|corner| self.corners[corner as usize]);
            let area = (b - a).perp_dot(c - a);
            let weights = DVec3::new((b - place).perp_dot(c - place), (c - place).perp_dot(a - place), 0.0) / area;
            let weights = DVec3::new(weights.x, weights.y, 1.0 - weights.x - weights.y);
            (weights.min_element() >= -EDGE).then_some(WithinTriangle { corners, weights })
        })
    }

    fn bucket(&self, scaled: DVec2) -> Option<[usize; 2]> {
        let slack = EDGE * self.side as f64;
        let inside = scaled.min_element() >= -slack && scaled.max_element() <= self.side as f64 + slack;
        inside.then(|| scaled.to_array().map(|part| (part.max(0.0) as usize).min(self.side - 1)))
    }

    /// Number of entries of all buckets.
    fn entries(&self) -> usize {
        (0..self.triangles.len())
            .map(|index| self.reach(index))
            .fold(0, |sum, [low, high]| sum.saturating_add((high[0] - low[0] + 1) * (high[1] - low[1] + 1)))
    }

    /// Indices of the buckets that a triangle's bounding box touches.
    fn buckets(&self, index: usize) -> impl Iterator<Item = usize> + use<> {
        let ([low, high], side) = (self.reach(index), self.side);
        (low[1]..=high[1]).flat_map(move |row| (low[0]..=high[0]).map(move |column| row * side + column))
    }

    /// Column and row of the first and of the last bucket that a triangle's bounding box touches.
    fn reach(&self, index: usize) -> [[usize; 2]; 2] {
        let corners = self.triangles[index].map(|corner| (self.corners[corner as usize] - self.lowest) * self.scale);
        let slack = DVec2::splat(2.0 * EDGE * self.side as f64);
        let cell = |place: DVec2| place.max(DVec2::ZERO).to_array().map(|part| (part as usize).min(self.side - 1));
        let low = cell(corners[0].min(corners[1]).min(corners[2]) - slack);
        let high = cell(corners[0].max(corners[1]).max(corners[2]) + slack);
        [low, high]
    }
}

#[cfg(test)]
mod tests {
    //! Law: the entries of a net stay in proportion to its triangles, however they lie. A wrong program would take all
    //! memory for a warp of noise.

    use super::*;
    use rand::{RngExt, SeedableRng};

    #[test]
    fn noise_takes_as_much_as_order() {
        let grid = EvenGrid { columns: 150, rows: 150 };
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(11);
        let noise = (0..150 * 150).map(|_| DVec2::new(random.random(), random.random())).collect::<Vec<_>>();
        let even = (0..150 * 150).map(|sample| grid.place(sample)).collect::<Vec<_>>();
        for places in [noise, even] {
            let net = TriangleNet::new(places.clone(), &grid.triangles());
            let count = net.triangles.len();
            assert!(net.sorted.len() <= ENTRIES * count + net.side * net.side, "{} of {count}", net.sorted.len());
            // The middle of each triangle is found, in it or in one that lies above it.
            for corners in grid.triangles().iter().step_by(97) {
                let middle = corners.iter().map(|corner| places[*corner as usize]).sum::<DVec2>() / 3.0;
                assert!(net.find(middle).is_some_and(|found| (found.mix(&places) - middle).length() < 1e-9));
            }
        }
    }
}
