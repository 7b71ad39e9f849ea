//! The structs that Rust writes and a shader reads, byte for byte.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec2, Vec4};

/// One draw: where the eye's camera points and how the eye moves.
///
/// Positions given to the shader are relative to the eye, in the observer's axes (a pure boost of the world's).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ViewUniforms {
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
    /// κ that shifts light, whether geometry is on or off; what radiance is multiplied by; 2 over the width, 2 over the height in pixels.
    pub shift: Vec4,
    /// Carrier whose weights are kept, when the map is drawn; yzw unused.
    pub layer: Vec4,
    /// When geometry is off, of what moves in the world: unit vector along its motion, and its κ; w = 1 of what rests, and when geometry
    /// is on.
    pub source: Vec4,
    /// Where the vertex stage bends: the eye relative to the scene's origin, metres, world axes, rounded to f32; w unused.
    pub eye: Vec4,
    /// What that rounding lost.
    pub eye_rest: Vec4,
}

/// Daylight, in the frame of what it falls on: the world's, or that of something that moves.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightingUniforms {
    /// From the scene's own coordinates to the shadow map's texture coordinates and depth.
    pub shadow_from_world: Mat4,
    /// Unit vector towards the sun; w = 1 if what lies between counts, 0 if nothing can cast a shadow here.
    pub sun_direction: Vec4,
    /// Linear light on a surface that faces the sun; w = depth that it may lie behind the shadow map and still be lit.
    pub sun: Vec4,
    /// Red light of all else, on a surface of a normal: xyz · normal + w.
    pub ambient_red: Vec4,
    /// The same in green.
    pub ambient_green: Vec4,
    /// The same in blue.
    pub ambient_blue: Vec4,
    /// Half the radiance of the ground, where no surface is; w unused.
    pub ground: Vec4,
    /// Radiance of the sky overhead; w = its carrier, and that of all sky.
    pub zenith: Vec4,
    /// Radiance of the sky at the horizon; w = what the sky's weights are multiplied by to be relative to white.
    pub horizon: Vec4,
    /// Radiance behind everything, where pipelines show that instead of the sky; w unused.
    pub background: Vec4,
}

/// One surface.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MaterialUniforms {
    /// Linear factor of the base colour, and opacity.
    pub base_colour: Vec4,
    /// Linear radiance; w = opacity below which nothing is drawn, if the pipeline is masked.
    pub emissive: Vec4,
    /// Carriers: of what it reflects, or, unlit, sends out; of what it emits besides. Then what their weights are multiplied by to be
    /// relative to white.
    pub carriers: Vec4,
}

/// A part of a cube's face, drawn somewhere in the atlas.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct AtlasTile {
    /// Tangents at its upper left corner.
    pub corner: Vec2,
    /// Texels per tangent, right and down.
    pub scale: Vec2,
    /// First texel of the pane.
    pub low: Vec2,
    /// Texel after its last.
    pub high: Vec2,
}

/// How a pixel finds its place in the map.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MapUniforms {
    /// From the observer's axes (or the world's, turned alike) to the cube's: +z is along the motion.
    pub cube_from_observer: Mat4,
}

/// How samples are summed.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct AccumulateUniforms {
    /// What each sample counts for: one over their number.
    pub weight: f32,
}

/// What the light meter is asked.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MeteringUniforms {
    /// Exposure over the texture's scale, if it is not automatic.
    pub exposure: f32,
    /// Base-2 logarithm of the exposure, or of what is added to the automatic one.
    pub log2_exposure: f32,
    /// Base-2 logarithm of the texture's scale.
    pub log2_scale: f32,
    /// How far to go from what the eye is adapted to, to what it sees: 0 to 1.
    pub share: f32,
    /// 1 takes the exposure from the gain.
    pub automatic: u32,
    /// 1 counts the gain: luminance as seen, over that of the same surfaces unshifted.
    pub gains: u32,
    /// 1 counts the luminance itself.
    pub luminances: u32,
    /// Pixels that are looked at, across.
    pub columns: u32,
    /// And down.
    pub rows: u32,
}

/// What the eye is adapted to; stays on the device from frame to frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct AdaptationState {
    /// What the texture's values are multiplied with: exposure over scale.
    pub exposure: f32,
    /// Exposed gain that is shown as white, at least 1.
    pub white: f32,
    /// Base-2 logarithm of the exposure.
    pub log2_exposure: f32,
    /// Mean base-2 logarithm of the gain.
    pub gain: f32,
    /// Base-2 logarithm of the gain of the brightest pixels.
    pub bright: f32,
}

/// Where on a screen a picture is shown.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PlacementUniforms {
    /// The screen's pixel that its upper left one is.
    pub origin: Vec2,
    /// What its values are multiplied by before all else.
    pub exposure: f32,
    /// 1 if the window's first row lies on an odd one of the monitor, plus 2 for its first column: for pictures that eyes take turns in.
    pub odd: f32,
}

/// A flat picture of what an eye sees, taken to be shown on a surface that is not flat. Axes of the room.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FacetUniforms {
    /// Where the eye is, metres; w = the largest tangent, right or up, that this facet shows.
    pub eye: Vec4,
    /// To the right in the picture; w unused.
    pub right: Vec4,
    /// Upward in it; w unused.
    pub up: Vec4,
    /// Straight ahead; w unused.
    pub forward: Vec4,
    /// Texel that lies straight ahead, then texels per tangent right and up (which is negative).
    pub texel: Vec4,
}

/// From where a room is seen.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RoomViewUniforms {
    /// From the room's axes, metres.
    pub clip_from_room: Mat4,
}
