//! Header of a Draco file: the counts that its memory follows from, and where its metadata lie.

use crate::DecodeError;

/// Bit of the flags that announces metadata.
const METADATA: u8 = 0x80;
/// Place of the flags' second byte.
const FLAGS: usize = 10;
/// Number of bytes before the metadata.
const HEAD: usize = 11;
/// Deepest nesting of metadata that is passed over.
const DEEPEST: usize = 64;

/// Header of a Draco mesh.
pub(super) struct DracoHeader {
    /// Number of triangles.
    pub(super) faces: u64,
    /// Number of points before those on seams are doubled.
    pub(super) points: u64,
    /// Number of groups of attributes that have seams of their own.
    pub(super) seamed: u64,
    /// Place behind the metadata.
    body: usize,
}

impl DracoHeader {
    /// Reads a header.
    ///
    /// # Errors
    /// [`DecodeError`] if the bytes are no Draco mesh of a known version, or end within it.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, DecodeError> {
        let Some((&[b'D', b'R', b'A', b'C', b'O', major, minor, geometry, method, _, flags], rest)) =
            bytes.split_first_chunk::<HEAD>()
        else {
            return Err(DecodeError::Damaged("they do not begin as Draco does".to_owned()));
        };
        // Clouds of points have versions of their own.
        if geometry != 1 {
            return Err(DecodeError::Unsupported("Draco without triangles".to_owned()));
        }
        if (major, minor) != (2, 2) {
            return Err(DecodeError::Unsupported(format!("Draco of version {major}.{minor}, where 2.2 is known")));
        }
        let mut reader = Reader { bytes: rest };
        if flags & METADATA != 0 {
            reader.skip_metadata()?;
        }
        let body = bytes.len() - reader.bytes.len();
        let edgebreaker = method == 1;
        if edgebreaker {
            reader.skip(1)?;
        }
        let [first, second] = [reader.number()?, reader.number()?];
        let (points, faces) = if edgebreaker { (first, second) } else { (second, first) };
        let seamed = if edgebreaker { u64::from(reader.byte()?) } else { 0 };
        Ok(Self { faces, points, seamed, body })
    }

    /// The file without its metadata, if it has some.
    pub(super) fn without_metadata(&self, bytes: &[u8]) -> Option<Vec<u8>> {
        (self.body > HEAD).then(|| {
            let mut bare = [&bytes[..HEAD], &bytes[self.body..]].concat();
            bare[FLAGS] &= !METADATA;
            bare
        })
    }
}

/// Bytes that are still to be read.
struct Reader<'a> {
    bytes: &'a [u8],
}

impl Reader<'_> {
    fn byte(&mut self) -> Result<u8, DecodeError> {
        let (&byte, rest) = self.bytes.split_first().ok_or(DecodeError::CutShort)?;
        self.bytes = rest;
        Ok(byte)
    }

    fn skip(&mut self, count: u64) -> Result<(), DecodeError> {
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        self.bytes = self.bytes.get(count..).ok_or(DecodeError::CutShort)?;
        Ok(())
    }

    /// Number of seven bits a byte, the lowest first.
    fn number(&mut self) -> Result<u64, DecodeError> {
        let mut number = 0;
        for shift in (0..63).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Ok(number);
            }
        }
        Err(DecodeError::Damaged("a number in them has no end".to_owned()))
    }

    /// Passes over the metadata of each attribute and of the mesh.
    fn skip_metadata(&mut self) -> Result<(), DecodeError> {
        for _ in 0..self.number()? {
            self.number()?;
            self.skip_block()?;
        }
        self.skip_block()
    }

    /// Passes over a block of metadata: entries of a name and a value, then blocks within, each after its name.
    fn skip_block(&mut self) -> Result<(), DecodeError> {
        // Blocks that are still to come, on each level.
        let mut open = vec![1];
        while let Some(blocks) = open.last_mut() {
            if *blocks == 0 {
                open.pop();
                continue;
            }
            *blocks -= 1;
            if open.len() > 1 {
                let name = self.byte()?;
                self.skip(name.into())?;
            }
            for _ in 0..self.number()? {
                let name = self.byte()?;
                self.skip(name.into())?;
                let value = self.number()?;
                self.skip(value)?;
            }
            open.push(self.number()?);
            if open.len() > DEEPEST {
                return Err(DecodeError::Damaged("their metadata are nested too deeply".to_owned()));
            }
        }
        Ok(())
    }
}
