//! Law: light shifted by D is D⁵ L(Dλ), so a black body seen with the Doppler factor D is one of temperature D·T, and
//! its radiance of all wavelengths together grows by D⁴. A wrong program would lose a power of D, or shift the wrong
//! way.

use std::f64::consts::PI;

use exact_reference::random::{seeded, size};
use physics::colour::{Carrier, ShiftTable, Spectrum};
use physics::glam::DVec3;
use rand::RngExt;

use crate::support::{EPSILON, relative_difference};

fn planck(kelvin: f64) -> Spectrum {
    Spectrum::planck(kelvin).unwrap()
}

#[test]
fn a_shifted_black_body_is_a_black_body_of_the_shifted_temperature() {
    let mut random = seeded(71);
    for _ in 0..2000 {
        let doppler = size(&mut random, -6.0..6.0);
        let seen_kelvin = size(&mut random, 1.5..8.0);
        let direct = planck(seen_kelvin / doppler).xyz(doppler);
        let expected = planck(seen_kelvin).xyz(1.0);
        // Wien's exponent, 570 at 31.6 K and 800 nm, is rounded a few times before it is raised.
        let tolerance = 1e-13 + 8.0 * EPSILON * 1.5e-2 / (360e-9 * seen_kelvin);
        assert!(tolerance < 1e-9);
        assert!(relative_difference(direct, expected) < tolerance, "D = {doppler}, D T = {seen_kelvin} K");
    }
}

/// The sum over all wavelengths, even in their logarithm, of a function that vanishes at both ends.
fn over_all_wavelengths(peak_nm: f64, radiance: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 0.01;
    let part = |step: i32| {
        let nm = peak_nm * (f64::from(step) * STEP).exp();
        radiance(nm) * nm * 1e-9 * STEP
    };
    (-1000..=1500).map(part).sum()
}

#[test]
fn radiance_of_all_wavelengths_grows_by_the_fourth_power() {
    /// Stefan's and Boltzmann's constant, CODATA 2018. *Units:* W m⁻² K⁻⁴.
    const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;
    /// Rounding of the ten digits.
    const PRINTED: f64 = 2e-10;
    let mut random = seeded(72);
    for _ in 0..100 {
        let kelvin = size(&mut random, 0.0..6.0);
        let doppler = size(&mut random, -6.0..6.0);
        let at_rest = planck(kelvin);
        let seen = |nm: f64| doppler.powi(5) * at_rest.radiance(doppler * nm);
        let radiance = over_all_wavelengths(2.9e6 / (doppler * kelvin), seen);
        let expected = doppler.powi(4) * STEFAN_BOLTZMANN * kelvin.powi(4) / PI;
        assert!((radiance / expected - 1.0).abs() < PRINTED, "D = {doppler}, T = {kelvin}: {radiance}, not {expected}");
    }
}

/// The candela was defined so, from 1946 to 1979: 60 cd/cm² from a black body at the freezing point of platinum,
/// 2041.4 K.
#[test]
fn black_body_at_the_freezing_point_of_platinum_has_sixty_candela_per_square_centimetre() {
    let luminance = planck(2041.4).xyz(1.0).y;
    /// Effect of a degree more or less; the temperature was not known better.
    const MEASURED: f64 = 1e-2;
    assert!((luminance / 60e4 - 1.0).abs() < MEASURED, "{luminance} cd/m²");
}

/// CIE 15:2018, table T.3; illuminant A is 2848 K by the constant c₂ of 1931, 1.435e-2 m K.
#[test]
fn black_body_of_illuminant_a_has_its_chromaticity() {
    /// Five digits, and what steps of 5 nm make of the last.
    const PRINTED: f64 = 1.5e-5;
    let xyz = planck(2848.0 * 1.438_776_877 / 1.435).xyz(1.0);
    let sum = xyz.element_sum();
    assert!((xyz.x / sum - 0.447_57).abs() < PRINTED, "x = {}", xyz.x / sum);
    assert!((xyz.y / sum - 0.407_45).abs() < PRINTED, "y = {}", xyz.y / sum);
}

#[test]
fn as_a_reflectance_it_is_a_share_of_its_maximum() {
    let mut random = seeded(73);
    for _ in 0..100 {
        let kelvin = size(&mut random, 0.0..6.0);
        let spectrum = planck(kelvin);
        // Wien's displacement law, CODATA 2018.
        let peak_nm = 2.897_771_955e6 / kelvin;
        assert!((spectrum.reflectance(peak_nm) - 1.0).abs() < 1e-14);
        let nm = peak_nm * random.random_range(0.2..5.0);
        let ratio = spectrum.radiance(nm) / spectrum.radiance(peak_nm);
        assert!((spectrum.reflectance(nm) / ratio - 1.0).abs() < 1e-12, "{kelvin} K at {nm} nm");
    }
    for kelvin in [f64::MIN_POSITIVE, 1e-100, 1e300] {
        let reflectance = planck(kelvin).reflectance(500.0);
        assert!((0.0..1e-9).contains(&reflectance), "{kelvin} K: {reflectance}");
    }
}

/// Rayleigh and Jeans: towards the infrared a black body's D L(Dλ) falls as D⁻³, so the table ends in straight lines.
#[test]
fn far_infrared_of_a_black_body_follows_rayleigh_and_jeans() {
    let carrier = Carrier::emitted(planck(5900.0));
    let table = ShiftTable::new(std::slice::from_ref(&carrier), 257);
    for doppler in [1e5, 1e6, 1e8, 1e12] {
        let luminance = carrier.xyz_from_weights(doppler).row(1).element_sum();
        let tenfold = carrier.xyz_from_weights(10.0 * doppler).row(1).element_sum();
        assert!((luminance / tenfold / 1e3 - 1.0).abs() < 1e-4, "D = {doppler}");
        let looked_up = table.rgb_from_weights(0, doppler) * DVec3::ONE;
        let direct = carrier.rgb_from_weights(doppler) * DVec3::ONE;
        // Beyond the last node, the slope is that of two rounded f32.
        assert!(relative_difference(looked_up, direct) < 1e-2, "D = {doppler}: {looked_up}, not {direct}");
    }
}

#[test]
fn light_too_faint_for_any_number_keeps_a_colour_in_the_table() {
    let cold = [planck(1e-3), planck(2800.0), planck(f64::MIN_POSITIVE), planck(1e300)];
    let mut carriers: Vec<_> = cold.iter().cloned().map(Carrier::emitted).collect();
    carriers.push(Carrier::reflected(Some(planck(2800.0)), Some(planck(2800.0))));
    let table = ShiftTable::new(&carriers, 65);
    assert!(table.texels().iter().flatten().all(|number| number.is_finite()));
    // Far on Wien's side what is left is the red end of the eye: a red beyond the screen's.
    let [red, green, blue, log2_luminance] = table.texels()[20];
    // Held where a shader's f32 still counts with it.
    assert!((-1000.0..-500.0).contains(&log2_luminance), "log₂ Y = {log2_luminance}");
    assert!(red > 5.0 && green < -0.5 && blue.abs() < 0.2, "{red}, {green}, {blue}");
}
