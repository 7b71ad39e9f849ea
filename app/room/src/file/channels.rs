//! `[[channel]]` tables: names are turned into indices, and named files into maps.

use super::text::DisplayText;
use super::{names, schema};
use crate::channel::{Channel, ChannelPart};
use crate::display::Screen;
use crate::error::{DisplayError, FilePlace};
use crate::gain_map::GainMap;
use crate::maps::{MapError, MapShelf};
use crate::projector::Projector;
use crate::read;
use crate::viewer::EyeSide;
use crate::warp::{CornerWarp, MeasuredWarp, Warp};
use crate::window::WindowPlace;
use glam::{DVec2, DVec4};
use regular_file::Budget;
use std::collections::HashMap;
use std::path::Path;
use toml::Spanned;

/// Named parts of the display that channels refer to.
pub(super) struct ChannelResolver<'a> {
    pub text: &'a DisplayText<'a>,
    pub screens: &'a [Screen],
    pub projectors: &'a [Projector],
    pub windows: &'a [WindowPlace],
    pub folder: &'a Path,
    /// Maps that channels have named so far.
    pub maps: MapShelf<'a>,
}

/// Indices of screens, windows and projectors by their names.
struct KnownNames<'a> {
    screens: HashMap<&'a str, usize>,
    windows: HashMap<&'a str, usize>,
    projectors: HashMap<&'a str, usize>,
}

impl<'a> ChannelResolver<'a> {
    /// Channels of all `[[channel]]` tables, in the file's order.
    pub fn resolve(&mut self, tables: &[Spanned<schema::ChannelTable>]) -> Result<Vec<Channel>, DisplayError> {
        names::check(self.text, "channel", tables, |channel| &channel.name)?;
        let known = KnownNames {
            screens: indices(self.screens.iter().map(|screen| screen.name.as_str())),
            windows: indices(self.windows.iter().map(|window| window.name.as_str())),
            projectors: indices(self.projectors.iter().map(|projector| projector.name.as_str())),
        };
        tables.iter().map(|table| self.channel(table, &known)).collect()
    }

    fn channel(
        &mut self,
        table: &Spanned<schema::ChannelTable>,
        known: &KnownNames<'a>,
    ) -> Result<Channel, DisplayError> {
        let (given, text) = (table.get_ref(), self.text);
        let at = |key: &str| text.at(table.span().start, &format!("channel {:?}", given.name), key);
        let refuse = |key: &str, reason: String| DisplayError::Value { at: at(key), reason };
        if let Some(reason) = not_a_file_name(&given.name) {
            return Err(DisplayError::NotAName { at: at("name"), name: given.name.clone(), reason });
        }
        let screen = find(|| at("screen"), "screen", &given.screen, &known.screens)?;
        let window = find(|| at("window"), "window", &given.window, &known.windows)?;
        let projector = given.projector.as_ref();
        let projector =
            projector.map(|name| find(|| at("projector"), "projector", name, &known.projectors)).transpose()?;
        let eyes = [EyeSide::Left, EyeSide::Right, EyeSide::Centre];
        let eye = given.eye.as_deref().unwrap_or("centre");
        let eye = eyes[find(|| at("eye"), "eye", eye, &indices(eyes.map(EyeSide::name).into_iter()))?];
        let viewport = self.viewport(given, window, &at)?;
        let part = part(given, &at)?;
        if given.part.is_some() && projector.is_some() {
            return Err(refuse(
                "part",
                "the projector says which part of the screen it lights; leave one of them out".into(),
            ));
        }
        if given.corners.is_some() && given.warp.is_some() {
            return Err(refuse("corners", "a channel has either corners or a warp".into()));
        }
        let warp = match (&given.corners, &given.warp) {
            (Some(corners), _) => self.corners(corners, viewport, &at)?,
            (None, Some(file)) => Some(Warp::Grid(self.warp(file)?)),
            (None, None) => None,
        };
        Ok(Channel {
            name: given.name.clone(),
            screen,
            eye,
            window,
            viewport,
            part,
            warp,
            projector,
            alpha: self.map(&given.alpha, given.alpha_gamma, || at("alpha_gamma"))?,
            beta: self.map(&given.beta, given.beta_gamma, || at("beta_gamma"))?,
        })
    }

    fn viewport(
        &self,
        given: &schema::ChannelTable,
        window: usize,
        at: &dyn Fn(&str) -> Box<FilePlace>,
    ) -> Result<[u32; 4], DisplayError> {
        let WindowPlace { name, size: size @ [width, height], .. } = &self.windows[window];
        let viewport = given.viewport.unwrap_or([0, 0, *width, *height]);
        if viewport[2] == 0 || viewport[3] == 0 {
            let reason = "its width and height must be at least one pixel".into();
            return Err(DisplayError::Value { at: at("viewport"), reason });
        }
        let inside = |from: u32, length: u32, whole: u32| u64::from(from) + u64::from(length) <= u64::from(whole);
        if inside(viewport[0], viewport[2], *width) && inside(viewport[1], viewport[3], *height) {
            Ok(viewport)
        } else {
            Err(DisplayError::ViewportOutside { at: at("viewport"), viewport, window: name.clone(), size: *size })
        }
    }

