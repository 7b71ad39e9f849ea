//! Street furniture: doorsteps, lamps, signs, flower boxes, barrels.

use glam::{Vec3, vec2};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, MeshCorner, SiteFrame};
use super::house::House;
use super::market;
use super::nature;
use super::paint::ground_floors;
use super::plan::{Station, on_ground};
use super::surface::TownSurface;

/// Furnishes the front of a house, the `number`th of its row.
pub(super) fn furnish(builder: &mut Builder, house: &House, number: usize, dice: &mut ChaCha8Rng) {
    let frame = &house.frame;
    for &(x, cell) in &house.bays {
        if cell == ground_floors::DOOR {
            doorstep(builder, &frame.at(x, 0.0, 0.0));
        }
    }
    let shop = house.bays.iter().find(|(_, cell)| *cell == ground_floors::SHOP);
    if let Some(&(x, _)) = shop
        && dice.random_bool(0.8)
    {
        let side = if x > house.width / 2.0 { 1.1 } else { -1.1 };
        let place = (x + side).clamp(0.4, house.width - 0.4);
        sign(builder, &frame.at(place, 3.0, 0.0), dice.random_range(0..8), house.jetty);
    } else if number.is_multiple_of(3) {
        lamp(builder, &frame.at(dice.random_range(0.3..0.7) * house.width, 2.7, 0.0), house.jetty);
    }
    if dice.random_bool(0.42) {
        for &x in &house.windows {
            nature::flower_box(builder, &frame.at(x, house.ground_floor + 0.72, house.jetty), 1.15, dice);
        }
    }
    let bare = house.bays.iter().find(|(_, cell)| *cell == ground_floors::BARE);
    if let Some(&(x, _)) = bare {
        match dice.random_range(0..3) {
            0 => nature::ivy(builder, &frame.at(0.0, 0.0, 0.0), x - 1.1, 2.2, house.ground_floor - 0.1),
            1 => {
                market::barrel(builder, &frame.at(x - 0.3, 0.05, 0.42));
                market::barrel(builder, &frame.at(x + 0.4, 0.05, 0.40));
            }
            _ => market::bench(builder, &frame.at(x, 0.05, 0.28)),
        }
    }
}

/// Builds a stone step before a door; `frame` lies at the foot of the wall.
fn doorstep(builder: &mut Builder, frame: &SiteFrame) {
    let (half, low, high, out) = (0.75, -0.1, 0.24, 0.32);
    let p = |x: f32, y: f32, z: f32| frame.point(x, y, z);
    let faces = [
        [p(-half, low, out), p(half, low, out), p(half, high, out), p(-half, high, out)],
        [p(-half, high, out), p(half, high, out), p(half, high, 0.0), p(-half, high, 0.0)],
        [p(half, low, out), p(half, low, 0.0), p(half, high, 0.0), p(half, high, out)],
        [p(-half, low, 0.0), p(-half, low, out), p(-half, high, out), p(-half, high, 0.0)],
    ];
    for face in faces {
        builder.metric(TownSurface::Slabs, Vec3::ONE, &face);
    }
}

/// Builds a lantern on a bracket; `frame` lies on the wall.
fn lamp(builder: &mut Builder, frame: &SiteFrame, jetty: f32) {
    let out = jetty + 0.45;
    builder.rod(TownSurface::Iron, Vec3::ONE, frame.origin, frame.point(0.0, 0.0, out), 0.045);
    builder.rod(TownSurface::Iron, Vec3::ONE, frame.point(0.0, -0.4, 0.0), frame.point(0.0, 0.0, 0.42), 0.035);
    lantern(builder, &frame.at(0.0, -0.52, out - 0.03));
}

/// Builds the lantern itself; its top, from which it hangs, is 0.5 m above `frame`.
fn lantern(builder: &mut Builder, frame: &SiteFrame) {
    builder.prism(TownSurface::Lantern, Vec3::ONE, frame, 4, [0.10, 0.17], [0.04, 0.36]);
    builder.prism(TownSurface::Iron, Vec3::ONE, frame, 4, [0.23, 0.0], [0.36, 0.54]);
    builder.prism(TownSurface::Iron, Vec3::ONE, frame, 4, [0.10, 0.0], [0.04, -0.04]);
}

