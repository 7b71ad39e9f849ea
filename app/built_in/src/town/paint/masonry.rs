//! Stone, plaster, tiles and boards: pictures that repeat in both directions.

use glam::{IVec2, Vec2, Vec3, ivec2, vec2, vec3};

use crate::town::canvas::{PaintCanvas, chance, cloud, floor, noise, repeats, smoothstep, within};

/// Stone of a course, as seen from a point.
struct Stone {
    /// Signed distance of the point from its outline, negative inside, metres.
    distance: f32,
    /// Position of the point within it, −1…1 in both directions.
    place: Vec2,
    /// Identity of the stone, for its random numbers.
    id: IVec2,
}

/// Finds the stone at `p` in courses of stones with irregular joints.
///
/// `cells` are the numbers of stones along and of courses up a repetition of `tile` metres. `jitter` is the largest
/// shift of a joint, as a share of a stone. `round` is the radius of corners in metres.
fn course(p: Vec2, tile: Vec2, cells: IVec2, jitter: f32, round: f32, gap: f32, seed: u32) -> Stone {
    let cell = tile / cells.as_vec2();
    let row = floor(p.y / cell.y);
    let wrapped_row = within(row, cells.y);
    let shift = (chance(wrapped_row, 1, seed) + 0.5 * (wrapped_row % 2) as f32) * cell.x;
    let x = p.x + shift;
    let joint = |k: i32| {
        let wrapped = within(k, cells.x);
        (k as f32 + jitter * (chance(wrapped, wrapped_row, seed ^ 77) - 0.5)) * cell.x
    };
    let mut column = floor(x / cell.x);
    if x < joint(column) {
        column -= 1;
    } else if x >= joint(column + 1) {
        column += 1;
    }
    let (left, right) = (joint(column), joint(column + 1));
    let centre = vec2((left + right) / 2.0, (row as f32 + 0.5) * cell.y);
    let half = vec2((right - left) / 2.0, cell.y / 2.0) - gap / 2.0;
    let offset = vec2(x, p.y) - centre;
    let q = offset.abs() - half + round;
    let distance = q.max(Vec2::ZERO).length() + q.max_element().min(0.0) - round;
    Stone { distance, place: offset / half, id: ivec2(within(column, cells.x), wrapped_row) }
}

/// Relief of a rounded stone as a factor on its colour: bright on top, darker down its sides.
fn dome(stone: &Stone, edge: f32) -> f32 {
    let depth = smoothstep(0.0, edge, -stone.distance);
    0.62 + 0.38 * depth + 0.07 * (stone.place.y - 0.5 * stone.place.x) * (1.0 - 0.5 * depth)
}

/// Paints street cobbles in rows across the way.
pub(in crate::town) fn cobbles(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, tile, |p| {
        let wobble = vec2(noise(p * 4.0, ivec2(20, 20), seed), noise(p * 4.0, ivec2(20, 20), seed + 9)) * 0.012;
        let stone = course(p + wobble, tile, ivec2(26, 33), 0.45, 0.045, 0.016, seed);
        let own = chance(stone.id.x, stone.id.y, seed + 1);
        let hue = chance(stone.id.x, stone.id.y, seed + 2);
        let base = vec3(0.50, 0.49, 0.47).lerp(vec3(0.56, 0.51, 0.45), hue) * (0.80 + 0.32 * own);
        let grit = 1.0
            + 0.10 * noise(p * 120.0, ivec2(600, 600), seed + 3)
            + 0.10 * cloud(p * 12.0, ivec2(60, 60), 2, seed + 4);
        let worn = 1.0 + 0.12 * cloud(p, ivec2(5, 5), 3, seed + 5);
        let top = base * dome(&stone, 0.045) * grit * worn;
        let moss = smoothstep(0.05, 0.5, cloud(p * 0.8, ivec2(4, 4), 3, seed + 6));
        let joint = vec3(0.27, 0.25, 0.22).lerp(vec3(0.27, 0.30, 0.18), moss) * grit;
        joint.lerp(top, smoothstep(0.004, -0.008, stone.distance))
    })
}

