//! The structs that Rust writes and a shader reads, byte for byte.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec2, Vec4};

/// Camera and motion of the eye for one draw.
///
/// Positions given to the shader are relative to the eye, in the observer's axes (a pure boost of the world's).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ViewUniforms {
    /// Reversed depth, infinite far plane.
    pub clip_from_observer: Mat4,
    /// Direction through the picture's centre, observer's axes; w unused.
    pub forward: Vec4,
    /// Vector from the centre to the picture's right edge, at unit distance along `forward`; w unused.
    pub right: Vec4,
    /// Vector from the centre to the picture's upper edge, at unit distance along `forward`; w unused.
    pub up: Vec4,
    /// Unit vector along the motion, world axes; w = κ = γ + |u| (1 when at rest or when geometry is off).
    pub motion: Vec4,
    /// x = κ that shifts light, geometry on or off; y = factor of radiance; z = 2 over the width, w = 2 over the
    /// height in pixels.
    pub shift: Vec4,
    /// x = carrier whose weights are kept, when the map is drawn; y = width of what a sample stands for, pixels; zw
    /// unused.
    pub layer: Vec4,
    /// Motion of a moving object when geometry is off: unit vector along it, world axes, and w = κ; w = 1 for an
    /// object at rest, and when geometry is on.
    pub source: Vec4,
    /// Position of the eye relative to the scene's origin, for a vertex stage that works out apparent positions;
    /// metres, world axes, rounded to f32; w unused.
    pub eye: Vec4,
    /// Remainder of that rounding, metres; w unused.
    pub eye_rest: Vec4,
}

/// Daylight, in the frame of the surfaces that it falls on: the world's, or that of a moving object.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct LightingUniforms {
    /// Matrix from the scene's own coordinates to the shadow map's texture coordinates and depth.
    pub shadow_from_world: Mat4,
    /// Unit vector towards the sun; w = 1 if the shadow map counts, 0 if nothing can cast a shadow here.
    pub sun_direction: Vec4,
    /// Linear light on a surface that faces the sun; w = depth that a surface may lie behind the shadow map and still
    /// be lit.
    pub sun: Vec4,
    /// Red light from everywhere but the sun, on a surface of a normal: xyz · normal + w.
    pub ambient_red: Vec4,
    /// Green light likewise.
    pub ambient_green: Vec4,
    /// Blue light likewise.
    pub ambient_blue: Vec4,
    /// Half the radiance of the ground, for directions in which no surface is; w is the distance by which a point is
    /// moved off its surface before the shadow map is asked, metres.
    pub ground: Vec4,
    /// Radiance of the sky overhead; w = the carrier of all sky.
    pub zenith: Vec4,
    /// Radiance of the sky at the horizon; w = factor that makes the sky's weights relative to white.
    pub horizon: Vec4,
    /// Radiance behind everything, for pipelines that show it instead of the sky; w unused.
    pub background: Vec4,
}

/// Colours and carriers of a surface.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MaterialUniforms {
    /// Linear factor of the base colour; w = factor of the opacity.
    pub base_colour: Vec4,
    /// Linear radiance that the surface emits; w = opacity below which nothing is drawn, if the pipeline is masked.
    pub emissive: Vec4,
    /// x = carrier of the light that the surface reflects, or, unlit, sends out; y = carrier of the light that it
    /// emits besides; zw = factors that make their weights relative to white.
    pub carriers: Vec4,
}

/// Part of a cube's face, drawn at a place in the atlas.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct AtlasTile {
    /// Tangents at the tile's upper left corner.
    pub corner: Vec2,
    /// Texels per tangent, right and down.
    pub scale: Vec2,
    /// First texel of the tile.
    pub low: Vec2,
    /// Texel after the tile's last one.
    pub high: Vec2,
}

/// Axes in which a pixel finds its place in the map.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MapUniforms {
    /// Matrix from the observer's axes (or the world's, turned alike) to the cube's: +z is along the motion.
    pub cube_from_observer: Mat4,
}

