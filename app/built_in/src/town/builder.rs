//! Builder: collects faces into meshes, one for each district and surface.
//!
//! Faces are flat-shaded, with positions in metres. Texture coordinates are metres divided by the size of one
//! repetition of the surface's picture, unless a face brings its own. Vertex colours carry the tint of a house and
//! the darkness of corners that little light reaches.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, vec2, vec3};

use super::surface::TownSurface;
use crate::clock::ClockFace;
use crate::turn::circle;
use scene::Mesh;

/// Linear colour that multiplies a surface's picture.
pub(super) type Tint = Vec3;

/// A corner of a face.
#[derive(Clone, Copy)]
pub(super) struct MeshCorner {
    pub(super) at: Vec3,
    pub(super) uv: Vec2,
    /// Share of the light that reaches the corner.
    pub(super) light: f32,
}

impl MeshCorner {
    pub(super) fn new(at: Vec3, uv: Vec2) -> Self {
        Self { at, uv, light: 1.0 }
    }
}

/// Local frame of a building or piece: an origin and right-handed axes.
#[derive(Clone, Copy)]
pub(super) struct SiteFrame {
    pub(super) origin: Vec3,
    /// Unit vector to the right, as seen by an observer in front.
    pub(super) right: Vec3,
    pub(super) up: Vec3,
    /// Unit vector out of the front, towards an observer in front.
    pub(super) out: Vec3,
}

impl SiteFrame {
    /// Upright frame whose front faces along the horizontal direction `out`.
    pub(super) fn facing(origin: Vec3, out: Vec3) -> Self {
        Self { origin, right: Vec3::Y.cross(out), up: Vec3::Y, out }
    }

    /// Upright frame, turned about the vertical.
    pub(super) fn turned(origin: Vec3, turns: f32) -> Self {
        let c = circle(turns);
        Self::facing(origin, vec3(c.y, 0.0, c.x))
    }

    pub(super) fn point(&self, x: f32, y: f32, z: f32) -> Vec3 {
        self.origin + self.right * x + self.up * y + self.out * z
    }

    /// Frame with the same axes at another place, given in this frame.
    pub(super) fn at(&self, x: f32, y: f32, z: f32) -> Self {
        Self { origin: self.point(x, y, z), ..*self }
    }

    /// Frame turned about the vertical by a share of a full turn.
    pub(super) fn rotated(&self, turns: f32) -> Self {
        let c = circle(turns);
        let out = self.out * c.x + self.right * c.y;
        Self { origin: self.origin, right: self.up.cross(out), up: self.up, out }
    }
}

/// Meshes under construction.
#[derive(Default)]
pub(super) struct Builder {
    districts: Vec<String>,
    current: usize,
    meshes: BTreeMap<(usize, TownSurface), Mesh>,
    /// Clocks whose dials have been added, without hands.
    pub(super) clocks: Vec<ClockFace>,
}

impl Builder {
    /// Starts a district: faces from here on belong to it.
    pub(super) fn district(&mut self, name: &str) {
        self.current = self.districts.iter().position(|known| known == name).unwrap_or_else(|| {
            self.districts.push(name.into());
            self.districts.len() - 1
        });
    }

    /// Finished meshes, in the order of districts and surfaces.
    pub(super) fn finish(self, material_of: impl Fn(TownSurface) -> usize) -> Vec<Mesh> {
        let named = |((_, surface), mesh): ((usize, TownSurface), Mesh)| Mesh {
            material: material_of(surface),
            solid: surface.solid(),
            ..mesh
        };
        self.meshes.into_iter().map(named).collect()
    }

    /// Adds a flat convex face, counter-clockwise as seen from its front.
    pub(super) fn face(&mut self, surface: TownSurface, tint: Tint, corners: &[MeshCorner]) {
        let normal = normal_of(corners.iter().map(|corner| corner.at));
        let normals = vec![normal; corners.len()];
        self.smooth_face(surface, tint, corners, &normals);
    }

