//! Law under test: an OpenEXR file shows the same surroundings in whatever channels, blocks, packing and windows they
//! are stored, in the directions that OpenEXR gives them. A wrong reader would turn or mirror a face, take wide
//! primaries for those of sRGB, or make a bad number into a white screen.

use super::super::decode::decode;
use super::cubes::{assert_colours, colour};
use super::exr_file::*;
use super::pictures::*;
use exr::compression::Compression;
use exr::math::Vec2;
use exr::meta::attribute::{Chromaticities, EnvironmentMap, IntegerBounds, SampleType, Text};
use exr::meta::header::Header;
use glam::Vec3;
use regular_file::Budget;
use scene::Panorama;
use scene::mipmap::linear_from_srgb;
use std::path::Path;

const SIZE: [u32; 2] = [64, 32];

/// Number of the surroundings for a channel R, G or B, at a place of the data window.
fn number(header: &Header, channel: &str, x: usize, y: usize) -> f32 {
    let display = header.shared_attributes.display_window;
    let position = header.own_attributes.layer_position;
    let x = (x as i32 + position.0 - display.position.0).rem_euclid(display.size.0 as i32) as u32;
    let y = (y as i32 + position.1 - display.position.1).clamp(0, display.size.1 as i32 - 1) as u32;
    let rgb = surroundings([display.size.0 as u32, display.size.1 as u32], x, y);
    let index = "RGB".find(&channel[channel.len() - 1..]).unwrap_or(0);
    linear_from_srgb(f32::from(rgb[index]) / 255.0)
}

fn assert_shown(header: Header, tolerance: f32, what: &str) -> Vec<String> {
    let (panorama, notices) = read(&file(&[header], number));
    assert_eq!([panorama.width, panorama.height], SIZE, "{what}");
    assert_surroundings(&panorama, tolerance, what);
    notices
}

#[test]
fn every_packing_in_lines_and_tiles_shows_the_same() {
    let packings = [
        (Compression::Uncompressed, 1e-3),
        (Compression::RLE, 1e-3),
        (Compression::ZIP1, 1e-3),
        (Compression::ZIP16, 1e-3),
        (Compression::PIZ, 1e-3),
        (Compression::PXR24, 1e-3),
        (Compression::B44, 0.02),
        (Compression::B44A, 0.02),
        (Compression::DWAA(None), 0.02),
        (Compression::DWAB(None), 0.02),
    ];
    for (compression, tolerance) in packings {
        for sample_type in [SampleType::F16, SampleType::F32] {
            let lines = Header { compression, ..rgb_part(64, 32, sample_type) };
            let what = format!("{compression:?}, {sample_type:?}");
            // What packing changes may be a little below 0, and is told as such.
            let notices = assert_shown(lines.clone(), tolerance, &what);
            assert!(notices.is_empty() || tolerance > 1e-3, "{what}: {notices:?}");
            assert_shown(tiled(lines, 24), tolerance, &format!("{what}, in tiles"));
        }
    }
}

#[test]
fn numbers_stay_as_they_are() {
    let values = |header: &Header, channel: &str, x: usize, y: usize| {
        let index = (y * header.layer_size.0 + x) * 3 + "RGB".find(channel).unwrap();
        1e-3 * 2.0_f32.powi(index as i32)
    };
    let (panorama, notices) = read(&file(&[rgb_part(4, 2, SampleType::F32)], values));
    for (index, value) in panorama.rgb.as_flattened().iter().enumerate() {
        let expected = 1e-3 * 2.0_f32.powi(index as i32);
        assert!((value.to_f32() / expected - 1.0).abs() < 1.0 / 2048.0, "{value} is not {expected}");
    }
    assert!(notices.is_empty());
    let whole = read(&file(&[rgb_part(4, 2, SampleType::U32)], |_, _, x, _| x as f32)).0;
    assert_eq!(whole.pixel(3, 0), [3.0; 3], "whole numbers");
}

