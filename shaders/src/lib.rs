//! WGSL and its Rust mirror: the structs that both sides share, the constants, and the sources. No GPU here.
//!
//! Rust owns every constant and writes the WGSL for it, so no number is typed twice. A struct shared with a shader has
//! the same name, fields and order in both; `shaders/tests/shaders/mirror.rs` compares each offset and size by naga's
//! reflection and validates every module.
//!
//! A module is a list of files from `wgsl/`, concatenated: [`Module::source`].

mod constants;
mod declarations;
mod layout;
mod modules;

pub use constants::{
    BRIGHTEST, COMBINE_CHECKER, COMBINE_COLUMNS, COMBINE_DUBOIS, COMBINE_GREY, COMBINE_HALF_COLOUR, COMBINE_ROWS,
    DARKEST, DUBOIS_LEFT, DUBOIS_RIGHT, FILMIC, GAMUT_CLAMP, GAMUT_DESATURATE, GAMUT_OPEN, GAMUT_WHITE, HALF_LIMIT,
    HISTOGRAM_PASSES, HISTOGRAM_TOLERANCE, LARGEST_LOG2, MAP_CELLS, MATERIAL_GROUP, METER_BINS, METER_BINS_PER_OCTAVE,
    METER_BRIGHT_PERCENT, METER_GRID, METER_OCTAVES, METER_REACH, METER_TRIM_PERCENT, METER_WORKGROUP, NOT_BENT,
    OUTSIDE_DELAY, OUTSIDE_DOPPLER, OUTSIDE_LIGHT, PANORAMA_LOOKS, SCREEN_OCTAVES, SHADOW_BIAS_TEXELS,
    SHADOW_FILTER_TEXELS, SHADOW_NORMAL_OFFSET_TEXELS, SHIFT_NODES, SKY_GLOW, SKY_GLOW_POWER, SKY_HAZE, SKY_HAZE_DEPTH,
    SKY_SUN, SKY_SUN_EDGE, SKY_ZENITH_FROM, TONE_EXPONENTIAL, TONE_FILMIC, TONE_HISTOGRAM, TONE_LINEAR, TONE_REINHARD,
    VIEW_GROUP,
};
pub use layout::{
    AccumulateUniforms, AdaptationState, AtlasTile, FacetUniforms, InterfaceUniforms, LightingUniforms, MapUniforms,
    MaterialUniforms, MeteringUniforms, PlacementUniforms, RoomViewUniforms, SheetUniforms, VeilUniforms, ViewUniforms,
};
pub use modules::{
    ACCUMULATE, COMBINE, COPY, DISPLAY, DISPLAY_VIEWS, ENCODED, ENLARGE, FROM_SPHERE, HIDDEN, INTERFACE, MARKS, METER,
    MODULES, Module, PROBE, RESAMPLE, ROOM, SCENE_DEPTH, SHADOW, SHEET, SKY, SURFACE, VEIL, VIEW_NUMBER, WARP,
};
