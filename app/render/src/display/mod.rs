//! From radiance to pixels: the mean of several samples, exposure, tone, gamut, and the screen's curve.
//!
//! 1. **Exposure** multiplies. Automatic exposure ([`adaptation`]) takes back, with a time constant, the brightness
//!    that Doppler shift and searchlight effect have added to the picture as a whole. A fixed exposure is counted in
//!    stops from the world's own white.
//! 2. **Tone** bends luminance, so that differences between luminances above white stay visible. A colour is scaled
//!    as a whole.
//! 3. **Gamut** changes colours that the screen cannot show into colours that it can (W 3.2.5).
//! 4. The screen's curve is that of sRGB, by IEC 61966-2-1.
//!
//! At rest, colours inside the screen's gamut pass unchanged through the last three steps but for the encoding: an
//! unlit colour comes out as its nearest byte.

pub mod adaptation;
mod developer;
pub mod development;
mod enlarge;
mod passes;

pub use adaptation::{Adaptation, Seen};
pub use developer::{
    Accumulator, DevelopedPart, Developer, LINEAR_FORMAT, copy, encoded, encodes, from_sphere, resample,
};
pub use development::{Development, Exposure, Gamut, Tone};
pub use enlarge::Enlarger;
pub use passes::{
    FILTERED, Pass, READ, UNFILTERED, UNIFORM, clear, contents, group, layout, module, over, pipeline_layout,
};
