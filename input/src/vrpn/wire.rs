//! Bytes of VRPN: cookies and messages, cut from a stream and put together.
//!
//! Both sides begin with a cookie of 24 bytes; messages follow. All numbers are big-endian:
//!
//! | at | type | meaning |
//! |---|---|---|
//! | 0 | u32 | 24 + length of the payload, without its padding |
//! | 4 | u32 | seconds since 1970, on the sender's clock |
//! | 8 | u32 | microseconds |
//! | 12 | i32 | sender, a number that the sending side has described |
//! | 16 | i32 | type, likewise; negative for the messages that describe |
//! | 20 | u32 | sequence number, of no use |
//! | 24 | | payload, padded with zeros to a multiple of 8 |
//!
//! No length of a message begins like a cookie. So a cookie is recognised wherever a message may begin, and after
//! nonsense the stream is taken up again at the next one.

use thiserror::Error;

/// Usual port of a VRPN server.
pub const PORT: u16 = 3883;
/// Length of a cookie, bytes.
pub const COOKIE_LENGTH: usize = 24;
/// Cookie of this side: version 7.38, nothing is logged.
pub const COOKIE: [u8; COOKIE_LENGTH] = *b"vrpn: ver. 07.38  0\0\0\0\0\0";
/// Length of the longest payload that is accepted, bytes: the length of VRPN's own buffers.
pub const LONGEST_PAYLOAD: usize = 64_000;
/// Length of the longest name with its NUL, bytes.
pub const LONGEST_NAME: usize = 100;

/// Type of the messages that give a sender its number.
pub const DESCRIBES_SENDER: i32 = -1;
/// Type of the messages that give a type its number.
pub const DESCRIBES_TYPE: i32 = -2;

/// Beginning of every cookie.
const MAGIC: &[u8] = b"vrpn: ver. ";
/// Version that a server must have: the part before the full stop.
const MAJOR: &[u8] = b"07.";
const HEADER_LENGTH: usize = 24;

/// Reason why the stream makes no sense.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum VrpnError {
    /// A beginning that is not VRPN's.
    #[error("the other side does not speak VRPN: it begins with {0:?}")]
    NotVrpn(String),
    /// A cookie of another major version.
    #[error("the server speaks VRPN {0:?}, this program version 07")]
    Version(String),
    /// A length that no message has.
    #[error("a message of {0} bytes; the stream is damaged")]
    Length(u32),
    /// A description without a sound name.
    #[error("a description whose name cannot be read")]
    Name,
}

/// Message of VRPN.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VrpnMessage<'a> {
    /// Time on the sender's clock, seconds since 1970.
    pub seconds: u32,
    /// Time on the sender's clock, microseconds of the second.
    pub microseconds: u32,
    /// Number of the sender; in a description, the number that is described.
    pub sender: i32,
    /// Number of the type.
    pub kind: i32,
    /// Content of the message.
    pub payload: &'a [u8],
}

impl VrpnMessage<'_> {
    /// Bytes of the message, padding included; the sequence number is zero.
    pub fn to_bytes(&self) -> Vec<u8> {
        let length = u32::try_from(HEADER_LENGTH + self.payload.len()).expect("payloads are short");
        let mut bytes = Vec::with_capacity(HEADER_LENGTH + padded(self.payload.len()));
        for word in [length, self.seconds, self.microseconds] {
            bytes.extend_from_slice(&word.to_be_bytes());
        }
        for word in [self.sender, self.kind, 0] {
            bytes.extend_from_slice(&word.to_be_bytes());
        }
        bytes.extend_from_slice(self.payload);
        bytes.resize(HEADER_LENGTH + padded(self.payload.len()), 0);
        bytes
    }

    /// Name in a description's payload: its length with the NUL, the name, the NUL.
    ///
    /// # Errors
    /// A payload of another form.
    pub fn name(&self) -> Result<&str, VrpnError> {
        let (length, text) = self.payload.split_first_chunk().ok_or(VrpnError::Name)?;
        let length = usize::try_from(u32::from_be_bytes(*length)).map_err(|_| VrpnError::Name)?;
        if length > LONGEST_NAME {
            return Err(VrpnError::Name);
        }
        let text = text.get(..length).and_then(|text| text.strip_suffix(&[0])).ok_or(VrpnError::Name)?;
        std::str::from_utf8(text).map_err(|_| VrpnError::Name)
    }
}

/// Bytes of a description: from now on, `number` means `name`.
pub fn description(kind: i32, number: i32, name: &str) -> Vec<u8> {
    let length = u32::try_from(name.len() + 1).expect("names are short");
    let payload = [&length.to_be_bytes(), name.as_bytes(), &[0]].concat();
    VrpnMessage { seconds: 0, microseconds: 0, sender: number, kind, payload: &payload }.to_bytes()
}

/// Length with its padding, bytes.
fn padded(length: usize) -> usize {
    length.next_multiple_of(8)
}

