//! Reading glTF: what a file says is what stands in the scene, and no file brings the program down.
//!
//! A wrong loader would show mirrored parts inside out, lose millimetres far from the origin, turn textures the wrong way round, or
//! panic on a length that lies. Files are built here, byte by byte, so that each says one thing.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, too, may fail the test")]

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use glam::{DVec3, Vec2, Vec3};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rapidity::scene::gltf::{GltfError, Progress, Stage, load};
use rapidity::scene::{Alpha, Scene, Wrap};
use serde_json::{Value, json};
use tempfile::TempDir;

/// How many broken files are tried in each of two ways.
const BROKEN_FILES: usize = 2000;

/// A file under construction: JSON and the binary chunk that it refers to.
struct File {
    json: Value,
    blob: Vec<u8>,
}

impl File {
    /// One triangle in the plane z = 0, at the only node.
    fn triangle() -> Self {
        let mut file = Self {
            json: json!({
                "asset": { "version": "2.0" },
                "scenes": [{ "nodes": [0] }],
                "nodes": [{ "mesh": 0 }],
                "meshes": [{ "primitives": [{ "attributes": {} }] }],
                "buffers": [{ "byteLength": 0 }],
                "bufferViews": [],
                "accessors": [],
            }),
            blob: Vec::new(),
        };
        let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        file.attribute("POSITION", positions);
        file
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        self.blob.resize(self.blob.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.blob.len(), "byteLength": bytes.len() });
        self.blob.extend_from_slice(bytes);
        self.json["buffers"][0]["byteLength"] = json!(self.blob.len());
        self.push("bufferViews", view)
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }))
    }

    fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(&bytes, 5126, kind, values.len() / width)
    }

    fn indices(&mut self, indices: &[u16]) {
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        let accessor = self.accessor(&bytes, 5123, "SCALAR", indices.len());
        self.primitive()["indices"] = json!(accessor);
    }

    fn attribute(&mut self, name: &str, accessor: usize) {
        self.primitive()["attributes"][name] = json!(accessor);
    }

    fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    /// Gives the primitive a material.
    fn material(&mut self, material: Value) {
        let index = self.push("materials", material);
        self.primitive()["material"] = json!(index);
    }

    /// Adds a texture with a 2 × 1 picture, red and half transparent green.
    fn texture(&mut self, sampler: Value) -> usize {
        let view = self.view(&png(2, 1, &[255, 0, 0, 255, 0, 255, 0, 128]));
        let image = self.push("images", json!({ "bufferView": view, "mimeType": "image/png", "name": "flag" }));
        let sampler = self.push("samplers", sampler);
        self.push("textures", json!({ "source": image, "sampler": sampler }))
    }

    /// Appends to one of the JSON's lists.
    fn push(&mut self, list: &str, item: Value) -> usize {
        let list = &mut self.json[list];
        if list.is_null() {
            *list = json!([]);
        }
        let list = list.as_array_mut().unwrap();
        list.push(item);
        list.len() - 1
    }

    fn glb(&self) -> Vec<u8> {
        let mut text = self.json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut blob = self.blob.clone();
        blob.resize(blob.len().next_multiple_of(4), 0);
        let length = 12 + 8 + text.len() + 8 + blob.len();
        let word = |value: usize| (value as u32).to_le_bytes();
        let parts: [&[u8]; 9] =
            [b"glTF", &word(2), &word(length), &word(text.len()), b"JSON", &text, &word(blob.len()), b"BIN\0", &blob];
        parts.concat()
    }

    fn load(&self) -> Result<Scene, GltfError> {
        load_bytes(&self.glb())
    }

    fn scene(&self) -> Scene {
        let scene = self.load().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.fault(), None);
        scene
    }

    /// The error's text, which must name the file.
    fn error(&self) -> String {
        let error = self.load().expect_err("this file is wrong").to_string();
        assert!(error.contains("scene.glb"), "{error}");
        error
    }
}

