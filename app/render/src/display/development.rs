//! Settings between radiance and screen: exposure, tone curve, gamut.

use clap::ValueEnum;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// Largest exposure, in stops from white, either way: a factor of 10¹⁸.
pub const MOST_STOPS: f32 = 60.0;

/// Settings with which radiance is developed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Development {
    /// Brightness of the picture.
    pub exposure: Exposure,
    /// Curve for luminances, also those brighter than white.
    pub tone: Tone,
    /// Treatment of colours outside the screen's gamut.
    pub gamut: Gamut,
}

/// Brightness of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// Automatic: on average over the picture as bright as the same surfaces at rest, and brighter by this number of
    /// stops.
    Auto(f32),
    /// Fixed: brighter by this number of stops than with the world's own white shown as white. A stop is a factor of
    /// two.
    Stops(f32),
}

impl Exposure {
    /// Fixed exposure that shows as white what is white at rest.
    pub const WHITE: Self = Self::Stops(0.0);
    /// Automatic exposure, as bright as at rest.
    pub const AUTO: Self = Self::Auto(0.0);

    /// Stops from the starting point, which is white or the automatic exposure.
    pub fn stops(self) -> f32 {
        let (Self::Auto(stops) | Self::Stops(stops)) = self;
        stops
    }

    /// Exposure that is brighter by `stops`. An automatic exposure stays automatic.
    pub fn changed(self, stops: f32) -> Self {
        let changed = (self.stops() + stops).clamp(-MOST_STOPS, MOST_STOPS);
        match self {
            Self::Auto(_) => Self::Auto(changed),
            Self::Stops(_) => Self::Stops(changed),
        }
    }
}

impl Default for Exposure {
    fn default() -> Self {
        Self::AUTO
    }
}

impl Display for Exposure {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto(stops) if *stops == 0.0 => formatter.write_str("auto"),
            Self::Auto(stops) => write!(formatter, "auto{stops:+}"),
            Self::Stops(stops) if *stops == 0.0 => formatter.write_str("white"),
            Self::Stops(stops) => write!(formatter, "{stops:+}"),
        }
    }
}

/// Error for a text that names no exposure.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("expected auto, white, or a number of stops from -{MOST_STOPS} to {MOST_STOPS}, as in -1.5 or auto+1")]
pub struct ExposureError;

impl FromStr for Exposure {
    type Err = ExposureError;

    fn from_str(text: &str) -> Result<Self, ExposureError> {
        let text = text.trim();
        let stops = |text: &str| match text.parse::<f32>() {
            Ok(stops) if stops.abs() <= MOST_STOPS => Ok(stops),
            _ => Err(ExposureError),
        };
        match (text, text.strip_prefix("auto")) {
            ("white", _) => Ok(Self::WHITE),
            (_, Some("")) => Ok(Self::AUTO),
            (_, Some(more)) if more.starts_with(['+', '-']) => stops(more).map(Self::Auto),
            _ => stops(text).map(Self::Stops),
        }
    }
}

/// Curve from exposed luminance to the screen's, white being 1 in both. Colours are scaled as a whole, so that their
/// hue stays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
#[repr(u32)]
pub enum Tone {
    /// L (1 + L/w²) / (1 + L): the brightest gain, w, is white; linear while nothing is brighter than at rest
    /// (Reinhard et al. 2002, eq. 4)
    #[default]
    Reinhard = shaders::TONE_REINHARD,
    /// L: what is brighter than white is white
    Linear = shaders::TONE_LINEAR,
    /// 1 − e^(−L), as photographic layers saturate (B eq. 5.1)
    Exponential = shaders::TONE_EXPONENTIAL,
    /// Contrast as of film, dark shadows and soft highlights (Narkowicz 2016)
    Filmic = shaders::TONE_FILMIC,
    /// Brightness levels shared out by how many pixels need them, contrast nowhere exaggerated (Larson et al. 1997)
    Histogram = shaders::TONE_HISTOGRAM,
}

/// Treatment of colours that the screen cannot show (W 3.2.5).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
#[repr(u32)]
pub enum Gamut {
    /// Towards the grey of the same luminance
    #[default]
    Desaturate = shaders::GAMUT_DESATURATE,
    /// White is added until no channel is negative, then all are darkened until none is above 1
    White = shaders::GAMUT_WHITE,
    /// Each channel is cut off by itself
    Clamp = shaders::GAMUT_CLAMP,
}

/// Next choice in order; the first one follows the last.
pub fn next<T: ValueEnum + PartialEq>(choice: T) -> T {
    let following = T::value_variants().iter().skip_while(|value| **value != choice).nth(1);
    following.or(T::value_variants().first()).cloned().unwrap_or(choice)
}

/// Name of a choice on the command line.
pub fn name(choice: &impl ValueEnum) -> String {
    choice.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

#[cfg(test)]
mod tests {
    //! The text of an exposure must parse back to the same exposure. A program that lost the sign would darken
    //! instead of brighten.

    use super::*;

    #[test]
    fn exposures_survive_their_text() {
        for (text, exposure) in [
            ("auto", Exposure::AUTO),
            ("auto-0.5", Exposure::Auto(-0.5)),
            ("white", Exposure::WHITE),
            ("+2", Exposure::Stops(2.0)),
            ("-1.5", Exposure::Stops(-1.5)),
        ] {
            assert_eq!(text.parse(), Ok(exposure));
            assert_eq!(exposure.to_string(), text);
        }
        assert_eq!("0".parse(), Ok(Exposure::WHITE));
        for text in ["", "bright", "nan", "inf", "61", "-60.5"] {
            assert_eq!(text.parse::<Exposure>(), Err(ExposureError), "{text}");
        }
    }

    #[test]
    fn a_change_leaves_automatic_from_white_and_stops_at_the_ends() {
        assert_eq!(Exposure::AUTO.changed(0.5), Exposure::Auto(0.5));
        assert_eq!(Exposure::Stops(-1.0).changed(-0.5), Exposure::Stops(-1.5));
        assert_eq!(Exposure::Stops(MOST_STOPS).changed(0.5), Exposure::Stops(MOST_STOPS));
    }
}