/// Piece of a stream, with its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VrpnPiece<'a> {
    /// Cookie: the other side begins, and its earlier descriptions are forgotten.
    Cookie(&'a [u8]),
    /// Message, and its bytes as they came.
    Message(VrpnMessage<'a>, &'a [u8]),
}

/// Cutter of a stream into its pieces. It holds one unfinished message at most.
#[derive(Debug, Default)]
pub struct VrpnPieces {
    partial: Vec<u8>,
    place: StreamPlace,
}

/// Place in the stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum StreamPlace {
    /// Before the cookie.
    #[default]
    Start,
    /// Place between two messages.
    Messages,
    /// In nonsense, until the next cookie.
    Lost,
}

impl VrpnPieces {
    /// Forgets the unfinished piece; the next one must be a cookie.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Takes the next bytes and calls `each` for every piece that ends in them. Nonsense is reported once, then
    /// everything up to the next cookie is passed over.
    pub fn push(&mut self, bytes: &[u8], mut each: impl FnMut(Result<VrpnPiece<'_>, VrpnError>)) {
        let mut stream = std::mem::take(&mut self.partial);
        stream.extend_from_slice(bytes);
        let mut rest = &stream[..];
        loop {
            if self.place == StreamPlace::Lost {
                rest = &rest[cookie_or_end(rest)..];
            }
            match next(rest, self.place) {
                Ok(Some((piece, length))) => {
                    self.place = StreamPlace::Messages;
                    each(Ok(piece));
                    rest = &rest[length..];
                }
                Ok(None) => break,
                Err(error) => {
                    if self.place != StreamPlace::Lost {
                        each(Err(error));
                    }
                    self.place = StreamPlace::Lost;
                    // Skip a byte that begins no piece.
                    rest = &rest[1..];
                }
            }
        }
        let used = stream.len() - rest.len();
        stream.drain(..used);
        self.partial = stream;
    }
}

/// Place of the next cookie, or of the possible beginning of one at the end.
fn cookie_or_end(bytes: &[u8]) -> usize {
    let begins = |at: &usize| {
        let here = &bytes[*at..];
        here.starts_with(MAGIC) || MAGIC.starts_with(here)
    };
    (0..bytes.len()).find(begins).unwrap_or(bytes.len())
}

/// First piece and its length, bytes; `None` if there is not enough yet.
fn next(bytes: &[u8], place: StreamPlace) -> Result<Option<(VrpnPiece<'_>, usize)>, VrpnError> {
    let known = bytes.len().min(MAGIC.len());
    let like_a_cookie = known > 0 && bytes[..known] == MAGIC[..known];
    if like_a_cookie {
        return match bytes.get(..COOKIE_LENGTH) {
            None => Ok(None),
            Some(cookie) if cookie[MAGIC.len()..].starts_with(MAJOR) => {
                Ok(Some((VrpnPiece::Cookie(cookie), COOKIE_LENGTH)))
            }
            Some(cookie) => Err(VrpnError::Version(shown(&cookie[MAGIC.len()..]))),
        };
    }
    match place {
        _ if bytes.is_empty() => Ok(None),
        StreamPlace::Messages => message(bytes),
        StreamPlace::Start | StreamPlace::Lost => Err(VrpnError::NotVrpn(shown(bytes))),
    }
}

fn message(bytes: &[u8]) -> Result<Option<(VrpnPiece<'_>, usize)>, VrpnError> {
    let Some(first) = bytes.first_chunk() else {
        return Ok(None);
    };
    // The length is checked before anything is waited for.
    let length = u32::from_be_bytes(*first);
    let payload_length = usize::try_from(length).ok().and_then(|length| length.checked_sub(HEADER_LENGTH));
    let payload_length = payload_length.filter(|&length| length <= LONGEST_PAYLOAD).ok_or(VrpnError::Length(length))?;
    let whole = HEADER_LENGTH + padded(payload_length);
    let Some(raw) = bytes.get(..whole) else {
        return Ok(None);
    };
    let mut words = [0; HEADER_LENGTH / 4];
    for (word, bytes) in words.iter_mut().zip(raw.as_chunks::<4>().0) {
        *word = u32::from_be_bytes(*bytes);
    }
    let [_, seconds, microseconds, sender, kind, _] = words;
    let payload = &raw[HEADER_LENGTH..HEADER_LENGTH + payload_length];
    let message =
        VrpnMessage { seconds, microseconds, sender: sender.cast_signed(), kind: kind.cast_signed(), payload };
    Ok(Some((VrpnPiece::Message(message, raw), whole)))
}

/// Beginning of bytes that cannot be read, for an error's sentence.
fn shown(bytes: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(&bytes[..bytes.len().min(16)]).into_owned();
    text.trim_end_matches('\0').to_owned()
}

#[cfg(test)]
mod tests {
    //! Bytes captured from the stock server must be read and written exactly, however they are cut; an impossible
    //! length must not be believed, nor cost memory.
    use super::*;
    use crate::vrpn::golden;

