//! Streets: cobbles with a gutter on both sides, kerbs, raised pavements up to and under the house fronts.

use glam::{Vec2, Vec3, vec2};

use super::builder::{Builder, MeshCorner};
use super::plan::{Lot, Station, TownPlan, Use, on_ground};
use super::surface::TownSurface;

/// Width of a pavement and of its kerb, and height of the kerb, metres.
pub(super) const PAVEMENT: f32 = 0.95;
const KERB: f32 = 0.14;
const STEP: f32 = 0.08;
/// Width of the pavement under the houses, metres: their fronts are straight while the street bends.
const UNDER: f32 = 1.6;

/// Strip of the street's cross section, from its left to its right edge.
struct Strip {
    surface: TownSurface,
    /// Distances of the edges right of the middle, metres.
    across: [f32; 2],
    /// Heights of the edges above the ground, metres.
    height: [f32; 2],
    light: [f32; 2],
}

/// Cross section at a station; `level` is 0 where everything lies in one plane and 1 in the open street.
fn section(station: &Station, level: f32) -> Vec<Strip> {
    let [left, right] = station.width;
    let step = STEP * level;
    let camber = 0.05 * level;
    let gutter = -0.03 * level;
    let mut strips = vec![];
    let edge = |width: f32| width - PAVEMENT;
    let (l, r) = (edge(left), edge(right));
    let mut strip = |surface, a: f32, b: f32, ha: f32, hb: f32, la: f32, lb: f32| {
        strips.push(Strip { surface, across: [a, b], height: [ha, hb], light: [la, lb] });
    };
    strip(TownSurface::Slabs, -left - UNDER, -l - KERB, step, step, 0.0, 0.95);
    strip(TownSurface::Ashlar, -l - KERB, -l, step, step, 0.9, 0.9);
    strip(TownSurface::Ashlar, -l, -l, step, gutter, 0.75, 0.6);
    strip(TownSurface::Cobbles, -l, -l + 0.4, gutter, 0.0, 0.72, 0.96);
    strip(TownSurface::Cobbles, -l + 0.4, 0.0, 0.0, camber, 0.96, 1.0);
    strip(TownSurface::Cobbles, 0.0, r - 0.4, camber, 0.0, 1.0, 0.96);
    strip(TownSurface::Cobbles, r - 0.4, r, 0.0, gutter, 0.96, 0.72);
    strip(TownSurface::Ashlar, r, r, gutter, step, 0.6, 0.75);
    strip(TownSurface::Ashlar, r, r + KERB, step, step, 0.9, 0.9);
    strip(TownSurface::Slabs, r + KERB, right + UNDER, step, step, 0.95, 0.0);
    strips
}

/// Paves the street from the square round and back to it.
pub(super) fn pave(builder: &mut Builder, plan: &TownPlan) {
    let stations = plan.street_stations();
    // A bend of ten metres' radius needs only every second station.
    let mut chosen: Vec<&Station> = stations.iter().step_by(2).collect();
    if stations.len().is_multiple_of(2) {
        chosen.extend(stations.last());
    }
    let level = |k: usize| (k.min(chosen.len() - 1 - k) as f32 / 2.0).min(1.0);
    let mut unit = 0.0;
    builder.district("streets");
    for k in 0..chosen.len() - 1 {
        let (near, far) = (chosen[k], chosen[k + 1]);
        let advance = near.at.distance(far.at);
        for (a, b) in section(near, level(k)).iter().zip(section(far, level(k + 1))) {
            let tile = a.surface.tile();
            let corner = |station: &Station, strip: &Strip, side: usize, along: f32| {
                let foot = station.beside(strip.across[side]);
                let at = on_ground(foot) + Vec3::Y * strip.height[side];
                let across = if strip.across[0] == strip.across[1] { strip.height[side] } else { strip.across[side] };
                MeshCorner { at, uv: vec2(across, -along) / tile, light: strip.light[side] }
            };
            builder.face(
                a.surface,
                Vec3::ONE,
                &[
                    corner(near, a, 0, unit),
                    corner(near, a, 1, unit),
                    corner(far, &b, 1, unit + advance),
                    corner(far, &b, 0, unit + advance),
                ],
            );
        }
        unit += advance;
    }
}

