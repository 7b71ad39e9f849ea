//! Law: a picture's pixels come out as they went in, whatever its format; of a picture that ends too early the upper
//! part is kept and said to be so; nothing that the bytes claim is allocated beyond the budget, and no bytes make a
//! decoder panic. The pictures were written by libpng, libjpeg-turbo, libwebp and
//! Basis Universal's encoder, or by the hand of the test.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use super::samples::*;
use super::{DecodedPicture, PictureKind, decode, kind, size};
use crate::DecodeError;
use crate::mutations::{hex, mutations};
use ::png::{BitDepth, ColorType, Encoder};
use regular_file::Budget;

/// Colours of the pictures below, 16 pixels wide and 48 high: a white square of 8 pixels in the upper left corner, red
/// beside it, green from row 16, blue from row 32. Each with a column and a row where it stands.
const COLOURS: [([usize; 2], [u8; 3]); 4] =
    [([2, 2], [250, 250, 250]), ([12, 12], [200, 40, 30]), ([8, 24], [40, 180, 60]), ([8, 44], [30, 50, 190])];

fn decoded(bytes: &[u8]) -> DecodedPicture {
    decode(bytes, &Budget::default()).unwrap()
}

fn pixel(picture: &DecodedPicture, [column, row]: [usize; 2]) -> [u8; 4] {
    picture.rgba[4 * (row * picture.width as usize + column)..][..4].try_into().unwrap()
}

fn png(width: u32, colour: ColorType, depth: BitDepth, palette: Option<[&[u8]; 2]>, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let row = (width as usize * colour.samples() * depth as usize).div_ceil(8);
    let mut encoder = Encoder::new(&mut bytes, width, (data.len() / row) as u32);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    if let Some([colours, alphas]) = palette {
        encoder.set_palette(colours);
        encoder.set_trns(alphas);
    }
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    bytes
}

/// Grey PNG of 2 × 2 pixels in Adam7's order, its pixels not compressed.
fn interlaced_png(grey: [u8; 4]) -> Vec<u8> {
    let [a, b, c, d] = grey;
    // First the pixel at the corner, then the one to its right, then the second row; each row begins with its filter.
    let rows = [0, a, 0, b, 0, c, d];
    let mut zlib = vec![0x78, 1, 1, 7, 0, !7, !0];
    zlib.extend(rows);
    let [mut low, mut high] = [1_u32, 0];
    for byte in rows {
        low += u32::from(byte);
        high += low;
    }
    zlib.extend((high << 16 | low).to_be_bytes());
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let header = [0, 0, 0, 2, 0, 0, 0, 2, 8, 0, 0, 0, 1];
    for (name, data) in [(b"IHDR", &header[..]), (b"IDAT", &zlib), (b"IEND", &[])] {
        bytes.extend((data.len() as u32).to_be_bytes());
        let chunk = [&name[..], data].concat();
        bytes.extend(&chunk);
        bytes.extend(crc32fast::hash(&chunk).to_be_bytes());
    }
    bytes
}

