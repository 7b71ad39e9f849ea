//! Church on the east side of the square: a tower with clock and spire, a nave with an apse, a churchyard wall.

use glam::{Vec3, vec3};

use super::builder::{Builder, SiteFrame};
use super::masonry::{clock, panel};
use super::paint::tracery::{LANCET, PORTAL};
use super::roof::Roof;
use super::surface::TownSurface;
use scene::LocalName;

/// Half the width of the tower, and its height up to the spire, metres.
const TOWER: f32 = 3.8;
const BELFRY: f32 = 26.0;
/// Half the width of the nave, its beginning and end along z, the heights of its walls and of its roof, metres.
const NAVE: f32 = 7.5;
const LENGTH: [f32; 2] = [-4.0, -34.0];
const EAVES: f32 = 11.0;
const ROOF: f32 = 11.0;

/// Builds the church; `frame` lies in the middle of its front on the ground, `width` is the lot's.
pub(super) fn build(builder: &mut Builder, frame: &SiteFrame, width: f32) {
    nave(builder, frame);
    tower(builder, &frame.at(0.0, 0.0, 1.0 - TOWER));

    // A wall with coping closes the churchyard on both sides.
    for [left, right] in [[-width / 2.0, -NAVE + 0.5], [NAVE - 0.5, width / 2.0]] {
        builder.block(TownSurface::Rubble, Vec3::ONE, frame, vec3(left, -0.2, -0.6), vec3(right, 2.6, -0.1));
        builder.block(TownSurface::Ashlar, Vec3::ONE, frame, vec3(left, 2.6, -0.7), vec3(right, 2.78, 0.0));
    }
}

/// Builds the tower about `frame`'s upright axis.
fn tower(builder: &mut Builder, frame: &SiteFrame) {
    let stone = Vec3::ONE;
    let half = TOWER;
    builder.block(TownSurface::Ashlar, stone, frame, vec3(-half, 0.0, -half), vec3(half, BELFRY, half));
    builder.block(
        TownSurface::Ashlar,
        stone * 0.85,
        frame,
        vec3(-half - 0.25, -0.1, -half - 0.25),
        vec3(half + 0.25, 1.1, half + 0.25),
    );
    for (level, out) in [(9.2, 0.16), (17.4, 0.16), (BELFRY - 0.3, 0.35)] {
        let reach = half + out;
        builder.beam(
            TownSurface::Ashlar,
            stone * 0.95,
            frame,
            vec3(-reach, level, -reach),
            vec3(reach, level + 0.3, reach),
        );
    }
    for (x, z) in [(-half, -half), (half, -half), (half, half), (-half, half)] {
        builder.block(
            TownSurface::Ashlar,
            stone * 0.95,
            &frame.at(x, 0.0, z),
            vec3(-0.45, 0.0, -0.45),
            vec3(0.45, 17.4, 0.45),
        );
        let pinnacle = frame.at(x * 0.9, BELFRY, z * 0.9);
        builder.prism(TownSurface::Ashlar, stone, &pinnacle, 4, [0.55, 0.55], [0.0, 1.4]);
        builder.prism(TownSurface::Slate, stone, &pinnacle, 4, [0.7, 0.0], [1.4, 4.2]);
    }

    // Four faces: bell openings and a clock; the portal and a great window in front.
    for quarter in 0..4_usize {
        let face = frame.rotated(quarter as f32 / 4.0).at(0.0, 0.0, half + 0.05);
        for x in [-1.5, 0.3] {
            panel(builder, TownSurface::Lancet, &face, [x, 18.6], [1.2, 3.3]);
        }
        let side = [("front", "vorn"), ("right", "rechts"), ("back", "hinten"), ("left", "links")][quarter];
        let name = LocalName::new(format!("church clock, {}", side.0), format!("Kirchenuhr, {}", side.1));
        clock(builder, name, &face.at(0.0, 23.75, 0.03), 1.85);
    }
    let front = frame.at(0.0, 0.0, half + 0.3);
    panel(builder, TownSurface::Portal, &front, [-PORTAL.x / 2.0, 0.0], PORTAL.to_array());
    builder.block(TownSurface::Ashlar, stone, &front, vec3(-2.0, 0.0, -0.3), vec3(-1.8, 4.6, 0.12));
    builder.block(TownSurface::Ashlar, stone, &front, vec3(1.8, 0.0, -0.3), vec3(2.0, 4.6, 0.12));
    builder.beam(TownSurface::Ashlar, stone, &front, vec3(-2.1, 4.4, -0.3), vec3(2.1, 4.75, 0.2));
    for (step, out) in [(0.28, 0.5), (0.14, 0.9)] {
        builder.block(TownSurface::Slabs, stone, &front, vec3(-2.3 - out, -0.1, -0.2), vec3(2.3 + out, step, out));
    }
    panel(builder, TownSurface::Lancet, &frame.at(0.0, 0.0, half + 0.05), [-1.1, 10.6], [2.2, 5.6]);

    // The spire.
    builder.prism(TownSurface::Slate, Vec3::ONE, frame, 8, [half * 1.04, 2.3], [BELFRY, BELFRY + 5.0]);
    builder.prism(TownSurface::Slate, Vec3::ONE, frame, 8, [2.3, 0.0], [BELFRY + 5.0, BELFRY + 23.0]);
    builder.turned(
        TownSurface::Gold,
        Vec3::ONE,
        frame,
        8,
        &[(0.06, 48.6), (0.35, 49.1), (0.35, 49.3), (0.05, 49.8), (0.05, 51.2), (0.0, 51.3)],
    );
    builder.beam(TownSurface::Gold, Vec3::ONE, frame, vec3(-0.45, 50.5, -0.05), vec3(0.45, 50.62, 0.05));
}

