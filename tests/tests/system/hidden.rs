//! Law: drawing depth before light changes no pixel. A window on a software driver draws it first, so that hidden
//! surfaces are not shaded; a picture that is kept does not. Both show the same surfaces: opaque ones and ones with
//! holes, with one side and with two, glass before and behind, at rest and in motion.
//!
//! A program that draws the depth of glass or of cut-out corners hides what is behind them; one that works out depth at
//! other places than light leaves holes.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::DVec3;
use physics::colour::Spectrum;
use physics::{Beta, Celerity, Event};
use scene::motion::{Motion, Uniform};
use scene::{Alpha, Lighting, Material, Mesh, Scene};
use system_tests::bodies::cuboid;
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP, Photographer};
use system_tests::view::View;
use view::{Dial, Effects};

const SIZE: [u32; 2] = [160, 120];

/// Steps of half floats between two pictures of the same light.
const HALF_STEP: f32 = 2e-3;

/// Crowd of boxes, one behind the other, of every kind of material.
fn scene() -> Scene {
    let colour = |red: f32, green: f32, blue: f32, alpha: f32| [red, green, blue, alpha];
    let material =
        |base_colour, alpha, double_sided| Material { base_colour, alpha, double_sided, ..Material::default() };
    let materials = vec![
        material(colour(0.8, 0.2, 0.1, 1.0), Alpha::Opaque, false),
        material(colour(0.1, 0.7, 0.2, 1.0), Alpha::Opaque, true),
        material(colour(0.2, 0.3, 0.9, 0.4), Alpha::Blend, true),
        // Everything of it is cut out: it must hide nothing.
        material(colour(0.9, 0.9, 0.1, 0.2), Alpha::Mask(0.5), false),
        material(colour(0.7, 0.1, 0.7, 1.0), Alpha::Mask(0.5), false),
    ];
    let mut meshes = Vec::new();
    for number in 0..60_i32 {
        let place = DVec3::new(
            f64::from(number % 5) - 2.0,
            f64::from(number / 5 % 4) - 1.5,
            -2.0 - 0.7 * f64::from(number / 20) - 0.13 * f64::from(number % 7),
        );
        let motion = (number % 11 == 3).then_some(0);
        meshes.push(Mesh { material: number as usize % materials.len(), motion, ..cuboid(place, 0.42, 0) });
    }
    Scene {
        materials,
        meshes,
        motions: vec![Motion::Uniform(Uniform {
            celerity: Beta::new(DVec3::new(0.3, 0.0, 0.1)).unwrap().celerity(),
            anchor: Event::default(),
        })],
        light: Lighting { shadows: false, ..Lighting::default() },
        ..Scene::default()
    }
}

#[test]
fn a_window_shows_the_surfaces_of_a_picture_that_is_kept() {
    let scene = scene();
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 70.0, size: SIZE };
    let at = |beta: f64| if beta > 0.0 { Beta::new(DVec3::NEG_Z * beta).unwrap().celerity() } else { Celerity::ZERO };
    for (beta, effects) in [(0.0, Effects::NONE), (0.5, Effects::ALL), (0.9, Effects::GEOMETRY)] {
        let kept = Photographer::with(&scene, SIZE, 1, None, AS_GIVEN).light(&view, DVec3::ZERO, at(beta), effects);
        let shown = Photographer::of_window(&scene, SIZE, AS_GIVEN).light(&view, DVec3::ZERO, at(beta), effects);
        let largest = kept.pixels().flat_map(|pixel| pixel.0).fold(0.0, f32::max);
        let differs = |(one, other): &(&image::Rgb<f32>, &image::Rgb<f32>)| {
            one.0.iter().zip(other.0).any(|(one, other)| (one - other).abs() > HALF_STEP * (one.abs() + 0.05 * largest))
        };
        let differing = kept.pixels().zip(shown.pixels()).filter(differs).count();
        let colours: std::collections::HashSet<_> =
            kept.pixels().map(|pixel| pixel.0.map(|value| (value / largest * 50.0) as i32)).collect();
        assert!(colours.len() > 20, "the picture is empty: {}", colours.len());
        assert!(differing * 1000 <= (SIZE[0] * SIZE[1]) as usize, "{beta}: {differing} pixels");
    }
}

#[test]
fn surfaces_of_several_spectra_hide_each_other_in_a_map() {
    // The map holds the light of each carrier by itself. A program that draws only the surfaces that shine on it shows
    // light through the others.
    let mut scene = Scene { motions: Vec::new(), ..scene() };
    scene.meshes.iter_mut().for_each(|mesh| mesh.motion = None);
    for (material, kelvin) in [(0, 2500.0), (1, 9000.0), (3, 4000.0), (4, 6000.0)] {
        scene.materials[material].spectrum = Some(Spectrum::planck(kelvin).unwrap());
    }
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 70.0, size: SIZE };
    let celerity = Beta::new(DVec3::NEG_Z * 0.5).unwrap().celerity();
    let light =
        |method| Photographer::with(&scene, SIZE, 1, None, method).light(&view, DVec3::ZERO, celerity, Effects::ALL);
    let (by_map, drawn) = (light(DEFAULT_MAP), light(Dial::tolerance(0.1)));
    let differs = |(one, other): (&image::Rgb<f32>, &image::Rgb<f32>)| {
        one.0.iter().zip(other.0).any(|(one, other)| (one - other).abs() > 0.02 * (one.abs() + other.abs()) + 1e-4)
    };
    let differing = by_map.pixels().zip(drawn.pixels()).filter(|(one, other)| differs((one, other))).count();
    let colours: std::collections::HashSet<_> =
        drawn.pixels().map(|pixel| pixel.0.map(|value| (value * 50.0) as i32)).collect();
    assert!(colours.len() > 20, "the picture is empty: {}", colours.len());
    // Outlines may lie a part of a pixel elsewhere.
    assert!(differing * 100 <= (SIZE[0] * SIZE[1]) as usize, "{differing} pixels");
}