#[test]
fn every_kind_of_png_gives_its_pixels() {
    use ::png::{BitDepth::*, ColorType::*};
    let palette = Some([&[9, 8, 7, 1, 2, 3][..], &[255, 100]]);
    for (bytes, pixels) in [
        (png(2, Rgb, Eight, None, &[1, 2, 3, 4, 5, 6]), [[1, 2, 3, 255], [4, 5, 6, 255]]),
        (png(2, Rgba, Eight, None, &[1, 2, 3, 4, 5, 6, 7, 8]), [[1, 2, 3, 4], [5, 6, 7, 8]]),
        (png(2, Grayscale, Eight, None, &[1, 200]), [[1, 1, 1, 255], [200, 200, 200, 255]]),
        (png(2, GrayscaleAlpha, Eight, None, &[1, 2, 3, 4]), [[1, 1, 1, 2], [3, 3, 3, 4]]),
        (png(2, Grayscale, One, None, &[0b0100_0000]), [[0, 0, 0, 255], [255, 255, 255, 255]]),
        (png(2, Indexed, Two, palette, &[0b0001_0000]), [[9, 8, 7, 255], [1, 2, 3, 100]]),
        // Of 16 bits the nearest value remains: 0x0180 is 1.49 of 255, 0x0182 is 1.502.
        (png(2, Grayscale, Sixteen, None, &[1, 0x80, 1, 0x82]), [[1, 1, 1, 255], [2, 2, 2, 255]]),
        (
            png(2, Rgba, Sixteen, None, &[0, 0, 255, 255, 128, 128, 255, 255, 1, 1, 2, 2, 3, 3, 4, 4]),
            [[0, 255, 128, 255], [1, 2, 3, 4]],
        ),
    ] {
        let picture = decoded(&bytes);
        assert_eq!((picture.width, picture.height, picture.notice), (2, 1, None));
        assert_eq!(picture.rgba, pixels.concat());
    }
    let picture = decoded(&interlaced_png([10, 20, 30, 40]));
    assert_eq!(picture.rgba.iter().step_by(4).collect::<Vec<_>>(), [&10, &20, &30, &40]);
}

#[test]
fn every_kind_of_jpeg_webp_and_ktx2_gives_its_colours() {
    for (text, tolerance, expected) in [
        (JPEG_BASELINE, 12, PictureKind::Jpeg),
        (JPEG_PROGRESSIVE, 3, PictureKind::Jpeg),
        (JPEG_RGB, 2, PictureKind::Jpeg),
        (JPEG_CMYK, 3, PictureKind::Jpeg),
        (WEBP_LOSSLESS, 0, PictureKind::WebP),
        (WEBP_LOSSLESS_ALPHA, 0, PictureKind::WebP),
        (WEBP_LOSSY, 2, PictureKind::WebP),
        (WEBP_LOSSY_ALPHA, 2, PictureKind::WebP),
        (WEBP_MOVING, 0, PictureKind::WebP),
        (KTX2_ETC1S, 12, PictureKind::Ktx2),
        (KTX2_ETC1S_ALPHA, 12, PictureKind::Ktx2),
        (KTX2_UASTC, 1, PictureKind::Ktx2),
        (KTX2_UASTC_ALPHA, 1, PictureKind::Ktx2),
    ] {
        let bytes = hex(text);
        assert_eq!((kind(&bytes), size(&bytes)), (Some(expected), Ok((16, 48))));
        let picture = decoded(&bytes);
        for (place, colour) in COLOURS {
            let found = pixel(&picture, place);
            let off = found.iter().zip(colour).map(|(found, wanted)| found.abs_diff(wanted)).max();
            assert!(off <= Some(tolerance), "{found:?} for {colour:?} in {text}");
            let with_alpha = [WEBP_LOSSLESS_ALPHA, WEBP_LOSSY_ALPHA, KTX2_ETC1S_ALPHA, KTX2_UASTC_ALPHA];
            let alpha = if with_alpha.contains(&text) && place[1] >= 40 { 77 } else { 255_u8 };
            assert!(
                found[3].abs_diff(alpha) <= if expected == PictureKind::Ktx2 { 5 } else { 0 },
                "{found:?} in {text}"
            );
        }
        assert_eq!(picture.notice.is_some(), text == WEBP_MOVING);
    }
    // The brightness of the four colours.
    let picture = decoded(&hex(JPEG_GREY));
    let grey = COLOURS.map(|(place, _)| pixel(&picture, place)[0]);
    assert!(grey.iter().zip([250, 87, 124, 60]).all(|(found, wanted)| found.abs_diff(wanted) <= 2), "{grey:?}");
}

