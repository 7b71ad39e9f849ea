//! Law: the bytes that meshoptimizer's encoder was given come out, exactly, and after a filter to its precision; no
//! bytes make the decoder panic or allocate what they cannot hold. A wrong decoder would scatter vertices.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use super::{Filter, Mode, decode};
use crate::DecodeError;
use crate::mutations::{hex, mutations};
use regular_file::Budget;

/// Vertices of version 0.
const VERTICES_0: &str = "\
    a0050888888888000000052aaaaaaaaa000000060242424242424242ee000000040407009443e40ccb5c7bac2bfc24b37463\
    c4ff00000013eb3c9b0700b82c63ef800b9bd84843d3a0107bf4ff0000006827b3bc0700de9a56123175b9fdbe7a360d5195\
    d9ff000000e29e5a1600000000000000000000000000000000000000000000000000000000000000000900";
/// Vertices of version 1, their first word as two numbers.
const VERTICES_1_PAIRS: &str = "\
    a1ba7f550040404040202020202020202010101010101010000e2a09122105161d011a19021e150622110a29000e2a091221\
    05161d011a19021e150622110a2900ec0808ec080808ec0808ec080808ec0808ec08060522322252232225ae000000030208\
    888f8888f8888f1f1f1f0f00080808080206666f6666f6666f1717170f00060606060204444f4444f4444f0f0f0f0f000404\
    0404052abaaeab070707aa0000000000000000000000000000803f0000307500000000010000";
/// Vertices of version 1, their first word as one number, turned.
const VERTICES_1_TURNED: &str = "\
    a1687f550110000f0204c4f262e262f131fc1e0f0007010301000e2a09122105161d011a19021e150622110a29000e2a0912\
    2105161d011a19021e150622110a2900ec0808ec080808ec0808ec080808ec0808ec08060522322252232225ae0000000302\
    08888f8888f8888f1f1f1f0f00080808080206666f6666f6666f1717170f00060606060204444f4444f4444f0f0f0f0f0004\
    040404052abaaeab070707aa0000000000000000000000000000803f0000307500000000520000";
/// Triangles.
const TRIANGLES: &str = "\
    e1fe1e100e100e8e1e140e130e8e1e130e130effffff0f089fba04c701b1c6013c04007687566778a9866589689801690000";
/// Indices in any order.
const INDICES: &str = "\
    d100040c0a10020a040c0a10020a040c0a100206040c0a10020a040c0a10020a040c0a100206040c0a10020a040c0a10020a\
    040c0a1002b1091a8f03900983068a03990903820600000000";
/// Unit vectors of 8 bits.
const UNIT_8: &str = "\
    a0013ff00000fdfe91eede013ff00000fd036b26fe0002043434000000000000000000000000000000000000000000000000\
    0000000000000000007f007f7f";
/// Unit vectors of 16 bits.
const UNIT_16: &str = "\
    a00127f000004767e4013ff00000fdfe91ece0012ff00000034a46860137f00000ff6b26fc00000204343400000000000126\
    600000000000000000000000000000000000000000000000000000ff7f0000ff7fff7f";
/// Quaternions.
const QUATERNIONS: &str = "\
    a0013fc00000fb07d034013fc00000b49690260133c00000fb68330133c00000b44823013fc00000fb07c733013fc00000b4\
    96da2301324000000500000000000000000000000000000000000000000000000000000000000000ff7f";
/// Floats of 15 bits and an exponent.
const FLOATS: &str = "\
    a0010c00000090010c0000003800013c000000140c010c00000065013c00000040a70104000000013c0000000f0a013c0000\
    00d505013c00000008a80108000000013c00000083fe0000000000000000000000000000000000000000002000f3000000f2\
    00d8fff4";

/// Colours of 8 bits.
const COLOURS_8: &str = "\
    a1ff007d668000fe6a9b0084648000007d3f000000000000000000000000000000000000007f007fff00";
/// Colours of 12 bits.
const COLOURS_12: &str = "\
    a1ffff000266000005060800016a64000e1716000464000015060800000200000005030000000000000000000000000000ff\
    070000ff07ff0f0000";

fn decoded(text: &str, count: usize, stride: usize, mode: Mode, filter: Filter) -> Vec<u8> {
    decode(&hex(text), count, stride, mode, filter, &Budget::default()).unwrap()
}

fn shorts(bytes: &[u8]) -> Vec<f32> {
    bytes.chunks(2).map(|pair| f32::from(i16::from_le_bytes([pair[0], pair[1]])) / 32767.0).collect()
}

#[track_caller]
fn assert_near(found: &[f32], wanted: &[f32], tolerance: f32) {
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() <= tolerance, "{found} for {wanted}");
    }
}

