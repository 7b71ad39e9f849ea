//! Kind of picture, by its first bytes: the ending of a name may lie.

use image::ImageFormat;
use std::fmt;

/// Kind of picture that can be a panorama.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PictureKind {
    /// PNG, JPEG, WebP or TIFF.
    Common(ImageFormat),
    /// Radiance's HDR.
    Radiance,
    /// OpenEXR.
    OpenExr,
}

impl PictureKind {
    /// Kind of the picture that begins with these bytes, if it is one of these.
    pub(super) fn of(bytes: &[u8]) -> Option<Self> {
        const EXR: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
        if bytes.starts_with(&EXR) {
            return Some(Self::OpenExr);
        }
        if bytes.starts_with(b"#?") {
            return Some(Self::Radiance);
        }
        match image::guess_format(bytes) {
            Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::WebP | ImageFormat::Tiff)) => {
                Some(Self::Common(format))
            }
            _ => None,
        }
    }
}

impl fmt::Display for PictureKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Common(ImageFormat::Jpeg) => "JPEG",
            Self::Common(ImageFormat::WebP) => "WebP",
            Self::Common(ImageFormat::Tiff) => "TIFF",
            Self::Common(_) => "PNG",
            Self::Radiance => "HDR (Radiance)",
            Self::OpenExr => "OpenEXR",
        })
    }
}
