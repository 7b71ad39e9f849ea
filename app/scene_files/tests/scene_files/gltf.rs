//! Law: the loaded scene is what the glTF file describes.
//!
//! A wrong loader would show mirrored parts inside out, lose millimetres far from the origin, or turn textures the
//! wrong way round.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::sync::Mutex;

use crate::support::{GltfUnderTest, load_path, png, write};
use glam::{DVec3, Vec2, Vec3};
use physics::{Celerity, Event};
use regular_file::Budget;
use scene::motion::{Motion, Uniform};
use scene::{Alpha, Scene, Start, Wrap};
use scene_files::export::write_glb;
use scene_files::gltf::{LoadStage, Progress, ReadRules, load};
use serde_json::json;
use tempfile::TempDir;

fn face_normal(scene: &Scene, triangle: usize) -> Vec3 {
    let mesh = &scene.meshes[0];
    let [a, b, c] = [0, 1, 2].map(|corner| mesh.positions[mesh.indices[3 * triangle + corner] as usize]);
    (b - a).cross(c - a).normalize()
}

#[test]
fn a_triangle_comes_in_as_it_is() {
    let scene = GltfUnderTest::triangle().scene();
    let mesh = &scene.meshes[0];
    assert_eq!(scene.name, "scene");
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y]);
    assert_eq!(mesh.indices, [0, 1, 2]);
    assert_eq!(mesh.normals, [Vec3::Z; 3], "without normals, triangles are flat");
    assert!((0..3).all(|vertex| mesh.colour(vertex) == [1.0; 4] && mesh.uv(vertex) == Vec2::ZERO));
    assert_eq!(mesh.name, "node 0");
    assert!(mesh.solid);
    assert_eq!(scene.materials[mesh.material].base_colour, [1.0; 4]);
    assert_eq!(scene.origin, DVec3::ZERO);
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
}

#[test]
fn what_moves_hangs_together_and_is_not_solid() {
    let mut file = GltfUnderTest::triangle();
    file.json["scenes"][0]["nodes"] = json!([0, 3]);
    file.json["nodes"] = json!([
        { "mesh": 0, "translation": [1, 2, 3], "children": [1, 2], "extras": { "celerity": [0, 0, -0.75], "at": 5 } },
        { "mesh": 0, "translation": [0, 1, 0] },
        { "mesh": 0, "translation": [0, 0, 1], "extras": { "celerity": [2, 0, 0], "rapidity": { "solid": true } } },
        { "mesh": 0, "extras": { "at": "home" } },
    ]);
    let scene = file.scene();
    let uniform = |celerity: DVec3, position: DVec3, ct: f64| {
        Motion::Uniform(Uniform { celerity: Celerity::new(celerity).unwrap(), anchor: Event { ct, position } })
    };
    let parent = uniform(DVec3::Z * -0.75, DVec3::new(1.0, 2.0, 3.0), 5.0);
    assert_eq!(scene.motions, [parent, uniform(DVec3::X * 2.0, DVec3::new(1.0, 2.0, 4.0), 0.0)]);
    let motions: Vec<_> = scene.meshes.iter().map(|mesh| mesh.motion).collect();
    assert_eq!(motions, [Some(0), Some(0), Some(1), None]);
    assert_eq!(scene.meshes.iter().map(|mesh| mesh.solid).collect::<Vec<_>>(), [false, false, false, true]);

    // After writing and reading again it moves as before.
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("again.glb");
    write_glb(&scene, &path).unwrap();
    let again = load_path(&path).unwrap();
    assert_eq!(again.motions, scene.motions);
    assert_eq!(again.meshes.iter().map(|mesh| mesh.motion).collect::<Vec<_>>(), motions);
    for (again, mesh) in again.meshes.iter().zip(&scene.meshes) {
        assert_eq!(again.positions, mesh.positions);
    }
}

