//! MPCDI, the common output of projector calibrations (VESA, 1.0 and 2.0): profiles 2d and a3.
//!
//! A container is a zip with an `mpcdi.xml` and the maps it names. A bare `.mpcdi.xml` has the maps beside it. Each
//! region is the raster of one projector. In profile a3 its warp holds the points of the surface themselves: they
//! become a mesh, and the picture lies evenly on the grid. In profile 2d the warp says which place of the region's
//! picture each pixel shows; the picture's place in the room is left open.

use super::file_name::file_name;
use super::xml;
use crate::channel::{Channel, ChannelPart};
use crate::display::{Display, Screen};
use crate::gain_map::GainMap;
use crate::reflection::Reflection;
use crate::surface::flat::FlatSurface;
use crate::surface::mesh::MeshSurface;
use crate::surface::shape::ScreenSurface;
use crate::viewer::{EyeSide, HEAD_M, Viewer};
use crate::warp::Warp;
use crate::window::{Combine, Monitor, WindowPlace};
use crate::{maps, read};
use glam::{DVec2, DVec3};
use roxmltree::Node;
use std::io::{Cursor, Read};
use std::path::Path;

/// Largest file in a container, bytes unpacked. A larger file is refused.
const MAX_FILE: u64 = 1 << 29;

/// Distance before the head and width of a 2d profile's picture, metres. The file does not say them.
const FLAT_DISTANCE_M: f64 = 2.0;
const FLAT_WIDTH_M: f64 = 4.0;

/// Reads a container or a bare file. An error's text is worded to follow the file's name.
pub(crate) fn parse(bytes: Vec<u8>, folder: &Path) -> Result<Display, String> {
    let mut files = if bytes.starts_with(b"PK") {
        let zip = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|error| format!("it is no good zip: {error}"))?;
        MpcdiFiles::Zip(Box::new(zip))
    } else {
        MpcdiFiles::Bare { xml: bytes, folder }
    };
    let xml = files.description()?;
    let text = std::str::from_utf8(&xml).map_err(|_| "its description is not UTF-8 text".to_owned())?;
    let document = xml::document(text, "MPCDI")?;
    let root = document.root_element();
    let profile = xml::attribute(root, "profile").unwrap_or_default().to_ascii_lowercase();
    if !matches!(profile.as_str(), "2d" | "a3") {
        return Err(format!("its profile is {profile:?}; only 2d and a3 can be read, so export it as one of these"));
    }
    let mut import = MpcdiImport { files, root, solid: profile == "a3", names: Vec::new(), display: empty() };
    for buffer in xml::all(root, "buffer") {
        for region in xml::all(buffer, "region") {
            import.region(buffer, region)?;
        }
    }
    if import.display.channels.is_empty() {
        return Err("it has no <region> in a <buffer>, so there is nothing to show".into());
    }
    if !import.solid {
        import.display.notices.push(format!(
            "profile 2d does not say where the picture is: it is taken to be {FLAT_WIDTH_M} m wide, {FLAT_DISTANCE_M} m before the head"
        ));
    }
    Ok(import.display)
}

fn empty() -> Display {
    Display {
        name: String::new(),
        viewer: Viewer::default(),
        screens: Vec::new(),
        projectors: Vec::new(),
        windows: Vec::new(),
        channels: Vec::new(),
        tracker: None,
        notices: Vec::new(),
    }
}

/// Source of the description and the maps.
enum MpcdiFiles<'a> {
    Zip(Box<zip::ZipArchive<Cursor<Vec<u8>>>>),
    Bare { xml: Vec<u8>, folder: &'a Path },
}

