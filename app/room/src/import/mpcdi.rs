//! MPCDI, the common output of projector calibrations (VESA, 1.0 and 2.0): profiles 2d, 3d, a3 and sl.
//!
//! A container is a zip with an `mpcdi.xml` and the maps it names. A bare `.mpcdi.xml` has the maps beside it. Each
//! region is the raster of one projector, and becomes a window and a channel. What the channel shows depends on the
//! profile:
//!
//! - 2d: the warp says which place of the region's picture each pixel shows; the picture's place is left open.
//! - 3d: the same, but the picture's place is given: a frustum, seen by an eye that stays where it is.
//! - a3: the warp holds the points of the surface. They become a mesh, and the picture lies evenly on the grid.
//! - sl: a projector, by its frustum and its coordinate frame, lights a mesh: the points of the warp, or a mesh beside
//!   the file. A distortion map says which place of an ideal lens's picture each pixel shows.

use super::blank::blank;
use super::file_name::TakenNames;
use super::letters;
use super::mpcdi_files::MpcdiFiles;
use super::mpcdi_frame::{frustum, metres, position, room_from_file};
use super::xml;
use crate::channel::{Channel, ChannelPart};
use crate::display::{Display, Screen};
use crate::gain_map::GainMap;
use crate::lens::ProjectorLens;
use crate::maps::{self, MapShelf};
use crate::projector::Projector;
use crate::reflection::Reflection;
use crate::surface::flat::FlatSurface;
use crate::surface::mesh::MeshSurface;
use crate::surface::mesh_file;
use crate::surface::shape::ScreenSurface;
use crate::viewer::{EyeSide, HEAD_M};
use crate::warp::Warp;
use crate::window::{Combine, Monitor, WindowPlace};
use glam::{DMat3, DVec2, DVec3};
use regular_file::Budget;
use roxmltree::Node;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

/// Distance before the head of a flat picture, metres. The file does not say it.
const FLAT_DISTANCE_M: f64 = 2.0;

/// Width of a 2d profile's picture, metres. The file does not say it.
const FLAT_WIDTH_M: f64 = 4.0;

/// Largest memory of a description, in bytes of its text.
const BYTES_OF_TEXT: u64 = 30;

/// Reads a container or a bare file. An error's text is worded to follow the file's name.
///
/// # Arguments
/// * `folder`, `stem` — folder of the file, and its name without an ending: where a mesh is looked for.
pub(crate) fn parse(bytes: Vec<u8>, folder: &Path, stem: &str, budget: &Budget) -> Result<Display, String> {
    let mut files = MpcdiFiles::open(bytes, folder)?;
    let xml = files.description(budget)?;
    let text = letters::text(&xml);
    budget.take(BYTES_OF_TEXT * text.len() as u64).map_err(|error| format!("its description: {error}"))?;
    let document = xml::document(&text, "MPCDI")?;
    let root = document.root_element();
    let profile = xml::attribute(root, "profile").unwrap_or_default().to_ascii_lowercase();
    let profile = match profile.as_str() {
        "2d" => MpcdiProfile::Flat,
        "3d" => MpcdiProfile::FixedEye,
        "a3" => MpcdiProfile::Solid,
        "sl" => MpcdiProfile::ShaderLamps,
        _ => return Err(format!("its profile is {profile:?}; the profiles are 2d, 3d, a3 and sl")),
    };
    let mut import = MpcdiImport {
        files,
        maps: MapShelf::new(budget),
        profile,
        mesh_path: folder.join(format!("{stem}.obj")),
        mesh: None,
        filesets: HashMap::new(),
        bent: bent_lenses(root),
        pictures: HashMap::new(),
        names: TakenNames::default(),
        noticed: HashSet::new(),
        placed: false,
        display: blank(DVec3::ZERO),
    };
    for set in xml::all(root, "fileset") {
        import.filesets.entry(xml::attribute(set, "region").unwrap_or_default()).or_insert(set);
    }
    if profile == MpcdiProfile::Flat {
        import.display.viewer.head_m = HEAD_M;
    }
    // An extension may have buffers of its own, which say something else.
    for buffer in xml::all(xml::first(root, "display").unwrap_or(root), "buffer") {
        for region in xml::children(buffer, "region") {
            let id = xml::attribute(region, "id").unwrap_or("region");
            import.region(buffer, region, id).map_err(|reason| format!("region {id:?}: {reason}"))?;
        }
    }
    if import.display.channels.is_empty() {
        let left_out = import.display.notices.into_iter().next();
        return Err(left_out.unwrap_or("it has no <region> in a <buffer>, so there is nothing to show".into()));
    }
    match profile {
        MpcdiProfile::Flat => import.notice(format!(
            "profile 2d does not say where the picture is: it is taken to be {FLAT_WIDTH_M} m wide, {FLAT_DISTANCE_M} m before the head"
        )),
        MpcdiProfile::FixedEye => import.notice(
            "profile 3d is made for an eye that stays where it is: the directions are right for a head that rests at the room's origin"
                .into(),
        ),
        MpcdiProfile::Solid | MpcdiProfile::ShaderLamps => {}
    }
    Ok(import.display)
}

