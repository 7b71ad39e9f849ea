//! `[[screen]]`: which form a screen is written in, and what it comes to.

use super::schema;
use super::text::Text;
use crate::room::{DisplayError, Flat, Screen, Surface};
use glam::{DVec2, DVec3};
use std::path::Path;
use toml::Spanned;

/// All screens.
pub(super) fn resolve(
    text: &Text<'_>,
    tables: &[Spanned<schema::Screen>],
    _folder: &Path,
) -> Result<Vec<Screen>, DisplayError> {
    super::names(text, "screen", tables, |screen| &screen.name)?;
    tables
        .iter()
        .map(|table| {
            let form = Form { text, start: table.span().start, given: table.get_ref() };
            Ok(Screen { name: form.given.name.clone(), surface: form.surface()? })
        })
        .collect()
}

/// One table, and where it is.
struct Form<'a> {
    text: &'a Text<'a>,
    start: usize,
    given: &'a schema::Screen,
}

impl Form<'_> {
    fn at(&self, key: &str) -> crate::room::At {
        self.text.at(self.start, &format!("screen {:?}", self.given.name), key)
    }

    fn refuse<T>(&self, key: &str, reason: impl Into<String>) -> Result<T, DisplayError> {
        Err(DisplayError::Value { at: self.at(key), reason: reason.into() })
    }

    fn surface(&self) -> Result<Surface, DisplayError> {
        self.finite()?;
        let given = self.given;
        let corners = [given.lower_left, given.lower_right, given.upper_left, given.upper_right];
        let has_corners = corners.iter().any(Option::is_some);
        let has_centre = given.centre.is_some()
            || given.size.is_some()
            || [given.yaw, given.pitch, given.roll].iter().any(Option::is_some);
        match (has_corners, has_centre) {
            (true, false) => self.corners(),
            (false, true) => self.centre(),
            (true, true) => self.refuse("", "it has corners and a centre; write one of them only"),
            (false, false) => {
                self.refuse("", "it says nowhere where it is; write three corners, or a centre and a size")
            }
        }
    }

    /// Everything that is a number is one.
    fn finite(&self) -> Result<(), DisplayError> {
        let given = self.given;
        let points = [
            ("lower_left", given.lower_left),
            ("lower_right", given.lower_right),
            ("upper_left", given.upper_left),
            ("upper_right", given.upper_right),
            ("centre", given.centre),
            ("size", given.size.map(|[width, height]| [width, height, 0.0])),
            ("yaw", given.yaw.map(|angle| [angle, 0.0, 0.0])),
            ("pitch", given.pitch.map(|angle| [angle, 0.0, 0.0])),
            ("roll", given.roll.map(|angle| [angle, 0.0, 0.0])),
        ];
        for (key, point) in points {
            if point.is_some_and(|point| !point.iter().all(|number| number.is_finite())) {
                return self.refuse(key, "a number in it is not finite");
            }
        }
        Ok(())
    }

    fn corners(&self) -> Result<Surface, DisplayError> {
        let given = self.given;
        let [ll, lr, ul, ur] = [given.lower_left, given.lower_right, given.upper_left, given.upper_right]
            .map(|corner| corner.map(DVec3::from));
        // Any three say where the fourth is.
        let (ll, lr, ul) = match (ll, lr, ul, ur) {
            (Some(ll), Some(lr), Some(ul), _) => (ll, lr, ul),
            (Some(ll), Some(lr), None, Some(ur)) => (ll, lr, ll + ur - lr),
            (Some(ll), None, Some(ul), Some(ur)) => (ll, ll + ur - ul, ul),
            (None, Some(lr), Some(ul), Some(ur)) => (lr + ul - ur, lr, ul),
            _ => return self.refuse("", "a rectangle needs three of lower_left, lower_right, upper_left, upper_right"),
        };
        let wrong = |reason| DisplayError::NotRectangle { at: self.at(""), reason };
        let flat = Flat::from_corners(ll, lr, ul).map_err(wrong)?;
        if let Some(ur) = ur {
            flat.closes(ur).map_err(wrong)?;
        }
        Ok(Surface::Flat(flat))
    }

    fn centre(&self) -> Result<Surface, DisplayError> {
        let given = self.given;
        let Some(centre) = given.centre else { return self.refuse("", "it has a size or angles, but no centre") };
        let Some(size) = given.size else { return self.refuse("centre", "it has a centre, but no size") };
        let angles = [given.yaw, given.pitch, given.roll].map(|angle| angle.unwrap_or(0.0));
        Flat::from_centre(centre.into(), DVec2::from(size), angles.into())
            .map(Surface::Flat)
            .map_err(|reason| DisplayError::NotRectangle { at: self.at("size"), reason })
    }
}
