//! Law: lenses are invertible, the laser scanner is that of the thesis, and light is conserved. A wrong lens shifts
//! the picture by its error; a wrong brightness shows as a shading of the screen.
#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use glam::{DMat3, DVec2, DVec3};
use rand::{RngExt, SeedableRng};
use room::{LensTable, Projector, ProjectorLens};
use room::{Reflection, file, room_from_turned};
use view::Tangents;

/// Tolerance for the rounding of a few trigonometric functions; places are shares of a picture, and 1e-4 is less than
/// a tenth of a pixel.
const ROUNDING: f64 = 1e-12;

fn places(count: usize) -> impl Iterator<Item = DVec2> {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(6);
    (0..count).map(move |_| DVec2::new(random.random(), random.random()))
}

fn lenses() -> Vec<(&'static str, ProjectorLens)> {
    let angles = (0..9 * 7).map(|i| {
        let place = DVec2::new(f64::from(i % 9) / 8.0, f64::from(i / 9) / 6.0);
        // Yaw is to the left, places run to the right; pitch is up, places run down.
        DVec2::new(0.5 - place.x, 0.4 - 0.8 * place.y) * (1.0 + 0.1 * place.length_squared())
    });
    vec![
        ("pinhole", ProjectorLens::pinhole(1.4, 1.6, DVec2::new(0.1, 0.5))),
        ("scan", ProjectorLens::scan([1280, 1024], 0.025_f64.to_radians(), 1.8)),
        ("table", ProjectorLens::Table(LensTable::new(9, 7, angles.collect()))),
    ]
}

#[test]
fn lenses_map_places_to_directions_and_back() {
    for (name, lens) in lenses() {
        for place in places(2000) {
            let direction = lens.direction(place).unwrap();
            assert!((direction.length() - 1.0).abs() < ROUNDING, "{name} {place}");
            let back = lens.place(3.0 * direction).unwrap_or_else(|| panic!("{name} {place}: no way back"));
            assert!(back.distance(place) < 1e-9, "{name} {place}: {back}");
        }
        // Right in the picture is right in direction, and down is down.
        let at = |x, y| lens.direction(DVec2::new(x, y)).unwrap();
        assert!(at(0.9, 0.5).x > at(0.1, 0.5).x && at(0.5, 0.1).y > at(0.5, 0.9).y, "{name}");
        assert_eq!(
            lens.place(DVec3::Z).filter(|place| (place - 0.5).abs().max_element() <= 0.5),
            None,
            "{name}: behind"
        );
    }
}

#[test]
fn the_scanner_is_equation_4_6() {
    // Eq. 4.6 as printed: the first component along the axis, the second to the left, the third up; pixels from the
    // middle.
    let printed = |x: f64, y: f64| {
        let kappa = std::f64::consts::PI / 7200.0;
        let a = (1.0 - (kappa * x).cos().powi(2) * (kappa * y).cos().powi(2)).sqrt();
        let alpha = a.asin();
        [
            (1.8 * alpha).cos(),
            -(1.8 * alpha).sin() * (kappa * x).sin() / a,
            (1.8 * alpha).sin() * (kappa * x).cos() * (kappa * y).sin() / a,
        ]
    };
    let lens = ProjectorLens::scan([1280, 768], 0.025_f64.to_radians(), 1.8);
    for (x, y) in [(1.0, 0.0), (0.0, 1.0), (-640.0, 384.0), (333.0, -111.0), (640.0, -384.0)] {
        let place = DVec2::new(0.5 + x / 1280.0, 0.5 - y / 768.0);
        let ours = lens.direction(place).unwrap();
        let [axis, left, up] = printed(x, y);
        // The printed a cancels near the axis: 1e-10 of it remains at one pixel.
        assert!(ours.distance(DVec3::new(-left, up, -axis)) < 1e-9, "{x} {y}: {ours}");
    }
    assert_eq!(lens.direction(DVec2::splat(0.5)).unwrap(), DVec3::NEG_Z);
}

#[test]
fn a_scanner_without_an_optic_turns_by_its_mirrors() {
    let lens = ProjectorLens::scan([100, 100], 0.01, 1.0);
    let direction = lens.direction(DVec2::new(1.0, 0.0)).unwrap();
    // The angle is half the pixels times the step: 0.5 rad each way.
    let expected = DVec3::new(0.5_f64.sin(), 0.5_f64.cos() * 0.5_f64.sin(), -0.5_f64.cos() * 0.5_f64.cos());
    assert!(direction.distance(expected) < ROUNDING, "{direction}");
}

#[test]
fn throw_ratio_is_distance_over_width_and_shift_moves_by_pictures() {
    let lens = ProjectorLens::pinhole(2.0, 1.5, DVec2::new(0.0, 0.5));
    assert_eq!(
        lens,
        ProjectorLens::Pinhole(Tangents { low: DVec2::new(-0.25, 0.0), high: DVec2::new(0.25, 1.0 / 3.0) })
    );
}

fn projector(lens: ProjectorLens) -> Projector {
    Projector {
        name: "p".into(),
        position_m: DVec3::ZERO,
        room_from_projector: DMat3::IDENTITY,
        lens,
        light: 1.0,
        gamma: None,
        even: true,
        blend: true,
    }
}

#[test]
fn solid_angles_sum_to_what_the_edges_enclose() {
    // A square pyramid of ±45° is a sixth of the sphere: 4π/6.
    let lens = ProjectorLens::Pinhole(Tangents { low: -DVec2::ONE, high: DVec2::ONE });
    let steps = 200;
    let sum: f64 = (0..steps * steps)
        .map(|i| (DVec2::new(f64::from(i % steps), f64::from(i / steps)) + 0.5) / f64::from(steps))
        .map(|place| lens.solid_angle(place).unwrap())
        .sum();
    let mean = sum / f64::from(steps * steps);
    assert!((mean - 4.0 * std::f64::consts::PI / 6.0).abs() < 1e-4, "{mean}");
}

