//! Mesh under construction: coloured quads, boxes, discs and solids of few faces, from sums, products and quotients.

use crate::turn::circle;
use glam::{Vec2, Vec3};
use scene::Mesh;

/// Linear colour of a face.
pub(crate) type FaceColour = [f32; 3];

/// Mesh of flat faces, each of one colour.
#[derive(Default)]
pub(crate) struct Shape {
    mesh: Mesh,
}

impl Shape {
    /// Empty shape with this name, of the material with this index. `solid`: true if a vehicle collides with it.
    pub(crate) fn new(name: &str, material: usize, solid: bool) -> Self {
        Self { mesh: Mesh { name: name.to_owned(), material, solid, ..Mesh::default() } }
    }

    /// Finished mesh, with this motion.
    pub(crate) fn finish(self, motion: Option<usize>) -> Mesh {
        Mesh { motion, ..self.mesh }
    }

    /// Flat convex face, counter-clockwise as seen from its front.
    pub(crate) fn face(&mut self, corners: &[Vec3], colour: FaceColour) {
        let textured: Vec<(Vec3, Vec2)> = corners.iter().map(|corner| (*corner, Vec2::ZERO)).collect();
        self.textured(&textured, colour);
    }

    /// Flat convex face with the texture's coordinates at each corner.
    pub(crate) fn textured(&mut self, corners: &[(Vec3, Vec2)], [red, green, blue]: FaceColour) {
        let [a, b, c] = [0, 1, 2].map(|corner| corners[corner].0);
        let normal = (b - a).cross(c - a).normalize();
        let first = self.mesh.positions.len() as u32;
        for (at, uv) in corners {
            self.mesh.positions.push(*at);
            self.mesh.normals.push(normal);
            self.mesh.uvs.push(*uv);
            self.mesh.colours.push([red, green, blue, 1.0]);
        }
        for last in 2..corners.len() as u32 {
            self.mesh.indices.extend([first, first + last - 1, first + last]);
        }
    }

    /// Parallelogram at a corner, spanned by two sides; its front is where they run counter-clockwise.
    pub(crate) fn patch(&mut self, corner: Vec3, right: Vec3, up: Vec3, colour: FaceColour) {
        self.face(&[corner, corner + right, corner + right + up, corner + up], colour);
    }

    /// Six sides of a box between two corners.
    pub(crate) fn cuboid(&mut self, low: Vec3, high: Vec3, colour: FaceColour) {
        let size = high - low;
        let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
        self.patch(low + z, x, y, colour);
        self.patch(low + x, -x, y, colour);
        self.patch(low + x + z, -z, y, colour);
        self.patch(low, z, y, colour);
        self.patch(low + y + z, x, -z, colour);
        self.patch(low, x, z, colour);
    }

    /// Regular polygon about `centre` whose axes `right` and `up` are as long as its radius.
    pub(crate) fn disc(&mut self, centre: Vec3, right: Vec3, up: Vec3, sides: u32, colour: FaceColour) {
        let corners: Vec<Vec3> = (0..sides)
            .map(|side| {
                let at = circle(side as f32 / sides as f32);
                centre + right * at.x + up * at.y
            })
            .collect();
        self.face(&corners, colour);
    }

    /// Upright cone or trunk of a cone with flat sides, from `low` to `high`, metres above `foot`.
    pub(crate) fn cone(&mut self, foot: Vec3, [low, high]: [f32; 2], [wide, narrow]: [f32; 2], colour: FaceColour) {
        const SIDES: u32 = 7;
        let at = |side: u32, radius: f32, height: f32| {
            let c = circle(side as f32 / SIDES as f32);
            foot + Vec3::new(c.y * radius, height, c.x * radius)
        };
        for side in 0..SIDES {
            let mut corners = vec![at(side, wide, low), at(side + 1, wide, low), at(side + 1, narrow, high)];
            if narrow > 0.0 {
                corners.push(at(side, narrow, high));
            }
            self.face(&corners, colour);
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law: every face of a solid looks outward. A wrong winding would show it from the inside.

    use super::*;

    #[test]
    fn faces_of_boxes_and_cones_look_outward() {
        let mut shape = Shape::new("test", 0, false);
        shape.cuboid(Vec3::new(-1.0, -2.0, -3.0), Vec3::new(1.0, 2.0, 3.0), [1.0; 3]);
        shape.cone(Vec3::NEG_Y * 2.0, [0.0, 4.0], [2.0, 0.0], [1.0; 3]);
        let mesh = shape.finish(None);
        assert!(mesh.positions.iter().zip(&mesh.normals).all(|(at, normal)| at.dot(*normal) > 0.0));
    }
}
