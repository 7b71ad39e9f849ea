//! Texts of the interface, a table a language, and the user's language.
//!
//! A table is a match over all [`Phrase`]s, so no language can lack one. A new language is a file like `german.rs`, and
//! its line in [`Language`]; the compiler then asks for its other tables, as that of devices.

mod english;
mod german;
mod language;
mod phrase;

pub use language::{Language, LanguageError};
pub use phrase::Phrase;