#[test]
fn a_square_wall_is_evenly_lit_and_gets_all_the_light() {
    let projector = projector(ProjectorLens::pinhole(1.0, 1.0, DVec2::ZERO));
    for place in places(100) {
        let ray = projector.ray(place).unwrap();
        let point = ray * (2.0 / -ray.z);
        // At 2 m distance the picture is 2 m × 2 m: a quarter of the light on each square metre.
        let light = projector.illuminance(place, point, DVec3::Z).unwrap();
        assert!((light - 0.25).abs() < 1e-6, "{place}: {light}");
    }
}

#[test]
fn a_matt_screen_looks_the_same_from_everywhere_and_a_glossy_one_mirrors() {
    let (light, viewer) = (DVec3::new(1.0, 0.0, 2.0), DVec3::new(-1.0, 0.5, 2.0));
    let matt = Reflection::default();
    assert_eq!(matt.toward(light, viewer, DVec3::Z), matt.toward(light, DVec3::X + DVec3::Z, DVec3::Z));
    let glossy = Reflection { gloss: 0.5, exponent: 50.0 };
    let mirror = DVec3::new(-1.0, 0.0, 2.0);
    assert!(glossy.toward(light, mirror, DVec3::Z) > glossy.toward(light, viewer, DVec3::Z));
    // Both reflect all of the light: ∫ B cos θ dΩ = 1 at normal incidence of a narrow lobe.
    let narrow = Reflection { gloss: 1.0, exponent: 2000.0 };
    let steps = 20_000;
    let sum: f64 = (0..steps)
        .map(|i| (f64::from(i) + 0.5) / f64::from(steps) * std::f64::consts::FRAC_PI_2)
        .map(|angle| {
            let to = DVec3::new(angle.sin(), 0.0, angle.cos());
            narrow.toward(DVec3::Z, to, DVec3::Z) * angle.cos() * angle.sin() * std::f64::consts::TAU
        })
        .sum::<f64>()
        * std::f64::consts::FRAC_PI_2
        / f64::from(steps);
    assert!((sum - 1.0).abs() < 2e-3, "{sum}");
}

#[test]
fn a_slanted_projector_is_corrected_to_an_even_wall() {
    // One projector, from below: its pixels are spread more at the top. Gain × flux / area is the same everywhere.
    let display = file::parse(
        "[[screen]]\nname = \"wall\"\ncentre = [0, 1.5, -3]\nsize = [6, 6]\n\
         [[projector]]\nname = \"p\"\nposition = [0.5, 0.2, 0]\nyaw = 10\npitch = 20\nthrow_ratio = 1.2\nsize = [64, 48]\n\
         [[window]]\nname = \"w\"\nsize = [64, 48]\n\
         [[channel]]\nname = \"c\"\nscreen = \"wall\"\nwindow = \"w\"\nprojector = \"p\"\n",
        "d.toml",
        std::path::Path::new(""),
    )
    .unwrap();
    let channel = &display.channels[0];
    let gains = channel.gains(&display, [64, 48]).unwrap();
    let corner =
        |x: u32, y: u32| channel.point(&display, DVec2::new(f64::from(x) / 64.0, f64::from(y) / 48.0)).unwrap();
    let (mut least, mut most, mut brightest) = (f64::INFINITY, 0.0_f64, 0.0_f32);
    for (x, y) in (0..48).flat_map(|y| (0..64).map(move |x| (x, y))) {
        let [a, b, c] = [corner(x, y), corner(x + 1, y), corner(x, y + 1)];
        let area = (b - a).cross(c - a).length();
        let gain = gains.factors[(y * 64 + x) as usize];
        (least, most) = (least.min(f64::from(gain) / area), most.max(f64::from(gain) / area));
        brightest = brightest.max(gain);
    }
    // The area is taken at a pixel's corner, the gain at its centre: up to half a pixel's change.
    assert!(most / least < 1.03, "{most} {least}");
    assert!(brightest > 0.97 && brightest <= 1.0, "nothing is darker than it need be: {brightest}");
    assert_eq!(display.projectors[0].room_from_projector, room_from_turned(10.0, 20.0, 0.0));
}

#[test]
fn lens_tables_are_read_from_csv() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("l.csv"), "x,y,yaw,pitch\n0,0,20,10\n1,0,-20,10\n0,1,20,-15\n1,1,-20,-15\n")
        .unwrap();
    let text = "[[screen]]\nname = \"s\"\ncentre = [0, 1.6, -3]\nsize = [9, 9]\n[[window]]\nname = \"w\"\nsize = [9, 9]\n\
                [[channel]]\nname = \"c\"\nscreen = \"s\"\nwindow = \"w\"\nprojector = \"p\"\n\
                [[projector]]\nname = \"p\"\nposition = [0, 1.6, 0]\nlens = \"table\"\ntable = \"l.csv\"\n";
    let display = file::parse(text, "d.toml", folder.path()).unwrap();
    let point = |x, y| display.channels[0].point(&display, DVec2::new(x, y)).unwrap() - DVec3::Y * 1.6;
    // The upper left is to the left and up.
    let upper_left = point(0.0, 0.0);
    assert!((upper_left.x / 3.0 + 20_f64.to_radians().tan()).abs() < ROUNDING, "{upper_left}");
    assert!((upper_left.y / upper_left.x.hypot(3.0) - 10_f64.to_radians().tan()).abs() < ROUNDING, "{upper_left}");
    assert!(point(0.5, 1.0).x.abs() < ROUNDING && point(0.5, 1.0).y < 0.0);
}
