//! Outline of a KTX2: its header, and where its largest picture lies.

use crate::DecodeError;

/// Number of bytes before the index of the levels.
const HEAD: usize = 80;

/// Way in which the levels of a KTX2 are packed once more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    /// Not at all.
    Plain,
    /// BasisLZ, the code of ETC1S.
    BasisLz,
    /// Zstandard.
    Zstandard,
}

/// Header of a KTX2, and its largest level.
pub(super) struct Ktx2Outline<'a> {
    /// Width, pixels.
    pub(super) width: u32,
    /// Height, pixels.
    pub(super) height: u32,
    /// Number in Vulkan's list of formats, 0 of those that are to be transcoded.
    pub(super) format: u32,
    /// Packing of the levels.
    pub(super) packing: Packing,
    /// Number of pictures of each size: layers times faces.
    pub(super) pictures: u64,
    /// Number of levels.
    pub(super) levels: u64,
    /// Colour model of the data, and the use of its first sample.
    pub(super) model: [u8; 2],
    /// Data that all levels share.
    pub(super) shared: &'a [u8],
    /// Data of the largest level.
    pub(super) level: &'a [u8],
}

impl<'a> Ktx2Outline<'a> {
    /// Width and height that the header names, pixels.
    pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
        Ok((word(bytes, 20)?, word(bytes, 24)?))
    }

    /// Reads the header.
    ///
    /// # Errors
    /// [`DecodeError`]: a part that the header names is not there, or of an unknown kind.
    pub(super) fn read(bytes: &'a [u8]) -> Result<Self, DecodeError> {
        let (width, height) = Self::size(bytes)?;
        if word(bytes, 28)? != 0 {
            return Err(DecodeError::Unsupported("KTX2 of a volume".to_owned()));
        }
        let [layers, faces, levels] = [word(bytes, 32)?, word(bytes, 36)?, word(bytes, 40)?].map(|count| count.max(1));
        let packing = match word(bytes, 44)? {
            0 => Packing::Plain,
            1 => Packing::BasisLz,
            2 => Packing::Zstandard,
            other => return Err(DecodeError::Unsupported(format!("KTX2 with supercompression {other}"))),
        };
        // The largest level stands first in the index, wherever its data are.
        let level = part(bytes, long(bytes, HEAD)?, long(bytes, HEAD + 8)?)?;
        let descriptor = part(bytes, word(bytes, 48)?.into(), word(bytes, 52)?.into())?;
        let model = [descriptor.get(12), descriptor.get(31)].map(|byte| byte.copied().unwrap_or_default());
        Ok(Self {
            width,
            height,
            format: word(bytes, 12)?,
            packing,
            pictures: u64::from(layers) * u64::from(faces),
            levels: levels.into(),
            model: [model[0], model[1] & 15],
            shared: part(bytes, long(bytes, 64)?, long(bytes, 72)?)?,
            level,
        })
    }
}

/// Number of 16 bits at a place.
pub(super) fn short(bytes: &[u8], place: usize) -> Result<u16, DecodeError> {
    Ok(u16::from_le_bytes(array(bytes, place)?))
}

/// Number of 32 bits at a place.
pub(super) fn word(bytes: &[u8], place: usize) -> Result<u32, DecodeError> {
    Ok(u32::from_le_bytes(array(bytes, place)?))
}

fn long(bytes: &[u8], place: usize) -> Result<u64, DecodeError> {
    Ok(u64::from_le_bytes(array(bytes, place)?))
}

fn array<const N: usize>(bytes: &[u8], place: usize) -> Result<[u8; N], DecodeError> {
    bytes.get(place..).and_then(<[u8]>::first_chunk).copied().ok_or(DecodeError::CutShort)
}

/// Bytes from a place on.
pub(super) fn part(bytes: &[u8], place: u64, length: u64) -> Result<&[u8], DecodeError> {
    let end = usize::try_from(place.saturating_add(length)).unwrap_or(usize::MAX);
    bytes.get(usize::try_from(place).unwrap_or(usize::MAX)..end).ok_or(DecodeError::CutShort)
}
