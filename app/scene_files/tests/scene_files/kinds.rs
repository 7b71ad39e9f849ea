//! Law: what a file says is where and how it is drawn: joints place a skinned mesh, weights move a morphed one,
//! instances repeat one, compressed data are the numbers that were compressed, and each texture has its own
//! coordinates. A wrong program draws raw vertices, one instance for all, or a fallback without its colours.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::support::{GltfUnderTest, load_path, png, write};
use base64::encode;
use glam::{DVec3, Vec2, Vec3};
use scene::Scene;
use serde_json::{Value, json};
use tempfile::TempDir;

/// Rounding of f32 numbers of a few metres.
const ROUNDED: f32 = 1e-5;

/// Positions of a square of 2 m in the plane z = 0, in the vertex coding of meshoptimizer's encoder.
const SQUARE_MESHOPT: &str = "a1eaeaaa00ff00ff0000ff00000000000000000000000080bf000080bf00000000000000";

/// Its two triangles.
const TRIANGLES_MESHOPT: &str = "e1f000007687566778a9866589689801690000";

/// The same square, by Google's Draco encoder with 14 bits.
const SQUARE_DRACO: &str = "445241434f02020101000000040200020000011fff011101ff00000100090300000201010100030301300110030028829800\
    00000000ff3f0000000080bf000080bf00000000000000400e";

