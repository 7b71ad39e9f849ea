//! A pixel must show the place from which light reaches it. For each pixel the program tells the place of the scene
//! that it shows. Light from there arrives from a direction that is known exactly, and that must be the pixel's own
//! direction.
//!
//! In a wrong program, a vertex formula that cancels gives errors astern of minutes of arc that grow as γ² (other
//! programs: 17′, 12′ and 7′ at γ = 701 and 100). Flat triangles that are too large give degrees between vertices. A
//! map that is too coarse gives the size of its texels.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use built_in::town;
use glam::DVec3;
use measure::direction::{self, ARCMIN_PER_RAD};
use measure::quantiles::Sorted;
use physics::{Celerity, Event, Observer};
use scene::Scene;
use system_tests::photographer::{DEFAULT_MAP, Photographer};
use system_tests::turns::turn;
use system_tests::view::{View, middle};
use view::Dial;

const SIZE: [u32; 2] = [320, 240];
const FOV_DEGREES: f64 = 60.0;

/// Size of a pixel at the middle of such a picture, arcminutes.
const PIXEL_ARCMIN: f64 = 16.5;

/// Tolerance requested from `polygon`, pixels.
const TOLERANCE_PX: f64 = 0.05;

/// Tenth of the smallest error that other programs' formulas have at γ = 701, arcminutes.
const TENTH_OF_OTHERS_ARCMIN: f64 = 1.2;

/// Half the diagonal of a texel of the default map, eight to the pixel, arcminutes.
const MAP_ARCMIN: f64 = 0.5 * std::f64::consts::SQRT_2 * PIXEL_ARCMIN / 8.0;

const LATTICE: Lattice = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 };

/// Errors of a picture; pixels that show no surface do not count.
fn errors(scene: &Scene, method: Dial, eye: DVec3, celerity: DVec3, look: DVec3) -> Sorted {
    let view = View { look, up: DVec3::Y, fov_degrees: FOV_DEGREES, size: SIZE };
    let celerity = Celerity::new(celerity).unwrap();
    let mut photographer = Photographer::with(scene, SIZE, 1, None, method);
    let places = photographer.places(&view, eye, celerity);
    let pixels = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row]));
    // What moves has places of its own frame; the hands of clocks are compared with rays in `clocks`.
    let resting = |(pixel, shown): ([u32; 2], Option<studio::Shown>)| {
        let shown = shown.filter(|shown| shown.motion.is_none())?;
        Some((view.direction(middle(pixel)), shown.position + scene.origin))
    };
    let shown = pixels.zip(places).filter_map(resting);
    let observer = Observer { event: Event { ct: 0.0, position: eye }, celerity };
    direction::errors(&observer, shown)
}

fn polygon() -> Dial {
    Dial::tolerance(TOLERANCE_PX)
}

/// Checks a picture's errors against the bounds of each method, for all pixels and for 99 of 100. `rounding` is the
/// uncertainty of the places themselves, which are in f32, arcminutes.
fn hold(scene: &Scene, eye: DVec3, celerity: DVec3, look: DVec3, rounding: f64) {
    for (method, most, usual) in [
        (polygon(), TOLERANCE_PX * PIXEL_ARCMIN, 0.5 * TOLERANCE_PX * PIXEL_ARCMIN),
        (DEFAULT_MAP, 1.1 * MAP_ARCMIN, 0.8 * MAP_ARCMIN),
    ] {
        let errors = errors(scene, method, eye, celerity, look);
        let (all, of_99) = (errors.quantile(1.0), errors.quantile(0.99));
        let picture = format!("{method} at {celerity} towards {look}: {all:.4}′, 99 % {of_99:.4}′");
        println!("{picture}, median {:.4}′, {} pixels", errors.quantile(0.5), errors.count());
        assert!(errors.count() > 5000, "{picture}: {} pixels show a surface", errors.count());
        assert!(all <= most + rounding && of_99 <= usual + rounding, "{picture}");
        assert!(of_99 <= TENTH_OF_OTHERS_ARCMIN, "{picture}");
    }
}

fn celerity(gamma: f64) -> f64 {
    (gamma * gamma - 1.0).sqrt()
}

#[test]
fn boxes_are_where_they_are_seen() {
    let scene = LATTICE.build();
    for gamma in [1.0, 1.25, 2.3, 7.1] {
        hold(&scene, DVec3::new(0.3, 0.4, 2.0), DVec3::NEG_Z * celerity(gamma), DVec3::NEG_Z, 0.0);
    }
    // At γ = 701 everything in the picture but its middle is astern in the world: a box 1.6 m behind, enlarged 1400
    // times at most.
    let rounding = 2.0_f64.powi(-23) / 1.6 * 1402.0 * ARCMIN_PER_RAD;
    hold(&scene, DVec3::new(2.1, 1.9, -0.1), DVec3::NEG_Z * celerity(701.0), DVec3::new(0.1, 0.0, -1.0), rounding);
}

#[test]
fn the_town_is_where_it_is_seen() {
    let _turn = turn();
    let scene = town::build(1);
    let eye = scene.start.position + DVec3::Y * 1.6;
    let ahead = scene.start.look;
    for gamma in [5.0 / 3.0, 701.0] {
        hold(&scene, eye, ahead * celerity(gamma), ahead, 0.0);
    }
    hold(&scene, eye, ahead * celerity(701.0), ahead.cross(DVec3::Y), 0.0);
}