/// Paints small setts laid in overlapping arcs, as on market squares.
pub(in crate::town) fn setts(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    // Width of an arc, and its rise as a share of that.
    const SPAN: f32 = 1.44;
    const RISE: f32 = 0.2;
    let columns = (tile.x / SPAN).round() as i32;
    PaintCanvas::new(pixels, tile, |p| {
        let column = (p.x / SPAN).floor();
        let across = p.x - (column + 0.5) * SPAN;
        // Rings are arcs of a circle about the middle of the column, cut off at its sides.
        let rise = RISE * SPAN * (1.0 - (across / (0.5 * SPAN)).powi(2));
        let rings = (tile.y / 0.1).round() as i32;
        let ring = tile.y / rings as f32;
        let height = (p.y - rise) / ring;
        let row = height.floor();
        let slope = 2.0 * RISE * across.abs() / (0.25 * SPAN);
        let stretch = (1.0 + slope * slope).sqrt();
        let along = across * (1.0 + 0.25 * slope);
        let wrapped = ivec2(column as i32 % columns, (row as i32).rem_euclid(rings));
        let shift = chance(wrapped.x, wrapped.y, seed) * 0.1;
        let k = ((along + shift) / 0.105).floor();
        let place = vec2(((along + shift) / 0.105 - k) * 2.0 - 1.0, (height - row) * 2.0 - 1.0);
        let q = (place.abs() - vec2(0.62, 0.62)).max(Vec2::ZERO).length() - 0.26;
        let distance = q * 0.05 / stretch;
        let id = ivec2(wrapped.x * 64 + k as i32, wrapped.y);
        let own = chance(id.x, id.y, seed + 1);
        let hue = chance(id.x, id.y, seed + 2);
        let base = vec3(0.55, 0.53, 0.50).lerp(vec3(0.60, 0.54, 0.46), hue) * (0.78 + 0.30 * own);
        let grit = 1.0 + 0.09 * noise(p * 100.0, ivec2(576, 576), seed + 3);
        let worn = 1.0 + 0.14 * cloud(p / 1.44, ivec2(4, 4), 3, seed + 5);
        let relief = 0.78 + 0.22 * smoothstep(0.0, -0.018, distance) + 0.03 * place.y;
        let joint = vec3(0.33, 0.31, 0.27) * grit;
        joint.lerp(base * relief * grit, smoothstep(0.002, -0.006, distance)) * worn
    })
}

/// Paints pavement slabs.
pub(in crate::town) fn slabs(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, tile, |p| {
        let stone = course(p, tile, ivec2(5, 8), 0.5, 0.012, 0.014, seed);
        let own = chance(stone.id.x, stone.id.y, seed + 1);
        let base = vec3(0.60, 0.58, 0.53).lerp(vec3(0.56, 0.53, 0.50), chance(stone.id.x, stone.id.y, seed + 2));
        let surface =
            1.0 + 0.10 * cloud(p * 3.0, ivec2(12, 12), 4, seed + 3) + 0.05 * noise(p * 90.0, ivec2(360, 360), seed + 4);
        let top = base * (0.86 + 0.2 * own) * surface * (0.8 + 0.2 * smoothstep(0.0, 0.02, -stone.distance));
        vec3(0.27, 0.26, 0.23).lerp(top, smoothstep(0.003, -0.004, stone.distance))
    })
}

/// Paints squared sandstone in courses.
pub(in crate::town) fn ashlar(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, tile, |p| ashlar_at(p, tile, ivec2(6, 11), seed))
}

/// Colour of squared sandstone at a point.
pub(super) fn ashlar_at(p: Vec2, tile: Vec2, cells: IVec2, seed: u32) -> Vec3 {
    let stone = course(p, tile, cells, 0.55, 0.012, 0.012, seed);
    let own = chance(stone.id.x, stone.id.y, seed + 1);
    let hue = chance(stone.id.x, stone.id.y, seed + 2);
    let base = vec3(0.71, 0.63, 0.50)
        .lerp(vec3(0.68, 0.57, 0.48), hue)
        .lerp(vec3(0.62, 0.60, 0.55), (own * 7.0).fract() * 0.6);
    let period = |scale: f32| repeats(tile, Vec2::splat(scale));
    let surface = 1.0
        + 0.10 * cloud(p * 2.0, period(2.0), 4, seed + 3)
        + 0.05 * noise(p * 70.0, period(70.0), seed + 4)
        + 0.05 * noise(p * vec2(4.0, 30.0), repeats(tile, vec2(4.0, 30.0)), seed + 5);
    let bevel = 0.84
        + 0.16 * smoothstep(0.0, 0.022, -stone.distance)
        + 0.05 * stone.place.y * smoothstep(0.04, 0.0, -stone.distance);
    let top = base * (0.88 + 0.2 * own) * surface * bevel;
    vec3(0.50, 0.46, 0.39).lerp(top, smoothstep(0.003, -0.003, stone.distance))
}

