//! The file's tables as they are written: every key, nothing resolved.

use serde::Deserialize;
use toml::{Spanned, Value};

/// A whole display file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub name: Option<String>,
    #[serde(default)]
    pub viewer: Option<Spanned<Viewer>>,
    #[serde(default)]
    pub screen: Vec<Spanned<Screen>>,
    #[serde(default)]
    pub window: Vec<Spanned<Window>>,
    #[serde(default)]
    pub channel: Vec<Spanned<Channel>>,
    pub tracker: Option<Value>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Viewer {
    pub eye_separation: Option<f64>,
    pub eye_scale: Option<f64>,
    pub head: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Screen {
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
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Window {
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
#[serde(deny_unknown_fields)]
pub(super) struct Channel {
    pub name: String,
    pub screen: String,
    pub eye: Option<String>,
    pub window: String,
    pub viewport: Option<[u32; 4]>,
    pub part: Option<[f64; 4]>,
}
