//! Tours of the program.

use crate::plan::TourPlan;
use crate::tour_error::TourError;
use crate::tour_file::parse;

/// Names and texts of the built-in tours, in the order of a menu.
pub const BUILT_IN: [(&str, &str); 5] = [
    ("searchlight", include_str!("tours/searchlight.toml")),
    ("terrell", include_str!("tours/terrell.toml")),
    ("twins", include_str!("tours/twins.toml")),
    ("bells", include_str!("tours/bells.toml")),
    ("slow-light", include_str!("tours/slow-light.toml")),
];

/// Built-in tours, each with its name.
pub fn built_in_plans() -> Vec<(&'static str, TourPlan)> {
    BUILT_IN.iter().filter_map(|(name, text)| Some((*name, parse(name, text).ok()?))).collect()
}

/// Built-in tour of this name.
///
/// # Errors
/// [`TourError::Unknown`], with the names that there are.
pub fn built_in(name: &str) -> Result<TourPlan, TourError> {
    match BUILT_IN.iter().find(|(known, _)| *known == name) {
        Some((name, text)) => parse(name, text),
        None => {
            let known = BUILT_IN.map(|(name, _)| format!("\"{name}\"")).join(", ");
            Err(TourError::Unknown { name: name.to_owned(), known })
        }
    }
}