#[test]
fn strips_and_fans_keep_their_winding() {
    for (mode, indices) in [(5, [0, 1, 2, 3]), (6, [0, 1, 3, 2])] {
        let mut file = GltfUnderTest::triangle();
        let square = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
        file.attribute("POSITION", square);
        file.indices(&indices);
        file.primitive()["mode"] = json!(mode);
        let scene = file.scene();
        assert_eq!(scene.triangle_count(), 2);
        for triangle in 0..2 {
            assert_eq!(face_normal(&scene, triangle), Vec3::Z, "mode {mode}, triangle {triangle}");
        }
    }
}

#[test]
fn incomplete_triangles_are_left_out_and_named() {
    let mut file = GltfUnderTest::triangle();
    file.indices(&[0, 1, 2, 0, 1]);
    let scene = file.scene();
    assert_eq!(scene.triangle_count(), 1);
    assert!(scene.notices[0].contains("incomplete triangle"), "{:?}", scene.notices);
}

#[test]
fn transforms_compose_from_child_to_root() {
    let mut file = GltfUnderTest::triangle();
    // Root: moved by 10 along x. Child: scaled by 2, then turned by 90° about y (x goes to −z).
    let half = 0.5_f64.sqrt();
    file.json["nodes"] = json!([
        { "translation": [10, 0, 0], "children": [1] },
        { "rotation": [0, half, 0, half], "scale": [2, 2, 2], "mesh": 0 },
    ]);
    let scene = file.scene();
    let expected = [Vec3::new(10.0, 0.0, 0.0), Vec3::new(10.0, 0.0, -4.0), Vec3::new(10.0, 2.0, 0.0)];
    for (position, expected) in scene.meshes[0].positions.iter().zip(expected) {
        assert!(position.distance(expected) < 1e-5, "{position} is not {expected}");
    }
    assert!(scene.meshes[0].normals[0].distance(Vec3::X) < 1e-6);
}

#[test]
fn a_matrix_is_read_by_columns() {
    let mut file = GltfUnderTest::triangle();
    file.json["nodes"][0]["matrix"] = json!([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]);
    let positions = &file.scene().meshes[0].positions;
    assert_eq!(*positions, [Vec3::new(5.0, 6.0, 7.0), Vec3::new(5.0, 8.0, 7.0), Vec3::new(4.0, 6.0, 7.0)]);
}

#[test]
fn mirrored_nodes_are_not_inside_out() {
    for scale in [[-1.0, 1.0, 1.0], [1.0, -3.0, 1.0], [2.0, 1.0, -0.5], [-1.0, -2.0, -3.0]] {
        let mut file = GltfUnderTest::triangle();
        file.json["nodes"][0]["scale"] = json!(scale);
        let scene = file.scene();
        // Front faces and normals agree: both point along the mirrored +z.
        let expected = Vec3::Z * f32::signum(scale[2]);
        assert_eq!(face_normal(&scene, 0), expected, "scale {scale:?}");
        assert_eq!(scene.meshes[0].normals[0], expected, "scale {scale:?}");
    }
}

#[test]
fn normals_stay_perpendicular_under_uneven_scale() {
    let mut file = GltfUnderTest::triangle();
    let slope = file.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -1.0]);
    file.attribute("POSITION", slope);
    let half = 0.5_f32.sqrt();
    let normals = file.floats("VEC3", &[[0.0, half, half]; 3].concat());
    file.attribute("NORMAL", normals);
    file.json["nodes"][0]["scale"] = json!([1, 5, 0.25]);
    let scene = file.scene();
    assert!(scene.meshes[0].normals[0].distance(face_normal(&scene, 0)) < 1e-6);
}

#[test]
fn flattened_nodes_keep_their_normal() {
    let mut file = GltfUnderTest::triangle();
    file.json["nodes"][0]["scale"] = json!([1, 1, 0]);
    assert_eq!(file.scene().meshes[0].normals, [Vec3::Z; 3]);
}

