//! Surfaces of any shape, as triangles.

use super::hit::{NEAREST, SurfaceHit};
use crate::net::{EDGE, EvenGrid, TriangleNet, WithinTriangle};
use glam::{DVec2, DVec3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use parry3d_f64::query::Ray;
use std::sync::OnceLock;

/// Triangles with places uv. Front faces are counter-clockwise as seen by the viewer.
#[derive(Clone)]
pub struct MeshSurface {
    points: Vec<DVec3>,
    places: TriangleSearch,
    size_m: f64,
    /// Places and triangles. Those of a grid are made when first needed; the points of a projector's pixels do not
    /// need them.
    shape: OnceLock<MeshTriangles>,
    /// Bounding boxes for ray tests, made for the first ray.
    boxes: OnceLock<Bvh>,
}

#[derive(Clone)]
struct MeshTriangles {
    uvs: Vec<DVec2>,
    /// Triangles that are not holes.
    triangles: Vec<[u32; 3]>,
}

/// Search for the triangle at a place.
#[derive(Clone)]
enum TriangleSearch {
    /// Even grid, where the place gives the triangle's number.
    Grid(EvenGrid),
    /// Any other mesh, where the triangle is searched for.
    Net(TriangleNet),
}

impl PartialEq for MeshSurface {
    fn eq(&self, other: &Self) -> bool {
        // Holes are NaN, and two of them count as equal.
        let alike = |(a, b): (&DVec3, &DVec3)| a == b || !a.is_finite() && !b.is_finite();
        self.points.len() == other.points.len()
            && self.points.iter().zip(&other.points).all(alike)
            && self.uvs() == other.uvs()
            && self.triangles() == other.triangles()
    }
}

impl std::fmt::Debug for MeshSurface {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MeshSurface")
            .field("points", &self.points.len())
            .field("size_m", &self.size_m)
            .finish_non_exhaustive()
    }
}

impl MeshTriangles {
    fn new(points: &[DVec3], uvs: Vec<DVec2>, mut triangles: Vec<[u32; 3]>) -> Self {
        triangles.retain(|corners| {
            let [a, b, c] = corners.map(|corner| points[corner as usize]);
            let area = (b - a).cross(c - a).length();
            area.is_finite() && area > 0.0
        });
        Self { uvs, triangles }
    }
}

impl MeshSurface {
    /// Creates a mesh from triangles. Indices must be below the number of points, and there must be as many uvs as
    /// points. A triangle with a corner that is not finite, or without area, is a hole.
    pub fn new(points: Vec<DVec3>, uvs: Vec<DVec2>, triangles: &[[u32; 3]]) -> Self {
        let places = TriangleSearch::Net(TriangleNet::new(uvs.clone(), triangles));
        let shape = MeshTriangles::new(&points, uvs, triangles.to_vec());
        Self { shape: shape.into(), ..Self::with(points, places) }
    }

    /// Creates a mesh from points in rows, the lower left one first, evenly spaced in uv; at least two columns and
    /// two rows.
    pub fn grid(columns: u32, rows: u32, points: Vec<DVec3>) -> Self {
        Self::with(points, TriangleSearch::Grid(EvenGrid { columns, rows }))
    }

    fn with(points: Vec<DVec3>, places: TriangleSearch) -> Self {
        let used = || points.iter().filter(|point| point.is_finite());
        let lowest = used().fold(DVec3::INFINITY, |low, &point| low.min(point));
        let highest = used().fold(DVec3::NEG_INFINITY, |high, &point| high.max(point));
        let size_m = (highest - lowest).length();
        Self { points, places, size_m, shape: OnceLock::new(), boxes: OnceLock::new() }
    }

    fn shape(&self) -> &MeshTriangles {
        self.shape.get_or_init(|| match &self.places {
            TriangleSearch::Grid(grid) => {
                let uvs = (0..grid.columns * grid.rows).map(|sample| grid.place(sample)).collect();
                MeshTriangles::new(&self.points, uvs, grid.triangles())
            }
            // A mesh with a net was given its shape when it was created.
            TriangleSearch::Net(_) => MeshTriangles { uvs: Vec::new(), triangles: Vec::new() },
        })
    }

