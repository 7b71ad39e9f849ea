//! Fronts assembled from the bays of their pictures: whole storeys, and gables that the roof cuts off.

use glam::{Vec2, vec2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, MeshCorner, SiteFrame, Tint};
use super::paint::{ground_floors, timber};
use super::surface::TownSurface;

/// Bay of a storey, upright in a frame's plane.
pub(super) struct Bay {
    pub(super) surface: TownSurface,
    pub(super) tint: Tint,
    /// Index of the bay in the picture.
    pub(super) cell: usize,
    pub(super) across: [f32; 2],
    pub(super) height: [f32; 2],
}

impl Bay {
    pub(super) fn build(&self, builder: &mut Builder, frame: &SiteFrame) {
        let [left, right] = self.across;
        let [bottom, top] = self.height;
        let corner = |x: f32, y: f32, u: usize, v: f32| {
            MeshCorner::new(frame.point(x, y, 0.0), vec2((self.cell + u) as f32 / timber::BAYS as f32, v))
        };
        let corners = [
            corner(left, bottom, 0, 1.0),
            corner(right, bottom, 1, 1.0),
            corner(right, top, 1, 0.0),
            corner(left, top, 0, 0.0),
        ];
        builder.face(self.surface, self.tint, &corners);
    }
}

/// Kinds of the bays of a ground floor: at least one door, otherwise windows and shops.
pub(super) fn ground_bays(bays: usize, dice: &mut ChaCha8Rng) -> Vec<usize> {
    use ground_floors::{ARCH, BARE, DOOR, GROUND_WINDOWS, SHOP};
    let mut cells: Vec<usize> = (0..bays)
        .map(|_| match dice.random_range(0..10) {
            0..3 => SHOP,
            3..5 => GROUND_WINDOWS[1],
            5..9 => GROUND_WINDOWS[0],
            _ => BARE,
        })
        .collect();
    let place = dice.random_range(0..bays);
    cells[place] = if dice.random_bool(0.35) { ARCH } else { DOOR };
    if cells[place] == ARCH && bays > 2 {
        cells[(place + 1) % bays] = DOOR;
    }
    cells
}

/// Kinds of the bays of an upper storey: windows, with braced bays at the corners of wide fronts; symmetric.
pub(super) fn upper_bays(bays: usize, dice: &mut ChaCha8Rng) -> Vec<usize> {
    let window = timber::WINDOWS[dice.random_range(0..timber::WINDOWS.len())];
    let other = timber::WINDOWS[dice.random_range(0..timber::WINDOWS.len())];
    let blind = timber::BLIND[dice.random_range(0..timber::BLIND.len())];
    let braced = bays > 2 && dice.random_bool(0.45);
    (0..bays)
        .map(|k| {
            let from_edge = k.min(bays - 1 - k);
            match from_edge {
                0 if braced => blind,
                0 => window,
                _ => other,
            }
        })
        .collect()
}

/// Gable over the street, in a frame whose origin is its lower left corner.
pub(super) struct Gable {
    pub(super) surface: TownSurface,
    pub(super) tint: Tint,
    pub(super) width: f32,
    /// Height at which the roof's slopes meet, metres.
    pub(super) height: f32,
    pub(super) bays: usize,
    pub(super) timbered: bool,
    /// Share of the height at which a hip cuts the gable off; `None` for no hip.
    pub(super) hip: Option<f32>,
}

/// Height of a storey in a gable, and of its windows' upper edges, metres.
const STOREY: f32 = 2.45;
const HEAD: f32 = 2.1;

impl Gable {
    pub(super) fn build(&self, builder: &mut Builder, frame: &SiteFrame, dice: &mut ChaCha8Rng) {
        let top = self.height * self.hip.unwrap_or(1.0);
        let rows = (top / STOREY).ceil() as usize;
        for row in 0..rows {
            let low = row as f32 * STOREY;
            let high = (low + STOREY).min(top);
            let (windows, cell) = self.windows(low, top, dice);
            let blind = timber::BLIND[dice.random_range(0..2)];
            let reach = self.bays as i32 + 1;
            for k in -reach..=reach {
                let cell = if (0..windows as i32).contains(&k) { cell } else { blind };
                self.cut_bay(builder, frame, (k as f32 - windows as f32 / 2.0, cell), [low, high]);
            }
        }
    }

    /// Number of windows for which a storey from height `low` has room, and their bay in the picture.
    fn windows(&self, low: f32, top: f32, dice: &mut ChaCha8Rng) -> (usize, usize) {
        let bay = self.width / self.bays as f32;
        let free = self.width * (1.0 - (low + HEAD) / self.height);
        // Shutters need room beside the window.
        let needed = if self.timbered { 1.35 } else { 2.2 };
        let cell = if self.timbered && free < 2.6 { 1 } else { timber::WINDOWS[dice.random_range(0..4)] };
        if low + HEAD > top || free < needed {
            return (0, cell);
        }
        ((((free - needed) / bay) as usize + 1).min(self.bays), cell)
    }

    /// Builds the part below the roof of a bay that begins `place` bays right of the middle.
    fn cut_bay(&self, builder: &mut Builder, frame: &SiteFrame, (place, cell): (f32, usize), [low, high]: [f32; 2]) {
        let middle = self.width / 2.0;
        let bay = self.width / self.bays as f32;
        let left = middle + place * bay;
        let square = [vec2(left, low), vec2(left + bay, low), vec2(left + bay, high), vec2(left, high)];
        // Keep the part below the two slopes: x/middle ≥ y/height on the left, mirrored on the right.
        let cut = clip(&square, vec2(-1.0 / middle, 1.0 / self.height), 0.0);
        let mut cut = clip(&cut, vec2(1.0 / middle, 1.0 / self.height), 2.0);
        // Points coincide where a slope passes through a corner.
        cut.dedup_by(|a, b| a.distance(*b) < 0.005);
        let twice_area: f32 = cut.windows(2).map(|pair| (pair[0] - cut[0]).perp_dot(pair[1] - cut[0])).sum();
        if cut.len() < 3 || twice_area < 0.002 {
            return;
        }
        let corner = |p: &Vec2| {
            let u = (cell as f32 + (p.x - left) / bay) / timber::BAYS as f32;
            MeshCorner::new(frame.point(p.x, p.y, 0.0), vec2(u, 1.0 - (p.y - low) / STOREY))
        };
        builder.face(self.surface, self.tint, &cut.iter().map(corner).collect::<Vec<_>>());
    }
}

/// Keeps the part of a convex polygon where `normal · p ≤ offset`.
fn clip(polygon: &[Vec2], normal: Vec2, offset: f32) -> Vec<Vec2> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &p) in polygon.iter().enumerate() {
        let q = polygon[(k + 1) % polygon.len()];
        let (a, b) = (normal.dot(p) - offset, normal.dot(q) - offset);
        if a <= 0.0 {
            kept.push(p);
        }
        if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
            kept.push(p.lerp(q, a / (a - b)));
        }
    }
    kept
}