/// Width of the border of slabs along the fronts of the square, metres.
const BORDER: f32 = 1.8;

/// Paves the market square: setts inside, a border of slabs along the fronts.
pub(super) fn pave_square(builder: &mut Builder, plan: &TownPlan) {
    builder.district("market square");
    let outline = square_outline(plan);
    let count = outline.len();
    // Inner corners of the border: the end of the side before and the beginning of the side after. The two coincide,
    // except where the border stops at a street.
    let inner: Vec<[Vec2; 2]> = (0..count)
        .map(|k| {
            let ((before, width), (p, next_width)) = (outline[(k + count - 1) % count], outline[k]);
            let (m, n) = ((p - before).normalize().perp(), (outline[(k + 1) % count].0 - p).normalize().perp());
            if width == next_width {
                [p + (m + n) * width / (1.0 + m.dot(n)); 2]
            } else {
                [p + m * width, p + n * next_width]
            }
        })
        .collect();
    for k in 0..count {
        let next = (k + 1) % count;
        if outline[k].1 > 0.0 {
            let corners = [(inner[k][1], 1.0), (inner[next][0], 1.0), (outline[next].0, 0.55), (outline[k].0, 0.55)];
            builder.lit(TownSurface::Slabs, Vec3::ONE, &corners.map(|(p, light)| (on_ground(p), light)));
        }
    }
    let mut middle: Vec<Vec2> = inner.into_iter().flatten().collect();
    middle.dedup();
    for triangle in triangulate(&middle) {
        builder.metric(TownSurface::Setts, Vec3::ONE, &triangle.map(on_ground));
    }
}

/// Corners of the square, clockwise on a map, each with the width of the border along the side that begins there,
/// which is 0 across the mouths of the streets.
fn square_outline(plan: &TownPlan) -> Vec<(Vec2, f32)> {
    let mut outline = vec![];
    for row in &plan.rows {
        // The row's lots at the square follow one another.
        let at_square = |lot: &&Lot| lot.at_square || matches!(lot.kind, Use::TownHall | Use::Church);
        let lots: Vec<_> = row.iter().filter(at_square).collect();
        outline.extend(lots.iter().map(|lot| (lot.front[0], BORDER)));
        outline.extend(lots.last().map(|lot| (lot.front[1], 0.0)));
    }
    outline
}

/// Cuts a simple polygon into triangles by clipping ears.
fn triangulate(outline: &[Vec2]) -> Vec<[Vec2; 3]> {
    let area: f32 = (0..outline.len()).map(|k| outline[k].perp_dot(outline[(k + 1) % outline.len()])).sum();
    let mut rest: Vec<Vec2> = outline.to_vec();
    // On the ground, z points down the map: a positive area runs clockwise as seen from above.
    if area > 0.0 {
        rest.reverse();
    }
    let mut triangles = vec![];
    while rest.len() > 3 {
        let count = rest.len();
        let ear = (0..count).filter(|&k| {
            let (a, b, c) = (rest[(k + count - 1) % count], rest[k], rest[(k + 1) % count]);
            let inside = |p: Vec2| {
                (b - a).perp_dot(p - a) <= 0.0 && (c - b).perp_dot(p - b) <= 0.0 && (a - c).perp_dot(p - c) <= 0.0
            };
            (b - a).perp_dot(c - b) < 0.0 && rest.iter().all(|&p| p == a || p == b || p == c || !inside(p))
        });
        let flatness = |k: usize| {
            let (a, c) = (rest[(k + count - 1) % count], rest[(k + 1) % count]);
            a.distance_squared(c)
        };
        let Some(k) = ear.min_by(|&i, &j| flatness(i).total_cmp(&flatness(j))) else {
            break;
        };
        triangles.push([rest[(k + count - 1) % count], rest[k], rest[(k + 1) % count]]);
        rest.remove(k);
    }
    if let [a, b, c] = rest[..] {
        triangles.push([a, b, c]);
    }
    triangles
}
