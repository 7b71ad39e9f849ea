//! Relativity's three effects on a picture, each of which can be left out.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// Effects of relativity on the picture: any of its three parts.
///
/// The wavelength shift alone, L'(λ') = D L(Dλ'), keeps the radiance of all wavelengths together; the searchlight
/// effect alone multiplies it by D⁴; both are D⁵ L(Dλ') (W eq. 4.13, B eq. 2.10).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Effects {
    /// Aberration and light-travel time, which decide the apparent positions.
    pub geometry: bool,
    /// Shift of the wavelengths, which decides the colours.
    pub doppler: bool,
    /// Searchlight effect, which decides the brightness.
    pub searchlight: bool,
}

impl Effects {
    /// Full relativistic picture: geometry, Doppler shift and searchlight effect.
    pub const ALL: Self = Self { geometry: true, doppler: true, searchlight: true };
    /// The plain picture, as if light were infinitely fast.
    pub const NONE: Self = Self { geometry: false, doppler: false, searchlight: false };
    /// Apparent positions alone, in the colours and brightness that things have at rest.
    pub const GEOMETRY: Self = Self { geometry: true, ..Self::NONE };

    /// True if colour or brightness change.
    pub fn shift_light(self) -> bool {
        self.doppler || self.searchlight
    }
}

impl Default for Effects {
    fn default() -> Self {
        Self::ALL
    }
}

impl Display for Effects {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let parts = [(self.geometry, "geometry"), (self.doppler, "doppler"), (self.searchlight, "searchlight")];
        let named: Vec<_> = parts.iter().filter(|(on, _)| *on).map(|(_, name)| *name).collect();
        formatter.write_str(&if named.is_empty() { "none".to_owned() } else { named.join(",") })
    }
}

/// Error for a text that names no effects.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("expected all, none, or any of geometry, doppler and searchlight with commas between them")]
pub struct EffectsError;

impl FromStr for Effects {
    type Err = EffectsError;

    fn from_str(text: &str) -> Result<Self, EffectsError> {
        match text.trim() {
            "all" => return Ok(Self::ALL),
            "none" => return Ok(Self::NONE),
            _ => {}
        }
        let mut effects = Self::NONE;
        for name in text.split(',') {
            let effect = match name.trim() {
                "geometry" => &mut effects.geometry,
                "doppler" => &mut effects.doppler,
                "searchlight" => &mut effects.searchlight,
                _ => return Err(EffectsError),
            };
            *effect = true;
        }
        Ok(effects)
    }
}