/// KTX2 that no Basis Universal is in: the number of Vulkan's format, width, height and pixels.
fn ktx2(format: u32, width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
    let mut bytes = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let words = [format, 1, width, height, 0, 2, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0];
    words.iter().for_each(|word| bytes.extend(word.to_le_bytes()));
    [104, pixels.len() as u64, pixels.len() as u64].iter().for_each(|long| bytes.extend(long.to_le_bytes()));
    bytes.extend(pixels);
    bytes
}

#[test]
fn plain_ktx2_gives_its_first_picture() {
    for (format, pixels, rgba) in [
        (37, &[1, 2, 3, 4, 5, 6, 7, 8][..], [1, 2, 3, 4, 5, 6, 7, 8]),
        (50, &[3, 2, 1, 4, 7, 6, 5, 8], [1, 2, 3, 4, 5, 6, 7, 8]),
        (29, &[1, 2, 3, 5, 6, 7], [1, 2, 3, 255, 5, 6, 7, 255]),
        (30, &[3, 2, 1, 7, 6, 5], [1, 2, 3, 255, 5, 6, 7, 255]),
    ] {
        let picture = decoded(&ktx2(format, 2, 1, &[pixels, pixels].concat()));
        assert_eq!(picture.rgba, rgba);
        assert_eq!(picture.notice.as_deref(), Some("it holds 2 pictures, and only the first is shown"));
    }
    let said = |bytes: &[u8]| decode(bytes, &Budget::default()).unwrap_err().to_string();
    assert!(said(&ktx2(37, 2, 1, &[1, 2, 3, 4])).contains("end too early"));
    assert!(said(&ktx2(145, 4, 4, &[0; 16])).contains("Vulkan's format 145"));
    let mut packed = ktx2(37, 2, 1, &[0; 16]);
    packed[44] = 3;
    assert!(said(&packed).contains("supercompression 3"));
    // Of the blocks only some are there.
    let cut = hex(KTX2_UASTC);
    assert!(said(&cut[..cut.len() - 9]).contains("end too early"));
}

#[test]
fn of_a_picture_cut_short_the_upper_part_is_kept_and_said() {
    let rows: Vec<u8> =
        (0..200_u32).flat_map(|row| (0..300).map(move |column| (row * row * 31 + column * 7) as u8)).collect();
    let whole = png(300, ColorType::Grayscale, BitDepth::Eight, None, &rows);
    let picture = decoded(&whole[..whole.len() / 2]);
    let kept = picture.rgba.iter().step_by(4).zip(&rows).take_while(|(found, row)| found == row).count() / 300;
    assert!((60..140).contains(&kept), "{kept} rows");
    assert_eq!(picture.notice.unwrap(), format!("cut short: the lower {} % are missing", (200 - kept).div_ceil(2)));

    let whole = hex(JPEG_BASELINE);
    let picture = decoded(&whole[..whole.len() - 12]);
    assert!(pixel(&picture, [12, 12])[0] > 180, "the first row of blocks is there");
    // Two rows of blocks out of three, and the rows that need them to be enlarged.
    assert_eq!(picture.notice.as_deref(), Some("cut short: the lower 71 % are missing"));
    assert_eq!(pixel(&picture, [8, 44]), [128, 128, 128, 255], "what is missing is grey and opaque");

    let whole = hex(JPEG_PROGRESSIVE);
    let picture = decoded(&whole[..whole.len() - 30]);
    assert_eq!(picture.notice.as_deref(), Some("cut short: it is coarser than it was made"));
    assert!(pixel(&picture, [8, 44])[2] > 160, "the last rows are there");

    // Nothing of these can be shown.
    for whole in [JPEG_BASELINE, WEBP_LOSSLESS, WEBP_LOSSY].map(hex) {
        assert!(matches!(decode(&whole[..30], &Budget::default()), Err(DecodeError::CutShort)));
    }
}

