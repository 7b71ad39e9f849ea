//! Law under test: a picture of Radiance shows the same surroundings whatever the order of its axes, the packing of its
//! scanlines and its exposure. A wrong reader would mirror it, show it twice as bright, or refuse it.

use super::pictures::*;
use glam::Vec3;

/// Width and height of the surroundings.
const SIZE: [u32; 2] = [64, 32];

/// Way of packing scanlines.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Packing {
    Flat,
    Runs,
    Channels,
}

/// Shared-exponent pixel of codes 0 to 255, as linear numbers of 1 / 255, times `factor`.
fn pixel(codes: [u8; 3], factor: f64) -> [u8; 4] {
    let numbers = codes.map(|code| f64::from(scene::mipmap::linear_from_srgb(f32::from(code) / 255.0)) * factor);
    let greatest = numbers.into_iter().fold(0.0, f64::max);
    if greatest == 0.0 {
        return [0; 4];
    }
    let exponent = greatest.log2().floor() + 1.0;
    let [red, green, blue] = numbers.map(|number| (number / exponent.exp2() * 256.0).min(255.0) as u8);
    [red, green, blue, (exponent + 128.0) as u8]
}

fn packed(line: &[[u8; 4]], packing: Packing) -> Vec<u8> {
    let mut bytes = Vec::new();
    match packing {
        Packing::Flat => bytes.extend(line.as_flattened()),
        Packing::Runs => {
            let mut rest = line;
            while let Some(&first) = rest.first() {
                let run = rest.iter().take_while(|pixel| **pixel == first).count();
                bytes.extend(first);
                // The count of repetitions, in digits to the base 256.
                let mut count = run - 1;
                while count > 0 {
                    bytes.extend([1, 1, 1, (count % 256) as u8]);
                    count /= 256;
                }
                rest = &rest[run..];
            }
        }
        Packing::Channels => {
            bytes.extend([2, 2, (line.len() >> 8) as u8, line.len() as u8]);
            for channel in 0..4 {
                let mut rest = line;
                while let Some(&first) = rest.first() {
                    let run = rest.iter().take(127).take_while(|pixel| pixel[channel] == first[channel]).count();
                    if run > 2 {
                        bytes.extend([128 + run as u8, first[channel]]);
                        rest = &rest[run..];
                    } else {
                        bytes.extend([1, first[channel]]);
                        rest = &rest[1..];
                    }
                }
            }
        }
    }
    bytes
}

/// File with these lines of header, of the surroundings in the order of axes.
fn file(header: &str, [first, second]: [&str; 2], packing: Packing, [width, height]: [u32; 2], factor: f64) -> Vec<u8> {
    let length = |axis: &str| if axis.ends_with('X') { width } else { height };
    let mut bytes = format!("{header}\n{first} {} {second} {}\n", length(first), length(second)).into_bytes();
    for outer in 0..length(first) {
        let line: Vec<_> = (0..length(second))
            .map(|inner| {
                let place = |axis: &str| {
                    let along = if first.ends_with(axis) { outer } else { inner };
                    // Columns count from the left with +X; rows count from the top with −Y.
                    let reversed = [first, second].contains(&if axis == "X" { "-X" } else { "+Y" });
                    let side = if axis == "X" { width } else { height };
                    if reversed { side - 1 - along } else { along }
                };
                pixel(surroundings([width, height], place("X"), place("Y")), factor)
            })
            .collect();
        bytes.extend(packed(&line, packing));
    }
    bytes
}

const PLAIN: &str = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

/// Difference that a mantissa of eight bits makes.
const MANTISSA: f32 = 0.02;

#[test]
fn all_orders_of_axes_show_the_same() {
    for vertical in ["-Y", "+Y"] {
        for horizontal in ["+X", "-X"] {
            for axes in [[vertical, horizontal], [horizontal, vertical]] {
                for packing in [Packing::Flat, Packing::Runs, Packing::Channels] {
                    let (panorama, notices) = read(&file(PLAIN, axes, packing, SIZE, 1.0));
                    assert_eq!([panorama.width, panorama.height], SIZE);
                    assert_surroundings(&panorama, MANTISSA, &format!("{axes:?}, {packing:?}"));
                    assert!(notices.is_empty(), "{notices:?}");
                }
            }
        }
    }
}

