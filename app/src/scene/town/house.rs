//! Burghers' houses: a ground floor of stone or plaster, storeys that jut out one over the other, a steep roof.
//!
//! A front is put together from the bays of its pictures, so that no two houses look alike although pictures are
//! shared. The lot's quadrilateral is kept for the walls, so that neighbours leave no gap.

use glam::{Vec2, Vec3, vec2, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, Corner, Frame, Tint};
use super::paint::{openings, timber};
use super::plan::{Lot, ground};
use super::roof::{Roof, chimney, clip, dormer};
use super::surface::Surface;

/// Decides how houses look, and remembers the last one so that neighbours differ.
#[derive(Default)]
pub(super) struct Builders {
    last_front: usize,
    last_ground_floor: usize,
    last_height: f32,
}

/// What was built, for those who furnish the street.
pub(super) struct House {
    /// At the left end of the front, on the ground, looking out onto the street.
    pub(super) frame: Frame,
    pub(super) width: f32,
    /// Middles of the bays of the ground floor and what each is.
    pub(super) bays: Vec<(f32, usize)>,
    /// How far the first upper storey juts out, and its height above the street.
    pub(super) jetty: f32,
    pub(super) ground_floor: f32,
    /// Middles of first-floor windows.
    pub(super) windows: Vec<f32>,
}

/// sRGB to linear, by a cubic that errs by less than 0.01.
pub(super) fn linear(colour: Vec3) -> Vec3 {
    colour * (colour * (colour * 0.305_306 + 0.682_171) + 0.012_523)
}

/// A colour out of a few for roof tiles.
pub(super) fn roof_tint(dice: &mut ChaCha8Rng) -> Tint {
    let warm: f32 = dice.random_range(0.0..1.0);
    vec3(1.0, 0.96, 0.94).lerp(vec3(0.80, 0.72, 0.68), warm) * dice.random_range(0.85..1.1)
}

