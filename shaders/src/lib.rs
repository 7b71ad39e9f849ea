//! WGSL and its Rust mirror: the structs that both sides share, the constants, and the sources. No GPU here.
//!
//! Rust owns every constant and writes the WGSL for it, so no number is typed twice; a struct shared with a
//! shader has the same name, fields and order in both, and `tests/mirror.rs` compares each offset and size by
//! naga's reflection and validates every module.
//!
//! A module is a list of files from `wgsl/`, concatenated: [`Module::source`].

mod layout;

pub use layout::{Accumulate, Adaptation, Lighting, Map, Material, Metering, Pane, View};

use glam::DVec3;
use physics::colour::{ShiftTable, luminance};

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

/// Values above it are taken for it: its square is still a finite f32.
pub const BRIGHTEST: f32 = (1_u64 << 60) as f32;
/// Luminances below it are taken for black.
pub const DARKEST: f32 = 1e-30;
/// Base-2 logarithm of the largest factor that exposure multiplies with, and of its inverse.
pub const LARGEST_LOG2: f32 = 120.0;

/// Columns and rows of the pixels that the light meter looks at; a smaller picture is looked at whole.
///
/// Fewer than 2¹⁶ in all, so that a sum of 16-bit fractions over them fits 32 bits.
pub const METER_GRID: [u32; 2] = [256, 144];
/// Side of the square of pixels that a group of threads looks at.
pub const METER_WORKGROUP: u32 = 16;
/// Bins of a light meter's histogram.
pub const METER_BINS: u32 = 1024;
/// Bins for each doubling.
pub const METER_BINS_PER_OCTAVE: f32 = 4.0;
/// Doublings from 1 to either end of the histogram.
pub const METER_OCTAVES: f32 = METER_BINS as f32 / METER_BINS_PER_OCTAVE / 2.0;
/// Doublings below the brightest gain that the mean gain reaches down to.
pub const METER_REACH: f32 = 8.0;
/// Share of the samples that the mean gain leaves out at either end.
pub const METER_TRIM_PERCENT: u32 = 10;
/// Share of the samples that are darker than what is shown as white.
pub const METER_BRIGHT_PERCENT: u32 = 99;

/// Doublings between the darkest and the brightest that a screen shows, for the histogram's curve: 1000 : 1.
pub const SCREEN_OCTAVES: f32 = 10.0;
/// How often the histogram is cut at its ceiling.
pub const HISTOGRAM_PASSES: u32 = 32;
/// Share of the samples below which a histogram that is cut has nothing left: the screen has the frame's range anyway.
pub const HISTOGRAM_TOLERANCE: f32 = 0.025;

/// No curve: what is brighter than the screen is cut off.
pub const TONE_LINEAR: u32 = 0;
/// Extended Reinhard.
pub const TONE_REINHARD: u32 = 1;
/// 1 − e^(−L).
pub const TONE_EXPONENTIAL: u32 = 2;
/// As film has it.
pub const TONE_FILMIC: u32 = 3;
/// Histogram adjustment.
pub const TONE_HISTOGRAM: u32 = 4;
/// L (a L + b) / (L (c L + d) + e), the fit by K. Narkowicz, "ACES filmic tone mapping curve", 2016.
pub const FILMIC: [f32; 5] = [2.51, 0.03, 2.43, 0.59, 0.14];

/// Desaturation at constant luminance.
pub const GAMUT_DESATURATE: u32 = 0;
/// Adding white, then darkening.
pub const GAMUT_WHITE: u32 = 1;
/// Each channel by itself.
pub const GAMUT_CLAMP: u32 = 2;

/// Nodes of the shift table over ln D; odd, so that D = 1 is one.
pub const SHIFT_NODES: u32 = ShiftTable::NODES as u32;
/// Cells along each side of a quarter of a face of the image renderer's map, and of a cell that is cut further; a power of two.
pub const MAP_CELLS: u32 = 16;
/// The largest value that a half float holds safely.
pub const HALF_LIMIT: f32 = 60_000.0;
/// Stands for each coordinate of a vertex that the CPU leaves to the vertex stage.
pub const NOT_BENT: f32 = 3e38;
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
const FULLSCREEN: &str = include_str!("../wgsl/fullscreen.wgsl");
const RADIANCE: &str = include_str!("../wgsl/radiance.wgsl");
const SHARED: &str = include_str!("../wgsl/shared.wgsl");

const PHOTO_SURFACE: &str = include_str!("../wgsl/photo_surface.wgsl");
const SHIFT: &str = include_str!("../wgsl/shift.wgsl");

/// Triangles of the photo-surface (or of the plain world) under sun and sky.
pub const SURFACE: Module = Module {
    name: "surface",
    files: &[SHARED, ABERRATION, SHIFT, PHOTO_SURFACE, include_str!("../wgsl/surface.wgsl")],
};
/// The sky behind everything, per pixel.
pub const SKY: Module = Module { name: "sky", files: &[SHARED, ABERRATION, SHIFT, include_str!("../wgsl/sky.wgsl")] };
/// From the map of the world around the eye to what the observer sees.
pub const WARP: Module =
    Module { name: "warp", files: &[SHARED, ABERRATION, SHIFT, include_str!("../wgsl/warp.wgsl")] };
