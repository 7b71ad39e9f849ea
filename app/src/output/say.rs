//! Lines on standard output and standard error.
//!
//! A line may hold names that come from a file or a device. What a terminal would obey instead of showing is escaped
//! in it, and what is endless is cut.

use std::fmt::Display;
use std::io::{self, Write};

/// Longest line of a text, characters.
const LONGEST: usize = 2000;

/// Writes a text to standard output. A closed output is an error, not a panic.
///
/// # Errors
/// An output, terminal or pipe, that is closed.
pub fn say(text: impl Display) -> io::Result<()> {
    say_exactly(harmless(&text.to_string()))
}

/// Writes a text for other programs to standard output as it is.
///
/// # Errors
/// An output that is closed.
pub fn say_exactly(text: impl Display) -> io::Result<()> {
    writeln!(io::stdout(), "{text}")
}

/// Text without anything that a terminal obeys but line breaks and tabs, each line cut where it is endless.
fn harmless(text: &str) -> String {
    let mut harmless = String::with_capacity(text.len());
    for (number, line) in text.split('\n').enumerate() {
        if number > 0 {
            harmless.push('\n');
        }
        let mut characters = line.chars();
        for character in characters.by_ref().take(LONGEST) {
            // Marks that turn the direction of writing make a text read otherwise than it is.
            let turns =
                matches!(character, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
            if character != '\t' && (character.is_control() || turns) {
                harmless.extend(character.escape_unicode());
            } else {
                harmless.push(character);
            }
        }
        if characters.next().is_some() {
            harmless.push('…');
        }
    }
    harmless
}

/// Writes a line to standard error. Where nothing can be written (a full disk, a closed pipe), the work goes on
/// without: it matters more than its notices.
pub fn tell(line: impl Display) {
    // One write, so that lines of two programs are not mixed.
    let _ = io::stderr().write_all(format!("{}\n", harmless(&line.to_string())).as_bytes());
}

#[cfg(test)]
mod tests {
    //! Law: no name in a file can move the cursor, colour the terminal, or fill it.

    use super::*;

    #[test]
    fn a_terminal_has_nothing_to_obey() {
        assert_eq!(harmless("a\tb\nγ é 日本"), "a\tb\nγ é 日本");
        assert_eq!(harmless("\u{1b}[2J\u{7}\r\u{9b}x\u{202e}y"), "\\u{1b}[2J\\u{7}\\u{d}\\u{9b}x\\u{202e}y");
        let endless = harmless(&format!("{}\nend", "x".repeat(10_000_000)));
        assert_eq!(endless.chars().count(), LONGEST + 1 + 4);
        assert!(endless.ends_with("…\nend"));
    }
}
