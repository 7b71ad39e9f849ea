//! Law: a picture's pixels come out as they went in, whatever its format; of a picture that ends too early the upper
//! part is kept and said to be so; nothing that the bytes claim is allocated beyond the budget, and no bytes make a
//! decoder panic. The pictures were written by libpng, libjpeg-turbo, libwebp and
//! Basis Universal's encoder, or by the hand of the test.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use super::{DecodedPicture, PictureKind, decode, kind, size};
use crate::DecodeError;
use crate::mutations::{hex, mutations};
use ::png::{BitDepth, ColorType, Encoder};
use regular_file::Budget;

/// Colours of the pictures below, 16 pixels wide and 48 high: a white square of 8 pixels in the upper left corner, red
/// beside it, green from row 16, blue from row 32. Each with a column and a row where it stands.
const COLOURS: [([usize; 2], [u8; 3]); 4] =
    [([2, 2], [250, 250, 250]), ([12, 12], [200, 40, 30]), ([8, 24], [40, 180, 60]), ([8, 44], [30, 50, 190])];

/// Baseline JPEG whose colour has half the resolution.
const JPEG_BASELINE: &str = "\
    ffd8ffe000104a46494600010100000100010000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f13201513121213271c1e17\
    202e2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a51524fffdb0043010e0e0e131113\
    261515264f352d354f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f\
    4f4f4f4f4f4f4f4fffc00011080030001003012200021101031101ffc4001700010101010000000000000000000000000007\
    0506ffc40014100100000000000000000000000000000000ffc4001801000203000000000000000000000000000306040507\
    ffc4001a110002030101000000000000000000000000110304211214ffda000c03010002110311003f00a5a36083249dac18\
    ead5f3bd6cd700033a39700fe5b1ffd9";
/// Progressive JPEG.
const JPEG_PROGRESSIVE: &str = "\
    ffd8ffe000104a46494600010100000100010000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f13201513121213271c1e17\
    202e2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a51524fffdb0043010e0e0e131113\
    261515264f352d354f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f\
    4f4f4f4f4f4f4f4fffc20011080030001003011100021101031101ffc4001700010101010000000000000000000000000006\
    0405ffc4001801010003010000000000000000000000000002040605ffda000c03010002100310000001a5236b75c0d91cb8\
    0397a0b600ffc40014100100000000000000000000000000000030ffda00080101000105024fffc400141101000000000000\
    00000000000000000030ffda0008010301013f014fffc40014110100000000000000000000000000000030ffda0008010201\
    013f014fffc40014100100000000000000000000000000000030ffda0008010100063f024fffc40014100100000000000000\
    000000000000000030ffda0008010100013f214fffda000c03010002000300000010924492000fffc4001411010000000000\
    0000000000000000000030ffda0008010301013f104fffc40014110100000000000000000000000000000030ffda00080102\
    01013f104fffc40014100100000000000000000000000000000030ffda0008010100013f104fffd9";
/// JPEG that stores red, green and blue.
const JPEG_RGB: &str = "\
    ffd8ffee000e41646f626500640000000000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f13201513121213271c1e17202e\
    2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a51524fffc00011080030001003521100\
    471100421100ffc4001800010101010100000000000000000000000007050803ffc400141001000000000000000000000000\
    00000000ffda000c03520047004200003f00a5a96a5b01cfce78000475566900000f14bd5000001fffd9";
/// JPEG of four inks.
const JPEG_CMYK: &str = "\
    ffd8ffee000e41646f626500640000000000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f13201513121213271c1e17202e\
    2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a51524fffc00014080030001004431100\
    4d11005911004b1100ffc4001800010101010100000000000000000000000007050803ffc400141001000000000000000000\
    00000000000000ffda000e0443004d0059004b00003f00a5a96a5a9cc073f39e0000047556690000000f14bd500000001fff\
    d9";
/// Grey JPEG.
const JPEG_GREY: &str = "\
    ffd8ffe000104a46494600010100000100010000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f13201513121213271c1e17\
    202e2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a51524fffc0000b08003000100101\
    1100ffc40017000101010100000000000000000000000000070506ffc40014100100000000000000000000000000000000ff\
    da0008010100003f00a5a360d701cb80ffd9";
/// WebP without loss.
const WEBP_LOSSLESS: &str = "\
    5249464646000000574542505650384c390000002f0fc00b001f202420ba31469a6d899080e8069a6d90242420ced8698b9d\
    d2fcc7df8009814cdaa6266b7226778f1988e8ff04806ef6bdcf3d00";
/// WebP without loss, its last 8 rows of alpha 77.
const WEBP_LOSSLESS_ALPHA: &str = "\
    5249464658000000574542505650384c4b0000002f0fc00b102740986db4f7600679d84742a46d333c81937d414784d94683\
    19e7588ef35e020142a15883e2ff4d6c00ce8299b66d422114466114c69f58b43fa2ff1300a0dae9dffb93df3c00";
/// WebP with loss.
const WEBP_LOSSY: &str = "\
    5249464662000000574542505650382056000000d003009d012a1000300001402625a002c49505f807e00728a308e81f8abc\
    2b3dc0ccfc0fce060000fb3fff7bfdffef749fffdec9885db29d4308d2760e7076c15bb056b056ec78bfc00f56ddcf4a87ed\
    70053add0000";
