//! Lattice of boxes: the simplest scene that shows how straight lines bend, and the one that tests know exactly.

use glam::{DVec3, Vec2, Vec3};
use scene::{Lighting, Material, Mesh, Scene, Start};

/// Dimensions of a lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Number of boxes along x, y and z.
    pub count: [u32; 3],
    /// Distance from one box's centre to the next's, metres.
    pub spacing: f32,
    /// Edge length of a box, metres.
    pub side: f32,
}

impl Default for Lattice {
    fn default() -> Self {
        Self { count: [10, 10, 10], spacing: 4.0, side: 1.0 }
    }
}

/// Normal and linear colour of each face; opposite faces differ, so that a box's orientation can be seen.
const FACES: [(Vec3, [f32; 3]); 6] = [
    (Vec3::X, [0.80, 0.10, 0.08]),
    (Vec3::NEG_X, [0.80, 0.45, 0.08]),
    (Vec3::Y, [0.85, 0.85, 0.80]),
    (Vec3::NEG_Y, [0.80, 0.70, 0.10]),
    (Vec3::Z, [0.10, 0.25, 0.75]),
    (Vec3::NEG_Z, [0.08, 0.55, 0.20]),
];

impl Lattice {
    /// Centre of box `[i, j, k]`, world metres; the lattice's middle is the world's origin.
    pub fn centre(&self, index: [u32; 3]) -> Vec3 {
        let along = |axis: usize| (index[axis] as f32 - (self.count[axis] as f32 - 1.0) / 2.0) * self.spacing;
        Vec3::new(along(0), along(1), along(2))
    }

    /// Linear colour of the face of any box whose outward normal is `normal`; `None` unless that is one of the six
    /// axis directions.
    pub fn face_colour(normal: Vec3) -> Option<[f32; 3]> {
        FACES.iter().find(|face| face.0 == normal).map(|face| face.1)
    }

    /// Builds the scene: unlit, twelve triangles a box, against a dark background.
    pub fn build(&self) -> Scene {
        let mut mesh = Mesh { name: "boxes".to_owned(), solid: true, ..Default::default() };
        let [columns, rows, layers] = self.count;
        for index in (0..columns * rows * layers).map(|n| [n % columns, n / columns % rows, n / (columns * rows)]) {
            let centre = self.centre(index);
            for (normal, colour) in FACES {
                self.push_face(&mut mesh, centre, normal, colour);
            }
        }
        Scene {
            name: "lattice".to_owned(),
            materials: vec![Material { name: "painted".to_owned(), unlit: true, ..Default::default() }],
            meshes: vec![mesh],
            light: Lighting {
                shadows: false,
                zenith: [0.004, 0.006, 0.012],
                horizon: [0.012, 0.016, 0.028],
                ground: [0.003, 0.004, 0.007],
                sun: [0.0; 3],
                ..Default::default()
            },
            start: Start { position: DVec3::new(0.0, 0.0, f64::from(self.spacing) / 2.0), ..Start::default() },
            ..Default::default()
        }
    }

    fn push_face(&self, mesh: &mut Mesh, centre: Vec3, normal: Vec3, [red, green, blue]: [f32; 3]) {
        // Two axes of the face such that u × v points outward: corners then run counter-clockwise.
        let u = Vec3::new(normal.y.abs(), normal.z.abs(), normal.x.abs());
        let v = normal.cross(u);
        let first = mesh.positions.len() as u32;
        for (du, dv) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            mesh.positions.push(centre + (normal + u * du + v * dv) * (self.side / 2.0));
            mesh.normals.push(normal);
            mesh.uvs.push(Vec2::new(du, dv) * 0.5 + 0.5);
            mesh.colours.push([red, green, blue, 1.0]);
        }
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: every face looks outward. A wrong winding would show boxes from the inside.

    use super::*;

    #[test]
    fn faces_wind_counter_clockwise_around_their_normals() {
        let scene = Lattice { count: [2, 1, 1], spacing: 3.0, side: 1.0 }.build();
        let mesh = &scene.meshes[0];
        assert_eq!(scene.triangle_count(), 24);
        for corners in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [corners[0], corners[1], corners[2]].map(|i| mesh.positions[i as usize]);
            assert_eq!((b - a).cross(c - a).normalize(), mesh.normals[corners[0] as usize]);
        }
    }
}
