//! Law under test: memory is counted before it is taken. A wrong reader would take gigabytes for a file of a few
//! kilobytes, or read gigabytes of a file that is no picture.

use super::super::decode::decode;
use super::super::load::load;
use super::exr_file::{file, rgb_part, tiled};
use super::pictures::*;
use exr::meta::attribute::SampleType;
use image::{GrayImage, ImageFormat};
use regular_file::Budget;
use std::io::{Seek, SeekFrom, Write};
use std::path::Path;

#[test]
fn a_picture_takes_its_pixels_from_the_budget_and_no_more_stays() {
    let bytes = encoded(GrayImage::new(2000, 1000), ImageFormat::Png);
    let budget = Budget::new(100_000_000);
    decode(&bytes, Path::new("x.png"), &budget).unwrap();
    assert_eq!(100_000_000 - budget.left(), 2000 * 1000 * 6);
    // The bytes that are decoded and the pixels that are kept are there at the same time.
    let short = Budget::new(2000 * 1000 * 7 - 1);
    let error = decode(&bytes, Path::new("x.png"), &short).unwrap_err().to_string();
    assert!(error.starts_with("x.png: it would take") && error.contains("--limit"), "{error}");
}

#[test]
fn sizes_that_a_small_file_claims_are_refused() {
    let refused = |bytes: &[u8]| {
        let error = refusal(bytes);
        assert!(error.contains("GB of memory") || error.contains("limit"), "{error}");
    };
    // 2 TB of pixels, in a PNG whose header says so.
    let mut png = encoded(GrayImage::new(2, 1), ImageFormat::Png);
    png[16..24].copy_from_slice(&[0, 0x1e, 0x84, 0x80, 0, 0x0f, 0x42, 0x40]);
    let crc = !png[12..29].iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 })
    });
    png[29..33].copy_from_slice(&crc.to_be_bytes());
    refused(&png);
    // A picture of one tile as large as itself, all of which would be unpacked at once.
    let small = tiled(rgb_part(16, 8, SampleType::F32), 16384);
    let mut bytes = file(&[small], |_, _, _, _| 0.0);
    for window in [b"dataWindow\0", b"displayWind"] {
        let place = bytes.windows(11).position(|name| name == window).unwrap();
        let place = place + bytes[place..].windows(6).position(|kind| kind == b"box2i\0").unwrap() + 6 + 4 + 8;
        bytes[place..place + 4].copy_from_slice(&16383_u32.to_le_bytes());
        bytes[place + 4..place + 8].copy_from_slice(&8191_u32.to_le_bytes());
    }
    refused(&bytes);
}

#[test]
fn gigabytes_that_are_no_picture_are_not_read() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("zeros.png");
    // A file with a hole takes no room.
    std::fs::File::create(&path).unwrap().set_len(5_000_000_000).unwrap();
    let error = load(&path, &Budget::default()).unwrap_err().to_string();
    assert!(error.contains("is no picture"), "{error}");
    let mut file = std::fs::File::options().write(true).open(&path).unwrap();
    file.seek(SeekFrom::Start(0)).unwrap();
    file.write_all(&[0x76, 0x2f, 0x31, 0x01]).unwrap();
    let error = load(&path, &Budget::default()).unwrap_err().to_string();
    assert!(error.contains("5.0 GB of memory"), "{error}");
}
