//! Market fountain: steps, an eight-sided basin, a column with spouts, and a banner bearer on top. Also the well in
//! the street.

use glam::{Vec3, vec3};

use super::builder::{Builder, SiteFrame};
use super::masonry::basin;
use super::surface::TownSurface;

const SIDES: u32 = 8;

/// Builds the fountain about `frame`'s upright axis.
pub(super) fn build(builder: &mut Builder, frame: &SiteFrame) {
    let stone = Vec3::ONE;
    builder.prism(TownSurface::Slabs, stone, frame, SIDES, [3.5, 3.5], [-0.1, 0.16]);
    builder.prism(TownSurface::Slabs, stone, frame, SIDES, [3.0, 3.0], [0.16, 0.32]);
    basin(builder, TownSurface::Ashlar, frame, SIDES, [2.45, 2.15], [0.32, 1.25]);
    basin(builder, TownSurface::Ashlar, frame, SIDES, [2.55, 2.1], [1.12, 1.28]);
    let surface = frame.at(0.0, 1.05, 0.0);
    builder.prism(TownSurface::Water, stone, &surface, SIDES, [2.2, 2.2], [-0.01, 0.0]);

    // The column with its capital.
    builder.prism(TownSurface::Ashlar, stone, frame, SIDES, [0.55, 0.55], [0.3, 1.7]);
    let column =
        [(0.62, 1.7), (0.62, 1.85), (0.36, 2.0), (0.30, 3.5), (0.42, 3.65), (0.55, 3.95), (0.55, 4.1), (0.0, 4.12)];
    builder.turned(TownSurface::Ashlar, stone, frame, SIDES, &column);
    for quarter in 0..4 {
        let face = frame.rotated(quarter as f32 / 4.0);
        builder.beam(TownSurface::Iron, stone, &face, vec3(-0.03, 1.52, 0.5), vec3(0.03, 1.58, 1.25));
        // A jet falls from each spout.
        let jet = [face.point(0.0, 1.55, 1.25), face.point(0.0, 1.05, 1.5)];
        builder.rod(TownSurface::Lantern, vec3(0.9, 1.05, 1.3), jet[0], jet[1], 0.025);
        builder.turned(
            TownSurface::Gold,
            stone,
            &face.at(0.0, 1.55, 0.62),
            6,
            &[(0.0, -0.12), (0.13, -0.04), (0.13, 0.04), (0.0, 0.12)],
        );
    }
    bearer(builder, &frame.at(0.0, 4.1, 0.0).rotated(0.1));
}

/// Builds a figure in armour with shield and banner.
fn bearer(builder: &mut Builder, frame: &SiteFrame) {
    let stone = vec3(0.55, 0.52, 0.46);
    let body =
        [(0.34, 0.0), (0.30, 0.35), (0.20, 0.75), (0.17, 0.95), (0.25, 1.25), (0.24, 1.42), (0.09, 1.52), (0.09, 1.58)];
    builder.turned(TownSurface::Paint, stone, frame, SIDES, &body);
    let head = [(0.0, 1.55), (0.13, 1.63), (0.15, 1.74), (0.11, 1.86), (0.03, 1.93), (0.0, 2.08)];
    builder.turned(TownSurface::Paint, stone, frame, SIDES, &head);
    builder.beam(TownSurface::Paint, stone, frame, vec3(-0.44, 0.95, -0.02), vec3(-0.24, 1.38, 0.16));
    builder.beam(TownSurface::Paint, stone, frame, vec3(0.22, 1.12, 0.0), vec3(0.46, 1.32, 0.26));
    builder.beam(TownSurface::Paint, vec3(0.42, 0.06, 0.05), frame, vec3(-0.56, 0.55, 0.12), vec3(-0.16, 1.15, 0.18));
    builder.beam(TownSurface::Gold, Vec3::ONE, frame, vec3(-0.52, 0.82, 0.18), vec3(-0.2, 0.88, 0.2));
    builder.prism(TownSurface::Gold, Vec3::ONE, &frame.at(0.46, 0.0, 0.22), 5, [0.025, 0.025], [0.0, 2.9]);
    let p = |y: f32, z: f32| frame.point(0.46, y, z);
    for out in [1.0, -1.0] {
        let cloth = [p(2.1, 0.25), p(2.85, 0.25), p(2.75, 1.15), p(2.45, 0.9), p(2.2, 1.2)];
        builder.facing(TownSurface::Paint, vec3(0.45, 0.05, 0.04), &cloth[..3], frame.right * out);
        builder.facing(TownSurface::Paint, vec3(0.45, 0.05, 0.04), &[cloth[0], cloth[2], cloth[3]], frame.right * out);
        builder.facing(TownSurface::Paint, vec3(0.45, 0.05, 0.04), &[cloth[0], cloth[3], cloth[4]], frame.right * out);
    }
}

/// Builds a draw well with a little roof.
pub(super) fn well(builder: &mut Builder, frame: &SiteFrame) {
    basin(builder, TownSurface::Rubble, frame, SIDES, [1.0, 0.75], [-0.1, 0.85]);
    builder.prism(TownSurface::Water, Vec3::splat(0.35), frame, SIDES, [0.8, 0.8], [0.2, 0.3]);
    for x in [-0.95, 0.95] {
        builder.block(TownSurface::Planks, Vec3::ONE, frame, vec3(x - 0.08, 0.0, -0.08), vec3(x + 0.08, 2.3, 0.08));
    }
    builder.beam(TownSurface::Planks, Vec3::ONE, frame, vec3(-1.1, 1.7, -0.06), vec3(1.1, 1.82, 0.06));
    builder.beam(TownSurface::Planks, vec3(0.8, 0.7, 0.6), frame, vec3(-0.14, 0.95, -0.14), vec3(0.14, 1.2, 0.14));
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    for side in [-1.0, 1.0] {
        let slope = [p(-1.35, 2.15, side * 0.95), p(1.35, 2.15, side * 0.95), p(1.35, 2.95, 0.0), p(-1.35, 2.95, 0.0)];
        builder.facing(TownSurface::Tiles, Vec3::ONE, &slope, Vec3::Y);
        builder.facing(
            TownSurface::Planks,
            Vec3::splat(0.5),
            &slope.map(|corner| corner - Vec3::Y * 0.05),
            Vec3::NEG_Y,
        );
        let end = [p(side * 1.1, 2.25, -0.8), p(side * 1.1, 2.25, 0.8), p(side * 1.1, 2.9, 0.0)];
        builder.facing(TownSurface::Planks, Vec3::splat(0.8), &end, frame.right * side);
    }
}
