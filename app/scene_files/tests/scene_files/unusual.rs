//! Law: what is unusual, or faulty in one place, is drawn as the file says and otherwise like the rest: shapes that an
//! animation holds, cameras that it moves, parts of a skin without joints, metals of another material model, views that
//! are longer than their buffer. A wrong program draws them elsewhere, black, or not at all.

use crate::support::GltfUnderTest;
use glam::{DVec3, Vec3};
use serde_json::{Value, json};

/// Adds an animation with one channel, and gives the index of its output.
fn animate(file: &mut GltfUnderTest, target: Value, interpolation: &str, times: &[f32], output: usize) {
    let bytes: Vec<u8> = times.iter().flat_map(|value| value.to_le_bytes()).collect();
    let input = file.accessor(&bytes, 5126, "SCALAR", times.len());
    file.json["animations"] = json!([{
        "channels": [{ "sampler": 0, "target": target }],
        "samplers": [{ "input": input, "output": output, "interpolation": interpolation }],
    }]);
}

fn scalars(file: &mut GltfUnderTest, values: &[f32]) -> usize {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    file.accessor(&bytes, 5126, "SCALAR", values.len())
}

#[test]
fn a_shape_that_an_animation_holds_is_a_pose() {
    for (interpolation, times, values) in [
        ("STEP", vec![0.0, 1.0], vec![0.5, 0.0, 0.5, 0.0]),
        ("LINEAR", vec![3.0], vec![0.5, 0.0]),
        ("CUBICSPLINE", vec![0.0, 1.0], vec![0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0]),
    ] {
        let mut file = GltfUnderTest::triangle();
        let [up, out] = [[0.0, 1.0, 0.0], [0.0, 0.0, 8.0]].map(|moved| file.floats("VEC3", &[moved; 3].concat()));
        file.primitive()["targets"] = json!([{ "POSITION": up }, { "POSITION": out }]);
        let output = scalars(&mut file, &values);
        animate(&mut file, json!({ "node": 0, "path": "weights" }), interpolation, &times, output);
        let scene = file.scene();
        assert!(scene.notices.is_empty(), "{interpolation}: {:?}", scene.notices);
        assert_eq!(scene.meshes[0].positions[0], Vec3::new(0.0, 0.5, 0.0), "{interpolation}");
    }
    // A shape that changes stands still.
    let mut file = GltfUnderTest::triangle();
    let output = scalars(&mut file, &[0.0, 1.0]);
    animate(&mut file, json!({ "node": 0, "path": "weights" }), "LINEAR", &[0.0, 1.0], output);
    assert!(file.scene().notices[0].contains("changes a shape"));
}

#[test]
fn cubic_keys_that_hold_one_value_are_a_pose() {
    let mut file = GltfUnderTest::triangle();
    let output = file.floats("VEC3", &[[0.0; 3], [5.0, 0.0, 0.0], [0.0; 3]].concat().repeat(2));
    animate(&mut file, json!({ "node": 0, "path": "translation" }), "CUBICSPLINE", &[0.0, 1.0], output);
    let scene = file.scene();
    assert!(scene.motions.is_empty() && scene.meshes[0].solid);
    assert_eq!(scene.meshes[0].positions[0] + scene.origin.as_vec3(), Vec3::new(5.0, 0.0, 0.0));
}

#[test]
fn a_camera_that_keys_move_is_where_they_begin() {
    let mut file = GltfUnderTest::triangle();
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }]);
    let camera = file.push("nodes", json!({ "camera": 0, "translation": [-50, 0, 4] }));
    file.json["scenes"][0]["nodes"] = json!([0, camera]);
    let output = file.floats("VEC3", &[1.0, 0.0, 6.0, 2.0, 0.0, 6.0]);
    animate(&mut file, json!({ "node": camera, "path": "translation" }), "LINEAR", &[0.0, 9.0], output);
    assert_eq!(file.scene().start.position, DVec3::new(1.0, 0.0, 6.0));
}

#[test]
fn a_skinned_part_without_joints_is_where_its_node_is() {
    let mut file = GltfUnderTest::triangle();
    file.json["skins"] = json!([{ "joints": [1] }]);
    file.json["nodes"] = json!([{ "mesh": 0, "skin": 0, "translation": [1, 0, 0] }, { "translation": [7, 7, 7] }]);
    file.json["scenes"][0]["nodes"] = json!([0, 1]);
    let scene = file.scene();
    assert!(scene.notices[0].contains("1 skin is not applied"), "{:?}", scene.notices);
    let first = scene.meshes[0].positions[0] + scene.origin.as_vec3();
    assert!(first.distance(Vec3::X) < 1e-5, "{first}");
}

#[test]
fn a_metal_without_a_diffuse_colour_has_its_specular_one() {
    let mut file = GltfUnderTest::triangle();
    file.material(json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0, 0, 0, 1], "specularFactor": [1.0, 0.76, 0.33], "glossinessFactor": 0.75 } } }));
    let scene = file.scene();
    let metal = &scene.materials[0];
    assert!((metal.base_colour[1] - 0.76).abs() < 0.01 && metal.metallic > 0.99, "{metal:?}");
    assert_eq!(metal.roughness, 0.25);
    // With a map of specular colours, that is the one; with one of diffuse colours, too, it is named.
    let map = file.texture(json!({}));
    let specular = &mut file.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"];
    specular["specularGlossinessTexture"] = json!({ "index": map });
    let scene = file.scene();
    assert_eq!((scene.materials[0].base_colour_texture, scene.materials[0].base_colour[2]), (Some(0), 0.33));
    let specular = &mut file.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"];
    specular["diffuseTexture"] = json!({ "index": map });
    specular["diffuseFactor"] = json!([1, 1, 1, 1]);
    assert!(file.scene().notices[0].contains("metals are dark"), "{:?}", file.scene().notices);
}

#[test]
fn a_view_that_is_longer_than_its_buffer_is_read_as_far_as_it_is_needed() {
    let mut file = GltfUnderTest::triangle();
    file.json["bufferViews"][0]["byteLength"] = json!(99);
    assert_eq!(file.scene().meshes[0].positions.len(), 3);
    file.json["accessors"][0]["count"] = json!(4);
    assert!(file.error().contains("4 elements"));
}

#[test]
fn what_is_there_instead_of_triangles_is_named() {
    let mut file = GltfUnderTest::triangle();
    file.json["nodes"][0]["extensions"] = json!({ "KHR_node_visibility": { "visible": false } });
    assert!(file.error().contains("hidden nodes"), "{}", file.error());
    file.json["scenes"][0]["nodes"] = json!([]);
    assert!(file.error().contains("nodes without meshes"), "{}", file.error());
}

#[test]
fn a_packed_view_of_an_unknown_form_is_named() {
    let mut file = GltfUnderTest::triangle();
    file.json["bufferViews"][0]["byteLength"] = json!(9999);
    file.json["bufferViews"][0]["byteOffset"] = json!(9999);
    let packed = |key: &str| {
        let mut extension = json!({ "buffer": 0, "byteLength": 9, "count": 3, "byteStride": 12, "mode": "ATTRIBUTES" });
        extension[key] = json!("FOLDED");
        json!({ "EXT_meshopt_compression": extension })
    };
    for key in ["mode", "filter"] {
        file.json["bufferViews"][0]["extensions"] = packed(key);
        assert!(file.error().contains(&format!("the {key} FOLDED")), "{}", file.error());
    }
}
