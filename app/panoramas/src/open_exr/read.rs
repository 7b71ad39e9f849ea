//! Reading of an OpenEXR file, a band of blocks at a time.

use super::super::cube::OPEN_EXR_CUBE;
use super::super::error::PanoramaError;
use super::super::intake::{BAND_BYTES, PictureIntake};
use super::super::primaries::{Primaries, convert};
use super::super::shape::PanoramaShape;
use super::super::turn::PictureTurn;
use super::blocks::{PartBlocks, has_row};
use super::part::{ColourChannels, bytes_of, check_resolutions, drawn_part};
use exr::compression::Compression;
use exr::meta::MetaData;
use exr::meta::attribute::{ChannelDescription, EnvironmentMap, SampleType};
use exr::meta::header::Header;
use half::f16;
use rayon::prelude::*;
use scene::Panorama;
use std::io::Cursor;

/// Largest side of a picture, pixels.
const MAX_SIDE: usize = 1 << 20;

/// Numbers of one channel in a band of rows.
struct ChannelPlane<'a> {
    channel: &'a ChannelDescription,
    /// Index of the channel in its part.
    index: usize,
    width: usize,
    numbers: Vec<f32>,
}

/// Reads a picture; the result names its layout, too.
pub(crate) fn read(bytes: &[u8], intake: &mut PictureIntake<'_>) -> Result<(Panorama, &'static str), PanoramaError> {
    // Read the headers, and choose a part.
    let mut cursor = Cursor::new(bytes);
    let meta = MetaData::read_from_buffered(&mut cursor, false).map_err(|error| intake.damaged(error))?;
    let drawn = drawn_part(&meta).map_err(|fault| intake.damaged(fault))?;
    let header = &meta.headers[drawn.index];
    let many_parts = meta.requirements.has_multiple_layers;
    check_resolutions(header).map_err(|fault| intake.damaged(fault))?;
    if matches!(header.compression, Compression::HTJ2K32 | Compression::HTJ2K256) {
        return Err(intake.damaged(format!("its {} is not supported", header.compression)));
    }
    intake.notices.extend(drawn.notice);

    // Find the place of the data in the picture.
    let data = header.data_window();
    let (shape, whole, place) = window(header, intake)?;
    if data.size.0.max(data.size.1) > MAX_SIDE {
        return Err(intake.damaged(format!("it has {} × {} pixels", data.size.0, data.size.1)));
    }
    let mut work = intake.begin(whole, shape, PictureTurn::default())?;

    // Read bands of whole rows of blocks. Rows with numbers of all channels begin a band.
    let blocks = PartBlocks::new(bytes, &meta.headers, many_parts, cursor.position() as usize, drawn.index);
    if !blocks.table_is_whole() {
        return Err(intake.damaged("the file ends in its table of blocks"));
    }
    let channels: Vec<_> = drawn.channels.indices().iter().map(|&index| &header.channels.list[index]).collect();
    let down = channels.iter().map(|channel| channel.sampling.1).max().unwrap_or(1);
    let bytes_per_pixel = header.channels.bytes_per_pixel + 24;
    let block_row = data.size.0.saturating_mul(blocks.step[1].min(data.size.1)).saturating_mul(bytes_per_pixel);
    let rows_of_blocks = (BAND_BYTES / block_row.max(1)).clamp(1, 256).next_multiple_of(down);
    let band_bytes = block_row.saturating_mul(rows_of_blocks.min(blocks.counts[1])) as u64;
    intake.take(band_bytes)?;
    let colours = PictureColours::new(header, drawn.channels, intake);
    let (mut outside, mut missing, mut fault) = (0, 0, None);
    for first in (0..blocks.counts[1]).step_by(rows_of_blocks) {
        let last = (first + rows_of_blocks).min(blocks.counts[1]);
        let places: Vec<_> =
            (first..last).flat_map(|row| (0..blocks.counts[0]).map(move |column| [column, row])).collect();
        let unpacked: Vec<_> = places.par_iter().map(|[column, row]| blocks.unpacked(*column, *row)).collect();
        if unpacked.iter().all(Result::is_err) {
            missing += places.iter().map(|[column, row]| blocks.place(*column, *row).pixels()).sum::<usize>();
            fault = fault.or_else(|| unpacked.into_iter().find_map(Result::err));
            continue;
        }
        let top = first * blocks.step[1];
        let height = (last * blocks.step[1]).min(data.size.1) - top;
        let mut planes: Vec<_> = drawn
            .channels
            .indices()
            .iter()
            .map(|&index| {
                let channel = &header.channels.list[index];
                let width = data.size.0 / channel.sampling.0;
                ChannelPlane { channel, index, width, numbers: vec![0.0; width * height.div_ceil(channel.sampling.1)] }
            })
            .collect();
        for ([column, row], unpacked) in places.into_iter().zip(unpacked) {
            let place = blocks.place(column, row);
            match unpacked {
                Ok(bytes) => spread(header, &bytes, place.corner, place.size, top, &mut planes),
                Err(what) => {
                    missing += place.pixels();
                    fault.get_or_insert(what);
                }
            }
        }
        let mut band = vec![[0.0; 3]; data.size.0 * height];
        let lines = band.par_chunks_exact_mut(data.size.0).enumerate();
        outside += lines.map(|(row, line)| colours.fill(line, row, &planes)).sum::<usize>();
        work.canvas.add([place[0], place[1] + top as i64], data.size.0, &mut band);
    }
    intake.budget.give_back(band_bytes);
    if let Some(fault) = fault {
        let share = missing as f64 / (data.size.0 * data.size.1) as f64;
        if share >= 1.0 {
            return Err(intake.damaged(fault));
        }
        let share = (100.0 * share).ceil();
        intake.notices.push(format!("the picture is damaged: {fault}; {share} % of it are missing, and black"));
    }
    if outside > 0 {
        intake.notices.push(format!("pixels with a colour that sRGB does not have: {outside}; the nearest is drawn"));
    }
    intake.finish(work)
}

