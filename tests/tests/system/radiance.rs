//! Black-body light must stay black-body light in motion, of temperature D·T (W 3.3, B 2.4). So an eye within walls
//! that glow at T sees, in each direction n', exactly the colour and luminance of a black body at D(n')·T. With one
//! effect alone, the shift of wavelengths keeps the radiance of all of them together, D L(Dλ), and the searchlight
//! effect multiplies it by D⁴.
//!
//! In a wrong program, D² or D³ instead of D⁵ per wavelength makes walls too dark ahead. D from a direction scaled by
//! the field of view makes rings of wrong colour. A spectrum of a few lines is black ahead. D interpolated between
//! corners makes facets.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::{DVec3, Vec3};
use image::Rgb32FImage;
use physics::colour::{Spectrum, rgb_from_xyz, xyz_from_rgb};
use physics::{Aberration, Beta, Celerity};
use scene::refine::refine;
use scene::{Material, Scene};
use system_tests::colour::srgb_byte;
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP, Photographer};
use system_tests::view::{View, middle};
use view::{Dial, Effects, Places};

const SIZE: [u32; 2] = [96, 72];

/// Relative tolerance that the renderer promises; the table's own error is a tenth of it.
const TOLERANCE: f64 = 0.01;

const KELVIN: f64 = 5000.0;

/// Walls of a room around the eye, all of one material.
fn room(material: Material) -> Scene {
    let lattice = Lattice { count: [1; 3], spacing: 1.0, side: 8.0 };
    let mut room = lattice.build();
    for mesh in &mut room.meshes {
        mesh.material = 0;
        // The walls are seen from within.
        mesh.indices.chunks_exact_mut(3).for_each(|corners| corners.swap(0, 1));
        mesh.colours.fill([1.0; 4]);
        mesh.normals.iter_mut().for_each(|normal| *normal = -*normal);
    }
    room.materials = vec![Material { unlit: true, ..material }];
    room
}

fn glowing(kelvin: f64) -> Scene {
    room(Material { spectrum: Some(Spectrum::planck(kelvin).unwrap()), ..Material::default() })
}

