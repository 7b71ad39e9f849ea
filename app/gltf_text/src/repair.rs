//! Repair of a file's JSON: what exporters write against the letter of glTF is put right, a member that cannot be read
//! is left out, and a part that cannot be read without it is replaced by an empty one, so that the rest can be drawn.
//!
//! A sound file never comes here: it is parsed in one pass. Only where that fails, or where a number is so large that
//! an index would wrap around, is the text parsed as plain JSON, mended, and parsed again.

use ::gltf::json;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Number, Value, json};

use super::file_json::{GltfJson, NodeJson};
use super::loose_json::tightened;
use super::members::remove_unreadable;
use super::notices::{Notices, Part};

/// Keys whose numbers are indices into lists.
const INDEX_KEYS: [&str; 20] = [
    "buffer",
    "bufferView",
    "camera",
    "children",
    "index",
    "indices",
    "input",
    "inverseBindMatrices",
    "joints",
    "light",
    "material",
    "mesh",
    "node",
    "nodes",
    "output",
    "sampler",
    "scene",
    "skeleton",
    "skin",
    "source",
];

/// Keys below which every number is an index, whatever its own key.
const INDEX_MAPS: [&str; 2] = ["attributes", "targets"];

/// Members of lists of numbers without which these mean the same. Any other, such as an offset, would give wrong ones.
const SPARED: [&str; 4] = [".name", ".target", ".min", ".max"];

/// Index that no list has, in place of one that 32 bits cannot hold.
const NOWHERE: u32 = u32::MAX - 1;

/// Digits from which on a whole number may be larger than 32 bits hold.
const LONG_NUMBER: usize = 10;