impl Builders {
    /// Builds a house on a lot.
    pub(super) fn house(&mut self, builder: &mut Builder, lot: &Lot, dice: &mut ChaCha8Rng) -> House {
        // Choose what it is made of.
        let pick = |dice: &mut ChaCha8Rng, count: usize, last: usize| (last + dice.random_range(1..count)) % count;
        let front = pick(dice, timber::HOUSE_FRONTS, self.last_front);
        let ground_floor = pick(dice, openings::GROUND_FLOORS.len(), self.last_ground_floor);
        (self.last_front, self.last_ground_floor) = (front, ground_floor);
        let timbered = timber::FRONTS[front].is_timbered();
        let tint = Vec3::splat(dice.random_range(0.90..1.04))
            * if timbered { Vec3::ONE } else { Vec3::ONE.lerp(pastel(dice), 0.8) };
        let wall = tint * linear(timber::FRONTS[front].plaster());
        let [a, b] = lot.front;
        let base = ground(a).min(ground(b)) - 0.03;
        let width = a.distance(b);
        let direction = (b - a) / width;
        let right = vec3(direction.x, 0.0, direction.y);
        let frame = Frame { origin: vec3(a.x, base, a.y), right, up: Vec3::Y, out: right.cross(Vec3::Y) };
        let depth = depth_of(lot, width, direction);
        let lean = lot.sides.map(|side| side.dot(direction));
        let bays = (width / 2.4).round().max(1.0) as usize;

        // Stack the storeys.
        let first = dice.random_range(2.9..3.3);
        let upper = if lot.at_square { dice.random_range(2..4) } else { [1, 2, 2, 2, 3][dice.random_range(0..5)] };
        let storey: f32 = dice.random_range(2.5..2.8);
        let mut height = first + storey * upper as f32;
        if (height - self.last_height).abs() < 0.35 {
            height += 0.5;
        }
        self.last_height = height;
        let storey = (height - first) / upper as f32;
        let jetty = if timbered { dice.random_range(0.16..0.34) } else { 0.0 };
        let mut levels = vec![(0.0, first, 0.0)];
        for k in 0..upper {
            let bottom = first + storey * k as f32;
            let juts = jetty * if k == 0 { 1.0 } else { 1.0 + 0.45 * k as f32 };
            levels.push((bottom, bottom + storey, juts));
        }

        // Front walls, bay by bay.
        let plan = ground_bays(bays, dice);
        let bay = width / bays as f32;
        let mut windows = vec![];
        for (k, &cell) in plan.iter().enumerate() {
            let x = k as f32 * bay;
            storey_bay(
                builder,
                Surface::GroundFloor(ground_floor),
                Vec3::ONE.lerp(tint, 0.5),
                &frame,
                [x, x + bay],
                [0.0, first],
                0.0,
                cell,
            );
        }
        for (level, &(bottom, top, juts)) in levels.iter().enumerate().skip(1) {
            let cells = upper_bays(bays, dice);
            for (k, &cell) in cells.iter().enumerate() {
                let x = k as f32 * bay;
                if level == 1 && timber::WINDOWS.contains(&cell) {
                    windows.push(x + bay / 2.0);
                }
                storey_bay(builder, Surface::Front(front), tint, &frame, [x, x + bay], [bottom, top], juts, cell);
            }
            let before = levels[level - 1].2;
            if juts > before {
                let under = |x: f32, z: f32| frame.point(x, bottom, z);
                builder.lit(
                    Surface::Planks,
                    Vec3::splat(0.9),
                    &[
                        (under(0.0, before), 0.35),
                        (under(width, before), 0.35),
                        (under(width, juts), 0.8),
                        (under(0.0, juts), 0.8),
                    ],
                );
            }
        }

        // Party walls and the back.
        let back =
            |side: usize, y: f32| frame.point(if side == 0 { 0.0 } else { width } + lean[side] * depth, y, -depth);
        for &(bottom, top, juts) in &levels {
            for (side, x) in [0.0, width].into_iter().enumerate() {
                let corners =
                    [back(side, bottom), frame.point(x, bottom, juts), frame.point(x, top, juts), back(side, top)];
                builder.facing(Surface::Plaster, wall * 0.92, &corners, frame.right * (2.0 * side as f32 - 1.0));
            }
        }
        builder.facing(
            Surface::Plaster,
            wall * 0.9,
            &[back(1, 0.0), back(0, 0.0), back(0, height), back(1, height)],
            -frame.out,
        );

        // The roof, its ridge across the street or along it.
        let juts = levels[levels.len() - 1].2;
        let walls =
            [frame.point(0.0, height, juts), frame.point(width, height, juts), back(1, height), back(0, height)];
        let gable_to_street = if width > 8.6 {
            false
        } else if width < 6.4 {
            true
        } else {
            dice.random_bool(0.6)
        };
        let roof_colour = roof_tint(dice);
        let pitch = dice.random_range(1.15..1.45);
        if gable_to_street {
            let hip = dice.random_bool(0.3).then_some(0.62);
            let roof = Roof {
                walls,
                height: pitch * width / 2.0,
                overhang: [0.22, 0.38, 0.15],
                hips: [hip, None],
                surface: Surface::Tiles,
                near: true,
                tint: roof_colour,
            };
            gable(
                builder,
                Surface::Front(front),
                tint,
                &frame,
                &Gable { width, height: roof.height, bottom: height, juts, bays, timbered, hip },
                dice,
            );
            let [_, end] = roof.ridge();
            builder.facing(Surface::Plaster, wall * 0.9, &[walls[2], walls[3], end], -frame.out);
            roof.build(builder);
            let across = frame.at(
                width / 2.0 + dice.random_range(-0.9..0.9),
                height + roof.height - 1.6,
                -depth * dice.random_range(0.3..0.7),
            );
            chimney(builder, &across, 2.4, Vec3::splat(0.9));
        } else {
            let span = depth + juts;
            let roof = Roof {
                walls: [walls[1], walls[2], walls[3], walls[0]],
                height: pitch * span / 2.0,
                overhang: [0.42, 0.12, 0.12],
                hips: [None, None],
                surface: Surface::Tiles,
                near: true,
                tint: roof_colour,
            };
            let [right_end, left_end] = roof.ridge();
            builder.facing(Surface::Plaster, wall * 0.9, &[walls[1], walls[2], right_end], frame.right);
            builder.facing(Surface::Plaster, wall * 0.9, &[walls[3], walls[0], left_end], -frame.right);
            roof.build(builder);
            let slope = 2.0 * roof.height / span;
            let dormers = if width > 7.4 { dice.random_range(1..4) } else { dice.random_range(1..3) };
            for k in 0..dormers {
                let x = width * (k as f32 + 0.5) / dormers as f32;
                let inset = 0.75;
                dormer(builder, &frame.at(x, height + 0.1 + inset * slope, juts - inset), slope, front, roof_colour);
            }
            let x = width * dice.random_range(0.15..0.85);
            chimney(builder, &frame.at(x, height + roof.height - 1.3, juts - span * 0.56), 2.3, Vec3::splat(0.9));
        }
        let middles = plan.iter().enumerate().map(|(k, &cell)| ((k as f32 + 0.5) * bay, cell)).collect();
        House { frame, width, bays: middles, jetty: levels[1].2, ground_floor: first, windows }
    }
}