impl MpcdiFiles<'_> {
    fn description(&mut self) -> Result<Vec<u8>, String> {
        match self {
            Self::Bare { xml, .. } => Ok(std::mem::take(xml)),
            Self::Zip(_) => self.read("mpcdi.xml"),
        }
    }

    /// Contents of a file by its name, in upper or lower case.
    fn read(&mut self, name: &str) -> Result<Vec<u8>, String> {
        match self {
            Self::Bare { folder, .. } => {
                // A bare description may name only files in its own folder.
                if Path::new(name).components().count() != 1 || Path::new(name).file_name().is_none() {
                    return Err(format!("{name:?} is not beside it"));
                }
                read::bytes(&folder.join(name)).map_err(|reason| format!("{name:?} {reason}"))
            }
            Self::Zip(zip) => {
                let found = zip.file_names().filter_map(Result::ok).find(|file| file.eq_ignore_ascii_case(name));
                let found = found.map(|file| file.into_owned());
                let found = found.ok_or_else(|| format!("there is no {name:?} in it"))?;
                let wrong = |error: &dyn std::fmt::Display| format!("{name:?} cannot be unpacked: {error}");
                let mut bytes = Vec::new();
                let file = zip.by_name(&found).map_err(|error| wrong(&error))?;
                file.take(MAX_FILE + 1).read_to_end(&mut bytes).map_err(|error| wrong(&error))?;
                if bytes.len() as u64 > MAX_FILE {
                    return Err(wrong(&format!("it is larger than {MAX_FILE} bytes")));
                }
                Ok(bytes)
            }
        }
    }
}

/// A display under construction.
struct MpcdiImport<'a> {
    files: MpcdiFiles<'a>,
    root: Node<'a, 'a>,
    /// True for profile a3, where the warp holds the surface's points.
    solid: bool,
    names: Vec<String>,
    display: Display,
}

impl<'a> MpcdiImport<'a> {
    /// Adds one projector's raster: a window, a channel, and a screen. The regions of one 2d buffer share a screen.
    fn region(&mut self, buffer: Node<'a, 'a>, region: Node<'a, 'a>) -> Result<(), String> {
        let id = xml::attribute(region, "id").unwrap_or("region");
        let wrong = |reason: String| format!("region {id:?}: {reason}");
        let resolution = [xml::number(region, "xResolution")?, xml::number(region, "yResolution")?];
        if resolution.iter().any(|side| !(*side >= 1.0 && *side <= 65_536.0 && side.fract() == 0.0)) {
            return Err(wrong(format!("{} × {} pixels are no raster", resolution[0], resolution[1])));
        }
        let size = resolution.map(|side| side as u32);
        let name = file_name(id, &mut self.names);
        let fileset = xml::all(self.root, "fileset").find(|set| xml::attribute(*set, "region") == Some(id));
        let warp_file = fileset.and_then(|set| xml::first(set, "geometryWarpFile"));
        let warp = match warp_file.and_then(|file| xml::text(file, "path")) {
            Some(path) => Some(self.files.read(path).map_err(wrong)?),
            None => None,
        };
        let (screen, part, warp) = match (self.solid, warp) {
            (true, None) => return Err(wrong("profile a3 needs its geometryWarpFile, and there is none".into())),
            (true, Some(bytes)) => {
                let surface = self.surface(warp_file, &bytes).map_err(wrong)?;
                self.display.screens.push(Screen { name: name.clone(), surface, reflection: Reflection::default() });
                (self.display.screens.len() - 1, ChannelPart::default(), None)
            }
            (false, warp) => {
                let warp =
                    warp.map(|bytes| maps::warp(&bytes)).transpose().map_err(|error| wrong(error.to_string()))?;
                (self.picture(buffer)?, part(region)?, warp.map(Warp::Grid))
            }
        };
        let alpha = self.map(fileset, "alphaMap").map_err(wrong)?;
        let beta = self.map(fileset, "betaMap").map_err(wrong)?;
        let index = self.display.windows.len();
        self.display.windows.push(WindowPlace {
            name: name.clone(),
            monitor: Some(Monitor::Index(index)),
            position: None,
            size,
            fullscreen: true,
            combine: Combine::None,
            swap_eyes: false,
        });
        self.display.channels.push(Channel {
            name,
            screen,
            eye: EyeSide::Centre,
            window: index,
            viewport: [0, 0, size[0], size[1]],
            part,
            warp,
            projector: None,
            alpha,
            beta,
        });
        Ok(())
    }