/// Layout, size of the picture, and the place of the data window's corner in it.
fn window(
    header: &Header,
    intake: &mut PictureIntake<'_>,
) -> Result<(PanoramaShape, [u32; 2], [i64; 2]), PanoramaError> {
    let (data, display) = (header.data_window(), header.shared_attributes.display_window);
    let size = |bounds: exr::meta::attribute::IntegerBounds| [bounds.size.0 as u32, bounds.size.1 as u32];
    let [width, height] = size(data);
    if header.own_attributes.environment_map == Some(EnvironmentMap::Cube) {
        // The faces fill the data window (ImfEnvmap.h).
        return if width > 0 && u64::from(height) == 6 * u64::from(width) {
            Ok((PanoramaShape::Cube(&OPEN_EXR_CUBE), [width, height], [0, 0]))
        } else {
            Err(PanoramaError::Shape { path: intake.path.into(), width, height })
        };
    }
    if header.own_attributes.environment_map == Some(EnvironmentMap::LatitudeLongitude)
        && let Some(shape @ PanoramaShape::Equirectangular) = PanoramaShape::of([width, height])
    {
        return Ok((shape, [width, height], [0, 0]));
    }
    let Some(shape) = PanoramaShape::of(size(display)) else {
        // A display window of another shape belongs to another camera.
        let shown = size(display);
        return match PanoramaShape::of([width, height]) {
            Some(shape) => Ok((shape, [width, height], [0, 0])),
            None => Err(PanoramaError::Shape { path: intake.path.into(), width: shown[0], height: shown[1] }),
        };
    };
    let place = [data.position.0 - display.position.0, data.position.1 - display.position.1].map(i64::from);
    let end = [place[0] + i64::from(width), place[1] + i64::from(height)];
    let [columns, rows] = size(display);
    if place[0] > 0 || place[1] > 0 || end[0] < i64::from(columns) || end[1] < i64::from(rows) {
        intake.notices.push(format!(
            "the file holds {width} × {height} of the {columns} × {rows} pixels of the panorama; the rest is black"
        ));
    }
    Ok((shape, [columns, rows], place))
}