/// Regions whose lens is no pinhole: those of an extension with `<fisheye>` or `<anamorphic>`.
fn bent_lenses<'a>(root: Node<'a, 'a>) -> HashSet<&'a str> {
    let bent = |region: &Node<'a, 'a>| {
        region.children().any(|child| {
            ["fisheye", "anamorphic"].iter().any(|name| child.tag_name().name().eq_ignore_ascii_case(name))
        })
    };
    xml::all(root, "region").filter(bent).filter_map(|region| xml::attribute(region, "id")).collect()
}

/// Profile of a file: what its regions say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MpcdiProfile {
    /// 2d: parts of a flat picture.
    Flat,
    /// 3d: flat pictures by their angles.
    FixedEye,
    /// a3: points of a surface.
    Solid,
    /// sl: projectors and a surface.
    ShaderLamps,
}

/// A display under construction.
struct MpcdiImport<'a> {
    files: MpcdiFiles<'a>,
    maps: MapShelf<'a>,
    profile: MpcdiProfile,
    /// Path of the mesh beside the file.
    mesh_path: PathBuf,
    /// Index of the screen with the mesh beside the file, and the metres of its unit.
    mesh: Option<usize>,
    /// Filesets by their regions' names.
    filesets: HashMap<&'a str, Node<'a, 'a>>,
    /// Names of regions whose lens is not understood.
    bent: HashSet<&'a str>,
    /// Screens of 2d buffers by their names.
    pictures: HashMap<String, usize>,
    names: TakenNames,
    noticed: HashSet<String>,
    /// True once the head has its place.
    placed: bool,
    display: Display,
}

/// Part of a display that a region fills.
struct RegionView {
    screen: usize,
    part: ChannelPart,
    warp: Option<Warp>,
    projector: Option<usize>,
}

impl RegionView {
    fn of(screen: usize) -> Self {
        Self { screen, part: ChannelPart::default(), warp: None, projector: None }
    }
}