#[test]
fn runs_longer_than_a_byte_counts_are_read() {
    let wide = file(PLAIN, ["-Y", "+X"], Packing::Runs, [2048, 1024], 1.0);
    assert_surroundings(&read(&wide).0, MANTISSA, "runs of 512");
}

#[test]
fn headers_of_all_writers_are_read() {
    for header in [
        "#?RGBE\nFORMAT=32-bit_rle_rgbe\n",
        "#?RADIANCE\n",
        "#?RADIANCE\n# made by hand\nsome words\nFORMAT=32-bit_rle_rgbe\nGAMMA=1\nEXPOSURE=1\n",
        "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n",
    ] {
        assert_surroundings(&read(&file(header, ["-Y", "+X"], Packing::Channels, SIZE, 1.0)).0, MANTISSA, header);
    }
    let narrow = read(&file(PLAIN, ["-Y", "+X"], Packing::Flat, [6, 3], 1.0)).0;
    assert_eq!(narrow.pixel(3, 0), [1.0; 3]);
}

#[test]
fn numbers_are_divided_by_the_product_of_all_exposures() {
    let header = format!("{PLAIN}EXPOSURE=4\nEXPOSURE= 0.5\n");
    assert_surroundings(&read(&file(&header, ["-Y", "+X"], Packing::Channels, SIZE, 2.0)).0, MANTISSA, "exposure 2");
    let bad = format!("{PLAIN}EXPOSURE=0\n");
    assert!(refusal(&file(&bad, ["-Y", "+X"], Packing::Flat, SIZE, 1.0)).contains("EXPOSURE=0"));
}

#[test]
fn tristimulus_values_become_srgb() {
    // IEC 61966-2-1: D65, (0.9505, 1, 1.0890), is white.
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n".to_vec();
    bytes.extend([122, 128, 139, 129, 122, 128, 139, 129]);
    let seen = read(&bytes).0.pixel(0, 0);
    assert!(difference(seen, [1.0; 3]) < 0.03, "{seen:?}");
}

#[test]
fn other_primaries_become_srgb() {
    // Green of sRGB in the primaries of ITU-R BT.2020 is (0.3293, 0.9195, 0.0880) (ITU-R BT.2087).
    let header = format!("{PLAIN}PRIMARIES= 0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n");
    let mut bytes = format!("{header}\n-Y 1 +X 2\n").into_bytes();
    bytes.extend([84, 235, 23, 128].repeat(2));
    let seen = read(&bytes).0.pixel(0, 0);
    assert!(difference(seen, [0.0, 1.0, 0.0]) < 0.02, "{seen:?}");
}

#[test]
fn a_file_that_ends_early_is_black_at_its_end() {
    let bytes = file(PLAIN, ["-Y", "+X"], Packing::Flat, SIZE, 1.0);
    let (panorama, notices) = read(&bytes[..bytes.len() - 64 * 4 * 16 + 5]);
    assert!(notices[0].contains("ends before its picture does; 50 %"), "{notices:?}");
    assert_eq!(along(&panorama, Vec3::new(0.1, 1.0, 0.1)), [1.0; 3]);
    assert_eq!(along(&panorama, Vec3::new(0.1, -1.0, 0.1)), [0.0; 3]);
}

#[test]
fn faults_are_named() {
    let refused = |bytes: &[u8], words: &str| {
        let error = refusal(bytes);
        assert!(error.contains(words), "{error}");
    };
    refused(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 80000\n", "the file ends before its picture does");
    refused(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 400000 +X 800000000\n", "which is no panorama");
    refused(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000000 +X 2000000000\n", "GB of memory");
    refused(b"#?RADIANCE\nFORMAT=8-bit\n\n-Y 1 +X 2\n", "its format is \"8-bit\"");
    refused(b"#?RADIANCE\n\n-Y 1 +Y 2\n", "is no size such as");
    refused(b"#?RADIANCE\n\n-Y 0 +X 0\n", "is no size such as");
    refused(b"#?RADIANCE\nno end", "no end");
    let mut long = b"#?RADIANCE\n\n-Y 4 +X 8\n".to_vec();
    long.extend([2, 2, 0, 8, 128 + 100, 7]);
    refused(&long, "a scanline is longer than the picture is wide");
}
