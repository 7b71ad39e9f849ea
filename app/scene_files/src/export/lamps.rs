//! Lamps as lights of `KHR_lights_punctual`.

use ::gltf::json::Index;
use ::gltf::json::extensions::scene::Node as NodeExtensions;
use ::gltf::json::extensions::scene::khr_lights_punctual::{KhrLightsPunctual, Light, Spot, Type};
use ::gltf::json::validation::Checked;
use glam::{DQuat, DVec3};

use crate::gltf::file_json::NodeJson;
use crate::gltf::spectrum;
use scene::Lamp;

/// Node of a lamp, which shines along the node's −z; `light`: index into the file's lights.
pub fn lamp_node(light: usize, lamp: &Lamp) -> NodeJson {
    let khr_lights_punctual = Some(KhrLightsPunctual { light: Index::new(light as u32) });
    let turn = |spot: scene::Spot| DQuat::from_rotation_arc(DVec3::NEG_Z, spot.direction);
    NodeJson {
        name: Some(lamp.name.clone()),
        translation: Some(lamp.position.to_array()),
        rotation: lamp.spot.map(|spot| turn(spot).to_array()),
        extensions: Some(NodeExtensions { khr_lights_punctual, ..Default::default() }),
        ..NodeJson::default()
    }
}

/// Lamp as a glTF light in candela: its light at one metre, of which π lux show white as white.
pub fn light(lamp: &Lamp) -> Light {
    let spot =
        lamp.spot.map(|spot| Spot { inner_cone_angle: spot.inner_rad as f32, outer_cone_angle: spot.outer_rad as f32 });
    Light {
        name: Some(lamp.name.clone()),
        type_: Checked::Valid(if spot.is_some() { Type::Spot } else { Type::Point }),
        color: lamp.colour,
        intensity: std::f32::consts::PI,
        range: lamp.range.map(|range| range as f32),
        spot,
        extensions: None,
        extras: lamp.spectrum.as_ref().and_then(spectrum::to_extras),
    }
}