/// Weight of the samples that are summed.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct AccumulateUniforms {
    /// Weight of each sample: one over their number.
    pub weight: f32,
}

/// Questions to the light meter.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct MeteringUniforms {
    /// Exposure over the texture's scale, used if it is not automatic.
    pub exposure: f32,
    /// Base-2 logarithm of the exposure, or of the factor on the automatic one.
    pub log2_exposure: f32,
    /// Base-2 logarithm of the texture's scale.
    pub log2_scale: f32,
    /// Share of the way to go from the old adaptation to the new: 0 to 1.
    pub share: f32,
    /// 1 if the exposure is taken from the gain.
    pub automatic: u32,
    /// 1 if the gain is counted: luminance as seen, over that of the same surfaces unshifted.
    pub gains: u32,
    /// 1 if the luminance itself is counted.
    pub luminances: u32,
    /// Number of columns of pixels that are looked at.
    pub columns: u32,
    /// Number of rows of pixels that are looked at.
    pub rows: u32,
}

/// Adaptation of the eye; stays on the device from frame to frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct AdaptationState {
    /// Factor of the texture's values: exposure over scale.
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

/// Placement of a picture on a screen.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PlacementUniforms {
    /// Pixel of the screen at the picture's upper left corner.
    pub origin: Vec2,
    /// Factor of the picture's values before all else.
    pub exposure: f32,
    /// 1 if the window's first row lies on an odd row of the monitor, plus 2 if its first column lies on an odd
    /// column: for pictures that show both eyes by turns.
    pub odd: f32,
}

/// Interface's picture.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct InterfaceUniforms {
    /// Size of the picture, points.
    pub size: Vec2,
}

/// Flat picture of what an eye sees, taken to be shown on a surface that is not flat. Axes of the room.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct FacetUniforms {
    /// Position of the eye, metres; w = the largest tangent, right or up, that this facet shows.
    pub eye: Vec4,
    /// Unit vector to the right in the picture; w unused.
    pub right: Vec4,
    /// Unit vector upward in the picture; w unused.
    pub up: Vec4,
    /// Unit vector straight ahead; w unused.
    pub forward: Vec4,
    /// xy = texel that lies straight ahead; zw = texels per tangent, right and up (up is negative).
    pub texel: Vec4,
}

/// Sheet that floats in a room, and the channel that shows it. Axes of the room, metres.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SheetUniforms {
    /// Position of the eye; w unused.
    pub eye: Vec4,
    /// Lower left corner of the sheet; w unused.
    pub corner: Vec4,
    /// Vector along the lower edge of the sheet; w unused.
    pub right: Vec4,
    /// Vector along the left edge of the sheet; w unused.
    pub up: Vec4,
    /// Lower left corner of a flat screen's picture; w unused.
    pub screen_corner: Vec4,
    /// Vector along the lower edge of a flat screen's picture; w unused.
    pub screen_right: Vec4,
    /// Vector along the left edge of a flat screen's picture; w unused.
    pub screen_up: Vec4,
    /// Rectangle of the channel's picture: x, y, width, height, pixels.
    pub viewport: Vec4,
}

/// Veil before a flat channel's picture, which darkens it away from straight ahead. Axes of the room, metres.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct VeilUniforms {
    /// Position of the eye; w unused.
    pub eye: Vec4,
    /// Unit vector straight ahead; w unused.
    pub ahead: Vec4,
    /// Lower left corner of the screen's picture; w unused.
    pub screen_corner: Vec4,
    /// Vector along the lower edge of the screen's picture; w unused.
    pub screen_right: Vec4,
    /// Vector along the left edge of the screen's picture; w unused.
    pub screen_up: Vec4,
    /// Rectangle of the channel's picture: x, y, width, height, pixels.
    pub viewport: Vec4,
    /// x = angle up to which nothing is darkened, y = angle from which on all is, radians; z = share of the signal that
    /// is taken there; w unused.
    pub shade: Vec4,
}

/// Camera from which a room is seen.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RoomViewUniforms {
    /// Matrix from the room's axes, metres, to clip coordinates.
    pub clip_from_room: Mat4,
}
