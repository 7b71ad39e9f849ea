//! Law: primitives that share one large set of vertices take memory for their own triangles alone, and every attribute
//! still belongs to its vertex. A wrong program takes the whole set once for each primitive, or mixes up vertices.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::support::GltfUnderTest;
use glam::Vec3;
use serde_json::{Value, json};

/// Number of vertices that are shared.
const VERTICES: usize = 60_000;

/// Number of primitives. Each with all the vertices would exceed the usual limit of memory.
const PRIMITIVES: usize = 2_000;

/// Place of a vertex.
fn place(vertex: usize) -> Vec3 {
    Vec3::new(vertex as f32 * 0.125, (vertex % 3) as f32, (vertex % 7) as f32)
}

#[test]
fn primitives_that_share_vertices_take_only_their_own() {
    let mut file = GltfUnderTest::triangle();
    let all = |of: &dyn Fn(usize) -> Vec3| (0..VERTICES).flat_map(|vertex| of(vertex).to_array()).collect::<Vec<_>>();
    let positions = file.floats("VEC3", &all(&place));
    let normals = file.floats("VEC3", &all(&|vertex| if vertex % 2 == 0 { Vec3::X } else { Vec3::Y }));
    let uvs: Vec<f32> = (0..VERTICES).flat_map(|vertex| [vertex as f32, 0.5]).collect();
    let uvs = file.floats("VEC2", &uvs);
    let colours: Vec<u8> = (0..VERTICES).flat_map(|vertex| [(vertex % 256) as u8, 255, 0, 255]).collect();
    let colours = file.accessor(&colours, 5121, "VEC4", VERTICES);
    // Morph target that moves vertex 31 alone, by a sparse accessor.
    let (moved, way) =
        (file.view(&31_u16.to_le_bytes()), file.view(&[0.0_f32, 0.0, 5.0].map(f32::to_le_bytes).concat()));
    let sparse = json!({
        "count": 1,
        "indices": { "bufferView": moved, "componentType": 5123 },
        "values": { "bufferView": way },
    });
    let target = json!({ "componentType": 5126, "type": "VEC3", "count": VERTICES, "sparse": sparse });
    let target = file.push("accessors", target);
    let primitive = |file: &mut GltfUnderTest, number: usize| -> Value {
        let corners = [3 * number + 2, 3 * number, 3 * number + 1].map(|corner| (corner as u32).to_le_bytes());
        let indices = file.accessor(&corners.concat(), 5125, "SCALAR", 3);
        let attributes = json!({ "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs, "COLOR_0": colours });
        json!({ "attributes": attributes, "indices": indices, "targets": [{ "POSITION": target }] })
    };
    let primitives: Vec<Value> = (0..PRIMITIVES).map(|number| primitive(&mut file, number)).collect();
    file.json["meshes"] = json!([{ "primitives": primitives, "weights": [1.0] }]);
    file.material(json!({ "pbrMetallicRoughness": {} }));

    let scene = file.scene();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert_eq!(scene.vertex_count(), 3 * PRIMITIVES);
    for (number, mesh) in scene.meshes.iter().enumerate() {
        assert_eq!(mesh.indices, [2, 0, 1], "primitive {number}");
        for corner in 0..3 {
            let vertex = 3 * number + corner;
            let moved = if vertex == 31 { 5.0 * Vec3::Z } else { Vec3::ZERO };
            assert_eq!(mesh.positions[corner] + scene.origin.as_vec3(), place(vertex) + moved, "vertex {vertex}");
            assert_eq!(mesh.normals[corner], if vertex % 2 == 0 { Vec3::X } else { Vec3::Y }, "vertex {vertex}");
            assert_eq!(mesh.colour(corner)[0], (vertex % 256) as f32 / 255.0, "vertex {vertex}");
        }
    }
}

#[test]
fn vertices_of_no_triangle_do_not_count() {
    let mut file = GltfUnderTest::triangle();
    let corners = [[9.0, 9.0, 9.0], [0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let positions = file.floats("VEC3", &corners.concat());
    file.attribute("POSITION", positions);
    file.indices(&[1, 2, 3]);
    let mesh = &file.scene().meshes[0];
    assert_eq!(mesh.positions, [1, 2, 3].map(|corner| Vec3::from_array(corners[corner])));
    assert_eq!(mesh.normals, [Vec3::Z; 3]);
}
