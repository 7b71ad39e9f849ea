//! Vertices: blocks of up to 256, in them byte by byte of the vertex the differences to the vertex before.
//!
//! A block is cut into planes, one for each byte of a vertex, and a plane into groups of sixteen. A group takes as few
//! bits a byte as suit it; the largest number of these bits stands for a byte that follows behind the group. Version 1
//! may also take two or four bytes of a vertex as one number, or leave a plane out.

use crate::DecodeError;

/// Upper half of the first byte.
const MARK: u8 = 0xa0;
/// Most bytes of a block.
const BLOCK_BYTES: usize = 8192;
/// Most vertices of a block.
const BLOCK: usize = 256;
/// Bytes of a group.
const GROUP: usize = 16;
/// Bits a byte of a group, by version and by the group's two bits.
const BITS: [[[u8; 4]; 2]; 2] = [[[0, 2, 4, 8]; 2], [[0, 1, 2, 4], [1, 2, 4, 8]]];

/// Four planes of a block: bytes of each vertex in a row.
type Planes = [[u8; BLOCK]; 4];

/// Fills the bytes with vertices of a stride.
pub(super) fn decode(bytes: &[u8], stride: usize, decoded: &mut [u8]) -> Result<(), DecodeError> {
    let (&mark, rest) = bytes.split_first().ok_or(DecodeError::CutShort)?;
    let version = usize::from(mark & 0x0f);
    if mark & 0xf0 != MARK || version > 1 {
        return Err(DecodeError::Damaged("they do not begin as vertices do".to_owned()));
    }

    // Behind the blocks stand the vertex before the first one, and of version 1 the kinds of numbers.
    let kinds_length = version * stride / 4;
    let padded = (stride + kinds_length).max(if version == 0 { 32 } else { 24 });
    let blocks = rest.len().checked_sub(padded).ok_or(DecodeError::CutShort)?;
    let (mut rest, tail) = rest.split_at(blocks);
    let tail = &tail[padded - stride - kinds_length..];
    let (first, kinds) = tail.split_at(stride);
    let mut before = [0; 256];
    before[..stride].copy_from_slice(first);

    let block = (BLOCK_BYTES / stride / GROUP * GROUP).min(BLOCK);
    let mut planes = [[0; BLOCK]; 4];
    for vertices in decoded.chunks_mut(block * stride) {
        let count = vertices.len() / stride;
        let (controls, behind) = rest.split_at_checked(kinds_length).ok_or(DecodeError::CutShort)?;
        rest = behind;
        for word in 0..stride / 4 {
            let control = controls.get(word).copied().unwrap_or_default();
            for (index, plane) in planes.iter_mut().enumerate() {
                match control >> (2 * index) & 3 {
                    2 => plane.fill(0),
                    3 => plane[..count].copy_from_slice(take(&mut rest, count)?),
                    table => read_plane(&mut rest, &BITS[version][usize::from(table)], count, plane)?,
                }
            }
            let kind = kinds.get(word).copied().unwrap_or_default();
            let last = &mut before[4 * word..4 * word + 4];
            let places = vertices.chunks_exact_mut(stride).map(|vertex| &mut vertex[4 * word..4 * word + 4]);
            match kind & 3 {
                0 => sum_up(&planes, last, places, |difference, last| {
                    add(signed(difference, 0x0101_0101, 0xff), last, 0x8080_8080)
                }),
                1 => sum_up(&planes, last, places, |difference, last| {
                    add(signed(difference, 0x0001_0001, 0xffff), last, 0x8000_8000)
                }),
                2 => {
                    let turn = u32::from(kind >> 4);
                    sum_up(&planes, last, places, |difference, last| difference.rotate_right(turn) ^ last);
                }
                _ => return Err(DecodeError::Damaged("a kind of numbers in them does not exist".to_owned())),
            }
        }
    }
    if rest.is_empty() { Ok(()) } else { Err(DecodeError::Damaged("more vertices follow than are named".to_owned())) }
}

/// Turns the planes into words of four bytes, each from its difference and the word before.
fn sum_up<'a>(
    planes: &Planes,
    last: &mut [u8],
    places: impl Iterator<Item = &'a mut [u8]>,
    step: impl Fn(u32, u32) -> u32,
) {
    let [first, second, third, fourth] = planes;
    let differences = first.iter().zip(second).zip(third).zip(fourth);
    let mut word = u32::from_le_bytes([last[0], last[1], last[2], last[3]]);
    for (place, (((first, second), third), fourth)) in places.zip(differences) {
        word = step(u32::from_le_bytes([*first, *second, *third, *fourth]), word);
        place.copy_from_slice(&word.to_le_bytes());
    }
    last.copy_from_slice(&word.to_le_bytes());
}

/// Differences of which the lowest bit is the sign, for all numbers of a word: `lowest` marks their lowest bits, `ones`
/// fills one of them.
fn signed(word: u32, lowest: u32, ones: u32) -> u32 {
    let halves = word >> 1 & !(lowest.rotate_right(1));
    halves ^ (word & lowest).wrapping_mul(ones)
}

/// Sums of all numbers of two words, without carry from one to the next: `highest` marks their highest bits.
fn add(first: u32, second: u32, highest: u32) -> u32 {
    ((first & !highest) + (second & !highest)) ^ ((first ^ second) & highest)
}

/// Takes bytes from the front.
fn take<'a>(bytes: &mut &'a [u8], count: usize) -> Result<&'a [u8], DecodeError> {
    let (taken, rest) = bytes.split_at_checked(count).ok_or(DecodeError::CutShort)?;
    *bytes = rest;
    Ok(taken)
}

/// Reads a plane of `count` bytes, rounded up to whole groups.
fn read_plane(bytes: &mut &[u8], bits: &[u8; 4], count: usize, plane: &mut [u8; BLOCK]) -> Result<(), DecodeError> {
    let groups = count.div_ceil(GROUP);
    let modes = take(bytes, groups.div_ceil(4))?;
    let (places, _) = plane.as_chunks_mut::<GROUP>();
    for (group, place) in places[..groups].iter_mut().enumerate() {
        match bits[usize::from(modes[group / 4] >> (2 * (group % 4)) & 3)] {
            0 => place.fill(0),
            1 => {
                // Of single bits the lowest is the first, other than of pairs and fours.
                let packed = take(bytes, 2)?;
                let bits = u16::from_le_bytes([packed[0], packed[1]]);
                for (index, place) in place.iter_mut().enumerate() {
                    *place = if bits >> index & 1 == 1 { take(bytes, 1)?[0] } else { 0 };
                }
            }
            2 => read_group::<2>(bytes, place)?,
            4 => read_group::<4>(bytes, place)?,
            _ => place.copy_from_slice(take(bytes, GROUP)?),
        }
    }
    Ok(())
}

/// Reads a group of `WIDTH` bits a byte, the highest bits first.
fn read_group<const WIDTH: usize>(bytes: &mut &[u8], place: &mut [u8; GROUP]) -> Result<(), DecodeError> {
    let packed = take(bytes, 2 * WIDTH)?;
    let escape = (1_u8 << WIDTH) - 1;
    let per_byte = 8 / WIDTH;
    for (place, &packed) in place.chunks_exact_mut(per_byte).zip(packed) {
        for (index, place) in place.iter_mut().enumerate() {
            let value = packed >> (8 - WIDTH * (index + 1)) & escape;
            *place = if value == escape { take(bytes, 1)?[0] } else { value };
        }
    }
    Ok(())
}
