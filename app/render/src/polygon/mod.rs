//! `polygon`: the photo-surface of every vertex (W 5.1), drawn with ordinary rasterisation.
//!
//! Exact at the vertices; between them edges are straight where they should bend, which is what refinement is for.
//! The transform runs beside the render thread (`photo_surface`); it does not depend on where the eye looks, so
//! one [`PhotoSurface::submit`] serves any number of draws. Hidden surfaces by depth are
//! right as they stand: along one line of sight the nearer apparent position is the later emission (W 5.1.1).

//!
//! A scene is either refined to one edge length before it comes here, or cut for every picture by [`Adaptive`].

mod adaptive;
mod photo_surface;
mod vertex_stage;

pub use adaptive::{Adaptive, CutStats, Pace, Tolerance};
pub use photo_surface::{PhotoSurface, Transformed};
pub use vertex_stage::VertexStage;