    /// Adds a convex face with a normal of its own at each corner.
    pub(super) fn smooth_face(&mut self, surface: TownSurface, tint: Tint, corners: &[MeshCorner], normals: &[Vec3]) {
        let mesh = self.meshes.entry((self.current, surface)).or_insert_with(|| Mesh {
            name: format!("{}: {}", self.districts.get(self.current).map_or("town", String::as_str), surface.name()),
            ..Mesh::default()
        });
        let first = mesh.positions.len() as u32;
        let mut count = 0;
        for (k, (corner, normal)) in corners.iter().zip(normals).enumerate() {
            // Corners coincide where a face tapers to nothing.
            if corner.at == corners[(k + 1) % corners.len()].at {
                continue;
            }
            count += 1;
            mesh.positions.push(corner.at);
            mesh.normals.push(*normal);
            mesh.uvs.push(corner.uv);
            let colour = tint * corner.light;
            mesh.colours.push([colour.x, colour.y, colour.z, 1.0]);
        }
        for k in 2..count {
            mesh.indices.extend([first, first + k - 1, first + k]);
        }
    }

    /// Adds a flat convex face with its picture in metres, and the share of light at each corner.
    pub(super) fn lit(&mut self, surface: TownSurface, tint: Tint, corners: &[(Vec3, f32)]) {
        let normal = normal_of(corners.iter().map(|corner| corner.0));
        let (right, up) = axes_of(normal);
        let tile = surface.tile();
        let corners: Vec<_> = corners
            .iter()
            .map(|&(at, light)| MeshCorner { at, uv: vec2(at.dot(right), -at.dot(up)) / tile, light })
            .collect();
        self.face(surface, tint, &corners);
    }

    /// Adds a flat convex face with its picture in metres.
    pub(super) fn metric(&mut self, surface: TownSurface, tint: Tint, corners: &[Vec3]) {
        let corners: Vec<_> = corners.iter().map(|&at| (at, 1.0)).collect();
        self.lit(surface, tint, &corners);
    }

    /// Adds a face like `metric`, turned over if necessary so that its front faces along `towards`.
    pub(super) fn facing(&mut self, surface: TownSurface, tint: Tint, corners: &[Vec3], towards: Vec3) {
        let mut corners = corners.to_vec();
        if normal_of(corners.iter().copied()).dot(towards) < 0.0 {
            corners.reverse();
        }
        self.metric(surface, tint, &corners);
    }

    /// Adds the four upright sides of a box between two corners in `frame`.
    pub(super) fn walls(&mut self, surface: TownSurface, tint: Tint, frame: &SiteFrame, low: Vec3, high: Vec3) {
        let p = |x: bool, y: bool, z: bool| {
            let pick = |high_side, low, high| if high_side { high } else { low };
            frame.point(pick(x, low.x, high.x), pick(y, low.y, high.y), pick(z, low.z, high.z))
        };
        let (o, i) = (false, true);
        for face in [
            [p(o, o, i), p(i, o, i), p(i, i, i), p(o, i, i)],
            [p(i, o, i), p(i, o, o), p(i, i, o), p(i, i, i)],
            [p(i, o, o), p(o, o, o), p(o, i, o), p(i, i, o)],
            [p(o, o, o), p(o, o, i), p(o, i, i), p(o, i, o)],
        ] {
            self.metric(surface, tint, &face);
        }
    }

    /// Adds a box between two corners in `frame`, without its underside.
    pub(super) fn block(&mut self, surface: TownSurface, tint: Tint, frame: &SiteFrame, low: Vec3, high: Vec3) {
        self.walls(surface, tint, frame, low, high);
        let p = |x, z| frame.point(x, high.y, z);
        self.metric(surface, tint, &[p(low.x, high.z), p(high.x, high.z), p(high.x, low.z), p(low.x, low.z)]);
    }

    /// Adds a box with its underside.
    pub(super) fn beam(&mut self, surface: TownSurface, tint: Tint, frame: &SiteFrame, low: Vec3, high: Vec3) {
        self.block(surface, tint, frame, low, high);
        let p = |x, z| frame.point(x, low.y, z);
        self.metric(surface, tint * 0.6, &[p(low.x, low.z), p(high.x, low.z), p(high.x, high.z), p(low.x, high.z)]);
    }