/// Builds nave and apse behind the tower.
fn nave(builder: &mut Builder, frame: &SiteFrame) {
    let stone = vec3(1.0, 0.98, 0.95);
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    let [front, end] = LENGTH;
    let peak = EAVES + ROOF;
    let wall =
        [p(-NAVE, 0.0, front), p(NAVE, 0.0, front), p(NAVE, EAVES, front), p(0.0, peak, front), p(-NAVE, EAVES, front)];
    builder.metric(TownSurface::Ashlar, stone, &wall);
    builder.facing(
        TownSurface::Ashlar,
        stone,
        &[p(-NAVE, EAVES, end), p(NAVE, EAVES, end), p(0.0, peak, end)],
        -frame.out,
    );
    let roof = Roof {
        walls: [p(-NAVE, EAVES, front), p(NAVE, EAVES, front), p(NAVE, EAVES, end), p(-NAVE, EAVES, end)],
        height: ROOF,
        overhang: [0.45, 0.25, 0.25],
        hips: [None, None],
        surface: TownSurface::Tiles,
        near: Some((frame.origin, frame.out, 60.0)),
        tint: vec3(0.86, 0.80, 0.78),
    };
    roof.build(builder);
    for side in [-1.0, 1.0] {
        let out = frame.right * side;
        let flank = [
            p(side * NAVE, 0.0, front),
            p(side * NAVE, 0.0, end),
            p(side * NAVE, EAVES, end),
            p(side * NAVE, EAVES, front),
        ];
        builder.facing(TownSurface::Ashlar, stone, &flank, out);
        let wall = SiteFrame::facing(frame.point(side * (NAVE + 0.05), 0.0, 0.0), out);
        for bay in 0..5 {
            let z = front - 3.2 - 6.0 * bay as f32;
            panel(
                builder,
                TownSurface::Lancet,
                &wall,
                [-side * z - LANCET.x * 0.65, 3.2],
                [LANCET.x * 1.3, LANCET.y * 1.4],
            );
            let foot = wall.at(-side * (z - 3.0), 0.0, 0.0);
            builder.block(TownSurface::Ashlar, stone * 0.95, &foot, vec3(-0.4, 0.0, -0.1), vec3(0.4, 6.5, 1.1));
            builder.block(TownSurface::Ashlar, stone * 0.95, &foot, vec3(-0.4, 6.5, -0.1), vec3(0.4, 9.5, 0.6));
        }
        panel(builder, TownSurface::Lancet, &frame.at(0.0, 0.0, front + 0.05), [side * 5.6 - 0.9, 3.4], [1.8, 4.8]);
    }
    let apse = frame.at(0.0, 0.0, end);
    builder.prism(TownSurface::Ashlar, stone, &apse, 8, [6.6, 6.6], [0.0, EAVES - 1.0]);
    builder.prism(TownSurface::Tiles, vec3(0.86, 0.80, 0.78), &apse, 8, [7.1, 0.0], [EAVES - 1.1, EAVES + 6.0]);
}
