//! The light of a part of a picture must be the mean over its rays. A ray takes a texture at full size, at one place;
//! drawn pictures use a ready-made mean over a pixel or a texel. Over blocks of pixels, each with hundreds of rays,
//! both must agree.
//!
//! In a wrong program, textures averaged as sRGB numbers are darker everywhere. Textures that are shifted or mirrored
//! change whole blocks. Textures looked up in copies too small mix blocks with their neighbours, however large the
//! blocks are.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::town;
use glam::{DVec3, Vec3};
use image::Rgb32FImage;
use system_tests::bodies::celerity;
use system_tests::photographer::{Photographer, RAYS};
use system_tests::turns::turn;
use system_tests::view::View;
use view::{Dial, Effects};

/// Size in pixels: four times as wide and high as the pictures of the other tests, with a ray a pixel. A block thus
/// has 256 rays, and is as large as four pixels of those pictures along each side.
const SIZE: [u32; 2] = [768, 512];
const BLOCK: u32 = 16;

/// Largest differences of half of the blocks, and of 99 of 100, relative to the brighter one's largest channel.
///
/// A copy of a texture is as small as the pixel is long, not as it is wide (a software driver is not asked for more
/// samples). So on the pavement and on walls seen at a slant a pixel takes in some of its neighbours. A block of one
/// colour beside one of another then has a seam some pixels wide, a tenth of its area. The map is finer than the
/// picture, and its seam is narrower.
const POLYGON: [f64; 2] = [0.012, 0.16];
const IMAGE: [f64; 2] = [0.008, 0.09];

/// Ratio of the error of 99 of 100 blocks for blocks twice as wide; it would be one half if seams were the only
/// error.
const LEFT: f64 = 0.7;

/// Largest difference of the whole picture: no light is lost or gained.
const WHOLE: f64 = 0.006;

/// Means over blocks of pixels.
fn blocks(light: &Rgb32FImage, side: u32) -> Vec<DVec3> {
    let pixel = |column, row| Vec3::from_array(light.get_pixel(column, row).0).as_dvec3();
    let mean = |[column, row]: [u32; 2]| {
        let inside = (0..side).flat_map(|down| (0..side).map(move |right| (right, down)));
        let sum: DVec3 = inside.map(|(right, down)| pixel(side * column + right, side * row + down)).sum();
        sum / f64::from(side * side)
    };
    let [columns, rows] = SIZE.map(|pixels| pixels / side);
    (0..rows).flat_map(|row| (0..columns).map(move |column| mean([column, row]))).collect()
}

/// Differences of blocks, sorted.
fn differences(drawn: &Rgb32FImage, traced: &Rgb32FImage, side: u32) -> Vec<f64> {
    let (drawn, traced) = (blocks(drawn, side), blocks(traced, side));
    let difference = |(a, b): (&DVec3, &DVec3)| (*a - *b).abs().max_element() / a.max(*b).max_element();
    let mut differences: Vec<f64> = drawn.iter().zip(&traced).map(difference).collect();
    differences.sort_by(f64::total_cmp);
    differences
}

#[test]
fn the_town_in_its_own_textures_is_what_many_rays_see() {
    let _turn = turn();
    let mut scene = town::build(1);
    // The renderers' shadows are a map with soft edges, which `raytrace.rs` tests.
    scene.light.shadows = false;
    let eye = scene.start.position + DVec3::Y * 1.6;
    let look = scene.start.look;
    let view = View { look, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let mut tracer = Photographer::with(&scene, SIZE, 1, None, RAYS);
    let motions = [0.0, 0.9].map(|beta| celerity(look.normalize() * beta));
    let traced = motions.map(|motion| tracer.light(&view, eye, motion, Effects::ALL));

    let adaptive = Dial::tolerance(0.05);
    let map = Dial::map(3.0);
    for (method, [half, most]) in [(adaptive, POLYGON), (map, IMAGE)] {
        let mut photographer = Photographer::with(&scene, SIZE, 1, None, method);
        for (motion, traced) in motions.iter().zip(&traced) {
            let drawn = photographer.light(&view, eye, *motion, Effects::ALL);
            let quantile = |sorted: &[f64], share: f64| sorted[(sorted.len() as f64 * share) as usize];
            let [small, large] = [BLOCK, 2 * BLOCK].map(|side| differences(&drawn, traced, side));
            let [usual, of_99, of_large] = [quantile(&small, 0.5), quantile(&small, 0.99), quantile(&large, 0.99)];
            let sum = |light| blocks(light, BLOCK).iter().sum::<DVec3>();
            let whole = (sum(&drawn) / sum(traced) - 1.0).abs().max_element();
            let what = format!(
                "{method} at γ = {:.2}: half of the blocks within {usual:.4}, 99 % within {of_99:.4}, of larger ones {of_large:.4}; \
                 all together {whole:.4}",
                motion.gamma()
            );
            println!("{what}");
            assert!(usual <= half && of_99 <= most, "{what}");
            assert!(of_large <= LEFT * of_99 && whole <= WHOLE, "{what}");
        }
    }
}