    /// Adds a thin rod with three sides from one point to another.
    pub(super) fn rod(&mut self, surface: TownSurface, tint: Tint, from: Vec3, to: Vec3, thickness: f32) {
        let axis = (to - from).normalize_or(Vec3::Y);
        let (side, up) = axis.any_orthonormal_pair();
        let edge = |k: u32| {
            let c = circle(k as f32 / 3.0) * thickness * 0.6;
            side * c.x + up * c.y
        };
        for k in 0..3 {
            let (a, b) = (edge(k), edge(k + 1));
            self.facing(surface, tint, &[from + a, from + b, to + b, to + a], a + b);
        }
    }

    /// Adds a body of revolution about the frame's upright axis through (radius, height) pairs from bottom to top.
    pub(super) fn turned(
        &mut self,
        surface: TownSurface,
        tint: Tint,
        frame: &SiteFrame,
        sides: u32,
        profile: &[(f32, f32)],
    ) {
        let tile = surface.tile();
        let ring = |side: u32| circle(side as f32 / sides as f32);
        let mut along = 0.0;
        for pair in profile.windows(2) {
            let ((r0, y0), (r1, y1)) = (pair[0], pair[1]);
            let slope = vec2(y1 - y0, r0 - r1).normalize_or(Vec2::X);
            let length = vec2(r1 - r0, y1 - y0).length();
            for side in 0..sides {
                let (c0, c1) = (ring(side), ring(side + 1));
                let at = |c: Vec2, r: f32, y: f32| frame.point(c.y * r, y, c.x * r);
                let normal = |c: Vec2| (frame.right * c.y + frame.out * c.x) * slope.x + frame.up * slope.y;
                let around =
                    |k: u32| k as f32 / sides as f32 * (std::f32::consts::TAU * r0.max(r1) / tile.x).round().max(1.0);
                let uv = |k: u32, y: f32| vec2(around(k), -y / tile.y);
                let mut corners = Vec::with_capacity(4);
                let mut normals = Vec::with_capacity(4);
                let mut push = |c, k, r, y, v| {
                    corners.push(MeshCorner::new(at(c, r, y), uv(k, v)));
                    normals.push(normal(c));
                };
                if r0 > 0.0 {
                    push(c0, side, r0, y0, along);
                }
                push(c1, side + 1, r0, y0, along);
                push(c1, side + 1, r1, y1, along + length);
                if r1 > 0.0 {
                    push(c0, side, r1, y1, along + length);
                }
                self.smooth_face(surface, tint, &corners, &normals);
            }
            along += length;
        }
    }

    /// Adds a prism with flat sides and a flat top over a regular polygon, from `low` to `high`.
    pub(super) fn prism(
        &mut self,
        surface: TownSurface,
        tint: Tint,
        frame: &SiteFrame,
        sides: u32,
        radius: [f32; 2],
        height: [f32; 2],
    ) {
        let at = |k: u32, r: f32, y: f32| {
            let c = circle((k as f32 + 0.5) / sides as f32);
            frame.point(c.y * r, y, c.x * r)
        };
        for k in 0..sides {
            let [r0, r1] = radius;
            let [y0, y1] = height;
            let mut corners = vec![at(k, r0, y0), at(k + 1, r0, y0), at(k + 1, r1, y1)];
            if r1 > 0.0 {
                corners.push(at(k, r1, y1));
            }
            self.metric(surface, tint, &corners);
        }
        if radius[1] > 0.0 {
            let top: Vec<_> = (0..sides).map(|k| at(k, radius[1], height[1])).collect();
            self.metric(surface, tint, &top);
        }
    }
}

/// Unit normal of a nearly flat polygon (Newell's sum over its edges, about its first corner).
fn normal_of(corners: impl Iterator<Item = Vec3> + Clone) -> Vec3 {
    let first = corners.clone().next().unwrap_or_default();
    let next = corners.clone().skip(1);
    corners.zip(next).map(|(a, b)| (a - first).cross(b - first)).sum::<Vec3>().normalize_or(Vec3::Y)
}

/// Unit vectors along a surface: one horizontal, one upwards as far as possible.
fn axes_of(normal: Vec3) -> (Vec3, Vec3) {
    if normal.y.abs() > 0.999 {
        return (Vec3::X, Vec3::NEG_Z * normal.y.signum());
    }
    let right = Vec3::Y.cross(normal).normalize();
    (right, normal.cross(right))
}