/// True if the text may have an index that 32 bits cannot hold: a long run of digits that is no fraction.
pub fn may_wrap(text: &[u8]) -> bool {
    let mut start = 0;
    while start < text.len() {
        if !text[start].is_ascii_digit() {
            start += 1;
            continue;
        }
        let length = text[start..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let fraction = start > 0 && text[start - 1] == b'.' || text.get(start + length) == Some(&b'.');
        if length >= LONG_NUMBER && !fraction {
            let digits = text[start..start + length].iter();
            let value = digits.fold(0_u64, |sum, digit| sum.saturating_mul(10).saturating_add(u64::from(digit - b'0')));
            if value > u64::from(NOWHERE) {
                return true;
            }
        }
        start += length;
    }
    false
}

/// JSON of a file with its repairs made and named; `None` if the text is no JSON object.
pub fn repaired(text: &[u8], notices: &mut Notices) -> Option<GltfJson> {
    let text = String::from_utf8_lossy(text);
    let mut value: Value = match serde_json::from_str(&text) {
        Ok(value) => value,
        Err(fault) => {
            let value = serde_json::from_str(&tightened(&text)).ok()?;
            notices.left_out(Part::File, "what is no JSON", &fault.to_string());
            value
        }
    };
    normalise(&mut value, "");
    let root = value.as_object_mut()?;
    mend_asset(root, notices);
    list::<json::Scene>(root, "scenes", &json!({ "nodes": [] }), notices, |scene, _, _| {
        scene.entry("nodes").or_insert_with(|| json!([]));
    });
    list::<NodeJson>(root, "nodes", &json!({}), notices, |_, _, _| {});
    list::<json::Mesh>(root, "meshes", &json!({ "primitives": [] }), notices, |mesh, place, notices| {
        inner::<json::mesh::Primitive>(mesh, "primitives", place, notices, Part::Mesh);
    });
    list::<json::Material>(root, "materials", &json!({}), notices, |_, _, _| {});
    list::<json::Texture>(root, "textures", &json!({}), notices, |_, _, _| {});
    list::<json::texture::Sampler>(root, "samplers", &json!({}), notices, |_, _, _| {});
    list::<json::Image>(root, "images", &json!({}), notices, |_, _, _| {});
    list::<json::Animation>(
        root,
        "animations",
        &json!({ "channels": [], "samplers": [] }),
        notices,
        |animation, place, notices| {
            inner::<json::animation::Channel>(animation, "channels", place, notices, Part::Animation);
        },
    );
    list::<json::Skin>(root, "skins", &json!({ "joints": [] }), notices, |_, _, _| {});
    list::<json::Camera>(root, "cameras", &json!({ "type": "unknown" }), notices, |camera, _, _| {
        // The near plane is this program's own.
        if let Some(Value::Object(perspective)) = camera.get_mut("perspective") {
            perspective.entry("znear").or_insert_with(|| json!(0.01));
        }
    });
    let none = json!({ "componentType": 0, "type": "none", "count": 0 });
    list::<json::Accessor>(root, "accessors", &none, notices, |_, _, _| {});
    list::<json::buffer::View>(
        root,
        "bufferViews",
        &json!({ "buffer": NOWHERE, "byteLength": 0 }),
        notices,
        |_, _, _| {},
    );
    list::<json::Buffer>(root, "buffers", &json!({ "byteLength": 0 }), notices, |_, _, _| {});
    for key in ["extensionsUsed", "extensionsRequired"] {
        if let Some(names) = root.get_mut(key) {
            let strings = names.as_array().into_iter().flatten().filter(|name| name.is_string()).cloned().collect();
            *names = Value::Array(strings);
        }
    }
    for key in ["extensions", "scene"] {
        let readable = match (key, root.get(key)) {
            (_, None) => true,
            ("scene", Some(scene)) => scene.is_u64(),
            (_, Some(extensions)) => json::extensions::Root::deserialize(extensions).is_ok(),
        };
        if !readable {
            root.remove(key);
            notices.left_out(Part::File, key, "it cannot be read");
        }
    }
    serde_json::from_value(value).ok()
}

/// Writes a version that is a number as a text, and adds an asset that is missing: lists are of version 2.
fn mend_asset(root: &mut Map<String, Value>, notices: &mut Notices) {
    if !root.contains_key("asset") && ["nodes", "meshes"].iter().any(|key| root.get(*key).is_some_and(Value::is_array))
    {
        notices.left_out(Part::File, "asset", "it is missing");
        root.insert("asset".into(), json!({ "version": "2.0" }));
    }
    let Some(asset) = root.get_mut("asset") else { return };
    for key in ["version", "minVersion"] {
        if let Some(number) = asset.get(key).and_then(Value::as_f64) {
            asset[key] = Value::String(format!("{number:.1}"));
        }
    }
    mend::<json::Asset>(asset, "asset", notices, |_| true).ok();
}

/// Removes the members of an item that cannot be read and are `spared`, and names them.
///
/// # Errors
/// Fault of an item that cannot be read all the same.
fn mend<T: DeserializeOwned>(
    item: &mut Value,
    place: &str,
    notices: &mut Notices,
    spared: impl Fn(&str) -> bool,
) -> Result<(), String> {
    for (member, fault) in remove_unreadable::<T>(item, spared)? {
        notices.left_out(Part::File, &format!("{place}{member}"), &fault);
    }
    Ok(())
}

/// Mends the items of one of the file's lists with `mend`, and replaces those that cannot be read by `empty`.
fn list<T: DeserializeOwned>(
    root: &mut Map<String, Value>,
    key: &str,
    empty: &Value,
    notices: &mut Notices,
    mend: impl Fn(&mut Map<String, Value>, &str, &mut Notices),
) {
    let Some(list) = root.get_mut(key) else { return };
    let Value::Array(items) = list else {
        root.remove(key);
        notices.left_out(Part::File, key, "it is no list");
        return;
    };
    let are_numbers = ["accessors", "bufferViews", "buffers"].contains(&key);
    let is_spared = |member: &str| SPARED.iter().any(|name| member.starts_with(name));
    for (index, item) in items.iter_mut().enumerate() {
        let place = format!("{key}[{index}]");
        if let Value::Object(item) = item {
            mend(item, &place, notices);
        }
        if let Err(fault) = self::mend::<T>(item, &place, notices, |member| !are_numbers || is_spared(member)) {
            notices.left_out(part_of(key), &place, &fault);
            *item = empty.clone();
        }
    }
}

/// Mends the items of an item's own list, and removes those that cannot be read.
fn inner<T: DeserializeOwned>(
    item: &mut Map<String, Value>,
    key: &str,
    place: &str,
    notices: &mut Notices,
    part: Part,
) {
    let Some(Value::Array(parts)) = item.get_mut(key) else { return };
    let mut index = 0;
    parts.retain_mut(|value| {
        let place = format!("{place}.{key}[{index}]");
        let read = mend::<T>(value, &place, notices, |_| true);
        if let Err(fault) = &read {
            // A channel of KHR_animation_pointer has no node.
            let pointer = part == Part::Animation && value["target"]["node"].is_null();
            let fault = if pointer { "it moves something else than a node" } else { fault };
            notices.left_out(part, &place, fault);
        }
        index += 1;
        read.is_ok()
    });
}

fn part_of(key: &str) -> Part {
    match key {
        "meshes" | "accessors" | "bufferViews" | "buffers" => Part::Mesh,
        "nodes" | "scenes" | "cameras" => Part::Node,
        "materials" => Part::Material,
        "textures" | "samplers" | "images" => Part::Picture,
        "animations" => Part::Animation,
        "skins" => Part::Skin,
        _ => Part::File,
    }
}

/// Writes whole numbers as such (4.0 as 4), removes members that are null and indices of −1, which stand for none, and
/// replaces indices that are too large.
/// Extras belong to other programs and stay as they are.
fn normalise(value: &mut Value, key: &str) {
    match value {
        Value::Object(members) => {
            // A name that is none costs nothing but itself.
            let none = |key: &str, member: &Value| {
                (INDEX_KEYS.contains(&key)) && member.as_f64() == Some(-1.0) || member.is_null()
            };
            let kept = |key: &str, member: &Value| {
                key == "extras" || !none(key, member) && (key != "name" || member.is_string())
            };
            members.retain(|key, member| kept(key, member));
            for (own, member) in members.iter_mut().filter(|(key, _)| key.as_str() != "extras") {
                normalise(member, if INDEX_MAPS.contains(&key) { key } else { own });
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|item| normalise(item, key)),
        Value::Number(number) => {
            if let Some(whole) = whole(number) {
                *number = whole.into();
            }
            let index = INDEX_KEYS.contains(&key) || INDEX_MAPS.contains(&key);
            if index && number.as_u64().is_some_and(|number| number > u64::from(NOWHERE)) {
                *number = NOWHERE.into();
            }
        }
        _ => {}
    }
}

/// Whole number that is written with a fraction of zero.
fn whole(number: &Number) -> Option<i64> {
    /// Largest magnitude up to which a double holds every whole number.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    let value = if number.is_f64() { number.as_f64()? } else { return None };
    (value.fract() == 0.0 && value.abs() <= EXACT).then_some(value as i64)
}

#[cfg(test)]
mod tests {
    //! Laws under test: repaired JSON says what was meant, a part that cannot be read is empty and named, and only a
    //! text with a long whole number may wrap.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use ::gltf::json::validation::Checked::Valid;

    #[test]
    fn whole_numbers_with_a_fraction_of_zero_are_whole() {
        let text = br#"{ "asset": { "version": "2.0" }, "scene": 0.0, "scenes": [{ "nodes": [1.0], "name": null }],
            "accessors": [{ "componentType": 5126.0, "count": 3.0, "type": "VEC3", "extras": { "a": 2.0 } }] }"#;
        let mut notices = Notices::default();
        let json = repaired(text, &mut notices).unwrap();
        assert_eq!((json.scene.unwrap().value(), json.scenes[0].nodes[0].value()), (0, 1));
        assert_eq!(json.accessors[0].count.0, 3);
        assert_eq!(json.accessors[0].extras.as_ref().unwrap().get(), r#"{"a":2.0}"#);
        assert!(notices.into_sentences().is_empty());
    }

    #[test]
    fn an_item_that_cannot_be_read_is_empty_and_named() {
        let text = br#"{ "asset": { "version": "2.0" }, "materials": [{ "alphaCutoff": "x" }, { "name": "good" }],
            "scenes": [{}], "animations": [{ "channels": [{ "sampler": 0, "target": { "path": "rotation" } }],
            "samplers": [] }] }"#;
        let mut notices = Notices::default();
        let json = repaired(text, &mut notices).unwrap();
        assert_eq!((json.materials[0].name.as_deref(), json.materials[1].name.as_deref()), (None, Some("good")));
        assert!(json.animations[0].channels.is_empty() && json.scenes[0].nodes.is_empty());
        let said = notices.into_sentences().join("\n");
        assert!(said.contains("materials[0]") && said.contains("animations[0].channels[0]"), "{said}");
    }

    #[test]
    fn a_member_that_cannot_be_read_costs_nothing_but_itself() {
        let text = br#"{ "nodes": [
            { "children": [1, "x"], "translation": [0, 1], "rotation": [0, 0, 0, 1], "camera": -1 }, {}],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 3, "NORMAL": "x" }, "material": -1 }] }],
            "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.5 } }],
            "materials": [{ "emissiveFactor": [1], "alphaMode": "BLEND", "normalTexture": {}, "extensions": {
                "KHR_materials_ior": { "ior": "x" }, "KHR_materials_unlit": {} } }] }"#;
        let mut notices = Notices::default();
        let json = repaired(text, &mut notices).unwrap();
        let node = &json.nodes[0];
        assert_eq!((node.rotation, node.translation), (Some([0.0, 0.0, 0.0, 1.0]), None));
        assert_eq!(node.children.as_ref().unwrap().len(), 1);
        let attributes = &json.meshes[0].primitives[0].attributes;
        assert_eq!(attributes.values().map(|index| index.value()).collect::<Vec<_>>(), [3]);
        assert_eq!(json.cameras[0].perspective.as_ref().unwrap().yfov, 0.5);
        let material = &json.materials[0];
        let extensions = material.extensions.as_ref().unwrap();
        assert!(extensions.unlit.is_some() && material.normal_texture.is_none());
        assert_eq!(material.alpha_mode, Valid(json::material::AlphaMode::Blend));
        let said = notices.into_sentences().join("\n");
        assert!(said.starts_with("7 parts of the file are passed over: asset (it is missing)"), "{said}");
    }

    #[test]
    fn numbers_without_their_place_are_no_numbers() {
        let text = br#"{ "asset": { "version": "2.0" }, "bufferViews": [
            { "buffer": 0, "byteLength": 4, "byteOffset": -1 },
            { "buffer": 0, "byteLength": 4, "byteOffset": 8, "target": "x" }] }"#;
        let mut notices = Notices::default();
        let json = repaired(text, &mut notices).unwrap();
        let views = json.buffer_views.iter().map(|view| (view.byte_length.0, view.byte_offset.map_or(0, |at| at.0)));
        assert_eq!(views.collect::<Vec<_>>(), [(0, 0), (4, 8)]);
        assert!(notices.first_fault().unwrap().contains("bufferViews[0]"));
    }

    #[test]
    fn a_text_that_is_almost_json_is_read() {
        let text = b"{ \"asset\": { \"version\": 2.0, \"generator\": 7 }, \"accessors\": [{ \"componentType\": 5126,
            \"count\": 1, \"type\": \"VEC3\", \"min\": [NaN, 0, 0] },], }";
        let mut notices = Notices::default();
        let json = repaired(text, &mut notices).unwrap();
        assert_eq!((json.asset.version.as_str(), json.accessors[0].count.0), ("2.0", 1));
        assert!(notices.into_sentences().join("\n").contains("what is no JSON"));
    }

    #[test]
    fn an_index_beyond_32_bits_is_no_other_index() {
        let text = br#"{ "asset": { "version": "2.0" }, "nodes": [{ "mesh": 4294967296 }], "meshes": [
            { "primitives": [{ "attributes": { "POSITION": 4294967297 } }] }] }"#;
        assert!(may_wrap(text));
        let json = repaired(text, &mut Notices::default()).unwrap();
        assert_eq!(json.nodes[0].mesh.unwrap().value(), NOWHERE as usize);
        let positions = json.meshes[0].primitives[0].attributes.values().next().unwrap();
        assert_eq!(positions.value(), NOWHERE as usize);
        for harmless in ["0.70710678118654752", "1234567890.5", "[4294967, 12]", "\"4294967294\""] {
            assert!(!may_wrap(harmless.as_bytes()), "{harmless}");
        }
    }
}
