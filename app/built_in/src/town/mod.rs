//! Built-in old town, made from a seed.
//!
//! `plan` lays out the way, the square and the lots. `street` paves them. `house` and the other building modules
//! build on the lots with the help of `builder`. `surface` lists the pictures, which `paint` paints on a `canvas`.
//! Painting takes most of the time; so `paint_pictures` can be left out where its pictures have been kept.
//! Everything is computed from sums, products, quotients and square roots, and every part has a random generator of
//! its own, so a seed gives the same town to the bit.

mod builder;
mod canvas;
mod church;
mod facade;
mod fountain;
mod furniture;
mod gate;
mod house;
mod market;
mod masonry;
mod nature;
pub(crate) mod paint;
mod pictures;
mod plan;
mod roof;
mod skyline;
mod square;
mod street;
mod surface;
mod town_hall;

use glam::{DVec3, Vec2, Vec3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::clock::HandKind;
use builder::{Builder, SiteFrame};
use house::Builders;
pub use pictures::{EDITION, TownPicture};
use plan::{TownPlan, Use, on_ground};
use scene::{Lighting, LocalName, NamedPlace, Scene, Start};
use surface::TownSurface;

/// Seed of the town that everybody sees.
pub const TOWN_SEED: u64 = 1;

/// Random generator for one part of the town, independent of the numbers drawn by any other part.
fn dice(seed: u64, part: u64) -> ChaCha8Rng {
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    dice.set_stream(part);
    dice
}

/// Paints the pictures on the town's surfaces. `painted` hears, on any thread, how many are finished, and of how many.
pub fn paint_pictures(seed: u64, painted: impl Fn(usize, usize) + Sync) -> Vec<TownPicture> {
    surface::paint(seed as u32, painted)
}

/// Builds the old town, its pictures painted anew.
pub fn build(seed: u64) -> Scene {
    build_with(seed, paint_pictures(seed, |_, _| ())).expect("there is a picture for each surface that has one")
}

/// Builds the old town with pictures of [`paint_pictures`] that were kept; `None` if they are not as many as it has.
///
/// *Frames, units*: metres, y up, the middle of the market square near the origin; north is −z. The circuit runs
/// clockwise on a map, some 415 m, at least 1.5 m clear of anything solid.
pub fn build_with(seed: u64, pictures: Vec<TownPicture>) -> Option<Scene> {
    let (materials, textures) = surface::materials(pictures)?;
    let plan = TownPlan::new(&mut dice(seed, 0));
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
                Use::TownHall => town_hall::build(&mut builder, &SiteFrame::facing(on_ground(a), out), a.distance(b)),
                Use::Church => {
                    church::build(&mut builder, &SiteFrame::facing(on_ground((a + b) / 2.0), out), a.distance(b));
                }
                Use::Gate => {}
            }
        }
    }
    builder.district("gate");
    let gate = plan.gate_station();
    let ahead = Vec3::new(gate.ahead.x, 0.0, gate.ahead.y);
    gate::build(&mut builder, &SiteFrame::facing(on_ground(gate.at), -ahead), plan::GATE_DEPTH);
    square::furnish(&mut builder, &mut dice(seed, 3));
    for (number, station) in plan.festive_stations().into_iter().enumerate() {
        furniture::bunting(&mut builder, station, number);
    }

    // Close the view.
    let mut dice = dice(seed, 4);
    skyline::second_row(&mut builder, &plan, &mut dice);
    skyline::yards(&mut builder, &mut dice);
    skyline::town_wall(&mut builder);
    nature::country(&mut builder, &daylight());

    // Hand everything over.
    let circuit = plan.circuit();
    let look = (circuit[1] - circuit[0]).normalize();
    let clocks = std::mem::take(&mut builder.clocks);
    let mut scene = Scene {
        name: "old town".into(),
        origin: DVec3::ZERO,
        textures,
        materials,
        meshes: builder.finish(TownSurface::number),
        light: daylight(),
        start: Start { position: circuit[0], look, ..Start::default() },
        places: places(&plan),
        circuit,
        ..Scene::default()
    };
    for clock in clocks {
        clock.furnish(&mut scene, &[HandKind::Seconds, HandKind::Rounds], TownSurface::Hand.number());
    }
    Some(scene)
}

/// Places to which an observer can jump, all on the way.
fn places(plan: &TownPlan) -> Vec<NamedPlace> {
    let way = &plan.way;
    let place = |english: &str, german: &str, station: usize, look: Vec2| NamedPlace {
        name: LocalName::new(english, german),
        start: Start {
            position: on_ground(way[station].at).as_dvec3(),
            look: Vec3::new(look.x, 0.0, look.y).normalize().as_dvec3(),
            ..Start::default()
        },
    };
    // Twenty metres before the gate and behind it, and where the way passes between church and town hall.
    let [enter, leave] = plan.gate.map(|station| way[station].at);
    let [before, behind] = [plan.gate[0] - 14, plan.gate[1] + 14];
    let at_square = (0..plan.street[0]).min_by(|&a, &b| way[a].at.y.abs().total_cmp(&way[b].at.y.abs()));
    let at_square = at_square.unwrap_or_default();
    vec![
        place("market square", "Marktplatz", 0, way[1].at - way[0].at),
        place("before the church", "vor der Kirche", at_square, Vec2::X),
        place("before the town hall", "vor dem Rathaus", at_square, Vec2::NEG_X),
        place("before the gate", "vor dem Tor", before, enter - way[before].at),
        place("behind the gate", "hinter dem Tor", behind, leave - way[behind].at),
    ]
}

/// Light of a clear late morning: the sun stands in the south-east.
fn daylight() -> Lighting {
    Lighting {
        sun_direction: Vec3::new(0.36, 0.88, 0.44).normalize(),
        sky: [0.34, 0.39, 0.47],
        ground: [0.20, 0.18, 0.155],
        ..Lighting::default()
    }
}
