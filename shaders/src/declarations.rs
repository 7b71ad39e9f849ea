//! The WGSL declarations of the shared constants.

use glam::DVec3;
use physics::colour::{ShiftTable, luminance};

use crate::constants::{
    BRIGHTEST, COMBINE_CHECKER, COMBINE_COLUMNS, COMBINE_DUBOIS, COMBINE_GREY, COMBINE_HALF_COLOUR, COMBINE_ROWS,
    DARKEST, DUBOIS_LEFT, DUBOIS_RIGHT, FILMIC, GAMUT_CLAMP, GAMUT_DESATURATE, GAMUT_OPEN, GAMUT_WHITE, HALF_LIMIT,
    HISTOGRAM_PASSES, HISTOGRAM_TOLERANCE, LARGEST_LOG2, MAP_CELLS, METER_BINS, METER_BINS_PER_OCTAVE,
    METER_BRIGHT_PERCENT, METER_OCTAVES, METER_REACH, METER_TRIM_PERCENT, METER_WORKGROUP, NOT_BENT, OUTSIDE_DELAY,
    OUTSIDE_DOPPLER, OUTSIDE_LIGHT, PANORAMA_LOOKS, SCREEN_OCTAVES, SHADOW_FILTER_TEXELS, SHIFT_NODES, SKY_GLOW,
    SKY_GLOW_POWER, SKY_HAZE, SKY_HAZE_DEPTH, SKY_SUN, SKY_SUN_EDGE, SKY_ZENITH_FROM, TONE_EXPONENTIAL, TONE_FILMIC,
    TONE_HISTOGRAM, TONE_LINEAR, TONE_REINHARD,
};

/// The WGSL declarations of the shared constants, a line each.
pub(crate) fn declarations() -> String {
    let nodes_per_octave = f64::from(SHIFT_NODES - 1) * std::f64::consts::LN_2 / (2.0 * ShiftTable::LN_LIMIT);
    let mut source = String::new();
    for (name, value) in [
        ("SHADOW_FILTER_TEXELS", SHADOW_FILTER_TEXELS),
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
        ("SKY_ZENITH_FROM", SKY_ZENITH_FROM),
        ("SKY_HAZE_DEPTH", SKY_HAZE_DEPTH),
        ("SKY_HAZE", SKY_HAZE),
        ("SKY_GLOW", SKY_GLOW),
        ("SKY_GLOW_POWER", SKY_GLOW_POWER as f32),
        ("SKY_SUN", SKY_SUN),
        ("SKY_SUN_OUTER", SKY_SUN_EDGE[0]),
        ("SKY_SUN_INNER", SKY_SUN_EDGE[1]),
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
        ("GAMUT_OPEN", GAMUT_OPEN),
        ("OUTSIDE_LIGHT", OUTSIDE_LIGHT),
        ("OUTSIDE_DOPPLER", OUTSIDE_DOPPLER),
        ("OUTSIDE_DELAY", OUTSIDE_DELAY),
        ("COMBINE_ROWS", COMBINE_ROWS),
        ("COMBINE_COLUMNS", COMBINE_COLUMNS),
        ("COMBINE_CHECKER", COMBINE_CHECKER),
        ("COMBINE_DUBOIS", COMBINE_DUBOIS),
        ("COMBINE_GREY", COMBINE_GREY),
        ("COMBINE_HALF_COLOUR", COMBINE_HALF_COLOUR),
    ] {
        source.push_str(&format!("const {name}: u32 = {value}u;\n"));
    }
    for (eye, matrix) in [("LEFT", DUBOIS_LEFT), ("RIGHT", DUBOIS_RIGHT)] {
        for (row, [red, green, blue]) in ["RED", "GREEN", "BLUE"].into_iter().zip(matrix) {
            source.push_str(&format!("const DUBOIS_{eye}_{row}: vec3<f32> = vec3({red:?}, {green:?}, {blue:?});\n"));
        }
    }
    let [red, green, blue] = DVec3::AXES.map(|primary| luminance(primary) as f32);
    source.push_str(&format!("const LUMINANCE: vec3<f32> = vec3({red:?}, {green:?}, {blue:?});\n"));
    source
}