/// Paints irregular fieldstones in mortar.
pub(in crate::town) fn rubble(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, tile, |p| rubble_at(p, tile, seed))
}

/// Colour of a fieldstone wall at a point: cells about scattered points.
pub(super) fn rubble_at(p: Vec2, tile: Vec2, seed: u32) -> Vec3 {
    let cell = vec2(0.32, 0.22);
    let stones = repeats(tile, cell.recip());
    let q = p / tile * stones.as_vec2();
    let home = ivec2(floor(q.x), floor(q.y));
    let (mut first, mut second, mut id, mut to) = (9.0_f32, 9.0_f32, home, Vec2::ZERO);
    for dy in -1..=1 {
        for dx in -1..=1 {
            let at = home + ivec2(dx, dy);
            let wrapped = ivec2(within(at.x, stones.x), within(at.y, stones.y));
            let seedling = vec2(chance(wrapped.x, wrapped.y, seed), chance(wrapped.x, wrapped.y, seed + 1));
            let offset = q - (at.as_vec2() + 0.15 + 0.7 * seedling);
            let d = offset.length();
            if d < first {
                (second, first, id, to) = (first, d, wrapped, offset);
            } else {
                second = second.min(d);
            }
        }
    }
    let depth = smoothstep(0.05, 0.32, second - first);
    let own = chance(id.x, id.y, seed + 2);
    let hue = chance(id.x, id.y, seed + 3);
    let base = vec3(0.58, 0.53, 0.45).lerp(vec3(0.52, 0.51, 0.50), hue) * (0.78 + 0.34 * own);
    let period = |scale: f32| repeats(tile, Vec2::splat(scale));
    let surface =
        1.0 + 0.14 * cloud(p * 5.0, period(5.0), 3, seed + 4) + 0.06 * noise(p * 60.0, period(60.0), seed + 5);
    let top = base * surface * (0.72 + 0.28 * depth + 0.10 * to.y * (1.0 - depth));
    (vec3(0.60, 0.56, 0.48) * (0.72 + 0.1 * own)).lerp(top, smoothstep(0.06, 0.13, second - first))
}

/// Paints lime plaster, nearly white, to be tinted.
pub(in crate::town) fn plaster(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, tile, |p| Vec3::splat(0.92) * plaster_at(p, tile, seed))
}

/// Unevenness of plaster as a factor on its colour.
pub(super) fn plaster_at(p: Vec2, tile: Vec2, seed: u32) -> f32 {
    let period = |scale: f32| repeats(tile, Vec2::splat(scale));
    1.0 + 0.07 * cloud(p * 1.0, period(1.0), 4, seed)
        + 0.018 * noise(p * 22.0, period(22.0), seed + 7)
        + 0.025 * noise(p * 75.0, period(75.0), seed + 8)
        - 0.05
            * smoothstep(0.25, 0.6, noise(p * vec2(6.0, 0.5), repeats(tile, vec2(6.0, 0.5)).max(IVec2::ONE), seed + 9))
}

