//! A pixel must show the light that reaches the eye along its middle's direction, with that direction taken from the
//! observer's axes to the world's (W 5.1, B 4.1). The `polygon` picture of boxes, drawn with triangles from bent
//! vertices, and the `image` picture, looked up in a map of the world, must agree with the picture of rays traced one
//! by one.
//!
//! In a wrong program, aberration the wrong way round makes boxes crowd astern. Lorentz contraction alone puts
//! straight edges in the wrong places. A picture mirrored or shifted by half a pixel has every outline wrong. A wrong
//! near plane makes holes. Coordinates in f32 about the world's origin tear boxes apart a million metres away.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::DVec3;
use image::RgbaImage;
use physics::{Beta, Celerity};
use scene::Scene;
use scene::refine::refine;
use std::collections::HashSet;
use std::sync::LazyLock;
use system_tests::exact::{Boxes, BoxesSeen, differing};
use system_tests::photographer::{DEFAULT_MAP, Photographer};
use system_tests::turns::turn;
use system_tests::view::View;

/// Size of every picture here, pixels.
const SIZE: [u32; 2] = [640, 480];

/// Linear colour, unlike the colour of any face.
const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];

const LATTICE: Lattice = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 };

/// Longest edge, metres: at 0.99 c and the nearest box, such edges deviate from the true curve by a fifth of a pixel.
const EDGE_M: f32 = 0.09;

/// Largest share of pixels that may differ. A quarter of a promille was measured for a pixel's 256 steps of
/// rasterisation, half a promille for straight edges at 0.99 c. The program promises 0.005.
const SHARE_AT_MOST: f64 = 0.002;

/// Largest share for the `image` renderer: with eight texels to a pixel the nearest one is on average a fifteenth of
/// a pixel away.
const SHARE_OF_MAP: f64 = 0.003;

/// Largest distance of an outline from its exact place, pixels. Straight edges and f32 together were never seen to
/// move one by a quarter.
const REACH: f64 = 0.5;

/// Rays to a pixel in the search for an outline: as fine as the thinnest sliver of a face that was seen.
const RAYS_PER_PIXEL: f64 = 32.0;

/// Place of the eye, metres, between the boxes; no coordinate lies in the plane of a face.
const EYE: DVec3 = DVec3::new(0.375, -0.21875, 0.53125);

/// Direction of the motion. Dead astern is the corner of a box 5.7 m away, since things dead astern are enlarged
/// most.
const MOTION: DVec3 = DVec3::new(-5.13, 1.29, -1.97);

static REFINED: LazyLock<Scene> = LazyLock::new(|| refine(&LATTICE.build(), EDGE_M).unwrap());

fn boxes() -> Boxes {
    Boxes::of(&LATTICE, BACKGROUND)
}

fn photographer(samples: u32) -> Photographer {
    Photographer::new(&REFINED, SIZE, samples, Some(BACKGROUND))
}

/// Views ahead, abeam, astern and obliquely, at several focal lengths.
fn views() -> [View; 4] {
    let view = |look, up, fov_degrees| View { look, up, fov_degrees, size: SIZE };
    [
        view(MOTION, DVec3::Y, 90.0),
        view(MOTION.cross(DVec3::Y), DVec3::Y, 60.0),
        view(-MOTION, DVec3::new(0.1, 1.0, 0.0), 75.0),
        view(DVec3::new(-3.0, 2.0, 7.0), DVec3::new(0.7, 0.3, -0.2), 80.0),
    ]
}

fn at(beta: f64) -> Celerity {
    Beta::new(MOTION.normalize() * beta).unwrap().celerity()
}

/// Asserts that few pixels differ from the exact picture, and that each of those shows a colour that is exact at most
/// half a pixel away.
fn assert_exact(drawn: &RgbaImage, sight: &BoxesSeen<'_>, at_most: f64, what: &str) {
    let exact = sight.picture();
    let mut colours: Vec<_> = exact.pixels().collect();
    colours.sort_by_key(|pixel| pixel.0);
    colours.dedup();
    assert!(colours.len() >= 2, "{what}: {} colours are too few to compare", colours.len());

    let differing = differing(drawn, &exact);
    let share = differing.len() as f64 / f64::from(SIZE[0] * SIZE[1]);
    let stray = differing.iter().find(|&&[column, row]| {
        !sight.shows_near([column, row], drawn.get_pixel(column, row).0, REACH, RAYS_PER_PIXEL)
    });
    assert!(share < at_most, "{what}: {share} of the pixels differ, the first at {:?}", differing.first());
    assert_eq!(stray, None, "{what}: a pixel differs that no outline comes near");
}

fn assert_exact_at(beta: f64) {
    let (boxes, mut photographer) = (boxes(), photographer(1));
    for view in views() {
        let drawn = photographer.moving(&view, EYE, at(beta));
        assert_exact(&drawn, &boxes.seen_by(&view, EYE, at(beta)), SHARE_AT_MOST, &format!("{view:?} at {beta} c"));
    }
}

