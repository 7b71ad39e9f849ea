//! Skyline over the roofs: houses in the second row, trees in the yards, the town wall with its towers.

use glam::{Vec2, Vec3, vec2, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, SiteFrame};
use super::canvas::Area;
use super::house::{linear, roof_tint};
use super::nature::{MIDDLE, tree};
use super::paint::timber::FRONTS;
use super::plan::{Lot, SQUARE, TownPlan, Use, on_ground};
use super::roof::Roof;
use super::surface::TownSurface;
use crate::turn::circle;

/// Semi-axes of the town wall, its height, metres, and its number of stretches.
const WALL: Vec2 = vec2(112.0, 98.0);
const WALL_HEIGHT: f32 = 6.5;
const STRETCHES: u32 = 36;

/// Builds a second row of houses behind the lots of both sides.
pub(super) fn second_row(builder: &mut Builder, plan: &TownPlan, dice: &mut ChaCha8Rng) {
    builder.district("second row");
    let mut built: Vec<Vec2> = vec![];
    for row in &plan.rows {
        for lot in row.iter().filter(|lot| lot.kind == Use::House) {
            let place = behind(lot, dice.random_range(17.0..20.0));
            let inside = ((place - MIDDLE) / WALL).length() < 0.88;
            let [west, east, north, south] = SQUARE;
            let at_square = Area::new(west, north, east - west, south - north).distance(place) < 18.0;
            let churchyard = place.x > 18.0 && place.x < 66.0 && place.y.abs() < 18.0;
            let free = plan.way.iter().all(|station| station.at.distance_squared(place) > 19.0 * 19.0)
                && built.iter().all(|other| other.distance_squared(place) > 10.5 * 10.5);
            if !(inside && free) || churchyard || at_square {
                continue;
            }
            built.push(place);
            let direction = (lot.front[1] - lot.front[0]).normalize();
            let out = vec3(-direction.y, 0.0, direction.x);
            let frame = SiteFrame::facing(on_ground(place), out).rotated(dice.random_range(-0.03..0.03));
            if dice.random_bool(0.22) {
                tree(builder, &frame, dice.random_range(9.0..13.0), 16, dice);
            } else {
                let frame = if dice.random_bool(0.5) { frame.rotated(0.25) } else { frame };
                plain_house(builder, &frame, dice);
            }
        }
    }
}

/// Point at a depth behind the middle of a lot's front.
fn behind(lot: &Lot, depth: f32) -> Vec2 {
    let direction = (lot.front[1] - lot.front[0]).normalize();
    (lot.front[0] + lot.front[1]) / 2.0 + vec2(direction.y, -direction.x) * depth
}

/// Builds a house of which only roof and gables are visible.
fn plain_house(builder: &mut Builder, frame: &SiteFrame, dice: &mut ChaCha8Rng) {
    let (half, deep) = (dice.random_range(3.4..4.4), dice.random_range(3.8..5.0));
    let height = dice.random_range(8.0..11.5);
    let front = dice.random_range(0..8);
    let wall = linear(FRONTS[front].plaster());
    let p = |x: f32, y: f32, z: f32| frame.point(x, y - 0.3, z);
    let roof = Roof {
        walls: [p(-half, height, deep), p(half, height, deep), p(half, height, -deep), p(-half, height, -deep)],
        height: half * dice.random_range(1.2..1.5),
        overhang: [0.3, 0.3, 0.3],
        hips: [None, dice.random_bool(0.5).then_some(0.5)],
        surface: TownSurface::Tiles,
        near: None,
        tint: roof_tint(dice),
    };
    roof.build(builder);
    let [a, b, c, d] = roof.walls;
    let [near, far] = roof.ridge();
    let hipped = c.lerp(far, 0.5);
    let hipped_left = d.lerp(far, 0.5);
    let foot = |corner: Vec3| corner - Vec3::Y * height;
    builder.metric(TownSurface::Plaster, wall, &[foot(a), foot(b), b, near, a]);
    if roof.hips[1].is_some() {
        builder.metric(TownSurface::Plaster, wall, &[foot(c), foot(d), d, hipped_left, hipped, c]);
    } else {
        builder.metric(TownSurface::Plaster, wall, &[foot(c), foot(d), d, far, c]);
    }
    builder.metric(TownSurface::Plaster, wall, &[foot(b), foot(c), c, b]);
    builder.metric(TownSurface::Plaster, wall, &[foot(d), foot(a), a, d]);
}

/// Builds trees in the yards inside the ring of streets.
pub(super) fn yards(builder: &mut Builder, dice: &mut ChaCha8Rng) {
    builder.district("second row");
    for (x, z) in [
        (64.0, -12.0),
        (70.0, 6.0),
        (62.0, 18.0),
        (80.0, -22.0),
        (84.0, 14.0),
        (44.0, -30.0),
        (58.0, -34.0),
        (40.0, 26.0),
        (72.0, 28.0),
    ] {
        let place = vec2(x + dice.random_range(-3.0..3.0), z + dice.random_range(-3.0..3.0));
        tree(builder, &SiteFrame::turned(on_ground(place), 0.0), dice.random_range(8.0..13.0), 16, dice);
    }
}

/// Builds the wall round the town, with a tower at every sixth stretch.
pub(super) fn town_wall(builder: &mut Builder) {
    builder.district("town wall");
    let at = |k: u32, out: f32| {
        let c = circle((k % STRETCHES) as f32 / STRETCHES as f32);
        on_ground(MIDDLE + c * (WALL + out)) - Vec3::Y * 0.3
    };
    let up = Vec3::Y * WALL_HEIGHT;
    for k in 0..STRETCHES {
        let (a, b, c, d) = (at(k, 0.0), at(k + 1, 0.0), at(k, 1.4), at(k + 1, 1.4));
        let middle = MIDDLE.extend(0.0);
        let inward = vec3(middle.x, 0.0, middle.y) - a;
        builder.facing(TownSurface::Rubble, Vec3::ONE, &[a, b, b + up, a + up], inward);
        builder.facing(TownSurface::Rubble, Vec3::ONE, &[c, d, d + up, c + up], -inward);
        let ridge = Vec3::Y * (WALL_HEIGHT + 1.3);
        let lift = Vec3::Y * (WALL_HEIGHT - 0.2);
        let (near, far) = (at(k, -0.9), at(k + 1, -0.9));
        let (outer, outer_far) = (at(k, 1.8), at(k + 1, 1.8));
        let (top, top_far) = (at(k, 0.6) + ridge, at(k + 1, 0.6) + ridge);
        builder.facing(TownSurface::Tiles, Vec3::splat(0.9), &[near + lift, far + lift, top_far, top], Vec3::Y);
        builder.facing(TownSurface::Tiles, Vec3::splat(0.9), &[outer + lift, outer_far + lift, top_far, top], Vec3::Y);
        if k % 6 == 3 {
            let tower = SiteFrame::facing(at(k, 0.7), inward.normalize());
            builder.prism(TownSurface::Rubble, Vec3::ONE, &tower, 8, [3.2, 3.2], [0.0, 13.0]);
            builder.prism(TownSurface::Tiles, vec3(0.9, 0.8, 0.78), &tower, 8, [3.8, 0.0], [12.8, 19.0]);
        }
    }
}
