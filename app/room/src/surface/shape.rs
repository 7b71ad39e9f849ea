//! Surface of any kind: one interface to rectangles, cylinders, spheres and meshes.

use super::cylinder::CylinderSurface;
use super::flat::FlatSurface;
use super::hit::SurfaceHit;
use super::mesh::MeshSurface;
use super::sphere::SphereSurface;
use glam::{DVec2, DVec3};

/// Shape and place of a screen.
#[derive(Clone, Debug, PartialEq)]
pub enum ScreenSurface {
    /// A flat rectangle.
    Flat(FlatSurface),
    /// A wall curved round a vertical axis.
    Cylinder(CylinderSurface),
    /// A dome, or a part of one.
    Sphere(SphereSurface),
    /// A mesh of triangles.
    Mesh(Box<MeshSurface>),
}

impl ScreenSurface {
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
    pub fn hit(&self, origin: DVec3, direction: DVec3) -> Option<SurfaceHit> {
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
    pub fn to_mesh(&self, columns: u32, rows: u32) -> MeshSurface {
        if let Self::Mesh(mesh) = self {
            return (**mesh).clone();
        }
        let place = |i: u32, count: u32| f64::from(i) / f64::from(count - 1);
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let points = places.map(|(column, row)| {
            self.point(DVec2::new(place(column, columns), place(row, rows))).unwrap_or(DVec3::NAN)
        });
        MeshSurface::grid(columns, rows, points.collect())
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
