//! Burghers' houses: a ground floor of stone or plaster, storeys that jut out one over the other, a steep roof.
//!
//! A front is assembled from the bays of its pictures, so that houses look different although they share pictures.
//! The walls follow the lot's quadrilateral, so that neighbours leave no gap.

use glam::{Vec3, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, SiteFrame, Tint};
use super::facade::{Bay, Gable, ground_bays, upper_bays};
use super::paint::{ground_floors, timber};
use super::plan::{Lot, ground};
use super::roof::{Roof, chimney, dormer};
use super::surface::TownSurface;

/// Depth of a house on a large enough lot, and width of a bay, metres.
const DEPTH: f32 = 9.0;
const BAY: f32 = 2.4;

/// Designer of houses, which remembers the last one so that neighbours differ.
#[derive(Default)]
pub(super) struct Builders {
    last_front: usize,
    last_ground_floor: usize,
    last_height: f32,
}

/// Measures of a finished house, for furnishing the street.
pub(super) struct House {
    /// Frame at the left end of the front, on the ground, facing the street.
    pub(super) frame: SiteFrame,
    pub(super) width: f32,
    /// Middle of each bay of the ground floor, metres, and its kind.
    pub(super) bays: Vec<(f32, usize)>,
    /// Distance by which the first upper storey juts out, and its height above the street, metres.
    pub(super) jetty: f32,
    pub(super) ground_floor: f32,
    /// Middles of first-floor windows, metres from the left end.
    pub(super) windows: Vec<f32>,
}

/// Storey from its floor to its ceiling, and the distance by which it juts out, metres.
struct Storey {
    bottom: f32,
    top: f32,
    juts: f32,
}

/// House under construction.
struct Design {
    frame: SiteFrame,
    width: f32,
    depth: f32,
    /// Lean of the left and right side walls, metres to the right per metre of depth.
    lean: [f32; 2],
    bays: usize,
    front: usize,
    ground_floor: usize,
    tint: Tint,
    /// Colour of walls without a picture of their own.
    wall: Tint,
    storeys: Vec<Storey>,
}

/// Linear colour of an sRGB colour, by a cubic that errs by less than 0.01.
pub(super) fn linear(colour: Vec3) -> Vec3 {
    colour * (colour * (colour * 0.305_306 + 0.682_171) + 0.012_523)
}

/// Random colour for roof tiles.
pub(super) fn roof_tint(dice: &mut ChaCha8Rng) -> Tint {
    let warm: f32 = dice.random_range(0.0..1.0);
    vec3(1.0, 0.96, 0.94).lerp(vec3(0.80, 0.72, 0.68), warm) * dice.random_range(0.85..1.1)
}

impl Builders {
    /// Builds a house on a lot.
    pub(super) fn house(&mut self, builder: &mut Builder, lot: &Lot, dice: &mut ChaCha8Rng) -> House {
        let design = self.design(lot, dice);
        let plan = ground_bays(design.bays, dice);
        design.build_ground_floor(builder, &plan);
        let windows = design.build_storeys(builder, dice);
        design.build_plain_walls(builder);
        if design.width < 6.4 || (design.width < 8.6 && dice.random_bool(0.6)) {
            design.roof_across(builder, dice);
        } else {
            design.roof_along(builder, dice);
        }
        let bay = design.width / design.bays as f32;
        House {
            frame: design.frame,
            width: design.width,
            bays: plan.iter().enumerate().map(|(k, &cell)| ((k as f32 + 0.5) * bay, cell)).collect(),
            jetty: design.storeys[1].juts,
            ground_floor: design.storeys[0].top,
            windows,
        }
    }

