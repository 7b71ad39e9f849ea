//! Tables of a display file as they are written: every key, nothing resolved.

use serde::Deserialize;
use toml::{Spanned, Value};

/// A whole display file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct DisplayTables {
    pub name: Option<String>,
    #[serde(default)]
    pub viewer: Option<Spanned<ViewerTable>>,
    #[serde(default)]
    pub screen: Vec<Spanned<ScreenTable>>,
    #[serde(default)]
    pub projector: Vec<Spanned<ProjectorTable>>,
    #[serde(default)]
    pub window: Vec<Spanned<WindowTable>>,
    #[serde(default)]
    pub channel: Vec<Spanned<ChannelTable>>,
    pub tracker: Option<Value>,
    pub bicycle: Option<Value>,
    pub trainer: Option<Value>,
    pub rider: Option<Value>,
    pub axes: Option<Value>,
    pub gamepad: Option<Value>,
    pub keys: Option<Value>,
}

impl DisplayTables {
    /// Tables about the rider's hardware, unchanged.
    pub(super) fn set_up(&self) -> toml::Table {
        let Self { bicycle, trainer, rider, axes, gamepad, keys, tracker, .. } = self;
        let tables = [
            ("bicycle", bicycle),
            ("trainer", trainer),
            ("rider", rider),
            ("axes", axes),
            ("gamepad", gamepad),
            ("keys", keys),
            ("tracker", tracker),
        ];
        tables.into_iter().filter_map(|(name, table)| Some((name.to_owned(), table.clone()?))).collect()
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct ViewerTable {
    pub eye_separation: Option<f64>,
    pub eye_scale: Option<f64>,
    pub head: Option<[f64; 3]>,
    pub turns_pictures: Option<bool>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct ScreenTable {
    pub name: String,
    pub lower_left: Option<[f64; 3]>,
    pub lower_right: Option<[f64; 3]>,
    pub upper_left: Option<[f64; 3]>,
    pub upper_right: Option<[f64; 3]>,
    pub centre: Option<[f64; 3]>,
    pub size: Option<[f64; 2]>,
    pub yaw: Option<f64>,
    pub pitch: Option<f64>,
    pub roll: Option<f64>,
    pub cylinder: Option<CylinderTable>,
    pub sphere: Option<SphereTable>,
    pub sweep: Option<SweepTable>,
    pub mesh: Option<String>,
    pub gloss: Option<f64>,
    pub gloss_exponent: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct CylinderTable {
    #[serde(default)]
    pub centre: [f64; 3],
    pub radius: f64,
    pub left: f64,
    pub right: f64,
    pub bottom: f64,
    pub top: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct SphereTable {
    #[serde(default)]
    pub centre: [f64; 3],
    pub radius: f64,
    pub left: Option<f64>,
    pub right: Option<f64>,
    pub bottom: Option<f64>,
    pub top: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct SweepTable {
    #[serde(default)]
    pub centre: [f64; 3],
    pub width: f64,
    pub profile: Vec<[f64; 2]>,
    pub bend: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct ProjectorTable {
    pub name: String,
    pub position: [f64; 3],
    pub yaw: Option<f64>,
    pub pitch: Option<f64>,
    pub roll: Option<f64>,
    pub lens: Option<String>,
    pub size: Option<[u32; 2]>,
    pub throw_ratio: Option<f64>,
    pub shift: Option<[f64; 2]>,
    pub tangents: Option<[f64; 4]>,
    pub step: Option<f64>,
    pub magnification: Option<f64>,
    pub table: Option<String>,
    pub light: Option<f64>,
    pub gamma: Option<f64>,
    pub even: Option<bool>,
    pub blend: Option<bool>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WindowTable {
    pub name: String,
    pub size: [u32; 2],
    pub monitor: Option<Value>,
    pub position: Option<[i32; 2]>,
    #[serde(default)]
    pub fullscreen: bool,
    pub combine: Option<String>,
    #[serde(default)]
    pub swap_eyes: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct ChannelTable {
    pub name: String,
    pub screen: String,
    pub eye: Option<String>,
    pub window: String,
    pub viewport: Option<[u32; 4]>,
    pub part: Option<[f64; 4]>,
    pub projector: Option<String>,
    pub corners: Option<CornersTable>,
    pub warp: Option<String>,
    pub alpha: Option<String>,
    pub alpha_gamma: Option<f64>,
    pub beta: Option<String>,
    pub beta_gamma: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct CornersTable {
    pub upper_left: Option<[f64; 2]>,
    pub upper_right: Option<[f64; 2]>,
    pub lower_right: Option<[f64; 2]>,
    pub lower_left: Option<[f64; 2]>,
}
