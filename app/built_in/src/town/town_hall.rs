//! Town hall on the west side of the square: an arcade, two storeys of tall windows, stepped gables, a clock, a
//! turret.

use glam::{Vec3, vec3};

use super::builder::{Builder, SiteFrame};
use super::facade::Bay;
use super::furniture;
use super::house::linear;
use super::masonry::{Arch, clock, stepped_gable, window_panel};
use super::paint::{ground_floors, timber};
use super::roof::{Roof, dormer};
use super::surface::TownSurface;
use scene::LocalName;

const ARCHES: u32 = 6;
/// Depth of the arcade and of the whole building, thickness of its piers, metres.
const ARCADE: f32 = 3.2;
const DEPTH: f32 = 13.0;
const PIER: f32 = 0.7;
/// Heights of the arcade and of each storey, metres, and number of storeys; height of the roof.
const FIRST: f32 = 4.7;
const STOREY: f32 = 3.5;
const STOREYS: u32 = 2;
const ROOF: f32 = 8.5;

/// Builds the town hall; `frame` lies at the left end of its front on the ground.
pub(super) fn build(builder: &mut Builder, frame: &SiteFrame, width: f32) {
    let wall = linear(timber::FRONTS[timber::TOWN_HALL].plaster());
    arcade(builder, frame, width);

    // The storeys, in bays of their own picture.
    let bays = (width / 2.6).round() as usize;
    for storey in 0..STOREYS {
        let low = FIRST + STOREY * storey as f32;
        for k in 0..bays {
            let cell = timber::WINDOWS[k % 2];
            let across = [k, k + 1].map(|k| width * k as f32 / bays as f32);
            let height = [low, low + STOREY];
            Bay { surface: TownSurface::Front(timber::TOWN_HALL), tint: Vec3::ONE, cell, across, height }
                .build(builder, frame);
        }
    }
    for level in [FIRST, FIRST + STOREY] {
        builder.beam(
            TownSurface::Ashlar,
            Vec3::ONE,
            frame,
            vec3(0.0, level - 0.22, -0.1),
            vec3(width, level + 0.1, 0.16),
        );
    }

    // Banners between the windows.
    for (k, x) in [0.13, 0.5, 0.87].into_iter().enumerate() {
        furniture::banner(builder, &frame.at(width * x, FIRST + 1.1, 0.3), [0.95, 4.9], k);
    }

    // Sides, back and roof.
    let eaves = FIRST + STOREY * STOREYS as f32;
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    for (x, out) in [(0.0, -frame.right), (width, frame.right)] {
        builder.facing(
            TownSurface::Plaster,
            wall,
            &[p(x, 0.0, 0.0), p(x, 0.0, -DEPTH), p(x, eaves, -DEPTH), p(x, eaves, 0.0)],
            out,
        );
        let inward = if x > 0.0 { -0.45 } else { 0.0 };
        let gable = SiteFrame {
            origin: p(x + inward + 0.45, eaves, -DEPTH / 2.0),
            right: -frame.out,
            up: Vec3::Y,
            out: frame.right,
        };
        stepped_gable(builder, TownSurface::Plaster, wall, &gable, DEPTH / 2.0, ROOF + 1.2, 7);
    }
    builder.facing(
        TownSurface::Plaster,
        wall,
        &[p(0.0, 0.0, -DEPTH), p(width, 0.0, -DEPTH), p(width, eaves, -DEPTH), p(0.0, eaves, -DEPTH)],
        -frame.out,
    );
    let tint = vec3(0.95, 0.86, 0.82);
    let roof = Roof {
        walls: [p(width - 0.4, eaves, 0.0), p(width - 0.4, eaves, -DEPTH), p(0.4, eaves, -DEPTH), p(0.4, eaves, 0.0)],
        height: ROOF,
        overhang: [0.35, 0.0, 0.0],
        hips: [None, None],
        surface: TownSurface::Tiles,
        near: Some((frame.origin, frame.out, 4.0)),
        tint,
    };
    roof.build(builder);
    let slope = 2.0 * ROOF / DEPTH;
    for x in [0.12, 0.28, 0.72, 0.88] {
        dormer(builder, &frame.at(width * x, eaves + 0.1 + 1.2 * slope, -1.2), slope, timber::TOWN_HALL, tint);
    }

    // The middle gable with the clock, and its roof back to the slope.
    let (half, height) = (4.4, 7.6);
    let gable = frame.at(width / 2.0, eaves, 0.12);
    stepped_gable(builder, TownSurface::Plaster, wall, &gable, half, height, 6);
    let name = LocalName::new("town hall clock", "Rathausuhr");
    clock(builder, name, &gable.at(0.0, 3.85, 0.05), 1.45);
    for x in [-1.75, 0.55] {
        window_panel(builder, timber::TOWN_HALL, &gable.at(0.0, 0.0, 0.04), [x, 0.5], [1.2, 1.75]);
    }
    let top = height - 1.0;
    let reach = -top / slope;
    for side in [-1.0, 1.0] {
        let corners = [
            gable.point(side * half, 0.05, -0.4),
            gable.point(side * half, 0.05, 0.0),
            gable.point(0.0, top, -0.4),
            gable.point(0.0, top, reach),
        ];
        builder.facing(TownSurface::Tiles, tint, &[corners[0], corners[2], corners[3]], Vec3::Y);
    }

    // A turret with a bell stands on the ridge.
    let turret = frame.at(width / 2.0, eaves + ROOF - 0.8, -DEPTH / 2.0);
    builder.prism(TownSurface::Planks, vec3(0.9, 0.85, 0.8), &turret, 6, [0.95, 0.95], [0.0, 2.6]);
    builder.prism(TownSurface::Slate, Vec3::ONE, &turret, 6, [1.25, 0.75], [2.6, 3.5]);
    builder.prism(TownSurface::Slate, Vec3::ONE, &turret, 6, [0.75, 0.0], [3.5, 7.2]);
    builder.turned(TownSurface::Gold, Vec3::ONE, &turret, 6, &[(0.0, 7.0), (0.18, 7.25), (0.0, 7.5)]);
}

