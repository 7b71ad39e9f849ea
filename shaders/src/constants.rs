//! Constants that Rust and WGSL share. Rust owns them; `declarations.rs` writes the WGSL for each that a shader uses.

use physics::colour::ShiftTable;

/// Bind group that holds [`ViewUniforms`](crate::ViewUniforms), [`LightingUniforms`](crate::LightingUniforms) and the
/// shadow map.
pub const VIEW_GROUP: u32 = 0;
/// Bind group that holds [`MaterialUniforms`](crate::MaterialUniforms) and its textures.
pub const MATERIAL_GROUP: u32 = 1;
/// Radius over which the sun's shadow is smoothed, shadow-map texels.
pub const SHADOW_FILTER_TEXELS: f32 = 0.75;
/// Distance that a surface may lie behind the shadow map and still be lit, shadow-map texels.
pub const SHADOW_BIAS_TEXELS: f64 = 0.5;
/// Distance that the point looked up in the shadow map is moved off its surface, so that no surface shades itself,
/// shadow-map texels. A sample is up to (0.75 + 0.5)√2 texels aside, and a surface at the angle θ to the light is as
/// much times tan θ deeper there; a step s along its normal makes up for s/cos θ. With the bias, 1.5 suffice up to 70°,
/// beyond which little light falls.
pub const SHADOW_NORMAL_OFFSET_TEXELS: f64 = 1.5;

/// Largest value of a channel; larger ones are taken for it. Its square is still a finite f32.
pub const BRIGHTEST: f32 = (1_u64 << 60) as f32;
/// Luminance below which a pixel is taken for black.
pub const DARKEST: f32 = 1e-30;
/// Base-2 logarithm of the largest factor that exposure multiplies with, and of its inverse.
pub const LARGEST_LOG2: f32 = 120.0;

/// Columns and rows of the pixels that the light meter looks at, shared by all pictures that one eye sees; every pixel
/// of a smaller picture is looked at.
///
/// Fewer than 2¹⁶ pixels in all, so that a sum of 16-bit fractions over them fits 32 bits.
pub const METER_GRID: [u32; 2] = [256, 144];
/// Side of the square of pixels that a group of threads looks at, pixels.
pub const METER_WORKGROUP: u32 = 16;
/// Number of bins of a light meter's histogram.
pub const METER_BINS: u32 = 1024;
/// Number of bins for each doubling.
pub const METER_BINS_PER_OCTAVE: f32 = 4.0;
/// Number of doublings from 1 to either end of the histogram.
pub const METER_OCTAVES: f32 = METER_BINS as f32 / METER_BINS_PER_OCTAVE / 2.0;
/// Number of doublings below the brightest gain that the mean gain reaches down to.
pub const METER_REACH: f32 = 8.0;
/// Share of the samples that the mean gain leaves out at either end, per cent.
pub const METER_TRIM_PERCENT: u32 = 10;
/// Share of the samples that are darker than what is shown as white, per cent.
pub const METER_BRIGHT_PERCENT: u32 = 99;

/// Number of doublings between the darkest and the brightest that a screen shows, for the histogram's curve: 1000 : 1.
pub const SCREEN_OCTAVES: f32 = 10.0;
/// Number of times that the histogram is cut at its ceiling.
pub const HISTOGRAM_PASSES: u32 = 32;
/// Share of the samples below which a histogram has nothing left after its cuts: the screen has the frame's range
/// anyway.
pub const HISTOGRAM_TOLERANCE: f32 = 0.025;

/// Tone curve without compression: light brighter than the screen is cut off.
pub const TONE_LINEAR: u32 = 0;
/// Tone curve of Reinhard, extended by a white point.
pub const TONE_REINHARD: u32 = 1;
/// Exponential tone curve, 1 − e^(−L).
pub const TONE_EXPONENTIAL: u32 = 2;
/// Tone curve like that of film, by [`FILMIC`].
pub const TONE_FILMIC: u32 = 3;
/// Tone curve by histogram adjustment.
pub const TONE_HISTOGRAM: u32 = 4;
/// Coefficients a to e of the filmic curve L (a L + b) / (L (c L + d) + e), the fit by K. Narkowicz, "ACES filmic tone
/// mapping curve", 2016.
pub const FILMIC: [f32; 5] = [2.51, 0.03, 2.43, 0.59, 0.14];

