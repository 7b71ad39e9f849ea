//! Codecs of films, and what ffmpeg is told of each.

use std::path::Path;

/// FilmCodec of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "lower")]
pub enum FilmCodec {
    /// H.264: plays everywhere.
    H264,
    /// H.265 (HEVC): half the size, on newer players; the one for high dynamic range.
    H265,
    /// AV1: smaller still, slower to write.
    Av1,
    /// ProRes 422 HQ, for editing; large. In .mov files.
    Prores,
    /// FFV1: without any loss, for archives; very large. In .mkv files.
    Ffv1,
}

/// Signal of a film of a high dynamic range (ITU-R BT.2100).
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "lower")]
pub enum HdrCurve {
    /// Perceptual quantiser, as of HDR10: luminances up to 10,000 cd/m².
    Pq,
    /// Hybrid log-gamma, which usual screens show, too.
    Hlg,
}

impl FilmCodec {
    /// True if it can hold more than 8 bits a colour in a form that players know.
    pub fn is_deep(self) -> bool {
        self != Self::H264
    }

    /// FilmCodec of a film that is not told its codec, by the ending of its name.
    pub fn usual(path: &Path) -> Self {
        match ending(path).as_deref() {
            Some("mov") => Self::Prores,
            _ => Self::H264,
        }
    }

    /// True if a film of this name can hold the codec's pictures.
    pub fn fits(self, path: &Path) -> bool {
        let ending = ending(path);
        let one_of = |endings: &[&str]| ending.as_deref().is_some_and(|ending| endings.contains(&ending));
        match self {
            Self::H264 | Self::H265 => one_of(&["mp4", "mov", "mkv"]),
            Self::Av1 => one_of(&["mp4", "mkv"]),
            Self::Prores => one_of(&["mov", "mkv"]),
            Self::Ffv1 => one_of(&["mkv"]),
        }
    }

    /// Endings of films that can hold it, for messages.
    pub fn endings(self) -> &'static str {
        match self {
            Self::H264 | Self::H265 => ".mp4, .mov or .mkv",
            Self::Av1 => ".mp4 or .mkv",
            Self::Prores => ".mov or .mkv",
            Self::Ffv1 => ".mkv",
        }
    }

    /// Arguments of ffmpeg: the encoder, its quality, and the form of its pixels.
    pub(crate) fn arguments(self, high_dynamic_range: bool) -> Vec<&'static str> {
        let ten_bits = high_dynamic_range;
        match self {
            Self::H264 => {
                let pixels = if ten_bits { "yuv420p10le" } else { "yuv420p" };
                vec!["-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-pix_fmt", pixels]
            }
            Self::H265 => {
                let pixels = if ten_bits { "yuv420p10le" } else { "yuv420p" };
                let quiet = "log-level=error:hdr-opt=1:repeat-headers=1";
                let quiet = if ten_bits { quiet } else { "log-level=error" };
                let made = ["-c:v", "libx265", "-preset", "fast", "-crf", "20", "-pix_fmt", pixels, "-tag:v", "hvc1"];
                [made.as_slice(), &["-x265-params", quiet]].concat()
            }
            Self::Av1 => {
                let pixels = if ten_bits { "yuv420p10le" } else { "yuv420p" };
                vec!["-c:v", "libsvtav1", "-preset", "8", "-crf", "28", "-pix_fmt", pixels]
            }
            Self::Prores => vec!["-c:v", "prores_ks", "-profile:v", "hq", "-pix_fmt", "yuv422p10le"],
            // Lossless in RGB; each picture stands alone.
            Self::Ffv1 => {
                let pixels = if ten_bits { "gbrp16le" } else { "bgr0" };
                vec!["-c:v", "ffv1", "-level", "3", "-g", "1", "-slices", "16", "-pix_fmt", pixels]
            }
        }
    }

    /// True if the codec keeps red, green and blue as they are.
    pub(crate) fn keeps_rgb(self) -> bool {
        self == Self::Ffv1
    }
}

/// True if a film of this name begins with an index, which can say how it is projected.
pub fn is_indexed(path: &Path) -> bool {
    matches!(ending(path).as_deref(), Some("mp4" | "mov"))
}

/// Ending of a file's name in lower case.
fn ending(path: &Path) -> Option<String> {
    path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase())
}
