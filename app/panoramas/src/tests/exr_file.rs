//! OpenEXR files for the tests, of any channels, resolutions, blocks and packing.

use exr::compression::Compression;
use exr::math::{RoundingMode, Vec2};
use exr::meta::attribute::{
    ChannelDescription, ChannelList, IntegerBounds, LevelMode, LineOrder, SampleType, Text, TileDescription,
};
use exr::meta::header::{Header, ImageAttributes, LayerAttributes};
use exr::meta::{BlockDescription, Requirements};
use half::f16;

/// Channel without lower resolution.
pub fn channel(name: &str, sample_type: SampleType) -> ChannelDescription {
    ChannelDescription { name: name.into(), sample_type, quantize_linearly: false, sampling: Vec2(1, 1) }
}

/// Channel at half the resolution, both ways.
pub fn at_half_resolution(name: &str) -> ChannelDescription {
    ChannelDescription { sampling: Vec2(2, 2), ..channel(name, SampleType::F16) }
}

/// Header of a part with lines, not packed; the display window is the data window.
pub fn part(width: u32, height: u32, channels: impl IntoIterator<Item = ChannelDescription>) -> Header {
    let size = Vec2(width as usize, height as usize);
    let mut list: Vec<_> = channels.into_iter().collect();
    list.sort_by_key(|channel| channel.name.to_string());
    Header {
        channels: ChannelList::new(list.into_iter().collect()),
        compression: Compression::Uncompressed,
        blocks: BlockDescription::ScanLines,
        line_order: LineOrder::Increasing,
        layer_size: size,
        deep: false,
        deep_data_version: None,
        chunk_count: 0,
        max_samples_per_pixel: None,
        shared_attributes: ImageAttributes::with_size(size),
        own_attributes: LayerAttributes { layer_name: Some(Text::from("part")), ..LayerAttributes::default() },
    }
}

/// Header of a part with the channels R, G, B.
pub fn rgb_part(width: u32, height: u32, sample_type: SampleType) -> Header {
    part(width, height, ["R", "G", "B"].map(|name| channel(name, sample_type)))
}

/// Header of the part in square tiles.
pub fn tiled(header: Header, side: usize) -> Header {
    let tiles = TileDescription {
        tile_size: Vec2(side, side),
        level_mode: LevelMode::Singular,
        rounding_mode: RoundingMode::Down,
    };
    Header { blocks: BlockDescription::Tiles(tiles), ..header }
}

/// File of parts; `number` gives the number of a channel at a column and row of the data window.
pub fn file(parts: &[Header], number: impl Fn(&Header, &str, usize, usize) -> f32) -> Vec<u8> {
    let parts: Vec<Header> =
        parts.iter().map(|part| part.clone().with_encoding(part.compression, part.blocks, part.line_order)).collect();
    let many = parts.len() > 1;
    let mut bytes = exr::meta::magic_number::BYTES.to_vec();
    let requirements = Requirements {
        file_format_version: 2,
        is_single_layer_and_tiled: !many && parts[0].blocks.has_tiles(),
        has_long_names: false,
        has_deep_data: false,
        has_multiple_layers: many,
    };
    requirements.write(&mut bytes).unwrap();
    Header::write_all(&parts, &mut bytes, many).unwrap();
    let mut table = bytes.len();
    bytes.resize(table + 8 * parts.iter().map(|part| part.chunk_count).sum::<usize>(), 0);
    for (index, part) in parts.iter().enumerate() {
        for block in part.blocks_increasing_y_order() {
            let place = part.get_absolute_block_pixel_coordinates(block.location).unwrap();
            let offset = bytes.len() as u64;
            bytes[table..table + 8].copy_from_slice(&offset.to_le_bytes());
            table += 8;
            if many {
                bytes.extend((index as i32).to_le_bytes());
            }
            let tile = block.location.tile_index;
            match part.blocks {
                BlockDescription::Tiles(_) => {
                    [tile.0 as i32, tile.1 as i32, 0, 0].iter().for_each(|number| bytes.extend(number.to_le_bytes()));
                }
                BlockDescription::ScanLines => {
                    bytes.extend((place.position.1 + part.own_attributes.layer_position.1).to_le_bytes());
                }
            }
            let packed = packed(part, place, &number);
            bytes.extend((packed.len() as i32).to_le_bytes());
            bytes.extend(packed);
        }
    }
    bytes
}

fn packed(part: &Header, place: IntegerBounds, number: &impl Fn(&Header, &str, usize, usize) -> f32) -> Vec<u8> {
    let mut plain = Vec::new();
    let (left, top) = (place.position.0 as usize, place.position.1 as usize);
    for y in top..top + place.size.1 {
        for channel in part.channels.list.iter().filter(|channel| y % channel.sampling.1 == 0) {
            for x in (left..left + place.size.0).step_by(channel.sampling.0) {
                let number = number(part, &channel.name.to_string(), x, y);
                match channel.sample_type {
                    SampleType::F16 => plain.extend(f16::from_f32(number).to_ne_bytes()),
                    SampleType::F32 => plain.extend(number.to_ne_bytes()),
                    SampleType::U32 => plain.extend((number as u32).to_ne_bytes()),
                }
            }
        }
    }
    if part.compression == Compression::Uncompressed {
        return plain;
    }
    // The crate sizes blocks by the bytes of a pixel at full resolution.
    let mut sized = part.clone();
    sized.channels.bytes_per_pixel = plain.len() / (place.size.0 * place.size.1);
    let packed = part.compression.compress_image_section_to_le(&sized, plain.clone(), place).unwrap();
    if packed.len() < plain.len() { packed } else { plain }
}
