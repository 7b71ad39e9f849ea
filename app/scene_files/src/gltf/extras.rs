//! Extras: the data of a scene beyond glTF, which `export` writes: `extras.rapidity` of the scene and of its nodes,
//! and a node's motion.

use ::gltf::json::Extras;
use glam::{DVec3, Vec3};
use physics::Celerity;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_json::value::RawValue;

use scene::{Lighting, Start};

/// Tolerance of a unit vector's squared length, for f32 rounding. Within it the vector is kept as written, so that a
/// scene which is saved and loaded stays the same to the bit; beyond it the vector is normalised.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Name, without its leading underscore, of the vertex attribute for colours above 1, which glTF's own must clamp.
pub(crate) const COLOURS: &str = "RAPIDITY_COLOR";

/// `extras.rapidity` of a glTF scene.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct SceneExtras {
    pub(crate) origin: Option<[f64; 3]>,
    pub(crate) light: LightExtras,
    /// Luminance that is shown as white, cd/m².
    pub(crate) white: Option<f64>,
    /// Panorama: name of a file beside the scene, or a picture within it.
    pub(crate) panorama: Option<Value>,
    pub(crate) start: Option<Start>,
    pub(crate) circuit: Vec<[f64; 3]>,
}

/// `extras.rapidity` of a glTF node.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct NodeExtras {
    pub(crate) solid: Option<bool>,
}

/// Scene extras as JSON: plain numbers.
#[derive(Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct SceneJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    origin: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    light: Option<LightExtras>,
    #[serde(skip_serializing_if = "Option::is_none")]
    white: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    panorama: Option<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<StartJson>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    circuit: Vec<[f64; 3]>,
}

/// Contents of `light` in a scene's `extras.rapidity`; missing fields leave the light as it is.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(crate) struct LightExtras {
    #[serde(skip_serializing_if = "Option::is_none")]
    sun_direction: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sun: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sky: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ground: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    zenith: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    horizon: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shadows: Option<bool>,
    /// Spectrum as it stands in the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spectrum: Option<Value>,
}

impl LightExtras {
    /// Extras with all of a scene's light; `spectrum` as `spectrum::to_json` writes it.
    pub(crate) fn of(light: Lighting, spectrum: Option<Value>) -> Self {
        Self {
            sun_direction: Some(light.sun_direction.to_array()),
            sun: Some(light.sun),
            sky: Some(light.sky),
            ground: Some(light.ground),
            zenith: Some(light.zenith),
            horizon: Some(light.horizon),
            shadows: Some(light.shadows),
            spectrum,
        }
    }

    /// Changes the parts of the light that the file mentions.
    pub(super) fn apply(&self, light: &mut Lighting) {
        let Lighting { sun_direction, sun, sky, ground, zenith, horizon, shadows } = light;
        *sun_direction = self.sun_direction.map_or(*sun_direction, Vec3::from_array);
        for (ours, theirs) in
            [(sun, self.sun), (sky, self.sky), (ground, self.ground), (zenith, self.zenith), (horizon, self.horizon)]
        {
            *ours = theirs.unwrap_or(*ours);
        }
        *shadows = self.shadows.unwrap_or(*shadows);
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StartJson {
    position: [f64; 3],
    look: [f64; 3],
}

/// Extras may hold other programs' data; only the key `rapidity` is read.
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

/// Extras with this value.
pub(crate) fn to_extras(value: &Value) -> Extras {
    Some(serde_json::value::to_raw_value(value).expect("a JSON value is JSON"))
}

/// Celerity of a node, `extras.celerity`, γβ along the world's axes, and `extras.at`, the world time (metres of light
/// travel, default 0) at which the node is where the file has it. `None` if there is no celerity; `at` alone belongs
/// to another program.
///
/// # Errors
/// The faulty key, and what is wrong with it.
pub(super) fn celerity(extras: &Extras) -> Result<Option<(Celerity, f64)>, (&'static str, String)> {
    let value = extras.as_deref().and_then(|text| serde_json::from_str::<Value>(text.get()).ok()).unwrap_or_default();
    let Some(celerity) = value.get("celerity") else { return Ok(None) };
    let numbers: Option<Vec<f64>> = celerity.as_array().and_then(|list| list.iter().map(Value::as_f64).collect());
    let celerity = numbers
        .and_then(|numbers| <[f64; 3]>::try_from(numbers).ok())
        .and_then(|numbers| Celerity::new(DVec3::from_array(numbers)).ok())
        .ok_or_else(|| {
            ("celerity", format!("expected three finite numbers, γβ along the world's x, y and z, not {celerity}"))
        })?;
    let at = value.get("at").map_or(Some(0.0), |at| at.as_f64().filter(|at| at.is_finite()));
    let at = at.ok_or_else(|| {
        ("at", format!("expected a time in metres of light travel, a finite number, not {}", value["at"]))
    })?;
    Ok(Some((celerity, at)))
}

impl NodeExtras {
    pub(super) fn read(extras: &Extras) -> Result<Self, String> {
        read(extras)
    }

    /// Extras of a node to be written.
    pub(crate) fn to_extras(&self) -> Extras {
        to_extras(&serde_json::json!({ "rapidity": self }))
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
        let mut light = json.light.unwrap_or_default();
        let colours = [light.sun, light.sky, light.ground, light.zenith, light.horizon];
        if !colours.into_iter().flatten().flatten().all(f32::is_finite) {
            return Err("a colour of light is beyond all numbers".to_owned());
        }
        if let Some(direction) = &mut light.sun_direction {
            *direction = unit(Vec3::from_array(*direction).as_dvec3(), "light.sunDirection")?.as_vec3().to_array();
        }
        if let Some(white) = json.white.filter(|white| !(white.is_finite() && *white > 0.0)) {
            return Err(format!("white: expected a luminance in cd/m², a number above 0, not {white}"));
        }
        let start = json.start.map(|start| {
            let look = unit(DVec3::from_array(start.look), "start.look")?;
            Ok::<_, String>(Start { position: DVec3::from_array(start.position), look })
        });
        Ok(Self {
            origin: json.origin,
            light,
            white: json.white,
            panorama: json.panorama,
            start: start.transpose()?,
            circuit: json.circuit,
        })
    }

    /// Extras of a scene to be written.
    pub(crate) fn into_extras(self) -> Extras {
        let start =
            self.start.map(|start| StartJson { position: start.position.to_array(), look: start.look.to_array() });
        let (origin, light, white) = (self.origin, Some(self.light), self.white);
        let json = SceneJson { origin, light, white, panorama: self.panorama, start, circuit: self.circuit };
        to_extras(&serde_json::json!({ "rapidity": json }))
    }
}