    /// Chooses materials and height of a house, unlike its neighbour.
    fn design(&mut self, lot: &Lot, dice: &mut ChaCha8Rng) -> Design {
        let pick = |dice: &mut ChaCha8Rng, count: usize, last: usize| (last + dice.random_range(1..count)) % count;
        self.last_front = pick(dice, timber::HOUSE_FRONTS, self.last_front);
        self.last_ground_floor = pick(dice, ground_floors::GROUND_FLOORS.len(), self.last_ground_floor);
        let front = &timber::FRONTS[self.last_front];
        let wash = if front.is_timbered() { Vec3::ONE } else { Vec3::ONE.lerp(pastel(dice), 0.8) };
        let tint = wash * dice.random_range(0.90..1.04);

        // Place it on its lot.
        let [a, b] = lot.front;
        let width = a.distance(b);
        let direction = (b - a) / width;
        let right = vec3(direction.x, 0.0, direction.y);
        let base = ground(a).min(ground(b)) - 0.03;
        let lean = lot.sides.map(|side| side.dot(direction));
        let closing = lean[0] - lean[1];

        // Stack the storeys.
        let first = dice.random_range(2.9..3.3);
        let upper = if lot.at_square { dice.random_range(2..4) } else { [1, 2, 2, 2, 3][dice.random_range(0..5)] };
        let mut height = first + dice.random_range(2.5..2.8) * upper as f32;
        if (height - self.last_height).abs() < 0.35 {
            height += 0.5;
        }
        self.last_height = height;
        let storey = (height - first) / upper as f32;
        let jetty = if front.is_timbered() { dice.random_range(0.16..0.34) } else { 0.0 };
        let mut storeys = vec![Storey { bottom: 0.0, top: first, juts: 0.0 }];
        storeys.extend((0..upper).map(|k| {
            let bottom = first + storey * k as f32;
            Storey { bottom, top: bottom + storey, juts: jetty * (1.0 + 0.45 * k as f32) }
        }));

        Design {
            frame: SiteFrame { origin: vec3(a.x, base, a.y), right, up: Vec3::Y, out: right.cross(Vec3::Y) },
            width,
            depth: if closing > 0.0 { (0.6 * width / closing).min(DEPTH) } else { DEPTH },
            lean,
            bays: (width / BAY).round().max(1.0) as usize,
            front: self.last_front,
            ground_floor: self.last_ground_floor,
            tint,
            wall: tint * linear(front.plaster()) * 0.92,
            storeys,
        }
    }
}

impl Design {
    /// Height of the walls, and the distance by which the uppermost storey juts out, metres.
    fn top(&self) -> (f32, f32) {
        let top = &self.storeys[self.storeys.len() - 1];
        (top.top, top.juts)
    }

    /// Point of the left (0) or right (1) edge of the back wall at height `y`.
    fn back(&self, side: usize, y: f32) -> Vec3 {
        self.frame.point(side as f32 * self.width + self.lean[side] * self.depth, y, -self.depth)
    }

    /// Upper corners of the walls: left and right in front, right and left at the back.
    fn upper_corners(&self) -> [Vec3; 4] {
        let (y, z) = self.top();
        [self.frame.point(0.0, y, z), self.frame.point(self.width, y, z), self.back(1, y), self.back(0, y)]
    }

    /// Left and right ends of a bay, metres from the left end of the front.
    fn across(&self, k: usize) -> [f32; 2] {
        [k, k + 1].map(|k| self.width * k as f32 / self.bays as f32)
    }

    fn build_ground_floor(&self, builder: &mut Builder, plan: &[usize]) {
        for (k, &cell) in plan.iter().enumerate() {
            let surface = TownSurface::GroundFloor(self.ground_floor);
            let tint = Vec3::ONE.lerp(self.tint, 0.5);
            let height = [0.0, self.storeys[0].top];
            Bay { surface, tint, cell, across: self.across(k), height }.build(builder, &self.frame);
        }
    }

    /// Builds the fronts of the upper storeys and the undersides seen from below; returns the middles of first-floor
    /// windows.
    fn build_storeys(&self, builder: &mut Builder, dice: &mut ChaCha8Rng) -> Vec<f32> {
        let mut windows = vec![];
        for pair in self.storeys.windows(2) {
            let (below, storey) = (&pair[0], &pair[1]);
            let plane = self.frame.at(0.0, 0.0, storey.juts);
            for (k, cell) in upper_bays(self.bays, dice).into_iter().enumerate() {
                let across = self.across(k);
                if below.bottom == 0.0 && timber::WINDOWS.contains(&cell) {
                    windows.push((across[0] + across[1]) / 2.0);
                }
                let height = [storey.bottom, storey.top];
                Bay { surface: TownSurface::Front(self.front), tint: self.tint, cell, across, height }
                    .build(builder, &plane);
            }
            if storey.juts > below.juts {
                let under = |x: f32, z: f32, light: f32| (self.frame.point(x, storey.bottom, z), light);
                let (w, inner, outer) = (self.width, below.juts, storey.juts);
                let corners =
                    [under(0.0, inner, 0.35), under(w, inner, 0.35), under(w, outer, 0.8), under(0.0, outer, 0.8)];
                builder.lit(TownSurface::Planks, Vec3::splat(0.9), &corners);
            }
        }
        windows
    }

