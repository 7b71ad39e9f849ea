//! What stands and hangs along the streets: doorsteps, lamps, signs, flower boxes, barrels.

use glam::{Vec3, vec2, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, Corner, Frame};
use super::house::House;
use super::market;
use super::nature;
use super::paint::openings;
use super::surface::Surface;

/// Furnishes the front of a house, the `number`th of its row.
pub(super) fn furnish(builder: &mut Builder, house: &House, number: usize, dice: &mut ChaCha8Rng) {
    let frame = &house.frame;
    for &(x, cell) in &house.bays {
        if cell == openings::DOOR {
            builder.block(
                Surface::Slabs,
                Vec3::ONE,
                &frame.at(x, 0.0, 0.0),
                vec3(-0.75, -0.1, -0.1),
                vec3(0.75, 0.24, 0.32),
            );
        }
    }
    let shop = house.bays.iter().find(|(_, cell)| *cell == openings::SHOP);
    if let Some(&(x, _)) = shop
        && dice.random_bool(0.8)
    {
        let side = if x > house.width / 2.0 { 1.1 } else { -1.1 };
        let place = (x + side).clamp(0.4, house.width - 0.4);
        sign(builder, &frame.at(place, 3.0, 0.0), dice.random_range(0..8), house.jetty);
    } else if number.is_multiple_of(2) {
        lamp(builder, &frame.at(dice.random_range(0.3..0.7) * house.width, 2.7, 0.0), house.jetty);
    }
    if dice.random_bool(0.42) {
        for &x in &house.windows {
            nature::flower_box(builder, &frame.at(x, house.ground_floor + 0.72, house.jetty), 1.15, dice);
        }
    }
    let bare = house.bays.iter().find(|(_, cell)| *cell == openings::BARE);
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

/// A lantern on a bracket; `frame` lies on the wall.
fn lamp(builder: &mut Builder, frame: &Frame, jetty: f32) {
    let out = jetty + 0.45;
    builder.rod(Surface::Iron, Vec3::ONE, frame.origin, frame.point(0.0, 0.0, out), 0.045);
    builder.rod(Surface::Iron, Vec3::ONE, frame.point(0.0, -0.4, 0.0), frame.point(0.0, 0.0, 0.42), 0.035);
    lantern(builder, &frame.at(0.0, -0.52, out - 0.03));
}

/// The lantern itself, hanging from its top at 0.5 m above `frame`.
fn lantern(builder: &mut Builder, frame: &Frame) {
    builder.prism(Surface::Lantern, Vec3::ONE, frame, 4, [0.10, 0.17], [0.04, 0.36]);
    builder.prism(Surface::Iron, Vec3::ONE, frame, 4, [0.23, 0.0], [0.36, 0.54]);
    builder.prism(Surface::Iron, Vec3::ONE, frame, 4, [0.10, 0.0], [0.04, -0.04]);
}

/// A lamp post with two lanterns.
pub(super) fn lamp_post(builder: &mut Builder, frame: &Frame) {
    builder.turned(
        Surface::Iron,
        Vec3::ONE,
        frame,
        6,
        &[(0.2, 0.0), (0.17, 0.25), (0.07, 0.5), (0.05, 3.3), (0.09, 3.4), (0.03, 3.75), (0.0, 3.9)],
    );
    builder.rod(Surface::Iron, Vec3::ONE, frame.point(-0.6, 3.3, 0.0), frame.point(0.6, 3.3, 0.0), 0.045);
    for x in [-0.55, 0.55] {
        lantern(builder, &frame.at(x, 2.78, 0.0));
    }
}

/// A guild sign on a bracket, square to the wall that `frame` lies on.
fn sign(builder: &mut Builder, frame: &Frame, kind: i32, jetty: f32) {
    let y = -0.35;
    let end = frame.point(0.0, y + 0.04, 0.95 + 0.3 * jetty);
    builder.rod(Surface::Iron, Vec3::ONE, frame.point(0.0, y + 0.04, 0.0), end, 0.045);
    builder.rod(Surface::Iron, Vec3::ONE, frame.point(0.0, y + 0.4, 0.0), frame.point(0.0, y + 0.04, 0.6), 0.03);
    let [u, v] = [(kind % 4) as f32 / 4.0, (kind / 4) as f32 / 4.0];
    let (near, far) = (0.28, 0.92);
    for side in [1.0_f32, -1.0] {
        // Seen from either side the picture reads the right way round.
        let corner = |s: f32, t: f32| {
            let z = if side > 0.0 { far + (near - far) * s } else { near + (far - near) * s };
            Corner::new(
                frame.point(0.012 * side, y - 0.66 + 0.64 * t, z),
                vec2(u + 0.004 + 0.242 * s, 1.0 - v - 0.004 - 0.242 * t),
            )
        };
        builder.face(
            Surface::Signs,
            Vec3::ONE,
            &[corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)],
        );
    }
}
