//! Test files: glTF under construction, byte by byte, so that each test's file differs in one thing.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, too, may fail the test")]
#![allow(dead_code, reason = "each test program uses its part of it")]

use std::path::{Path, PathBuf};

use regular_file::Budget;
use scene::Scene;
use scene_files::SceneReadError;
use scene_files::check::{Report, check};
use scene_files::gltf::{GltfError, ReadRules, load};
use serde_json::{Value, json};
use tempfile::TempDir;

/// File under construction: JSON and the binary chunk that it refers to.
pub struct GltfUnderTest {
    pub json: Value,
    pub blob: Vec<u8>,
}

impl GltfUnderTest {
    /// File with one triangle in the plane z = 0, at the only node.
    pub fn triangle() -> Self {
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

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.blob.resize(self.blob.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.blob.len(), "byteLength": bytes.len() });
        self.blob.extend_from_slice(bytes);
        self.json["buffers"][0]["byteLength"] = json!(self.blob.len());
        self.push("bufferViews", view)
    }

    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }))
    }

    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = match kind {
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(&bytes, 5126, kind, values.len() / width)
    }

    pub fn indices(&mut self, indices: &[u16]) {
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        let accessor = self.accessor(&bytes, 5123, "SCALAR", indices.len());
        self.primitive()["indices"] = json!(accessor);
    }

    pub fn attribute(&mut self, name: &str, accessor: usize) {
        self.primitive()["attributes"][name] = json!(accessor);
    }

    pub fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    /// Gives the primitive a material.
    pub fn material(&mut self, material: Value) {
        let index = self.push("materials", material);
        self.primitive()["material"] = json!(index);
    }

    /// Adds a texture with a 2 × 1 picture, red and half transparent green.
    pub fn texture(&mut self, sampler: Value) -> usize {
        let view = self.view(&png(2, 1, &[255, 0, 0, 255, 0, 255, 0, 128]));
        let image = self.push("images", json!({ "bufferView": view, "mimeType": "image/png", "name": "flag" }));
        let sampler = self.push("samplers", sampler);
        self.push("textures", json!({ "source": image, "sampler": sampler }))
    }

    /// Appends an item to one of the JSON's lists; returns its index.
    pub fn push(&mut self, list: &str, item: Value) -> usize {
        let list = &mut self.json[list];
        if list.is_null() {
            *list = json!([]);
        }
        let list = list.as_array_mut().unwrap();
        list.push(item);
        list.len() - 1
    }

    pub fn glb(&self) -> Vec<u8> {
        Self::with_text(&self.json.to_string(), &self.blob)
    }

    /// File with this text instead of its JSON, and this binary chunk.
    pub fn with_text(text: &str, blob: &[u8]) -> Vec<u8> {
        let mut text = text.as_bytes().to_vec();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut blob = blob.to_vec();
        blob.resize(blob.len().next_multiple_of(4), 0);
        let length = 12 + 8 + text.len() + 8 + blob.len();
        let word = |value: usize| (value as u32).to_le_bytes();
        let parts: [&[u8]; 9] =
            [b"glTF", &word(2), &word(length), &word(text.len()), b"JSON", &text, &word(blob.len()), b"BIN\0", &blob];
        parts.concat()
    }

    pub fn load(&self) -> Result<Scene, GltfError> {
        load_bytes(&self.glb())
    }

    pub fn scene(&self) -> Scene {
        let scene = self.load().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scene.validate(), Ok(()));
        scene
    }

    /// Text of the error on loading, which must name the file.
    pub fn error(&self) -> String {
        let error = self.load().expect_err("this file is wrong").to_string();
        assert!(error.contains("scene.glb"), "{error}");
        error
    }
}

pub fn png(width: u32, height: u32, rgba: &[u8]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_raw(width, height, rgba.to_vec())
        .unwrap()
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

pub fn write(folder: &TempDir, name: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

pub fn load_bytes(bytes: &[u8]) -> Result<Scene, GltfError> {
    let folder = TempDir::new().unwrap();
    load_path(&write(&folder, "scene.glb", bytes))
}

/// Scene from a glTF file, read by the usual rules.
pub fn load_path(path: &Path) -> Result<Scene, GltfError> {
    load(path, ReadRules { budget: &Budget::default(), trust: false }, |_| {})
}

/// Scene from a file of any kind, read by the usual rules.
pub fn read_path(path: &Path) -> Result<Scene, SceneReadError> {
    scene_files::read(path, ReadRules { budget: &Budget::default(), trust: false }, |_| {})
}

/// Report on a file, read by the usual rules.
pub fn report(path: &Path) -> Report {
    check(path, ReadRules { budget: &Budget::default(), trust: false }).unwrap()
}
