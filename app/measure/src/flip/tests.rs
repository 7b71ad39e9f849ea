//! Three laws. Equal pictures have no distance. The distance of black and white follows by hand from the paper's
//! equations. On patterns that exercise every part, distances agree with those of the authors' program. In a wrong
//! program, a filter that is not normalised moves flat pictures apart, and a missing Hunt's effect or exponent
//! changes the numbers by percents.

use super::*;

const SIZE: [u32; 2] = [32, 24];

/// Tolerance for the rounding of the authors' program, and for its own digits of the sRGB matrix.
const TOLERANCE: f64 = 3e-4;

/// Tolerance for sums rounded in another order, of which features take the root.
const MIRRORED: f64 = 1e-7;

fn picture(colour: impl Fn(f64, f64) -> DVec3) -> Vec<DVec3> {
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (f64::from(x), f64::from(y))));
    pixels.map(|(x, y)| colour(x, y)).collect()
}

fn apart(first: &[DVec3], second: &[DVec3], pixels_per_degree: f64) -> Vec<f64> {
    let perceived = |rgb| Perceived::new(SIZE, rgb, pixels_per_degree);
    distances(&perceived(first), &perceived(second))
}

fn edge_at(column: f64) -> Vec<DVec3> {
    picture(|x, _| DVec3::splat(if x >= column { 1.0 } else { 0.0 }))
}

fn waves(phase: f64, green: f64, blue: f64) -> Vec<DVec3> {
    picture(|x, y| {
        let red = 0.5 + 0.4 * (0.7 * x + 0.2 * y + phase).sin();
        DVec3::new(red, green + 0.3 * (0.5 * y).cos(), 0.4 + 0.3 * (blue * x - 0.4 * y).sin())
    })
}

#[test]
fn what_is_alike_has_no_distance() {
    let one = waves(0.0, 0.5, 0.3);
    assert!(apart(&one, &one, PIXELS_PER_DEGREE).iter().all(|distance| *distance == 0.0));
}

#[test]
fn black_and_white_are_as_far_apart_as_the_equations_say() {
    // HyAB is 100, 100^0.7 = 25.12. Green and blue are the corners (87.73, −86.18, 83.18) and (32.30, 79.19, −107.86)
    // of CIELAB. Hunt's effect multiplies their a* b* by 0.8773 and 0.3230: HyAB 55.43 + √(101.19² + 107.81²) =
    // 203.29, ^0.7 = 41.28.
    let (difference, largest) = (100_f64.powf(0.7), 203.29_f64.powf(0.7));
    let by_hand = 0.95 + (difference - 0.4 * largest) / (0.6 * largest) * 0.05;
    let [black, white] = [0.0, 1.0].map(|value| picture(|_, _| DVec3::splat(value)));
    for distance in apart(&black, &white, PIXELS_PER_DEGREE) {
        assert!((distance - by_hand).abs() < 1e-4, "{distance} {by_hand}");
    }
    let [green, blue] = [DVec3::Y, DVec3::Z].map(|rgb| picture(|_, _| rgb));
    assert!(apart(&green, &blue, PIXELS_PER_DEGREE).iter().all(|distance| (distance - 1.0).abs() < 1e-9));
}

#[test]
fn it_does_not_matter_which_picture_is_first_nor_which_side_is_left() {
    let (one, other) = (edge_at(16.0), edge_at(17.0));
    let there = apart(&one, &other, PIXELS_PER_DEGREE);
    assert_eq!(there, apart(&other, &one, PIXELS_PER_DEGREE));
    // In the mirror image the edges are at 15 and 16, white on the left. The negative of that has the same features.
    let mirrored = |rgb: &[DVec3]| -> Vec<DVec3> {
        rgb.chunks(SIZE[0] as usize).flat_map(|row| row.iter().rev().copied()).collect()
    };
    let back = apart(&mirrored(&one), &mirrored(&other), PIXELS_PER_DEGREE);
    for (row, mirrored) in there.chunks(SIZE[0] as usize).zip(back.chunks(SIZE[0] as usize)) {
        for (distance, back) in row.iter().zip(mirrored.iter().rev()) {
            assert!((distance - back).abs() < MIRRORED);
        }
    }
}

/// Numbers of the authors' program, flip-evaluator 1.7 (`evaluate`, "LDR", linear sRGB in): mean, and the pixels (16,
/// 12), (15, 12), (20, 5) as x, y.
#[test]
fn distances_are_those_of_the_authors_program() {
    let spot = picture(|x, y| if (x, y) == (16.0, 12.0) { DVec3::new(0.9, 0.1, 0.1) } else { DVec3::splat(0.2) });
    let grey = picture(|_, _| DVec3::splat(0.2));
    let cases = [
        ("edge", edge_at(16.0), edge_at(17.0), PIXELS_PER_DEGREE, [0.103463, 0.538265, 0.772917, 0.019276]),
        ("edge", edge_at(16.0), edge_at(17.0), 30.0, [0.074517, 0.953169, 0.856972, 0.0]),
        (
            "waves",
            waves(0.0, 0.5, 0.3),
            waves(0.3, 0.45, 0.33),
            PIXELS_PER_DEGREE,
            [0.284429, 0.322363, 0.354232, 0.242162],
        ),
        ("waves", waves(0.0, 0.5, 0.3), waves(0.3, 0.45, 0.33), 30.0, [0.335644, 0.411569, 0.420685, 0.275413]),
        ("spot", grey.clone(), spot.clone(), PIXELS_PER_DEGREE, [0.005172, 0.239248, 0.181501, 0.001791]),
        ("spot", grey, spot, 30.0, [0.003205, 0.645719, 0.186251, 0.0]),
    ];
    for (name, first, second, pixels_per_degree, expected) in cases {
        let distances = apart(&first, &second, pixels_per_degree);
        let at = |x: usize, y: usize| distances[y * SIZE[0] as usize + x];
        let found = [mean(&distances), at(16, 12), at(15, 12), at(20, 5)];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < TOLERANCE, "{name}, {pixels_per_degree}: {found} {expected}");
        }
    }
}
