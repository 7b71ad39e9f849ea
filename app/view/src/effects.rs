//! Relativity's three effects on a picture, each of which can be left out.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// Places at which a picture shows things: a choice of the event on each worldline.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Places {
    /// Things as seen: each point where the light left it that arrives now (aberration and light-travel time).
    #[default]
    Seen,
    /// Things as measured: each point where it is now, by the observer's own simultaneity, in the observer's frame. It
    /// is contracted along the motion.
    Measured,
    /// Things in instant light: each point where it is now, by the world's simultaneity, in the world's frame.
    Instant,
}

impl Places {
    /// Every view of places, in the order in which a key goes through them.
    pub const ALL: [Self; 3] = [Self::Seen, Self::Measured, Self::Instant];

    /// Name of the view.
    pub fn name(self) -> &'static str {
        match self {
            Self::Seen => "seen",
            Self::Measured => "measured",
            Self::Instant => "instant",
        }
    }

    /// View of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|known| known.name() == name)
    }

    /// View of places that follows, the first after the last.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Seen => Self::Measured,
            Self::Measured => Self::Instant,
            Self::Instant => Self::Seen,
        }
    }
}

/// Effects of relativity on the picture: any of its three parts.
///
/// The wavelength shift alone, L'(λ') = D L(Dλ'), keeps the radiance of all wavelengths together; the searchlight
/// effect alone multiplies it by D⁴; both are D⁵ L(Dλ') (W eq. 4.13, B eq. 2.10).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Effects {
    /// Places at which things are shown.
    pub places: Places,
    /// Shift of the wavelengths, which decides the colours.
    pub doppler: bool,
    /// Searchlight effect, which decides the brightness.
    pub searchlight: bool,
}

impl Effects {
    /// Full relativistic picture: geometry, Doppler shift and searchlight effect.
    pub const ALL: Self = Self { places: Places::Seen, doppler: true, searchlight: true };
    /// The plain picture, as if light were infinitely fast.
    pub const NONE: Self = Self { places: Places::Instant, doppler: false, searchlight: false };
    /// Apparent positions alone, in the colours and brightness that things have at rest.
    pub const GEOMETRY: Self = Self { places: Places::Seen, ..Self::NONE };
    /// Places at the observer's own present, in the colours and brightness that things have at rest.
    pub const MEASURED: Self = Self { places: Places::Measured, ..Self::NONE };

    /// True if things are shown where their light comes from.
    pub fn bend(self) -> bool {
        self.places == Places::Seen
    }

    /// True if colours change.
    pub fn shift_colour(self) -> bool {
        self.doppler && self.places != Places::Measured
    }

    /// True if brightness changes.
    pub fn brighten(self) -> bool {
        self.searchlight && self.places != Places::Measured
    }

    /// True if colour or brightness change.
    pub fn shift_light(self) -> bool {
        self.shift_colour() || self.brighten()
    }
}

impl Default for Effects {
    fn default() -> Self {
        Self::ALL
    }
}

impl Display for Effects {
    /// Writes what is shown.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.bend(), "geometry"),
            (self.places == Places::Measured, "measured"),
            (self.shift_colour(), "doppler"),
            (self.brighten(), "searchlight"),
        ];
        let named: Vec<_> = parts.iter().filter(|(on, _)| *on).map(|(_, name)| *name).collect();
        formatter.write_str(&if named.is_empty() { "none".to_owned() } else { named.join(",") })
    }
}

/// Error for a text that names no effects.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum EffectsError {
    /// A word that names no effect.
    #[error("expected all, none, measured, or any of geometry, doppler and searchlight with commas between them")]
    Unknown,
    /// Another effect beside `measured`.
    #[error(
        "measured stands alone: it shows where things are now, which no light brings, so there is no geometry, doppler \
         or searchlight of light; leave the others out"
    )]
    MeasuredWith,
}

impl FromStr for Effects {
    type Err = EffectsError;

    fn from_str(text: &str) -> Result<Self, EffectsError> {
        match text.trim() {
            "all" => return Ok(Self::ALL),
            "none" => return Ok(Self::NONE),
            "measured" => return Ok(Self::MEASURED),
            _ => {}
        }
        let mut effects = Self::NONE;
        let mut measured = false;
        for name in text.split(',') {
            match name.trim() {
                "geometry" => effects.places = Places::Seen,
                "doppler" => effects.doppler = true,
                "searchlight" => effects.searchlight = true,
                "measured" => measured = true,
                _ => return Err(EffectsError::Unknown),
            }
        }
        if measured { Err(EffectsError::MeasuredWith) } else { Ok(effects) }
    }
}

#[cfg(test)]
mod tests {
    //! Law: effects that are written are read again as what they show, and each word keeps its meaning.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for (text, effects) in [
            ("all", Effects::ALL),
            ("geometry,doppler,searchlight", Effects::ALL),
            ("none", Effects::NONE),
            ("geometry", Effects::GEOMETRY),
            ("measured", Effects::MEASURED),
            ("doppler", Effects { doppler: true, ..Effects::NONE }),
            (" searchlight , geometry", Effects { searchlight: true, ..Effects::GEOMETRY }),
        ] {
            assert_eq!(text.parse(), Ok(effects), "{text}");
            assert_eq!(effects.to_string().parse(), Ok(effects), "{text}");
        }
    }

    #[test]
    fn measured_stands_alone() {
        assert_eq!("measured,doppler".parse::<Effects>(), Err(EffectsError::MeasuredWith));
        assert_eq!("geometry,measured".parse::<Effects>(), Err(EffectsError::MeasuredWith));
        assert_eq!("colour".parse::<Effects>(), Err(EffectsError::Unknown));
        // A switch that is still on shows nothing there, and is on again afterwards.
        let switched = Effects { places: Places::Measured, ..Effects::ALL };
        assert!(!switched.shift_light() && switched.to_string() == "measured");
        assert_eq!(Effects { places: switched.places.next().next(), ..switched }, Effects::ALL);
    }
}
