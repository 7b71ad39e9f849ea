//! Sheets: meshes under construction from flat patches in cells and bodies of revolution, fine enough to carry light
//! at their vertices.

use glam::{Vec2, Vec3, vec2, vec3};
use rayon::prelude::*;

use crate::turn::circle;
use scene::Mesh;

/// Number of sides of round bodies.
const SIDES: u32 = 48;

/// Mesh under construction, of one material; texture coordinates are metres.
pub(super) struct HallSheet {
    mesh: Mesh,
    /// Longest edge of a patch's cells, metres.
    cell: f32,
}

impl HallSheet {
    pub(super) fn new(name: impl Into<String>, material: usize, cell: f32) -> Self {
        Self { mesh: Mesh { name: name.into(), material, solid: true, ..Mesh::default() }, cell }
    }

    /// Finished mesh, with its light at each vertex as colour: `light` gives the emitted share for a position and
    /// normal.
    pub(super) fn shaded(mut self, light: impl Fn(Vec3, Vec3) -> f32 + Sync) -> Mesh {
        let Mesh { positions, normals, colours, .. } = &mut self.mesh;
        let lit = positions.par_iter().zip(&*normals).map(|(&position, &normal)| light(position, normal));
        *colours = lit.map(|light| [light, light, light, 1.0]).collect();
        self.mesh
    }

    /// Adds a parallelogram whose front faces along `across` × `along`.
    pub(super) fn patch(&mut self, corner: Vec3, across: Vec3, along: Vec3) {
        let cells = |edge: Vec3| (edge.length() / self.cell).ceil().max(1.0) as u32;
        let normal = across.cross(along).normalize();
        let size = vec2(across.length(), along.length());
        self.grid([cells(across), cells(along)], |share| {
            (corner + across * share.x + along * share.y, normal, vec2(share.x, 1.0 - share.y) * size)
        });
    }

    /// Adds the six sides of an upright box.
    pub(super) fn block(&mut self, low: Vec3, high: Vec3) {
        let size = high - low;
        let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
        self.patch(low + z, x, y);
        self.patch(high - y, -z, y);
        self.patch(low + x, -x, y);
        self.patch(low, z, y);
        self.patch(low + y + z, x, -z);
        self.patch(low, x, z);
    }

    pub(super) fn ball(&mut self, centre: Vec3, radius: f32) {
        self.grid([SIDES, SIDES / 2], |share| {
            // From pole to pole is half a turn.
            let height = circle(share.y / 2.0 - 0.25);
            let normal = around(share.x, height.x, height.y);
            (centre + normal * radius, normal, share * radius)
        });
    }

    /// Adds an upright cylinder on `base`, with its lid.
    pub(super) fn drum(&mut self, base: Vec3, radius: f32, height: f32) {
        let rings = (height / self.cell).ceil().max(1.0) as u32;
        self.grid([SIDES, rings], |share| {
            let normal = around(share.x, 1.0, 0.0);
            (base + normal * radius + Vec3::Y * height * share.y, normal, share * height)
        });
        let lid = base + Vec3::Y * height;
        self.grid([SIDES, 4], |share| (lid + around(share.x, radius * (1.0 - share.y), 0.0), Vec3::Y, share * radius));
    }

    /// Adds cells over the unit square: `place` gives position, normal and texture coordinates for each share of the
    /// way. Triangles without area, at a pole, are left out.
    fn grid(&mut self, [columns, rows]: [u32; 2], place: impl Fn(Vec2) -> (Vec3, Vec3, Vec2)) {
        let first = self.mesh.positions.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                let (position, normal, uv) = place(vec2(column as f32 / columns as f32, row as f32 / rows as f32));
                self.mesh.positions.push(position);
                self.mesh.normals.push(normal);
                self.mesh.uvs.push(uv);
            }
        }
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            let corner = |right: u32, up: u32| first + (row + up) * (columns + 1) + column + right;
            for triangle in [[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]] {
                let corners = triangle.map(|(right, up)| corner(right, up));
                let [a, b, c] = corners.map(|index| self.mesh.positions[index as usize]);
                if (b - a).cross(c - a).length_squared() > MIN_AREA_SQUARED {
                    self.mesh.indices.extend(corners);
                }
            }
        }
    }
}

/// Square of twice the area, m⁴, below which a triangle lies at a pole.
const MIN_AREA_SQUARED: f32 = 1e-12;

/// Point on a circle about the vertical axis, counter-clockwise from above.
fn around(turns: f32, radius: f32, height: f32) -> Vec3 {
    let c = circle(turns);
    vec3(c.y * radius, height, c.x * radius)
}
