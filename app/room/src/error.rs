//! Errors in displays. Each message says where the error is, what it is, and what to do.

use crate::built_in;
use crate::format::FILE_ENDINGS;
use crate::frustum::EyeBehind;
use crate::surface::flat::NotRectangle;
use std::fmt;
use std::path::PathBuf;
use thiserror::Error;

/// Place in a display's file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FilePlace {
    /// Name of the file, as the user gave it.
    pub file: String,
    /// Line number from 1, if it is known.
    pub line: Option<usize>,
    /// Table and key, such as `screen "front", key size`.
    pub key: String,
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        if self.key.is_empty() { Ok(()) } else { write!(f, ", {}", self.key) }
    }
}

/// Reason why a display cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DisplayError {
    /// A name that is neither a built-in display nor a file.
    #[error("there is no display {name:?}; name a file, or one of {}", built_in::NAMES.join(", "))]
    NoSuch {
        /// Name, as the user gave it.
        name: String,
    },
    /// A file that is no display of any format.
    #[error(
        "{}: it is no display; a display is a file ({FILE_ENDINGS}; a .toml has [[screen]], [[window]] and [[channel]]), or one of {}",
        path.display(), built_in::NAMES.join(", ")
    )]
    NoDisplay {
        /// Path of the file.
        path: PathBuf,
    },
    /// A file that cannot be read.
    #[error("{}: {reason}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Reason, as the operating system words it.
        reason: String,
    },
    /// A text that is not TOML, an unknown key, or a value of the wrong type.
    #[error("{at}: {reason}")]
    Syntax {
        /// Place of the error.
        at: Box<FilePlace>,
        /// Reason, as the parser words it.
        reason: String,
    },
    /// A value out of its range.
    #[error("{at}: {reason}")]
    Value {
        /// Place of the value.
        at: Box<FilePlace>,
        /// Reason, and what to do.
        reason: String,
    },
    /// Corners that do not form a rectangle.
    #[error("{at}: {reason}")]
    NotRectangle {
        /// Place of the screen.
        at: Box<FilePlace>,
        /// Deviation from a rectangle.
        reason: NotRectangle,
    },
    /// A name that refers to nothing.
    #[error("{at}: there is no {kind} {name:?}{}; there is {}", suggestion(name, known), listed(known))]
    Unknown {
        /// Place of the name.
        at: Box<FilePlace>,
        /// Kind of thing that was looked up: `screen`, `window`, `projector`, `eye`, `lens` or `combine`.
        kind: &'static str,
        /// Name, as written in the file.
        name: String,
        /// Known names of this kind.
        known: Vec<String>,
    },
    /// Two things of one kind with the same name.
    #[error("{at}: another {kind} is already called {name:?}; give each a name of its own")]
    Duplicate {
        /// Place of the second one.
        at: Box<FilePlace>,
        /// Kind of thing: `screen`, `window`, `projector` or `channel`.
        kind: &'static str,
        /// Name used twice.
        name: String,
    },
    /// A name that is not allowed.
    #[error("{at}: {name:?} cannot be a name: {reason}")]
    NotAName {
        /// Place of the name.
        at: Box<FilePlace>,
        /// Name, as written in the file.
        name: String,
        /// Reason why it is not allowed.
        reason: &'static str,
    },
    /// A viewport that is not inside its window.
    #[error("{at}: the viewport [{}, {}, {}, {}] is not inside window {window:?} of {} × {} pixels", viewport[0], viewport[1], viewport[2], viewport[3], size[0], size[1])]
    ViewportOutside {
        /// Place of the viewport.
        at: Box<FilePlace>,
        /// Viewport as written: x, y, width and height, pixels.
        viewport: [u32; 4],
        /// Name of the window.
        window: String,
        /// Width and height of the window, pixels.
        size: [u32; 2],
    },
    /// Two viewports on the same pixels.
    #[error(
        "{at}: the viewport overlaps that of channel {other:?}; only a left and a right channel may share pixels: the same viewport, in a window with combine"
    )]
    Overlap {
        /// Place of the second channel's viewport.
        at: Box<FilePlace>,
        /// Name of the first channel.
        other: String,
    },
    /// An eye that is behind a screen.
    #[error("{at}: screen {screen:?}, {eye} eye: {reason}")]
    Behind {
        /// Place of the channel.
        at: Box<FilePlace>,
        /// Name of the screen.
        screen: String,
        /// Name of the eye.
        eye: &'static str,
        /// Place of the eye and its distance behind the screen.
        reason: EyeBehind,
    },
    /// A file named by the display's file, or an imported file, with wrong contents.
    #[error("{}: {reason}", path.display())]
    Import {
        /// Path of the file.
        path: PathBuf,
        /// Reason, and what to do.
        reason: String,
    },
}

fn suggestion(name: &str, known: &[String]) -> String {
    nearest(name, known.iter().map(String::as_str)).map_or(String::new(), |name| format!(" (did you mean {name:?}?)"))
}

fn listed(known: &[String]) -> String {
    if known.is_empty() { "none".into() } else { known.join(", ") }
}

/// Known name that was probably meant: the one with the fewest edits, if these are at most a third of its letters.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|candidate| (edits(name, candidate), candidate))
        .filter(|(edits, candidate)| *edits <= candidate.chars().count().div_ceil(3))
        .min()
        .map(|(_, candidate)| candidate)
}

/// Levenshtein distance between two words.
fn edits(from: &str, to: &str) -> usize {
    let to: Vec<char> = to.chars().collect();
    let mut row: Vec<usize> = (0..=to.len()).collect();
    for (i, a) in from.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, b) in to.iter().enumerate() {
            let replaced = diagonal + usize::from(a != *b);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[to.len()]
}
