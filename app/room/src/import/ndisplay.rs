//! Unreal Engine's nDisplay: a cluster's nodes with their windows, viewports, and the flat screens that they show.
//!
//! *Frames.* The file's axes are left-handed: x ahead, y to the right, z up. Rotations turn yaw to the right, pitch up
//! and roll clockwise, in this order, each about the axes as the turns before have left them. Lengths are centimetres,
//! or metres in files of which the distance between the eyes says so.

use super::blank::blank;
use super::file_name::TakenNames;
use super::letters;
use super::ndisplay_scene::{NDisplayScene, NDisplayScreen};
use crate::channel::{Channel, ChannelPart};
use crate::display::{Display, Screen};
use crate::reflection::Reflection;
use crate::surface::flat::FlatSurface;
use crate::surface::shape::ScreenSurface;
use crate::viewer::EyeSide;
use crate::window::{Combine, WindowPlace};
use glam::{DVec2, DVec3};
use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::HashMap;

/// Largest side of a window, pixels.
const MAX_PIXELS: i64 = 1 << 16;

/// Rectangle in pixels.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
struct PixelRectangle {
    x: f64,
    y: f64,
    w: f64,
    h: f64,
}

/// Reads a file. An error's text is worded to follow the file's name.
pub(crate) fn parse(bytes: &[u8]) -> Result<Display, String> {
    let text = letters::text(bytes);
    let value: Value = serde_json::from_str(&text).map_err(|error| format!("it is no JSON: {error}"))?;
    let root = member(&value, "nDisplay").unwrap_or(&value);
    let nodes = member(root, "cluster").and_then(|cluster| member(cluster, "nodes")).and_then(Value::as_object);
    let nodes = nodes.ok_or("it has no nDisplay.cluster.nodes, so there is no window")?;
    let scene = NDisplayScene::read(member(root, "scene"))?;
    let mut import = NDisplayImport {
        display: blank(DVec3::ZERO),
        screens: HashMap::new(),
        camera: None,
        names: TakenNames::default(),
        scene,
    };
    import.nodes(nodes)?;
    if import.display.channels.is_empty() {
        let first = import.display.notices.into_iter().next();
        return Err(first.unwrap_or("none of its nodes has a viewport, so there is nothing to show".into()));
    }
    Ok(import.finish(nodes))
}

/// Member of an object by its name, in upper or lower case.
fn member<'a>(value: &'a Value, name: &str) -> Option<&'a Value> {
    let object = value.as_object()?;
    object.get(name).or_else(|| object.iter().find(|(key, _)| key.eq_ignore_ascii_case(name)).map(|(_, value)| value))
}

fn word<'a>(value: &'a Value, name: &str) -> Option<&'a str> {
    member(value, name)?.as_str().map(str::trim).filter(|text| !text.is_empty())
}

/// A display under construction.
struct NDisplayImport {
    display: Display,
    scene: NDisplayScene,
    /// Indices of the display's screens by the file's names.
    screens: HashMap<String, usize>,
    /// Name of the camera at which the head is.
    camera: Option<String>,
    names: TakenNames,
}

impl NDisplayImport {
    fn notice(&mut self, notice: String) {
        self.display.notices.push(notice);
    }

