//! Surfaces in the room that can show something.
//!
//! Every surface has places uv, 0 to 1 from the lower left as seen by the viewer, a normal that points to the viewer's side, and a first
//! point that a ray hits.

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

/// A ray closer to its start than this share of the surface's size hits nothing: a projector on the rim of a dome does not light
/// the rim.
const NEAREST: f64 = 1e-9;

/// Rounding may put a point on an edge this far (in uv) beyond it.
const EDGE: f64 = 1e-9;

/// Where a ray hits a surface first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// In lengths of the ray's direction.
    pub distance: f64,
    /// Room axes, metres.
    pub point: DVec3,
    /// Unit vector to the viewer's side, whichever side the ray came from.
    pub normal: DVec3,
    /// Place on the surface, 0 to 1 from the lower left as seen by the viewer.
    pub uv: DVec2,
}

/// What a screen is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// A rectangle.
    Flat(Flat),
    /// A wall curved round a vertical axis.
    Cylinder(Cylinder),
    /// A dome, or part of one.
    Sphere(Sphere),
    /// Triangles.
    Mesh(Box<Mesh>),
}

impl Surface {
    /// Point at a place on the surface: room axes, metres. Places outside 0 to 1 are those on its nearest edge. `None`: a hole in a mesh.
    pub fn point(&self, uv: DVec2) -> Option<DVec3> {
        let uv = uv.clamp(DVec2::ZERO, DVec2::ONE);
        match self {
            Self::Flat(flat) => Some(flat.point(uv)),
            Self::Cylinder(cylinder) => Some(cylinder.point(uv)),
            Self::Sphere(sphere) => Some(sphere.point(uv)),
            Self::Mesh(mesh) => mesh.point(uv),
        }
    }

    /// Unit normal there, to the viewer's side. `None`: a hole in a mesh.
    pub fn normal(&self, uv: DVec2) -> Option<DVec3> {
        let uv = uv.clamp(DVec2::ZERO, DVec2::ONE);
        match self {
            Self::Flat(flat) => Some(flat.normal()),
            Self::Cylinder(cylinder) => Some(cylinder.normal(uv)),
            Self::Sphere(sphere) => Some(sphere.normal(uv)),
            Self::Mesh(mesh) => mesh.normal(uv),
        }
    }

    /// Where a ray from `origin` along `direction` (any length but zero) hits the surface first, from either side.
    pub fn hit(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        match self {
            Self::Flat(flat) => flat.hit(origin, direction),
            Self::Cylinder(cylinder) => cylinder.hit(origin, direction),
            Self::Sphere(sphere) => sphere.hit(origin, direction),
            Self::Mesh(mesh) => mesh.hit(origin, direction),
        }
    }

    /// The place of a point of the surface; `None` if the point is not near it. Meshes are searched through.
    pub fn uv(&self, point: DVec3) -> Option<DVec2> {
        match self {
            Self::Flat(flat) => flat.uv(point - flat.lower_left),
            Self::Cylinder(cylinder) => cylinder.uv(point - cylinder.centre),
            Self::Sphere(sphere) => sphere.uv(point - sphere.centre),
            Self::Mesh(mesh) => mesh.uv(point),
        }
    }

    /// As a mesh of columns × rows places, at least two each, for what draws the room: a mesh as it is, anything else evenly divided.
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

    /// Width and height as one would measure them along the surface, metres; of a mesh, its bounding box's diagonal twice.
    pub fn size_m(&self) -> DVec2 {
        match self {
            Self::Flat(flat) => flat.size_m(),
            Self::Cylinder(cylinder) => cylinder.size_m(),
            Self::Sphere(sphere) => sphere.size_m(),
            Self::Mesh(mesh) => DVec2::splat(mesh.size_m()),
        }
    }

    /// What it is called in reports: flat, cylinder, sphere or mesh.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Flat(_) => "flat",
            Self::Cylinder(_) => "cylinder",
            Self::Sphere(_) => "sphere",
            Self::Mesh(_) => "mesh",
        }
    }
}

/// Where a·t² + 2·b·t + c = 0, the lower first; NaN where nowhere.
///
/// The textbook form cancels for the root near zero, which a projector on a dome's rim has.
fn crossings(a: f64, b: f64, c: f64) -> [f64; 2] {
    let root = (b * b - a * c).sqrt();
    let sum = -(b + root.copysign(b));
    let (one, other) = (sum / a, c / sum);
    if one <= other { [one, other] } else { [other, one] }
}

/// How far a yaw is on the way from `left` down to `right`, 0 to 1; `None` outside.
fn share(yaw: f64, left: f64, right: f64) -> Option<f64> {
    let width = left - right;
    let slack = EDGE * width;
    let turned = (left - yaw + slack).rem_euclid(TAU) - slack;
    (turned <= width + slack).then(|| (turned / width).clamp(0.0, 1.0))
}
