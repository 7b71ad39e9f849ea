//! Loose JSON: what exporters write that is almost JSON, made into JSON.
//!
//! Numbers that are none (NaN, Infinity, `1.#INF`) become null, and numbers in another spelling (+1, .5) their value;
//! a comma before a closing bracket and comments are left out; in strings, control characters and backslashes that
//! escape nothing are escaped, and halves of a character become the sign for an unknown one.

use serde_json::Number;

/// Text in which all that [`super::loose_json`] knows is put right; one pass over it.
pub(crate) fn tightened(text: &str) -> String {
    let mut tight = String::with_capacity(text.len() + 16);
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        rest = match first {
            '"' => string(rest, &mut tight),
            '/' if rest.starts_with("//") => rest.find('\n').map_or("", |end| &rest[end..]),
            '/' if rest.starts_with("/*") => rest[2..].find("*/").map_or("", |end| &rest[end + 4..]),
            ']' | '}' => {
                // A comma before the bracket promises an item that does not come.
                let end = tight.trim_end().len();
                if tight[..end].ends_with(',') {
                    tight.truncate(end - 1);
                }
                tight.push(first);
                &rest[1..]
            }
            '[' | '{' | ',' | ':' | '/' => {
                tight.push(first);
                &rest[1..]
            }
            space if space.is_whitespace() => {
                tight.push(' ');
                &rest[space.len_utf8()..]
            }
            _ => word(rest, &mut tight),
        };
    }
    tight
}

/// Writes the word at the front as JSON; the rest behind it.
fn word<'a>(text: &'a str, tight: &mut String) -> &'a str {
    let inside = |c: char| !(c.is_whitespace() || ",:[]{}\"/".contains(c));
    let (word, rest) = text.split_at(text.find(|c| !inside(c)).unwrap_or(text.len()));
    let is_json = matches!(word, "true" | "false" | "null") || serde_json::from_str::<Number>(word).is_ok();
    match word.parse::<f64>() {
        _ if is_json => tight.push_str(word),
        Ok(number) if number.is_finite() => tight.push_str(&number.to_string()),
        _ => tight.push_str("null"),
    }
    rest
}

/// Writes the string at the front as JSON; the rest behind it.
fn string<'a>(text: &'a str, tight: &mut String) -> &'a str {
    tight.push('"');
    let mut rest = &text[1..];
    while let Some(first) = rest.chars().next() {
        let mut length = first.len_utf8();
        match first {
            '"' => {
                tight.push('"');
                return &rest[1..];
            }
            '\\' => match rest.as_bytes().get(1) {
                Some(b'"' | b'\\' | b'/' | b'b' | b'f' | b'n' | b'r' | b't') => {
                    length = 2;
                    tight.push_str(&rest[..2]);
                }
                Some(b'u') => match (unit(rest), rest.get(6..).and_then(unit)) {
                    (Some(0xd800..=0xdbff), Some(0xdc00..=0xdfff)) => {
                        length = 12;
                        tight.push_str(&rest[..12]);
                    }
                    (Some(0xd800..=0xdfff), _) => {
                        length = 6;
                        tight.push(char::REPLACEMENT_CHARACTER);
                    }
                    (Some(_), _) => {
                        length = 6;
                        tight.push_str(&rest[..6]);
                    }
                    (None, _) => tight.push_str("\\\\"),
                },
                _ => tight.push_str("\\\\"),
            },
            control if control < ' ' => tight.push_str(&format!("\\u{:04x}", u32::from(control))),
            other => tight.push(other),
        }
        rest = &rest[length..];
    }
    rest
}

/// Number of an escape `\uXXXX` at the front.
fn unit(text: &str) -> Option<u16> {
    let digits = text.strip_prefix("\\u")?.get(..4)?;
    digits.bytes().all(|digit| digit.is_ascii_hexdigit()).then(|| u16::from_str_radix(digits, 16).ok())?
}

#[cfg(test)]
mod tests {
    //! Law: JSON means the same as before, and what is almost JSON means what was meant.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use serde_json::{Value, json};

    fn read(text: &str) -> Value {
        serde_json::from_str(&tightened(text)).unwrap()
    }

    #[test]
    fn what_is_json_stays_what_it_is() {
        let text = r#" { "a": [1, -2.5e-3, true, null, "x\"\\\u00e4\ud83d\ude00, ] } // \n"], "b": {}, "": [] } "#;
        assert_eq!(read(text), serde_json::from_str::<Value>(text).unwrap());
    }

    #[test]
    fn what_is_almost_json_is_read_as_it_was_meant() {
        for (text, meant) in [
            (r#"[NaN, -Infinity, 1.#QNAN, -nan(ind), inf]"#, json!([null, null, null, null, null])),
            ("[+1, .5, 2., 1e5]", json!([1, 0.5, 2, 1e5])),
            ("{ \"a\": [1, 2,], } // end", json!({ "a": [1, 2] })),
            ("[1 /* one, */, 2]", json!([1, 2])),
            ("[\"a\tb\"]", json!(["a\tb"])),
            (r#"["a\ud800b", "C:\Users", "\u12"]"#, json!(["a\u{fffd}b", "C:\\Users", "\\u12"])),
        ] {
            assert_eq!(read(text), meant, "{text}");
        }
    }

    #[test]
    fn texts_that_end_anywhere_are_no_trouble() {
        let text = r#"{ "a\u00e4\ud83d\ude00": [NaN, "\x"], /* ä */ } // ü"#;
        let ends = (0..=text.len()).filter(|&end| text.is_char_boundary(end));
        ends.for_each(|end| drop(tightened(&text[..end])));
    }
}
