//! Text of a display file: line numbers for errors, and the parser's errors as this program's.

use crate::error::{DisplayError, FilePlace, nearest};

/// Name and text of a file.
pub(super) struct DisplayText<'a> {
    pub name: &'a str,
    pub text: &'a str,
}

impl DisplayText<'_> {
    /// Place of a key in the table that begins at byte `start`. An empty key means the table itself.
    pub fn at(&self, start: usize, table: &str, key: &str) -> Box<FilePlace> {
        let from = start.min(self.text.len());
        let tail = self.text.get(from..).unwrap_or_default();
        // The table ends where the next one begins. Its own head is the first line.
        let lines = tail.lines().enumerate();
        let own = lines.take_while(|(index, line)| *index == 0 || !line.trim_start().starts_with('['));
        let offset = own
            .filter(|(_, line)| !key.is_empty() && line.split_once('=').is_some_and(|(left, _)| left.trim() == key))
            .map(|(index, _)| index)
            .next();
        let what = if key.is_empty() { table.to_owned() } else { format!("{table}, key {key}") };
        Box::new(FilePlace { file: self.name.to_owned(), line: Some(self.line(from) + offset.unwrap_or(0)), key: what })
    }

    /// Line number of a byte, counted from 1.
    fn line(&self, byte: usize) -> usize {
        1 + self.text.bytes().take(byte).filter(|byte| *byte == b'\n').count()
    }

    /// Error that the parser found, with the key that was probably meant.
    pub fn syntax(&self, error: &toml::de::Error) -> DisplayError {
        let message = error.message();
        let mut reason = message.replace('\n', " ");
        if message.starts_with("unknown field") {
            let mut words = message.split('`').skip(1).step_by(2);
            let wrong = words.next().unwrap_or_default();
            if let Some(meant) = nearest(wrong, words) {
                reason = format!("{reason}; did you mean `{meant}`?");
            }
        }
        let line = error.span().map(|span| self.line(span.start));
        let at = Box::new(FilePlace { file: self.name.to_owned(), line, key: String::new() });
        DisplayError::Syntax { at, reason }
    }
}
