//! Open country round the small scenes: a meadow, trees, and hills before the horizon.

use crate::shape::{FaceColour, Shape};
use crate::turn::circle;
use glam::{Vec2, Vec3, vec2, vec3};
use scene::Lighting;

const MEADOW: FaceColour = [0.16, 0.27, 0.075];
const FIELDS: [FaceColour; 3] = [[0.20, 0.31, 0.08], [0.33, 0.30, 0.10], [0.13, 0.23, 0.07]];
const LEAVES: [FaceColour; 3] = [[0.055, 0.16, 0.035], [0.085, 0.20, 0.04], [0.04, 0.12, 0.045]];
const BARK: FaceColour = [0.10, 0.065, 0.04];
const HILLS: [FaceColour; 2] = [[0.10, 0.18, 0.11], [0.16, 0.25, 0.26]];

/// Light of a clear afternoon: the sun stands behind the observer's left shoulder, who looks along −z.
pub(crate) fn daylight() -> Lighting {
    Lighting { sun_direction: vec3(-0.42, 0.66, 0.62).normalize(), ..Lighting::default() }
}

/// Share from 0 to 1 that looks random, the same for each number everywhere.
fn scattered(number: u32, salt: u32) -> f32 {
    let mixed = (number.wrapping_mul(2_654_435_761) ^ salt.wrapping_mul(40_503)).wrapping_mul(0x9E37_79B1);
    ((mixed ^ (mixed >> 15)).wrapping_mul(0x85EB_CA6B) >> 8) as f32 / 16_777_216.0
}

/// Ground at this height out to the hills, with fields in strips. `free`: true where no tree may stand.
pub(crate) fn build(shape: &mut Shape, height: f32, free: impl Fn(Vec2) -> bool) {
    const REACH: f32 = 260.0;
    const CELL: f32 = 40.0;
    let cells = (2.0 * REACH / CELL) as i32;
    for (row, column) in (0..cells).flat_map(|row| (0..cells).map(move |column| (row, column))) {
        let corner = vec3(column as f32 * CELL - REACH, height, (row + 1) as f32 * CELL - REACH);
        let number = (row * cells + column) as u32;
        let near = (corner + vec3(0.5, 0.0, -0.5) * CELL).length() < 95.0;
        let colour = if near { MEADOW } else { FIELDS[(scattered(number, 1) * 3.0) as usize % 3] };
        shape.patch(corner, Vec3::X * CELL, Vec3::NEG_Z * CELL, colour);
    }

    // Trees, the more of them the further away.
    for number in 0..420 {
        let turn = circle(scattered(number, 2));
        let away = 18.0 + 215.0 * scattered(number, 3);
        let at = turn * away;
        if free(at) {
            continue;
        }
        let size = 0.7 + 0.8 * scattered(number, 4);
        let foot = vec3(at.x, height, at.y);
        let leaves = LEAVES[(scattered(number, 5) * 3.0) as usize % 3];
        shape.cone(foot, [0.0, 1.6 * size], [0.28 * size, 0.22 * size], BARK);
        if number % 3 == 0 {
            shape.cone(foot, [1.2 * size, 8.5 * size], [2.1 * size, 0.0], leaves);
        } else {
            shape.cone(foot, [1.5 * size, 3.0 * size], [1.3 * size, 2.7 * size], leaves);
            shape.cone(foot, [3.0 * size, 5.2 * size], [2.7 * size, 2.3 * size], leaves);
            shape.cone(foot, [5.2 * size, 7.2 * size], [2.3 * size, 0.0], leaves);
        }
    }

    // Two ranges of hills.
    for (range, (distance, tall)) in [(240.0, 15.0), (258.0, 34.0)].into_iter().enumerate() {
        const SIDES: u32 = 72;
        let crest = |side: u32| {
            let near = side % SIDES;
            tall * (0.45 + 0.3 * scattered(near / 3, 6 + range as u32) + 0.25 * scattered(near, 8 + range as u32))
        };
        let at = |side: u32, up: f32| {
            let c = circle(side as f32 / SIDES as f32) * distance;
            vec3(c.x, height + up, c.y)
        };
        for side in 0..SIDES {
            let corners = [at(side, -1.0), at(side, crest(side)), at(side + 1, crest(side + 1)), at(side + 1, -1.0)];
            let [a, b, c, d] = corners;
            shape.face(&[a, d, c], HILLS[range]);
            shape.face(&[a, c, b], HILLS[range]);
        }
    }
}

/// True within a strip of this half width about a line through the origin along the unit vector `along`.
pub(crate) fn in_strip(at: Vec2, along: Vec2, half: f32) -> bool {
    vec2(-along.y, along.x).dot(at).abs() < half
}