/// Builds a lamp post with two lanterns.
pub(super) fn lamp_post(builder: &mut Builder, frame: &SiteFrame) {
    builder.turned(
        TownSurface::Iron,
        Vec3::ONE,
        frame,
        6,
        &[(0.2, 0.0), (0.17, 0.25), (0.07, 0.5), (0.05, 3.3), (0.09, 3.4), (0.03, 3.75), (0.0, 3.9)],
    );
    builder.rod(TownSurface::Iron, Vec3::ONE, frame.point(-0.6, 3.3, 0.0), frame.point(0.6, 3.3, 0.0), 0.045);
    for x in [-0.55, 0.55] {
        lantern(builder, &frame.at(x, 2.78, 0.0));
    }
}

/// Builds a guild sign on a bracket, square to the wall that `frame` lies on.
fn sign(builder: &mut Builder, frame: &SiteFrame, kind: i32, jetty: f32) {
    let y = -0.35;
    let end = frame.point(0.0, y + 0.04, 0.95 + 0.3 * jetty);
    builder.rod(TownSurface::Iron, Vec3::ONE, frame.point(0.0, y + 0.04, 0.0), end, 0.045);
    builder.rod(TownSurface::Iron, Vec3::ONE, frame.point(0.0, y + 0.4, 0.0), frame.point(0.0, y + 0.04, 0.6), 0.03);
    let [u, v] = [(kind % 4) as f32 / 4.0, (kind / 4) as f32 / 4.0];
    let (near, far) = (0.28, 0.92);
    for side in [1.0_f32, -1.0] {
        // The picture reads the right way round from either side.
        let corner = |s: f32, t: f32| {
            let z = if side > 0.0 { far + (near - far) * s } else { near + (far - near) * s };
            MeshCorner::new(
                frame.point(0.012 * side, y - 0.66 + 0.64 * t, z),
                vec2(u + 0.004 + 0.242 * s, 1.0 - v - 0.004 - 0.242 * t),
            )
        };
        builder.face(
            TownSurface::Signs,
            Vec3::ONE,
            &[corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
        );
    }
}

/// Builds a hanging cloth, the middle of its lower edge at the frame's origin; `number` chooses its colours.
pub(super) fn banner(builder: &mut Builder, frame: &SiteFrame, [width, height]: [f32; 2], number: usize) {
    let stripe = (number % 4) as f32 / 4.0 + 0.03;
    let corner = |s: f32, t: f32| {
        MeshCorner::new(frame.point((s - 0.5) * width, t * height, 0.0), vec2(0.375 + s, stripe + 0.19 * (1.0 - t)))
    };
    let point = MeshCorner::new(frame.point(0.0, -0.5, 0.0), vec2(0.875, stripe + 0.19));
    builder.face(
        TownSurface::Awning,
        Vec3::ONE,
        &[corner(0.0, 0.0), point, corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
    );
    let (left, right) = (frame.point(-0.6 * width, height, 0.0), frame.point(0.6 * width, height, 0.0));
    builder.rod(TownSurface::Gold, Vec3::ONE, left, right, 0.06);
}

/// Builds pennants on a line across the street at a station of the way.
pub(super) fn bunting(builder: &mut Builder, station: &Station, number: usize) {
    const PENNANTS: usize = 9;
    builder.district("bunting");
    let [left, right] = station.width;
    let ahead = Vec3::new(station.ahead.x, 0.0, station.ahead.y);
    // The line sags from wall to wall and bends a little along the street.
    let at = |k: usize| {
        let s = k as f32 / PENNANTS as f32;
        let sag = 4.0 * s * (1.0 - s);
        let across = -left - 0.4 + s * (left + right + 0.8);
        on_ground(station.beside(across)) + Vec3::Y * (5.0 - 0.75 * sag) + ahead * (0.8 * s - 0.4)
    };
    for k in 0..PENNANTS {
        let (a, b) = (at(k), at(k + 1));
        let middle = (a + b) / 2.0 - Vec3::Y * 0.42;
        let stripe = ((k + number) % 4) as f32 / 4.0;
        let corner = |at: Vec3, s: f32, t: f32| MeshCorner::new(at, vec2(0.27 + 0.2 * s, stripe + 0.03 + 0.19 * t));
        let cord = Vec3::Y * 0.03;
        builder.face(
            TownSurface::Awning,
            Vec3::ONE,
            &[corner(a.lerp(b, 0.1), 0.0, 0.0), corner(middle, 0.5, 1.0), corner(a.lerp(b, 0.9), 1.0, 0.0)],
        );
        builder.face(TownSurface::Awning, Vec3::splat(0.7), &[a, b, b + cord, a + cord].map(|at| corner(at, 0.5, 0.5)));
    }
}
