//! Streets of a scene: all places that can be reached on the ground from its circuit without passing a wall.

use std::collections::{HashSet, VecDeque};

use glam::DVec3;
use scene::Surroundings;

/// Side of a cell, metres.
const CELL_M: f64 = 0.25;
/// Least distance of a cell's middle from a wall, metres: that of a vehicle's middle, less half a cell's diagonal.
const CLEAR_M: f64 = 0.2;
/// Greatest height of a vehicle above the ground on which it rides fast, metres. It climbs and sees walls from there.
const LIFTED_M: f64 = 0.25;
/// Greatest rise from a cell to the next, metres: a kerb's from that height.
const RISE_M: f64 = scene::collision::STEP + LIFTED_M;

/// Cells that are connected with the circuit.
pub struct Streets {
    cells: HashSet<[i32; 2]>,
}

impl Streets {
    /// Spreads from the corners of the circuit over the ground, as far as walls let it.
    pub fn of(surroundings: &dyn Surroundings) -> Self {
        let mut cells = HashSet::new();
        let mut next: VecDeque<([i32; 2], f64)> =
            surroundings.circuit().iter().map(|corner| (cell(*corner), corner.y)).collect();
        while let Some((at, from_y)) = next.pop_front() {
            if cells.contains(&at) {
                continue;
            }
            let middle = DVec3::new(f64::from(at[0]) * CELL_M, from_y, f64::from(at[1]) * CELL_M);
            let Some(ground) = surroundings.height_below(middle + LIFTED_M * DVec3::Y) else { continue };
            let place = DVec3 { y: ground.height, ..middle };
            let is_street = (ground.height - from_y).abs() < RISE_M;
            if !is_street || surroundings.nearest_wall(place + LIFTED_M * DVec3::Y, CLEAR_M).is_some() {
                continue;
            }
            cells.insert(at);
            let around = (-1..=1).flat_map(|x| (-1..=1).map(move |z| [at[0] + x, at[1] + z]));
            next.extend(around.map(|beside| (beside, ground.height)));
        }
        Self { cells }
    }

    /// True if a place is in a cell of the streets, or beside one.
    pub fn hold(&self, place: DVec3) -> bool {
        let [x, z] = cell(place);
        (-1..=1).any(|right| (-1..=1).any(|back| self.cells.contains(&[x + right, z + back])))
    }

    /// Area of the streets, square metres.
    pub fn area_m2(&self) -> f64 {
        self.cells.len() as f64 * CELL_M * CELL_M
    }
}

/// Cell whose middle is nearest.
fn cell(place: DVec3) -> [i32; 2] {
    [place.x, place.z].map(|along| (along / CELL_M).round() as i32)
}
