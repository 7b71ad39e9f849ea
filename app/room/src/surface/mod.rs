//! Surfaces in the room on which pictures are shown.
//!
//! Every surface has places uv, 0 to 1 from the lower left as seen by the viewer; a normal that points to the
//! viewer's side; and, for every ray, the first point that the ray hits.

mod cylinder;
mod flat;
mod mesh;
pub(super) mod mesh_file;
mod sphere;
mod sweep;

pub use cylinder::Cylinder;
pub use flat::{Flat, NotRectangle};
pub use mesh::Mesh;
pub use sphere::Sphere;
pub use sweep::{SweepError, sweep};

use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Nearest hit of a ray, as a share of the surface's size. Closer to its start a ray hits nothing, so that a
/// projector on the rim of a dome does not light the rim.
const NEAREST: f64 = 1e-9;

/// Largest distance in uv by which rounding may put a point of the edge beyond it.
const EDGE: f64 = 1e-9;

/// First hit of a ray on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in lengths of its direction.
    pub distance: f64,
    /// Point that is hit, room axes, metres.
    pub point: DVec3,
    /// Unit vector to the viewer's side, whichever side the ray came from; room axes.
    pub normal: DVec3,
    /// Place on the surface, 0 to 1 from the lower left as seen by the viewer.
    pub uv: DVec2,
}

/// Shape and place of a screen.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// A flat rectangle.
    Flat(Flat),
    /// A wall curved round a vertical axis.
    Cylinder(Cylinder),
    /// A dome, or a part of one.
    Sphere(Sphere),
    /// A mesh of triangles.
    Mesh(Box<Mesh>),
}

impl Surface {
    /// Point at a place on the surface: room axes, metres. A place outside 0 to 1 is moved to the nearest edge.
    /// `None` in a hole of a mesh.
    pub fn point(&self, uv: DVec2) -> Option<DVec3> {
        let uv = uv.clamp(DVec2::ZERO, DVec2::ONE);
        match self {
            Self::Flat(flat) => Some(flat.point(uv)),
            Self::Cylinder(cylinder) => Some(cylinder.point(uv)),
            Self::Sphere(sphere) => Some(sphere.point(uv)),
            Self::Mesh(mesh) => mesh.point(uv),
        }
    }

    /// Unit normal at a place, towards the viewer's side; room axes. `None` in a hole of a mesh.
    pub fn normal(&self, uv: DVec2) -> Option<DVec3> {
        let uv = uv.clamp(DVec2::ZERO, DVec2::ONE);
        match self {
            Self::Flat(flat) => Some(flat.normal()),
            Self::Cylinder(cylinder) => Some(cylinder.normal(uv)),
            Self::Sphere(sphere) => Some(sphere.normal(uv)),
            Self::Mesh(mesh) => mesh.normal(uv),
        }
    }

    /// First hit of a ray from `origin` along `direction` (any length but zero), from either side of the surface.
    pub fn hit(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        match self {
            Self::Flat(flat) => flat.hit(origin, direction),
            Self::Cylinder(cylinder) => cylinder.hit(origin, direction),
            Self::Sphere(sphere) => sphere.hit(origin, direction),
            Self::Mesh(mesh) => mesh.hit(origin, direction),
        }
    }

    /// Place uv of a point of the surface; `None` if the point is not near the surface. A mesh is searched as a
    /// whole.
    pub fn uv(&self, point: DVec3) -> Option<DVec2> {
        match self {
            Self::Flat(flat) => flat.uv(point - flat.lower_left),
            Self::Cylinder(cylinder) => cylinder.uv(point - cylinder.centre),
            Self::Sphere(sphere) => sphere.uv(point - sphere.centre),
            Self::Mesh(mesh) => mesh.uv(point),
        }
    }

    /// Mesh of columns × rows places, at least two each, for drawing the room. A mesh is returned as it is; any other
    /// surface is divided evenly.
    pub fn to_mesh(&self, columns: u32, rows: u32) -> Mesh {
        if let Self::Mesh(mesh) = self {
            return (**mesh).clone();
        }
        let place = |i: u32, count: u32| f64::from(i) / f64::from(count - 1);
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let points = places.map(|(column, row)| {
            self.point(DVec2::new(place(column, columns), place(row, rows))).unwrap_or(DVec3::NAN)
        });
        Mesh::grid(columns, rows, points.collect())
    }

    /// Width and height measured along the surface, metres. For a mesh, both are the diagonal of its bounding box.
    pub fn size_m(&self) -> DVec2 {
        match self {
            Self::Flat(flat) => flat.size_m(),
            Self::Cylinder(cylinder) => cylinder.size_m(),
            Self::Sphere(sphere) => sphere.size_m(),
            Self::Mesh(mesh) => DVec2::splat(mesh.size_m()),
        }
    }

    /// Name of the surface's kind in reports: flat, cylinder, sphere or mesh.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Flat(_) => "flat",
            Self::Cylinder(_) => "cylinder",
            Self::Sphere(_) => "sphere",
            Self::Mesh(_) => "mesh",
        }
    }
}

/// Solutions of a·t² + 2·b·t + c = 0, the smaller first; NaN if there are none.
///
/// The textbook form cancels for the root near zero, which a projector on a dome's rim has.
fn crossings(a: f64, b: f64, c: f64) -> [f64; 2] {
    let root = (b * b - a * c).sqrt();
    let sum = -(b + root.copysign(b));
    let (one, other) = (sum / a, c / sum);
    if one <= other { [one, other] } else { [other, one] }
}

/// Position of a yaw between `left` (0) and `right` (1), counted downwards; `None` outside.
fn share(yaw: f64, left: f64, right: f64) -> Option<f64> {
    let width = left - right;
    let slack = EDGE * width;
    let turned = (left - yaw + slack).rem_euclid(TAU) - slack;
    (turned <= width + slack).then(|| (turned / width).clamp(0.0, 1.0))
}