/// Spreads the numbers of an unpacked block over the planes of the channels that are drawn.
fn spread(
    header: &Header,
    mut bytes: &[u8],
    corner: [usize; 2],
    size: [usize; 2],
    top: usize,
    planes: &mut [ChannelPlane<'_>],
) {
    for row in corner[1]..corner[1] + size[1] {
        for (index, channel) in header.channels.list.iter().enumerate().filter(|(_, channel)| has_row(channel, row)) {
            let count = size[0] / channel.sampling.0;
            let (numbers, rest) = bytes.split_at((count * bytes_of(channel)).min(bytes.len()));
            bytes = rest;
            for plane in planes.iter_mut().filter(|plane| plane.index == index) {
                let from = (row - top) / channel.sampling.1 * plane.width + corner[0] / channel.sampling.0;
                let target = &mut plane.numbers[from..from + count];
                match channel.sample_type {
                    SampleType::F16 => fill(target, numbers, |bytes| f16::from_ne_bytes(bytes).to_f32()),
                    SampleType::F32 => fill(target, numbers, f32::from_ne_bytes),
                    SampleType::U32 => fill(target, numbers, |bytes| u32::from_ne_bytes(bytes) as f32),
                }
            }
        }
    }
}

fn fill<const N: usize>(target: &mut [f32], bytes: &[u8], number: impl Fn([u8; N]) -> f32) {
    for (target, bytes) in target.iter_mut().zip(bytes.as_chunks::<N>().0) {
        *target = number(*bytes);
    }
}

/// Way from a picture's channels to linear sRGB.
struct PictureColours {
    channels: ColourChannels,
    matrix: Option<glam::Mat3>,
    luminances: [f32; 3],
}

impl PictureColours {
    fn new(header: &Header, channels: ColourChannels, intake: &mut PictureIntake<'_>) -> Self {
        let primaries = header.shared_attributes.chromaticities.map(|known| {
            let points = [known.red, known.green, known.blue, known.white];
            Primaries::new(points.map(|point| [point.0, point.1].map(f64::from)))
        });
        if matches!(primaries, Some(None)) {
            intake.notices.push("the chromaticities of the picture are no colours; those of sRGB are taken".into());
        }
        let primaries = primaries.flatten().unwrap_or_else(Primaries::srgb);
        let grey = matches!(channels, ColourChannels::Grey(_));
        let matrix = if grey { None } else { primaries.srgb_from_picture() };
        Self { channels, matrix, luminances: primaries.luminances() }
    }

    /// Fills a row of a band from the planes; the result counts the colours outside of sRGB.
    fn fill(&self, line: &mut [[f32; 3]], row: usize, planes: &[ChannelPlane<'_>]) -> usize {
        let rows: Vec<_> = planes
            .iter()
            .map(|plane| {
                let row = &plane.numbers[row / plane.channel.sampling.1 * plane.width..][..plane.width];
                move |column: usize| row[(column / plane.channel.sampling.0).min(plane.width - 1)]
            })
            .collect();
        for (column, pixel) in line.iter_mut().enumerate() {
            *pixel = match (&self.channels, rows.as_slice()) {
                (ColourChannels::LuminanceChroma(_), [luminance, red, blue]) => {
                    let luminance = luminance(column);
                    let (red, blue) = ((red(column) + 1.0) * luminance, (blue(column) + 1.0) * luminance);
                    let [of_red, of_green, of_blue] = self.luminances;
                    [red, (luminance - red * of_red - blue * of_blue) / of_green, blue]
                }
                (_, [red, green, blue]) => [red(column), green(column), blue(column)],
                (_, rows) => [rows.first().map_or(0.0, |grey| grey(column)); 3],
            };
        }
        self.matrix.map_or(0, |matrix| convert(matrix, line))
    }
}
