//! If both eyes share pixels, each eye must get its own picture: every other row, column or field of the monitor, not
//! of the window; or the colours that its filter passes. White to both eyes must be white.
//!
//! A wrong program exchanges the eyes, has rows that follow the window when it is moved by one pixel, or applies
//! matrices to encoded values.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DQuat, DVec3};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Event};
use render::SceneRenderer;
use room::{Combine, Display, EyeSide};
use scene::{Mesh, Scene};
use studio::{Studio, light};
use system_tests::bodies::{cuboid, unlit};
use system_tests::colour::linear_of;
use system_tests::display::texture;
use system_tests::photographer::{AS_GIVEN, gpu};
use view::{Effects, Occasion, Stored};
use walls::{Occupant, Quality, RoomHead, Walls};

const SIZE: u32 = 4;
/// Tolerance of f32 after the screen's curve and back.
const TOLERANCE: f64 = 1e-5;

/// Colours that half floats hold exactly.
const LEFT: [f32; 3] = [0.8125, 0.3125, 0.125];
const RIGHT: [f32; 3] = [0.125, 0.625, 0.375];

/// Distance of each eye from the head's middle in the world, metres: each is in a room of its own.
const ASIDE_M: f64 = 10.0;

/// Window with a channel for each eye, both on all of its pixels.
struct StereoWindow(Walls);

impl StereoWindow {
    /// Window after both eyes have looked, each at walls of its colour around it.
    fn new(combine: Combine, swap: bool, colours: [[f32; 3]; 2]) -> Self {
        let mut display = Display::built_in("stereo-wall").unwrap();
        display.windows.truncate(1);
        let window = &mut display.windows[0];
        (window.size, window.combine, window.swap_eyes) = ([SIZE; 2], combine, swap);
        for (channel, eye) in display.channels.iter_mut().zip([EyeSide::Left, EyeSide::Right]) {
            (channel.eye, channel.window, channel.viewport) = (eye, 0, [0, 0, SIZE, SIZE]);
        }
        display.viewer.eye_scale = 2.0 * ASIDE_M / display.viewer.eye_separation_m;

        let head = RoomHead::at_rest(display.viewer.head_m);
        let vehicle = WorldlineState::new(Event::default(), Celerity::ZERO, DQuat::IDENTITY);
        let format = Studio::format(gpu());
        let quality = Quality { format, samples: 1, density: 1.0, smooth: false };
        let scene = rooms(head.place_m, colours);
        let mut renderer = SceneRenderer::new(gpu(), scene.clone(), format, None, AS_GIVEN, Occasion::Still).unwrap();
        let mut walls = Walls::new(gpu(), display, quality, wgpu::TextureFormat::Rgba32Float);
        let submitted = walls
            .submit(gpu(), &mut renderer, &Occupant { vehicle, thrust: Thrust::default(), head }, Effects::NONE)
            .unwrap();
        walls.draw(gpu(), &mut renderer, submitted).unwrap();
        walls.adapt(gpu(), &Default::default(), None);
        Self(walls)
    }

    /// Linear light that the window shows at a place of its monitor, row by row.
    fn shown(&mut self, first_pixel: [i32; 2]) -> Vec<[f64; 3]> {
        let screen = texture(SIZE, &[[0.0; 4]; (SIZE * SIZE) as usize]);
        let mut encoder = gpu().device.create_command_encoder(&Default::default());
        self.0.show_window(gpu(), &mut encoder, 0, &Default::default(), &screen, first_pixel);
        gpu().queue.submit([encoder.finish()]);
        let picture = light(gpu(), &screen, &Stored::UNSHIFTED).unwrap();
        picture.pixels().map(|pixel| pixel.0.map(|value| linear_of(f64::from(value)))).collect()
    }
}

/// Two closed rooms, for the left and the right eye of a head, each of one colour.
fn rooms(head: DVec3, [left, right]: [[f32; 3]; 2]) -> Scene {
    let room = |aside: DVec3, [red, green, blue]: [f32; 3]| {
        let mut room = Mesh { motion: None, ..cuboid(head + aside, 4.0, 0) };
        // The walls are seen from within.
        room.indices.chunks_exact_mut(3).for_each(|corners| corners.swap(0, 1));
        room.colours.fill([red, green, blue, 1.0]);
        room
    };
    unlit(vec![room(DVec3::NEG_X * ASIDE_M, left), room(DVec3::X * ASIDE_M, right)], &[])
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
            let mut window = StereoWindow::new(combine, swap, [LEFT, RIGHT]);
            for first in [[0, 0], [1, 0], [0, 1], [-3, 5]] {
                for (index, pixel) in (0..).zip(window.shown(first)) {
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
        for pixel in StereoWindow::new(combine, false, [LEFT, RIGHT]).shown([0, 0]) {
            let off = pixel.iter().zip(meant).map(|(is, should)| (is - should).abs()).fold(0.0, f64::max);
            assert!(off < tolerance, "{combine:?}: {pixel:?} instead of {meant:?}");
        }
    }
}

#[test]
fn what_is_white_to_both_eyes_is_white() {
    for combine in Combine::ALL.into_iter().filter(|combine| *combine != Combine::None) {
        for pixel in StereoWindow::new(combine, false, [[1.0; 3]; 2]).shown([0, 0]) {
            // The matrices' rows add up to 1 within their printed digits.
            let off = pixel.iter().map(|value| (value - 1.0).abs()).fold(0.0, f64::max);
            assert!(off < 2e-3, "{combine:?}: {pixel:?}");
        }
    }
}