#[test]
fn a_cube_of_openexr_is_seen_as_its_header_says() {
    // ImfEnvmap.h: faces +X, −X, +Y, −Y, +Z, −Z; here by the direction of each face's pixels in OpenEXR's axes.
    const SIDE: usize = 32;
    let direction = |x: usize, row: usize| {
        let place = |index: usize| index as f32 / (SIDE - 1) as f32 * 2.0 - 1.0;
        let (across, down) = (place(x), place(row % SIDE));
        match row / SIDE {
            0 => Vec3::new(1.0, -down, across),
            1 => Vec3::new(-1.0, -down, -across),
            2 => Vec3::new(across, 1.0, -down),
            3 => Vec3::new(across, -1.0, down),
            4 => Vec3::new(-across, -down, 1.0),
            _ => Vec3::new(across, -down, -1.0),
        }
    };
    let mut header = rgb_part(SIDE as u32, 6 * SIDE as u32, SampleType::F32);
    header.own_attributes.environment_map = Some(EnvironmentMap::Cube);
    let bytes = file(&[header.clone()], |_, channel, x, y| {
        // Ahead is OpenEXR's +z, and left its +x.
        let seen = direction(x, y) * Vec3::new(-1.0, 1.0, -1.0);
        colour(seen)["RGB".find(channel).unwrap()]
    });
    let read = decode(&bytes, Path::new("x.exr"), &Budget::default()).unwrap();
    assert_eq!(read.description, "OpenEXR, OpenEXR cube");
    assert_colours(&read.panorama, 0.02, "OpenEXR cube");
    // Without the header's word, the same picture is a cube map of graphics interfaces.
    header.own_attributes.environment_map = None;
    let read = decode(&file(&[header], number), Path::new("x.exr"), &Budget::default()).unwrap();
    assert_eq!(read.description, "OpenEXR, cube, faces one below another");
}

#[test]
fn a_latitude_longitude_map_has_left_on_the_left() {
    let mut header = rgb_part(64, 32, SampleType::F16);
    header.own_attributes.environment_map = Some(EnvironmentMap::LatitudeLongitude);
    assert_shown(header, 1e-3, "latlong");
}

#[test]
fn other_primaries_become_srgb_and_white_stays_white() {
    let colours = [
        // ITU-R BT.2020: red, green and blue of sRGB in its numbers (ITU-R BT.2087, table 4).
        ([0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290], [0.6274, 0.0691, 0.0164], [1.0, 0.0, 0.0]),
        ([0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290], [0.3293, 0.9195, 0.0880], [0.0, 1.0, 0.0]),
        // ACES 2065-1, whose white is that of D60.
        ([0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.077, 0.32168, 0.33767], [0.5; 3], [0.5; 3]),
        ([0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290], [0.1, 0.2, 0.3], [0.1, 0.2, 0.3]),
    ];
    for ([rx, ry, gx, gy, bx, by, wx, wy], stored, expected) in colours {
        let mut header = rgb_part(4, 2, SampleType::F32);
        header.shared_attributes.chromaticities =
            Some(Chromaticities { red: Vec2(rx, ry), green: Vec2(gx, gy), blue: Vec2(bx, by), white: Vec2(wx, wy) });
        let (panorama, _) = read(&file(&[header], |_, channel, _, _| stored["RGB".find(channel).unwrap()]));
        let seen = panorama.pixel(1, 1);
        assert!(difference(seen, expected) < 2e-3, "{stored:?}: {seen:?} is not {expected:?}");
    }
    // A colour that sRGB does not have is told.
    let mut header = rgb_part(4, 2, SampleType::F32);
    let point = |x, y| Vec2(x, y);
    header.shared_attributes.chromaticities = Some(Chromaticities {
        red: point(0.708, 0.292),
        green: point(0.170, 0.797),
        blue: point(0.131, 0.046),
        white: point(0.3127, 0.3290),
    });
    let green = |_: &Header, channel: &str, _: usize, _: usize| f32::from(u8::from(channel == "G"));
    let (panorama, notices) = read(&file(&[header.clone()], green));
    assert!(notices[0].contains("a colour that sRGB does not have: 8"), "{notices:?}");
    assert_eq!(panorama.pixel(0, 0)[0], 0.0);
    header.shared_attributes.chromaticities.as_mut().unwrap().red = point(0.0, 0.0);
    header.shared_attributes.chromaticities.as_mut().unwrap().green = point(0.0, 0.0);
    assert!(read(&file(&[header], green)).1[0].contains("are no colours"));
}

#[test]
fn luminance_alone_is_grey() {
    let header = part(64, 32, [channel("Y", SampleType::F16)]);
    let (panorama, notices) = read(&file(&[header], |_, _, _, y| y as f32));
    assert_eq!((panorama.pixel(7, 3), panorama.pixel(60, 31)), ([3.0; 3], [31.0; 3]));
    assert!(notices.is_empty());
}