#[test]
fn what_a_picture_claims_is_refused_before_it_is_allocated() {
    // Pictures that are 16 000 pixels wide and high, as their headers say.
    let mut large_png = png(1, ColorType::Grayscale, BitDepth::Eight, None, &[1]);
    large_png[16..24].copy_from_slice(&[0, 0, 0x3e, 0x80, 0, 0, 0x3e, 0x80]);
    let mut large_jpeg = hex(JPEG_GREY);
    let frame = large_jpeg.windows(2).position(|marker| marker == [0xff, 0xc0]).unwrap();
    large_jpeg[frame + 5..frame + 9].copy_from_slice(&[0x3e, 0x80, 0x3e, 0x80]);
    // Of so few bytes not even a row could come.
    assert_eq!(decode(&large_jpeg, &Budget::default()), Err(DecodeError::CutShort));
    large_jpeg.resize(10_000, 0);
    let mut large_webp = hex(WEBP_LOSSLESS);
    large_webp[21..25].copy_from_slice(&(15_999_u32 << 14 | 15_999).to_le_bytes());
    let mut large_ktx2 = hex(KTX2_ETC1S);
    large_ktx2[20..28].copy_from_slice(&[0x80, 0x3e, 0, 0, 0x80, 0x3e, 0, 0]);
    for bytes in [large_png, large_jpeg, large_webp, large_ktx2] {
        let budget = Budget::new(500_000_000);
        assert_eq!(size(&bytes), Ok((16_000, 16_000)));
        assert!(matches!(decode(&bytes, &budget), Err(DecodeError::OverBudget(_))));
        assert_eq!(budget.left(), 500_000_000, "a refusal takes nothing");
    }
    // A side of 0, and one that no graphics processor takes.
    for sides in [[0, 0, 0, 0], [0, 0, 0x40, 1]] {
        let mut bytes = png(1, ColorType::Grayscale, BitDepth::Eight, None, &[1]);
        bytes[16..20].copy_from_slice(&sides);
        assert!(matches!(size(&bytes), Err(DecodeError::Size { .. })));
    }
    // The pixels that are returned stay taken, and nothing else.
    let budget = Budget::default();
    let picture = decode(&hex(WEBP_LOSSY), &budget).unwrap();
    assert_eq!(budget.left(), Budget::DEFAULT - picture.rgba.len() as u64);
}

#[test]
fn a_picture_within_is_no_larger_than_the_canvas() {
    // The canvas is one pixel, the picture upon it 16 × 48.
    let mut bytes = hex(WEBP_LOSSY_ALPHA);
    bytes[24..30].fill(0);
    assert_eq!(size(&bytes), Ok((1, 1)));
    assert!(decode(&bytes, &Budget::default()).unwrap_err().to_string().contains("larger than it says"));
}

#[test]
fn mutated_pictures_end_in_pixels_or_a_sentence() {
    let pictures = [
        png(20, ColorType::Rgb, BitDepth::Eight, None, &[7; 1200]),
        interlaced_png([1, 2, 3, 4]),
        hex(JPEG_BASELINE),
        hex(JPEG_PROGRESSIVE),
        hex(JPEG_CMYK),
        hex(WEBP_LOSSLESS_ALPHA),
        hex(WEBP_LOSSY_ALPHA),
        hex(WEBP_MOVING),
        hex(KTX2_ETC1S_ALPHA),
        hex(KTX2_UASTC),
        ktx2(37, 2, 2, &[1; 32]),
    ];
    for bytes in pictures.iter().flat_map(|picture| mutations(picture, 300)) {
        let budget = Budget::new(40_000_000);
        match decode(&bytes, &budget) {
            Ok(picture) => {
                assert_eq!(picture.rgba.len(), 4 * picture.width as usize * picture.height as usize);
                assert_eq!(budget.left(), 40_000_000 - picture.rgba.len() as u64);
            }
            Err(error) => {
                assert!(!error.to_string().is_empty());
                assert_eq!(budget.left(), 40_000_000);
            }
        }
    }
}
