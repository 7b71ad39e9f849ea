//! File of pictures, to the byte.

use built_in::town::{EDITION, TownPicture};
use rayon::prelude::*;
use std::sync::Arc;

/// First bytes of a file, with the number of its form.
const MAGIC: &[u8; 8] = b"rapipic1";
/// Largest side of a picture, pixels.
const LARGEST_SIDE: u32 = 1 << 13;
/// Bytes of all pictures together that are believed.
const LARGEST_CONTENTS: u64 = 1 << 29;

/// File of pictures: magic, edition, seed, number of pictures; of each width, height and packed length; then what is
/// packed, and a checksum. Numbers are little-endian.
pub fn packed(pictures: &[TownPicture], seed: u64) -> Vec<u8> {
    let blocks: Vec<Vec<u8>> = pictures.par_iter().map(|picture| lz4_flex::compress(&planes(&picture.rgba))).collect();
    let mut file = MAGIC.to_vec();
    file.extend(EDITION.to_le_bytes());
    file.extend(seed.to_le_bytes());
    file.extend((pictures.len() as u32).to_le_bytes());
    for (picture, block) in pictures.iter().zip(&blocks) {
        for number in [picture.width, picture.height, block.len() as u32] {
            file.extend(number.to_le_bytes());
        }
    }
    blocks.iter().for_each(|block| file.extend(block));
    file.extend(crc32fast::hash(&file).to_le_bytes());
    file
}

/// Pictures in a file; `None` if anything about it is not as [`packed`] writes it.
pub fn unpacked(file: &[u8], seed: u64) -> Option<Vec<TownPicture>> {
    // Check what the file says of itself before any of it is believed.
    let (contents, checksum) = file.split_last_chunk::<4>()?;
    let mut rest = contents.strip_prefix(MAGIC)?;
    let mut number = |bytes: usize| {
        let (taken, left) = rest.split_at_checked(bytes)?;
        rest = left;
        Some(taken.iter().rev().fold(0_u64, |number, &byte| number << 8 | u64::from(byte)))
    };
    if number(8)? != EDITION || number(8)? != seed || crc32fast::hash(contents) != u32::from_le_bytes(*checksum) {
        return None;
    }
    let count = number(4)?;
    let mut sizes = Vec::new();
    let mut total = 0;
    for _ in 0..count {
        let [width, height, length] = [number(4)? as u32, number(4)? as u32, number(4)? as u32];
        let sides = 1..=LARGEST_SIDE;
        total += 4 * u64::from(width) * u64::from(height);
        if !sides.contains(&width) || !sides.contains(&height) || total > LARGEST_CONTENTS {
            return None;
        }
        sizes.push((width, height, length as usize));
    }
    let mut blocks = Vec::new();
    for (width, height, length) in sizes {
        let (block, left) = rest.split_at_checked(length)?;
        rest = left;
        blocks.push((width, height, block));
    }
    if !rest.is_empty() {
        return None;
    }

    let picture = |(width, height, block): (u32, u32, &[u8])| {
        let mut planes = vec![0; 4 * width as usize * height as usize];
        let whole = lz4_flex::decompress_into(block, &mut planes).is_ok_and(|length| length == planes.len());
        whole.then(|| TownPicture { width, height, rgba: Arc::new(pixels(&planes)) })
    };
    blocks.into_par_iter().map(picture).collect()
}

/// Planes of a picture, which pack better than its pixels: red, green less red, blue less green, opacity.
fn planes(rgba: &[u8]) -> Vec<u8> {
    let count = rgba.len() / 4;
    let mut planes = vec![0; 4 * count];
    let (red, rest) = planes.split_at_mut(count);
    let (green, rest) = rest.split_at_mut(count);
    let (blue, opacity) = rest.split_at_mut(count);
    for (number, pixel) in rgba.chunks_exact(4).enumerate() {
        red[number] = pixel[0];
        green[number] = pixel[1].wrapping_sub(pixel[0]);
        blue[number] = pixel[2].wrapping_sub(pixel[1]);
        opacity[number] = pixel[3];
    }
    planes
}

/// Pixels of the picture with these [`planes`].
fn pixels(planes: &[u8]) -> Vec<u8> {
    let count = planes.len() / 4;
    let (red, rest) = planes.split_at(count);
    let (green, rest) = rest.split_at(count);
    let (blue, opacity) = rest.split_at(count);
    let mut rgba = vec![0; 4 * count];
    for ((((pixel, &red), &green), &blue), &opacity) in
        rgba.chunks_exact_mut(4).zip(red).zip(green).zip(blue).zip(opacity)
    {
        let green = green.wrapping_add(red);
        pixel.copy_from_slice(&[red, green, blue.wrapping_add(green), opacity]);
    }
    rgba
}
