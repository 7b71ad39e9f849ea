//! Outline of a JPEG: its frame header, and its end if it is there.

use crate::DecodeError;

/// Frame header of a JPEG, and how far the file goes.
pub(super) struct JpegOutline {
    /// Width, pixels.
    pub(super) width: u32,
    /// Height, pixels.
    pub(super) height: u32,
    /// Horizontal and vertical sampling of each component.
    pub(super) sampling: Vec<[u32; 2]>,
    /// True if the picture comes as ever finer versions.
    pub(super) progressive: bool,
    /// True if the file reaches its end marker.
    pub(super) complete: bool,
    /// Number of bytes up to the end, or up to the segment that is cut.
    pub(super) sound: usize,
}

impl JpegOutline {
    /// Walks from marker to marker.
    ///
    /// # Errors
    /// [`DecodeError`] if no frame header comes before the pixels.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, DecodeError> {
        let mut place = 2;
        let mut sound = bytes.len();
        let mut outline: Option<Self> = None;
        while let Some(marker) = next_marker(bytes, &mut place) {
            match marker {
                0x01 | 0xd0..=0xd8 => {}
                0xd9 => {
                    if let Some(outline) = &mut outline {
                        outline.complete = true;
                    }
                    break;
                }
                _ => {
                    let length = match bytes.get(place..place + 2) {
                        Some(&[high, low]) => usize::from(u16::from_be_bytes([high, low])).max(2),
                        _ => 2,
                    };
                    let Some(segment) = bytes.get(place + 2..place + length) else {
                        sound = place - 2;
                        break;
                    };
                    let frame = (0xc0..=0xcf).contains(&marker) && ![0xc4, 0xc8, 0xcc].contains(&marker);
                    if frame && outline.is_none() {
                        outline = Some(Self::of_frame(marker, segment)?);
                    }
                    place += length;
                }
            }
        }
        outline.map(|outline| Self { sound, ..outline }).ok_or(DecodeError::CutShort)
    }

    fn of_frame(marker: u8, segment: &[u8]) -> Result<Self, DecodeError> {
        let &[_, height_high, height_low, width_high, width_low, count, ref components @ ..] = segment else {
            return Err(DecodeError::Damaged("its frame header is too short".to_owned()));
        };
        let sampling: Vec<[u32; 2]> = components
            .chunks_exact(3)
            .take(usize::from(count))
            .map(|component| [u32::from(component[1] >> 4), u32::from(component[1] & 15)])
            .collect();
        if ![1, 3, 4].contains(&sampling.len()) {
            let kind = format!("JPEG of {} components, where 1, 3 and 4 are known", sampling.len());
            return Err(DecodeError::Unsupported(kind));
        }
        Ok(Self {
            width: u32::from(u16::from_be_bytes([width_high, width_low])),
            height: u32::from(u16::from_be_bytes([height_high, height_low])),
            sampling,
            progressive: marker == 0xc2,
            complete: false,
            sound: 0,
        })
    }
}

/// Next marker at or after a place, which is moved behind it. Coded pixels are passed over.
fn next_marker(bytes: &[u8], place: &mut usize) -> Option<u8> {
    while let Some(&[first, second]) = bytes.get(*place..*place + 2) {
        *place += 1;
        // A zero follows where the byte belongs to coded pixels; filling bytes may precede a marker.
        if first == 0xff && second != 0 && second != 0xff {
            *place += 1;
            return Some(second);
        }
    }
    None
}
