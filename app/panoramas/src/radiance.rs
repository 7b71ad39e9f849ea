//! Radiance's HDR (Ward, "Real Pixels"; `color.c`, `resolu.c`): three bytes with a common exponent a pixel.
//!
//! The header names the product of all exposures, by which the numbers are divided, and the axes in the order in which
//! the picture is stored: `-Y 512 +X 1024` is row by row from the top, each from the left. Scanlines are flat, or
//! packed in one of two ways.

use super::error::PanoramaError;
use super::intake::{BAND_BYTES, PictureIntake};
use super::primaries::{Primaries, convert, srgb_from_xyz};
use super::turn::PictureTurn;
use glam::Mat3;
use scene::Panorama;

/// Longest header that is read, bytes.
const MAX_HEADER: usize = 1 << 20;

/// Widths of scanlines that may be packed channel by channel.
const PACKED: std::ops::Range<usize> = 8..32768;

/// Header of a picture.
struct RadianceHeader {
    /// Factors from the stored numbers to radiances.
    scale: [f32; 3],
    /// Matrix to linear sRGB, if the numbers are not that already.
    matrix: Option<Mat3>,
    /// Length and number of the scanlines.
    size: [u32; 2],
    turn: PictureTurn,
}

/// Reads a picture; the result names its layout, too.
pub(super) fn read(bytes: &[u8], intake: &mut PictureIntake<'_>) -> Result<(Panorama, &'static str), PanoramaError> {
    let (header, mut rest) = header(bytes).map_err(|fault| intake.damaged(fault))?;
    let [width, height] = header.size;
    let shape = intake.shape(header.turn.size(header.size))?;
    let mut work = intake.begin(header.size, shape, header.turn)?;

    let length = width as usize;
    let rows = (BAND_BYTES / 12 / length).clamp(1, height as usize);
    let band_bytes = (length * (rows + 1) * 12) as u64;
    intake.take(band_bytes)?;
    // Values of the last bit of a mantissa, by exponent.
    let units: [f64; 256] = std::array::from_fn(|exponent| (exponent as f64 - 136.0).exp2());
    let (mut line, mut band) = (vec![[0_u8; 4]; length], Vec::with_capacity(rows * length));
    let (mut outside, mut fault, mut first) = (0, None, 0);
    while fault.is_none() && first < height as usize {
        band.clear();
        for _ in first..(first + rows).min(height as usize) {
            match scanline(&mut rest, &mut line) {
                Ok(()) => band.extend(line.iter().map(|pixel| radiance(*pixel, &units, header.scale))),
                Err(what) => {
                    fault = Some(what);
                    break;
                }
            }
        }
        if let Some(matrix) = header.matrix {
            outside += convert(matrix, &mut band);
        }
        work.canvas.add([0, first as i64], length, &mut band);
        first += band.len() / length;
    }
    intake.budget.give_back(band_bytes);
    if let Some(fault) = fault {
        if first == 0 {
            return Err(intake.damaged(fault));
        }
        let missing = 100.0 * (1.0 - first as f64 / f64::from(height));
        intake.notices.push(format!("the picture is damaged: {fault}; {missing:.0} % of it are missing, and black"));
    }
    if outside > 0 {
        intake.notices.push(format!("pixels with a colour that sRGB does not have: {outside}; the nearest is drawn"));
    }
    intake.finish(work)
}

