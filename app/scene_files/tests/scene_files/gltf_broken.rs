//! Law: each file that is no scene, or lies about its contents, ends in a sentence that names the file and the place;
//! none ends in a panic or in more memory than a scene may have.
//!
//! A wrong loader would believe an offset, a count or a picture's size without checking it, walk in circles, or take
//! half a file for a whole one.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::path::Path;

use crate::support::{GltfUnderTest, load_bytes, load_path, png, write};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use regular_file::Budget;
use scene_files::gltf::{ReadRules, load};
use serde_json::{Value, json};
use tempfile::TempDir;

/// Number of broken files tried in each of two ways.
const BROKEN_FILES: usize = 2000;

#[test]
fn files_that_are_no_scenes_are_refused_with_advice() {
    let folder = TempDir::new().unwrap();
    let refused = |path: &Path, words: &str| {
        let error = load_path(path).unwrap_err().to_string();
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
    let whole = GltfUnderTest::triangle().glb();
    refused(&write(&folder, "short.glb", &whole[..whole.len() - 8]), "28 bytes of 36 are there: it is cut short");
    refused(&write(&folder, "magic.glb", b"glTF"), "cut short");
    refused(&write(&folder, "v1.glb", b"glTF\x01\0\0\0\x0c\0\0\0"), "version 1");
}

#[test]
fn contradictions_are_named_with_their_place() {
    let refused = |change: fn(&mut GltfUnderTest), words: &[&str]| {
        let mut file = GltfUnderTest::triangle();
        change(&mut file);
        let error = file.error();
        assert!(words.iter().all(|word| error.contains(word)), "{words:?} are not in: {error}");
    };
    // The only triangle is faulty, so nothing is left, and the sentence names the fault.
    refused(|file| file.json["nodes"][0]["mesh"] = json!(5), &["nodes[0].mesh", "no number 5 among 1"]);
    refused(|file| file.json["nodes"][0] = json!([]), &["nodes[0]", "expected an object"]);
    // A number that a transform cannot have costs that part of it alone.
    for (key, numbers, fault) in [
        ("translation", json!([0, 1e39, 0]), "1e39 is out of range"),
        ("rotation", json!([0, 0, 0, -1e300]), "-1e300 is out of range"),
    ] {
        let mut file = GltfUnderTest::triangle();
        file.json["nodes"][0][key] = numbers;
        let said = file.scene().notices.join("\n");
        assert!(said.contains(&format!("nodes[0].{key}")) && said.contains(fault), "{said}");
    }
    let moving = |extras: Value, key: &str, fault: &str| {
        let mut file = GltfUnderTest::triangle();
        file.json["nodes"][0]["extras"] = extras;
        let error = file.error();
        assert!(error.contains(key) && error.contains(fault), "{error}");
    };
    for celerity in [json!(0.9), json!([1, 2]), json!([0, 0, "fast"]), json!([0, 0, null])] {
        moving(json!({ "celerity": celerity }), "nodes[0].extras.celerity", "expected three finite numbers");
    }
    moving(json!({ "celerity": [0, 0, 1], "at": "noon" }), "nodes[0].extras.at", "metres of light travel");
    moving(json!({ "rapidity": { "solud": true } }), "nodes[0].extras.rapidity", "unknown field `solud`");
    refused(|file| file.json["scenes"][0]["nodes"] = json!([9]), &["nodes[9]", "no number 9 among 1"]);
    refused(|file| file.primitive()["attributes"]["POSITION"] = json!(77), &["no number 77"]);
    refused(|file| file.primitive()["mode"] = json!(7), &["mode"]);
    refused(|file| file.indices(&[0, 1, 3]), &["indices", "vertex 3 of 3"]);
    refused(|file| file.json["accessors"][0]["count"] = json!(4), &["accessors[0]", "4 elements"]);
    refused(|file| file.json["accessors"][0]["count"] = json!(u64::MAX), &["accessors[0]", "too large"]);
    refused(|file| file.json["accessors"][0]["byteOffset"] = json!(u64::MAX), &["accessors[0]"]);
    refused(|file| file.json["accessors"][0]["type"] = json!("VEC2"), &["accessors[0]", "Vec2"]);
    refused(|file| file.json["accessors"][0]["componentType"] = json!(1), &["accessors[0]", "unknown"]);
    refused(|file| file.json["bufferViews"][0]["byteOffset"] = json!(999), &["bufferViews[0]", "from 999 on"]);
    refused(|file| file.json["bufferViews"][0]["byteOffset"] = json!(u64::MAX), &["bufferViews[0]"]);
    refused(|file| file.json["bufferViews"][0]["byteStride"] = json!(8), &["accessors[0]", "every 8 bytes"]);
    refused(|file| file.json["bufferViews"][0]["buffer"] = json!(1), &["bufferViews[0]", "no number 1"]);
    refused(|file| file.json["buffers"][0]["uri"] = json!("data:text/plain;base64,%"), &["buffers[0]", "base64"]);
    refused(|file| file.json["buffers"][0]["uri"] = json!("https://example.org/a.bin"), &["buffers[0]", "https"]);
    refused(|file| file.json["buffers"][0]["uri"] = json!("../a.bin"), &["buffers[0]", "--trust"]);
    refused(|file| file.primitive()["mode"] = json!(0), &["nothing to draw"]);
    refused(|file| file.json["scenes"][0]["extras"] = json!({ "rapidity": { "sun": 1 } }), &["extras.rapidity", "sun"]);
}

#[test]
fn a_faulty_part_is_left_out_and_named_and_the_rest_is_drawn() {
    let drawn = |change: fn(&mut GltfUnderTest), words: &[&str]| {
        let mut file = GltfUnderTest::triangle();
        change(&mut file);
        let scene = file.scene();
        assert_eq!(scene.triangle_count(), 1, "{words:?}");
        let said = scene.notices.join("\n");
        assert!(words.iter().all(|word| said.contains(word)), "{words:?} are not in: {said}");
    };
    drawn(|file| file.json["scene"] = json!(3), &["scene", "no number 3 among 1"]);
    drawn(
        |file| file.json["nodes"][0]["children"] = json!([0]),
        &["1 node is not drawn: nodes[0]", "its own ancestor"],
    );
    drawn(
        |file| file.json["scenes"][0]["nodes"] = json!([0, 0, 7]),
        &["2 nodes are not drawn", "two parents", "nodes[7]"],
    );
    drawn(|file| file.primitive()["material"] = json!(0), &["material", "no number 0 among 0"]);
    drawn(|file| file.json["buffers"][0]["byteLength"] = json!(1000), &["buffers[0]", "cut short"]);
    drawn(|file| file.json["extensionsRequired"] = json!(["KHR_materials_clearcoat"]), &["clearcoat", "requires it"]);
    drawn(|file| file.primitive()["attributes"]["NORMAL"] = json!(77), &["NORMAL", "no number 77"]);
    drawn(
        |file| {
            let normals = file.floats("VEC3", &[0.0, 1.0, 0.0]);
            file.attribute("NORMAL", normals);
        },
        &["NORMAL", "1 entries for 3 positions"],
    );
    drawn(|file| file.indices(&[0, 1, 2, 0, 1, 9]), &["indices", "vertex 9 of 3; 1 of 2 triangles"]);
    drawn(
        |file| {
            file.push("images", json!({ "uri": "https://example.org/a.png" }));
            file.push("textures", json!({ "source": 0 }));
            file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
        },
        &["1 picture is not drawn: images[0]", "https"],
    );
    drawn(|file| file.json["materials"] = json!([{ "alphaMode": "FOG", "alphaCutoff": "x" }]), &["materials[0]"]);
    drawn(
        |file| {
            let mesh = json!({ "primitives": [{ "attributes": { "POSITION": 4_294_967_296_u64 } }] });
            let mesh = file.push("meshes", mesh);
            file.json["nodes"] = json!([{ "mesh": 0 }, { "mesh": mesh }]);
            file.json["scenes"][0]["nodes"] = json!([0, 1]);
        },
        &["1 part of the geometry is not drawn: meshes[1].primitives[0]"],
    );
    // Nothing to draw there: neither a fault nor a triangle.
    drawn(
        |file| {
            let none = file.floats("VEC3", &[]);
            let primitives = json!([{ "attributes": { "POSITION": none } }, { "attributes": { "NORMAL": 0 } }]);
            let mesh = file.push("meshes", json!({ "primitives": primitives }));
            file.json["nodes"] = json!([{ "mesh": mesh }, { "mesh": 0 }]);
            file.json["scenes"][0]["nodes"] = json!([0, 1]);
        },
        &["parts without vertices are not drawn", "parts without positions are not drawn"],
    );
}

#[test]
fn own_extras_are_read_or_refused_but_never_dropped() {
    // Another program's data may be of any kind and depth.
    let text = |extras: &str| {
        let mut file = GltfUnderTest::triangle();
        file.json["nodes"][0]["extras"] = json!("@");
        GltfUnderTest::with_text(&file.json.to_string().replace("\"@\"", extras), &file.blob)
    };
    let deep = format!("{}1{}", "[".repeat(5000), "]".repeat(5000));
    let foreign = format!("{{ \"a\": 1e999, \"deep\": {deep}, \"celerity\": [0, 0, 1] }}");
    let scene = load_bytes(&text(&foreign)).unwrap();
    assert_eq!(scene.motions.len(), 1, "its celerity is read beside what is not understood");
    let refused = |extras: &str, words: &str| {
        let error = load_bytes(&text(extras)).unwrap_err().to_string();
        assert!(error.contains("nodes[0].extras") && error.contains(words), "{error}");
    };
    refused("{ \"celerity\": [0, 0, 1e999] }", "celerity");
    refused("{ \"celerity\": [0, 0, 1], \"celerity\": [0, 0, 2] }", "duplicate");
}

#[test]
fn a_bomb_of_instances_is_refused_before_it_goes_off() {
    // The file has ten thousand nodes, each with a mesh whose ten thousand primitives share one accessor.
    let mut file = GltfUnderTest::triangle();
    let primitive = file.primitive().clone();
    file.json["meshes"][0]["primitives"] = json!(vec![primitive; 10_000]);
    file.json["nodes"] = json!(vec![json!({ "mesh": 0 }); 10_000]);
    file.json["scenes"][0]["nodes"] = json!((0..10_000).collect::<Vec<_>>());
    let error = file.error();
    assert!(error.contains("too large"), "{error}");
}

#[test]
fn a_picture_bomb_is_refused_before_it_is_decoded() {
    let mut file = GltfUnderTest::triangle();
    let texture = file.texture(json!({}));
    file.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": texture } } }));
    // The size stands at byte 16 of a PNG, behind its signature; its checksum is at 29.
    let mut bomb = png(1, 1, &[0; 4]);
    bomb[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    let checksum = crc32(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&checksum.to_be_bytes());
    let view = file.view(&bomb);
    file.json["images"][0]["bufferView"] = json!(view);
    let scene = file.scene();
    assert!(scene.textures.is_empty() && scene.notices[0].contains("65536 × 65536"), "{:?}", scene.notices);
    // A picture that is possible, but does not fit with the memory for drawing it.
    bomb[16..24].copy_from_slice(&[0, 0, 64, 0, 0, 0, 64, 0]);
    let checksum = crc32(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&checksum.to_be_bytes());
    let view = file.view(&bomb);
    file.json["images"][0]["bufferView"] = json!(view);
    let folder = TempDir::new().unwrap();
    let budget = Budget::new(100_000_000);
    let rules = ReadRules { budget: &budget, trust: false };
    let error = load(&write(&folder, "scene.glb", &file.glb()), rules, |_| {}).unwrap_err().to_string();
    assert!(error.contains("images[0]") && error.contains("above the limit of 0.1 GB"), "{error}");
}

#[test]
fn one_budget_holds_for_everything_together() {
    let refused = |file: &GltfUnderTest, limit: u64| {
        let folder = TempDir::new().unwrap();
        let budget = Budget::new(limit);
        let rules = ReadRules { budget: &budget, trust: false };
        load(&write(&folder, "scene.glb", &file.glb()), rules, |_| {}).unwrap_err().to_string()
    };
    // Millions of zeros that take no room in the file.
    let mut zeros = GltfUnderTest::triangle();
    zeros.json["accessors"][0] = json!({ "componentType": 5126, "type": "VEC3", "count": 30_000_000 });
    assert!(refused(&zeros, Budget::DEFAULT).contains("meshes[0].primitives[0]"));
    // A file that is named again and again is read once; files that are sparse on the disk are not read at all.
    let mut many = GltfUnderTest::triangle();
    let keys = scalars(&mut many, &[0.0; 1000]);
    let samplers = vec![json!({ "input": keys, "output": keys }); 1000];
    let channels: Vec<Value> = (0..1000)
        .map(|sampler| json!({ "sampler": sampler, "target": { "node": 0, "path": "translation" } }))
        .collect();
    many.json["animations"] = json!([{ "channels": channels, "samplers": samplers }]);
    many.json["accessors"][keys]["type"] = json!("SCALAR");
    assert!(many.scene().notices[0].contains("1000 channels"), "{:?}", many.scene().notices);
}

fn scalars(file: &mut GltfUnderTest, values: &[f32]) -> usize {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    file.accessor(&bytes, 5126, "SCALAR", values.len())
}

/// Checksum of PNG chunks (ISO 3309).
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}

/// File that uses nearly everything that the loader reads.
fn rich_file() -> GltfUnderTest {
    let mut file = GltfUnderTest::triangle();
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
    file.material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": texture, "extensions": extensions } },
        "extras": { "spectrum": { "sampled": [[400, 0.5], [700, 1]] } },
    }));
    file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "directional", "color": [1, 1, 1], "intensity": 3, "extras": { "spectrum": { "planck": 5800 } } },
    ] } });
    let corners: Vec<u8> = [3.0_f32, 0.0, 0.0, 0.0, 2.0, 0.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    let (indices, values) = (file.view(&[1, 2]), file.view(&corners));
    file.json["accessors"][0]["sparse"] = json!({
        "count": 2,
        "indices": { "bufferView": indices, "componentType": 5121 },
        "values": { "bufferView": values },
    });
    file.json["nodes"] = json!([
        { "translation": [1, 2, 3], "children": [1], "extras": { "rapidity": { "solid": false } } },
        { "rotation": [0, 0, 0, 1], "scale": [1, 1, -1], "mesh": 0,
          "extensions": { "KHR_lights_punctual": { "light": 0 } } },
    ]);
    file.json["scenes"][0]["extras"] = json!({ "rapidity": {
        "origin": [0, 0, 0], "circuit": [[1, 2, 3]], "white": 80,
        "light": { "sky": [0.1, 0.1, 0.2], "spectrum": { "rgb": [1, 1, 0.5] } },
    } });
    file
}

/// Loads a file that may be broken; any valid scene or proper error will do. True if it loaded.
fn survive(bytes: &[u8]) -> bool {
    match load_bytes(bytes) {
        Ok(scene) => {
            assert_eq!(scene.validate(), Ok(()));
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
fn a_file_that_is_cut_short_says_so() {
    // The last view belongs to no triangle.
    let mut file = GltfUnderTest::triangle();
    file.view(&[0; 40]);
    let whole = file.glb();
    let mut drawn = 0;
    for length in 0..whole.len() {
        match load_bytes(&whole[..length]) {
            Ok(scene) => {
                drawn += 1;
                assert!(
                    scene.notices[0].contains("geometry") || scene.notices.join("\n").contains("cut short"),
                    "{length}"
                );
            }
            Err(error) => assert!(error.to_string().contains("scene.glb"), "{error}"),
        }
    }
    assert!(drawn > 0, "the triangles are there before the last bytes");
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