/// Corners of the square.
const CORNERS: [[f32; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

fn hex(text: &str) -> Vec<u8> {
    let digits: Vec<char> = text.chars().filter(|digit| !digit.is_whitespace()).collect();
    digits.chunks(2).map(|pair| u8::from_str_radix(&pair.iter().collect::<String>(), 16).unwrap()).collect()
}

/// Joins of a triangle's vertices to joints, and their weights.
fn skin(file: &mut GltfUnderTest, joints: &[u8], weights: &[f32]) {
    let joints = file.accessor(joints, 5121, "VEC4", joints.len() / 4);
    file.attribute("JOINTS_0", joints);
    let weights = file.floats("VEC4", weights);
    file.attribute("WEIGHTS_0", weights);
}

fn assert_positions(scene: &Scene, expected: &[Vec3]) {
    let found: Vec<Vec3> = scene.meshes.iter().flat_map(|mesh| mesh.positions.iter().copied()).collect();
    let same = found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| (*a + scene.origin.as_vec3()).distance(*b) < ROUNDED * 10.0);
    assert!(same, "{found:?}");
}

#[test]
fn joints_place_a_skinned_mesh_and_its_node_does_not() {
    let mut file = GltfUnderTest::triangle();
    // Half way between a joint that stays and one 2 m up; entirely at the one that is twice as large; at the first.
    skin(
        &mut file,
        &[0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0],
        &[0.5, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    );
    let inverse: Vec<f32> = (0..3).flat_map(|_| glam::Mat4::IDENTITY.to_cols_array()).collect();
    let bytes: Vec<u8> = inverse.iter().flat_map(|value| value.to_le_bytes()).collect();
    let inverse = file.accessor(&bytes, 5126, "MAT4", 3);
    file.json["skins"] = json!([{ "joints": [1, 2, 3], "inverseBindMatrices": inverse }]);
    file.json["nodes"] = json!([
        { "mesh": 0, "skin": 0, "translation": [0, 500, 0], "scale": [100, 100, 100] },
        { "translation": [1, 0, 0], "children": [2] },
        { "translation": [0, 2, 0] },
        { "scale": [2, 2, 2] },
    ]);
    file.json["scenes"][0]["nodes"] = json!([0, 1, 3]);
    let scene = file.scene();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert_positions(&scene, &[Vec3::new(1.0, 1.0, 0.0), Vec3::new(4.0, 0.0, 0.0), Vec3::new(1.0, 1.0, 0.0)]);
    // A joint that does not exist leaves the mesh where its node is, and says so.
    file.json["skins"][0]["joints"] = json!([1, 2, 77]);
    let said = file.scene().notices.join("\n");
    assert!(said.contains("1 skin is not applied: nodes[0]") && said.contains("nodes[77]"), "{said}");
}

#[test]
fn weights_of_the_node_or_the_mesh_move_morph_targets() {
    let mut file = GltfUnderTest::triangle();
    let up = file.floats("VEC3", &[[0.0, 1.0, 0.0]; 3].concat());
    let out = file.floats("VEC3", &[[0.0, 0.0, 8.0]; 3].concat());
    file.primitive()["targets"] = json!([{ "POSITION": up }, { "POSITION": out }]);
    let corner = |file: &GltfUnderTest| file.scene().meshes[0].positions[0];
    assert_eq!(corner(&file), Vec3::ZERO, "no weights, no change");
    file.json["meshes"][0]["weights"] = json!([0.5, 0.25]);
    assert_eq!(corner(&file), Vec3::new(0.0, 0.5, 2.0));
    file.json["nodes"][0]["weights"] = json!([0, 1]);
    assert_eq!(corner(&file), Vec3::new(0.0, 0.0, 8.0), "the node's weights count more");
    assert_eq!(file.scene().meshes[0].normals[0], Vec3::Z);
}

#[test]
fn every_instance_of_a_mesh_is_drawn() {
    let mut file = GltfUnderTest::triangle();
    let places = file.floats("VEC3", &[0.0, 0.0, 0.0, 0.0, 3.0, 0.0]);
    let sizes = file.floats("VEC3", &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    let attributes = json!({ "TRANSLATION": places, "SCALE": sizes });
    file.json["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    file.json["nodes"][0]["translation"] = json!([10, 0, 0]);
    file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    let scene = file.scene();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    let expected =
        [[10.0, 0.0, 0.0], [12.0, 0.0, 0.0], [10.0, 1.0, 0.0], [10.0, 3.0, 0.0], [14.0, 3.0, 0.0], [10.0, 5.0, 0.0]];
    assert_positions(&scene, &expected.map(Vec3::from_array));
}

#[test]
fn hidden_nodes_and_their_children_are_not_drawn() {
    let mut file = GltfUnderTest::triangle();
    file.json["nodes"] = json!([
        { "children": [1], "extensions": { "KHR_node_visibility": { "visible": false } } },
        { "mesh": 0 },
        { "mesh": 0, "extensions": { "KHR_node_visibility": { "visible": true } } },
    ]);
    file.json["scenes"][0]["nodes"] = json!([0, 2]);
    assert_eq!(file.scene().meshes.len(), 1);
}

/// Square whose positions and indices are in two views, with extensions for compressed data.
fn square(views: [Value; 2], blob: Vec<u8>, primitive: Value) -> GltfUnderTest {
    GltfUnderTest {
        json: json!({
            "asset": { "version": "2.0" },
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [primitive] }],
            "buffers": [{ "byteLength": blob.len() }, { "byteLength": 60, "extensions": { "EXT_meshopt_compression": { "fallback": true } } }],
            "bufferViews": views,
            "accessors": [
                { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4 },
                { "bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 6 },
            ],
        }),
        blob,
    }
}

fn assert_square(scene: &Scene, rounding: f32) {
    let mut triangles = Vec::new();
    let mesh = &scene.meshes[0];
    for corners in mesh.indices.as_chunks::<3>().0 {
        triangles.push(corners.map(|corner| mesh.positions[corner as usize]));
    }
    assert_eq!(triangles.len(), 2);
    for [x, y] in CORNERS {
        let there = |at: &Vec3| at.distance(Vec3::new(x, y, 0.0)) < rounding;
        assert!(triangles.iter().flatten().any(there), "no corner at {x}, {y}: {triangles:?}");
    }
    let area: f32 = triangles.iter().map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a).z).sum();
    assert!((area - 4.0).abs() < 8.0 * rounding, "{area}");
}

#[test]
fn data_that_meshopt_compressed_are_what_they_were() {
    let (positions, triangles) = (hex(SQUARE_MESHOPT), hex(TRIANGLES_MESHOPT));
    let view = |offset: usize, length: usize, count: usize, stride: usize, mode: &str, from: usize| {
        json!({ "buffer": 1, "byteOffset": from, "byteLength": count * stride, "extensions": { "EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": offset, "byteLength": length, "byteStride": stride, "count": count, "mode": mode,
        } } })
    };
    let views = [
        view(0, positions.len(), 4, 12, "ATTRIBUTES", 0),
        view(positions.len(), triangles.len(), 6, 2, "TRIANGLES", 48),
    ];
    let primitive = json!({ "attributes": { "POSITION": 0 }, "indices": 1 });
    let mut file = square(views, [positions, triangles].concat(), primitive);
    file.json["extensionsRequired"] = json!(["EXT_meshopt_compression"]);
    let scene = file.scene();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert_square(&scene, ROUNDED);
    // A size that the data do not have is refused before memory is taken for it.
    file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = json!(4_000_000_000_u64);
    let error = file.error();
    assert!(error.contains("bufferViews[0]") || error.contains("accessors[0]"), "{error}");
}

#[test]
fn data_that_meshopt_compressed_may_be_there_plainly_too() {
    let plain: Vec<u8> = CORNERS.iter().flat_map(|[x, y]| [*x, *y, 0.0]).flat_map(f32::to_le_bytes).collect();
    let triangles: Vec<u8> = [0_u16, 1, 2, 0, 2, 3].iter().flat_map(|index| index.to_le_bytes()).collect();
    let broken = json!({ "buffer": 0, "byteLength": 48, "extensions": { "EXT_meshopt_compression": {
        "buffer": 0, "byteOffset": 0, "byteLength": 48, "byteStride": 12, "count": 4, "mode": "ATTRIBUTES",
    } } });
    let views = [broken, json!({ "buffer": 0, "byteOffset": 48, "byteLength": 12 })];
    let file = square(views, [plain, triangles].concat(), json!({ "attributes": { "POSITION": 0 }, "indices": 1 }));
    assert_square(&file.scene(), ROUNDED);
}

