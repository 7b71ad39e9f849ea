//! Names of the tables of a file.

use super::text::DisplayText;
use crate::error::DisplayError;
use toml::Spanned;

/// Checks that names are unique and not empty.
pub(super) fn check<'a, T: 'a>(
    text: &DisplayText<'_>,
    kind: &'static str,
    tables: &'a [Spanned<T>],
    name: impl Fn(&'a T) -> &'a str,
) -> Result<(), DisplayError> {
    let mut seen = std::collections::HashSet::new();
    for table in tables {
        let name = name(table.get_ref());
        let at = || text.at(table.span().start, &format!("{kind} {name:?}"), "name");
        if name.trim().is_empty() {
            return Err(DisplayError::NotAName { at: at(), name: name.into(), reason: "it is empty" });
        }
        if !seen.insert(name) {
            return Err(DisplayError::Duplicate { at: at(), kind, name: name.into() });
        }
    }
    Ok(())
}
