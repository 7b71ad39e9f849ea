//! Pictures for the tests, and looks into panoramas.

use super::super::decode::{PanoramaRead, decode};
use glam::Vec3;
use image::{DynamicImage, ImageFormat, RgbImage};
use regular_file::Budget;
use scene::Panorama;
use std::f32::consts::PI;
use std::io::Cursor;
use std::path::Path;

/// Colours of four directions along the horizon: behind, left, ahead, right.
pub const ROUND: [[u8; 3]; 4] = [[255, 0, 255], [255, 0, 0], [0, 255, 0], [0, 255, 255]];

/// Picture in a file of the format.
pub fn encoded(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// Colour of a pixel of surroundings: white above, the colours of [`ROUND`] at the horizon, dark below.
pub fn surroundings([width, height]: [u32; 2], x: u32, y: u32) -> [u8; 3] {
    match 3 * y / height {
        0 => [255; 3],
        1 => ROUND[((4 * x + width / 2) / width % 4) as usize],
        _ => [60; 3],
    }
}

/// Picture of the surroundings.
pub fn picture(width: u32, height: u32) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| image::Rgb(surroundings([width, height], x, y)))
}

/// Panorama of a file that must be good, and the notices.
pub fn read(bytes: &[u8]) -> (Panorama, Vec<String>) {
    let PanoramaRead { panorama, notices, .. } = decode(bytes, Path::new("around.png"), &Budget::default()).unwrap();
    (panorama, notices)
}

/// Sentence on a file that must be refused.
pub fn refusal(bytes: &[u8]) -> String {
    decode(bytes, Path::new("around.png"), &Budget::default()).unwrap_err().to_string()
}

/// Value of the pixel in which a direction lies.
pub fn along(panorama: &Panorama, direction: Vec3) -> [f32; 3] {
    let direction = direction.normalize();
    let u = direction.x.atan2(-direction.z) / (2.0 * PI) + 0.5;
    let v = 0.5 - direction.y.clamp(-1.0, 1.0).asin() / PI;
    let at = |share: f32, size: u32| ((share * size as f32) as u32).min(size - 1) as usize;
    panorama.pixel(at(u, panorama.width), at(v, panorama.height))
}

/// Largest difference of two colours.
pub fn difference(one: [f32; 3], other: [f32; 3]) -> f32 {
    Vec3::from_array(one).distance(other.into())
}

/// Panics unless the surroundings are seen as [`surroundings`] paints them, within `tolerance`.
pub fn assert_surroundings(panorama: &Panorama, tolerance: f32, what: &str) {
    let dark = scene::mipmap::linear_from_srgb(60.0 / 255.0);
    let directions = [Vec3::Z, Vec3::NEG_X, Vec3::NEG_Z, Vec3::X];
    let round =
        directions.iter().zip(ROUND).map(|(direction, codes)| (*direction, codes.map(|code| f32::from(code) / 255.0)));
    for (direction, colour) in round.chain([(Vec3::Y, [1.0; 3]), (Vec3::NEG_Y, [dark; 3])]) {
        // A little off the axes, so that no direction lies on the edge of two pixels.
        let seen = along(panorama, direction + Vec3::new(0.03, 0.02, 0.03));
        assert!(difference(seen, colour) <= tolerance, "{what}: {direction} is {seen:?}, not {colour:?}");
    }
}
