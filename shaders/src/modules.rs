//! The shader modules: lists of files from `wgsl/`, concatenated behind the shared constants.

use crate::declarations::declarations;

/// A shader module: an entry of [`MODULES`].
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// Name of the module in labels and error messages.
    pub name: &'static str,
    files: &'static [&'static str],
}

impl Module {
    /// The module's WGSL: the constants, then its files in order.
    pub fn source(&self) -> String {
        let mut source = declarations();
        for file in self.files {
            source.push_str(file);
        }
        source
    }
}

const ABERRATION: &str = include_str!("../wgsl/aberration.wgsl");
const DEVELOP: &str = include_str!("../wgsl/develop.wgsl");
const ENCODE: &str = include_str!("../wgsl/encode.wgsl");
const FULLSCREEN: &str = include_str!("../wgsl/fullscreen.wgsl");
const GAMUT: &str = include_str!("../wgsl/gamut.wgsl");
const RADIANCE: &str = include_str!("../wgsl/radiance.wgsl");
const TABLE: &str = include_str!("../wgsl/table.wgsl");
const TONE: &str = include_str!("../wgsl/tone.wgsl");
const SHARED: &str = include_str!("../wgsl/shared.wgsl");

const PHOTO_SURFACE: &str = include_str!("../wgsl/photo_surface.wgsl");
const SHIFT: &str = include_str!("../wgsl/shift.wgsl");

/// Module that draws triangles of the photo-surface (or of the plain world) under sun and sky.
pub const SURFACE: Module = Module {
    name: "surface",
    files: &[
        SHARED,
        ABERRATION,
        SHIFT,
        PHOTO_SURFACE,
        include_str!("../wgsl/surface.wgsl"),
        include_str!("../wgsl/outside.wgsl"),
    ],
};
/// Module that draws the sky behind everything, per pixel.
pub const SKY: Module = Module { name: "sky", files: &[SHARED, ABERRATION, SHIFT, include_str!("../wgsl/sky.wgsl")] };
/// Module that draws the picture that the observer sees from the map of the world around the eye.
pub const WARP: Module =
    Module { name: "warp", files: &[SHARED, ABERRATION, SHIFT, include_str!("../wgsl/warp.wgsl")] };
/// Module that draws the sun's depth map, in the world frame.
pub const SHADOW: Module = Module { name: "shadow", files: &[SHARED, include_str!("../wgsl/shadow.wgsl")] };
/// Module that takes the mean of several samples.
pub const ACCUMULATE: Module =
    Module { name: "accumulate", files: &[FULLSCREEN, include_str!("../wgsl/accumulate.wgsl")] };
/// Module that copies radiance as it is.
pub const COPY: Module = Module { name: "copy", files: &[FULLSCREEN, include_str!("../wgsl/copy.wgsl")] };
/// Module of the light meter: exposure, white and the histogram's curve, which the eye adapts to.
pub const METER: Module = Module {
    name: "meter",
    files: &[
        RADIANCE,
        include_str!("../wgsl/meter.wgsl"),
        include_str!("../wgsl/expose.wgsl"),
        include_str!("../wgsl/equalise.wgsl"),
    ],
};
/// Module that shows linear radiance on a screen of sRGB.
pub const DISPLAY: Module = Module {
    name: "display",
    files: &[FULLSCREEN, RADIANCE, TONE, GAMUT, ENCODE, DEVELOP, TABLE, include_str!("../wgsl/display.wgsl")],
};
/// Module that shows the linear radiance of two views in the two layers of a screen of sRGB, in one pass.
pub const DISPLAY_VIEWS: Module = Module {
    name: "display of views",
    files: &[FULLSCREEN, RADIANCE, TONE, GAMUT, ENCODE, DEVELOP, include_str!("../wgsl/display_views.wgsl")],
};
/// Module that shows the number of each view.
pub const VIEW_NUMBER: Module =
    Module { name: "view number", files: &[FULLSCREEN, include_str!("../wgsl/view_number.wgsl")] };
/// Module that blackens the parts of a picture that nobody sees.
pub const HIDDEN: Module = Module { name: "hidden", files: &[include_str!("../wgsl/hidden.wgsl")] };
/// Module that hands on the depth of a picture.
pub const SCENE_DEPTH: Module =
    Module { name: "scene depth", files: &[FULLSCREEN, include_str!("../wgsl/scene_depth.wgsl")] };
/// Module that combines both eyes' pictures on the same pixels.
pub const COMBINE: Module =
    Module { name: "combine", files: &[FULLSCREEN, ENCODE, include_str!("../wgsl/combine.wgsl")] };
/// Module that draws a room seen from anywhere.
pub const ROOM: Module = Module { name: "room", files: &[include_str!("../wgsl/room.wgsl")] };
/// Linear light as a screen takes it.
pub const ENCODED: Module =
    Module { name: "encoded", files: &[FULLSCREEN, ENCODE, include_str!("../wgsl/encoded.wgsl")] };
/// Module that draws a sheet in a room over a channel's picture.
pub const SHEET: Module =
    Module { name: "sheet", files: &[FULLSCREEN, ENCODE, TABLE, include_str!("../wgsl/sheet.wgsl")] };
/// Module that darkens a channel's picture away from straight ahead.
pub const VEIL: Module = Module { name: "veil", files: &[FULLSCREEN, include_str!("../wgsl/veil.wgsl")] };
/// Module that draws the interface's triangles.
pub const INTERFACE: Module = Module { name: "interface", files: &[ENCODE, include_str!("../wgsl/interface.wgsl")] };
/// Module that resamples flat pictures for a surface that is not flat.
pub const RESAMPLE: Module = Module { name: "resample", files: &[FULLSCREEN, include_str!("../wgsl/resample.wgsl")] };
/// Module that takes a picture of any projection from light of all directions.
pub const FROM_SPHERE: Module =
    Module { name: "from_sphere", files: &[FULLSCREEN, include_str!("../wgsl/from_sphere.wgsl")] };
/// Module that enlarges a finished picture to the size of its window.
pub const ENLARGE: Module = Module { name: "enlarge", files: &[FULLSCREEN, include_str!("../wgsl/enlarge.wgsl")] };
/// Module that draws marks over a picture from outside.
pub const MARKS: Module = Module { name: "marks", files: &[include_str!("../wgsl/marks.wgsl")] };
/// Module of the shared functions alone, called from a compute shader so that they can be held against their Rust
/// twins.
pub const PROBE: Module = Module { name: "probe", files: &[ABERRATION, include_str!("../wgsl/probe.wgsl")] };

/// Every module, for tests that validate them.
pub const MODULES: [Module; 23] = [
    SHEET,
    VEIL,
    SURFACE,
    SKY,
    WARP,
    SHADOW,
    ACCUMULATE,
    COPY,
    METER,
    DISPLAY,
    DISPLAY_VIEWS,
    VIEW_NUMBER,
    HIDDEN,
    SCENE_DEPTH,
    COMBINE,
    ROOM,
    ENCODED,
    INTERFACE,
    RESAMPLE,
    FROM_SPHERE,
    ENLARGE,
    MARKS,
    PROBE,
];
