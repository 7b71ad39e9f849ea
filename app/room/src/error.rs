//! What can be wrong with a display: each says where, what, and what to do.

use super::frustum::EyeBehind;
use super::surface::NotRectangle;
use std::fmt;
use std::path::PathBuf;
use thiserror::Error;

/// Where in a display's file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct At {
    /// The file, as it was named.
    pub file: String,
    /// Line, from 1, where it is known.
    pub line: Option<usize>,
    /// What it is about, such as `screen "front", key size`.
    pub key: String,
}

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        if self.key.is_empty() { Ok(()) } else { write!(f, ", {}", self.key) }
    }
}

/// A display that cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DisplayError {
    /// Neither built in nor a file.
    #[error("there is no display {name:?}; name a file, or one of {}", super::built_in::NAMES.join(", "))]
    NoSuch {
        /// As asked for.
        name: String,
    },
    /// A file that cannot be read.
    #[error("{}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// As the system says it.
        reason: String,
    },
    /// Not TOML, an unknown key, or a value of the wrong type.
    #[error("{at}: {reason}")]
    Syntax {
        /// Where.
        at: Box<At>,
        /// As the parser says it.
        reason: String,
    },
    /// A value that cannot be.
    #[error("{at}: {reason}")]
    Value {
        /// Where.
        at: Box<At>,
        /// What is wrong, and what to do.
        reason: String,
    },
    /// Corners that make no rectangle.
    #[error("{at}: {reason}")]
    NotRectangle {
        /// Which screen.
        at: Box<At>,
        /// In what way.
        reason: NotRectangle,
    },
    /// A name that stands for nothing.
    #[error("{at}: there is no {kind} {name:?}{}; there is {}", suggestion(name, known), listed(known))]
    Unknown {
        /// Where.
        at: Box<At>,
        /// `screen`, `window`, `projector`.
        kind: &'static str,
        /// As written.
        name: String,
        /// All.
        known: Vec<String>,
    },
    /// Two of one kind with the same name.
    #[error("{at}: another {kind} is already called {name:?}; give each a name of its own")]
    Duplicate {
        /// Where the second is.
        at: Box<At>,
        /// `screen`, `window`, `projector`, `channel`.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A name that cannot be one.
    #[error("{at}: {name:?} cannot be a name: {reason}")]
    NotAName {
        /// Where.
        at: Box<At>,
        /// As written.
        name: String,
        /// Why not.
        reason: &'static str,
    },
    /// A viewport that sticks out of its window.
    #[error("{at}: the viewport [{}, {}, {}, {}] is not inside window {window:?} of {} × {} pixels", viewport[0], viewport[1], viewport[2], viewport[3], size[0], size[1])]
    ViewportOutside {
        /// Which channel.
        at: Box<At>,
        /// As written.
        viewport: [u32; 4],
        /// The window's name.
        window: String,
        /// Its size.
        size: [u32; 2],
    },
    /// Two viewports on the same pixels.
    #[error(
        "{at}: the viewport overlaps that of channel {other:?}; only a left and a right channel may share pixels: the same viewport, in a window with combine"
    )]
    Overlap {
        /// The second channel.
        at: Box<At>,
        /// The first channel's name.
        other: String,
    },
    /// A viewer who sees a screen from behind.
    #[error("{at}: screen {screen:?}, {eye} eye: {reason}")]
    Behind {
        /// Which channel.
        at: Box<At>,
        /// The screen's name.
        screen: String,
        /// Which eye.
        eye: &'static str,
        /// By how much.
        reason: EyeBehind,
    },
    /// A file beside the display's, or an imported one, that is not what it should be.
    #[error("{}: {reason}", path.display())]
    Import {
        /// The file.
        path: PathBuf,
        /// What is wrong with it, and what to do.
        reason: String,
    },
}

fn suggestion(name: &str, known: &[String]) -> String {
    nearest(name, known.iter().map(String::as_str)).map_or(String::new(), |name| format!(" (did you mean {name:?}?)"))
}

fn listed(known: &[String]) -> String {
    if known.is_empty() { "none".into() } else { known.join(", ") }
}

/// The known name that was probably meant: the one with the fewest edits, if those are at most a third of its letters.
pub(super) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|candidate| (edits(name, candidate), candidate))
        .filter(|(edits, candidate)| *edits <= candidate.chars().count().div_ceil(3))
        .min()
        .map(|(_, candidate)| candidate)
}

/// Levenshtein's distance.
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
