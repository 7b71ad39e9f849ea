//! Law: measured spectra are straight lines between their samples and constant beyond them, and nothing in them is
//! passed over, however far the Doppler effect squeezes it. A wrong program would sum over a grid and let lines
//! flicker as they shift.

use exact_reference::random::{seeded, size};
use physics::colour::{Carrier, SampledSpectrum, Spectrum, SpectrumError};
use physics::glam::DVec3;
use rand::RngExt;

use crate::support::relative_difference;

fn sampled(samples: &[[f64; 2]]) -> Spectrum {
    Spectrum::sampled(samples).unwrap()
}

fn numbers(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect()
}

#[test]
fn values_are_straight_between_samples_and_constant_beyond() {
    let spectrum = sampled(&[[400.0, 1.0], [500.0, 3.0], [600.0, 2.0]]);
    for (nm, value) in [(1e-3, 1.0), (400.0, 1.0), (425.0, 1.5), (500.0, 3.0), (550.0, 2.5), (600.0, 2.0), (1e9, 2.0)] {
        assert_eq!(spectrum.radiance(nm), value, "{nm} nm");
        assert_eq!(spectrum.reflectance(nm), value, "{nm} nm");
    }
    assert_eq!(sampled(&[[500.0, 7.0]]).radiance(123.0), 7.0);
}

/// Illuminant E: 683 lm/W times the table's sum of ȳ, and the three functions were made to have equal sums.
#[test]
fn equal_energy_has_its_chromaticity() {
    /// Remainder of that in the table.
    const UNEVEN: f64 = 1e-4;
    let xyz = sampled(&[[555.0, 1e9]]).xyz(1.0);
    assert!((xyz.y / (683.0 * 106.8569) - 1.0).abs() < 1e-5, "{xyz}");
    assert!((xyz / xyz.element_sum()).abs_diff_eq(DVec3::splat(1.0 / 3.0), UNEVEN), "{xyz}");
}

/// CIE 15:2018, table 11.1, chromaticity of D65 for the 2° observer; the spectrum is CIE's own, in steps of 5 nm.
#[test]
fn daylight_has_its_chromaticity() {
    let samples: Vec<_> = numbers(include_str!("../data/cie-d65-5nm.csv")).iter().map(|row| [row[0], row[1]]).collect();
    let xyz = sampled(&samples).xyz(1.0);
    let sum = xyz.element_sum();
    assert!((xyz.x / sum - 0.312_72).abs() < 2e-5 && (xyz.y / sum - 0.329_03).abs() < 2e-5, "{}", xyz / sum);
}

/// A line of 0.01 nm and one of 1e-6 nm, anywhere between the steps of the observer's table: luminance is that of its
/// wavelength.
#[test]
fn a_narrow_line_is_seen_whole_wherever_it_is_shifted() {
    /// Difference between the line and a straight piece of the table, and the halves of its steps.
    const TOLERANCE: f64 = 1e-3;
    let matching = numbers(include_str!("../../src/colour/data/cie-1931-2deg-1nm.csv"));
    let mut random = seeded(81);
    for half_width in [5e-3, 5e-7] {
        for _ in 0..200 {
            let doppler = size(&mut random, -1.0..1.0);
            let seen_nm: f64 = random.random_range(450.0..650.0);
            let [nm, half] = [seen_nm * doppler, half_width * doppler];
            let line = sampled(&[[nm - half, 0.0], [nm, 1e9], [nm + half, 0.0]]);
            let reflected = Carrier::reflected(Some(line.clone()), Some(sampled(&[[nm, 1.0]])));
            let line = Carrier::emitted(line);
            assert_eq!(reflected.xyz_from_weights(doppler), line.xyz_from_weights(doppler));
            // The weights' shares sum to 1; the shift keeps the area, `half`.
            let xyz = line.xyz_from_weights(doppler) * DVec3::ONE;
            let [left, right] = [0, 1].map(|next| &matching[seen_nm as usize - 360 + next]);
            let column = |index: usize| left[index] + (right[index] - left[index]) * seen_nm.fract();
            let expected = 683.0 * half * DVec3::new(column(1), column(2), column(3));
            assert!(
                relative_difference(xyz, expected) < TOLERANCE,
                "{seen_nm} nm, D = {doppler}: {xyz}, not {expected}"
            );
        }
    }
}

#[test]
fn far_beyond_its_samples_brightness_grows_by_the_fifth_power() {
    let spectrum = sampled(&[[400.0, 2.0], [500.0, 5.0], [700.0, 1.0]]);
    for doppler in [10.0, 1e3, 1e6] {
        assert!(relative_difference(spectrum.xyz(doppler), sampled(&[[1.0, 1.0]]).xyz(1.0) * doppler.powi(5)) < 1e-12);
        assert!(
            relative_difference(spectrum.xyz(1.0 / doppler), sampled(&[[1.0, 2.0]]).xyz(1.0) / doppler.powi(5)) < 1e-12
        );
    }
}

#[test]
fn what_is_reflected_is_reflectance_times_illuminant() {
    let paint = sampled(&[[380.0, 0.1], [520.0, 0.6], [700.0, 0.2], [1500.0, 0.9]]);
    let lamp = Spectrum::planck(2800.0).unwrap();
    let lit = Carrier::reflected(Some(paint.clone()), Some(lamp.clone()));
    for nm in [100.0, 380.0, 450.0, 520.0, 1000.0, 1e5] {
        assert_eq!(lit.radiance(nm), paint.radiance(nm) * lamp.radiance(nm));
    }
    assert_eq!(Carrier::reflected(None, Some(lamp.clone())), Carrier::emitted(lamp.clone()));
    assert_eq!(Carrier::reflected(Some(Spectrum::Gray), Some(lamp.clone())), Carrier::emitted(lamp));
    assert_eq!(Carrier::reflected(None, None), Carrier::white());
}

#[test]
fn numbers_that_are_no_spectrum_are_refused() {
    let refusal = |samples: &[[f64; 2]]| SampledSpectrum::new(samples).unwrap_err();
    assert_eq!(refusal(&[]), SpectrumError::Empty);
    assert_eq!(refusal(&[[0.0, 1.0]]), SpectrumError::Wavelength { index: 0, nm: 0.0 });
    assert_eq!(refusal(&[[500.0, 1.0], [500.0, 1.0]]), SpectrumError::Wavelength { index: 1, nm: 500.0 });
    assert_eq!(refusal(&[[500.0, -1.0]]), SpectrumError::Value { index: 0, value: -1.0 });
    assert_eq!(Spectrum::planck(0.0).unwrap_err(), SpectrumError::Temperature { kelvin: 0.0 });
    assert_eq!(Spectrum::rgb([0.0, -1.0, 0.0]).unwrap_err(), SpectrumError::Colour { rgb: [0.0, -1.0, 0.0] });
    for number in [f64::NAN, f64::INFINITY] {
        assert!(matches!(refusal(&[[number, 1.0]]), SpectrumError::Wavelength { index: 0, .. }));
        assert!(matches!(refusal(&[[500.0, number]]), SpectrumError::Value { index: 0, .. }));
        assert!(Spectrum::planck(number).is_err() && Spectrum::rgb([number, 0.0, 0.0]).is_err());
    }
}