fn png(width: u32, height: u32, rgba: &[u8]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_raw(width, height, rgba.to_vec())
        .unwrap()
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

fn write(folder: &TempDir, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

fn load_bytes(bytes: &[u8]) -> Result<Scene, GltfError> {
    let folder = TempDir::new().unwrap();
    load(&write(&folder, "scene.glb", bytes), |_| {})
}

fn face_normal(scene: &Scene, triangle: usize) -> Vec3 {
    let mesh = &scene.meshes[0];
    let [a, b, c] = [0, 1, 2].map(|corner| mesh.positions[mesh.indices[3 * triangle + corner] as usize]);
    (b - a).cross(c - a).normalize()
}

#[test]
fn a_triangle_comes_in_as_it_is() {
    let scene = File::triangle().scene();
    let mesh = &scene.meshes[0];
    assert_eq!(scene.name, "scene");
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y]);
    assert_eq!(mesh.indices, [0, 1, 2]);
    assert_eq!(mesh.normals, [Vec3::Z; 3], "without normals, triangles are flat");
    assert_eq!(mesh.colours, [[1.0; 4]; 3]);
    assert_eq!(mesh.name, "node 0");
    assert!(mesh.solid);
    assert_eq!(scene.materials[mesh.material].base_colour, [1.0; 4]);
    assert_eq!(scene.origin, DVec3::ZERO);
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
}

#[test]
fn strips_and_fans_keep_their_winding() {
    for (mode, indices) in [(5, [0, 1, 2, 3]), (6, [0, 1, 3, 2])] {
        let mut file = File::triangle();
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
    let mut file = File::triangle();
    file.indices(&[0, 1, 2, 0, 1]);
    let scene = file.scene();
    assert_eq!(scene.triangle_count(), 1);
    assert!(scene.notices[0].contains("incomplete triangle"), "{:?}", scene.notices);
}

#[test]
fn transforms_compose_from_child_to_root() {
    let mut file = File::triangle();
    // Root: moved by 10 along x. Child: turned by 90° about y (x goes to −z), then scaled by 2 before that.
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
    let mut file = File::triangle();
    file.json["nodes"][0]["matrix"] = json!([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]);
    let positions = &file.scene().meshes[0].positions;
    assert_eq!(*positions, [Vec3::new(5.0, 6.0, 7.0), Vec3::new(5.0, 8.0, 7.0), Vec3::new(4.0, 6.0, 7.0)]);
}

#[test]
fn mirrored_nodes_are_not_inside_out() {
    for scale in [[-1.0, 1.0, 1.0], [1.0, -3.0, 1.0], [2.0, 1.0, -0.5], [-1.0, -2.0, -3.0]] {
        let mut file = File::triangle();
        file.json["nodes"][0]["scale"] = json!(scale);
        let scene = file.scene();
        // Front faces and normals stay together: both point where the mirrored +z does.
        let expected = Vec3::Z * f32::signum(scale[2]);
        assert_eq!(face_normal(&scene, 0), expected, "scale {scale:?}");
        assert_eq!(scene.meshes[0].normals[0], expected, "scale {scale:?}");
    }
}

#[test]
fn normals_stay_perpendicular_under_uneven_scale() {
    let mut file = File::triangle();
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
    let mut file = File::triangle();
    file.json["nodes"][0]["scale"] = json!([1, 1, 0]);
    assert_eq!(file.scene().meshes[0].normals, [Vec3::Z; 3]);
}

#[test]
fn far_worlds_keep_their_millimetres() {
    // A thousand kilometres away, f32 has steps of 6 cm.
    let mut file = File::triangle();
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
    let mut file = File::triangle();
    file.json["nodes"][0]["translation"] = json!([100.5, 0, -7]);
    assert_eq!(file.scene().origin, DVec3::ZERO);
}

#[test]
fn integers_become_numbers() {
    let mut file = File::triangle();
    // Quantised positions as they are, normalised coordinates and colours as fractions.
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
    let mut file = File::triangle();
    let colours = file.floats("VEC3", &[[0.5, 0.25, 0.75]; 3].concat());
    file.attribute("COLOR_0", colours);
    assert_eq!(file.scene().meshes[0].colours, [[0.5, 0.25, 0.75, 1.0]; 3]);
}

#[test]
fn sparse_accessors_replace_elements() {
    let mut file = File::triangle();
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
    let mut file = File::triangle();
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
    assert_eq!(texture.rgba, [255, 0, 0, 255, 0, 255, 0, 128]);
    assert_eq!(texture.wrap, [Wrap::Clamp, Wrap::Mirror]);
    assert!(texture.nearest);
}

#[test]
fn textures_of_one_picture_and_sampling_become_one() {
    let mut file = File::triangle();
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
    let mut file = File::triangle();
    let uvs = file.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    file.attribute("TEXCOORD_1", uvs);
    let texture = file.texture(json!({}));
    // A quarter turn counter-clockwise, with v downwards: u runs up.
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
    let mut file = File::triangle();
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_materials_unlit"]);
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } }]);
    file.json["animations"] = json!([{ "channels": [], "samplers": [] }, { "channels": [], "samplers": [] }]);
    file.json["skins"] = json!([{ "joints": [0] }]);
    file.primitive()["targets"] = json!([{}]);
    file.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "attributes": { "POSITION": 0 }, "mode": 1 }));
    let notices = file.scene().notices;
    for expected in
        ["KHR_lights_punctual", "cameras", "animations stand still (2)", "skins", "morph", "points and lines"]
    {
        assert!(notices.iter().any(|notice| notice.contains(expected)), "{expected} is not in {notices:?}");
    }
    assert_eq!(notices.len(), 6, "{notices:?}");
}