    /// Adds the windows and viewports of all nodes.
    fn nodes(&mut self, nodes: &Map<String, Value>) -> Result<(), String> {
        for (id, node) in nodes {
            let Some(viewports) = member(node, "viewports").and_then(Value::as_object).filter(|all| !all.is_empty())
            else {
                self.notice(format!("node {id:?} has no viewports: it is left out"));
                continue;
            };
            let place = rectangle(member(node, "window")).map_err(|reason| format!("node {id:?}, window: {reason}"))?;
            let size = [place.w, place.h].map(|side| side as i64);
            if size.iter().any(|side| !(1..=MAX_PIXELS).contains(side)) {
                return Err(format!(
                    "node {id:?}, window: {} × {} pixels are no window; each side must be 1 to {MAX_PIXELS}",
                    place.w, place.h
                ));
            }
            let size = size.map(|side| side as u32);
            let window = self.display.windows.len();
            let before = self.display.channels.len();
            for (name, viewport) in viewports {
                self.viewport(name, viewport, window, size)?;
            }
            if self.display.channels.len() == before {
                continue;
            }
            let name = self.names.file_name(&format!("window {id}"));
            self.display.windows.push(WindowPlace {
                name,
                monitor: None,
                position: Some([place.x as i32, place.y as i32]),
                size,
                fullscreen: member(node, "fullScreen").and_then(Value::as_bool).unwrap_or(false),
                combine: Combine::None,
                swap_eyes: false,
            });
        }
        Ok(())
    }

    /// Adds a viewport's channel, or a notice of why there is none.
    fn viewport(&mut self, id: &str, viewport: &Value, window: usize, size: [u32; 2]) -> Result<(), String> {
        let wrong = |reason: String| format!("viewport {id:?}: {reason}");
        if member(viewport, "enabled").and_then(Value::as_bool) == Some(false) {
            self.notice(wrong("it is not enabled, so it is left out".into()));
            return Ok(());
        }
        let region = rectangle(member(viewport, "region")).map_err(|reason| wrong(format!("region: {reason}")))?;
        let sides = [region.x, region.y, region.w, region.h];
        let fits = region.x >= 0.0
            && region.y >= 0.0
            && region.w >= 1.0
            && region.h >= 1.0
            && region.x + region.w <= f64::from(size[0])
            && region.y + region.h <= f64::from(size[1]);
        if !fits {
            self.notice(wrong(format!(
                "its region {sides:?} is not inside its window of {} × {} pixels, so it is left out",
                size[0], size[1]
            )));
            return Ok(());
        }
        let rectangle = sides.map(|side| side as u32);
        let eye = self.look_through(word(viewport, "camera"));
        let policy = member(viewport, "projectionPolicy").unwrap_or(&Value::Null);
        let Some(screen) = self.screen(id, policy, region.w / region.h)? else { return Ok(()) };
        let name = self.names.file_name(id);
        self.display.channels.push(Channel {
            name,
            screen,
            eye,
            window,
            viewport: rectangle,
            part: ChannelPart::default(),
            warp: None,
            projector: None,
            alpha: None,
            beta: None,
        });
        Ok(())
    }

    /// Eye of a viewport's camera. The head is at the first camera that a viewport names.
    fn look_through(&mut self, camera: Option<&str>) -> EyeSide {
        let Some((name, camera)) = self.scene.camera(camera) else { return EyeSide::Centre };
        let eye = camera.eye;
        match &self.camera {
            None => {
                self.display.viewer.head_m = camera.place_m;
                if let Some(separation_m) = camera.eye_separation_m {
                    self.display.viewer.eye_separation_m = separation_m;
                }
                self.camera = Some(name);
            }
            Some(known) if *known != name && camera.place_m != self.display.viewer.head_m => {
                let notice =
                    format!("camera {name:?} is elsewhere: all viewports are drawn for the head at camera {known:?}");
                if !self.display.notices.contains(&notice) && self.display.notices.len() < 1000 {
                    self.display.notices.push(notice);
                }
            }
            Some(_) => {}
        }
        eye
    }