fn photographers(scene: &Scene) -> [(Photographer, &'static str); 2] {
    let fine = refine(scene, 0.5).unwrap();
    [
        (Photographer::with(&fine, SIZE, 1, None, AS_GIVEN), "polygon"),
        (Photographer::with(scene, SIZE, 1, None, DEFAULT_MAP), "image"),
    ]
}

fn view(look: DVec3) -> View {
    View { look, up: DVec3::new(0.1, 0.9, 0.3), fov_degrees: 90.0, size: SIZE }
}

fn at(beta: f64) -> Celerity {
    Beta::new(DVec3::new(0.3, -0.2, -1.0).normalize() * beta).unwrap().celerity()
}

/// Checks every pixel against the colour (XYZ, cd/m²) that light with its Doppler factor must have. Returns the
/// number of pixels compared.
fn assert_light(
    light: &Rgb32FImage,
    view: &View,
    motion: Celerity,
    geometry: bool,
    expected: impl Fn(f64) -> DVec3,
    what: &str,
) -> usize {
    let aberration = Aberration::new(motion);
    let mut compared = 0;
    for (column, row, pixel) in light.enumerate_pixels() {
        let direction = view.direction(middle([column, row]));
        let (_, doppler) = if geometry {
            aberration.world_from_observer(direction)
        } else {
            aberration.observer_from_world(direction)
        };
        if !(0.1..=10.0).contains(&doppler) {
            continue;
        }
        let seen = xyz_from_rgb() * Vec3::from_array(pixel.0).as_dvec3();
        let expected = expected(doppler);
        let error = (seen - expected).abs() / expected;
        assert!(
            error.max_element() < TOLERANCE,
            "{what}: {seen} instead of {expected} at {column}, {row}, where D = {doppler}"
        );
        compared += 1;
    }
    compared
}

#[test]
fn walls_of_5000_kelvin_look_as_walls_of_d_times_5000() {
    let planck = |doppler: f64| Spectrum::planck(KELVIN * doppler).unwrap().xyz(1.0);
    for (mut photographer, name) in photographers(&glowing(KELVIN)) {
        let mut compared = 0;
        for beta in [0.0, 0.5, 0.9, 0.98] {
            for look in [at(0.5).vector(), -at(0.5).vector(), DVec3::X] {
                let view = view(look);
                let light = photographer.light(&view, DVec3::new(0.5, 0.2, -0.7), at(beta), Effects::ALL);
                compared +=
                    assert_light(&light, &view, at(beta), true, planck, &format!("{name} at {beta} c to {look}"));
            }
        }
        // Pixels with D below a tenth or above ten are not compared; nearly all are within.
        assert!(compared > 60_000, "{name}: {compared} pixels");
    }
}

#[test]
fn each_effect_alone_has_its_share_of_d_to_the_fifth() {
    let spectrum = Spectrum::planck(KELVIN).unwrap();
    let doppler = Effects { doppler: true, ..Effects::GEOMETRY };
    let searchlight = Effects { searchlight: true, ..Effects::GEOMETRY };
    for (mut photographer, name) in photographers(&glowing(KELVIN)) {
        let view = view(at(0.5).vector());
        let mut check = |effects: Effects, expected: &dyn Fn(f64) -> DVec3| {
            let light = photographer.light(&view, DVec3::ZERO, at(0.8), effects);
            let what = format!("{name} with {effects}");
            assert!(assert_light(&light, &view, at(0.8), effects.bend(), expected, &what) > 6000);
        };
        check(Effects::GEOMETRY, &|_| spectrum.xyz(1.0));
        check(doppler, &|d| spectrum.xyz(d) / d.powi(4));
        check(searchlight, &|d| spectrum.xyz(1.0) * d.powi(4));
        check(Effects { places: Places::Instant, ..Effects::ALL }, &|d| spectrum.xyz(d));
        check(Effects::NONE, &|_| spectrum.xyz(1.0));
    }
}

#[test]
fn a_colour_is_a_spectrum_too() {
    let colour = [0.9, 0.4, 0.15];
    let [red, green, blue] = colour;
    let spectrum = Spectrum::rgb(colour.map(f64::from)).unwrap();
    let scene = room(Material { base_colour: [red, green, blue, 1.0], ..Material::default() });
    for (mut photographer, name) in photographers(&scene) {
        for beta in [0.0, 0.6, 0.9] {
            let view = view(DVec3::new(1.0, 0.0, -1.0));
            let light = photographer.light(&view, DVec3::ZERO, at(beta), Effects::ALL);
            let what = format!("{name} at {beta} c");
            assert!(assert_light(&light, &view, at(beta), true, |d| spectrum.xyz(d), &what) > 6000);
        }
    }
}

#[test]
fn light_far_brighter_than_the_screen_keeps_its_colour_on_file() {
    // Black body of 10,000 K at D = 3.3: 1e9 times the luminance that a screen shows.
    let spectrum = Spectrum::planck(10_000.0).unwrap();
    let (mut photographer, _) = photographers(&glowing(10_000.0)).into_iter().next().unwrap();
    let ahead = view(at(0.8).vector());
    let light = photographer.light(&ahead, DVec3::ZERO, at(0.8), Effects::ALL);
    let brightest = light.pixels().map(|pixel| pixel.0[2]).fold(0.0, f32::max);
    let expected = (rgb_from_xyz() * spectrum.xyz(3.0)).z;
    assert!((f64::from(brightest) / expected - 1.0).abs() < TOLERANCE, "{brightest} instead of {expected}");
}

/// Photographers with the renderers of windows, for coarse and fine.
fn windows(scene: &Scene) -> [(Photographer, &'static str); 2] {
    let map = Dial::map(1.5);
    [
        (Photographer::of_window(&refine(scene, 0.5).unwrap(), SIZE, AS_GIVEN), "polygon"),
        (Photographer::of_window(scene, SIZE, map), "image"),
    ]
}

/// Relative tolerance of half floats: two of their steps, of weights and of light.
const HALF_TOLERANCE: f64 = 0.01 + 2.0 / 1024.0;

#[test]
fn half_floats_hold_black_bodies_of_any_brightness() {
    // Bodies from red-hot to blue-white, and a base colour that dims an absolute luminance of 1e10 cd/m² to that of a
    // lamp.
    for (kelvin, base, white) in [(2800.0, 1.0, None), (10_000.0, 4e-9, Some(100.0)), (10_000.0, 1.0, None)] {
        let spectrum = Spectrum::planck(kelvin).unwrap();
        let material =
            Material { spectrum: Some(spectrum), base_colour: [base, base, base, 1.0], ..Material::default() };
        let scene = Scene { white, ..room(material) };
        for (mut photographer, name) in windows(&scene) {
            for beta in [0.0, 0.5, 0.9] {
                let view = view(at(0.5).vector());
                let light = photographer.light(&view, DVec3::ZERO, at(beta), Effects::ALL);
                let middle = light.get_pixel(SIZE[0] / 2, SIZE[1] / 2);
                let (_, doppler) = Aberration::new(at(beta)).world_from_observer(view.look);
                let expected =
                    f64::from(base) * (rgb_from_xyz() * Spectrum::planck(kelvin * doppler).unwrap().xyz(1.0));
                let seen = Vec3::from_array(middle.0).as_dvec3();
                let error = (seen - expected).abs().max_element() / expected.max_element();
                assert!(error < HALF_TOLERANCE, "{name}, {kelvin} K at {beta} c: {seen} instead of {expected}");
            }
        }
    }
}

#[test]
fn half_floats_hold_the_whole_picture_at_high_speed() {
    let scene = room(Material { base_colour: [0.5, 0.5, 0.5, 1.0], ..Material::default() });
    for (mut photographer, name) in windows(&scene) {
        let motion = Celerity::new(at(0.5).direction().unwrap() * 54.0).unwrap();
        let light = photographer.light(&view(motion.vector()), DVec3::ZERO, motion, Effects::ALL);
        let dark = light.pixels().filter(|pixel| pixel.0[1] <= 0.0).count();
        assert_eq!(dark, 0, "{name}: pixels of {} that half floats have lost", light.pixels().len());
    }
}

#[test]
fn a_scene_in_candela_is_the_same_at_rest_with_any_effects() {
    // The white wall is in daylight of 80,000 lux, and the luminance shown as white is a little lower.
    let mut scene = room(Material { base_colour: [0.5, 0.25, 0.125, 1.0], ..Material::default() });
    scene.materials[0].unlit = false;
    scene.white = Some(25_000.0);
    scene.light.sky = [20_000.0; 3];
    scene.light.ground = [20_000.0; 3];
    scene.light.sun = [0.0; 3];
    for (mut photographer, name) in photographers(&scene) {
        let mut picture = |effects| photographer.seen(&view(DVec3::X), DVec3::ZERO, Celerity::ZERO, effects);
        let plain = picture(Effects::NONE);
        let expected = [0.5, 0.25, 0.125].map(|colour| srgb_byte(colour * 0.8));
        assert_eq!(plain.get_pixel(9, 9).0[..3], expected, "{name}");
        for effects in ["geometry", "doppler", "searchlight", "doppler,searchlight", "all"] {
            assert!(picture(effects.parse().unwrap()) == plain, "{name}: {effects} changes what stands still");
        }
    }
}

#[test]
fn a_background_is_as_bright_as_it_is_said_to_be_whatever_is_white() {
    let scene = Scene { white: Some(1e7), ..Scene::default() };
    for method in [AS_GIVEN, DEFAULT_MAP] {
        let mut photographer = Photographer::with(&scene, SIZE, 1, Some([0.25, 0.5, 1.0]), method);
        let picture = photographer.seen(&view(DVec3::X), DVec3::ZERO, Celerity::ZERO, Effects::ALL);
        let expected = [0.25, 0.5, 1.0].map(srgb_byte);
        assert!(picture.pixels().all(|pixel| pixel.0[..3] == expected), "{method}");
    }
}
