//! Rule that decides which edges are split, and what it makes of a scene.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::divide::divide;
use crate::mesh::Mesh;
use crate::scene::Scene;

/// Distance from the circuit within which edges are as short as asked for, metres.
pub const NEAR_M: f64 = 4.0;

/// Rule that decides which edges are split: those of finite length above `edge`, or above the longer limit at their
/// distance.
#[derive(Clone, Copy)]
pub struct SplitRule<'a> {
    edge: f64,
    squared: f64,
    /// Corners of the circuit, relative to the scene's origin; empty if the scene has none.
    circuit: &'a [DVec3],
}

impl<'a> SplitRule<'a> {
    /// Rule for edges up to `edge` metres; `circuit`: corners of the circuit, relative to the scene's origin.
    pub fn new(edge: f64, circuit: &'a [DVec3]) -> Self {
        Self { edge, squared: edge * edge, circuit }
    }

    /// True if an edge is to be split; the same from either end, as differences and sums of two do not depend on
    /// their order.
    pub fn splits(self, a: Vec3, b: Vec3) -> bool {
        let length_squared = distance_squared(a, b);
        length_squared > self.squared
            && length_squared.is_finite()
            && length_squared > self.squared * self.leniency(self.distance(midpoint(a, b).as_dvec3()))
    }

    /// Distance from the circuit's nearest corner, metres; 0 if there is none.
    fn distance(self, place: DVec3) -> f64 {
        let squared = self.circuit.iter().map(|corner| corner.distance_squared(place)).reduce(f64::min);
        squared.unwrap_or(0.0).sqrt()
    }

    /// Square of the factor by which an edge may be longer at a distance from the circuit.
    fn leniency(self, distance: f64) -> f64 {
        (distance / NEAR_M).max(1.0).powi(2)
    }

    /// Rule that decides the same within one triangle, with the corners of the circuit alone that may be nearest there;
    /// `kept` holds them.
    pub fn within<'b>(self, [a, b, c]: [Vec3; 3], kept: &'b mut Vec<DVec3>) -> SplitRule<'b> {
        let corners = [a, b, c].map(|corner| corner.as_dvec3());
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let radius = corners.iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max);
        // Midpoints are rounded to f32.
        let rounding = 1e-6 * corners.iter().map(|corner| corner.length()).fold(0.0, f64::max);
        let reach = self.distance(middle) + 2.0 * (radius + rounding);
        kept.clear();
        let reach = if reach.is_finite() { reach } else { f64::INFINITY };
        kept.extend(self.circuit.iter().filter(|corner| corner.distance(middle) <= reach || reach == f64::INFINITY));
        SplitRule { circuit: kept, ..self }
    }

    /// Midpoints of a triangle's edges (0–1, 1–2, 2–0) that are split.
    fn midpoints(self, [a, b, c]: [Vec3; 3]) -> [Option<Vec3>; 3] {
        [(a, b), (b, c), (c, a)].map(|(a, b)| self.splits(a, b).then(|| midpoint(a, b)))
    }

    /// Number of triangles of the refined scene, or `None` as soon as it exceeds the limit.
    pub fn count(self, scene: &Scene, limit: usize) -> Option<usize> {
        if self.at_least(scene) > limit as u64 {
            return None;
        }
        let total = AtomicUsize::new(0);
        scene.meshes.par_iter().try_for_each(|mesh| {
            let (mut stack, mut near) = (Vec::new(), Vec::new());
            triangles(mesh).try_for_each(|triangle| {
                let rule = self.within(triangle, &mut near);
                stack.push(triangle);
                let mut count = 0;
                while let Some(triangle) = stack.pop() {
                    let midpoints = rule.midpoints(triangle);
                    if midpoints == [None; 3] {
                        count += 1;
                    } else {
                        divide(triangle, midpoints, distance_squared, |child| {
                            stack.push(child);
                        });
                    }
                    if count > limit {
                        return None;
                    }
                }
                (total.fetch_add(count, Ordering::Relaxed) + count <= limit).then_some(())
            })
        })?;
        Some(total.into_inner())
    }

    /// Lower bound of that number without counting: no triangle of the result has more area than the equilateral one.
    pub fn at_least(self, scene: &Scene) -> u64 {
        let equilateral = 3.0_f64.sqrt() / 4.0 * self.squared;
        let bound = |triangle: [Vec3; 3]| {
            // No place of a triangle is further from the circuit than one corner is, plus the longest way from there.
            let [a, b, c] = triangle;
            let longest = distance_squared(a, b).max(distance_squared(a, c)).sqrt();
            let largest = equilateral * self.leniency(self.distance(a.as_dvec3()) + longest);
            let share = area(triangle) / largest;
            if share.is_finite() { share.max(1.0) } else { 1.0 }
        };
        scene.meshes.iter().flat_map(triangles).map(bound).sum::<f64>() as u64
    }

    /// Estimate of that number from the lengths of the edges alone, at once for any length: a triangle becomes four
    /// as long as its shortest edge is halved, then three for its two longer ones, then two.
    ///
    /// *Accuracy:* 1 to 2.2 times the number of a large scene, and at least 0.6 times that of any triangle
    /// (`tests.rs`).
    pub fn estimate(self, scene: &Scene) -> f64 {
        let of = |triangle: [Vec3; 3]| {
            let [a, b, c] = triangle;
            let mut lengths = [(a, b), (b, c), (c, a)].map(|(a, b)| distance_squared(a, b).sqrt());
            lengths.sort_by(f64::total_cmp);
            let nearest = if self.circuit.is_empty() { 0.0 } else { self.distance(a.as_dvec3()) - lengths[2] };
            let edge = self.edge * self.leniency(nearest).sqrt();
            let halvings = lengths.map(|length| (length / edge).log2().ceil().max(0.0));
            let [short, middle, long] = halvings;
            let number = 4.0_f64.powf(short) * 3.0_f64.powf(middle - short) * 2.0_f64.powf(long - middle);
            if number.is_finite() { number } else { 1.0 }
        };
        let of_mesh = |mesh: &Mesh| triangles(mesh).map(of).sum::<f64>();
        scene.meshes.par_iter().map(of_mesh).sum()
    }

    /// Distance to the next f32 at the largest coordinate of a triangle that is to be split; 0 if none is.
    pub fn coarsest_step(self, mesh: &Mesh) -> f32 {
        let split = triangles(mesh).filter(|&triangle| self.midpoints(triangle).iter().any(Option::is_some));
        let largest = split
            .flatten()
            .filter(|corner| corner.is_finite())
            .map(|corner| corner.abs().max_element())
            .fold(0.0, f32::max);
        if f64::from(largest) < self.edge { 0.0 } else { largest.next_up() - largest }
    }
}

/// Triangles of a mesh as positions.
pub fn triangles(mesh: &Mesh) -> impl Iterator<Item = [Vec3; 3]> {
    mesh.indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|corner| mesh.positions[corners[corner] as usize]))
}

/// Squared distance of two positions, square metres.
pub fn distance_squared(a: Vec3, b: Vec3) -> f64 {
    a.as_dvec3().distance_squared(b.as_dvec3())
}

/// Area of a triangle, square metres.
pub fn area([a, b, c]: [Vec3; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
    (b - a).cross(c - a).length() / 2.0
}

/// Midpoint of an edge, the same to the last bit from either end.
pub fn midpoint(a: Vec3, b: Vec3) -> Vec3 {
    a * 0.5 + b * 0.5
}