#[test]
fn a_draco_mesh_is_what_it_was_to_its_quantisation() {
    let bytes = hex(SQUARE_DRACO);
    let primitive = json!({ "attributes": { "POSITION": 0 }, "indices": 1, "extensions": { "KHR_draco_mesh_compression": {
        "bufferView": 0, "attributes": { "POSITION": 0 },
    } } });
    let views = [json!({ "buffer": 0, "byteLength": bytes.len() }), json!({ "buffer": 0, "byteLength": 0 })];
    let mut file = square(views, bytes, primitive);
    file.json["accessors"] = json!([
        { "componentType": 5126, "type": "VEC3", "count": 4 },
        { "componentType": 5123, "type": "SCALAR", "count": 6 },
    ]);
    file.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let scene = file.scene();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert_square(&scene, 2.0 / 16383.0);
    for length in 0..file.blob.len() {
        let blob = file.blob[..length].to_vec();
        let mut cut = GltfUnderTest { json: file.json.clone(), blob };
        cut.json["bufferViews"][0]["byteLength"] = json!(length);
        cut.json["buffers"][0]["byteLength"] = json!(length);
        assert!(cut.error().contains("KHR_draco_mesh_compression"), "{length} bytes were enough");
    }
}

#[test]
fn specular_glossiness_gives_colour_and_picture() {
    let mut file = GltfUnderTest::triangle();
    let texture = file.texture(json!({}));
    let specular = json!({ "diffuseFactor": [1, 0.25, 0.5, 1], "diffuseTexture": { "index": texture } });
    file.material(json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": specular } }));
    file.json["extensionsRequired"] = json!(["KHR_materials_pbrSpecularGlossiness"]);
    let scene = file.scene();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert_eq!(scene.materials[0].base_colour, [1.0, 0.25, 0.5, 1.0]);
    assert_eq!(*scene.textures[scene.materials[0].base_colour_texture.unwrap()].rgba, [255, 0, 0, 255, 0, 255, 0, 128]);
    assert_eq!(scene.materials[0].metallic, 0.0);
}

#[test]
fn an_emissive_map_has_coordinates_of_its_own() {
    let mut file = GltfUnderTest::triangle();
    let first = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.attribute("TEXCOORD_0", first);
    let second = file.floats("VEC2", &[0.5, 0.5, 0.75, 0.5, 0.5, 0.75]);
    file.attribute("TEXCOORD_1", second);
    let texture = file.texture(json!({}));
    let transform = json!({ "KHR_texture_transform": { "offset": [0.0, 0.25] } });
    file.material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } },
        "emissiveTexture": { "index": texture, "texCoord": 1, "extensions": transform },
    }));
    let mesh = &file.scene().meshes[0];
    assert_eq!((mesh.uvs[1], mesh.emissive_uvs[1]), (Vec2::new(1.0, 0.0), Vec2::new(0.75, 0.75)));
    // The same coordinates are stored once.
    file.json["materials"][0]["emissiveTexture"] = json!({ "index": texture });
    assert!(file.scene().meshes[0].emissive_uvs.is_empty());
}

#[test]
fn a_picture_that_cannot_be_read_gives_way_to_its_fallback() {
    let mut file = GltfUnderTest::triangle();
    let texture = file.texture(json!({}));
    let broken = file.view(b"RIFF\x10\0\0\0WEBPVP8 ");
    let image = file.push("images", json!({ "bufferView": broken }));
    file.json["textures"][texture]["extensions"] = json!({ "EXT_texture_webp": { "source": image } });
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    let scene = file.scene();
    assert_eq!(scene.textures.len(), 1);
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    file.json["textures"][texture]["source"] = json!(image);
    let scene = file.scene();
    assert!(
        scene.textures.is_empty() && scene.notices[0].starts_with("1 picture is not drawn: images[1]")
            || scene.notices[0].starts_with("2 pictures are not drawn: images[1]"),
        "{:?}",
        scene.notices
    );
}

#[test]
fn pictures_that_share_their_bytes_are_decoded_and_kept_once() {
    let mut file = GltfUnderTest::triangle();
    let view = file.view(&png(1, 1, &[10, 20, 30, 255]));
    for wrap in [10497, 33071] {
        let image = file.push("images", json!({ "bufferView": view }));
        let sampler = file.push("samplers", json!({ "wrapS": wrap }));
        file.push("textures", json!({ "source": image, "sampler": sampler }));
    }
    file.material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } }, "emissiveTexture": { "index": 1 },
    }));
    let [first, second] = &file.scene().textures[..] else { unreachable!("there are two") };
    assert!(std::sync::Arc::ptr_eq(&first.rgba, &second.rgba) && first.wrap != second.wrap);
}