/// The sun's depth map, in the world frame.
pub const SHADOW: Module = Module { name: "shadow", files: &[SHARED, include_str!("../wgsl/shadow.wgsl")] };
/// The mean of several samples.
pub const ACCUMULATE: Module =
    Module { name: "accumulate", files: &[FULLSCREEN, include_str!("../wgsl/accumulate.wgsl")] };
/// Radiance as it is.
pub const COPY: Module = Module { name: "copy", files: &[FULLSCREEN, include_str!("../wgsl/copy.wgsl")] };
/// What the eye adapts to: exposure, white and the histogram's curve.
pub const METER: Module = Module {
    name: "meter",
    files: &[
        RADIANCE,
        include_str!("../wgsl/meter.wgsl"),
        include_str!("../wgsl/expose.wgsl"),
        include_str!("../wgsl/equalise.wgsl"),
    ],
};
/// Linear radiance to the screen's sRGB.
pub const DISPLAY: Module = Module {
    name: "display",
    files: &[
        FULLSCREEN,
        RADIANCE,
        include_str!("../wgsl/tone.wgsl"),
        include_str!("../wgsl/gamut.wgsl"),
        include_str!("../wgsl/display.wgsl"),
    ],
};
/// The shared functions alone, called from a compute shader so that they can be held against their Rust twins.
pub const PROBE: Module = Module { name: "probe", files: &[ABERRATION, include_str!("../wgsl/probe.wgsl")] };

/// Every module, for validation.
pub const MODULES: [Module; 9] = [SURFACE, SKY, WARP, SHADOW, ACCUMULATE, COPY, METER, DISPLAY, PROBE];

/// The WGSL declarations of the constants above.
fn constants() -> String {
    let nodes_per_octave = f64::from(SHIFT_NODES - 1) * std::f64::consts::LN_2 / (2.0 * ShiftTable::LN_LIMIT);
    let mut source = String::new();
    for (name, value) in [
        ("SHADOW_FILTER_TEXELS", SHADOW_FILTER_TEXELS),
        ("SHADOW_NORMAL_OFFSET_M", SHADOW_NORMAL_OFFSET_M),
        ("SHIFT_NODES_PER_OCTAVE", nodes_per_octave as f32),
        ("HALF_LIMIT", HALF_LIMIT),
        ("NOT_BENT", NOT_BENT),
        ("PANORAMA_LOOKS", PANORAMA_LOOKS),
        ("TURN", std::f32::consts::TAU),
        ("BRIGHTEST", BRIGHTEST),
        ("DARKEST", DARKEST),
        ("LARGEST_LOG2", LARGEST_LOG2),
        ("METER_BINS_PER_OCTAVE", METER_BINS_PER_OCTAVE),
        ("METER_OCTAVES", METER_OCTAVES),
        ("METER_REACH", METER_REACH),
        ("SCREEN_OCTAVES", SCREEN_OCTAVES),
        ("HISTOGRAM_TOLERANCE", HISTOGRAM_TOLERANCE),
        ("FILMIC_A", FILMIC[0]),
        ("FILMIC_B", FILMIC[1]),
        ("FILMIC_C", FILMIC[2]),
        ("FILMIC_D", FILMIC[3]),
        ("FILMIC_E", FILMIC[4]),
    ] {
        source.push_str(&format!("const {name}: f32 = {value:?};\n"));
    }
    for (name, value) in [
        ("SHIFT_NODES", SHIFT_NODES),
        ("MAP_CELLS", MAP_CELLS),
        ("BRIGHTEST_BITS", BRIGHTEST.to_bits()),
        ("METER_WORKGROUP", METER_WORKGROUP),
        ("METER_BINS", METER_BINS),
        ("METER_TRIM_PERCENT", METER_TRIM_PERCENT),
        ("METER_BRIGHT_PERCENT", METER_BRIGHT_PERCENT),
        ("HISTOGRAM_PASSES", HISTOGRAM_PASSES),
        ("TONE_LINEAR", TONE_LINEAR),
        ("TONE_REINHARD", TONE_REINHARD),
        ("TONE_EXPONENTIAL", TONE_EXPONENTIAL),
        ("TONE_FILMIC", TONE_FILMIC),
        ("TONE_HISTOGRAM", TONE_HISTOGRAM),
        ("GAMUT_DESATURATE", GAMUT_DESATURATE),
        ("GAMUT_WHITE", GAMUT_WHITE),
        ("GAMUT_CLAMP", GAMUT_CLAMP),
    ] {
        source.push_str(&format!("const {name}: u32 = {value}u;\n"));
    }
    let [red, green, blue] = DVec3::AXES.map(|primary| luminance(primary) as f32);
    let [columns, rows] = METER_GRID;
    source.push_str(&format!("const LUMINANCE: vec3<f32> = vec3({red:?}, {green:?}, {blue:?});\n"));
    source.push_str(&format!("const METER_GRID: vec2<u32> = vec2({columns}u, {rows}u);\n"));
    source
}