    /// Builds the party walls and the back.
    fn build_plain_walls(&self, builder: &mut Builder) {
        let p = |x: f32, y: f32, z: f32| self.frame.point(x, y, z);
        for storeys in self.storeys.chunk_by(|a, b| a.juts == b.juts) {
            let (bottom, top, z) = (storeys[0].bottom, storeys[storeys.len() - 1].top, storeys[0].juts);
            for (side, x) in [0.0, self.width].into_iter().enumerate() {
                let corners = [self.back(side, bottom), p(x, bottom, z), p(x, top, z), self.back(side, top)];
                let out = self.frame.right * (2.0 * side as f32 - 1.0);
                builder.facing(TownSurface::Plaster, self.wall, &corners, out);
            }
        }
        let (top, _) = self.top();
        let corners = [self.back(1, 0.0), self.back(0, 0.0), self.back(0, top), self.back(1, top)];
        builder.facing(TownSurface::Plaster, self.wall, &corners, -self.frame.out);
    }

    /// Builds a roof whose gable faces the street.
    fn roof_across(&self, builder: &mut Builder, dice: &mut ChaCha8Rng) {
        let (top, juts) = self.top();
        let walls = self.upper_corners();
        let hip = dice.random_bool(0.3).then_some(0.62);
        let roof = Roof {
            walls,
            height: dice.random_range(1.15..1.45) * self.width / 2.0,
            overhang: [0.22, 0.38, 0.15],
            hips: [hip, None],
            surface: TownSurface::Tiles,
            near: Some((self.frame.origin, self.frame.out, 3.0)),
            tint: roof_tint(dice),
        };
        roof.build(builder);
        let gable = Gable {
            surface: TownSurface::Front(self.front),
            tint: self.tint,
            width: self.width,
            height: roof.height,
            bays: self.bays,
            timbered: timber::FRONTS[self.front].is_timbered(),
            hip,
        };
        gable.build(builder, &self.frame.at(0.0, top, juts), dice);
        let [_, end] = roof.ridge();
        builder.facing(TownSurface::Plaster, self.wall, &[walls[2], walls[3], end], -self.frame.out);
        let x = self.width / 2.0 + dice.random_range(-0.9..0.9);
        let z = -self.depth * dice.random_range(0.3..0.7);
        if dice.random_bool(0.7) {
            chimney(builder, &self.frame.at(x, top + roof.height - 1.6, z), 2.4, Vec3::splat(0.9));
        }
    }

    /// Builds a roof whose eaves run along the street, with dormers.
    fn roof_along(&self, builder: &mut Builder, dice: &mut ChaCha8Rng) {
        let (top, juts) = self.top();
        let [a, b, c, d] = self.upper_corners();
        let span = self.depth + juts;
        let tint = roof_tint(dice);
        let roof = Roof {
            walls: [b, c, d, a],
            height: dice.random_range(1.15..1.45) * span / 2.0,
            overhang: [0.42, 0.12, 0.12],
            hips: [None, None],
            surface: TownSurface::Tiles,
            near: Some((self.frame.origin, self.frame.out, 3.0)),
            tint,
        };
        roof.build(builder);
        let [right_end, left_end] = roof.ridge();
        builder.facing(TownSurface::Plaster, self.wall, &[b, c, right_end], self.frame.right);
        builder.facing(TownSurface::Plaster, self.wall, &[d, a, left_end], -self.frame.right);
        let slope = 2.0 * roof.height / span;
        let inset = 0.75;
        let dormers = dice.random_range(1..if self.width > 7.4 { 4 } else { 3 });
        for k in 0..dormers {
            let x = self.width * (k as f32 + 0.5) / dormers as f32;
            let foot = self.frame.at(x, top + 0.1 + inset * slope, juts - inset);
            dormer(builder, &foot, slope, self.front, tint);
        }
        if dice.random_bool(0.7) {
            let x = self.width * dice.random_range(0.15..0.85);
            let foot = self.frame.at(x, top + roof.height - 1.3, juts - span * 0.56);
            chimney(builder, &foot, 2.3, Vec3::splat(0.9));
        }
    }
}

/// Random light colour for plaster.
fn pastel(dice: &mut ChaCha8Rng) -> Tint {
    [
        vec3(1.0, 0.93, 0.78),
        vec3(1.0, 0.78, 0.70),
        vec3(0.80, 0.95, 0.80),
        vec3(0.76, 0.88, 1.0),
        vec3(1.0, 0.86, 0.55),
        vec3(1.0, 1.0, 1.0),
    ][dice.random_range(0..6)]
}
