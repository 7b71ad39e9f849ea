//! Names of things in a scene, in the languages of the interface.

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