#[test]
fn a_camera_says_where_to_start() {
    let mut file = File::triangle();
    file.json["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } }]);
    let half = 0.5_f64.sqrt();
    file.push("nodes", json!({ "camera": 0, "translation": [3, 1.5, 4], "rotation": [0, half, 0, half] }));
    file.json["scenes"][0]["nodes"] = json!([0, 1]);
    let start = file.scene().start;
    assert_eq!(start.position, DVec3::new(3.0, 1.5, 4.0));
    assert!(start.look.distance(DVec3::NEG_X) < 1e-12);
}

#[test]
fn vertices_that_are_nowhere_are_counted() {
    let mut file = File::triangle();
    let positions = file.floats("VEC3", &[0.0, 0.0, 0.0, f32::NAN, 0.0, 0.0, 0.0, f32::INFINITY, 0.0]);
    file.attribute("POSITION", positions);
    let notices = file.scene().notices;
    assert!(notices[0].contains("not finite): 2"), "{notices:?}");
}

#[test]
fn buffers_and_pictures_beside_or_within_a_gltf_are_read() {
    let folder = TempDir::new().unwrap();
    let mut file = File::triangle();
    let texture = file.texture(json!({}));
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    file.json["images"][0] = json!({ "uri": "a%20flag.png" });
    write(&folder, "a flag.png", &png(2, 1, &[9; 8]));
    write(&folder, "numbers.bin", &file.blob);

    file.json["buffers"][0]["uri"] = json!("numbers.bin");
    let path = write(&folder, "scene.gltf", file.json.to_string().as_bytes());
    let beside = load(&path, |_| {}).unwrap();
    assert_eq!(beside.textures[0].rgba, [9; 8]);

    file.json["buffers"][0]["uri"] =
        json!(format!("data:application/octet-stream;base64,{}", base64::encode(&file.blob)));
    let path = write(&folder, "scene.gltf", file.json.to_string().as_bytes());
    assert_eq!(load(&path, |_| {}).unwrap().meshes[0].positions, beside.meshes[0].positions);
}

#[test]
fn a_missing_picture_is_a_notice() {
    let mut file = File::triangle();
    let texture = file.texture(json!({}));
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    file.json["images"][0] = json!({ "uri": "nowhere.png" });
    let scene = file.scene();
    assert!(scene.notices[0].contains("nowhere.png"), "{:?}", scene.notices);
    assert_eq!(scene.materials[0].base_colour_texture, None);
}

#[test]
fn progress_ends_with_everything_done() {
    let mut file = File::triangle();
    let texture = file.texture(json!({}));
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    let folder = TempDir::new().unwrap();
    let seen = Mutex::new(Vec::new());
    load(&write(&folder, "scene.glb", &file.glb()), |progress| {
        seen.lock().unwrap().push(progress);
    })
    .unwrap();
    let expected = [Stage::Pictures, Stage::Meshes].map(|stage| Progress { stage, done: 1, total: 1 });
    assert_eq!(seen.into_inner().unwrap(), expected);
}

#[test]
fn files_that_are_no_scenes_are_refused_with_advice() {
    let folder = TempDir::new().unwrap();
    let refused = |path: &Path, words: &str| {
        let error = load(path, |_| {}).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains(&*path.to_string_lossy()), "{error}");
    };
    refused(&folder.path().join("nowhere.glb"), "check the name");
    refused(folder.path(), "is not a file");
    refused(&write(&folder, "empty.glb", b""), "is empty");
    refused(&write(&folder, "text.gltf", b"once upon a time"), "neither a .glb nor JSON");
    refused(&write(&folder, "cut.gltf", b"{ \"asset\": { \"version\": "), "not glTF 2.0");
    refused(&write(&folder, "other.gltf", b"{ \"name\": 1 }"), "missing field `asset`");
    refused(&write(&folder, "old.gltf", b"{ \"asset\": { \"version\": \"1.0\" }, \"nodes\": {} }"), "version is 1.0");
    refused(&write(&folder, "bare.gltf", b"{ \"asset\": { \"version\": \"2.0\" } }"), "nothing to draw");
    let whole = File::triangle().glb();
    refused(&write(&folder, "short.glb", &whole[..whole.len() - 8]), "cut short");
    refused(&write(&folder, "magic.glb", b"glTF"), "cut short");
    refused(&write(&folder, "v1.glb", b"glTF\x01\0\0\0\x0c\0\0\0"), "version 1");
}

