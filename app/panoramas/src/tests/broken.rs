//! Law under test: whatever a file holds, reading it ends in a good panorama or in a sentence. A wrong reader would
//! panic, hang, or let a number through that is no radiance.

use super::super::decode::decode;
use super::exr_file::{file, rgb_part, tiled};
use super::pictures::*;
use exr::compression::Compression;
use exr::meta::attribute::SampleType;
use exr::meta::header::Header;
use image::{ImageFormat, RgbImage};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use regular_file::Budget;
use std::path::Path;

/// Number of broken files tried of each kind.
const BROKEN_FILES: usize = 400;

/// Small file of every kind.
fn files() -> Vec<(String, Vec<u8>)> {
    let common = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP, ImageFormat::Tiff];
    let mut files: Vec<_> = common
        .map(|format| {
            (
                format!("{format:?}"),
                encoded(RgbImage::from_fn(16, 8, |x, y| image::Rgb([x as u8 * 9, y as u8, 7])), format),
            )
        })
        .into();
    let mut radiance = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 8 +X 16\n".to_vec();
    for row in 0..8_u8 {
        radiance.extend([2, 2, 0, 16, 144, row, 16]);
        radiance.extend(0..16);
        radiance.extend([144, 9, 144, 128]);
    }
    files.push(("Radiance".into(), radiance));
    let packings = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::DWAA(None),
    ];
    for compression in packings {
        for tiles in [false, true] {
            let header = Header { compression, ..rgb_part(16, 8, SampleType::F16) };
            let header = if tiles { tiled(header, 8) } else { header };
            files.push((format!("{compression:?}, {tiles}"), file(&[header], |_, _, x, y| (x * x + y) as f32)));
        }
    }
    files
}

fn check(bytes: &[u8]) -> bool {
    let Ok(read) = decode(bytes, Path::new("x"), &Budget::new(200_000_000)) else {
        return false;
    };
    let panorama = read.panorama;
    assert_eq!(panorama.rgb.len(), panorama.width as usize * panorama.height as usize);
    assert!(panorama.rgb.as_flattened().iter().all(|value| value.is_finite() && value.to_f32() >= 0.0));
    true
}

#[test]
fn broken_bytes_end_in_a_picture_or_a_sentence() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for (kind, whole) in files() {
        assert!(check(&whole), "{kind}");
        let mut read = 0;
        for _ in 0..BROKEN_FILES {
            let mut bytes = whole.clone();
            for _ in 0..random.random_range(1..4) {
                let place = random.random_range(0..bytes.len());
                bytes[place] = random.random();
            }
            read += usize::from(check(&bytes));
        }
        assert!(read < BROKEN_FILES, "{kind}: every broken file was taken for a whole one");
    }
}

#[test]
fn files_cut_anywhere_end_in_a_picture_or_a_sentence() {
    for (kind, whole) in files() {
        let refused = (0..whole.len()).filter(|&length| !check(&whole[..length])).count();
        assert!(refused > 4, "{kind}: {refused} of {} were refused", whole.len());
    }
}
