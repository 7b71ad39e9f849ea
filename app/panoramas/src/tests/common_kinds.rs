//! Law under test: a picture shows the same surroundings in every kind of file, whatever its name; codes of sRGB become
//! light, and linear numbers stay. A wrong reader would swap left and right, put the sky below, show sRGB numbers as
//! light, or cut sixteen bits to eight.

use super::super::decode::decode_up_to;
use super::super::load::{is_picture, load};
use super::pictures::*;
use glam::Vec3;
use image::codecs::jpeg::JpegEncoder;
use image::{DynamicImage, ImageFormat, Rgb32FImage, RgbImage, RgbaImage};
use regular_file::Budget;
use scene::mipmap::linear_from_srgb;
use std::path::Path;

/// Difference that JPEG makes.
const JPEG: f32 = 0.12;

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
fn every_kind_of_file_shows_the_same_surroundings() {
    let rgb = picture(64, 32);
    for format in [ImageFormat::Png, ImageFormat::WebP, ImageFormat::Tiff] {
        assert_surroundings(&read(&encoded(rgb.clone(), format)).0, 1e-3, &format!("{format:?}"));
    }
    assert_surroundings(&read(&encoded(rgb.clone(), ImageFormat::Jpeg)).0, JPEG, "JPEG");
    // Opacity is left out, and what is under it is seen.
    let alpha = RgbaImage::from_fn(64, 32, |x, y| {
        let [red, green, blue] = rgb.get_pixel(x, y).0;
        image::Rgba([red, green, blue, (x * 4) as u8])
    });
    assert_surroundings(&read(&encoded(alpha, ImageFormat::Png)).0, 1e-3, "alpha");
    let deep = DynamicImage::from(rgb.clone()).into_rgb16();
    assert_surroundings(&read(&encoded(deep, ImageFormat::Png)).0, 1e-3, "sixteen bits");
    let float = DynamicImage::from(rgb).into_rgb32f();
    let float = Rgb32FImage::from_fn(64, 32, |x, y| image::Rgb(float.get_pixel(x, y).0.map(linear_from_srgb)));
    assert_surroundings(&read(&encoded(float, ImageFormat::Tiff)).0, 1e-3, "floating point TIFF");
    for [width, height] in [[65, 32], [63, 32], [64, 33], [1999, 1000], [2010, 1000]] {
        assert_surroundings(&read(&encoded(picture(width, height), ImageFormat::Png)).0, 1e-3, "nearly 2:1");
    }
}

#[test]
fn grey_pictures_are_grey() {
    let grey = image::GrayImage::from_fn(8, 4, |x, _| image::Luma([x as u8 * 30]));
    for format in [ImageFormat::Png, ImageFormat::Tiff] {
        let (panorama, _) = read(&encoded(grey.clone(), format));
        let expected = [linear_from_srgb(150.0 / 255.0); 3];
        assert!(difference(panorama.pixel(5, 1), expected) < 1e-3, "{format:?}: {:?}", panorama.pixel(5, 1));
    }
}

#[test]
fn sixteen_bits_are_kept() {
    let picture = image::ImageBuffer::<image::Rgb<u16>, _>::from_fn(4, 2, |x, _| image::Rgb([x as u16 * 1000 + 1; 3]));
    let (panorama, _) = read(&encoded(picture, ImageFormat::Png));
    let expected = 1001.0 / 65535.0 / 12.92;
    assert!((panorama.pixel(1, 0)[0] / expected - 1.0).abs() < 1e-3, "{:?}", panorama.pixel(1, 0));
}

#[test]
fn the_bytes_decide_and_any_ending_of_a_picture_is_known() {
    for name in ["a.png", "A.PNG", "a.JPEG", "a.jpg", "a.webp", "a.tif", "a.TIFF", "a.hdr", "a.exr"] {
        assert!(is_picture(Path::new(name)), "{name}");
    }
    assert!(!is_picture(Path::new("a.glb")) && !is_picture(Path::new("png")));
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("LIAR.JPG");
    std::fs::write(&path, encoded(picture(64, 32), ImageFormat::Png)).unwrap();
    assert_surroundings(&load(&path, &Budget::default()).unwrap().panorama.unwrap(), 1e-3, "a PNG named JPG");
}

#[test]
fn a_camera_turned_on_its_side_is_turned_back() {
    // Turned by 90° to the left when stored; orientation 6 says to turn it to the right.
    let stored = DynamicImage::from(picture(64, 32)).rotate270().into_rgb8();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, 100).encode_image(&stored).unwrap();
    let exif = b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";
    let mut turned = vec![0xff, 0xd8, 0xff, 0xe1, 0, exif.len() as u8 + 2];
    turned.extend(exif);
    turned.extend(&bytes[2..]);
    assert_surroundings(&read(&turned).0, JPEG, "orientation 6");
    assert!(refusal(&bytes).contains("32 × 64"), "without it, the picture is upright");
}

#[test]
fn a_jpeg_that_ends_early_is_told() {
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, 90).encode_image(&picture(512, 256)).unwrap();
    assert!(read(&bytes).1.is_empty());
    let (panorama, notices) = read(&bytes[..bytes.len() * 6 / 10]);
    assert!(notices[0].contains("ends before its picture does: about"), "{notices:?}");
    assert!(difference(along(&panorama, Vec3::new(0.0, 1.0, 0.03)), [1.0; 3]) < JPEG, "the part that is there is seen");
    // Whatever follows the picture is of no concern.
    bytes.extend([0; 100]);
    assert!(read(&bytes).1.is_empty());
}

#[test]
fn large_pictures_are_scaled_down_by_their_mean() {
    let codes: Vec<u16> = (0..3 * 12 * 6).map(|index| (index % 7) * 9000).collect();
    let mean = codes.iter().map(|code| linear_from_srgb(f32::from(*code) / 65535.0)).sum::<f32>() / codes.len() as f32;
    let picture = image::ImageBuffer::<image::Rgb<u16>, _>::from_raw(12, 6, codes).unwrap();
    let bytes = encoded(picture, ImageFormat::Png);
    let read = decode_up_to(6, &bytes, Path::new("x.png"), &Budget::default()).unwrap();
    assert_eq!((read.panorama.width, read.panorama.height), (6, 3));
    let sum: f32 = read.panorama.rgb.as_flattened().iter().map(|value| value.to_f32()).sum();
    assert!((sum / 54.0 - mean).abs() < 1e-3 * mean);
    assert!(read.notices[0].contains("12 × 6 pixels was scaled down to 6 × 3"), "{:?}", read.notices);
}

#[test]
fn other_proportions_are_refused_with_those_that_are_not() {
    for (width, height) in [(1, 1), (4, 4), (16, 9), (5, 1), (12, 3), (8, 7), (300, 200), (1000, 515)] {
        let error = refusal(&encoded(RgbImage::new(width, height), ImageFormat::Png));
        assert!(
            error.contains(&format!("around.png has {width} × {height} pixels")) && error.contains("2:1"),
            "{error}"
        );
    }
}

#[test]
fn files_that_are_no_pictures_are_refused() {
    let refused = |bytes: &[u8], words: &str| {
        let error = refusal(bytes);
        assert!(error.contains("around.png") && error.contains(words), "{error}");
    };
    refused(b"", "no picture");
    refused(b"once upon a time", "no picture");
    refused(b"GIF89a\x01\0\x01\0", "no picture");
    assert!(load(Path::new("/"), &Budget::default()).unwrap_err().to_string().contains("no picture"));
    let missing = load(Path::new("/nowhere.png"), &Budget::default()).unwrap_err().to_string();
    assert!(missing.contains("check the name"), "{missing}");
}