/// Builds the arcade along the square, with doors and windows behind it.
fn arcade(builder: &mut Builder, frame: &SiteFrame, width: f32) {
    let stone = Vec3::ONE;
    let span = width / ARCHES as f32;
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    for k in 0..ARCHES {
        let left = span * k as f32;
        let arch = Arch {
            wall: [left, left + span],
            top: FIRST,
            middle: left + span / 2.0,
            half: span / 2.0 - 0.42,
            spring: 2.35,
            depth: PIER,
        };
        arch.face(builder, TownSurface::Ashlar, stone, frame);
        arch.vault(builder, TownSurface::Ashlar, stone, frame);
        for (x, w) in [(left, 0.42), (left + span - 0.42, 0.42)] {
            builder.beam(
                TownSurface::Ashlar,
                stone * 0.95,
                frame,
                vec3(x - 0.02, 2.2, -PIER - 0.03),
                vec3(x + w + 0.05, 2.38, 0.06),
            );
        }

        // The wall behind.
        let behind = frame.at(0.0, 0.0, -ARCADE);
        let second = if k % 2 == 0 { ground_floors::ARCH } else { ground_floors::SHOP };
        for (j, cell) in [ground_floors::GROUND_WINDOWS[1], second].into_iter().enumerate() {
            let across = [j, j + 1].map(|j| left + span / 2.0 * j as f32);
            let (surface, tint) = (TownSurface::GroundFloor(1), Vec3::splat(0.62));
            Bay { surface, tint, cell, across, height: [0.0, FIRST - 0.2] }.build(builder, &behind);
        }
    }
    builder.lit(
        TownSurface::Planks,
        Vec3::splat(0.8),
        &[
            (p(0.0, FIRST - 0.2, -ARCADE), 0.4),
            (p(width, FIRST - 0.2, -ARCADE), 0.4),
            (p(width, FIRST - 0.2, -PIER), 0.5),
            (p(0.0, FIRST - 0.2, -PIER), 0.5),
        ],
    );
    builder.lit(
        TownSurface::Slabs,
        stone,
        &[
            (p(0.0, 0.02, 0.0), 0.7),
            (p(width, 0.02, 0.0), 0.7),
            (p(width, 0.02, -ARCADE), 0.45),
            (p(0.0, 0.02, -ARCADE), 0.45),
        ],
    );
    for (x, out) in [(0.02, frame.right), (width - 0.02, -frame.right)] {
        builder.facing(
            TownSurface::Ashlar,
            stone * 0.6,
            &[p(x, 0.0, -PIER), p(x, 0.0, -ARCADE), p(x, FIRST, -ARCADE), p(x, FIRST, -PIER)],
            out,
        );
    }
}