#[test]
fn far_worlds_keep_their_millimetres() {
    // At a thousand kilometres, f32 has steps of 6 cm.
    let mut file = GltfUnderTest::triangle();
    file.json["nodes"] = json!([
        { "translation": [1_000_000.125, -2_000_000.25, 3e9], "children": [1] },
        { "translation": [0.001, 0, 0], "mesh": 0 },
    ]);
    let scene = file.scene();
    let world = |position: Vec3| scene.origin + position.as_dvec3();
    let first = world(scene.meshes[0].positions[0]);
    assert!(first.distance(DVec3::new(1_000_000.126, -2_000_000.25, 3e9)) < 1e-6, "{first}");
    let start = scene.start.position;
    assert!(start.distance(first) < 10.0, "a visitor starts where the scene is, not at {start}");
}

#[test]
fn near_worlds_keep_the_files_coordinates() {
    let mut file = GltfUnderTest::triangle();
    file.json["nodes"][0]["translation"] = json!([100.5, 0, -7]);
    assert_eq!(file.scene().origin, DVec3::ZERO);
}

#[test]
fn integers_become_numbers() {
    let mut file = GltfUnderTest::triangle();
    // Quantised positions are used as they are, normalised coordinates and colours as fractions.
    let positions = file.accessor(&[0, 0, 0, 0, 9, 0, 0, 0, 0, 254, 0, 0], 5120, "VEC3", 3);
    let view = file.json["accessors"][positions]["bufferView"].as_u64().unwrap() as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    file.attribute("POSITION", positions);
    let uvs = file.accessor(&[0, 0, 255, 255, 255, 127, 0, 0, 0, 0, 0, 0], 5123, "VEC2", 3);
    file.json["accessors"][uvs]["normalized"] = json!(true);
    file.attribute("TEXCOORD_0", uvs);
    let colours = file.accessor(&[255, 0, 51, 102, 0, 255, 0, 0, 0, 0, 0, 255], 5121, "VEC4", 3);
    file.attribute("COLOR_0", colours);
    file.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let scene = file.scene();
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X * 9.0, Vec3::Y * -2.0]);
    assert_eq!(mesh.uvs[0], Vec2::new(0.0, 1.0));
    assert_eq!(mesh.uvs[1], Vec2::new(32767.0 / 65535.0, 0.0));
    assert_eq!(mesh.colours[0], [1.0, 0.0, 0.2, 0.4]);
}

#[test]
fn colours_without_opacity_are_opaque() {
    let mut file = GltfUnderTest::triangle();
    let colours = file.floats("VEC3", &[[0.5, 0.25, 0.75]; 3].concat());
    file.attribute("COLOR_0", colours);
    assert_eq!(file.scene().meshes[0].colours, [[0.5, 0.25, 0.75, 1.0]; 3]);
}

#[test]
fn sparse_accessors_replace_elements() {
    let mut file = GltfUnderTest::triangle();
    let indices = file.view(&[1]);
    let values = file.view(&[7.0_f32, 8.0, 9.0].map(f32::to_le_bytes).concat());
    file.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": indices, "componentType": 5121 },
        "values": { "bufferView": values },
    });
    assert_eq!(file.scene().meshes[0].positions, [Vec3::ZERO, Vec3::new(7.0, 8.0, 9.0), Vec3::Y]);
    file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert_eq!(file.scene().meshes[0].positions, [Vec3::ZERO, Vec3::new(7.0, 8.0, 9.0), Vec3::ZERO]);
    file.json["accessors"][0]["count"] = json!(1);
    assert!(file.error().contains("replaces element 1 of 1"), "{}", file.error());
}