impl<'a> MpcdiImport<'a> {
    /// Adds one projector's raster: a window, a channel, and a screen. The regions of one 2d buffer share a screen.
    fn region(&mut self, buffer: Node<'a, 'a>, region: Node<'a, 'a>, id: &str) -> Result<(), String> {
        let resolution = [xml::number(region, "xResolution")?, xml::number(region, "yResolution")?];
        if resolution.iter().any(|side| !(*side >= 1.0 && *side <= 65_536.0 && side.fract() == 0.0)) {
            return Err(format!("{} × {} pixels are no raster", resolution[0], resolution[1]));
        }
        if self.profile == MpcdiProfile::ShaderLamps && self.bent.contains(id) {
            self.notice(format!(
                "region {id:?}: its lens is a fisheye or anamorphic, which is not read: it is left out"
            ));
            return Ok(());
        }
        let size = resolution.map(|side| side as u32);
        let name = self.names.file_name(id);
        let fileset = self.filesets.get(id).copied();
        let view = match self.profile {
            MpcdiProfile::Flat => self.flat(buffer, region, fileset)?,
            MpcdiProfile::FixedEye => self.fixed_eye(region, fileset, &name)?,
            MpcdiProfile::Solid => self.solid(fileset, &name)?,
            MpcdiProfile::ShaderLamps => self.shader_lamp(region, fileset, &name)?,
        };
        let alpha = self.gain(fileset, "alphaMap")?;
        let beta = self.gain(fileset, "betaMap")?;
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
            screen: view.screen,
            eye: EyeSide::Centre,
            window: index,
            viewport: [0, 0, size[0], size[1]],
            part: view.part,
            warp: view.warp,
            projector: view.projector,
            alpha,
            beta,
        });
        Ok(())
    }

    /// Part of a flat picture.
    fn flat(
        &mut self,
        buffer: Node<'a, 'a>,
        region: Node<'a, 'a>,
        fileset: Option<Node<'a, 'a>>,
    ) -> Result<RegionView, String> {
        let part = part(region)?;
        let screen = self.picture(buffer, region, part)?;
        Ok(RegionView { part, warp: self.warp(fileset, "geometryWarpFile")?, ..RegionView::of(screen) })
    }

    /// Flat picture by its angles, seen from the room's origin.
    fn fixed_eye(
        &mut self,
        region: Node<'a, 'a>,
        fileset: Option<Node<'a, 'a>>,
        name: &str,
    ) -> Result<RegionView, String> {
        let (room_from_eye, tangents) = frustum(region)?;
        let corner =
            |x: f64, y: f64| self.display.viewer.head_m + room_from_eye * DVec3::new(x, y, -1.0) * FLAT_DISTANCE_M;
        let (low, high) = (tangents.low, tangents.high);
        let flat = FlatSurface::from_corners(corner(low.x, low.y), corner(high.x, low.y), corner(low.x, high.y))
            .map_err(|error| error.to_string())?;
        let screen = self.screen(name, ScreenSurface::Flat(flat));
        Ok(RegionView { warp: self.warp(fileset, "geometryWarpFile")?, ..RegionView::of(screen) })
    }

    /// Surface whose points are given for the raster's places.
    fn solid(&mut self, fileset: Option<Node<'a, 'a>>, name: &str) -> Result<RegionView, String> {
        let file = fileset.and_then(|set| xml::first(set, "geometryWarpFile"));
        let Some(path) = file.and_then(|file| xml::text(file, "path")) else {
            return Err("profile a3 needs its geometryWarpFile, and there is none".into());
        };
        self.place_head(file, DVec3::ZERO);
        // Axes of profile a3: y up, x to the left, z into the screen.
        let room_from_file = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, -1.0)) * self.metres(file);
        let surface = self.points(path, room_from_file)?;
        Ok(RegionView::of(self.screen(name, surface)))
    }

    /// Projector that lights a surface.
    fn shader_lamp(
        &mut self,
        region: Node<'a, 'a>,
        fileset: Option<Node<'a, 'a>>,
        name: &str,
    ) -> Result<RegionView, String> {
        let (turned, tangents) = frustum(region)?;
        let file = fileset.and_then(|set| xml::first(set, "geometryWarpFile"));
        let room_from_file = room_from_file(region)? * self.metres(file);
        let position_m = room_from_file * position(region)?;
        self.place_head(file, position_m);
        let screen = match file.and_then(|file| xml::text(file, "path")) {
            Some(path) => {
                let surface = self.points(path, room_from_file)?;
                self.screen(name, surface)
            }
            None => self.mesh_beside(room_from_file)?,
        };
        // The file's maps, or the projectors themselves, do all blending.
        self.display.projectors.push(Projector {
            name: name.to_owned(),
            position_m,
            room_from_projector: turned,
            lens: ProjectorLens::Pinhole(tangents),
            light: 1.0,
            gamma: None,
            even: false,
            blend: false,
        });
        let projector = Some(self.display.projectors.len() - 1);
        Ok(RegionView { projector, warp: self.warp(fileset, "distortionMap")?, ..RegionView::of(screen) })
    }

    /// Index of a new screen.
    fn screen(&mut self, name: &str, surface: ScreenSurface) -> usize {
        self.display.screens.push(Screen { name: name.to_owned(), surface, reflection: Reflection::default() });
        self.display.screens.len() - 1
    }

    /// Index of the screen that is the mesh beside the file, which is read for the first region that needs it.
    fn mesh_beside(&mut self, room_from_file: DMat3) -> Result<usize, String> {
        if let Some(known) = self.mesh {
            return Ok(known);
        }
        let path = &self.mesh_path;
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if !path.exists() {
            return Err(format!(
                "it has no geometryWarpFile; put the mesh that it lights beside the file, as {file:?}, in the file's axes and units"
            ));
        }
        let mesh =
            mesh_file::shape(path, room_from_file, self.maps.budget).map_err(|reason| format!("{file:?}: {reason}"))?;
        self.notice(format!("the projectors light the mesh of {file:?}"));
        let screen = self.screen("mesh", ScreenSurface::Mesh(Box::new(mesh)));
        self.mesh = Some(screen);
        Ok(screen)
    }

    /// Length of the file's unit, metres.
    fn metres(&mut self, file: Option<Node<'a, 'a>>) -> f64 {
        let unit = file.and_then(|file| xml::text(file, "geometricUnit")).unwrap_or("unknown");
        metres(unit).unwrap_or_else(|| {
            self.notice(format!("its geometric unit {unit:?} is not known: it is taken to be the metre"));
            1.0
        })
    }

    /// Puts the head where the file's origin says that it is. `otherwise` is the head's place if it does not say it.
    fn place_head(&mut self, file: Option<Node<'a, 'a>>, otherwise: DVec3) {
        let origin = file.and_then(|file| xml::text(file, "originOf3DData")).unwrap_or("unknown");
        let first = !std::mem::replace(&mut self.placed, true);
        match origin.to_ascii_lowercase().as_str() {
            "floorcenter" => self.display.viewer.head_m = HEAD_M,
            "idealeyepoint" => self.display.viewer.head_m = DVec3::ZERO,
            _ if self.profile == MpcdiProfile::ShaderLamps => {
                if first {
                    self.display.viewer.head_m = otherwise;
                    self.notice(
                        "the file does not say where the eye is: it is taken to be at the first projector; --head moves it"
                            .into(),
                    );
                }
            }
            _ => {
                self.display.viewer.head_m = otherwise;
                self.notice(format!("its origin is {origin:?}: the head is taken to be there"));
            }
        }
    }

    /// Surface from a file of points, brought into the room's axes and metres.
    fn points(&mut self, path: &str, room_from_file: DMat3) -> Result<ScreenSurface, String> {
        let bytes = self.files.read(path, self.maps.budget)?;
        let map = maps::grid(&bytes, self.maps.budget).map_err(|error| format!("{path:?}: {error}"))?;
        let point = |&[x, y, z]: &[f32; 3]| room_from_file * DVec3::new(f64::from(x), f64::from(y), f64::from(z));
        let rows = map.samples.chunks(map.width as usize).rev();
        let mesh = MeshSurface::grid(map.width, map.height, rows.flatten().map(point).collect());
        if !(mesh.size_m() > 0.0 && mesh.size_m().is_finite()) {
            return Err(format!("{path:?}: it has no points that are known and apart"));
        }
        Ok(ScreenSurface::Mesh(Box::new(mesh)))
    }

    fn notice(&mut self, notice: String) {
        if self.noticed.insert(notice.clone()) {
            self.display.notices.push(notice);
        }
    }

    /// Index of the flat screen that a 2d buffer's regions are parts of; it is added for the first of them.
    fn picture(&mut self, buffer: Node<'a, 'a>, region: Node<'a, 'a>, part: ChannelPart) -> Result<usize, String> {
        let name = xml::attribute(buffer, "id").unwrap_or("buffer").to_owned();
        if let Some(known) = self.pictures.get(&name) {
            return Ok(*known);
        }
        // The resolution of the whole is optional; that of the part says it, too.
        let whole = part.to - part.from;
        let side = |name: &str, share: f64| match xml::attribute(buffer, name) {
            Some(_) => xml::number(buffer, name),
            None => Ok(xml::number(region, name)? / share),
        };
        let (width, height) = (side("xResolution", whole.x)?, side("yResolution", whole.y)?);
        let size = DVec2::new(FLAT_WIDTH_M, FLAT_WIDTH_M * height / width);
        let centre = self.display.viewer.head_m - DVec3::Z * FLAT_DISTANCE_M;
        let flat =
            FlatSurface::from_centre(centre, size, DVec3::ZERO).map_err(|error| format!("buffer {name:?}: {error}"))?;
        let screen = self.screen(&name, ScreenSurface::Flat(flat));
        self.pictures.insert(name, screen);
        Ok(screen)
    }

    /// Warp of the kind of file, if the region has one.
    fn warp(&mut self, fileset: Option<Node<'a, 'a>>, kind: &'static str) -> Result<Option<Warp>, String> {
        let element = fileset.and_then(|set| xml::first(set, kind));
        let Some(path) = element.and_then(|element| xml::text(element, "path")) else { return Ok(None) };
        let Self { files, maps, .. } = self;
        let read = |budget: &Budget| files.read(path, budget).map_err(|reason| format!("{kind}: {reason}"));
        maps.warp(path, read, |error| format!("{kind} {path:?}: {error}")).map(|warp| Some(Warp::Grid(warp)))
    }

    /// Gains of the kind of file, if the region has one.
    fn gain(&mut self, fileset: Option<Node<'a, 'a>>, kind: &'static str) -> Result<Option<GainMap>, String> {
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
        let Self { files, maps, .. } = self;
        let read = |budget: &Budget| files.read(path, budget).map_err(|reason| format!("{kind}: {reason}"));
        maps.gain(path, gamma, read, |error| format!("{kind} {path:?}: {error}")).map(Some)
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
