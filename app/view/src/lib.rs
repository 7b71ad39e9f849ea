//! Who looks, when, and through what: the observer's eye, its camera, the effects of relativity on its picture.
//!
//! No scene and no device is known here; whoever draws or traces a picture is asked for it in these words.

mod camera;
mod dial;
mod effects;
mod sampling;
mod shot;

pub use camera::{Camera, Field, Tangents};
pub use dial::{Dial, DialError, Occasion, RendererName, Transform};
pub use effects::{Effects, EffectsError};
pub use sampling::sample_offset;
pub use shot::{EYE_HEIGHT_M, Gaze, Shot, Stored};
