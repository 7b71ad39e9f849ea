//! The observer's eye, its camera, and the effects of relativity on its picture.
//!
//! These types name a picture for every renderer and ray tracer. They know no scene and no device.

mod camera;
mod dial;
mod dial_limits;
mod effects;
mod exposure;
mod optics;
mod outside;
mod projection;
mod sampling;
mod shot;
mod sides;

pub use camera::{Camera, Field, Tangents};
pub use dial::{Dial, DialError, Occasion, RendererName, Transform};
pub use dial_limits::DialFault;
pub use effects::{Effects, EffectsError, Places};
pub use exposure::OpenShutter;
pub use optics::{CameraLens, Optics};
pub use outside::{Colouring, OutsideCamera, OutsideError, OutsideView};
pub use projection::{FACES, Framing, PlaceSight, Projection, ProjectionError, TurningEye};
pub use sampling::{PixelSample, sample_offset};
pub use shot::{EYE_HEIGHT_M, Gaze, Shot, Stored};
pub use sides::Sides;
