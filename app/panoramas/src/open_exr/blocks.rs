//! Blocks of a part: their places in the file and in the picture, and their unpacking.

use super::part::bytes_of;
use exr::compression::Compression;
use exr::math::Vec2;
use exr::meta::attribute::{ChannelDescription, ChannelList, IntegerBounds, SampleType};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, Headers};

/// Place of a block in its part, pixels from the corner of the data window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct BlockPlace {
    /// Column and row of the first pixel.
    pub(super) corner: [usize; 2],
    /// Width and height.
    pub(super) size: [usize; 2],
}

impl BlockPlace {
    /// Number of pixels.
    pub(super) fn pixels(self) -> usize {
        self.size[0] * self.size[1]
    }
}

/// Blocks of one part of a file, at full resolution.
pub(super) struct PartBlocks<'a> {
    bytes: &'a [u8],
    table: &'a [u8],
    header: &'a Header,
    part: usize,
    many_parts: bool,
    /// Width and height of a whole block.
    pub(super) step: [usize; 2],
    /// Numbers of blocks across and down.
    pub(super) counts: [usize; 2],
}

impl<'a> PartBlocks<'a> {
    /// Blocks of a part of a file, whose headers end at `end`.
    pub(super) fn new(bytes: &'a [u8], headers: &'a Headers, many_parts: bool, end: usize, part: usize) -> Self {
        // The tables of all parts follow the headers; the blocks of the full resolution come first in each.
        let before: usize = headers[..part].iter().map(|header| header.chunk_count.saturating_mul(8)).sum();
        let table = bytes.get(end.saturating_add(before)..).unwrap_or_default();
        let header = &headers[part];
        let Vec2(width, height) = header.layer_size;
        let step = match header.blocks {
            BlockDescription::ScanLines => [width, header.compression.scan_lines_per_block()],
            BlockDescription::Tiles(tiles) => [tiles.tile_size.0, tiles.tile_size.1],
        };
        let counts = [width.div_ceil(step[0]), height.div_ceil(step[1])];
        Self { bytes, table, header, part, many_parts, step, counts }
    }

    /// True if the table of the blocks lies within the file.
    pub(super) fn table_is_whole(&self) -> bool {
        self.counts[0].saturating_mul(self.counts[1]).saturating_mul(8) <= self.table.len()
    }

    /// Place of a block.
    pub(super) fn place(&self, column: usize, row: usize) -> BlockPlace {
        let Vec2(width, height) = self.header.layer_size;
        let corner = [column * self.step[0], row * self.step[1]];
        BlockPlace { corner, size: [self.step[0].min(width - corner[0]), self.step[1].min(height - corner[1])] }
    }

    /// Unpacked numbers of a block, in the order of the file: row by row, and in each row channel by channel.
    ///
    /// # Errors
    /// A fault: the block is not there, or damaged.
    pub(super) fn unpacked(&self, column: usize, row: usize) -> Result<Vec<u8>, String> {
        let place = self.place(column, row);
        let packed = self.packed(column, row, place).ok_or("a block is missing")?;
        unpack(self.header, place, packed)
    }

    /// Packed bytes of a block, if it is where the table says and is the one that should be there.
    fn packed(&self, column: usize, row: usize, place: BlockPlace) -> Option<&'a [u8]> {
        let entry = (row * self.counts[0] + column).checked_mul(8)?;
        let offset = u64::from_le_bytes(*self.table.get(entry..)?.first_chunk()?);
        let mut rest = self.bytes.get(usize::try_from(offset).ok()?..)?;
        let mut next = || {
            let (word, after) = rest.split_first_chunk::<4>()?;
            rest = after;
            Some(i64::from(i32::from_le_bytes(*word)))
        };
        if self.many_parts && next()? != self.part as i64 {
            return None;
        }
        let expected: &[i64] = match self.header.blocks {
            BlockDescription::ScanLines => {
                &[i64::from(self.header.own_attributes.layer_position.1) + place.corner[1] as i64]
            }
            BlockDescription::Tiles(_) => &[column as i64, row as i64, 0, 0],
        };
        for number in expected {
            if next()? != *number {
                return None;
            }
        }
        let length = usize::try_from(next()?).ok()?;
        rest.get(..length)
    }
}

/// True if a channel has numbers in this row of a block, rows being counted from the data window's first.
pub(super) fn has_row(channel: &ChannelDescription, row: usize) -> bool {
    row.is_multiple_of(channel.sampling.1)
}

/// Number of bytes of an unpacked block.
fn unpacked_bytes(channels: &[ChannelDescription], place: BlockPlace) -> usize {
    let bytes = |channel: &ChannelDescription| {
        let rows = (place.corner[1]..place.corner[1] + place.size[1]).filter(|row| has_row(channel, *row)).count();
        rows * (place.size[0] / channel.sampling.0) * bytes_of(channel)
    };
    channels.iter().map(bytes).sum()
}

