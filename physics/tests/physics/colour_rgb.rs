//! Law: a colour's spectrum is that colour at rest, positive and smooth everywhere, fades into grey when it is shifted
//! far, and is never black; white stays near-neutral (Δu'v' from D65) at every shift. A wrong program would tint the
//! picture at rest, or turn grey walls black ahead.

use exact_reference::random::seeded;
use physics::colour::{Carrier, Spectrum, luminance, rgb_from_xyz, shares, white, xyz_from_rgb};
use physics::glam::{DMat3, DVec2, DVec3};
use rand::RngExt;

/// Rounding of a sum of 471 products, each rounded, and of a matrix that multiplies them by 3.
const EXACT: f64 = 1e-12;

/// Wavelengths from hard X-rays to radio waves, even in their logarithm. *Units:* nm.
fn wavelengths() -> impl Iterator<Item = f64> {
    (-2000..=20_000).map(|step| 10_f64.powf(f64::from(step) * 1e-3))
}

/// Doppler factors from 1/`limit` to `limit`, even in their logarithm.
fn doppler_factors(limit: f64) -> impl Iterator<Item = f64> {
    (-80..=80).map(move |step| limit.powf(f64::from(step) / 80.0))
}

fn chromaticity(xyz: DVec3) -> DVec2 {
    DVec2::new(4.0 * xyz.x, 9.0 * xyz.y) / (xyz.x + 15.0 * xyz.y + 3.0 * xyz.z)
}

#[test]
fn white_is_one_candela_of_d65() {
    let xyz = Spectrum::Gray.xyz(1.0);
    assert!((xyz.y - 1.0).abs() < EXACT, "{xyz}");
    let sum = xyz.element_sum();
    assert!((xyz.x / sum - 0.3127).abs() < EXACT && (xyz.y / sum - 0.3290).abs() < EXACT, "{xyz}");
}

/// The matrix of the standard, to its digits (IEC 61966-2-1, 5.2).
#[test]
fn linear_srgb_is_that_of_the_standard() {
    const ROUNDING: f64 = 5e-5;
    let standard =
        DMat3::from_cols_array_2d(&[[0.4124, 0.2126, 0.0193], [0.3576, 0.7152, 0.1192], [0.1805, 0.0722, 0.9505]]);
    assert!(xyz_from_rgb().abs_diff_eq(standard, 2.0 * ROUNDING), "{}", xyz_from_rgb());
    assert!((rgb_from_xyz() * xyz_from_rgb()).abs_diff_eq(DMat3::IDENTITY, EXACT));
    assert!((luminance(DVec3::ONE) - 1.0).abs() < EXACT);
}

#[test]
fn a_colour_at_rest_is_itself() {
    let mut random = seeded(61);
    let ends = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE, DVec3::ZERO];
    let others = (0..100).map(|_| DVec3::from_array(std::array::from_fn(|_| random.random())));
    for rgb in ends.into_iter().chain(others) {
        let seen = rgb_from_xyz() * Spectrum::rgb(rgb.to_array()).unwrap().xyz(1.0);
        assert!(seen.abs_diff_eq(rgb, EXACT), "{rgb} is seen as {seen}");
    }
    assert!(Carrier::white().rgb_from_weights(1.0).abs_diff_eq(DMat3::IDENTITY, EXACT));
}

#[test]
fn shares_are_positive_and_sum_to_one_at_every_wavelength() {
    /// The stored floor of 0.006, less what the correction to the exact primaries takes.
    const FLOOR: f64 = 0.0059;
    for nm in wavelengths() {
        let shares = shares(nm);
        assert!(shares.iter().all(|share| *share > FLOOR), "{shares:?} at {nm} nm");
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < EXACT, "{shares:?} at {nm} nm");
        assert!(white(nm) > 0.0 && white(nm).is_finite(), "{nm} nm");
    }
}

#[test]
fn shares_are_even_in_far_ultraviolet_and_infrared() {
    /// Remainder of the correction to the exact primaries.
    const EVEN: f64 = 1e-5;
    for nm in wavelengths().filter(|nm| !(270.0..1200.0).contains(nm)) {
        assert!(shares(nm).iter().all(|share| (share - 1.0 / 3.0).abs() < EVEN), "{:?} at {nm} nm", shares(nm));
    }
}

#[test]
fn grey_stays_near_neutral_from_a_quarter_to_four() {
    /// Cost of white's bump in the green, shifted to the red: measured 0.0149.
    const FARTHEST: f64 = 0.0150;
    let neutral = chromaticity(xyz_from_rgb() * DVec3::ONE);
    for doppler in doppler_factors(4.0) {
        let apart = chromaticity(Spectrum::Gray.xyz(doppler)).distance(neutral);
        assert!(apart < FARTHEST, "Δu'v' = {apart} at D = {doppler}");
    }
}

#[test]
fn shares_are_broad() {
    /// The steepest flank, at 590 nm, takes 25 nm from one share to the next.
    const STEEPEST: f64 = 0.05;
    for nm in (100..3000).map(f64::from) {
        let steepest = DVec3::from_array(shares(nm)) - DVec3::from_array(shares(nm + 1.0));
        assert!(steepest.abs().max_element() < STEEPEST, "{steepest} a nanometre at {nm} nm");
    }
}

/// Largest change by the shift of wavelengths alone, for each primary.
#[test]
fn nothing_goes_black() {
    /// Luminance with white at 1. Measured: 0.0141 for red at D = 0.87, 0.0198 for green at 0.72, 0.0087 for blue at
    /// 1.19.
    const DARKEST: f64 = 0.0085;
    for doppler in doppler_factors(1e3).chain(doppler_factors(4.0)) {
        let luminance = Carrier::white().xyz_from_weights(doppler).row(1);
        let full = luminance.element_sum();
        assert!(luminance.min_element() > DARKEST * full.min(1.0), "{luminance} at D = {doppler}");
    }
}
