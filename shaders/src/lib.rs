//! WGSL and its Rust mirror: the structs that both sides share, the constants, and the sources. No GPU here.
//!
//! Rust owns every constant and writes the WGSL for it, so no number is typed twice; a struct shared with a
//! shader has the same name, fields and order in both, and `tests/mirror.rs` compares each offset and size by
//! naga's reflection and validates every module.
//!
//! A module is a list of files from `wgsl/`, concatenated: [`Module::source`].

mod layout;

use physics::colour::ShiftTable;

pub use layout::{Cut, Lighting, Map, Material, Pane, Resolve, View};

/// Bind group that holds [`View`], [`Lighting`] and the shadow map.
pub const VIEW_GROUP: u32 = 0;
/// Bind group that holds [`Material`] and its textures.
pub const MATERIAL_GROUP: u32 = 1;
/// How far, in shadow-map texels, the sun's shadow is smoothed.
pub const SHADOW_FILTER_TEXELS: f32 = 0.75;
/// Metres that a surface may lie behind the shadow map and still be lit.
pub const SHADOW_BIAS_M: f32 = 0.04;
/// Metres that the point looked up in the shadow map is moved off its surface, so that no surface shades itself.
pub const SHADOW_NORMAL_OFFSET_M: f32 = 0.06;

/// Nodes of the shift table over ln D; odd, so that D = 1 is one.
pub const SHIFT_NODES: u32 = ShiftTable::NODES as u32;
/// Luminance of linear sRGB red, green and blue (IEC 61966-2-1).
pub const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];
/// The largest value that a half float holds safely.
pub const HALF_LIMIT: f32 = 60_000.0;
/// The most looks along a stretched footprint in a panorama.
pub const PANORAMA_LOOKS: f32 = 16.0;

/// A shader module: an entry of [`MODULES`].
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// For labels and error messages.
    pub name: &'static str,
    files: &'static [&'static str],
}

impl Module {
    /// The module's WGSL: the constants, then its files in order.
    pub fn source(&self) -> String {
        let mut source = constants();
        for file in self.files {
            source.push_str(file);
        }
        source
    }
}

const ABERRATION: &str = include_str!("../wgsl/aberration.wgsl");
const SHARED: &str = include_str!("../wgsl/shared.wgsl");

const SHIFT: &str = include_str!("../wgsl/shift.wgsl");

/// Triangles of the photo-surface (or of the plain world) under sun and sky.
pub const SURFACE: Module =
    Module { name: "surface", files: &[SHARED, ABERRATION, SHIFT, include_str!("../wgsl/surface.wgsl")] };
/// The sky behind everything, per pixel.
pub const SKY: Module = Module { name: "sky", files: &[SHARED, ABERRATION, SHIFT, include_str!("../wgsl/sky.wgsl")] };
/// From the map of the world around the eye to what the observer sees.
pub const WARP: Module =
    Module { name: "warp", files: &[SHARED, ABERRATION, SHIFT, include_str!("../wgsl/warp.wgsl")] };
/// The sun's depth map, in the world frame.
pub const SHADOW: Module = Module { name: "shadow", files: &[SHARED, include_str!("../wgsl/shadow.wgsl")] };
/// Linear radiance to the screen's sRGB, and the mean of several samples.
pub const RESOLVE: Module = Module { name: "resolve", files: &[include_str!("../wgsl/resolve.wgsl")] };
/// The shared functions alone, called from a compute shader so that they can be held against their Rust twins.
pub const PROBE: Module = Module { name: "probe", files: &[ABERRATION, include_str!("../wgsl/probe.wgsl")] };

/// Every module, for validation.
pub const MODULES: [Module; 6] = [SURFACE, SKY, WARP, SHADOW, RESOLVE, PROBE];

/// The WGSL declarations of the constants above.
fn constants() -> String {
    let turn = std::f32::consts::TAU;
    let nodes_per_octave = f64::from(SHIFT_NODES - 1) * std::f64::consts::LN_2 / (2.0 * ShiftTable::LN_LIMIT);
    let [red, green, blue] = LUMINANCE;
    format!(
        "const SHADOW_FILTER_TEXELS: f32 = {SHADOW_FILTER_TEXELS:?};\n\
         const SHADOW_NORMAL_OFFSET_M: f32 = {SHADOW_NORMAL_OFFSET_M:?};\n\
         const SHIFT_NODES: u32 = {SHIFT_NODES}u;\n\
         const SHIFT_NODES_PER_OCTAVE: f32 = {nodes_per_octave:?};\n\
         const LUMINANCE: vec3<f32> = vec3({red:?}, {green:?}, {blue:?});\n\
         const HALF_LIMIT: f32 = {HALF_LIMIT:?};\n\
         const PANORAMA_LOOKS: f32 = {PANORAMA_LOOKS:?};\n\
         const TURN: f32 = {turn:?};\n"
    )
}