#[test]
fn materials_carry_what_is_drawn() {
    let mut file = GltfUnderTest::triangle();
    let texture = file.texture(json!({ "wrapS": 33071, "wrapT": 33648, "magFilter": 9728 }));
    file.material(json!({
        "name": "leaf",
        "pbrMetallicRoughness": { "baseColorFactor": [0.5, 1, 0.25, 0.75], "baseColorTexture": { "index": texture } },
        "emissiveFactor": [0.25, 0.5, 1.0],
        "alphaMode": "MASK",
        "alphaCutoff": 0.3,
        "doubleSided": true,
        "extensions": { "KHR_materials_unlit": {}, "KHR_materials_emissive_strength": { "emissiveStrength": 8.0 } },
    }));
    let scene = file.scene();
    let material = &scene.materials[0];
    assert_eq!(material.name, "leaf");
    assert_eq!(material.base_colour, [0.5, 1.0, 0.25, 0.75]);
    assert_eq!(material.base_colour_texture, Some(0));
    assert_eq!(material.emissive, [2.0, 4.0, 8.0]);
    assert_eq!(material.alpha, Alpha::Mask(0.3));
    assert!(material.unlit && material.double_sided);
    assert!(!scene.meshes[0].solid, "leaves do not stop a bicycle");
    let texture = &scene.textures[0];
    assert_eq!((texture.width, texture.height, texture.name.as_str()), (2, 1, "flag"));
    assert_eq!(*texture.rgba, [255, 0, 0, 255, 0, 255, 0, 128]);
    assert_eq!(texture.wrap, [Wrap::Clamp, Wrap::Mirror]);
    assert!(texture.nearest);
}

#[test]
fn textures_of_one_picture_and_sampling_become_one() {
    let mut file = GltfUnderTest::triangle();
    let first = file.texture(json!({}));
    let unused = file.push("textures", json!({ "source": 0, "sampler": 0 }));
    let same = file.push("textures", json!({ "source": 0 }));
    let clamped = file.push("samplers", json!({ "wrapS": 33071 }));
    let other = file.push("textures", json!({ "source": 0, "sampler": clamped }));
    for texture in [first, same, other] {
        file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    }
    let scene = file.scene();
    let used: Vec<_> = scene.materials.iter().map(|material| material.base_colour_texture).collect();
    assert_eq!(used, [Some(0), Some(0), Some(1)], "texture {unused} is drawn by nothing");
    assert_eq!(scene.textures.len(), 2);
}

#[test]
fn texture_transforms_are_baked() {
    let mut file = GltfUnderTest::triangle();
    let uvs = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.attribute("TEXCOORD_1", uvs);
    let texture = file.texture(json!({}));
    // The transform is a quarter turn counter-clockwise, with v downwards: u runs up.
    let transform =
        json!({ "offset": [0.5, 0.25], "rotation": std::f64::consts::FRAC_PI_2, "scale": [2, 3], "texCoord": 1 });
    let extensions = json!({ "KHR_texture_transform": transform });
    file.material(
        json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture, "extensions": extensions } } }),
    );
    let expected = [Vec2::new(0.5, 0.25), Vec2::new(0.5, -1.75), Vec2::new(3.5, 0.25)];
    for (uv, expected) in file.scene().meshes[0].uvs.iter().zip(expected) {
        assert!(uv.distance(expected) < 1e-6, "{uv} is not {expected}");
    }
}

#[test]
fn what_is_not_drawn_is_named() {
    let mut file = GltfUnderTest::triangle();
    file.json["extensionsUsed"] = json!(["KHR_materials_clearcoat", "KHR_materials_unlit"]);
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } }]);
    file.json["animations"] = json!([{ "channels": [], "samplers": [] }, { "channels": [], "samplers": [] }]);
    file.json["skins"] = json!([{ "joints": [0] }]);
    file.primitive()["targets"] = json!([{}]);
    file.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "attributes": { "POSITION": 0 }, "mode": 1 }));
    let notices = file.scene().notices;
    for expected in ["KHR_materials_clearcoat", "skins do not move", "points and lines"] {
        assert!(notices.iter().any(|notice| notice.contains(expected)), "{expected} is not in {notices:?}");
    }
    assert_eq!(notices.len(), 3, "{notices:?}");
}