#[test]
fn at_rest_boxes_are_where_exact_rays_meet_them() {
    assert_exact_at(0.0);
}

#[test]
fn at_half_the_speed_of_light_boxes_are_where_exact_rays_meet_them() {
    assert_exact_at(0.5);
}

#[test]
fn at_0_9_c_boxes_are_where_exact_rays_meet_them() {
    assert_exact_at(0.9);
}

#[test]
fn at_0_99_c_boxes_are_where_exact_rays_meet_them() {
    assert_exact_at(0.99);
}

/// Asserts that the map's picture is exact at a speed, with triangles as they are and the same number of texels as at
/// any speed.
fn assert_map_exact_at(beta: f64, views: &[View]) {
    let _turn = turn();
    let boxes = boxes();
    let mut photographer = Photographer::with(&LATTICE.build(), SIZE, 1, Some(BACKGROUND), DEFAULT_MAP);
    for view in views {
        let drawn = photographer.moving(view, EYE, at(beta));
        assert_exact(&drawn, &boxes.seen_by(view, EYE, at(beta)), SHARE_OF_MAP, &format!("map, {view:?} at {beta} c"));
    }
}

#[test]
fn at_rest_the_map_shows_what_exact_rays_meet() {
    assert_map_exact_at(0.0, &views());
}

#[test]
fn at_half_the_speed_of_light_the_map_shows_what_exact_rays_meet() {
    assert_map_exact_at(0.5, &views());
}

#[test]
fn at_0_9_c_the_map_shows_what_exact_rays_meet() {
    assert_map_exact_at(0.9, &views());
}

#[test]
fn at_0_99_c_the_map_shows_what_exact_rays_meet() {
    assert_map_exact_at(0.99, &views());
}

#[test]
fn at_0_9999_c_the_map_shows_what_exact_rays_meet() {
    // The oblique view has nothing but background.
    assert_map_exact_at(0.9999, &views()[..3]);
}

#[test]
fn without_effects_the_picture_is_the_plain_world() {
    let (boxes, mut photographer) = (boxes(), photographer(1));
    for view in views() {
        let drawn = photographer.plain(&view, EYE);
        assert_exact(&drawn, &boxes.seen_by(&view, EYE, Celerity::ZERO), SHARE_AT_MOST, &format!("plain {view:?}"));
        let at_rest = photographer.moving(&view, EYE, Celerity::ZERO);
        let share = differing(&drawn, &at_rest).len() as f64 / f64::from(SIZE[0] * SIZE[1]);
        assert!(share < SHARE_AT_MOST, "an eye at rest sees the plain world, but {share} of {view:?} differs");
    }
}

#[test]
fn a_million_metres_from_the_origin_not_a_pixel_changes() {
    // Every sum with this place is exact in f64.
    let far_away = DVec3::new(1_048_576.0, -262_144.0, 2_097_152.0);
    let mut here = photographer(1);
    let moved = Scene { origin: far_away, ..REFINED.clone() };
    let mut there = Photographer::new(&moved, SIZE, 1, Some(BACKGROUND));
    for view in views() {
        assert!(differing(&here.plain(&view, EYE), &there.plain(&view, far_away + EYE)).is_empty());
        for beta in [0.0, 0.9] {
            let (near, far) = (here.moving(&view, EYE, at(beta)), there.moving(&view, far_away + EYE, at(beta)));
            assert_eq!(differing(&near, &far), Vec::<[u32; 2]>::new(), "{view:?} at {beta} c");
        }
    }
}

#[test]
fn many_samples_blend_outlines_and_leave_flat_faces_exact() {
    let (boxes, view) = (boxes(), views()[0]);
    let exact = boxes.seen_by(&view, EYE, at(0.9)).picture();
    let pure: HashSet<_> = exact.pixels().copied().collect();
    for samples in [2, 7, 16] {
        let drawn = photographer(samples).moving(&view, EYE, at(0.9));
        let (mut flat, mut blended) = (0, 0);
        for (column, row, pixel) in drawn.enumerate_pixels() {
            let true_colour = exact.get_pixel(column, row);
            if surroundings(&exact, [column, row]).all(|neighbour| neighbour == *true_colour) {
                assert_eq!(pixel, true_colour, "{samples} samples at {column}, {row}");
                flat += 1;
            } else if !pure.contains(pixel) {
                blended += 1;
            }
        }
        assert!(flat > 100_000 && blended > 1000, "{samples} samples: {flat} flat pixels, {blended} blended ones");
    }
}

/// Pixels at most two columns and two rows away.
fn surroundings(picture: &RgbaImage, [column, row]: [u32; 2]) -> impl Iterator<Item = image::Rgba<u8>> {
    let along = |middle: u32, size: u32| middle.saturating_sub(2)..size.min(middle + 3);
    let rows = along(row, picture.height());
    along(column, picture.width()).flat_map(move |x| rows.clone().map(move |y| *picture.get_pixel(x, y)))
}