#[test]
fn contradictions_are_named_with_their_place() {
    let refused = |change: fn(&mut File), words: &[&str]| {
        let mut file = File::triangle();
        change(&mut file);
        let error = file.error();
        assert!(words.iter().all(|word| error.contains(word)), "{words:?} are not in: {error}");
    };
    refused(|file| file.json["nodes"][0]["mesh"] = json!(5), &["nodes[0].mesh", "no number 5 among 1"]);
    refused(|file| file.json["scene"] = json!(3), &["at scene", "no number 3"]);
    refused(|file| file.json["scenes"][0]["nodes"] = json!([9]), &["nodes[9]"]);
    refused(|file| file.json["nodes"][0]["children"] = json!([0]), &["nodes[0]", "its own ancestor"]);
    refused(|file| file.json["scenes"][0]["nodes"] = json!([0, 0]), &["nodes[0]", "two parents"]);
    refused(|file| file.primitive()["attributes"] = json!({}), &["meshes[0].primitives[0]", "POSITION is missing"]);
    refused(|file| file.primitive()["attributes"]["POSITION"] = json!(77), &["no number 77"]);
    refused(|file| file.primitive()["material"] = json!(0), &["material", "no number 0 among 0"]);
    refused(|file| file.primitive()["mode"] = json!(7), &["mode"]);
    refused(|file| file.indices(&[0, 1, 3]), &["indices", "vertex 3 of 3"]);
    refused(|file| file.json["accessors"][0]["count"] = json!(4), &["accessors[0]", "4 elements"]);
    refused(|file| file.json["accessors"][0]["count"] = json!(0), &["accessors[0]", "no elements"]);
    refused(|file| file.json["accessors"][0]["count"] = json!(u64::MAX), &["accessors[0]", "too large"]);
    refused(|file| file.json["accessors"][0]["byteOffset"] = json!(u64::MAX), &["accessors[0]"]);
    refused(|file| file.json["accessors"][0]["type"] = json!("VEC2"), &["accessors[0]", "Vec2"]);
    refused(|file| file.json["accessors"][0]["componentType"] = json!(1), &["accessors[0]", "unknown"]);
    refused(|file| file.json["bufferViews"][0]["byteLength"] = json!(999), &["bufferViews[0]", "999 bytes"]);
    refused(|file| file.json["bufferViews"][0]["byteOffset"] = json!(u64::MAX), &["bufferViews[0]"]);
    refused(|file| file.json["bufferViews"][0]["byteStride"] = json!(8), &["accessors[0]", "every 8 bytes"]);
    refused(|file| file.json["bufferViews"][0]["buffer"] = json!(1), &["bufferViews[0]", "no number 1"]);
    refused(|file| file.json["buffers"][0]["byteLength"] = json!(1000), &["buffers[0]", "cut short"]);
    refused(|file| file.json["buffers"][0]["uri"] = json!("data:text/plain,abc"), &["buffers[0]", "base64"]);
    refused(|file| file.json["buffers"][0]["uri"] = json!("https://example.org/a.bin"), &["buffers[0]", "beside"]);
    refused(|file| file.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]), &["KHR_draco"]);
    refused(|file| file.primitive()["mode"] = json!(0), &["nothing to draw"]);
    refused(|file| file.json["scenes"][0]["extras"] = json!({ "rapidity": { "sun": 1 } }), &["extras.rapidity", "sun"]);
    refused(
        |file| {
            let normals = file.floats("VEC3", &[0.0, 1.0, 0.0]);
            file.attribute("NORMAL", normals);
        },
        &["NORMAL", "1 entries for 3 positions"],
    );
}

#[test]
fn a_bomb_of_instances_is_refused_before_it_goes_off() {
    // Ten thousand nodes, each with a mesh whose ten thousand primitives share one accessor.
    let mut file = File::triangle();
    let primitive = file.primitive().clone();
    file.json["meshes"][0]["primitives"] = json!(vec![primitive; 10_000]);
    file.json["nodes"] = json!(vec![json!({ "mesh": 0 }); 10_000]);
    file.json["scenes"][0]["nodes"] = json!((0..10_000).collect::<Vec<_>>());
    let error = file.error();
    assert!(error.contains("too large"), "{error}");
}

