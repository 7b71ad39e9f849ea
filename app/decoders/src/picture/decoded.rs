//! Decoded picture, and what is said of one of which a part is missing.

/// Pixels of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DecodedPicture {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Red, green, blue, alpha of 8 bits, sRGB as stored, rows from the top.
    pub rgba: Vec<u8>,
    /// Remark on what could not be decoded, worded to follow the name of the picture and a colon.
    pub notice: Option<String>,
}

/// Grey of the pixels that could not be decoded.
pub(super) const MISSING: u8 = 128;

/// Reason why a picture is not whole.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Flaw {
    /// End before the last pixel.
    CutShort,
    /// Bytes in the middle that no encoder writes.
    Damaged,
}

impl Flaw {
    fn words(self) -> &'static str {
        match self {
            Flaw::CutShort => "cut short",
            Flaw::Damaged => "damaged",
        }
    }

    /// Sentence on a picture whose last rows are missing.
    pub(super) fn missing_rows(self, missing: usize, height: usize) -> String {
        // A row of a thousand is named too, and never the whole picture.
        let percent = (100 * missing).div_ceil(height).min(99);
        format!("{}: the lower {percent} % are missing", self.words())
    }

    /// Sentence on a picture of which only coarse versions are there.
    pub(super) fn coarse(self) -> String {
        format!("{}: it is coarser than it was made", self.words())
    }
}

/// Spreads red, green and blue, which fill the last three quarters of the buffer, over the whole of it, opaque.
pub(super) fn spread_rgb(rgba: &mut [u8]) {
    let pixels = rgba.len() / 4;
    for pixel in 0..pixels {
        // The place that is written never passes the one that is read.
        let from = pixels + 3 * pixel;
        let [red, green, blue] = [rgba[from], rgba[from + 1], rgba[from + 2]];
        rgba[4 * pixel..4 * pixel + 4].copy_from_slice(&[red, green, blue, 255]);
    }
}