/// Paints beaver-tail roof tiles, each course overlapping the one below.
pub(in crate::town) fn tiles(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    let cells = ivec2(24, 27);
    let cell = tile / cells.as_vec2();
    PaintCanvas::new(pixels, tile, |p| {
        // The rounded tail of the course above hangs into this one.
        let place = |row: f32| {
            let wrapped = (row as i32).rem_euclid(cells.y);
            let x = p.x / cell.x + 0.5 * (wrapped % 2) as f32 + 0.1 * (chance(wrapped, 5, seed) - 0.5);
            let k = x.floor();
            (
                vec2((x - k) * 2.0 - 1.0, (p.y / cell.y - row) * 2.0 - 1.0),
                ivec2((k as i32).rem_euclid(cells.x), wrapped),
            )
        };
        let row = (p.y / cell.y).floor();
        let (mut at, mut id) = place(row);
        // The course underneath shows below the rounded end of this course's tile.
        let round = |at: Vec2| at.y + 1.0 - 0.55 * (1.0 - (1.0 - at.x * at.x).max(0.0).sqrt());
        let mut under = 0.0;
        if round(at) < 0.0 {
            under = 1.0;
            (at, id) = place(row - 1.0);
        }
        let own = chance(id.x, id.y, seed + 1);
        let hue = chance(id.x, id.y, seed + 2);
        let base = vec3(0.60, 0.33, 0.24)
            .lerp(vec3(0.50, 0.27, 0.21), hue)
            .lerp(vec3(0.66, 0.42, 0.30), (own * 5.0).fract() * 0.5);
        let gap = smoothstep(0.97, 0.90, at.x.abs());
        let tail = smoothstep(0.0, 0.18, if under > 0.0 { 1.0 } else { round(at) });
        let shadow = if under > 0.0 { 0.62 } else { 1.0 - 0.25 * smoothstep(0.75, 1.0, at.y) };
        let weather = cloud(p / 1.44, ivec2(3, 3), 4, seed + 4);
        let lichen = smoothstep(0.15, 0.5, cloud(p / 0.216, ivec2(20, 20), 3, seed + 5) + 0.3 * weather);
        let grit = 1.0 + 0.08 * noise(p * 60.0, ivec2(259, 259), seed + 3);
        let colour = base * (0.80 + 0.30 * own) * grit * (1.0 + 0.22 * weather);
        colour.lerp(vec3(0.45, 0.42, 0.32), 0.35 * lichen) * (0.55 + 0.45 * gap) * shadow * (0.80 + 0.20 * tail)
    })
}

/// Paints slates for spires.
pub(in crate::town) fn slate(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, tile, |p| {
        let stone = course(p, tile, ivec2(14, 18), 0.25, 0.03, 0.008, seed);
        let own = chance(stone.id.x, stone.id.y, seed + 1);
        let base = vec3(0.36, 0.38, 0.42).lerp(vec3(0.40, 0.38, 0.40), own) * (0.8 + 0.35 * (own * 9.0).fract());
        let weather = 1.0 + 0.15 * cloud(p, ivec2(3, 3), 4, seed + 2);
        base * weather * (0.6 + 0.4 * smoothstep(0.0, 0.02, -stone.distance)) * (0.9 + 0.12 * -stone.place.y)
    })
}

/// Paints weathered boards running up the picture.
pub(in crate::town) fn planks(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, tile, |p| {
        let board = (p.x / 0.2).floor();
        let within = p.x / 0.2 - board;
        let own = chance(board as i32, 3, seed);
        let grain = noise(vec2(p.x * 60.0, p.y * 2.0 + own * 40.0), ivec2(120, 4), seed + 1)
            + 0.6 * noise(vec2(p.x * 150.0, p.y * 5.0), ivec2(300, 10), seed + 2);
        let base = vec3(0.42, 0.31, 0.22) * (0.85 + 0.3 * own) * (1.0 + 0.14 * grain);
        base * (0.45 + 0.55 * smoothstep(0.0, 0.05, within.min(1.0 - within)))
    })
}

/// Paints staves of a barrel with four hoops, from its foot to its rim.
pub(in crate::town) fn staves(pixels: [usize; 2], tile: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, tile, |p| {
        let q = p / tile;
        let stave = (q.x * 6.0).floor();
        let within = (q.x * 6.0).fract();
        let grain = noise(vec2(q.x * 60.0, q.y * 4.0), ivec2(60, 4), seed)
            + 0.6 * noise(vec2(q.x * 120.0, q.y * 9.0), ivec2(120, 9), seed + 1);
        let own = 0.85 + 0.3 * chance(stave as i32, 2, seed);
        let wood = vec3(0.52, 0.36, 0.23)
            * own
            * (1.0 + 0.13 * grain)
            * (0.5 + 0.5 * smoothstep(0.0, 0.08, within.min(1.0 - within)));
        let hoop = [0.07, 0.27, 0.73, 0.93].iter().map(|&y| (q.y - y).abs()).fold(1.0, f32::min);
        let iron = vec3(0.20, 0.20, 0.21) * (1.0 + 0.2 * grain);
        wood.lerp(iron, smoothstep(0.03, 0.025, hoop))
            * (0.7 + 0.3 * smoothstep(0.025, 0.05, (hoop - 0.028).abs() + 0.02))
    })
}
