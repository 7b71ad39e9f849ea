//! Law: shadows do not depend on the size of a scene. The sun's shadow map may leave a gap of its own texels between a
//! thing and its shadow, never one of so many centimetres; the ray tracer, which has no map, leaves none.
//!
//! A post on a slab is drawn in sizes from a millimetre to a kilometre. A program whose offsets are lengths shows no
//! shadow in the small ones, and shades surfaces by themselves in the large ones.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DVec3, Vec3};
use image::Rgb32FImage;
use physics::Celerity;
use scene::{Lighting, Material, Mesh, Scene};
use system_tests::bodies::cuboid;
use system_tests::photographer::{Photographer, RAYS};
use system_tests::turns::turn;
use system_tests::view::View;
use view::{Dial, Effects};

const SIZE: [u32; 2] = [120, 80];

/// Sizes of the slab's half side, metres: a jewel, a chair, a house, a town.
const SIZES: [f64; 4] = [5e-4, 0.3, 10.0, 1e3];

/// Place of the eye, half sides of the slab.
const EYE: DVec3 = DVec3::new(-0.4, 1.2, 1.4);

/// Largest share of pixels that may differ: those along the shadow's outline, which the map draws in steps.
const ALONG_OUTLINES: f64 = 0.02;

/// Slab with a post on it, light from the sun alone.
fn scene(size: f64) -> Scene {
    let scaled = |mut mesh: Mesh, scale: Vec3, shift: Vec3| {
        mesh.positions.iter_mut().for_each(|place| *place = (*place * scale + shift) * size as f32);
        Mesh { motion: None, material: 0, ..mesh }
    };
    let block = || cuboid(DVec3::ZERO, 1.0, 0);
    Scene {
        materials: vec![Material::default()],
        meshes: vec![
            scaled(block(), Vec3::new(1.0, 0.05, 1.0), Vec3::ZERO),
            scaled(block(), Vec3::new(0.2, 0.4, 0.2), Vec3::new(0.2, 0.45, -0.1)),
        ],
        light: Lighting {
            sun_direction: Vec3::new(0.7, 0.7, -0.3).normalize(),
            sun: [1.0; 3],
            sky: [0.0; 3],
            ground: [0.0; 3],
            shadows: true,
            ..Lighting::default()
        },
        ..Scene::default()
    }
}

fn light(size: f64, dial: Dial) -> Rgb32FImage {
    let eye = EYE * size;
    let view = View { look: -eye, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let mut photographer = Photographer::with(&scene(size), SIZE, 1, Some([0.0; 3]), dial);
    photographer.light(&view, eye, Celerity::ZERO, Effects::NONE)
}

/// Share of pixels that differ by more than a tenth of the brightest.
fn differing(one: &Rgb32FImage, other: &Rgb32FImage) -> f64 {
    let brightest = one.pixels().map(|pixel| pixel.0[1]).fold(0.0, f32::max);
    let differs = |(a, b): (&image::Rgb<f32>, &image::Rgb<f32>)| (a.0[1] - b.0[1]).abs() > 0.1 * brightest;
    one.pixels().zip(other.pixels()).filter(|pair| differs(*pair)).count() as f64 / one.pixels().len() as f64
}

#[test]
fn a_shadow_is_the_same_at_every_size() {
    let _turn = turn();
    let exact = light(1.0, RAYS);
    // The slab is lit, and the shadow of the post is on it.
    let mut unshadowed = scene(1.0);
    unshadowed.light.shadows = false;
    let eye = DVec3::new(0.4, 1.6, 2.2);
    let view = View { look: -eye, up: DVec3::Y, fov_degrees: 60.0, size: SIZE };
    let bright =
        Photographer::with(&unshadowed, SIZE, 1, Some([0.0; 3]), RAYS).light(&view, eye, Celerity::ZERO, Effects::NONE);
    let shadow = differing(&bright, &exact);
    assert!(shadow > 0.02, "the post casts a shadow on {shadow} of the picture");

    for size in SIZES {
        for (name, dial) in [("polygon", Dial::tolerance(0.05)), ("image", Dial::map(8.0)), ("rays", RAYS)] {
            let share = differing(&exact, &light(size, dial));
            println!("{name}, {size} m: {share:.4} differ, of {shadow:.4} in shadow");
            assert!(share < ALONG_OUTLINES, "{name}, {size} m: {share} of the pixels differ");
        }
    }
}
