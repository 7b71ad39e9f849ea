//! Surfaces in the room on which pictures are shown.
//!
//! Every surface has places uv, 0 to 1 from the lower left as seen by the viewer; a normal that points to the
//! viewer's side; and, for every ray, the first point that the ray hits.

pub(crate) mod cylinder;
pub(crate) mod flat;
mod hit;
pub(crate) mod mesh;
pub(crate) mod mesh_file;
mod round;
pub(crate) mod shape;
pub(crate) mod sphere;
pub(crate) mod sweep;

pub use cylinder::CylinderSurface;
pub use flat::{FlatSurface, NotRectangle};
pub use hit::SurfaceHit;
pub use mesh::MeshSurface;
pub use shape::ScreenSurface;
pub use sphere::SphereSurface;
pub use sweep::{SweepError, sweep};
