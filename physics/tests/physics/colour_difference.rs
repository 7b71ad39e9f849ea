//! Law: CIEDE2000 gives the published differences of the published pairs of colours, which its authors chose so that
//! every branch of the formula counts. A wrong program would have a hue turned the long way round, or a discontinuity
//! misplaced.

use physics::colour::difference::{delta_e_2000, lab_from_xyz};
use physics::glam::DVec3;

/// The table is printed to four places.
const PRINTED: f64 = 5e-5;

/// Sharma, Wu and Dalal, *The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary Test Data, and
/// Mathematical Observations*, Color Research and Application 30 (2005), table 1: two colours in CIELAB, and their
/// difference.
#[rustfmt::skip]
const PUBLISHED: [([f64; 3], [f64; 3], f64); 34] = [
    ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
    ([50.0, 3.1571, -77.2803], [50.0, 0.0, -82.7485], 2.8615),
    ([50.0, 2.8361, -74.0200], [50.0, 0.0, -82.7485], 3.4412),
    ([50.0, -1.3802, -84.2814], [50.0, 0.0, -82.7485], 1.0000),
    ([50.0, -1.1848, -84.8006], [50.0, 0.0, -82.7485], 1.0000),
    ([50.0, -0.9009, -85.5211], [50.0, 0.0, -82.7485], 1.0000),
    ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
    ([50.0, -1.0, 2.0], [50.0, 0.0, 0.0], 2.3669),
    ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0009], 7.1792),
    ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0010], 7.1792),
    ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0011], 7.2195),
    ([50.0, 2.4900, -0.0010], [50.0, -2.4900, 0.0012], 7.2195),
    ([50.0, -0.0010, 2.4900], [50.0, 0.0009, -2.4900], 4.8045),
    ([50.0, -0.0010, 2.4900], [50.0, 0.0010, -2.4900], 4.8045),
    ([50.0, -0.0010, 2.4900], [50.0, 0.0011, -2.4900], 4.7461),
    ([50.0, 2.5, 0.0], [50.0, 0.0, -2.5], 4.3065),
    ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
    ([50.0, 2.5, 0.0], [61.0, -5.0, 29.0], 22.8977),
    ([50.0, 2.5, 0.0], [56.0, -27.0, -3.0], 31.9030),
    ([50.0, 2.5, 0.0], [58.0, 24.0, 15.0], 19.4535),
    ([50.0, 2.5, 0.0], [50.0, 3.1736, 0.5854], 1.0000),
    ([50.0, 2.5, 0.0], [50.0, 3.2972, 0.0], 1.0000),
    ([50.0, 2.5, 0.0], [50.0, 1.8634, 0.5757], 1.0000),
    ([50.0, 2.5, 0.0], [50.0, 3.2592, 0.3350], 1.0000),
    ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
    ([63.0109, -31.0961, -5.8663], [62.8187, -29.7946, -4.0864], 1.2630),
    ([61.2901, 3.7196, -5.3901], [61.4292, 2.2480, -4.9620], 1.8731),
    ([35.0831, -44.1164, 3.7933], [35.0232, -40.0716, 1.5901], 1.8645),
    ([22.7233, 20.0904, -46.6940], [23.0331, 14.9730, -42.5619], 2.0373),
    ([36.4612, 47.8580, 18.3852], [36.2715, 50.5065, 21.2231], 1.4146),
    ([90.8027, -2.0831, 1.4410], [91.1528, -1.6435, 0.0447], 1.4441),
    ([90.9257, -0.5406, -0.9208], [88.6381, -0.8985, -0.7239], 1.5381),
    ([6.7747, -0.2908, -2.4247], [5.8714, -0.0985, -2.2286], 0.6377),
    ([2.0776, 0.0795, -1.1350], [0.9033, -0.0636, -0.5514], 0.9082),
];

#[test]
fn published_pairs_differ_as_published() {
    for (first, second, expected) in PUBLISHED {
        let [first, second] = [first, second].map(DVec3::from_array);
        for difference in [delta_e_2000(first, second), delta_e_2000(second, first)] {
            assert!((difference - expected).abs() <= PRINTED, "{first}, {second}: {difference}, published {expected}");
        }
    }
}

#[test]
fn a_colour_does_not_differ_from_itself() {
    for (first, second, _) in PUBLISHED {
        for lab in [first, second].map(DVec3::from_array) {
            assert_eq!(delta_e_2000(lab, lab), 0.0, "{lab}");
        }
    }
}

#[test]
fn white_is_the_lightest_and_black_the_darkest() {
    /// The two pieces of the curve of lightness meet, and its end is 100, to rounding.
    const ROUNDING: f64 = 1e-12;
    let white = DVec3::new(0.9505, 1.0, 1.0891);
    assert!(lab_from_xyz(white, white).abs_diff_eq(DVec3::new(100.0, 0.0, 0.0), ROUNDING));
    assert!(lab_from_xyz(DVec3::ZERO, white).abs_diff_eq(DVec3::ZERO, ROUNDING));
    // L* = 8 is where a Y of (6/29)³ ends the straight piece (CIE 15:2018, 8.2.1).
    for side in [1.0 - 1e-12, 1.0 + 1e-12] {
        let dark = lab_from_xyz(white * (side * (6.0_f64 / 29.0).powi(3)), white);
        assert!(dark.abs_diff_eq(DVec3::new(8.0, 0.0, 0.0), 1e-9), "{dark}");
    }
}
