//! WGSL and its Rust mirror: the structs that both sides share, the constants, and the sources. No GPU here.
//!
//! Rust owns every constant and writes the WGSL for it, so no number is typed twice; a struct shared with a
//! shader has the same name, fields and order in both, and `tests/mirror.rs` compares each offset and size by
//! naga's reflection and validates every module.
//!
//! A module is a list of files from `wgsl/`, concatenated: [`Module::source`].

mod layout;

pub use layout::{Lighting, Material, Resolve, View};

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

/// Triangles of the photo-surface (or of the plain world) under sun and sky.
pub const SURFACE: Module = Module { name: "surface", files: &[SHARED, include_str!("../wgsl/surface.wgsl")] };
/// The sky behind everything, per pixel.
pub const SKY: Module = Module { name: "sky", files: &[SHARED, ABERRATION, include_str!("../wgsl/sky.wgsl")] };
/// The sun's depth map, in the world frame.
pub const SHADOW: Module = Module { name: "shadow", files: &[SHARED, include_str!("../wgsl/shadow.wgsl")] };
/// Linear radiance to the screen's sRGB, and the mean of several samples.
pub const RESOLVE: Module = Module { name: "resolve", files: &[include_str!("../wgsl/resolve.wgsl")] };
/// The shared functions alone, called from a compute shader so that they can be held against their Rust twins.
pub const PROBE: Module = Module { name: "probe", files: &[ABERRATION, include_str!("../wgsl/probe.wgsl")] };

/// Every module, for validation.
pub const MODULES: [Module; 5] = [SURFACE, SKY, SHADOW, RESOLVE, PROBE];

/// The WGSL declarations of the constants above.
fn constants() -> String {
    format!(
        "const SHADOW_FILTER_TEXELS: f32 = {SHADOW_FILTER_TEXELS:?};\n\
         const SHADOW_NORMAL_OFFSET_M: f32 = {SHADOW_NORMAL_OFFSET_M:?};\n"
    )
}