#[test]
fn vertices_come_out_to_the_bit() {
    // Bytes that differ by few bits, by many, by none.
    let byte = |i: usize, k: usize| match k {
        0..3 => ((i * (k + 1)) >> 1) as u8,
        3..6 => ((i * i * 37 * (k + 1)) >> 1) as u8,
        6 => 9,
        _ => 0,
    };
    let vertices: Vec<u8> = (0..20).flat_map(|i| (0..8).map(move |k| byte(i, k))).collect();
    assert_eq!(decoded(VERTICES_0, 20, 8, Mode::Attributes, Filter::None), vertices);

    let vertex = |i: u32| {
        let first = (i as f32 * 0.25 + 1.0).to_le_bytes();
        let second = (257 * ((i * i * 7) % 40)) as u16;
        let third = (30_000 - 130 * ((i * 5) % 7)) as u16;
        let fourth = 0x0102_0304 * (i % 5);
        [&first[..], &second.to_le_bytes(), &third.to_le_bytes(), &fourth.to_le_bytes()].concat()
    };
    let vertices: Vec<u8> = (0..20).flat_map(vertex).collect();
    for text in [VERTICES_1_PAIRS, VERTICES_1_TURNED] {
        assert_eq!(decoded(text, 20, 12, Mode::Attributes, Filter::None), vertices);
    }
}

