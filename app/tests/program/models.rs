//! Models as people have them: a `.glb` without a camera, a start or any word of this program.

use glam::Vec3;
use std::f32::consts::TAU;

/// Model under construction: triangles of a few colours, in metres.
#[derive(Default)]
pub struct Model {
    parts: Vec<ModelPart>,
}

/// Triangles of one colour.
struct ModelPart {
    colour: [f32; 3],
    positions: Vec<Vec3>,
    indices: Vec<u32>,
}

impl Model {
    /// Adds a box from its least to its greatest corner, metres.
    pub fn cuboid(&mut self, colour: [f32; 3], least: [f32; 3], most: [f32; 3]) {
        let corner = |bits: usize| Vec3::from_array([0, 1, 2].map(|axis| [least, most][bits >> axis & 1][axis]));
        let positions: Vec<Vec3> = (0..8).map(corner).collect();
        let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let indices = sides.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).collect();
        self.parts.push(ModelPart { colour, positions, indices });
    }

    /// Adds a torus about the z axis, its two radii in metres.
    pub fn torus(&mut self, colour: [f32; 3], radius: f32, thickness: f32) {
        let (around, across) = (64_u32, 24_u32);
        let point = |index: u32| {
            let (turn, lean) = ((index / across) as f32 / around as f32, (index % across) as f32 / across as f32);
            let (out, up) = (radius + thickness * (lean * TAU).cos(), thickness * (lean * TAU).sin());
            Vec3::new(out * (turn * TAU).cos(), out * (turn * TAU).sin(), up)
        };
        let square = |index: u32| {
            let (turn, lean) = (index / across, index % across);
            let at = |turn: u32, lean: u32| turn % around * across + lean % across;
            let [a, b, c, d] = [at(turn, lean), at(turn + 1, lean), at(turn + 1, lean + 1), at(turn, lean + 1)];
            [a, b, c, a, c, d]
        };
        let positions = (0..around * across).map(point).collect();
        let indices = (0..around * across).flat_map(square).collect();
        self.parts.push(ModelPart { colour, positions, indices });
    }

    /// The model as `.glb`.
    pub fn glb(&self) -> Vec<u8> {
        let mut blob: Vec<u8> = Vec::new();
        let (mut views, mut accessors, mut primitives, mut materials) = (vec![], vec![], vec![], vec![]);
        let mut add = |bytes: &[u8], component: u32, kind: &str, count: usize| {
            let offset = blob.len();
            blob.extend_from_slice(bytes);
            let number = views.len();
            views.push(format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{}}}"#, bytes.len()));
            accessors.push(format!(
                r#"{{"bufferView":{number},"componentType":{component},"count":{count},"type":"{kind}"}}"#
            ));
            number
        };
        for (number, part) in self.parts.iter().enumerate() {
            let positions: Vec<u8> =
                part.positions.iter().flat_map(|position| position.to_array()).flat_map(f32::to_le_bytes).collect();
            let indices: Vec<u8> = part.indices.iter().flat_map(|index| index.to_le_bytes()).collect();
            let positions = add(&positions, 5126, "VEC3", part.positions.len());
            let indices = add(&indices, 5125, "SCALAR", part.indices.len());
            let [red, green, blue] = part.colour;
            materials.push(format!(
                r#"{{"pbrMetallicRoughness":{{"baseColorFactor":[{red},{green},{blue},1],"metallicFactor":0}}}}"#
            ));
            primitives.push(format!(
                r#"{{"attributes":{{"POSITION":{positions}}},"indices":{indices},"material":{number}}}"#
            ));
        }
        let mut text = format!(
            r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{}]}}],"materials":[{}],"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}}"#,
            primitives.join(","),
            materials.join(","),
            accessors.join(","),
            views.join(","),
            blob.len()
        )
        .into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let word = |value: usize| (value as u32).to_le_bytes();
        let length = 12 + 8 + text.len() + 8 + blob.len();
        let parts: [&[u8]; 9] =
            [b"glTF", &word(2), &word(length), &word(text.len()), b"JSON", &text, &word(blob.len()), b"BIN\0", &blob];
        parts.concat()
    }
}

/// Ring of 2 cm, with a stone.
pub fn ring() -> Model {
    let mut model = Model::default();
    model.torus([0.9, 0.7, 0.25], 0.009, 0.001);
    model.cuboid([0.7, 0.9, 1.0], [-0.0015, 0.0095, -0.0015], [0.0015, 0.0125, 0.0015]);
    model
}

/// Chair with its middle on the origin, as modelling programs leave it.
pub fn chair() -> Model {
    let mut model = Model::default();
    let wood = [0.6, 0.38, 0.2];
    for (x, z) in [(-0.2, -0.2), (0.2, -0.2), (-0.2, 0.2), (0.2, 0.2)] {
        model.cuboid(wood, [x - 0.02, -0.45, z - 0.02], [x + 0.02, 0.0, z + 0.02]);
    }
    model.cuboid([0.75, 0.2, 0.2], [-0.23, 0.0, -0.23], [0.23, 0.04, 0.23]);
    for x in [-0.2, 0.0, 0.2] {
        model.cuboid(wood, [x - 0.02, 0.04, -0.22], [x + 0.02, 0.45, -0.18]);
    }
    model.cuboid(wood, [-0.22, 0.38, -0.22], [0.22, 0.45, -0.18]);
    model
}

/// House on a lawn of 30 m.
pub fn house() -> Model {
    let mut model = Model::default();
    model.cuboid([0.3, 0.5, 0.2], [-15.0, -0.2, -15.0], [15.0, 0.0, 15.0]);
    model.cuboid([0.85, 0.8, 0.7], [-5.0, 0.0, -4.0], [5.0, 5.0, 4.0]);
    for storey in 0..6 {
        let (low, inset) = (5.0 + 0.5 * storey as f32, 0.8 * storey as f32);
        model.cuboid([0.6, 0.25, 0.2], [-5.5 + inset, low, -4.5], [5.5 - inset, low + 0.5, 4.5]);
    }
    model.cuboid([0.4, 0.25, 0.15], [-0.6, 0.0, 4.0], [0.6, 2.2, 4.1]);
    for x in [-3.2, 2.2] {
        for y in [0.9, 3.2] {
            model.cuboid([0.3, 0.4, 0.55], [x, y, 4.0], [x + 1.1, y + 1.2, 4.1]);
        }
    }
    model
}

/// City of 4 km, its blocks of different heights.
pub fn city() -> Model {
    let mut model = Model::default();
    model.cuboid([0.35, 0.37, 0.36], [-2000.0, -5.0, -2000.0], [2000.0, 0.0, 2000.0]);
    for block in 0..400_u32 {
        let (x, z) = ((block % 20) as f32 * 200.0 - 1990.0, (block / 20) as f32 * 200.0 - 1990.0);
        let middle = (1.0 - (x / 2000.0).hypot(z / 2000.0)).max(0.0);
        let height = 25.0 + 300.0 * middle * middle + (block * 7919 % 97) as f32;
        let shade = 0.5 + (block * 31 % 40) as f32 * 0.01;
        model.cuboid([shade, shade * 0.95, shade * 0.85], [x + 20.0, 0.0, z + 20.0], [x + 160.0, height, z + 160.0]);
    }
    model
}
