//! Unit of the lengths that a tracker sends.

use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Names of units, and their lengths in metres.
const NAMES: [(&str, f64); 5] = [("m", 1.0), ("cm", 0.01), ("mm", 0.001), ("ft", 0.3048), ("in", 0.0254)];
/// Lengths that a unit can have, metres.
const LENGTHS_M: std::ops::RangeInclusive<f64> = 1e-6..=1e6;
/// Distances of a head from a tracker's origin that are usual, metres.
const USUAL_M: std::ops::RangeInclusive<f64> = 0.3..=50.0;

/// Length of a tracker's unit: a number of metres, or a name such as `"mm"`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "UnitText", into = "UnitText")]
pub struct LengthUnit {
    metres: f64,
}

/// Unit as it is written.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number of metres, or \"m\", \"cm\", \"mm\", \"ft\" or \"in\"")]
enum UnitText {
    Number(f64),
    Name(String),
}

/// Text or number that is no unit.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "scale is {0}: expected the length of the tracker's unit, \"m\", \"cm\", \"mm\", \"ft\", \"in\" or a number of metres from 1e-6 to 1e6"
)]
pub struct LengthUnitError(String);

impl LengthUnit {
    /// Unit of this length, metres.
    ///
    /// # Errors
    /// A length that no unit has.
    pub fn new(metres: f64) -> Result<Self, LengthUnitError> {
        if LENGTHS_M.contains(&metres) { Ok(Self { metres }) } else { Err(LengthUnitError(metres.to_string())) }
    }

    /// Unit of this name.
    ///
    /// # Errors
    /// A name of no unit.
    pub fn named(name: &str) -> Result<Self, LengthUnitError> {
        let found = NAMES.iter().find(|(known, _)| *known == name);
        found.map(|(_, metres)| Self { metres: *metres }).ok_or_else(|| LengthUnitError(format!("{name:?}")))
    }

    /// Length, metres.
    pub fn metres(self) -> f64 {
        self.metres
    }

    /// Smaller unit of which a head can be `distance` from the origin, if there is one.
    pub(super) fn of_head(distance: f64) -> Option<Self> {
        ["mm", "cm"]
            .iter()
            .filter_map(|name| Self::named(name).ok())
            .find(|unit| USUAL_M.contains(&(distance * unit.metres)))
    }

    /// Name of several, as in "millimetres".
    pub(super) fn plural(self) -> String {
        match self.to_string().as_str() {
            "m" => "metres".to_owned(),
            "cm" => "centimetres".to_owned(),
            "mm" => "millimetres".to_owned(),
            "ft" => "feet".to_owned(),
            "in" => "inches".to_owned(),
            number => format!("units of {number} m"),
        }
    }
}

impl fmt::Display for LengthUnit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match NAMES.iter().find(|(_, metres)| *metres == self.metres) {
            Some((name, _)) => formatter.write_str(name),
            None => write!(formatter, "{}", self.metres),
        }
    }
}

impl TryFrom<UnitText> for LengthUnit {
    type Error = LengthUnitError;

    fn try_from(text: UnitText) -> Result<Self, LengthUnitError> {
        match text {
            UnitText::Number(metres) => Self::new(metres),
            UnitText::Name(name) => Self::named(&name),
        }
    }
}

impl From<LengthUnit> for UnitText {
    fn from(unit: LengthUnit) -> Self {
        Self::Number(unit.metres)
    }
}

#[cfg(test)]
mod tests {
    //! Law: a unit keeps its length through a recording, and a reading in another unit is known by its size.
    use super::*;

    fn unit(name: &str) -> LengthUnit {
        LengthUnit::named(name).unwrap()
    }

    #[test]
    fn names_and_numbers_are_lengths() {
        for (text, metres) in [("\"ft\"", 0.3048), ("\"in\"", 0.0254), ("0.5", 0.5), ("\"mm\"", 0.001), ("1", 1.0)] {
            let unit: LengthUnit = serde_json::from_str(text).unwrap();
            assert_eq!(unit.metres(), metres);
            let again = serde_json::to_string(&unit).unwrap();
            assert_eq!(serde_json::from_str::<LengthUnit>(&again).unwrap(), unit);
        }
        for text in ["\"mile\"", "0", "-1", "1e9", "\"\""] {
            let error = serde_json::from_str::<LengthUnit>(text).unwrap_err().to_string();
            assert!(error.contains("scale is") && error.contains("\"mm\""), "{text}: {error}");
        }
        assert!(serde_json::from_str::<LengthUnit>("[1]").unwrap_err().to_string().contains("a number of metres"));
    }

    #[test]
    fn a_distance_that_no_head_has_names_the_likely_unit() {
        for (distance, likely) in
            [(1700.0, Some("mm")), (170.0, Some("cm")), (600.0, Some("mm")), (1e5, None), (1e7, None)]
        {
            assert_eq!(LengthUnit::of_head(distance), likely.map(unit), "{distance}");
        }
    }
}
