//! PNG, JPEG, WebP and TIFF. Whole numbers are sRGB and become linear; floating-point numbers are linear. Opacity is
//! left out.

use super::error::PanoramaError;
use super::gpano;
use super::intake::{BAND_BYTES, PictureIntake};
use super::jpeg_end;
use super::shape::PanoramaShape;
use super::turn::PictureTurn;
use image::metadata::Orientation;
use image::{ColorType, ImageDecoder, ImageFormat, ImageReader, Limits};
use rayon::prelude::*;
use scene::Panorama;
use scene::mipmap::linear_from_srgb;
use std::io::Cursor;

/// Reads a picture; the result names its layout, too.
pub(super) fn read(
    bytes: &[u8],
    format: ImageFormat,
    intake: &mut PictureIntake<'_>,
) -> Result<(Panorama, &'static str), PanoramaError> {
    // Read the header; the JPEG decoder copies the file.
    let copied = if format == ImageFormat::Jpeg { bytes.len() as u64 } else { 0 };
    intake.take(copied)?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(intake.budget.left());
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(|error| intake.damaged(error))?;
    let (width, height) = decoder.dimensions();
    let turn = turn(decoder.orientation().unwrap_or(Orientation::NoTransforms));
    let part = decoder.xmp_metadata().ok().flatten().and_then(|xmp| gpano::part(&xmp, [width, height]));

    // Check the size before decoding.
    let (whole, place, shape) = match part {
        Some(part) => (part.whole, part.place, PanoramaShape::Equirectangular),
        None => ([width, height], [0, 0], intake.shape(turn.size([width, height]))?),
    };
    let pixels = u64::from(width) * u64::from(height);
    let working = match format {
        ImageFormat::Jpeg if jpeg_end::holds_coefficients(bytes) => 6 * pixels,
        ImageFormat::WebP => 4 * pixels,
        _ => 0,
    };
    let decoded = decoder.total_bytes();
    intake.take(decoded.saturating_add(working))?;
    let turn = if part.is_some() { PictureTurn::default() } else { turn };
    let mut work = intake.begin(whole, shape, turn)?;

    // Decode.
    let colour = decoder.color_type();
    let mut buffer = vec![0; decoded as usize];
    decoder.read_image(&mut buffer).map_err(|error| intake.damaged(error))?;
    let bytes_per_pixel = usize::from(colour.bytes_per_pixel());
    let bytes_per_row = width as usize * bytes_per_pixel;
    if format == ImageFormat::Jpeg && !jpeg_end::is_whole(bytes) {
        let filled = jpeg_end::filled_rows(&buffer, bytes_per_row, bytes_per_pixel);
        let share = match (100 * filled).div_ceil(height as usize) {
            0 => "a part".to_owned(),
            share => format!("about {share} %"),
        };
        intake.notices.push(format!("the file ends before its picture does: {share} of it is missing at the end"));
    }

    // Make it linear, some rows at a time.
    let linear = Linearized::new(colour).ok_or_else(|| intake.damaged(format!("its pixels are {colour:?}")))?;
    let rows = (BAND_BYTES / 12 / width as usize).max(1);
    let mut band = vec![[0.0; 3]; width as usize * rows.min(height as usize)];
    for (first, rows) in (0..).step_by(rows).zip(buffer.chunks(rows * bytes_per_row)) {
        let band = &mut band[..rows.len() / bytes_per_pixel];
        let lines = band.par_chunks_mut(width as usize).zip(rows.par_chunks(bytes_per_row));
        lines.for_each(|(line, row)| linear.fill(line, row, bytes_per_pixel));
        work.canvas.add([place[0], place[1] + first], width as usize, band);
    }
    drop(buffer);
    intake.budget.give_back(decoded.saturating_add(working) + copied);
    if let Some(part) = part {
        intake.notices.push(format!(
            "the picture covers {:.0}° × {:.0}° of the sphere, and is drawn there; the rest is black",
            part.degrees[0], part.degrees[1]
        ));
    }
    intake.finish(work)
}

/// Turn that a camera wrote into the file.
fn turn(orientation: Orientation) -> PictureTurn {
    let (transposed, mirrored, upside_down) = match orientation {
        Orientation::NoTransforms => (false, false, false),
        Orientation::FlipHorizontal => (false, true, false),
        Orientation::Rotate180 => (false, true, true),
        Orientation::FlipVertical => (false, false, true),
        Orientation::Rotate90FlipH => (true, false, false),
        Orientation::Rotate90 => (true, true, false),
        Orientation::Rotate270FlipH => (true, true, true),
        Orientation::Rotate270 => (true, false, true),
    };
    PictureTurn { transposed, mirrored, upside_down }
}

/// Way from the bytes of a pixel to linear numbers.
struct Linearized {
    colour: ColorType,
    /// Radiances of all codes; empty for floating-point numbers.
    of_code: Vec<f32>,
}

impl Linearized {
    fn new(colour: ColorType) -> Option<Self> {
        let greatest = match colour {
            ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Some(u16::from(u8::MAX)),
            ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => Some(u16::MAX),
            ColorType::Rgb32F | ColorType::Rgba32F => None,
            _ => return None,
        };
        let linear = |greatest: u16| {
            (0..=greatest).map(|code| linear_from_srgb(f32::from(code) / f32::from(greatest))).collect()
        };
        Some(Self { colour, of_code: greatest.map(linear).unwrap_or_default() })
    }

    /// Fills a line from the bytes of its row.
    fn fill(&self, line: &mut [[f32; 3]], row: &[u8], bytes_per_pixel: usize) {
        let channels = usize::from(self.colour.channel_count());
        let places = if channels < 3 { [0; 3] } else { [0, 1, 2] };
        let bytes_per_number = bytes_per_pixel / channels;
        for (pixel, bytes) in line.iter_mut().zip(row.chunks_exact(bytes_per_pixel)) {
            *pixel = places.map(|channel| match bytes[channel * bytes_per_number..][..bytes_per_number] {
                [code] => self.of_code[usize::from(code)],
                [low, high] => self.of_code[usize::from(u16::from_ne_bytes([low, high]))],
                [a, b, c, d] => f32::from_ne_bytes([a, b, c, d]),
                _ => 0.0,
            });
        }
    }
}
