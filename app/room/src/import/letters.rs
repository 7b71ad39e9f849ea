//! Letters of a file of another program: UTF-8, UTF-16 behind its mark, or else Latin-1, as older programs write.

use std::borrow::Cow;

/// Text of a file, without a mark of its encoding.
pub(super) fn text(bytes: &[u8]) -> Cow<'_, str> {
    let wide = |unit: fn([u8; 2]) -> u16| -> Cow<'_, str> {
        let units: Vec<u16> = bytes[2..].as_chunks::<2>().0.iter().map(|pair| unit(*pair)).collect();
        String::from_utf16_lossy(&units).into()
    };
    match bytes {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => match std::str::from_utf8(bytes) {
            Ok(text) => text.trim_start_matches('\u{feff}').into(),
            Err(_) => bytes.iter().copied().map(char::from).collect::<String>().into(),
        },
    }
}

#[cfg(test)]
mod tests {
    //! Law: a text means the same in each encoding.

    use super::*;

    #[test]
    fn a_text_is_the_same_in_every_encoding() {
        let wall = "<a b=\"Wänd\"/>";
        let wide = |bytes: fn(u16) -> [u8; 2]| wall.encode_utf16().flat_map(bytes).collect::<Vec<u8>>();
        let latin: Vec<u8> = wall.chars().map(|letter| letter as u8).collect();
        for bytes in [
            wall.as_bytes().to_vec(),
            [b"\xef\xbb\xbf", wall.as_bytes()].concat(),
            [vec![0xff, 0xfe], wide(u16::to_le_bytes)].concat(),
            [vec![0xfe, 0xff], wide(u16::to_be_bytes)].concat(),
            latin,
        ] {
            assert_eq!(text(&bytes), wall, "{bytes:?}");
        }
    }
}
