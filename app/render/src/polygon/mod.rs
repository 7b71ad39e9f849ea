//! `polygon`: the photo-surface of every vertex (W 5.1), drawn with ordinary rasterisation.
//!
//! Exact at the vertices. Between them edges are straight although they should bend, which is why scenes are refined.
//! The transform runs beside the render thread (`photo_surface`). It does not depend on the direction in which the
//! eye looks, so one photo-surface serves any number of draws. Depth hides the right surfaces without
//! further work: along one line of sight the nearer apparent position is the later emission (W 5.1.1).
//!
//! A scene is either refined to one edge length before it comes here, or cut for every picture by [`Adaptive`].

mod adaptive;
mod photo_surface;
mod vertex_places;
mod vertex_stage;

pub use adaptive::Adaptive;
pub use photo_surface::PhotoSurface;
pub use vertex_places::{place_streams, write_places};
pub use vertex_stage::VertexStage;