    /// Index of the screen that a viewport shows; `None`, with a notice, if its policy cannot be followed.
    fn screen(&mut self, id: &str, policy: &Value, aspect: f64) -> Result<Option<usize>, String> {
        let kind = word(policy, "type").unwrap_or("none").to_ascii_lowercase();
        let parameters = member(policy, "parameters").unwrap_or(&Value::Null);
        let named = ["screen", "mesh_component", "component"].into_iter().find_map(|key| word(parameters, key));
        let left_out = match kind.as_str() {
            "simple" => {
                let name = named.ok_or_else(|| format!("viewport {id:?}: its policy \"simple\" names no screen"))?;
                let screen = self.scene.screen(name)?;
                let screen = screen.ok_or_else(|| format!("viewport {id:?}: there is no screen {name:?}"))?;
                return self.flat(name, &screen).map(Some);
            }
            "mesh" => match named {
                // A mesh that is called as one of the file's screens is that rectangle.
                Some(name) => match self.scene.screen(name)? {
                    Some(screen) => return self.flat(name, &screen).map(Some),
                    None => format!("its mesh {name:?} is in the engine's project, not in this file"),
                },
                None => "its mesh is in the engine's project, not in this file".into(),
            },
            "camera" => {
                let half = (0.5 * FIELD_DEG).to_radians().tan();
                let size = DVec2::new(2.0 * half * aspect, 2.0 * half);
                let flat = FlatSurface::from_centre(self.display.viewer.head_m + DVec3::NEG_Z, size, DVec3::ZERO)
                    .map_err(|error| format!("viewport {id:?}: {error}"))?;
                self.notice(format!(
                    "viewport {id:?}: its camera is in the engine's project: it shows an ordinary view straight ahead, {FIELD_DEG}° high"
                ));
                return Ok(Some(self.push(id.to_owned(), flat)));
            }
            "mpcdi" => match word(parameters, "file") {
                Some(file) => format!("it is described by the MPCDI file {file:?}, which can be used by itself"),
                None => "it is described by an MPCDI file, which can be used by itself".into(),
            },
            other => format!("its projection policy {other:?} is not read"),
        };
        self.notice(format!("viewport {id:?}: {left_out}; it is left out"));
        Ok(None)
    }

    fn flat(&mut self, name: &str, screen: &NDisplayScreen) -> Result<usize, String> {
        if let Some(known) = self.screens.get(name) {
            return Ok(*known);
        }
        let (right, up) =
            (screen.room_from_screen.x_axis * screen.size_m.x, screen.room_from_screen.y_axis * screen.size_m.y);
        let corner = screen.place_m - 0.5 * (right + up);
        let flat = FlatSurface::from_corners(corner, corner + right, corner + up)
            .map_err(|error| format!("screen {name:?}: {error}"))?;
        let index = self.push(name.to_owned(), flat);
        self.screens.insert(name.to_owned(), index);
        Ok(index)
    }

    fn push(&mut self, name: String, flat: FlatSurface) -> usize {
        self.display.screens.push(Screen {
            name,
            surface: ScreenSurface::Flat(flat),
            reflection: Reflection::default(),
        });
        self.display.screens.len() - 1
    }

    /// Display with the notices that concern all of it.
    fn finish(mut self, nodes: &Map<String, Value>) -> Display {
        let mut hosts: Vec<&str> = nodes.values().filter_map(|node| word(node, "host")).collect();
        hosts.sort_unstable();
        hosts.dedup();
        if hosts.len() > 1 {
            self.notice(format!("its nodes run on {} hosts: all windows are opened on this machine", hosts.len()));
        }
        if self.scene.in_metres {
            self.notice(
                "its eyes are less than 1 apart, so its lengths are taken to be metres, not centimetres".into(),
            );
        }
        if self.scene.swaps_eyes {
            self.notice("swapEyes is not followed: exchange left and right where the stereo picture is made".into());
        }
        self.display
    }
}

/// Vertical field of view of a camera that is not in the file, degrees: that of this program's windows.
const FIELD_DEG: f64 = 60.0;

fn rectangle(value: Option<&Value>) -> Result<PixelRectangle, String> {
    let value = value.ok_or("it is not there")?;
    let found = PixelRectangle::deserialize(value).map_err(|error| error.to_string())?;
    let whole = |side: f64| side.is_finite() && side.abs() <= 1e9;
    if [found.x, found.y, found.w, found.h].into_iter().all(whole) {
        Ok(found)
    } else {
        Err("its numbers are too large".into())
    }
}
