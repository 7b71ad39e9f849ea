//! If both eyes share pixels, each eye must get its own picture: every other row, column or field of the monitor, not
//! of the window; or the colours that its filter passes. White to both eyes must be white.
//!
//! A wrong program exchanges the eyes, has rows that follow the window when it is moved by one pixel, or applies
//! matrices to encoded values.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use rapidity::renderers::display::{Combiner, Stored};
use rapidity::renderers::picture::light;
use rapidity::room::Combine;
use system_tests::colour::linear_of;
use system_tests::display::texture;
use system_tests::photographer::gpu;

const SIZE: u32 = 4;
/// Tolerance of f32 after the screen's curve and back.
const TOLERANCE: f64 = 1e-5;

const LEFT: [f32; 3] = [0.8, 0.3, 0.1];
const RIGHT: [f32; 3] = [0.1, 0.6, 0.4];

/// Linear light that a screen shows of two pictures of one colour each, row by row.
fn shown(combine: Combine, swap: bool, [left, right]: [[f32; 3]; 2], first_pixel: [i32; 2]) -> Vec<[f64; 3]> {
    let plain = |[red, green, blue]: [f32; 3]| texture(SIZE, &[[red, green, blue, 1.0]; (SIZE * SIZE) as usize]);
    let screen = plain([0.0; 3]);
    let format = screen.texture().format();
    let combiner = Combiner::new(gpu(), combine, swap, format).unwrap();
    let mut encoder = gpu().device.create_command_encoder(&Default::default());
    let eyes = [&plain(left), &plain(right)];
    combiner.show(gpu(), &mut encoder, eyes, &screen, [0, 0, SIZE, SIZE], first_pixel, false);
    gpu().queue.submit([encoder.finish()]);
    let picture = light(gpu(), &screen, &Stored::UNSHIFTED).unwrap();
    picture.pixels().map(|pixel| pixel.0.map(|value| linear_of(f64::from(value)))).collect()
}

fn assert_close(shown: [f64; 3], meant: [f64; 3], what: &str) {
    for (is, should) in shown.into_iter().zip(meant) {
        assert!((is - should).abs() < TOLERANCE, "{what}: {shown:?} instead of {meant:?}");
    }
}

fn is_left(combine: Combine, column: u32, row: u32) -> bool {
    match combine {
        Combine::Rows => row.is_multiple_of(2),
        Combine::Columns => column.is_multiple_of(2),
        _ => (row + column).is_multiple_of(2),
    }
}

#[test]
fn eyes_take_turns_on_the_monitor_wherever_the_window_is() {
    for combine in [Combine::Rows, Combine::Columns, Combine::Checker] {
        for swap in [false, true] {
            for first in [[0, 0], [1, 0], [0, 1], [-3, 5]] {
                let pixels = shown(combine, swap, [LEFT, RIGHT], first);
                for (index, pixel) in (0..).zip(pixels) {
                    let [column, row] = [index % SIZE, index / SIZE];
                    let on_monitor = |at: u32, first: i32| (at as i32 + first + 100) as u32;
                    let left = is_left(combine, on_monitor(column, first[0]), on_monitor(row, first[1])) != swap;
                    let meant = if left { LEFT } else { RIGHT }.map(f64::from);
                    assert_close(
                        pixel,
                        meant,
                        &format!("{combine:?}, {column}, {row} of a window at {first:?}, swapped: {swap}"),
                    );
                }
            }
        }
    }
}

/// Luminance of linear sRGB, IEC 61966-2-1.
fn luminance([red, green, blue]: [f64; 3]) -> f64 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

#[test]
fn filters_pass_to_each_eye_what_is_meant_for_it() {
    let [left, right] = [LEFT, RIGHT].map(|colour| colour.map(f64::from));
    // Rows of Dubois's published matrices, left eye's and right eye's.
    let dubois = [
        [0.4561, 0.500484, 0.176381, -0.0434706, -0.0879388, -0.00155529],
        [-0.0400822, -0.0378246, -0.0157589, 0.378476, 0.73364, -0.0184503],
        [-0.0152161, -0.0205971, -0.00546856, -0.0721527, -0.112961, 1.2264],
    ];
    let both = [left, right].concat();
    let row = |weights: [f64; 6]| weights.iter().zip(&both).map(|(weight, value)| weight * value).sum::<f64>();
    let cases = [
        (Combine::AnaglyphDubois, dubois.map(|weights| row(weights).clamp(0.0, 1.0)), 1e-4),
        (Combine::AnaglyphGrey, [luminance(left), luminance(right), luminance(right)], 3e-4),
        (Combine::AnaglyphHalfColour, [luminance(left), right[1], right[2]], 3e-4),
    ];
    for (combine, meant, tolerance) in cases {
        for pixel in shown(combine, false, [LEFT, RIGHT], [0, 0]) {
            let off = pixel.iter().zip(meant).map(|(is, should)| (is - should).abs()).fold(0.0, f64::max);
            assert!(off < tolerance, "{combine:?}: {pixel:?} instead of {meant:?}");
        }
    }
}

#[test]
fn what_is_white_to_both_eyes_is_white() {
    for combine in Combine::ALL.into_iter().filter(|combine| *combine != Combine::None) {
        for pixel in shown(combine, false, [[1.0; 3]; 2], [0, 0]) {
            // The matrices' rows add up to 1 within their printed digits.
            let off = pixel.iter().map(|value| (value - 1.0).abs()).fold(0.0, f64::max);
            assert!(off < 2e-3, "{combine:?}: {pixel:?}");
        }
    }
}