#[test]
fn a_scene_is_seen_first_from_its_first_perspective_camera() {
    let mut file = GltfUnderTest::triangle();
    file.json["cameras"] = json!([
        { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "zfar": 9, "znear": 0.1 }, "name": "plan" },
        { "type": "perspective", "perspective": { "yfov": 0.6, "znear": 0.1 }, "name": "door" },
    ]);
    let half = 0.5_f64.sqrt();
    let plan = file.push("nodes", json!({ "camera": 0, "translation": [9, 9, 9] }));
    let door = file.push("nodes", json!({ "camera": 1, "translation": [3, 1.5, 4], "rotation": [0, half, 0, half] }));
    file.json["scenes"][0]["nodes"] = json!([0, plan, door]);
    let scene = file.scene();
    let Start { position, look, up, eye_height_m, field_of_view_rad } = scene.start;
    assert_eq!((position, eye_height_m), (DVec3::new(3.0, 1.5, 4.0), 0.0), "the eye is where the camera is");
    assert!(look.distance(DVec3::NEG_X) < 1e-12 && up.distance(DVec3::Y) < 1e-12);
    assert!((field_of_view_rad.unwrap() - 0.6).abs() < 1e-7);
    let names: Vec<&str> = scene.cameras.iter().map(|camera| camera.name.as_str()).collect();
    assert_eq!(names, ["door", "plan"]);
    assert!(scene.notices.join("\n").contains("the camera \"plan\" is not perspective"), "{:?}", scene.notices);
}

#[test]
fn vertices_that_are_nowhere_are_counted() {
    let mut file = GltfUnderTest::triangle();
    let whole = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let nowhere = [0.0, 0.0, 0.0, f32::NAN, 0.0, 0.0, 0.0, f32::INFINITY, 0.0];
    let positions = file.floats("VEC3", &[whole, nowhere].concat());
    file.attribute("POSITION", positions);
    let notices = file.scene().notices;
    assert!(notices[0].contains("not finite): 2"), "{notices:?}");
    // Where nothing else is, there is nothing to draw.
    let positions = file.floats("VEC3", &nowhere);
    file.attribute("POSITION", positions);
    assert!(file.error().contains("none of its 1 triangles has finite corners"), "{}", file.error());
}

#[test]
fn buffers_and_pictures_beside_or_within_a_gltf_are_read() {
    let folder = TempDir::new().unwrap();
    let mut file = GltfUnderTest::triangle();
    let texture = file.texture(json!({}));
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    file.json["images"][0] = json!({ "uri": "a%20flag.png" });
    write(&folder, "a flag.png", &png(2, 1, &[9; 8]));
    write(&folder, "numbers.bin", &file.blob);

    file.json["buffers"][0]["uri"] = json!("numbers.bin");
    let path = write(&folder, "scene.gltf", file.json.to_string().as_bytes());
    let beside = load_path(&path).unwrap();
    assert_eq!(*beside.textures[0].rgba, [9; 8]);

    file.json["buffers"][0]["uri"] =
        json!(format!("data:application/octet-stream;base64,{}", base64::encode(&file.blob)));
    let path = write(&folder, "scene.gltf", file.json.to_string().as_bytes());
    assert_eq!(load_path(&path).unwrap().meshes[0].positions, beside.meshes[0].positions);
}

#[test]
fn a_missing_picture_is_a_notice() {
    let mut file = GltfUnderTest::triangle();
    let texture = file.texture(json!({}));
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    file.json["images"][0] = json!({ "uri": "nowhere.png" });
    let scene = file.scene();
    assert!(scene.notices[0].contains("nowhere.png"), "{:?}", scene.notices);
    assert_eq!(scene.materials[0].base_colour_texture, None);
}

#[test]
fn progress_ends_with_everything_done() {
    let mut file = GltfUnderTest::triangle();
    let texture = file.texture(json!({}));
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    let folder = TempDir::new().unwrap();
    let seen = Mutex::new(Vec::new());
    let rules = ReadRules { budget: &Budget::default(), trust: false };
    load(&write(&folder, "scene.glb", &file.glb()), rules, |progress| {
        seen.lock().unwrap().push(progress);
    })
    .unwrap();
    let expected = [LoadStage::Pictures, LoadStage::Meshes].map(|stage| Progress { stage, done: 1, total: 1 });
    assert_eq!(seen.into_inner().unwrap(), expected);
}