#[test]
fn luminance_and_chroma_at_half_resolution_are_colours() {
    let stored = [0.5, 0.2, 0.1_f32];
    let luminance = |y: usize| (0.2126 * stored[0] + 0.7152 * stored[1] + 0.0722 * stored[2]) * (1.0 + y as f32);
    let packings =
        [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::ZIP16, Compression::PIZ];
    for compression in packings {
        let channels = [channel("Y", SampleType::F16), at_half_resolution("RY"), at_half_resolution("BY")];
        let header = Header { compression, ..part(64, 32, channels) };
        let (panorama, _) = read(&file(&[header], |_, channel, _, y| match channel {
            "Y" => luminance(y),
            "RY" => stored[0] / luminance(0) - 1.0,
            _ => stored[2] / luminance(0) - 1.0,
        }));
        for y in [0, 1, 2, 17, 31] {
            let (seen, expected) = (panorama.pixel(40, y), stored.map(|number| number * (1.0 + y as f32)));
            let tolerance = 5e-3 * (1.0 + y as f32);
            assert!(difference(seen, expected) < tolerance, "{compression:?}, row {y}: {seen:?} is not {expected:?}");
        }
    }
}

#[test]
fn luminance_and_chroma_are_unpacked_from_b44() {
    // B44 packs four by four half floats in 14 bytes, or 3 if all are equal: the order of their bits (as a number that
    // grows with the float), and a shift that says so.
    let flat = |number: f32| {
        let bits = half::f16::from_f32(number).to_bits();
        let ordered = if bits & 0x8000 == 0 { bits | 0x8000 } else { !bits };
        [(ordered >> 8) as u8, ordered as u8, 0xfc]
    };
    let channels = [channel("Y", SampleType::F16), at_half_resolution("RY"), at_half_resolution("BY")];
    let header = Header { compression: Compression::B44A, ..part(32, 16, channels) };
    let mut bytes = file(&[Header { compression: Compression::ZIP16, ..header.clone() }], |_, _, _, _| 0.0);
    // One block holds all 16 rows: BY, RY, Y in the order of their names.
    let blocks = [(flat(-0.5), 8), (flat(1.0), 8), (flat(0.25), 32)];
    let packed: Vec<u8> = blocks.iter().flat_map(|(block, count)| block.repeat(*count)).collect();
    let place = bytes.windows(12).position(|name| name == b"compression\0").unwrap() + 12 + 12 + 4;
    bytes[place] = 7;
    let start = u64::from_le_bytes(*bytes[table_of(&bytes)..].first_chunk().unwrap()) as usize;
    bytes.truncate(start + 4);
    bytes.extend((packed.len() as i32).to_le_bytes());
    bytes.extend(packed);
    let (panorama, notices) = read(&bytes);
    assert!(notices.is_empty(), "{notices:?}");
    let green = (0.25 - 0.2126 * 0.5 - 0.0722 * 0.125) / 0.7152;
    for (x, y) in [(0, 0), (31, 15), (9, 7)] {
        assert!(difference(panorama.pixel(x, y), [0.5, green, 0.125]) < 2e-3, "{:?}", panorama.pixel(x, y));
    }
}

/// Place of the table of a file with one block: just before it.
fn table_of(bytes: &[u8]) -> usize {
    (0..bytes.len() - 8)
        .find(|&place| u64::from_le_bytes(*bytes[place..].first_chunk().unwrap()) == place as u64 + 8)
        .unwrap()
}

#[test]
fn the_first_layer_with_colours_is_drawn_and_named() {
    let names = ["ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B", "ViewLayer.Combined.A"];
    let channels = names.map(|name| channel(name, SampleType::F16)).into_iter();
    let channels = channels.chain([channel("ViewLayer.Depth.Z", SampleType::F32)]);
    let notices = assert_shown(part(64, 32, channels), 1e-3, "layers");
    assert!(notices[0].contains("\"ViewLayer.Combined\" is drawn"), "{notices:?}");

    // Several parts, the first of which has no colours.
    let mut depth = part(64, 32, [channel("Z", SampleType::F32)]);
    depth.own_attributes.layer_name = Some(Text::from("depth"));
    let mut beauty = Header { compression: Compression::ZIP16, ..rgb_part(64, 32, SampleType::F16) };
    beauty.own_attributes.layer_name = Some(Text::from("beauty"));
    let (panorama, notices) = read(&file(&[depth.clone(), beauty], number));
    assert_surroundings(&panorama, 1e-3, "parts");
    assert!(notices[0].contains("\"beauty\" is drawn"), "{notices:?}");
    let error = refusal(&file(&[depth], number));
    assert!(error.contains("no channels R, G and B, and no Y, but Z"), "{error}");
}