/// WebP with loss, its last 8 rows of alpha 77.
const WEBP_LOSSY_ALPHA: &str = "\
    524946469200000057454250565038580a000000100000000f00002f0000414c504815000000010f70a7ff8888201048f697\
    4e608088fe673b0000005650382056000000d003009d012a1000300001402625a002c49505f807e00728a308e81f8abc2b3d\
    c0ccfc0fce060000fb3fff7bfdffef749fffdec9885db29d4308d2760e7076c15bb056b056ec78bfc00f56ddcf4a87ed7005\
    3add0000";
/// WebP of two pictures, the second upside down.
const WEBP_MOVING: &str = "\
    524946461601000057454250565038580a000000120000000f00002f0000414e494d06000000000000000000414e4d467200\
    00000000000000000f00002f0000320000025650384c590000002f0fc00b001f2010209eb42990a84e484074238cb0d85421\
    01f1dc344b244be63fd001df0566dab631c9902cc9dd6310d1ffb8db7edbb66ddbb66ddbb66ddbb66d555555555555555555\
    55555555555555000000000000000000414e4d46700000000000000000000f00002f0000320000005650384c580000002f0f\
    c00b101f20102034f9af10a34520402811215ba5408090aa548998f90f80f6558399b66d4c32244b72f71844f43faaaaaaaa\
    aaaaaaaaaaaaaaaaaaaaaaaa0000000000000000b66ddbb66ddbb66ddbb66ddbb6bbd701";

/// KTX2 with codebooks.
const KTX2_ETC1S: &str = "\
    ab4b5458203230bb0d0a1a0a0000000001000000100000003000000000000000000000000100000001000000010000006800\
    00002c0000009400000024000000b8000000000000009b0000000000000053010000000000000d0000000000000000000000\
    000000002c0000000000000002002800a301020003030000080000000000000000003f000000000000000000ffffffff1f00\
    00004b545877726974657200426173697320556e6976657273616c20322e3130000004000300340000000d00000032000000\
    0000000000000000000000000d00000000000000000000001d40d4800100004050f0034d0e2c8029010300000020cc51807d\
    0298022000000000825e37f0008801000000000041c02af5d60efcffffffafaaaaaa020000000014c084000100000010d485\
    900098001000000000409208781b2000002088426970f484fc4406600e400000000008d3170302cebb896374114dab23fa49\
    5407";
/// KTX2 with codebooks and smaller pictures, its last 8 rows of alpha 77.
const KTX2_ETC1S_ALPHA: &str = "\
    ab4b5458203230bb0d0a1a0a000000000100000010000000300000000000000000000000010000000600000001000000e000\
    00003c0000001c0100002400000040010000000000006501000000000000d302000000000000220000000000000000000000\
    00000000bc0200000000000017000000000000000000000000000000b3020000000000000900000000000000000000000000\
    0000ad0200000000000006000000000000000000000000000000a90200000000000004000000000000000000000000000000\
    a502000000000000040000000000000000000000000000003c0000000000000002003800a301020003030000080800000000\
    000000003f000000000000000000ffffffff40003f0f0000000000000000ffffffff1f0000004b5458777269746572004261\
    73697320556e6976657273616c20322e31300000170012006000000039000000400000000000000000000000000000001500\
    0000150000000d00000000000000000000000d0000000d0000000a0000000000000000000000050000000500000004000000\
    0000000000000000030000000300000003000000000000000000000002000000020000000200000000000000000000000200\
    0000020000000200000020401c8801008600e059ba34c2e80b20c01b00010080609c94561e1106023c8210008008680fb34f\
    2bb991461080080002000082208b5b01601d74674f4cfb8fd978d6ed6f87a9076eceb5a5f4a50ea884b9bef98bca08c20211\
    29c946a4ee06000826050c80300c00c0e34532274898010400c51112268266ca66a25f5f5555adf1067fa0a0a04290094990\
    08aad81e75edf7ecfd38c7f8160041440002008081500a7fa1cc9f65285d006f0008000808bd187206475f53402387011006\
    a50eb4ee16c28123fe001ac737f800e2060800000040b2c815800039010500dd15f5009deef711b000cdbaa73a034fb0b001\
    e9ca9939c7199ea4f7943f971f124c654c58ef8d8ebe015632c7eeaeae963084814b05268c86288d5b98301c120c15268cc7\
    1843254785092b";
/// KTX2 of blocks of 16 bytes, packed by Zstandard.
const KTX2_UASTC: &str = "\
    ab4b5458203230bb0d0a1a0a0000000001000000100000003000000000000000000000000100000001000000020000006800\
    00002c000000940000002400000000000000000000000000000000000000b800000000000000400000000000000000030000\
    000000002c0000000000000002002800a601020003030000100000000000000000007f000000000000000000ffffffff1f00\
    00004b545877726974657200426173697320556e6976657273616c20322e3130000028b52ffd600002b501000402575f5fff\
    5f7aef01001719c5e37fd0c7008596e73f301701d743c6f73f1ec50207007540f13aa0cc430a1d820400c83351c8c011";
/// KTX2 of blocks of 16 bytes, its last 8 rows of alpha 77.
const KTX2_UASTC_ALPHA: &str = "\
    ab4b5458203230bb0d0a1a0a0000000001000000100000003000000000000000000000000100000001000000020000006800\
    00002c000000940000002400000000000000000000000000000000000000b800000000000000450000000000000000030000\
    000000002c0000000000000002002800a601020003030000100000000000000000007f030000000000000000ffffffff1f00\
    00004b545877726974657200426173697320556e6976657273616c20322e3130000028b52ffd600002dd01002402575f5fff\
    5f7aef01001719c5e37fd0c7008596e73f301701d743c6f73f1ec502b729082070a3850338c558caeb94f9a7d041020479a2\
    908923";

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
