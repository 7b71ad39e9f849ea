//! Gate tower astride the street.

use glam::{Vec3, vec3};

use super::builder::{Builder, SiteFrame};
use super::facade::Bay;
use super::masonry::{Arch, clock, panel};
use super::paint::timber;
use super::surface::TownSurface;
use scene::LocalName;

/// Half the width of the tower, height of its stone, of its timbered top and of its roof, metres.
const HALF: f32 = 5.2;
const STONE: f32 = 10.5;
const TOP: f32 = 2.9;
const ROOF: f32 = 8.0;

/// Builds the gate; `frame` lies on the middle of the street under it, looking back along the street.
pub(super) fn build(builder: &mut Builder, frame: &SiteFrame, depth: f32) {
    let half = depth / 2.0;
    let stone = vec3(1.0, 0.97, 0.93);
    let arch = Arch { wall: [-HALF, HALF], top: STONE, middle: 0.0, half: 2.25, spring: 2.5, depth };
    for turn in [0.0, 0.5] {
        let face = frame.rotated(turn).at(0.0, -0.1, half);
        arch.face(builder, TownSurface::Rubble, stone, &face);
        // A ring of dressed stone about the opening, and slits above it.
        let ring = Arch { wall: [-2.7, 2.7], top: 5.35, middle: 0.0, half: 2.25, spring: 2.5, depth: 0.12 };
        ring.face(builder, TownSurface::Ashlar, Vec3::ONE, &face.at(0.0, 0.0, 0.12));
        ring.vault(builder, TownSurface::Ashlar, Vec3::ONE, &face.at(0.0, 0.0, 0.12));
        for (a, b) in [(-2.7, -2.7), (2.7, 2.7)] {
            let edge = [
                face.point(a, 0.0, 0.0),
                face.point(b, 0.0, 0.12),
                face.point(b, 5.35, 0.12),
                face.point(a, 5.35, 0.0),
            ];
            builder.facing(TownSurface::Ashlar, Vec3::ONE, &edge, face.right * a);
        }
        builder.beam(TownSurface::Ashlar, Vec3::ONE, &face, vec3(-2.8, 5.35, 0.0), vec3(2.8, 5.55, 0.2));
        for x in [-3.2, 3.2] {
            panel(builder, TownSurface::Lancet, &face.at(0.0, 0.0, 0.05), [x - 0.35, 6.6], [0.7, 1.9]);
        }
        let side = if turn == 0.0 { ("near", "vorn") } else { ("far", "hinten") };
        let name = LocalName::new(format!("gate clock, {} side", side.0), format!("Toruhr, {}", side.1));
        clock(builder, name, &face.at(0.0, 7.95, 0.08), 1.65);
        builder.beam(TownSurface::Ashlar, Vec3::ONE, &face, vec3(-1.75, 6.0, 0.0), vec3(1.75, 6.2, 0.14));
    }
    arch.vault(builder, TownSurface::Rubble, stone, &frame.at(0.0, -0.1, half));
    for turn in [0.25, 0.75] {
        let side = frame.rotated(turn).at(0.0, 0.0, HALF);
        let p = |x: f32, y: f32| side.point(x, y, 0.0);
        builder.metric(TownSurface::Rubble, stone, &[p(-half, -0.1), p(half, -0.1), p(half, STONE), p(-half, STONE)]);
    }

    // The timbered top juts out on all sides.
    let out = 0.35;
    for (turn, reach, wide) in [(0.0, half, HALF), (0.25, HALF, half), (0.5, half, HALF), (0.75, HALF, half)] {
        let face = frame.rotated(turn).at(0.0, STONE, reach + out);
        let w = wide + out;
        let bays = (2.0 * w / 2.4).round() as usize;
        for k in 0..bays {
            let cell = if k == 0 || k + 1 == bays { timber::BLIND[0] } else { timber::WINDOWS[1] };
            let across = [k, k + 1].map(|k| -w + 2.0 * w * k as f32 / bays as f32);
            Bay { surface: TownSurface::Front(1), tint: Vec3::ONE, cell, across, height: [0.0, TOP] }
                .build(builder, &face);
        }
        let under = [
            face.point(-w, 0.0, 0.0),
            face.point(-w + out, 0.0, -out),
            face.point(w - out, 0.0, -out),
            face.point(w, 0.0, 0.0),
        ];
        builder.facing(TownSurface::Planks, Vec3::splat(0.5), &under, Vec3::NEG_Y);
    }

    // A steep hipped roof with a short ridge across the street.
    let (x, z, ridge) = (HALF + out + 0.4, half + out + 0.4, HALF - 2.4);
    let p = |x: f32, y: f32, z: f32| frame.point(x, STONE + TOP + y, z);
    let low = -0.45;
    let tint = vec3(0.95, 0.84, 0.80);
    for side in [-1.0, 1.0] {
        let slope = [p(-x, low, side * z), p(x, low, side * z), p(ridge, ROOF, 0.0), p(-ridge, ROOF, 0.0)];
        builder.facing(TownSurface::Tiles, tint, &slope, frame.out * side + Vec3::Y);
        let hip = [p(side * x, low, -z), p(side * x, low, z), p(side * ridge, ROOF, 0.0)];
        builder.facing(TownSurface::Tiles, tint, &hip, frame.right * side + Vec3::Y);
        let ball = frame.at(side * ridge, STONE + TOP + ROOF - 0.1, 0.0);
        builder.turned(TownSurface::Gold, Vec3::ONE, &ball, 6, &[(0.05, 0.0), (0.16, 0.35), (0.03, 0.6), (0.0, 1.5)]);
    }
    builder.metric(
        TownSurface::Planks,
        Vec3::splat(0.5),
        &[p(-x, low, -z), p(x, low, -z), p(x, low, z), p(-x, low, z)],
    );
}
