//! Colour errors: two pictures of one view, developed alike, compared pixel by pixel by ΔE2000.
//!
//! Light is compared in the form in which a screen would show it. Both pictures have the same exposure: the one by
//! which the reference is on average as bright as the same surfaces at rest. The curve is 1 − e^(−L), which does not
//! depend on the rest of the picture (B eq. 5.1). Colours outside the screen's gamut are mixed with the grey of their
//! luminance. So a brighter picture counts as a difference, and is not adapted away.

use glam::DVec3;
use physics::colour::difference::{delta_e_2000, lab_from_xyz};
use physics::colour::{luminance, xyz_from_rgb};
use rayon::prelude::*;

use super::quantiles::Sorted;

/// Share of white below which luminances are left out of the mean brightness.
const DARK: f64 = 1e-6;

/// Factor from light in cd/m² to exposed luminance, white being 1.
///
/// # Arguments
/// * `light` — linear sRGB in cd/m² of the reference.
/// * `at_rest` — luminances without any shift, relative to white.
/// * `white` — luminance that is white at rest, cd/m².
pub fn exposure(light: &[DVec3], at_rest: &[f64], white: f64) -> f64 {
    let lit = light.iter().map(|light| luminance(*light) / white).zip(at_rest);
    let lit = lit.filter(|(seen, at_rest)| *seen > DARK && **at_rest > DARK);
    let (sum, count) = lit.fold((0.0, 0), |(sum, count), (seen, at_rest)| (sum + (at_rest / seen).ln(), count + 1));
    (sum / f64::from(count.max(1))).exp() / white
}

/// Colour that a screen shows for light: linear sRGB from 0 to 1.
pub fn developed(light: DVec3, exposure: f64) -> DVec3 {
    let exposed = light * exposure;
    let bright = luminance(exposed);
    if bright <= 0.0 || !exposed.is_finite() {
        return DVec3::ZERO;
    }
    let shown = -(-bright).exp_m1();
    let grey = DVec3::splat(shown);
    let from_grey = exposed * (shown / bright) - grey;
    // Largest distance from grey at which every channel stays within 0 to 1.
    let room = |apart: f64| match apart {
        apart if apart > 0.0 => (1.0 - shown) / apart,
        apart if apart < 0.0 => shown / -apart,
        _ => 1.0,
    };
    let [red, green, blue] = from_grey.to_array().map(room);
    (grey + from_grey * red.min(green).min(blue).min(1.0)).clamp(DVec3::ZERO, DVec3::ONE)
}

/// ΔE2000 of each pixel of two developed pictures.
pub fn differences(first: &[DVec3], second: &[DVec3]) -> Sorted {
    let white = xyz_from_rgb() * DVec3::ONE;
    let lab = |rgb: &DVec3| lab_from_xyz(xyz_from_rgb() * *rgb, white);
    let pixels = first.par_iter().zip(second);
    Sorted::of(pixels.map(|(first, second)| delta_e_2000(lab(first), lab(second))).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    //! Three laws: a picture as bright as at rest stays so, a colour outside the gamut keeps its luminance, and twice
    //! the light is a difference.

    use super::*;

    #[test]
    fn exposure_takes_back_what_motion_has_added_on_the_average() {
        // Pixels twice and eight times as bright as at rest: four times in the geometric mean.
        let light = [DVec3::splat(200.0), DVec3::splat(400.0), DVec3::ZERO];
        let exposed = exposure(&light, &[1.0, 0.5, 0.3], 100.0);
        assert!((exposed - 0.25 / 100.0).abs() < 1e-12, "{exposed}");
    }

    #[test]
    fn luminance_is_kept_and_bent_by_the_exponential_alone() {
        for light in [DVec3::new(0.2, 0.5, 0.1), DVec3::new(5.0, -0.4, 0.1), DVec3::new(0.0, 0.0, 9.0)] {
            let shown = developed(light * 7.0, 1.0 / 7.0);
            assert!(shown.min_element() >= 0.0 && shown.max_element() <= 1.0, "{shown}");
            let expected = 1.0 - (-luminance(light)).exp();
            assert!((luminance(shown) - expected).abs() < 1e-12, "{light}");
        }
        assert_eq!(developed(DVec3::splat(-1.0), 1.0), DVec3::ZERO);
    }

    #[test]
    fn lightness_is_counted_as_the_formula_has_it() {
        // Greys of L* = 50 and 52 by Y = ((L* + 16) / 116)³: S_L at 51 is 1 + 0.015 / √21, so ΔE is 2 over that.
        let grey = |lightness: f64| [DVec3::splat(((lightness + 16.0) / 116.0_f64).powi(3))];
        let difference = differences(&grey(50.0), &grey(52.0)).quantile(1.0);
        assert!((difference - 2.0 / (1.0 + 0.015 / 21.0_f64.sqrt())).abs() < 1e-5, "{difference}");
        assert_eq!(differences(&grey(50.0), &grey(50.0)).quantile(1.0), 0.0);
    }
}
