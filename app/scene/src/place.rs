//! Places of a scene that have a name, and the languages of names.

use crate::scene::Start;

/// Name of a thing in a scene, in each language of the interface.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LocalName {
    /// English name.
    pub english: String,
    /// German name.
    pub german: String,
}

impl LocalName {
    /// Name in both languages.
    pub fn new(english: impl Into<String>, german: impl Into<String>) -> Self {
        Self { english: english.into(), german: german.into() }
    }
}

/// Place to which an observer can jump.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPlace {
    /// Name, for a menu.
    pub name: LocalName,
    /// Place and first view there.
    pub start: Start,
}
