//! Speeds in a path's file: a number of metres per second, or a text with its unit.

use serde::Deserialize;

/// Units of speed, longest first where one ends like another, with their metres per second.
const UNITS: [(&str, f64); 4] = [("km/h", 1.0 / 3.6), ("km/s", 1e3), ("m/s", 1.0), ("c", 299_792_458.0)];

/// Speed as a file writes it.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "expected a speed: metres per second, or a text as \"30 km/h\"")]
pub(crate) enum SpeedText {
    /// Metres per second.
    Number(f64),
    /// Number with a unit.
    Text(String),
}

impl SpeedText {
    /// Speed in metres per second, or the reason why it is none.
    pub(crate) fn metres_per_second(&self) -> Result<f64, String> {
        let text = match self {
            Self::Number(speed) => return above_zero(*speed, &speed.to_string()),
            Self::Text(text) => text.trim(),
        };
        for (unit, metres_per_second) in UNITS {
            if let Some(number) = text.strip_suffix(unit).and_then(|number| number.trim().parse::<f64>().ok()) {
                return above_zero(number * metres_per_second, text);
            }
        }
        Err(format!("\"{text}\" is no speed; expected a number of m/s, or a text as \"30 km/h\", \"5 m/s\", \"1 c\""))
    }
}

fn above_zero(speed: f64, text: &str) -> Result<f64, String> {
    if speed.is_finite() && speed > 0.0 { Ok(speed) } else { Err(format!("{text} is no speed above 0")) }
}

#[cfg(test)]
mod tests {
    //! Law: a speed is what it says, and nothing else is a speed.
    use super::*;

    #[test]
    fn speeds_have_units() {
        let read = |text: &str| SpeedText::Text(text.to_owned()).metres_per_second();
        assert_eq!(read("36 km/h").map(|speed| speed.round()), Ok(10.0));
        assert_eq!([read("2km/s"), read(" 5 m/s "), read("1 c")], [Ok(2e3), Ok(5.0), Ok(299_792_458.0)]);
        for text in ["", "fast", "-3 m/s", "NaN m/s", "0 c", "3 mph"] {
            assert!(read(text).is_err(), "{text}");
        }
        assert!(SpeedText::Number(f64::INFINITY).metres_per_second().is_err());
    }
}
