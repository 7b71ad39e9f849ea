//! Market: stalls with striped awnings and heaps of fruit, barrels, benches, crates.

use glam::{Vec3, vec2, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, MeshCorner, SiteFrame};
use super::surface::TownSurface;
use crate::turn::circle;

const OAK: Vec3 = vec3(1.0, 0.9, 0.8);

/// Builds a stall; `frame` lies on the ground in its middle, facing the customers.
pub(super) fn stall(builder: &mut Builder, frame: &SiteFrame, dice: &mut ChaCha8Rng) {
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    let (half, deep) = (1.5, 0.9);
    for (x, z) in [(-half, -deep), (half, -deep), (half, deep), (-half, deep)] {
        let height = if z < 0.0 { 2.25 } else { 2.05 };
        let post = frame.at(x, 0.0, z);
        builder.block(TownSurface::Planks, OAK, &post, vec3(-0.05, 0.0, -0.05), vec3(0.05, height, 0.05));
    }
    builder.block(TownSurface::Planks, OAK, frame, vec3(-half + 0.08, 0.0, -0.05), vec3(half - 0.08, 0.74, deep - 0.1));
    // The goods lie on a tilted board, one kind in each third.
    let kinds = dice.random_range(0..4);
    for k in 0..3 {
        let kind = ((k + kinds) % 4) as f32 / 4.0;
        let x = |s: f32| -half + 0.1 + (2.0 * half - 0.2) * (k as f32 + s) / 3.0;
        let corner = |s: f32, t: f32| {
            MeshCorner::new(
                p(x(0.03 + 0.94 * s), 0.80 + 0.22 * t, deep - 0.08 - 0.75 * t),
                vec2(kind + 0.01 + 0.23 * s, 1.0 - 0.5 * t),
            )
        };
        builder.face(
            TownSurface::Produce,
            Vec3::ONE,
            &[corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
        );
        let board = [
            p(x(0.0), 0.74, deep - 0.06),
            p(x(1.0), 0.74, deep - 0.06),
            p(x(1.0), 0.84, deep - 0.06),
            p(x(0.0), 0.84, deep - 0.06),
        ];
        builder.metric(TownSurface::Planks, OAK * 0.8, &board);
        let front = frame.at(x(0.5), 0.0, deep + 0.35);
        if dice.random_bool(0.6) {
            crate_of(builder, &front.rotated(dice.random_range(-0.04..0.04)), kind);
        }
    }
    // The awning: two slopes and a scalloped front, in one of four stripes.
    let stripe = dice.random_range(0..4) as f32 / 4.0;
    let cloth = |x: f32, y: f32, z: f32, t: f32| MeshCorner::new(p(x, y, z), vec2(x, stripe + 0.03 + 0.19 * t));
    let wide = half + 0.2;
    for (z0, y0, z1, y1) in
        [(deep + 0.45, 2.0, -0.1, 2.65), (-0.1, 2.65, -deep - 0.3, 2.2), (deep + 0.46, 1.76, deep + 0.45, 2.0)]
    {
        builder.face(
            TownSurface::Awning,
            Vec3::ONE,
            &[cloth(-wide, y0, z0, 1.0), cloth(wide, y0, z0, 1.0), cloth(wide, y1, z1, 0.0), cloth(-wide, y1, z1, 0.0)],
        );
    }
    for side in [-1.0_f32, 1.0] {
        let x = side * wide;
        builder.face(
            TownSurface::Awning,
            Vec3::ONE,
            &[cloth(x, 2.0, deep + 0.45, 1.0), cloth(x, 2.2, -deep - 0.3, 1.0), cloth(x, 2.65, -0.1, 0.0)],
        );
    }
}

/// Builds a crate full of one kind of goods.
fn crate_of(builder: &mut Builder, frame: &SiteFrame, kind: f32) {
    builder.block(TownSurface::Planks, OAK * 1.1, frame, vec3(-0.3, 0.0, -0.2), vec3(0.3, 0.34, 0.2));
    let corner = |x: f32, z: f32| {
        MeshCorner::new(
            frame.point(x, 0.36, z),
            vec2(kind + 0.02 + 0.2 * (x / 0.56 + 0.5), 0.3 - 0.3 * (z / 0.36 + 0.5)),
        )
    };
    builder.face(
        TownSurface::Produce,
        Vec3::ONE,
        &[corner(-0.27, 0.17), corner(0.27, 0.17), corner(0.27, -0.17), corner(-0.27, -0.17)],
    );
}

/// Builds a barrel on its end.
pub(super) fn barrel(builder: &mut Builder, frame: &SiteFrame) {
    let outline = [(0.27, 0.0), (0.345, 0.45), (0.27, 0.9), (0.0, 0.87)];
    builder.turned(TownSurface::Staves, Vec3::ONE, frame, 7, &outline);
}

/// Builds a bench with a back.
pub(super) fn bench(builder: &mut Builder, frame: &SiteFrame) {
    for x in [-0.75, 0.75] {
        for (foot, top) in [((0.0, 0.18), (0.44, 0.15)), ((0.0, -0.24), (0.88, -0.18))] {
            let (from, to) = (frame.point(x, foot.0, foot.1), frame.point(x, top.0, top.1));
            builder.rod(TownSurface::Iron, Vec3::ONE, from, to, 0.06);
        }
    }
    let plank = vec3(1.25, 0.95, 0.7);
    builder.beam(TownSurface::Planks, plank, frame, vec3(-0.95, 0.42, -0.2), vec3(0.95, 0.47, 0.22));
    builder.beam(TownSurface::Planks, plank, frame, vec3(-0.95, 0.62, -0.2), vec3(0.95, 0.86, -0.16));
}

/// Builds a round table with stools under a parasol; `number` chooses its cloth.
pub(super) fn table(builder: &mut Builder, frame: &SiteFrame, number: usize) {
    let wood = vec3(1.2, 0.95, 0.75);
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    builder.rod(TownSurface::Iron, Vec3::ONE, p(0.0, 0.0, 0.0), p(0.0, 2.75, 0.0), 0.05);
    builder.prism(TownSurface::Planks, wood, frame, 8, [0.48, 0.48], [0.72, 0.76]);
    for k in 0..3 {
        let c = circle(k as f32 / 3.0) * 0.85;
        builder.prism(TownSurface::Planks, wood, &frame.at(c.x, 0.0, c.y), 5, [0.14, 0.19], [0.0, 0.46]);
    }
    const PANELS: u32 = 8;
    let stripe = (number % 4) as f32 / 4.0;
    let rim = |k: u32| {
        let c = circle(k as f32 / PANELS as f32) * 1.45;
        p(c.x, 2.15, c.y)
    };
    for k in 0..PANELS {
        // White and coloured panels alternate.
        let u = 0.25 * (2 * (k % 2)) as f32 + 0.02;
        let corner = |at: Vec3, s: f32, t: f32| MeshCorner::new(at, vec2(u + 0.2 * s, stripe + 0.03 + 0.19 * t));
        let corners = [corner(rim(k + 1), 0.0, 1.0), corner(rim(k), 1.0, 1.0), corner(p(0.0, 2.7, 0.0), 0.5, 0.0)];
        builder.face(TownSurface::Awning, Vec3::ONE, &corners);
    }
}
