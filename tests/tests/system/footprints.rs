//! The mean over a pixel's samples must come closer to the mean over the pixel, the more samples there are. Each sample
//! of a drawn picture takes a ready-made mean of a texture or a panorama: over the part of the pixel that the sample
//! stands for. Rays, each of which takes one place, tell the mean over the pixel.
//!
//! In a wrong program every sample takes the mean over a whole pixel, so that samples beside the middle bring in the
//! neighbours: four samples are farther from the truth than one.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DVec3, Vec2, Vec3};
use image::Rgb32FImage;
use scene::{Material, Mesh, Panorama, Scene, Texture};
use system_tests::bodies::celerity;
use system_tests::photographer::{Photographer, RAYS};
use system_tests::turns::turn;
use system_tests::view::View;
use view::{Dial, Effects};

const SIZE: [u32; 2] = [96, 64];

/// Number of rays that tell the mean over a pixel.
const MANY: u32 = 256;

/// Numbers of samples that are compared, each with the one before.
const SAMPLES: [u32; 3] = [1, 4, 16];

/// Surroundings in black and white squares, at infinity.
fn chequered_surroundings() -> Scene {
    let (width, height, square) = (512, 256, 8);
    let code = |x: u32, y: u32| [f32::from(u8::from((x / square + y / square).is_multiple_of(2))); 3];
    let rgb = (0..height).flat_map(|y| (0..width).map(move |x| code(x, y)));
    Scene { panorama: Some(Panorama::new(width, height, rgb)), ..Scene::default() }
}

/// Floor in black and white squares, seen at a slant.
fn chequered_floor() -> Scene {
    let side = 256_u32;
    let texel = |x: u32, y: u32| [[0, 0, 0, 255], [255; 4]][((x / 4 + y / 4) % 2) as usize];
    let texture = Texture {
        name: "squares".into(),
        width: side,
        height: side,
        rgba: std::sync::Arc::new((0..side).flat_map(|y| (0..side).flat_map(move |x| texel(x, y))).collect()),
        wrap: Default::default(),
        nearest: false,
    };
    let corners = [[-8.0, 2.0], [8.0, 2.0], [8.0, -14.0], [-8.0, -14.0]];
    let floor = Mesh {
        name: "floor".into(),
        positions: corners.map(|[x, z]| Vec3::new(x, -1.6, z)).to_vec(),
        normals: vec![Vec3::Y; 4],
        uvs: [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]].map(Vec2::from).to_vec(),
        colours: vec![[1.0; 4]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    let material = Material { unlit: true, base_colour_texture: Some(0), ..Material::default() };
    Scene { textures: vec![texture], materials: vec![material], meshes: vec![floor], ..Scene::default() }
}

/// Root of the mean square of the differences.
fn difference(drawn: &Rgb32FImage, truth: &Rgb32FImage) -> f64 {
    let squares = drawn.as_raw().iter().zip(truth.as_raw()).map(|(a, b)| f64::from(a - b).powi(2));
    (squares.sum::<f64>() / drawn.as_raw().len() as f64).sqrt()
}

/// Compares the errors of all numbers of samples; each must be at most `ratio` of the one before.
fn assert_better_with_more(scene: &Scene, look: DVec3, beta: DVec3, ratio: f64, dials: &[Dial]) {
    let _turn = turn();
    let view = View { look, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let motion = celerity(beta);
    let light = |dial: Dial, samples: u32| {
        Photographer::with(scene, SIZE, samples, None, dial).light(&view, DVec3::ZERO, motion, Effects::GEOMETRY)
    };
    let truth = light(RAYS, MANY);
    for dial in dials {
        let errors = SAMPLES.map(|samples| difference(&light(*dial, samples), &truth));
        println!("{dial}, {beta}: {errors:.4?} with {SAMPLES:?} samples");
        assert!(errors.is_sorted_by(|before, after| *after <= ratio * *before), "{dial}, {beta}: {errors:?}");
    }
}

#[test]
fn a_panorama_is_closer_to_the_truth_with_more_samples() {
    let scene = chequered_surroundings();
    let dials = [Dial::tolerance(0.5), Dial::map(3.0)];
    assert_better_with_more(&scene, DVec3::NEG_Z, DVec3::NEG_Z * 0.99, 1.0, &dials);
    assert_better_with_more(&scene, DVec3::new(1.0, 0.3, -1.0), DVec3::NEG_Z * 0.5, 1.0, &dials);
}

#[test]
fn a_texture_is_closer_to_the_truth_with_more_samples() {
    let scene = chequered_floor();
    let dials = [Dial::tolerance(0.5), Dial::map(3.0)];
    for beta in [DVec3::ZERO, DVec3::NEG_Z * 0.6] {
        assert_better_with_more(&scene, DVec3::new(0.0, -0.5, -1.0), beta, 1.0, &dials);
    }
}