    /// Warp from corners, given in pixels from the viewport's upper left. A corner left out stays at the viewport's
    /// own; `None` if all four do.
    fn corners(
        &self,
        given: &schema::CornersTable,
        viewport: [u32; 4],
        at: &dyn Fn(&str) -> Box<FilePlace>,
    ) -> Result<Option<Warp>, DisplayError> {
        let size = DVec2::new(f64::from(viewport[2]), f64::from(viewport[3]));
        let places = [
            given.upper_left.map_or(DVec2::ZERO, |place| DVec2::from(place) / size),
            given.upper_right.map_or(DVec2::X, |place| DVec2::from(place) / size),
            given.lower_right.map_or(DVec2::ONE, |place| DVec2::from(place) / size),
            given.lower_left.map_or(DVec2::Y, |place| DVec2::from(place) / size),
        ];
        if places == [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y] {
            return Ok(None);
        }
        CornerWarp::new(places)
            .map(|corners| Some(Warp::Corners(corners)))
            .map_err(|error| DisplayError::Value { at: at("corners"), reason: error.to_string() })
    }

    fn map(
        &mut self,
        file: &Option<String>,
        gamma: Option<f64>,
        at: impl Fn() -> Box<FilePlace>,
    ) -> Result<Option<GainMap>, DisplayError> {
        let gamma = gamma.unwrap_or(1.0);
        if !(gamma.is_finite() && gamma > 0.0) {
            return Err(DisplayError::Value { at: at(), reason: format!("{gamma} must be a number above 0") });
        }
        let Some(file) = file else { return Ok(None) };
        let path = self.folder.join(file);
        self.maps.gain(file, gamma, |budget| bytes(&path, budget), |error| unusable(&path, &error)).map(Some)
    }

    fn warp(&mut self, file: &str) -> Result<MeasuredWarp, DisplayError> {
        let path = self.folder.join(file);
        self.maps.warp(file, |budget| bytes(&path, budget), |error| unusable(&path, &error))
    }
}

fn bytes(path: &Path, budget: &Budget) -> Result<Vec<u8>, DisplayError> {
    read::bytes(path, budget).map_err(|reason| DisplayError::Read { path: path.to_owned(), reason })
}

fn unusable(path: &Path, error: &MapError) -> DisplayError {
    DisplayError::Import { path: path.to_owned(), reason: error.to_string() }
}

fn part(given: &schema::ChannelTable, at: &dyn Fn(&str) -> Box<FilePlace>) -> Result<ChannelPart, DisplayError> {
    let Some(part) = given.part.map(DVec4::from) else { return Ok(ChannelPart::default()) };
    let (from, to) = (DVec2::new(part.x, part.y), DVec2::new(part.z, part.w));
    if part.cmpge(DVec4::ZERO).all() && part.cmple(DVec4::ONE).all() && to.cmpgt(from).all() {
        Ok(ChannelPart { from, to })
    } else {
        let reason = format!(
            "{part} is no part of a screen; write left, bottom, right, top, each from 0 to 1, left < right, bottom < top"
        );
        Err(DisplayError::Value { at: at("part"), reason })
    }
}

/// Indices of names by the names.
fn indices<'a>(names: impl Iterator<Item = &'a str>) -> HashMap<&'a str, usize> {
    names.enumerate().map(|(index, name)| (name, index)).collect()
}

/// Index of `name` among the known names.
fn find(
    at: impl Fn() -> Box<FilePlace>,
    kind: &'static str,
    name: &str,
    known: &HashMap<&str, usize>,
) -> Result<usize, DisplayError> {
    known.get(name).copied().ok_or_else(|| {
        let mut names: Vec<_> = known.iter().collect();
        names.sort_by_key(|(_, index)| **index);
        let known = names.into_iter().map(|(name, _)| (*name).to_owned()).collect();
        DisplayError::Unknown { at: at(), kind, name: name.to_owned(), known }
    })
}

/// Reason why `name` cannot be the name of a channel's picture file; `None` if it can.
fn not_a_file_name(name: &str) -> Option<&'static str> {
    if name.contains(['/', '\\']) {
        Some("a channel's picture is a file of that name, so it must have no / and no \\")
    } else if name.starts_with('.') {
        Some("a channel's picture is a file of that name, so it must not begin with a dot")
    } else if name.contains(|letter: char| letter.is_control() || "<>:\"|?*".contains(letter)) {
        Some(
            "a channel's picture is a file of that name, so it must have none of < > : \" | ? * and no control characters",
        )
    } else if name.len() > 200 {
        Some("a channel's picture is a file of that name, so it must be shorter than 200 bytes")
    } else {
        None
    }
}