    /// Surface from the points of profile a3: y up, x to the *left*, z into the screen.
    fn surface(&mut self, file: Option<Node<'a, 'a>>, bytes: &[u8]) -> Result<ScreenSurface, String> {
        let map = maps::grid(bytes).map_err(|error| error.to_string())?;
        let unit = file.and_then(|file| xml::text(file, "geometricUnit")).unwrap_or("unknown");
        let metres = match unit.to_ascii_lowercase().as_str() {
            "mm" => 1e-3,
            "cm" => 1e-2,
            "dm" => 1e-1,
            "m" => 1.0,
            "in" => 0.0254,
            "ft" => 0.3048,
            "yd" => 0.9144,
            _ => {
                self.notice(format!("its geometric unit {unit:?} is not known: it is taken to be the metre"));
                1.0
            }
        };
        let origin = file.and_then(|file| xml::text(file, "originOf3DData")).unwrap_or("unknown");
        match origin.to_ascii_lowercase().as_str() {
            "floorcenter" => self.display.viewer.head_m = HEAD_M,
            "idealeyepoint" => self.display.viewer.head_m = DVec3::ZERO,
            _ => {
                self.display.viewer.head_m = DVec3::ZERO;
                self.notice(format!("its origin is {origin:?}: the head is taken to be there"));
            }
        }
        let point = |&[x, y, z]: &[f32; 3]| DVec3::new(-f64::from(x), f64::from(y), -f64::from(z)) * metres;
        let rows = map.samples.chunks(map.width as usize).rev();
        let mesh = MeshSurface::grid(map.width, map.height, rows.flatten().map(point).collect());
        if !(mesh.size_m() > 0.0 && mesh.size_m().is_finite()) {
            return Err("its warp has no points that are known and apart".into());
        }
        Ok(ScreenSurface::Mesh(Box::new(mesh)))
    }

    fn notice(&mut self, notice: String) {
        if !self.display.notices.contains(&notice) {
            self.display.notices.push(notice);
        }
    }

    /// Index of the flat screen that a 2d buffer's regions are parts of; it is added for the first of them.
    fn picture(&mut self, buffer: Node<'a, 'a>) -> Result<usize, String> {
        let name = xml::attribute(buffer, "id").unwrap_or("buffer").to_owned();
        if let Some(index) = self.display.screens.iter().position(|screen| screen.name == name) {
            return Ok(index);
        }
        let (width, height) = (xml::number(buffer, "xResolution")?, xml::number(buffer, "yResolution")?);
        let size = DVec2::new(FLAT_WIDTH_M, FLAT_WIDTH_M * height / width);
        let centre = self.display.viewer.head_m - DVec3::Z * FLAT_DISTANCE_M;
        let flat =
            FlatSurface::from_centre(centre, size, DVec3::ZERO).map_err(|error| format!("buffer {name:?}: {error}"))?;
        self.display.screens.push(Screen {
            name,
            surface: ScreenSurface::Flat(flat),
            reflection: Reflection::default(),
        });
        Ok(self.display.screens.len() - 1)
    }

    fn map(&mut self, fileset: Option<Node<'a, 'a>>, kind: &'static str) -> Result<Option<GainMap>, String> {
        let Some(element) = fileset.and_then(|set| xml::first(set, kind)) else { return Ok(None) };
        let Some(path) = xml::text(element, "path") else { return Ok(None) };
        let gamma = match xml::text(element, "gammaEmbedded") {
            None => 1.0,
            Some(text) => text
                .parse()
                .ok()
                .filter(|gamma: &f64| gamma.is_finite() && *gamma > 0.0)
                .ok_or_else(|| format!("{kind}: gammaEmbedded is {text:?}; it must be a number above 0"))?,
        };
        if xml::text(element, "componentDepth") == Some("3") {
            self.notice(format!("{kind}s of three colours are used by their luminance"));
        }
        let bytes = self.files.read(path)?;
        maps::gain(&bytes, gamma).map(Some).map_err(|error| format!("{path:?}: {error}"))
    }
}

/// Rectangle of a region in its buffer, which counts y downwards.
fn part(region: Node<'_, '_>) -> Result<ChannelPart, String> {
    let [x, y, width, height] = [
        xml::number(region, "x")?,
        xml::number(region, "y")?,
        xml::number(region, "xSize")?,
        xml::number(region, "ySize")?,
    ];
    let part = ChannelPart { from: DVec2::new(x, 1.0 - y - height), to: DVec2::new(x + width, 1.0 - y) };
    let inside = part.from.min_element() >= -1e-6 && part.to.max_element() <= 1.0 + 1e-6 && width > 0.0 && height > 0.0;
    if !inside {
        return Err(format!(
            "{}: x, y, xSize, ySize = {x}, {y}, {width}, {height} are no part of its buffer",
            xml::place(region)
        ));
    }
    Ok(ChannelPart { from: part.from.max(DVec2::ZERO), to: part.to.min(DVec2::ONE) })
}