/// Gamut mapping by desaturation at constant luminance.
pub const GAMUT_DESATURATE: u32 = 0;
/// Gamut mapping by adding white, then darkening.
pub const GAMUT_WHITE: u32 = 1;
/// Gamut mapping that clamps each channel by itself.
pub const GAMUT_CLAMP: u32 = 2;
/// No gamut mapping: light is handed on as it is.
pub const GAMUT_OPEN: u32 = 3;

/// Combination of both eyes by rows: the even rows of the monitor are the left eye's.
pub const COMBINE_ROWS: u32 = 0;
/// Combination by columns: the even columns of the monitor are the left eye's.
pub const COMBINE_COLUMNS: u32 = 1;
/// Combination in a checkerboard: pixels whose row and column are both even or both odd are the left eye's.
pub const COMBINE_CHECKER: u32 = 2;
/// Red–cyan anaglyph by least squares (E. Dubois).
pub const COMBINE_DUBOIS: u32 = 3;
/// Red–cyan anaglyph of the luminances.
pub const COMBINE_GREY: u32 = 4;
/// Red–cyan anaglyph with red from the left eye's luminance, green and blue from the right eye.
pub const COMBINE_HALF_COLOUR: u32 = 5;
/// Matrix from the left eye's red, green and blue to those of a red–cyan anaglyph, linear: E. Dubois, "A projection
/// method to generate anaglyph stereo images", ICASSP 2001, for the phosphors and filters given there.
pub const DUBOIS_LEFT: [[f32; 3]; 3] =
    [[0.456_100, 0.500_484, 0.176_381], [-0.040_082, -0.037_825, -0.015_759], [-0.015_216, -0.020_597, -0.005_469]];
/// Matrix from the right eye's red, green and blue to those of a red–cyan anaglyph, linear; same source as
/// [`DUBOIS_LEFT`].
pub const DUBOIS_RIGHT: [[f32; 3]; 3] =
    [[-0.043_471, -0.087_939, -0.001_555], [0.378_476, 0.733_640, -0.018_450], [-0.072_153, -0.112_961, 1.226_395]];

/// Number of nodes of the shift table over ln D; odd, so that D = 1 is one.
pub const SHIFT_NODES: u32 = ShiftTable::NODES as u32;
/// Number of cells along each side of a quarter of a face of the image renderer's map, and of a cell that is cut
/// further; a power of two.
pub const MAP_CELLS: u32 = 16;
/// Largest value that a half float holds safely.
pub const HALF_LIMIT: f32 = 60_000.0;
/// Value of each coordinate of a vertex that the CPU leaves to the vertex stage.
pub const NOT_BENT: f32 = 3e38;
/// Largest number of samples along a stretched footprint in a panorama.
pub const PANORAMA_LOOKS: f32 = 16.0;

/// Square root of the sine of the altitude above which the sky has its zenith's colour.
pub const SKY_ZENITH_FROM: f32 = 0.9;
/// Sine of the depth below the horizon at which the haze has the ground's colour alone.
pub const SKY_HAZE_DEPTH: f32 = 0.25;
/// Brightness of the haze, in units of the light that the ground returns.
pub const SKY_HAZE: f32 = 2.0;
/// Radiance of the glow at the sun, in units of the sun's light.
pub const SKY_GLOW: f32 = 0.25;
/// Power of the cosine of the angle from the sun by which the glow fades.
pub const SKY_GLOW_POWER: u32 = 24;
/// Radiance of the sun's disc, in units of the sun's light.
pub const SKY_SUN: f32 = 4.0;
/// Cosines of the angles from the sun's middle at the outer and inner edge of its disc.
pub const SKY_SUN_EDGE: [f32; 2] = [0.99985, 0.99995];

/// Colours of an outside view show light.
pub const OUTSIDE_LIGHT: u32 = 0;
/// Colours of an outside view show Doppler factors.
pub const OUTSIDE_DOPPLER: u32 = 1;
/// Colours of an outside view show delays.
pub const OUTSIDE_DELAY: u32 = 2;
