//! Law under test: a thing drawn on a face of a cube is seen in its intended direction, within the resolution of a
//! face, in every layout. A wrong reader would swap left and right, turn a face, or let a pixel of one face leak into
//! another.

use super::super::decode::decode_up_to;
use super::pictures::*;
use glam::Vec3;
use image::{ImageBuffer, ImageFormat, Rgb, RgbImage};
use regular_file::Budget;
use scene::Panorama;
use std::f32::consts::PI;
use std::path::Path;

/// Tolerance for bilinear interpolation of a smooth function over faces of [`SIDE`] pixels; at edges the outer half
/// of a pixel is constant.
const INTERPOLATION: f32 = 0.6 / SIDE as f32;
const SIDE: u32 = 64;

/// Picture with floating-point numbers, for TIFF.
type FloatImage = ImageBuffer<Rgb<f32>, Vec<f32>>;

/// Test colour for every direction.
pub fn colour(direction: Vec3) -> [f32; 3] {
    (direction.normalize() * 0.4 + 0.5).to_array()
}

/// Panics unless every direction has its test colour, within `tolerance`.
pub fn assert_colours(panorama: &Panorama, tolerance: f32, what: &str) {
    for row in 0..panorama.height as usize {
        for column in 0..panorama.width as usize {
            let latitude = (0.5 - (row as f32 + 0.5) / panorama.height as f32) * PI;
            let longitude = ((column as f32 + 0.5) / panorama.width as f32 - 0.5) * 2.0 * PI;
            let level = Vec3::new(longitude.sin(), 0.0, -longitude.cos());
            let expected = colour(level * latitude.cos() + Vec3::Y * latitude.sin());
            let pixel = panorama.pixel(column, row);
            let error = difference(pixel, expected);
            assert!(error < tolerance, "{what}, row {row}, column {column}: {pixel:?} is not {expected:?}");
        }
    }
}

/// Faces painted as seen from the middle, looking along `ahead` with `up` above: right, left, up, down, ahead,
/// behind.
fn painted() -> Vec<Vec<[f32; 3]>> {
    let views = [
        (Vec3::X, Vec3::Y),
        (Vec3::NEG_X, Vec3::Y),
        (Vec3::Y, Vec3::Z),
        (Vec3::NEG_Y, Vec3::NEG_Z),
        (Vec3::NEG_Z, Vec3::Y),
        (Vec3::Z, Vec3::Y),
    ];
    let face = |(ahead, up): (Vec3, Vec3)| {
        let right = ahead.cross(up);
        let place = |index: u32| (index as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0;
        let pixel = |index: u32| colour(ahead + right * place(index % SIDE) - up * place(index / SIDE));
        (0..SIDE * SIDE).map(pixel).collect()
    };
    views.into_iter().map(face).collect()
}

/// Picture with the painted faces at these cells.
fn laid_out(columns: u32, rows: u32, cells: [[u32; 2]; 6], behind_turned: bool) -> FloatImage {
    let mut picture = FloatImage::new(columns * SIDE, rows * SIDE);
    for (index, (face, [column, row])) in painted().into_iter().zip(cells).enumerate() {
        for (place, pixel) in (0..).zip(face) {
            let (mut x, mut y) = (place % SIDE, place / SIDE);
            if behind_turned && index == 5 {
                (x, y) = (SIDE - 1 - x, SIDE - 1 - y);
            }
            picture.put_pixel(column * SIDE + x, row * SIDE + y, Rgb(pixel));
        }
    }
    picture
}

#[test]
fn cubes_of_every_shape_are_seen_as_they_were_painted() {
    let strip = std::array::from_fn(|face| [face as u32, 0]);
    let column = std::array::from_fn(|face| [0, face as u32]);
    for picture in [
        laid_out(6, 1, strip, false),
        laid_out(1, 6, column, false),
        laid_out(4, 3, [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]], false),
        laid_out(3, 4, [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]], true),
    ] {
        let size = picture.dimensions();
        let (panorama, _) = read(&encoded(picture, ImageFormat::Tiff));
        assert_eq!((panorama.width, panorama.height), (4 * SIDE, 2 * SIDE));
        assert_colours(&panorama, INTERPOLATION, &format!("{size:?}"));
    }
}

#[test]
fn a_cube_is_scaled_face_by_face() {
    let cube = laid_out(6, 1, std::array::from_fn(|face| [face as u32, 0]), false);
    let bytes = encoded(cube, ImageFormat::Tiff);
    let small = decode_up_to(100, &bytes, Path::new("x.tif"), &Budget::default()).unwrap().panorama;
    assert_eq!((small.width, small.height), (84, 42));
    assert!(difference(along(&small, Vec3::X), colour(Vec3::X)) < 0.05);
}

#[test]
fn a_photo_with_the_proportions_of_a_cross_is_refused() {
    for [width, height] in [[64, 48], [48, 64], [800, 600]] {
        let photo = RgbImage::from_fn(width, height, |x, y| Rgb([(x * 3) as u8, (y * 3) as u8, 90]));
        for format in [ImageFormat::Png, ImageFormat::Jpeg] {
            let error = refusal(&encoded(photo.clone(), format));
            assert!(error.contains(&format!("is a photo of {width} × {height}")), "{error}");
            assert!(error.contains("give a picture of all directions"), "{error}");
        }
    }
    // A cross with white corners, blurred by compression, is one.
    let cells = [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]];
    let cross = RgbImage::from_fn(256, 192, |x, y| {
        if cells.contains(&[x / 64, y / 64]) { Rgb([x as u8, y as u8, 30]) } else { Rgb([250; 3]) }
    });
    assert_eq!(read(&encoded(cross, ImageFormat::Jpeg)).0.width, 256);
}