#[test]
fn data_windows_are_placed_in_the_display_window() {
    let window = |x, y, width, height| IntegerBounds { position: Vec2(x, y), size: Vec2(width, height) };
    // The lower half alone, in a display window that does not begin at 0.
    let mut header = Header { compression: Compression::ZIP16, ..rgb_part(64, 16, SampleType::F16) };
    header.shared_attributes.display_window = window(10, -4, 64, 32);
    header.own_attributes.layer_position = Vec2(10, 12);
    let (panorama, notices) = read(&file(&[header], number));
    assert!(notices[0].contains("holds 64 × 16 of the 64 × 32 pixels"), "{notices:?}");
    assert_eq!((panorama.pixel(32, 15), panorama.pixel(32, 17)), ([0.0; 3], [0.0, 1.0, 0.0]));

    // More than the picture on all sides.
    for tiles in [None, Some(16)] {
        let mut header = rgb_part(72, 40, SampleType::F16);
        header.shared_attributes.display_window = window(0, 0, 64, 32);
        header.own_attributes.layer_position = Vec2(-4, -4);
        let header = if let Some(side) = tiles { tiled(header, side) } else { header };
        assert!(assert_shown(header, 1e-3, "overscan").is_empty());
    }
}

#[test]
fn bad_numbers_stay_single_and_are_told() {
    let bad = [f32::INFINITY, f32::NAN, 1e30, -5.0, f32::NEG_INFINITY];
    let value = |header: &Header, channel: &str, x: usize, y: usize| {
        if y == 20 && x < 5 { bad[x] } else { number(header, channel, x, y) * 0.5 }
    };
    let (panorama, notices) = read(&file(&[rgb_part(64, 32, SampleType::F32)], value));
    assert!(notices[0].contains("not finite or too large for light: 15"), "{notices:?}");
    let brightest = panorama.rgb.as_flattened().iter().map(|value| value.to_f32()).fold(0.0, f32::max);
    assert_eq!(brightest, 0.5, "no bad number is brighter than the brightest good one");
    assert_eq!([0, 1, 2, 3, 4].map(|x| panorama.pixel(x, 20)[0]), [0.5, 0.0, 0.5, 0.0, 0.0]);
    // Light beyond half floats is no fault of the file.
    let (panorama, notices) = read(&file(&[rgb_part(4, 2, SampleType::F32)], |_, _, x, _| 1e5 * x as f32));
    assert_eq!(panorama.pixel(1, 0), [Panorama::BRIGHTEST; 3]);
    assert!(notices[0].contains("above 65504, the greatest that is drawn: 18"), "{notices:?}");
}

#[test]
fn missing_blocks_are_black_and_told() {
    let bytes = file(&[rgb_part(64, 32, SampleType::F16)], number);
    let (panorama, notices) = read(&bytes[..bytes.len() - 100]);
    assert!(notices[0].contains("a block is missing; 4 % of it"), "{notices:?}");
    assert_eq!((panorama.pixel(5, 31), panorama.pixel(5, 0)), ([0.0; 3], [1.0; 3]));
    let table = bytes.len() - 32 * (8 + 64 * 6);
    assert!(refusal(&bytes[..table]).contains("a block is missing"));
    assert!(refusal(&bytes[..table - 8]).contains("ends in its table of blocks"));
}

#[test]
fn deep_data_is_refused_with_a_sentence() {
    let header = Header { deep: true, deep_data_version: Some(1), ..rgb_part(4, 2, SampleType::F16) };
    let mut bytes = exr::meta::magic_number::BYTES.to_vec();
    bytes.extend((2_u32 | 1 << 11).to_le_bytes());
    let header = Header { compression: Compression::ZIP1, ..header };
    header.write(&mut bytes).unwrap();
    assert!(refusal(&bytes).contains("flatten it"), "{}", refusal(&bytes));
}