fn unpack(header: &Header, place: BlockPlace, packed: &[u8]) -> Result<Vec<u8>, String> {
    let channels = &header.channels.list;
    let expected = unpacked_bytes(channels, place);
    if packed.len() == expected {
        return Ok(packed.to_vec()); // bytes that packing would have made more are not packed
    }
    if header.compression == Compression::Uncompressed {
        return Err("a block has another size than its picture".into());
    }
    if matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_))
        && !dwa_is_bounded(packed, channels, place)
    {
        return Err("a block claims more numbers than it has pixels".into());
    }
    let bounds = |[x, y]: [usize; 2], [width, height]: [usize; 2]| IntegerBounds {
        position: Vec2(x as i32, y as i32),
        size: Vec2(width, height),
    };
    let decompress = |header: &Header, packed: &[u8], bounds: IntegerBounds| {
        let unpacked = header.compression.decompress_image_section_from_le(header, packed.to_vec(), bounds, false);
        unpacked.map_err(|error| error.to_string())
    };
    if channels.iter().all(|channel| channel.sampling == Vec2(1, 1)) {
        return decompress(header, packed, bounds(place.corner, place.size));
    }
    if matches!(header.compression, Compression::B44 | Compression::B44A) {
        return unpack_b44(header, place, packed, &decompress, &bounds);
    }
    // The crate takes the size of a block from the bytes of a pixel, which it counts without regard to resolution.
    let pixels = place.pixels();
    if !expected.is_multiple_of(pixels) {
        return Err("its channels have resolutions that are not supported together".into());
    }
    let mut header = header.clone();
    header.channels.bytes_per_pixel = expected / pixels;
    decompress(&header, packed, bounds(place.corner, place.size))
}

/// True if the counts at the head of a block of DWA are not above those of its pixels: the crate allocates what they
/// claim.
fn dwa_is_bounded(packed: &[u8], channels: &[ChannelDescription], place: BlockPlace) -> bool {
    // Numbers are stored by squares of eight by eight.
    let most = (place.size[0].next_multiple_of(8) * place.size[1].next_multiple_of(8) * channels.len() * 4) as u64;
    let counts = packed.as_chunks::<8>().0.iter().map(|bytes| u64::from_le_bytes(*bytes)).take(10);
    // Sizes of packed parts, the third to sixth, are checked against the bytes that are there.
    let limits = [u64::MAX, most, u64::MAX, u64::MAX, u64::MAX, u64::MAX, 2 * most, most, most, most];
    counts.zip(limits).all(|(count, limit)| count <= limit)
}

/// Unpacks a block of B44 or B44A with channels of several resolutions: these follow one another, each packed in
/// squares of four by four numbers, of 14 bytes, or of 3 if all are equal.
fn unpack_b44(
    header: &Header,
    place: BlockPlace,
    mut packed: &[u8],
    decompress: &impl Fn(&Header, &[u8], IntegerBounds) -> Result<Vec<u8>, String>,
    bounds: &impl Fn([usize; 2], [usize; 2]) -> IntegerBounds,
) -> Result<Vec<u8>, String> {
    const SHORT: &str = "a block ends early";
    const FLAT: u8 = 13 << 2;
    let rows = place.corner[1]..place.corner[1] + place.size[1];
    let mut unpacked = Vec::new();
    for channel in &header.channels.list {
        let width = place.size[0] / channel.sampling.0;
        let height = rows.clone().filter(|row| has_row(channel, *row)).count();
        if channel.sample_type != SampleType::F16 || width * height == 0 {
            let (plain, rest) = packed.split_at_checked(width * height * bytes_of(channel)).ok_or(SHORT)?;
            (packed, unpacked) = (rest, [unpacked, vec![(plain.to_vec(), width * bytes_of(channel))]].concat());
            continue;
        }
        let mut length = 0;
        for _ in 0..width.div_ceil(4) * height.div_ceil(4) {
            length += if *packed.get(length + 2).ok_or(SHORT)? >= FLAT { 3 } else { 14 };
        }
        let (own, rest) = packed.split_at_checked(length).ok_or(SHORT)?;
        let alone = ChannelDescription { sampling: Vec2(1, 1), ..channel.clone() };
        let mut one = header.clone();
        one.channels = ChannelList::new(std::iter::once(alone).collect());
        let bytes = decompress(&one, own, bounds([0, 0], [width, height]))?;
        unpacked.push((bytes, width * 2));
        packed = rest;
    }
    // Sort the rows of all channels by row.
    let mut rows_of = unpacked.iter().map(|(bytes, length)| bytes.chunks_exact((*length).max(1))).collect::<Vec<_>>();
    let mut sorted = Vec::new();
    for row in rows {
        for (channel, rows) in header.channels.list.iter().zip(&mut rows_of) {
            if has_row(channel, row) {
                sorted.extend_from_slice(rows.next().ok_or(SHORT)?);
            }
        }
    }
    Ok(sorted)
}
