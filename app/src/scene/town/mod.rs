//! The built-in old town, made from a seed.
//!
//! `plan` lays out the way, the square and the lots; `street` paves them; `house` and its neighbours build on the lots with the
//! help of `builder`; `surface` has the pictures painted by `paint` on a `canvas`. Everything is computed from sums, products,
//! quotients and square roots, and every part rolls dice of its own, so a seed gives the same town to the bit.

mod builder;
mod canvas;
mod church;
mod fountain;
mod furniture;
mod gate;
mod house;
mod market;
mod masonry;
mod nature;
mod paint;
mod plan;
mod roof;
mod skyline;
mod street;
mod surface;
mod town_hall;
mod turn;

use glam::{DVec3, Vec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::scene::{Lighting, Scene, Start};
use builder::{Builder, Frame};
use house::Builders;
use plan::{Plan, Use, on_ground};

/// Dice for one part of the town, independent of how often any other part rolled its own.
fn dice(seed: u64, part: u64) -> ChaCha8Rng {
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    dice.set_stream(part);
    dice
}

/// Builds the old town.
///
/// *Frames, units*: metres, y up, the middle of the market square near the origin; north is −z. The circuit runs clockwise
/// on a map, some 450 m, at least 1.2 m clear of anything solid.
pub fn build(seed: u64) -> Scene {
    let plan = Plan::new(&mut dice(seed, 0));
    let mut builder = Builder::default();

    // Pave the ground.
    street::pave(&mut builder, &plan);
    street::pave_square(&mut builder, &plan);

    // Build on the lots.
    for (side, row) in plan.rows.iter().enumerate() {
        let mut builders = Builders::default();
        let mut dice = dice(seed, 1 + side as u64);
        for (number, lot) in row.iter().enumerate() {
            builder.district(lot.district);
            let [a, b] = lot.front;
            let right = on_ground(b) - on_ground(a);
            let out = Vec3::new(right.x, 0.0, right.z).normalize().cross(Vec3::Y);
            match lot.kind {
                Use::House => {
                    let house = builders.house(&mut builder, lot, &mut dice);
                    furniture::furnish(&mut builder, &house, number, &mut dice);
                }
                Use::TownHall => town_hall::build(&mut builder, &Frame::facing(on_ground(a), out), a.distance(b)),
                Use::Church => {
                    church::build(&mut builder, &Frame::facing(on_ground((a + b) / 2.0), out), a.distance(b));
                }
                Use::Gate => {}
            }
        }
    }
    builder.district("gate");
    let gate = plan.gate_station();
    let ahead = Vec3::new(gate.ahead.x, 0.0, gate.ahead.y);
    gate::build(&mut builder, &Frame::facing(on_ground(gate.at), -ahead), plan::GATE_DEPTH);
    furnish_square(&mut builder, &mut dice(seed, 3));

    // Close the view.
    let mut dice = dice(seed, 4);
    skyline::second_row(&mut builder, &plan, &mut dice);
    skyline::yards(&mut builder, &mut dice);
    skyline::town_wall(&mut builder);
    nature::country(&mut builder);

    // Paint the surfaces and hand everything over.
    let (materials, textures) = surface::materials(seed as u32);
    let circuit = plan.circuit();
    let look = (circuit[1] - circuit[0]).normalize();
    Scene {
        name: "old town".into(),
        origin: DVec3::ZERO,
        textures,
        materials,
        meshes: builder.finish(surface::Surface::number),
        light: daylight(),
        start: Start { position: circuit[0], look },
        circuit,
        notices: vec![],
    }
}

/// Sets up what stands on the market square.
fn furnish_square(builder: &mut Builder, dice: &mut ChaCha8Rng) {
    builder.district("market square");
    let place = |x: f32, z: f32, turns: f32| Frame::turned(Vec3::new(x, 0.0, z), turns);
    fountain::build(builder, &place(-6.0, 1.0, 0.25));
    for (x, z, turns) in [
        (-15.0, 16.0, 0.22),
        (-11.0, 18.5, 0.30),
        (-16.5, -13.0, 0.27),
        (-12.0, -16.5, 0.20),
        (-7.0, -17.0, 0.26),
        (-5.5, 17.5, 0.28),
    ] {
        market::stall(builder, &place(x, z, turns), dice);
    }
    for (x, z) in [(14.5, -15.5), (14.0, 16.5), (14.8, 21.5), (-19.5, 20.5)] {
        let frame = place(x, z, 0.0);
        nature::tree(builder, &frame, dice.random_range(8.0..10.5), dice);
        masonry::basin(builder, surface::Surface::Ashlar, &frame, 8, [1.0, 0.8], [0.0, 0.42]);
    }
    for (x, z, turns) in [(12.4, -15.5, 0.75), (12.0, 16.5, 0.75), (-1.0, 4.6, 0.3)] {
        market::bench(builder, &place(x, z, turns));
    }
    for (x, z) in [(-1.2, -9.0), (-1.0, 12.0), (11.5, 9.5), (11.5, -9.5)] {
        furniture::lamp_post(builder, &place(x, z, 0.25));
    }
    for (x, z) in [(-13.2, 14.3), (-13.9, 14.9), (-9.4, -15.0)] {
        market::barrel(builder, &place(x, z, 0.1));
    }
    fountain::well(builder, &place(12.0, -20.5, 0.1));
}

/// A clear late morning: the sun stands in the south-east.
fn daylight() -> Lighting {
    Lighting {
        sun_direction: Vec3::new(0.36, 0.88, 0.44).normalize(),
        sky: [0.34, 0.39, 0.47],
        ground: [0.20, 0.18, 0.155],
        ..Lighting::default()
    }
}
