//! Outside view of the photo-surface: a camera at rest in the observer's frame that does not sit at the eye (W 5.1.5).
//!
//! To such a camera the apparent positions of all things are an ordinary object in space, with the observer in its
//! middle. Nobody sees it so; it shows how a picture comes about.

use crate::camera::Camera;
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// Values that the colours of the photo-surface show in an outside view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Colouring {
    /// Light that the observer sees there, with the effects of the picture.
    #[default]
    Light,
    /// Doppler factor: blue above 1, white at 1, red below, with a line at every octave.
    Doppler,
    /// Delay of the light, which is its distance from the eye in the observer's frame: rings of equal delay.
    Delay,
}

/// Place and direction of a camera outside of the eye, and what its colours show.
///
/// Its written form is `X,Y,Z[/X,Y,Z][:light|doppler|delay]`: the place, the direction, the colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutsideView {
    /// Place of the camera relative to the eye, observer's axes (a pure boost of the world's), metres.
    pub place: DVec3,
    /// Direction of view, observer's axes, of any length; towards the eye if `None`.
    pub look: Option<DVec3>,
    /// Value that colours show.
    pub colouring: Colouring,
}

/// Part of a `Shot` that is seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutsideCamera {
    /// Place of the camera relative to the eye, observer's axes, metres.
    pub place: DVec3,
    /// Value that colours show.
    pub colouring: Colouring,
    /// Camera of the eye, whose field of view is drawn as lines.
    pub eye: Camera,
}

impl Colouring {
    /// Every colouring, in the order in which a key goes through them.
    pub const ALL: [Self; 3] = [Self::Light, Self::Doppler, Self::Delay];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Light => "light",
            Self::Doppler => "doppler",
            Self::Delay => "delay",
        }
    }

    /// Colouring that follows, the first after the last.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::Light => Self::Doppler,
            Self::Doppler => Self::Delay,
            Self::Delay => Self::Light,
        }
    }
}

impl OutsideView {
    /// View over the shoulder of an eye that looks along `ahead`, from `distance` metres: from behind, the right and
    /// above.
    pub fn over(ahead: DVec3, distance: f64) -> Self {
        let back = -ahead.normalize_or(DVec3::NEG_Z);
        let right = DVec3::Y.cross(back).try_normalize().unwrap_or(DVec3::X);
        let place = (0.75 * back + 0.5 * right + 0.45 * DVec3::Y).normalize() * distance;
        Self { place, look: None, colouring: Colouring::Light }
    }

    /// Moves around the eye by angles to the right and up, radians, divides the distance to it by `closer`, and looks
    /// at it.
    pub fn orbit(&mut self, right_rad: f64, up_rad: f64, closer: f64) {
        /// Smallest angle from straight above or below, radians.
        const NEAREST_RAD: f64 = 0.02;
        /// Nearest and farthest place, metres.
        const REACH_M: [f64; 2] = [1e-6, 1e12];
        let level = f64::hypot(self.place.x, self.place.z);
        let limit = FRAC_PI_2 - NEAREST_RAD;
        let height = (self.place.y.atan2(level) + up_rad).clamp(-limit, limit);
        let bearing = self.place.x.atan2(self.place.z) + right_rad;
        let direction = DVec3::new(bearing.sin() * height.cos(), height.sin(), bearing.cos() * height.cos());
        let distance = (self.place.length() / closer).clamp(REACH_M[0], REACH_M[1]);
        *self = Self { place: direction * distance, look: None, ..*self };
    }
}

impl OutsideCamera {
    /// Directions from the eye through the corners of its own picture of `size` pixels, observer's axes, unit vectors;
    /// lower left, lower right, upper right, upper left.
    pub fn corners(&self, size: [u32; 2]) -> [DVec3; 4] {
        let tangents = self.eye.tangents(size);
        let (low, high) = (tangents.low, tangents.high);
        [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]
            .map(|corner| (self.eye.observer_from_eye * corner.extend(-1.0)).normalize())
    }
}

impl Display for OutsideView {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let DVec3 { x, y, z } = self.place;
        write!(formatter, "{x},{y},{z}")?;
        if let Some(DVec3 { x, y, z }) = self.look {
            write!(formatter, "/{x},{y},{z}")?;
        }
        write!(formatter, ":{}", self.colouring.name())
    }
}

/// A text that is no outside view.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum OutsideError {
    /// A place or a direction that is not three finite numbers.
    #[error("{0}: expected three finite numbers with commas between them, as in X,Y,Z/X,Y,Z:doppler")]
    Vector(String),
    /// A camera at the eye itself.
    #[error("the camera must not be at the eye: give another place, metres from the eye")]
    AtTheEye,
    /// A direction without length.
    #[error("0,0,0 is no direction: give another one after the /, or none to look at the eye")]
    NoDirection,
    /// A word that names no colouring.
    #[error("{0}: expected light, doppler or delay after the colon")]
    Colouring(String),
}

impl FromStr for OutsideView {
    type Err = OutsideError;

    fn from_str(text: &str) -> Result<Self, OutsideError> {
        let (places, colouring) = match text.split_once(':') {
            Some((places, name)) => {
                let found = Colouring::ALL.into_iter().find(|colouring| colouring.name() == name.trim());
                (places, found.ok_or_else(|| OutsideError::Colouring(name.to_owned()))?)
            }
            None => (text, Colouring::default()),
        };
        let (place, look) = match places.split_once('/') {
            Some((place, look)) => (vector(place)?, Some(vector(look)?)),
            None => (vector(places)?, None),
        };
        if place.length_squared() == 0.0 {
            return Err(OutsideError::AtTheEye);
        }
        if look.is_some_and(|look| look.try_normalize().is_none()) {
            return Err(OutsideError::NoDirection);
        }
        Ok(Self { place, look, colouring })
    }
}

fn vector(text: &str) -> Result<DVec3, OutsideError> {
    let wrong = || OutsideError::Vector(text.to_owned());
    let numbers: Vec<f64> =
        text.split(',').map(|number| number.trim().parse().map_err(|_| wrong())).collect::<Result<_, _>>()?;
    let vector = <[f64; 3]>::try_from(numbers).map(DVec3::from_array).map_err(|_| wrong())?;
    if vector.is_finite() { Ok(vector) } else { Err(wrong()) }
}

#[cfg(test)]
mod tests {
    //! Law: an outside view that is written is read again, and what is none is refused with the reason.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let place = DVec3::new(3.0, 2.5, -1.0);
        for (text, look, colouring) in [
            ("3,2.5,-1", None, Colouring::Light),
            ("3, 2.5, -1 : doppler", None, Colouring::Doppler),
            ("3,2.5,-1/0,-1,0:delay", Some(DVec3::NEG_Y), Colouring::Delay),
        ] {
            let view: OutsideView = text.parse().unwrap();
            assert_eq!(view, OutsideView { place, look, colouring }, "{text}");
            assert_eq!(view.to_string().parse(), Ok(view));
        }
        for (text, told) in [
            ("3,2", "3,2: expected three"),
            ("3,2,inf", "expected three finite"),
            ("0,0,0", "at the eye"),
            ("1,0,0/0,0,0", "no direction"),
            ("1,0,0:heat", "heat: expected light, doppler or delay"),
        ] {
            let refused = text.parse::<OutsideView>().unwrap_err().to_string();
            assert!(refused.contains(told), "{text}: {refused}");
        }
    }
}