    /// Sender, type and payload of a message, `None` for a cookie; and the bytes.
    type CutPiece = (Option<(i32, i32, Vec<u8>)>, Vec<u8>);

    fn pieces(chunks: &[&[u8]]) -> Vec<Result<CutPiece, VrpnError>> {
        let (mut cut, mut pieces) = (Vec::new(), VrpnPieces::default());
        for chunk in chunks {
            pieces.push(chunk, |piece| {
                cut.push(piece.map(|piece| match piece {
                    VrpnPiece::Cookie(raw) => (None, raw.to_vec()),
                    VrpnPiece::Message(message, raw) => {
                        (Some((message.sender, message.kind, message.payload.to_vec())), raw.to_vec())
                    }
                }));
            });
        }
        cut
    }

    #[test]
    fn our_cookie_is_that_of_the_stock_server() {
        assert_eq!(COOKIE.to_vec(), golden::bytes(golden::COOKIE));
    }

    #[test]
    fn descriptions_are_written_as_the_stock_server_writes_them() {
        for (text, kind, number, name) in
            [(golden::SENDER, DESCRIBES_SENDER, 1, "Head"), (golden::TYPE, DESCRIBES_TYPE, 4, "vrpn_Tracker Pos_Quat")]
        {
            let mut expected = golden::bytes(text);
            // Descriptions made here carry neither time nor sequence number.
            expected[4..12].fill(0);
            expected[20..24].fill(0);
            assert_eq!(description(kind, number, name), expected);
        }
    }

    #[test]
    fn a_message_survives_its_bytes() {
        let raw = golden::bytes(golden::IDENTITY);
        let stream = [&COOKIE[..], &raw].concat();
        let mut pieces = VrpnPieces::default();
        pieces.push(&stream, |piece| {
            if let VrpnPiece::Message(message, found) = piece.unwrap() {
                assert_eq!(found, raw);
                assert_eq!((message.seconds, message.microseconds), (0x6b02_7c89, 0x0009_d21f));
                let mut again = message.to_bytes();
                // Messages made here carry no sequence number.
                again[20..24].copy_from_slice(&raw[20..24]);
                assert_eq!(again, raw);
            }
        });
    }

    #[test]
    fn pieces_do_not_depend_on_the_cut() {
        let stream = golden::session();
        let whole = pieces(&[&stream]);
        assert_eq!(whole.len(), 7);
        for cut in 0..=stream.len() {
            assert_eq!(pieces(&[&stream[..cut], &stream[cut..]]), whole, "cut at {cut}");
        }
        let single: Vec<&[u8]> = stream.chunks(1).collect();
        assert_eq!(pieces(&single), whole);
    }

    #[test]
    fn names_are_read_or_refused() {
        let name = |payload: &[u8]| {
            let message = VrpnMessage { seconds: 0, microseconds: 0, sender: 0, kind: -1, payload };
            message.name().map(str::to_owned)
        };
        assert_eq!(name(b"\0\0\0\x05Head\0"), Ok("Head".to_owned()));
        let long = [&200_u32.to_be_bytes()[..], &[b'x'; 199], &[0]].concat();
        for bad in
            [&b""[..], b"\0\0\0", b"\0\0\0\0", b"\0\0\0\x06Head\0", b"\0\0\0\x04Head", b"\xff\xff\xff\xffH\0", &long]
        {
            assert_eq!(name(bad), Err(VrpnError::Name), "{bad:?}");
        }
    }

    #[test]
    fn nonsense_is_told_once_and_the_next_cookie_is_taken_up() {
        let good = golden::session();
        for nonsense in [&[0xff; 300][..], &[0; 300], &[0, 0, 0, 23], b"vrpn: ver. 06.04  0\0\0\0\0\0", b"HTTP/1.1 400"]
        {
            for before in [0, COOKIE_LENGTH] {
                let stream = [&good[..before], nonsense, &good].concat();
                let whole = pieces(&[&stream]);
                assert_eq!(whole.iter().filter(|piece| piece.is_err()).count(), 1, "{nonsense:?} after {before}");
                assert_eq!(whole[whole.len() - 7..], pieces(&[&good]));
                let single: Vec<&[u8]> = stream.chunks(1).collect();
                let again = pieces(&single);
                assert_eq!(again.len(), whole.len());
                assert_eq!(again[again.len() - 7..], pieces(&[&good]));
            }
        }
    }

    #[test]
    fn a_length_that_is_none_is_refused_before_it_costs_memory() {
        for length in [0, 23, 25 + LONGEST_PAYLOAD as u32, u32::MAX] {
            let stream = [&COOKIE[..], &length.to_be_bytes()].concat();
            assert_eq!(pieces(&[&stream])[1], Err(VrpnError::Length(length)));
        }
        let mut cut = VrpnPieces::default();
        cut.push(&COOKIE, |_| {});
        for _ in 0..1000 {
            cut.push(&[0xee; 1000], |_| {});
            assert!(cut.partial.len() < MAGIC.len());
        }
    }
}
