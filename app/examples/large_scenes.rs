//! Large scenes for measuring how fast files open and are drawn: `large_scenes FOLDER` writes meshes of up to 4 million
//! triangles and twenty pictures of 4096 × 4096 pixels as ordinary `.glb` files, with nothing of this program's own in
//! them. `large_scenes FOLDER triangles-1e6` writes only that one, and so on.
#![allow(clippy::unwrap_used, reason = "a faulty example ends with its fault")]
#![allow(clippy::print_stderr, reason = "an example tells what it does not know")]

use std::io::Cursor;
use std::path::Path;
use std::process::ExitCode;

use image::codecs::jpeg::JpegEncoder;
use image::imageops::FilterType;
use image::{ImageFormat, RgbImage};
use serde_json::{Value, json};

/// Side of the sheet that triangles make up, metres.
const SIDE: f32 = 10.0;

/// Number of pictures.
const PICTURES: usize = 20;

/// Side of a picture, pixels.
const PIXELS: u32 = 4096;

/// Quality of JPEG pictures, of 100.
const QUALITY: u8 = 90;

/// Scenes of triangles: name, number of triangles, number of meshes.
const SHEETS: [(&str, usize, usize); 4] = [
    ("triangles-1e5", 100_000, 1),
    ("triangles-1e6", 1_000_000, 1),
    ("triangles-4e6", 4_000_000, 1),
    ("meshes-2000", 1_000_000, 2000),
];

/// Scenes of pictures.
const PICTURE_SCENES: [(&str, ImageFormat); 2] =
    [("pictures-png", ImageFormat::Png), ("pictures-jpeg", ImageFormat::Jpeg)];

fn main() -> ExitCode {
    let mut words = std::env::args_os().skip(1);
    let folder = words.next().expect("large_scenes FOLDER [SCENE…]: the folder for the files");
    let folder = Path::new(&folder);
    let chosen: Vec<String> = words.map(|word| word.to_string_lossy().into_owned()).collect();
    let names: Vec<&str> =
        SHEETS.iter().map(|(name, ..)| *name).chain(PICTURE_SCENES.iter().map(|(name, _)| *name)).collect();
    if let Some(unknown) = chosen.iter().find(|name| !names.contains(&name.as_str())) {
        eprintln!("{unknown} is none of the scenes: {}", names.join(", "));
        return ExitCode::from(2);
    }
    let wanted = |name: &str| chosen.is_empty() || chosen.iter().any(|chosen| chosen == name);
    let path = |name: &str| folder.join(name).with_extension("glb");
    std::fs::create_dir_all(folder).unwrap();
    for (name, triangles, meshes) in SHEETS.into_iter().filter(|(name, ..)| wanted(name)) {
        sheets(triangles, meshes).write(&path(name));
    }
    for (name, format) in PICTURE_SCENES.into_iter().filter(|(name, _)| wanted(name)) {
        pictures(format).write(&path(name));
    }
    ExitCode::SUCCESS
}

/// File under construction.
struct Glb {
    json: Value,
    blob: Vec<u8>,
}

impl Glb {
    fn new() -> Self {
        let lists = json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [] }], "nodes": [], "meshes": [],
            "materials": [], "textures": [], "images": [], "accessors": [], "bufferViews": [],
        });
        Self { json: lists, blob: Vec::new() }
    }

    /// Appends to a list; returns the index.
    fn push(&mut self, list: &str, item: Value) -> usize {
        let list = self.json[list].as_array_mut().unwrap();
        list.push(item);
        list.len() - 1
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        self.blob.resize(self.blob.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.blob.len(), "byteLength": bytes.len() });
        self.blob.extend_from_slice(bytes);
        self.push("bufferViews", view)
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }))
    }

    fn floats<const N: usize>(&mut self, kind: &str, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(&bytes, 5126, kind, values.len())
    }

    /// Adds a mesh at a node of its own.
    fn mesh(&mut self, positions: &[[f32; 3]], normals: &[[f32; 3]], uvs: Option<&[[f32; 2]]>, indices: &[u32]) {
        let at = self.floats("VEC3", positions);
        let corner = |of: fn(f32, f32) -> f32| {
            let folded = positions.iter().copied().reduce(|a, b| [of(a[0], b[0]), of(a[1], b[1]), of(a[2], b[2])]);
            json!(folded.unwrap())
        };
        self.json["accessors"][at]["min"] = corner(f32::min);
        self.json["accessors"][at]["max"] = corner(f32::max);
        let mut attributes = json!({ "POSITION": at, "NORMAL": self.floats("VEC3", normals) });
        if let Some(uvs) = uvs {
            attributes["TEXCOORD_0"] = json!(self.floats("VEC2", uvs));
        }
        let bytes: Vec<u8> = indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        let indices = self.accessor(&bytes, 5125, "SCALAR", indices.len());
        let mut primitive = json!({ "attributes": attributes, "indices": indices });
        if uvs.is_some() {
            primitive["material"] = json!(self.json["materials"].as_array().unwrap().len() - 1);
        }
        let mesh = self.push("meshes", json!({ "primitives": [primitive] }));
        let node = self.push("nodes", json!({ "mesh": mesh }));
        self.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(node));
    }

    fn write(mut self, path: &Path) {
        self.json["buffers"] = json!([{ "byteLength": self.blob.len() }]);
        // glTF allows no empty lists.
        self.json.as_object_mut().unwrap().retain(|_, list| list.as_array().is_none_or(|list| !list.is_empty()));
        let mut text = self.json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        self.blob.resize(self.blob.len().next_multiple_of(4), 0);
        let word = |value: usize| u32::try_from(value).unwrap().to_le_bytes();
        let total = 12 + 8 + text.len() + 8 + self.blob.len();
        let parts: [&[u8]; 9] = [
            b"glTF",
            &word(2),
            &word(total),
            &word(text.len()),
            b"JSON",
            &text,
            &word(self.blob.len()),
            b"BIN\0",
            &self.blob,
        ];
        std::fs::write(path, parts.concat()).unwrap();
    }
}