#[test]
fn a_picture_bomb_is_refused_before_it_is_decoded() {
    let mut file = File::triangle();
    let texture = file.texture(json!({}));
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    // The size stands at byte 16 of a PNG, behind its signature; its checksum is at 29.
    let mut bomb = png(1, 1, &[0; 4]);
    bomb[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    let checksum = crc32(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&checksum.to_be_bytes());
    let view = file.view(&bomb);
    file.json["images"][0]["bufferView"] = json!(view);
    let error = file.error();
    assert!(error.contains("65536 × 65536"), "{error}");
}

/// The checksum of PNG chunks (ISO 3309).
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}

/// A file in which nearly everything that is read occurs.
fn rich_file() -> File {
    let mut file = File::triangle();
    let normals = file.floats("VEC3", &[[0.0, 0.0, 1.0]; 3].concat());
    file.attribute("NORMAL", normals);
    let uvs = file.floats("VEC2", &[0.0; 6]);
    file.attribute("TEXCOORD_0", uvs);
    let colours = file.accessor(&[255; 12], 5121, "VEC4", 3);
    file.attribute("COLOR_0", colours);
    file.indices(&[0, 1, 2, 2]);
    file.primitive()["mode"] = json!(5);
    let texture = file.texture(json!({ "wrapS": 33071 }));
    let extensions = json!({ "KHR_texture_transform": { "scale": [2, 2] } });
    file.material(
        json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture, "extensions": extensions } } }),
    );
    let (indices, values) = (file.view(&[1, 2]), file.view(&[0; 24]));
    file.json["accessors"][0]["sparse"] = json!({
        "count": 2,
        "indices": { "bufferView": indices, "componentType": 5121 },
        "values": { "bufferView": values },
    });
    file.json["nodes"] = json!([
        { "translation": [1, 2, 3], "children": [1], "extras": { "rapidity": { "solid": false } } },
        { "rotation": [0, 0, 0, 1], "scale": [1, 1, -1], "mesh": 0 },
    ]);
    file.json["scenes"][0]["extras"] = json!({ "rapidity": { "origin": [0, 0, 0], "circuit": [[1, 2, 3]] } });
    file
}

/// Loads what may be broken: any result will do if it is sound.
fn survive(bytes: &[u8]) -> bool {
    match load_bytes(bytes) {
        Ok(scene) => {
            assert_eq!(scene.fault(), None);
            true
        }
        Err(error) => {
            assert!(error.to_string().contains("scene.glb"), "{error}");
            false
        }
    }
}

#[test]
fn broken_bytes_never_panic() {
    let whole = rich_file().glb();
    assert!(survive(&whole));
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..BROKEN_FILES {
        let mut bytes = whole.clone();
        for _ in 0..random.random_range(1..4) {
            let place = random.random_range(0..bytes.len());
            bytes[place] = random.random();
        }
        survive(&bytes);
    }
}

#[test]
fn files_cut_anywhere_are_refused() {
    let whole = rich_file().glb();
    for length in 0..whole.len() {
        assert!(!survive(&whole[..length]), "{length} of {} bytes were taken for a scene", whole.len());
    }
}

#[test]
fn lying_numbers_never_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let lies = [json!(-1), json!(0), json!(1), json!(3), json!(255), json!(65536), json!(u32::MAX), json!(u64::MAX)];
    let more =
        [json!(1e300), json!(-0.5), json!(null), json!([]), json!({}), json!("x"), json!([1e300, 0, 0]), json!([0])];
    let lies: Vec<Value> = lies.into_iter().chain(more).collect();
    let mut loaded = 0;
    for _ in 0..BROKEN_FILES {
        let mut file = rich_file();
        for _ in 0..random.random_range(1..3) {
            let lie = lies[random.random_range(0..lies.len())].clone();
            corrupt(&mut file.json, &mut random, lie);
        }
        loaded += usize::from(survive(&file.glb()));
    }
    assert!(loaded > 0 && loaded < BROKEN_FILES, "{loaded} of {BROKEN_FILES} were taken for scenes");
}

/// Replaces a random value somewhere in a JSON tree.
fn corrupt(value: &mut Value, random: &mut impl Rng, lie: Value) {
    let child = match value {
        Value::Array(items) if !items.is_empty() => {
            let index = random.random_range(0..items.len());
            items.get_mut(index)
        }
        Value::Object(items) if !items.is_empty() => {
            let index = random.random_range(0..items.len());
            items.values_mut().nth(index)
        }
        _ => None,
    };
    match child {
        Some(child) => corrupt(child, random, lie),
        None => *value = lie,
    }
}
