//! The bytes of MCAP, as far as we read them.
//!
//! A file is a magic number and records, each an opcode, a length and a body; a chunk's body holds
//! records again. Every length is checked against what is there before it is believed, so a hostile
//! file costs no more memory than its own size. The layout is that of the MCAP specification,
//! version 0.

/// What a file begins with.
pub(super) const MAGIC: &[u8; 8] = b"\x89MCAP0\r\n";
/// Opcode and length of a record.
pub(super) const RECORD_HEADER: usize = 9;

/// Opcodes of the records that matter to us.
pub(super) mod opcode {
    pub(crate) const HEADER: u8 = 0x01;
    pub(crate) const FOOTER: u8 = 0x02;
    pub(crate) const SCHEMA: u8 = 0x03;
    pub(crate) const CHANNEL: u8 = 0x04;
    pub(crate) const MESSAGE: u8 = 0x05;
    pub(crate) const CHUNK: u8 = 0x06;
    pub(crate) const METADATA: u8 = 0x0c;
    pub(crate) const DATA_END: u8 = 0x0f;
}

/// Opcode and length in a record's header.
pub(super) fn record_header(bytes: [u8; RECORD_HEADER]) -> (u8, u64) {
    let [opcode, length @ ..] = bytes;
    (opcode, u64::from_le_bytes(length))
}

/// The fields of a body, one after the other; `None` where it is too short.
pub(super) struct Fields<'a>(pub(super) &'a [u8]);

impl<'a> Fields<'a> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (field, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*field)
    }

    pub(super) fn u16(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    pub(super) fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    pub(super) fn u64(&mut self) -> Option<u64> {
        self.take().map(u64::from_le_bytes)
    }

    /// As many bytes as a 64-bit length says.
    pub(super) fn long_bytes(&mut self) -> Option<&'a [u8]> {
        let length = self.u64()?;
        self.bytes(length)
    }

    fn bytes(&mut self, length: u64) -> Option<&'a [u8]> {
        let (bytes, rest) = self.0.split_at_checked(usize::try_from(length).ok()?)?;
        self.0 = rest;
        Some(bytes)
    }

    /// A text behind its 32-bit length.
    pub(super) fn text(&mut self) -> Option<&'a str> {
        let length = self.u32()?;
        std::str::from_utf8(self.bytes(u64::from(length))?).ok()
    }

    /// The value of a key in a map of texts.
    pub(super) fn map_value(&mut self, key: &str) -> Option<&'a str> {
        let length = self.u32()?;
        let mut map = Fields(self.bytes(u64::from(length))?);
        while !map.0.is_empty() {
            let (found, value) = (map.text()?, map.text()?);
            if found == key {
                return Some(value);
            }
        }
        None
    }

    /// The next record of a chunk: opcode and body.
    pub(super) fn record(&mut self) -> Option<(u8, &'a [u8])> {
        let (opcode, length) = record_header(self.take()?);
        Some((opcode, self.bytes(length)?))
    }
}
