//! Text lines from a byte stream, and their checksum.
//!
//! A serial port delivers bytes cut anywhere, with noise in between. [`Lines`] joins them to lines of bounded length;
//! [`sealed`] and [`unseal`] add and check the checksum `*HH`: all bytes before the asterisk, combined by exclusive
//! or, as two hexadecimal digits, as in NMEA 0183.

use thiserror::Error;

/// Length of the longest line that is accepted, bytes, about twice the longest in use.
pub const LONGEST_LINE: usize = 128;

/// Reason for skipping a line.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LineError {
    /// A line without an end.
    #[error("a line longer than {LONGEST_LINE} bytes; is the baud rate right?")]
    TooLong,
    /// Bytes outside ASCII.
    #[error("a line that is not ASCII text; is the baud rate right?")]
    NotText,
    /// A line without the `*HH` that it must end in.
    #[error("no checksum `*HH` at the end of {line:?}")]
    NoChecksum {
        /// Text of the line.
        line: String,
    },
    /// A checksum that is not that of the text.
    #[error("checksum {found:02X} in {line:?}, computed {computed:02X}")]
    Checksum {
        /// Text of the line.
        line: String,
        /// Checksum in the line.
        found: u8,
        /// Checksum of the text.
        computed: u8,
    },
    /// A wrong number of fields.
    #[error("{found} fields in {line:?}, expected {expected}")]
    Fields {
        /// Text of the line.
        line: String,
        /// Number of fields in the line.
        found: usize,
        /// Number of fields that is expected.
        expected: &'static str,
    },
    /// A field that cannot be read, or cannot be right.
    #[error("{field} {text:?}: expected {expected}")]
    Field {
        /// Name of the field.
        field: &'static str,
        /// Text of the field.
        text: String,
        /// Description of a correct field.
        expected: &'static str,
    },
}

/// Assembler of lines from bytes; LF, CR or both end a line.
#[derive(Debug, Default)]
pub struct Lines {
    partial: Vec<u8>,
    skipping: bool,
}

impl Lines {
    /// Forgets the unfinished line.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Takes the next bytes and calls `each` for every line that ends in them; empty ones are passed over.
    pub fn push(&mut self, bytes: &[u8], mut each: impl FnMut(Result<&str, LineError>)) {
        for &byte in bytes {
            if byte == b'\n' || byte == b'\r' {
                if !self.skipping && !self.partial.is_empty() {
                    each(if self.partial.is_ascii() {
                        std::str::from_utf8(&self.partial).map_err(|_| LineError::NotText)
                    } else {
                        Err(LineError::NotText)
                    });
                }
                self.reset_keeping_buffer();
            } else if self.skipping {
                // The rest of a line that was too long is skipped.
            } else if self.partial.len() == LONGEST_LINE {
                self.skipping = true;
                each(Err(LineError::TooLong));
            } else {
                self.partial.push(byte);
            }
        }
    }

    fn reset_keeping_buffer(&mut self) {
        self.partial.clear();
        self.skipping = false;
    }
}

/// Exclusive or of all bytes.
fn checksum(text: &str) -> u8 {
    text.bytes().fold(0, |sum, byte| sum ^ byte)
}

/// Text with its checksum and a line feed.
pub fn sealed(text: &str) -> String {
    format!("{text}*{:02X}\n", checksum(text))
}

/// Text of a sealed line.
///
/// # Errors
/// A missing or wrong checksum.
pub fn unseal(line: &str) -> Result<&str, LineError> {
    let none = || LineError::NoChecksum { line: line.to_owned() };
    let (text, digits) = line.rsplit_once('*').ok_or_else(none)?;
    if digits.len() != 2 || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return Err(none());
    }
    let found = u8::from_str_radix(digits, 16).map_err(|_| none())?;
    let computed = checksum(text);
    if found == computed { Ok(text) } else { Err(LineError::Checksum { line: line.to_owned(), found, computed }) }
}

#[cfg(test)]
mod tests {
    //! Lines must come out the same however the bytes are cut; a flipped bit must not pass the checksum.
    use super::*;

    fn lines(chunks: &[&[u8]]) -> Vec<Result<String, LineError>> {
        let (mut assembled, mut lines) = (Vec::new(), Lines::default());
        for chunk in chunks {
            lines.push(chunk, |line| assembled.push(line.map(str::to_owned)));
        }
        assembled
    }

    #[test]
    fn the_checksum_is_that_of_nmea() {
        // The sentence that every description of NMEA 0183 quotes, without its dollar sign.
        let text = "GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,";
        assert_eq!(sealed(text), format!("{text}*47\n"));
        assert_eq!(unseal(&format!("{text}*47")), Ok(text));
    }

    #[test]
    fn every_flipped_bit_is_found() {
        let line = sealed("B1,7,123456,3,123000,1,120000,512,0");
        let line = line.trim_end();
        for index in 0..line.len() {
            for bit in 0..7 {
                let mut bytes = line.as_bytes().to_vec();
                bytes[index] ^= 1 << bit;
                let flipped = String::from_utf8(bytes).unwrap();
                // A digit of the checksum may change case only.
                if !flipped.eq_ignore_ascii_case(line) {
                    assert!(unseal(&flipped).is_err(), "{flipped}");
                }
            }
        }
    }

    #[test]
    fn a_missing_checksum_is_told_from_a_wrong_one() {
        for line in ["B1,1", "B1,1*", "B1,1*4", "B1,1*xy", "B1,1*+4", "B1,1*474"] {
            assert!(matches!(unseal(line), Err(LineError::NoChecksum { .. })), "{line}");
        }
        assert!(matches!(unseal("B1,1*00"), Err(LineError::Checksum { .. })));
    }

    #[test]
    fn lines_do_not_depend_on_the_cut() {
        let stream = b"one\r\ntwo\n\nthree\rfour";
        let whole = lines(&[stream]);
        assert_eq!(whole, ["one", "two", "three"].map(|line| Ok(line.to_owned())));
        let bytes: Vec<&[u8]> = stream.chunks(1).collect();
        assert_eq!(lines(&bytes), whole);
    }

    #[test]
    fn a_line_without_end_is_one_fault_and_bounded() {
        let mut stream = vec![b'x'; 100_000];
        stream.extend_from_slice(b"\nok\n");
        assert_eq!(lines(&[&stream]), vec![Err(LineError::TooLong), Ok("ok".to_owned())]);
        let longest = [vec![b'x'; LONGEST_LINE], b"\n".to_vec()].concat();
        assert!(lines(&[&longest])[0].is_ok());
    }

    #[test]
    fn bytes_outside_ascii_are_a_fault() {
        assert_eq!(lines(&[b"12\xff\n"]), vec![Err(LineError::NotText)]);
    }
}
