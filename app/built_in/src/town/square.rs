//! Furnishing of the market square.

use glam::{Vec3, vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::builder::{Builder, SiteFrame};
use super::surface::TownSurface;
use super::{fountain, furniture, market, masonry, nature};

/// Place and heading of an object: x and z in metres, and its direction in turns from south towards east.
type SitePlace = (f32, f32, f32);

const FOUNTAIN: SitePlace = (-6.0, 1.0, 0.25);
const WELL: SitePlace = (12.0, -20.5, 0.1);
const STALLS: [SitePlace; 6] = [
    (-15.0, 16.0, 0.22),
    (-11.0, 18.5, 0.30),
    (-5.5, 17.5, 0.28),
    (-16.5, -13.0, 0.27),
    (-12.0, -16.5, 0.20),
    (-7.0, -17.0, 0.26),
];
const TREES: [SitePlace; 4] = [(14.5, -15.5, 0.0), (14.0, 16.5, 0.3), (14.8, 21.5, 0.6), (-19.5, 20.5, 0.9)];
const BENCHES: [SitePlace; 3] = [(12.4, -15.5, 0.75), (12.0, 16.5, 0.75), (-1.0, 4.6, 0.3)];
const LAMPS: [SitePlace; 4] = [(-1.2, -9.0, 0.25), (-1.0, 12.0, 0.25), (11.5, 9.5, 0.25), (11.5, -9.5, 0.25)];
const BARRELS: [SitePlace; 3] = [(-13.2, 14.3, 0.0), (-13.9, 14.9, 0.4), (-9.4, -15.0, 0.7)];
const TABLES: [SitePlace; 4] = [(14.6, -8.2, 0.1), (16.2, -5.2, 0.4), (13.2, -5.6, 0.8), (15.2, 7.6, 0.3)];
const TUBS: [SitePlace; 7] = [
    (-22.8, -8.2, 0.1),
    (-22.8, -4.1, 0.5),
    (-22.8, 4.1, 0.9),
    (-22.8, 8.2, 0.3),
    (11.8, -7.2, 0.0),
    (11.8, -3.9, 0.4),
    (17.8, 3.6, 0.7),
];

/// Sets up fountain, well, stalls, trees, benches and lamps.
pub(super) fn furnish(builder: &mut Builder, dice: &mut ChaCha8Rng) {
    builder.district("market square");
    let frame = |(x, z, turns): SitePlace| SiteFrame::turned(vec3(x, 0.0, z), turns);
    fountain::build(builder, &frame(FOUNTAIN));
    fountain::well(builder, &frame(WELL));
    for place in STALLS {
        market::stall(builder, &frame(place), dice);
    }
    for place in TREES {
        nature::tree(builder, &frame(place), dice.random_range(8.5..10.5), 36, dice);
        masonry::basin(builder, TownSurface::Ashlar, &frame(place), 8, [1.0, 0.8], [0.0, 0.42]);
        builder.prism(TownSurface::Grass, Vec3::splat(0.6), &frame(place), 8, [0.85, 0.85], [0.2, 0.3]);
    }
    for place in BENCHES {
        market::bench(builder, &frame(place));
    }
    for place in LAMPS {
        furniture::lamp_post(builder, &frame(place));
    }
    for place in BARRELS {
        market::barrel(builder, &frame(place));
    }
    for (number, place) in TABLES.into_iter().enumerate() {
        market::table(builder, &frame(place), number);
    }
    for place in TUBS {
        nature::tub(builder, &frame(place), dice);
    }
}