/// Header, and the bytes after it.
fn header(bytes: &[u8]) -> Result<(RadianceHeader, &[u8]), String> {
    let mut rest = bytes;
    let mut line = || {
        let end = rest.iter().take(MAX_HEADER).position(|&byte| byte == b'\n').ok_or("its header has no end")?;
        let line = String::from_utf8_lossy(&rest[..end]).trim().to_owned();
        rest = &rest[end + 1..];
        Ok::<_, String>(line)
    };
    let (mut exposure, mut correction, mut xyz, mut primaries) = (1.0, [1.0; 3], false, None);
    loop {
        let line = line()?;
        if line.is_empty() {
            break;
        }
        let Some((key, value)) = line.split_once('=').filter(|_| !line.starts_with('#')) else {
            continue;
        };
        let number = || value.trim().parse::<f64>().ok().filter(|value| value.is_finite() && *value > 0.0);
        let numbers = || value.split_whitespace().map_while(|number| number.parse::<f64>().ok()).collect::<Vec<_>>();
        match key.trim() {
            "FORMAT" if value.trim() == "32-bit_rle_rgbe" => xyz = false,
            "FORMAT" if value.trim() == "32-bit_rle_xyze" => xyz = true,
            "FORMAT" => return Err(format!("its format is \"{}\", not rgbe or xyze", value.trim())),
            "EXPOSURE" => exposure *= number().ok_or_else(|| format!("EXPOSURE={value} is no exposure"))?,
            "COLORCORR" => {
                for (correction, number) in correction.iter_mut().zip(numbers()).filter(|(_, number)| *number > 0.0) {
                    *correction *= number;
                }
            }
            "PRIMARIES" => {
                if let Ok(numbers) = <[f64; 8]>::try_from(numbers()) {
                    let [rx, ry, gx, gy, bx, by, wx, wy] = numbers;
                    primaries = Primaries::new([[rx, ry], [gx, gy], [bx, by], [wx, wy]]);
                }
            }
            _ => {}
        }
    }
    let resolution = line()?;
    let fault = || format!("\"{resolution}\" is no size such as -Y 512 +X 1024");
    let words: Vec<&str> = resolution.split_whitespace().collect();
    let &[first, count, second, length] = words.as_slice() else {
        return Err(fault());
    };
    let turn = match (first, second) {
        ("-Y" | "+Y", "-X" | "+X") => {
            PictureTurn { transposed: false, mirrored: second == "-X", upside_down: first == "+Y" }
        }
        ("-X" | "+X", "-Y" | "+Y") => {
            PictureTurn { transposed: true, mirrored: first == "-X", upside_down: second == "+Y" }
        }
        _ => return Err(fault()),
    };
    let side = |word: &str| word.parse::<u32>().ok().filter(|side| *side > 0).ok_or_else(fault);
    let scale = correction.map(|correction| (1.0 / (exposure * correction)) as f32);
    let matrix = if xyz { Some(srgb_from_xyz()) } else { primaries.and_then(|known| known.srgb_from_picture()) };
    Ok((RadianceHeader { scale, matrix, size: [side(length)?, side(count)?], turn }, rest))
}

/// Radiance of a stored pixel.
fn radiance([red, green, blue, exponent]: [u8; 4], units: &[f64; 256], scale: [f32; 3]) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let unit = units[usize::from(exponent)];
    let [red, green, blue] = [red, green, blue].map(|mantissa| (f64::from(mantissa) * unit) as f32);
    [red * scale[0], green * scale[1], blue * scale[2]]
}

/// Reads one scanline.
fn scanline(rest: &mut &[u8], line: &mut [[u8; 4]]) -> Result<(), &'static str> {
    const END: &str = "the file ends before its picture does";
    if PACKED.contains(&line.len())
        && let Some(&[2, 2, high, low]) = rest.first_chunk::<4>()
        && high < 128
    {
        if usize::from(high) << 8 | usize::from(low) != line.len() {
            return Err("a scanline has another length than the picture");
        }
        *rest = &rest[4..];
        for channel in 0..4 {
            let mut place = 0;
            while place < line.len() {
                let (&count, after) = rest.split_first().ok_or(END)?;
                let (run, count) = if count > 128 { (true, count - 128) } else { (false, count) };
                let count = usize::from(count);
                if count == 0 || place + count > line.len() {
                    return Err("a scanline is longer than the picture is wide");
                }
                let taken = if run { 1 } else { count };
                let (values, after) = after.split_at_checked(taken).ok_or(END)?;
                for (step, pixel) in line[place..place + count].iter_mut().enumerate() {
                    pixel[channel] = values[if run { 0 } else { step }];
                }
                (place, *rest) = (place + count, after);
            }
        }
        return Ok(());
    }
    // Flat, or with runs: 1, 1, 1 and a count repeat the pixel before; counts in succession are digits to the base 256.
    let (mut place, mut shift) = (0, 0);
    while place < line.len() {
        let (pixel, after) = rest.split_first_chunk::<4>().ok_or(END)?;
        *rest = after;
        match *pixel {
            [1, 1, 1, count] if place > 0 => {
                let count = if shift < 32 { usize::from(count) << shift } else { usize::MAX };
                let end = place.checked_add(count).filter(|end| *end <= line.len());
                let end = end.ok_or("a scanline is longer than the picture is wide")?;
                let before = line[place - 1];
                line[place..end].fill(before);
                (place, shift) = (end, shift + 8);
            }
            pixel => {
                line[place] = pixel;
                (place, shift) = (place + 1, 0);
            }
        }
    }
    Ok(())
}
