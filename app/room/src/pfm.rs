//! Portable float maps: three floats for each sample.
//!
//! The file's rows run from bottom to top, as the format says and as the programs that write MPCDI warps do. The
//! returned rows run from top to bottom. A reader that turned them once more would show everything upside down.

/// Width, height, and samples row by row from the upper left.
pub(crate) struct Pfm {
    pub width: u32,
    pub height: u32,
    pub samples: Vec<[f32; 3]>,
}

/// Header of a file, and its samples as they are written.
pub(crate) struct PfmHeader<'a> {
    pub width: u32,
    pub height: u32,
    /// True if the low byte of a number comes first.
    little: bool,
    /// Bytes of the samples, the lowest row first.
    rows: &'a [u8],
}

/// Largest number of samples that is read.
const MAX_SAMPLES: u64 = 16_000_000;

/// Reads a file's header. Error texts are worded to follow the file's name.
pub(crate) fn header(bytes: &[u8]) -> Result<PfmHeader<'_>, String> {
    // Header: three words and one white space each, then floats.
    let mut rest = bytes;
    let mut word = || -> Option<&str> {
        let start = rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
        let length = rest[start..].iter().position(u8::is_ascii_whitespace)?;
        let word = &rest[start..start + length];
        rest = &rest[start + length + 1..];
        std::str::from_utf8(word).ok()
    };
    let kind = word().unwrap_or_default();
    if kind != "PF" {
        return Err(format!("it begins with {kind:?}, not with PF: it is no portable float map of three channels"));
    }
    let mut number = |what: &str| -> Result<f64, String> {
        let text = word().ok_or_else(|| format!("it ends before its {what}"))?;
        text.parse()
            .ok()
            .filter(|number: &f64| number.is_finite())
            .ok_or_else(|| format!("its {what} {text:?} is no number"))
    };
    let (width, height, scale) = (number("width")?, number("height")?, number("scale")?);
    let whole = |side: f64| side >= 1.0 && side.fract() == 0.0 && side <= 65_536.0;
    if !(whole(width) && whole(height)) || width * height > MAX_SAMPLES as f64 {
        return Err(format!("it has {width} × {height} samples; more than 0 and at most {MAX_SAMPLES} can be read"));
    }
    let (width, height) = (width as u32, height as u32);
    let needed = width as usize * height as usize * 12;
    if rest.len() < needed {
        return Err(format!(
            "it is cut short: {width} × {height} samples need {needed} bytes, and {} are there",
            rest.len()
        ));
    }

    // A negative scale means little-endian.
    Ok(PfmHeader { width, height, little: scale < 0.0, rows: &rest[..needed] })
}

impl PfmHeader<'_> {
    /// Map with all samples.
    pub fn samples(&self) -> Pfm {
        let float = |bytes: [u8; 4]| if self.little { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) };
        let sample = |bytes: &[u8; 12]| {
            let [r, g, b] = [0, 4, 8].map(|at| float([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]));
            [r, g, b]
        };
        let rows = self.rows.as_chunks::<12>().0.chunks(self.width as usize);
        Pfm { width: self.width, height: self.height, samples: rows.rev().flatten().map(sample).collect() }
    }
}