#[test]
fn indices_come_out_to_the_bit() {
    let corners = (0..9).map(|cell| cell / 3 * 4 + cell % 3);
    let mut indices: Vec<u32> = corners.flat_map(|q| [q, q + 1, q + 4, q + 1, q + 5, q + 4]).collect();
    // Far from all others, and beside the last one.
    indices.extend([300, 7, 200, 299, 7, 200, 301, 300, 7]);
    let count = indices.len();
    // A triangle may come out with another of its corners first.
    let from_least = |bytes: &[u8], stride: usize| -> Vec<[u32; 3]> {
        let index = |bytes: &[u8]| bytes.iter().rev().fold(0, |sum, &byte| sum << 8 | u32::from(byte));
        let turned = |face: &[u8]| {
            let [a, b, c] = [0, 1, 2].map(|corner| index(&face[corner * stride..][..stride]));
            [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap()
        };
        bytes.chunks(3 * stride).map(turned).collect()
    };
    let wanted: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
    for stride in [2, 4] {
        let found = decoded(TRIANGLES, count, stride, Mode::Triangles, Filter::None);
        assert_eq!(from_least(&found, stride), from_least(&wanted, 4));
        let found = decoded(INDICES, count, stride, Mode::Indices, Filter::None);
        assert_eq!(found, wanted.chunks(4).flat_map(|index| &index[..stride]).copied().collect::<Vec<_>>());
    }
}

#[test]
fn filters_give_back_what_was_rounded() {
    let unit: [[f32; 3]; 6] =
        [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [0.6, 0.8, 0.0], [-0.48, 0.6, -0.64], [0.36, -0.48, 0.8]];
    let signs = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
    let wanted: Vec<f32> = unit.iter().zip(signs).flat_map(|([x, y, z], sign)| [*x, *y, *z, sign]).collect();
    let bytes = decoded(UNIT_8, 6, 4, Mode::Attributes, Filter::Octahedral);
    let found: Vec<f32> = bytes.iter().map(|&byte| f32::from(byte as i8) / 127.0).collect();
    assert_near(&found, &wanted, 0.012);
    let bytes = decoded(UNIT_16, 6, 8, Mode::Attributes, Filter::Octahedral);
    assert_near(&shorts(&bytes), &wanted, 5e-5);

    let quaternions: [[f32; 4]; 5] = [
        [0.0, 0.0, 0.0, 1.0],
        [0.5, 0.5, 0.5, 0.5],
        [-0.5, 0.5, -0.5, 0.5],
        [0.1, 0.7, -0.1, 0.7],
        [0.8, 0.0, 0.6, 0.0],
    ];
    let bytes = decoded(QUATERNIONS, 5, 8, Mode::Attributes, Filter::Quaternion);
    for (found, wanted) in shorts(&bytes).chunks(4).zip(quaternions) {
        // A quaternion and its negative are one rotation.
        let sign = found.iter().zip(wanted).map(|(a, b)| a * b).sum::<f32>().signum();
        assert_near(&found.iter().map(|value| sign * value).collect::<Vec<_>>(), &wanted, 1.2e-4);
    }

    let bytes = decoded(FLOATS, 3, 12, Mode::Attributes, Filter::Exponential);
    let (floats, _) = bytes.as_chunks::<4>();
    let wanted = [1.0, 0.0, -2.5, 1024.0, 0.001_953_125, -3e-20, 123_456.0, -0.1, 7e18_f32];
    for (found, wanted) in floats.iter().map(|bytes| f32::from_le_bytes(*bytes)).zip(wanted) {
        assert!((found - wanted).abs() <= wanted.abs() / 16_000.0, "{found} for {wanted}");
    }
}

#[test]
fn colours_come_out_to_their_precision() {
    let wanted = [0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.2, 0.4, 0.8, 0.5, 0.9, 0.9, 0.1, 0.25];
    let bytes = decoded(COLOURS_8, 4, 4, Mode::Attributes, Filter::Colour);
    assert_near(&bytes.iter().map(|&byte| f32::from(byte) / 255.0).collect::<Vec<_>>(), &wanted, 0.006);
    let bytes = decoded(COLOURS_12, 4, 8, Mode::Attributes, Filter::Colour);
    let shorts = bytes.as_chunks::<2>().0.iter().map(|pair| f32::from(u16::from_le_bytes(*pair)) / 65535.0);
    assert_near(&shorts.collect::<Vec<_>>(), &wanted, 0.0004);
}

#[test]
fn claims_that_do_not_fit_are_refused() {
    let budget = Budget::new(1000);
    let said = |count, stride, mode, filter| {
        decode(&hex(VERTICES_0), count, stride, mode, filter, &budget).unwrap_err().to_string()
    };
    use Mode::{Attributes, Indices, Triangles};
    assert!(said(20, 6, Attributes, Filter::None).contains("6 bytes each"));
    assert!(said(20, 260, Attributes, Filter::None).contains("260 bytes each"));
    assert!(said(3, 8, Indices, Filter::None).contains("8 bytes each"));
    assert!(said(20, 4, Triangles, Filter::None).contains("20 indices make no triangles"));
    assert!(said(3, 4, Triangles, Filter::Exponential).contains("indices have none"));
    assert!(said(20, 12, Attributes, Filter::Octahedral).contains("does not go with 12 bytes"));
    assert!(said(3, 4, Triangles, Filter::None).contains("do not begin as triangles do"));
    assert!(said(4, 8, Attributes, Filter::None).contains("more vertices follow"));
    // More than the bytes can hold, and more than the budget has.
    assert!(said(1_000_000, 8, Attributes, Filter::None).contains("end too early"));
    assert!(said(1_000_000, 4, Indices, Filter::None).contains("end too early"));
    assert!(matches!(
        decode(&hex(VERTICES_0), 200, 8, Attributes, Filter::None, &budget),
        Err(DecodeError::OverBudget(_))
    ));
    assert_eq!(budget.left(), 1000, "a refusal takes nothing");
    decode(&hex(VERTICES_0), 20, 8, Attributes, Filter::None, &budget).unwrap();
    assert_eq!(budget.left(), 1000 - 160);
    // An index beyond 16 bits.
    let large = [0xd1, 0xff, 0xff, 0x3f, 0, 0, 0, 0];
    assert!(decode(&large, 1, 4, Indices, Filter::None, &Budget::default()).is_ok());
    let error = decode(&large, 1, 2, Indices, Filter::None, &Budget::default()).unwrap_err();
    assert!(error.to_string().contains("has no room in 2 bytes"), "{error}");
}

#[test]
fn mutated_data_end_in_bytes_or_a_sentence() {
    let inputs = [
        (VERTICES_0, 20, 8, Mode::Attributes, Filter::None),
        (VERTICES_1_PAIRS, 20, 12, Mode::Attributes, Filter::None),
        (VERTICES_1_TURNED, 20, 12, Mode::Attributes, Filter::Exponential),
        (TRIANGLES, 63, 2, Mode::Triangles, Filter::None),
        (INDICES, 63, 4, Mode::Indices, Filter::None),
        (UNIT_8, 6, 4, Mode::Attributes, Filter::Octahedral),
        (UNIT_16, 6, 8, Mode::Attributes, Filter::Octahedral),
        (QUATERNIONS, 5, 8, Mode::Attributes, Filter::Quaternion),
        (COLOURS_8, 4, 4, Mode::Attributes, Filter::Colour),
        (COLOURS_12, 4, 8, Mode::Attributes, Filter::Colour),
    ];
    for (text, count, stride, mode, filter) in inputs {
        for bytes in mutations(&hex(text), 500) {
            let budget = Budget::new(10_000);
            match decode(&bytes, count, stride, mode, filter, &budget) {
                Ok(decoded) => assert_eq!(decoded.len(), count * stride),
                Err(error) => assert!(!error.to_string().is_empty() && budget.left() == 10_000),
            }
        }
    }
}
