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

/// Largest coordinate of a start, metres: the square of a longer way overflows.
const FARTHEST_M: f64 = 1e100;

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
    /// Speed of light for which the scene is made, m/s.
    pub(crate) speed_of_light: Option<f64>,
    pub(crate) circuit: Vec<[f64; 3]>,
}

/// `extras.rapidity` of a glTF node.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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
    #[serde(skip_serializing_if = "Option::is_none")]
    speed_of_light: Option<f64>,
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
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct StartJson {
    position: [f64; 3],
    look: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    up: Option<[f64; 3]>,
    /// Height of the eye above the position, metres; that of a standing person if it is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    eye_height: Option<f64>,
    /// Vertical field of view, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    field_of_view: Option<f64>,
}

impl StartJson {
    /// JSON of a start; values that are the usual ones are left out.
    fn of(start: &Start) -> Self {
        let usual = Start::default();
        Self {
            position: start.position.to_array(),
            look: start.look.to_array(),
            up: (start.up != usual.up).then_some(start.up.to_array()),
            eye_height: (start.eye_height_m != usual.eye_height_m).then_some(start.eye_height_m),
            field_of_view: start.field_of_view_rad.map(f64::to_degrees),
        }
    }

    fn start(self) -> Result<Start, String> {
        let usual = Start::default();
        let (look, up) = (unit(self.look, "start.look")?, self.up.map(|up| unit(up, "start.up")).transpose()?);
        let eye_height_m = self.eye_height.unwrap_or(usual.eye_height_m);
        if !(eye_height_m.is_finite() && eye_height_m >= 0.0) {
            return Err(format!("start.eyeHeight: expected metres, 0 or more, not {eye_height_m}"));
        }
        if let Some(fov) = self.field_of_view.filter(|fov| !(1.0..=170.0).contains(fov)) {
            return Err(format!("start.fieldOfView: expected degrees from 1 to 170, not {fov}"));
        }
        let position = DVec3::from_array(self.position);
        if position.abs().max_element() > FARTHEST_M {
            return Err(format!("start.position: expected numbers up to {FARTHEST_M:e}"));
        }
        let field_of_view_rad = self.field_of_view.map(f64::to_radians);
        Ok(Start { position, look, up: up.unwrap_or(usual.up), eye_height_m, field_of_view_rad })
    }
}

/// Unit vector of a direction in the file.
fn unit(vector: [f64; 3], name: &str) -> Result<DVec3, String> {
    let vector = DVec3::from_array(vector);
    let off = (vector.length_squared() - 1.0).abs();
    let unit = if off <= UNIT_TOLERANCE { Some(vector) } else { vector.try_normalize() };
    unit.ok_or_else(|| format!("{name} is no direction"))
}

/// Extras may hold other programs' data; only the keys of this program are read. The others are passed over without
/// being understood: they may be nested to any depth, or hold numbers of any size.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct OwnExtras {
    #[serde(deserialize_with = "even_null")]
    pub(super) rapidity: Option<Box<RawValue>>,
    #[serde(deserialize_with = "even_null")]
    pub(super) celerity: Option<Box<RawValue>>,
    #[serde(deserialize_with = "even_null")]
    pub(super) at: Option<Box<RawValue>>,
    #[serde(deserialize_with = "even_null")]
    pub(super) spectrum: Option<Box<RawValue>>,
}

/// Value of a key that is present, `null` included: a mistake there must be told.
fn even_null<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Option<Box<RawValue>>, D::Error> {
    Box::<RawValue>::deserialize(deserializer).map(Some)
}

impl OwnExtras {
    /// Values of this program's keys, if the extras are an object.
    ///
    /// # Errors
    /// Fault of an object that cannot be read, such as a key that stands there twice.
    pub(super) fn of(extras: &Extras) -> Result<Self, String> {
        let Some(text) = extras.as_deref().map(RawValue::get).filter(|text| text.trim_start().starts_with('{')) else {
            return Ok(Self::default());
        };
        serde_json::from_str(text).map_err(|error| error.to_string())
    }
}

fn read<T: for<'a> Deserialize<'a> + Default>(extras: &Extras) -> Result<T, String> {
    match OwnExtras::of(extras)?.rapidity {
        Some(own) => serde_json::from_str(own.get()).map_err(|error| error.to_string()),
        None => Ok(T::default()),
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
    let own = OwnExtras::of(extras).map_err(|fault| ("", fault))?;
    let Some(celerity) = own.celerity else { return Ok(None) };
    let expected = "expected three finite numbers, γβ along the world's x, y and z";
    let numbers: Option<[f64; 3]> = serde_json::from_str(celerity.get()).ok();
    let celerity = numbers
        .and_then(|numbers| Celerity::new(DVec3::from_array(numbers)).ok())
        .ok_or_else(|| ("celerity", format!("{expected}, not {}", shortened(celerity.get()))))?;
    let at = own.at.map_or(Some(0.0), |at| serde_json::from_str::<f64>(at.get()).ok().filter(|at| at.is_finite()));
    let at = at.ok_or_else(|| ("at", "expected a time in metres of light travel, a finite number".to_owned()))?;
    Ok(Some((celerity, at)))
}

/// Beginning of a text, for messages.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 80;
    let mut short: String = text.chars().take(LONGEST).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short
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
        let mut light = json.light.unwrap_or_default();
        let colours = [light.sun, light.sky, light.ground, light.zenith, light.horizon];
        if !colours.into_iter().flatten().flatten().all(|channel| channel.is_finite() && channel >= 0.0) {
            return Err("a colour of light is negative or beyond all numbers".to_owned());
        }
        if let Some(direction) = &mut light.sun_direction {
            *direction = unit(direction.map(f64::from), "light.sunDirection")?.as_vec3().to_array();
        }
        if let Some(white) = json.white.filter(|white| !(white.is_finite() && *white > 0.0)) {
            return Err(format!("white: expected a luminance in cd/m², a number above 0, not {white}"));
        }
        if let Some(speed) = json.speed_of_light.filter(|speed| !(speed.is_finite() && *speed > 0.0)) {
            return Err(format!("speedOfLight: expected metres per second, a number above 0, not {speed}"));
        }
        let start = json.start.map(StartJson::start);
        Ok(Self {
            origin: json.origin,
            light,
            white: json.white,
            panorama: json.panorama,
            start: start.transpose()?,
            speed_of_light: json.speed_of_light,
            circuit: json.circuit,
        })
    }

    /// Extras of a scene to be written.
    pub(crate) fn into_extras(self) -> Extras {
        let json = SceneJson {
            origin: self.origin,
            light: Some(self.light),
            white: self.white,
            panorama: self.panorama,
            start: self.start.as_ref().map(StartJson::of),
            speed_of_light: self.speed_of_light,
            circuit: self.circuit,
        };
        to_extras(&serde_json::json!({ "rapidity": json }))
    }
}