    /// Vertices, room axes, metres; one that is not finite is unknown.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Places uv of the vertices, 0 to 1 from the lower left.
    pub fn uvs(&self) -> &[DVec2] {
        &self.shape().uvs
    }

    /// Triangles that are not holes, as indices of vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.shape().triangles
    }

    /// Diagonal of the bounding box, metres.
    pub fn size_m(&self) -> f64 {
        self.size_m
    }

    fn find(&self, uv: DVec2) -> Option<WithinTriangle> {
        match &self.places {
            TriangleSearch::Grid(grid) => grid.find(uv),
            TriangleSearch::Net(net) => net.find(uv),
        }
    }

    /// Point at a place uv; `None` in a hole.
    pub fn point(&self, uv: DVec2) -> Option<DVec3> {
        Some(self.find(uv)?.mix(&self.points)).filter(|point| point.is_finite())
    }

    /// Unit normal of the triangle at a place uv; `None` in a hole.
    pub fn normal(&self, uv: DVec2) -> Option<DVec3> {
        self.facing(self.find(uv)?.corners)
    }

    fn facing(&self, corners: [u32; 3]) -> Option<DVec3> {
        let [a, b, c] = self.corners(corners);
        (b - a).cross(c - a).try_normalize()
    }

    pub(super) fn hit(&self, origin: DVec3, direction: DVec3) -> Option<SurfaceHit> {
        if self.triangles().is_empty() || !(origin.is_finite() && direction.is_finite()) {
            return None;
        }
        let boxes = self.boxes.get_or_init(|| {
            let bounds = self.triangles().iter().map(|&corners| {
                let [a, b, c] = self.corners(corners);
                Aabb::new(vector(a.min(b).min(c)), vector(a.max(b).max(c)))
            });
            Bvh::from_leaves(BvhBuildStrategy::Binned, &bounds.collect::<Vec<_>>())
        });
        let nearest = NEAREST * self.size_m / direction.length();
        let ray = Ray::new(vector(origin), vector(direction));
        let meet = |index: u32| {
            meet(self.corners(self.triangles()[index as usize]), origin, direction)
                .filter(|(distance, _)| *distance > nearest)
        };
        let (index, _) = boxes.cast_ray(&ray, f64::MAX, |index, _| meet(index).map(|(distance, _)| distance))?;
        let ((distance, weights), corners) = (meet(index)?, self.triangles()[index as usize]);
        let within = WithinTriangle { corners, weights };
        Some(SurfaceHit {
            distance,
            point: within.mix(&self.points),
            normal: self.facing(corners)?,
            uv: within.mix(self.uvs()),
        })
    }

    /// Place uv of a point on one of the triangles. Every triangle is tested.
    pub(super) fn uv(&self, point: DVec3) -> Option<DVec2> {
        let within = |&corners: &[u32; 3]| {
            let triangle = self.corners(corners);
            let normal = self.facing(corners)?;
            let (distance, weights) = meet(triangle, point, normal)?;
            (distance.abs() < 1e-6 * self.size_m).then(|| WithinTriangle { corners, weights }.mix(self.uvs()))
        };
        self.triangles().iter().find_map(within)
    }

    fn corners(&self, corners: [u32; 3]) -> [DVec3; 3] {
        corners.map(|corner| self.points[corner as usize])
    }
}

/// Distance at which a ray meets a triangle, in lengths of `direction`, and the weights of the corners at that point.
///
/// *Equation.* Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997).
fn meet([a, b, c]: [DVec3; 3], origin: DVec3, direction: DVec3) -> Option<(f64, DVec3)> {
    let (ab, ac, from) = (b - a, c - a, origin - a);
    let across = direction.cross(ac);
    let determinant = ab.dot(across);
    let (second, along) = (from.dot(across) / determinant, from.cross(ab));
    let third = direction.dot(along) / determinant;
    let weights = DVec3::new(1.0 - second - third, second, third);
    let inside = weights.is_finite() && weights.min_element() >= -EDGE;
    inside.then(|| (ac.dot(along) / determinant, weights))
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}
