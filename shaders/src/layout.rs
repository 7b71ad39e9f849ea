//! The structs that Rust writes and a shader reads, byte for byte.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec4};

/// One draw: where the eye's camera points and how the eye moves.
///
/// Positions given to the shader are relative to the eye, in the observer's axes (a pure boost of the world's).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct View {
    /// Reversed depth, infinite far plane.
    pub clip_from_observer: Mat4,
    /// Direction through the picture's centre, observer's axes; w unused.
    pub forward: Vec4,
    /// From the centre to the picture's right edge, at unit distance along `forward`; w unused.
    pub right: Vec4,
    /// From the centre to the picture's upper edge, at unit distance along `forward`; w unused.
    pub up: Vec4,
    /// Unit vector along the motion, world axes; w = κ = γ + |u| (1 when at rest or when geometry is off).
    pub motion: Vec4,
}

/// Daylight, in the world frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Lighting {
    /// From the scene's own coordinates to the shadow map's texture coordinates and depth.
    pub shadow_from_world: Mat4,
    /// Unit vector towards the sun; w unused.
    pub sun_direction: Vec4,
    /// Linear light on a surface that faces the sun; w = depth that it may lie behind the shadow map and still be lit.
    pub sun: Vec4,
    /// On a surface that faces up.
    pub sky: Vec4,
    /// On a surface that faces down.
    pub ground: Vec4,
    /// Radiance of the sky overhead.
    pub zenith: Vec4,
    /// Radiance of the sky at the horizon.
    pub horizon: Vec4,
    /// Radiance behind everything, if w = 1; w = 0 shows the sky.
    pub background: Vec4,
}

/// One surface.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Material {
    /// Linear factor of the base colour, and opacity.
    pub base_colour: Vec4,
    /// Linear radiance; w = opacity below which nothing is drawn, if the pipeline is masked.
    pub emissive: Vec4,
}

/// How radiance becomes a pixel.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Resolve {
    /// What each sample counts for: one over their number.
    pub weight: f32,
    /// 1 encodes as sRGB, 0 leaves it linear (for a target that encodes by itself, and between samples).
    pub encode: f32,
    /// Fills the struct to 16 bytes.
    pub padding: [f32; 2],
}