/// A light colour to wash plaster with.
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

/// Depth of a house: about nine metres, less where its side lines run together.
fn depth_of(lot: &Lot, width: f32, direction: Vec2) -> f32 {
    let closing = lot.sides[0].dot(direction) - lot.sides[1].dot(direction);
    if closing > 0.0 { (0.6 * width / closing).min(9.0) } else { 9.0 }
}

/// What the bays of a ground floor are: always a door, otherwise windows and shops.
fn ground_bays(bays: usize, dice: &mut ChaCha8Rng) -> Vec<usize> {
    use openings::{ARCH, BARE, DOOR, GROUND_WINDOWS, SHOP};
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

/// What the bays of an upper storey are: windows, with braced bays at the corners of wide fronts; symmetric.
fn upper_bays(bays: usize, dice: &mut ChaCha8Rng) -> Vec<usize> {
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

/// One bay of a storey.
#[expect(clippy::too_many_arguments, reason = "a bay is where, how large and what; a struct would only rename them")]
fn storey_bay(
    builder: &mut Builder,
    surface: Surface,
    tint: Tint,
    frame: &Frame,
    [left, right]: [f32; 2],
    [bottom, top]: [f32; 2],
    juts: f32,
    cell: usize,
) {
    let bays = timber::BAYS as f32;
    let [u0, u1] = [cell as f32 / bays, (cell + 1) as f32 / bays];
    let corner = |x: f32, y: f32, u: f32, v: f32| Corner::new(frame.point(x, y, juts), vec2(u, v));
    builder.face(
        surface,
        tint,
        &[
            corner(left, bottom, u0, 1.0),
            corner(right, bottom, u1, 1.0),
            corner(right, top, u1, 0.0),
            corner(left, top, u0, 0.0),
        ],
    );
}

/// A gable over the street.
struct Gable {
    width: f32,
    height: f32,
    bottom: f32,
    juts: f32,
    bays: usize,
    timbered: bool,
    hip: Option<f32>,
}

/// The storeys of a gable, cut off by the roof.
fn gable(builder: &mut Builder, surface: Surface, tint: Tint, frame: &Frame, gable: &Gable, dice: &mut ChaCha8Rng) {
    const STOREY: f32 = 2.45;
    let middle = gable.width / 2.0;
    let bay = gable.width / gable.bays as f32;
    let top = gable.height * gable.hip.unwrap_or(1.0);
    let wide_at = |y: f32| gable.width * (1.0 - y / gable.height);
    let needed = if gable.timbered { 1.35 } else { 2.2 };
    let rows = (top / STOREY).ceil() as usize;
    for row in 0..rows {
        let low = row as f32 * STOREY;
        let high = (low + STOREY).min(top);
        let free = wide_at(low + 2.1);
        let windows =
            if low + 2.1 > top || free < needed { 0 } else { (((free - needed) / bay) as usize + 1).min(gable.bays) };
        let windows_cell = if gable.timbered && free < 2.6 { 1 } else { timber::WINDOWS[dice.random_range(0..4)] };
        let blind = timber::BLIND[dice.random_range(0..2)];
        let reach = gable.bays as i32 + 1;
        for k in -reach..=reach {
            let left = middle + (k as f32 - windows as f32 / 2.0) * bay;
            let cell = if (0..windows as i32).contains(&k) { windows_cell } else { blind };
            let square = [vec2(left, low), vec2(left + bay, low), vec2(left + bay, high), vec2(left, high)];
            // Below the roof's two slopes: x/middle ≥ y/height on the left, mirrored on the right.
            let steep = vec2(-1.0 / middle, 1.0 / gable.height);
            let cut = clip(&square, steep, 0.0);
            let cut = clip(&cut, vec2(1.0 / middle, 1.0 / gable.height), 2.0);
            if cut.len() < 3 {
                continue;
            }
            let corners: Vec<Corner> = cut
                .iter()
                .map(|p| {
                    let u = (cell as f32 + (p.x - left) / bay) / timber::BAYS as f32;
                    Corner::new(frame.point(p.x, gable.bottom + p.y, gable.juts), vec2(u, 1.0 - (p.y - low) / STOREY))
                })
                .collect();
            builder.face(surface, tint, &corners);
        }
    }
}
