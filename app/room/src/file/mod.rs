//! Display files: TOML in, a checked [`Display`](crate::Display) out. docs/DISPLAYS.md lists every key.
//!
//! Module `schema` has the tables as written; `viewer`, `screens`, `projectors`, `windows` and `channels` resolve
//! them. [`save()`] writes nudged corners back into the file.

mod channels;
mod names;
pub(crate) mod parse;
mod projectors;
mod save;
mod schema;
mod screens;
mod text;
mod viewer;
mod windows;

pub use parse::{parse, parse_within};
pub use save::{NudgedCorners, SaveError, save, saved};