#[test]
fn files_are_found_whatever_the_form_of_their_names() {
    let folder = TempDir::new().unwrap();
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    let bytes = png(1, 1, &[1, 2, 3, 255]);
    for name in ["with space.png", "ä.png", "100%.png", "sub/back.png"] {
        write(&folder, name, &bytes);
    }
    for uri in ["with%20space.png", "with space.png", "ä.png", "%C3%A4.png", "100%.png", "sub\\back.png", "./ä.png"] {
        let mut file = GltfUnderTest::triangle();
        file.push("images", json!({ "uri": uri }));
        file.push("textures", json!({ "source": 0 }));
        file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
        let scene = load_path(&write(&folder, "scene.glb", &file.glb())).unwrap();
        assert_eq!(scene.textures.len(), 1, "{uri}: {:?}", scene.notices);
    }
}

#[test]
fn containers_may_be_wrong_in_every_harmless_way() {
    let folder = TempDir::new().unwrap();
    let file = GltfUnderTest::triangle();
    let whole = file.glb();
    let positions =
        |bytes: &[u8], name: &str| load_path(&write(&folder, name, bytes)).unwrap().meshes[0].positions.clone();
    let expected = positions(&whole, "plain.glb");
    assert_eq!(positions(&whole, "UPPER.GLB"), expected);
    assert_eq!(positions(&[&whole[..], b"more"].concat(), "after.glb"), expected);
    let chunk = [&4_u32.to_le_bytes()[..], b"ABCD", b"abcd"].concat();
    let mut third = [&whole[..], &chunk].concat();
    let length = (third.len() as u32).to_le_bytes();
    third[8..12].copy_from_slice(&length);
    assert_eq!(positions(&third, "third.glb"), expected);
    let mut text = file.json.clone();
    text["buffers"][0]["uri"] = json!(format!("data:;base64,{}", encode(&file.blob)));
    let zeros = [text.to_string().as_bytes(), b"\n\0\0\0"].concat();
    assert_eq!(positions(&zeros, "zeros.gltf"), expected);
    assert_eq!(positions(&[b"\xef\xbb\xbf", text.to_string().as_bytes()].concat(), "mark.gltf"), expected);
    // Whole numbers with a fraction, members that are null.
    let floats =
        text.to_string().replace("\"count\":3", "\"count\":3.0").replace("\"mesh\":0", "\"mesh\":0.0,\"skin\":null");
    assert_eq!(positions(floats.as_bytes(), "floats.gltf"), expected);
}

#[test]
fn a_file_outside_the_folder_needs_trust() {
    let folder = TempDir::new().unwrap();
    std::fs::create_dir(folder.path().join("scene")).unwrap();
    let file = GltfUnderTest::triangle();
    write(&folder, "outside.bin", &file.blob);
    let mut text = file.json.clone();
    text["buffers"][0]["uri"] = json!("../outside.bin");
    let path = write(&folder, "scene/a.gltf", text.to_string().as_bytes());
    assert!(load_path(&path).unwrap_err().to_string().contains("allow it with --trust"));
    let rules = scene_files::gltf::ReadRules { budget: &regular_file::Budget::default(), trust: true };
    assert_eq!(scene_files::gltf::load(&path, rules, |_| {}).unwrap().triangle_count(), 1);
}

#[test]
fn a_model_without_a_start_is_framed_and_one_with_a_floor_is_stood_on() {
    let scene = GltfUnderTest::triangle().scene();
    assert!(!scene.start.is_on_ground() && scene.start.eye().z > 1.0, "{:?}", scene.start);
    assert_eq!(scene.speed_of_light_m_s, Some(0.45));
    // A floor of 20 m with a wall across it.
    let mut file = GltfUnderTest::triangle();
    let floor: [[f32; 3]; 7] = [
        [-10.0, 0.0, -10.0],
        [-10.0, 0.0, 10.0],
        [10.0, 0.0, 10.0],
        [10.0, 0.0, -10.0],
        [-4.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 6.0, 0.0],
    ];
    let positions = file.floats("VEC3", &floor.concat());
    file.attribute("POSITION", positions);
    file.indices(&[0, 1, 2, 0, 2, 3, 4, 5, 6]);
    let start = file.scene().start;
    assert!(start.is_on_ground() && start.position.y.abs() < 1e-6, "{start:?}");
    assert!(start.position.distance(DVec3::Z * 9.6) < 1e-6 && start.look == DVec3::NEG_Z, "{start:?}");
}
