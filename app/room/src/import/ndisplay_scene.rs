//! Scene of an nDisplay file: screens, cameras and the tree of transforms that they hang in.

use crate::turning::room_from_turned;
use crate::viewer::EyeSide;
use glam::{DMat3, DVec2, DVec3};
use serde::Deserialize;
use serde_json::Value;
use std::collections::HashMap;

/// Largest distance between the eyes that is taken to be metres, in the file's unit. People have 6 cm.
const EYES_IN_METRES: f64 = 1.0;

/// Part of the scene as it is written.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct ScenePart {
    parent_id: String,
    location: UnrealVector,
    rotation: UnrealRotation,
    size: Option<UnrealSize>,
    interpupillary_distance: Option<f64>,
    swap_eyes: bool,
    stereo_offset: String,
}

/// Place in the file's axes: x ahead, y right, z up.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
struct UnrealVector {
    x: f64,
    y: f64,
    z: f64,
}

/// Rotation, degrees.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
struct UnrealRotation {
    pitch: f64,
    yaw: f64,
    roll: f64,
}

/// Size of a screen, the file's unit.
#[derive(Clone, Copy, Debug, Deserialize)]
struct UnrealSize {
    width: f64,
    height: f64,
}

/// Rotation and place of a part in the room's axes, metres.
#[derive(Clone, Copy, Debug)]
struct ScenePlace {
    turned: DMat3,
    place_m: DVec3,
}

/// Flat screen in the room's axes.
pub(super) struct NDisplayScreen {
    /// Rotation from the screen's axes (x right, y up, as the viewer sees them) to the room's.
    pub room_from_screen: DMat3,
    /// Middle of the screen, metres.
    pub place_m: DVec3,
    /// Width and height, metres.
    pub size_m: DVec2,
}

/// Point from which viewports are seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct NDisplayCamera {
    /// Place, room axes, metres.
    pub place_m: DVec3,
    /// Distance between the eyes, metres.
    pub eye_separation_m: Option<f64>,
    /// Eye for which the camera stands.
    pub eye: EyeSide,
}

/// Screens and cameras of a file.
pub(super) struct NDisplayScene {
    parts: HashMap<String, ScenePart>,
    places: HashMap<String, ScenePlace>,
    cameras: Vec<(String, NDisplayCamera)>,
    /// Indices of the cameras by their names.
    camera_names: HashMap<String, usize>,
    metres: f64,
    /// True if lengths are metres, not centimetres.
    pub in_metres: bool,
    /// True if a camera exchanges its eyes.
    pub swaps_eyes: bool,
}

impl NDisplayScene {
    /// Reads the scene, and places all of its parts. An error's text is worded to follow the file's name.
    pub fn read(scene: Option<&Value>) -> Result<Self, String> {
        let mut parts = HashMap::new();
        let mut camera_names = Vec::new();
        for (kind, group) in scene.and_then(Value::as_object).into_iter().flatten() {
            for (name, part) in group.as_object().into_iter().flatten() {
                let read = ScenePart::deserialize(part).map_err(|error| format!("scene.{kind}, {name:?}: {error}"))?;
                if kind.eq_ignore_ascii_case("cameras") {
                    camera_names.push(name.clone());
                }
                parts.insert(name.clone(), read);
            }
        }
        let cameras = || camera_names.iter().map(|name| &parts[name]);
        let in_metres = cameras()
            .filter_map(|camera| camera.interpupillary_distance)
            .any(|distance| distance > 0.0 && distance < EYES_IN_METRES);
        let swaps_eyes = cameras().any(|camera| camera.swap_eyes);
        let mut scene = Self {
            metres: if in_metres { 1.0 } else { 0.01 },
            places: HashMap::new(),
            cameras: Vec::new(),
            camera_names: HashMap::new(),
            parts,
            in_metres,
            swaps_eyes,
        };
        for name in camera_names {
            let (part, place) = (scene.parts[&name].clone(), scene.place(&name)?);
            let eye = match part.stereo_offset.to_ascii_lowercase().as_str() {
                "left" => EyeSide::Left,
                "right" => EyeSide::Right,
                _ => EyeSide::Centre,
            };
            let separation = part.interpupillary_distance.map(|distance| distance * scene.metres);
            let camera = NDisplayCamera {
                place_m: place.place_m,
                eye_separation_m: separation.filter(|distance_m| (0.0..=1.0).contains(distance_m)),
                eye,
            };
            scene.camera_names.insert(name.clone(), scene.cameras.len());
            scene.cameras.push((name, camera));
        }
        Ok(scene)
    }

    /// Camera by its name, or the first one; `None` if there is none.
    pub fn camera(&self, name: Option<&str>) -> Option<(String, NDisplayCamera)> {
        let known = name.and_then(|name| self.camera_names.get(name)).copied().unwrap_or(0);
        self.cameras.get(known).cloned()
    }

    /// Screen by its name; `None` if there is none with a size.
    pub fn screen(&mut self, name: &str) -> Result<Option<NDisplayScreen>, String> {
        let Some(size) = self.parts.get(name).and_then(|part| part.size) else { return Ok(None) };
        let ScenePlace { turned, place_m } = self.place(name)?;
        let size_m = DVec2::new(size.width, size.height) * self.metres;
        Ok(Some(NDisplayScreen { room_from_screen: turned, place_m, size_m }))
    }

    /// Place of a part in the room. Parents are placed first, each once.
    fn place(&mut self, name: &str) -> Result<ScenePlace, String> {
        let mut chain: Vec<String> = Vec::new();
        let mut at = name.to_owned();
        let mut placed = loop {
            if let Some(known) = self.places.get(&at) {
                break *known;
            }
            let Some(part) = self.parts.get(&at) else {
                if !at.is_empty() {
                    return Err(format!(
                        "{:?} in the scene hangs on {at:?}, which is not there",
                        chain[chain.len() - 1]
                    ));
                }
                break ScenePlace { turned: DMat3::IDENTITY, place_m: DVec3::ZERO };
            };
            if chain.len() > self.parts.len() {
                return Err(format!("{name:?} in the scene hangs on itself"));
            }
            let parent = part.parent_id.trim().to_owned();
            chain.push(std::mem::replace(&mut at, parent));
        };
        for name in chain.into_iter().rev() {
            let ScenePart { location, rotation, .. } = &self.parts[&name];
            let offset = DVec3::new(location.y, location.z, -location.x) * self.metres;
            let turned = room_from_turned(-rotation.yaw, rotation.pitch, -rotation.roll);
            placed = ScenePlace { turned: placed.turned * turned, place_m: placed.place_m + placed.turned * offset };
            self.places.insert(name, placed);
        }
        Ok(placed)
    }
}
