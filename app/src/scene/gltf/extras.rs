//! What a scene says beyond glTF: `extras.rapidity` of the scene and of its nodes, as `export` writes it.

use ::gltf::json::Extras;
use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

use crate::scene::{Lighting, Start};

/// How far a unit vector's squared length may be off before it is normalised: f32 rounding. Below that it is kept as written, so that a
/// scene which is saved and loaded stays the same to the bit.
const UNIT_TOLERANCE: f64 = 1e-6;

/// The vertex attribute, without its leading underscore, that has colours above 1 where glTF's own must be clamped.
pub(in crate::scene) const COLOURS: &str = "RAPIDITY_COLOR";

/// `extras.rapidity` of a glTF scene.
#[derive(Debug, Default, PartialEq)]
pub(in crate::scene) struct SceneExtras {
    pub(in crate::scene) origin: Option<[f64; 3]>,
    pub(in crate::scene) light: Option<Lighting>,
    pub(in crate::scene) start: Option<Start>,
    pub(in crate::scene) circuit: Vec<[f64; 3]>,
}

/// `extras.rapidity` of a glTF node.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(in crate::scene) struct NodeExtras {
    pub(in crate::scene) solid: Option<bool>,
}

/// The same as JSON: plain numbers.
#[derive(Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct SceneJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    origin: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    light: Option<LightJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<StartJson>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    circuit: Vec<[f64; 3]>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct LightJson {
    sun_direction: [f32; 3],
    sun: [f32; 3],
    sky: [f32; 3],
    ground: [f32; 3],
    zenith: [f32; 3],
    horizon: [f32; 3],
    shadows: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StartJson {
    position: [f64; 3],
    look: [f64; 3],
}

/// Extras may hold anything of anybody; only this key is ours.
#[derive(Serialize, Deserialize)]
struct Ours<T> {
    rapidity: T,
}

fn read<T: for<'a> Deserialize<'a> + Default>(extras: &Extras) -> Result<T, String> {
    let Some(text) = extras.as_deref().map(RawValue::get) else {
        return Ok(T::default());
    };
    match serde_json::from_str::<serde_json::Value>(text) {
        Ok(value) if value.get("rapidity").is_some() => {
            serde_json::from_str::<Ours<T>>(text).map(|ours| ours.rapidity).map_err(|error| error.to_string())
        }
        _ => Ok(T::default()),
    }
}

impl NodeExtras {
    pub(super) fn read(extras: &Extras) -> Result<Self, String> {
        read(extras)
    }

    pub(in crate::scene) fn to_json(&self) -> serde_json::Value {
        serde_json::json!({ "rapidity": self })
    }
}

impl SceneExtras {
    pub(super) fn read(extras: &Extras) -> Result<Self, String> {
        let json: SceneJson = read(extras)?;
        let unit = |vector: DVec3, name: &str| {
            let off = (vector.length_squared() - 1.0).abs();
            let unit = if off <= UNIT_TOLERANCE { Some(vector) } else { vector.try_normalize() };
            unit.ok_or_else(|| format!("{name} is no direction"))
        };
        let light = json.light.map(|light| {
            let colours = [light.sun, light.sky, light.ground, light.zenith, light.horizon];
            if !colours.as_flattened().iter().all(|value| value.is_finite()) {
                return Err("a colour of light is beyond all numbers".to_owned());
            }
            Ok(Lighting {
                sun_direction: unit(Vec3::from_array(light.sun_direction).as_dvec3(), "light.sunDirection")?.as_vec3(),
                sun: light.sun,
                sky: light.sky,
                ground: light.ground,
                zenith: light.zenith,
                horizon: light.horizon,
                shadows: light.shadows,
            })
        });
        let start = json.start.map(|start| {
            let look = unit(DVec3::from_array(start.look), "start.look")?;
            Ok::<_, String>(Start { position: DVec3::from_array(start.position), look })
        });
        Ok(Self { origin: json.origin, light: light.transpose()?, start: start.transpose()?, circuit: json.circuit })
    }

    pub(in crate::scene) fn to_json(&self) -> serde_json::Value {
        let light = self.light.map(|light| LightJson {
            sun_direction: light.sun_direction.to_array(),
            sun: light.sun,
            sky: light.sky,
            ground: light.ground,
            zenith: light.zenith,
            horizon: light.horizon,
            shadows: light.shadows,
        });
        let start =
            self.start.map(|start| StartJson { position: start.position.to_array(), look: start.look.to_array() });
        let json = SceneJson { origin: self.origin, light, start, circuit: self.circuit.clone() };
        serde_json::json!({ "rapidity": json })
    }
}