/// Waves of `triangles` triangles in `meshes` meshes side by side.
fn sheets(triangles: usize, meshes: usize) -> Glb {
    let mut file = Glb::new();
    let columns = (meshes as f32).sqrt().ceil() as usize;
    let size = SIDE / columns as f32;
    let cells = (triangles as f32 / meshes as f32 / 2.0).sqrt() as u32;
    for mesh in 0..meshes {
        let [left, near] = [mesh % columns, mesh / columns].map(|place| place as f32 * size);
        let across = |index: u32| size * index as f32 / cells as f32;
        let points = (0..=cells).flat_map(|row| (0..=cells).map(move |column| [column, row]));
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        for [x, z] in points.map(|[column, row]| [left + across(column), near + across(row)]) {
            let [along, aside] = [0.9 * (3.0 * x).cos() * (2.0 * z).cos(), -0.6 * (3.0 * x).sin() * (2.0 * z).sin()];
            let length = along.hypot(aside).hypot(1.0);
            positions.push([x, 0.3 * (3.0 * x).sin() * (2.0 * z).cos(), z]);
            normals.push([-along / length, 1.0 / length, -aside / length]);
        }
        let corner = |row: u32, column: u32| row * (cells + 1) + column;
        let cell = |row, column| {
            let [a, b, c, d] =
                [corner(row, column), corner(row + 1, column), corner(row, column + 1), corner(row + 1, column + 1)];
            [a, b, c, c, b, d]
        };
        let indices: Vec<u32> =
            (0..cells).flat_map(|row| (0..cells).flat_map(move |column| cell(row, column))).collect();
        file.mesh(&positions, &normals, None, &indices);
    }
    file
}

/// Squares with a picture each.
fn pictures(format: ImageFormat) -> Glb {
    let mut file = Glb::new();
    for number in 0..PICTURES as u32 {
        // Coarse noise, smoothly enlarged: neither flat nor beyond compression.
        let hash = |x: u32, y: u32, channel: u32| {
            let mut bits = (x + 256 * y + 65_536 * channel + 196_608 * number).wrapping_mul(0x9e37_79b9);
            bits = (bits ^ (bits >> 15)).wrapping_mul(0x85eb_ca6b);
            (bits >> 24) as u8
        };
        let coarse = RgbImage::from_fn(256, 256, |x, y| image::Rgb([0, 1, 2].map(|channel| hash(x, y, channel))));
        let picture = image::imageops::resize(&coarse, PIXELS, PIXELS, FilterType::CatmullRom);
        let mut bytes = Cursor::new(Vec::new());
        match format {
            ImageFormat::Jpeg => {
                picture.write_with_encoder(JpegEncoder::new_with_quality(&mut bytes, QUALITY)).unwrap();
            }
            _ => picture.write_to(&mut bytes, format).unwrap(),
        }
        let view = file.view(&bytes.into_inner());
        let image = file.push("images", json!({ "bufferView": view, "mimeType": format.to_mime_type() }));
        let texture = file.push("textures", json!({ "source": image }));
        let surface = json!({ "baseColorTexture": { "index": texture }, "metallicFactor": 0 });
        file.push("materials", json!({ "pbrMetallicRoughness": surface }));
        let [x, y] = [(number % 5) as f32 * 1.1, (number / 5) as f32 * 1.1];
        let corners = [[x, y, 0.0], [x + 1.0, y, 0.0], [x + 1.0, y + 1.0, 0.0], [x, y + 1.0, 0.0]];
        let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        file.mesh(&corners, &[[0.0, 0.0, 1.0]; 4], Some(&uvs), &[0, 1, 2, 0, 2, 3]);
    }
    file
}
