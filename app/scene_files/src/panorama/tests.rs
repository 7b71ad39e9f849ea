//! Law under test: a thing drawn in a picture is seen in its intended direction, exactly for an equirectangular
//! picture, within the resolution of a face for cubes. A wrong reader would swap left and right, put the sky below,
//! show sRGB numbers as light, or let a pixel of one face leak into another.

use std::f32::consts::PI;

use glam::Vec3;
use image::{Rgb32FImage, RgbImage};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::super::load;
use super::*;

/// Tolerance for bilinear interpolation of a smooth function over faces of [`SIDE`] pixels; at edges the outer half
/// of a pixel is constant.
const INTERPOLATION: f32 = 0.6 / SIDE as f32;
const SIDE: u32 = 64;

/// Number of broken files tried in each format.
const BROKEN_FILES: usize = 500;

fn encoded(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn read(bytes: &[u8]) -> (Panorama, Vec<String>) {
    let mut notices = Vec::new();
    let panorama = decode(bytes, Path::new("around.png"), |notice| notices.push(notice)).unwrap();
    (panorama, notices)
}

/// Value of the pixel in which a direction lies.
fn along(panorama: &Panorama, direction: Vec3) -> [f32; 3] {
    let direction = direction.normalize();
    let u = direction.x.atan2(-direction.z) / (2.0 * PI) + 0.5;
    let v = 0.5 - direction.y.clamp(-1.0, 1.0).asin() / PI;
    let at = |share: f32, size: u32| ((share * size as f32) as u32).min(size - 1);
    panorama.rgb[(at(v, panorama.height) * panorama.width + at(u, panorama.width)) as usize]
}

/// Test colour for every direction.
fn colour(direction: Vec3) -> [f32; 3] {
    (direction.normalize() * 0.4 + 0.5).to_array()
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
fn laid_out(columns: u32, rows: u32, cells: [[u32; 2]; 6], behind_turned: bool) -> Rgb32FImage {
    let mut picture = Rgb32FImage::new(columns * SIDE, rows * SIDE);
    for (index, (face, [column, row])) in painted().into_iter().zip(cells).enumerate() {
        for (place, pixel) in (0..).zip(face) {
            let (mut x, mut y) = (place % SIDE, place / SIDE);
            if behind_turned && index == 5 {
                (x, y) = (SIDE - 1 - x, SIDE - 1 - y);
            }
            picture.put_pixel(column * SIDE + x, row * SIDE + y, image::Rgb(pixel));
        }
    }
    picture
}

#[test]
fn codes_become_light_and_the_middle_is_ahead() {
    // The columns from left to right are behind, left, ahead, right, each centred half a column after its beginning.
    let mut picture = RgbImage::new(4, 2);
    for (x, code) in [0, 64, 128, 255].into_iter().enumerate() {
        picture.put_pixel(x as u32, 0, image::Rgb([code; 3]));
        picture.put_pixel(x as u32, 1, image::Rgb([0, 0, code]));
    }
    let (panorama, notices) = read(&encoded(picture, ImageFormat::Png));
    assert!(notices.is_empty());
    // IEC 61966-2-1: code 64 is 0.0513, 128 is 0.2159.
    assert!((along(&panorama, Vec3::new(-1.0, 0.5, -0.1))[0] - 0.0513).abs() < 1e-4);
    assert!((along(&panorama, Vec3::new(0.1, 0.5, -1.0))[0] - 0.2159).abs() < 1e-4);
    assert_eq!(along(&panorama, Vec3::new(1.0, -0.5, 0.1)), [0.0, 0.0, 1.0], "right and below");
}

#[test]
fn linear_files_stay_as_they_are() {
    let values: Vec<f32> = (0..24).map(|index| 1e-3 * 3.7_f32.powi(index)).collect();
    let picture = Rgb32FImage::from_raw(4, 2, values.clone()).unwrap();
    let (panorama, notices) = read(&encoded(picture.clone(), ImageFormat::OpenExr));
    assert_eq!(panorama.rgb.as_flattened(), values);
    assert!(notices.is_empty());
    // HDR has a shared exponent and eight bits of mantissa.
    let (panorama, _) = read(&encoded(picture, ImageFormat::Hdr));
    for (read, written) in panorama.rgb.iter().zip(values.as_chunks::<3>().0) {
        assert!((read[2] / written[2] - 1.0).abs() < 1.0 / 128.0, "{} is not {}", read[2], written[2]);
    }
}

#[test]
fn sixteen_bits_are_kept() {
    let picture = image::ImageBuffer::<image::Rgb<u16>, _>::from_fn(4, 2, |x, _| image::Rgb([x as u16 * 100 + 1; 3]));
    let (panorama, _) = read(&encoded(picture, ImageFormat::Png));
    assert_eq!(panorama.rgb[1][0], 101.0 / 65535.0 / 12.92);
}

#[test]
fn numbers_that_no_light_has_are_replaced_and_told() {
    let mut values = vec![1.0; 24];
    values[..3].copy_from_slice(&[f32::NAN, f32::INFINITY, -1.0]);
    let picture = Rgb32FImage::from_raw(4, 2, values).unwrap();
    let (panorama, notices) = read(&encoded(picture, ImageFormat::OpenExr));
    assert_eq!(panorama.rgb[0], [0.0, BRIGHTEST, 0.0]);
    assert!(notices[0].contains("not finite: 3"), "{notices:?}");
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
        let (panorama, _) = read(&encoded(picture, ImageFormat::OpenExr));
        assert_eq!((panorama.width, panorama.height), (4 * SIDE, 2 * SIDE));
        for (index, pixel) in panorama.rgb.iter().enumerate() {
            let (row, column) = (index as u32 / panorama.width, index as u32 % panorama.width);
            let latitude = (0.5 - (row as f32 + 0.5) / panorama.height as f32) * PI;
            let longitude = ((column as f32 + 0.5) / panorama.width as f32 - 0.5) * 2.0 * PI;
            let level = Vec3::new(longitude.sin(), 0.0, -longitude.cos());
            let expected = colour(level * latitude.cos() + Vec3::Y * latitude.sin());
            let error = Vec3::from_array(*pixel).distance(expected.into());
            assert!(error < INTERPOLATION, "{size:?}, row {row}, column {column}: {pixel:?} is not {expected:?}");
        }
    }
}

#[test]
fn large_pictures_are_scaled_down_by_their_mean() {
    let values: Vec<f32> = (0..3 * 12 * 6).map(|index| (index % 7) as f32).collect();
    let mean = values.iter().sum::<f32>() / values.len() as f32;
    let bytes = encoded(Rgb32FImage::from_raw(12, 6, values).unwrap(), ImageFormat::OpenExr);
    let mut notices = Vec::new();
    let small = decode_up_to(6, &bytes, Path::new("x.exr"), |notice| notices.push(notice)).unwrap();
    assert_eq!((small.width, small.height), (6, 3));
    assert!((small.rgb.as_flattened().iter().sum::<f32>() / 54.0 - mean).abs() < 1e-6);
    assert!(notices[0].contains("12 × 6 pixels was scaled down to 6 × 3"), "{notices:?}");

    // A cube is scaled face by face, and the panorama is not wider than requested.
    let cube = laid_out(6, 1, std::array::from_fn(|face| [face as u32, 0]), false);
    let small = decode_up_to(100, &encoded(cube, ImageFormat::OpenExr), Path::new("x.exr"), |_| {}).unwrap();
    assert_eq!((small.width, small.height), (84, 42));
    let error = Vec3::from(along(&small, Vec3::X)).distance(colour(Vec3::X).into());
    assert!(error < 0.05, "{error}");
}

#[test]
fn other_proportions_are_refused_with_those_that_are_not() {
    for (width, height) in [(1, 1), (4, 4), (16, 9), (5, 1), (12, 3), (8, 7)] {
        let bytes = encoded(RgbImage::new(width, height), ImageFormat::Png);
        let error = decode(&bytes, Path::new("photo.png"), |_| {}).unwrap_err().to_string();
        assert!(
            error.contains(&format!("photo.png has {width} × {height} pixels")) && error.contains("2:1"),
            "{error}"
        );
    }
    for (width, height) in [(2, 1), (1999, 1000), (2001, 1000), (6, 1), (1, 6), (12, 9), (9, 12)] {
        assert!(PanoramaShape::of(width, height).is_some(), "{width} × {height}");
    }
}

#[test]
fn what_is_no_picture_is_refused() {
    let refused = |bytes: &[u8], words: &str| {
        let error = decode(bytes, Path::new("photo.png"), |_| {}).unwrap_err().to_string();
        assert!(error.contains("photo.png") && error.contains(words), "{error}");
    };
    refused(b"", "no picture");
    refused(b"once upon a time", "no picture");
    refused(b"GIF89a\x01\0\x01\0", "no picture");
    refused(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 80000\n", "38400000000 bytes when decoded");
    assert!(load(Path::new("/")).unwrap_err().to_string().contains("no picture"));
    assert!(load(Path::new("/nowhere.png")).unwrap_err().to_string().contains("check the name"));
}

#[test]
fn broken_bytes_never_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Hdr, ImageFormat::OpenExr] {
        let linear = matches!(format, ImageFormat::Hdr | ImageFormat::OpenExr);
        let whole =
            if linear { encoded(Rgb32FImage::new(16, 8), format) } else { encoded(RgbImage::new(16, 8), format) };
        let mut read = 0;
        for _ in 0..BROKEN_FILES {
            let mut bytes = whole.clone();
            for _ in 0..random.random_range(1..4) {
                let place = random.random_range(0..bytes.len());
                bytes[place] = random.random();
            }
            if let Ok(panorama) = decode(&bytes, Path::new("x"), |_| {}) {
                assert_eq!(panorama.rgb.len(), (panorama.width * panorama.height) as usize);
                assert!(panorama.rgb.as_flattened().iter().all(|value| value.is_finite() && *value >= 0.0));
                read += 1;
            }
        }
        assert!(read < BROKEN_FILES, "{format:?}: every broken file was taken for a whole one");
    }
}

#[test]
fn files_cut_anywhere_never_panic() {
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::Hdr, ImageFormat::OpenExr] {
        let linear = matches!(format, ImageFormat::Hdr | ImageFormat::OpenExr);
        let whole = if linear { encoded(Rgb32FImage::new(8, 4), format) } else { encoded(RgbImage::new(8, 4), format) };
        assert!(decode(&whole, Path::new("x"), |_| {}).is_ok(), "{format:?}");
        let refused =
            (0..whole.len()).filter(|&length| decode(&whole[..length], Path::new("x"), |_| {}).is_err()).count();
        assert!(refused > whole.len() / 4, "{format:?}: {refused} of {} were refused", whole.len());
    }
}
