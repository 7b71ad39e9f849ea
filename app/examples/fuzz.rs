//! Fuzzing: damaged files and lines of every kind, which must end in a result or a sentence, soon and without a panic.
//!
//! Each target changes a sound input at random places, by bytes or by the values of its structure, from a seed that is
//! counted up: a case is repeated by its number. `make fuzz` runs every target for a minute.
//!
//!     cargo run --release -p rapidity --example fuzz -- [SECONDS] [TARGET [FIRST-CASE]]
#![allow(clippy::unwrap_used, reason = "what cannot be written here is not a finding")]

use std::io::{Cursor, Write};
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use image::{DynamicImage, ImageFormat, RgbImage};
use input::recording::Recording;
use rand::rngs::SmallRng;
use rand::{RngExt, SeedableRng};
use regular_file::Budget;
use room::Display;
use scene_files::gltf::ReadRules;
use serde_json::{Value, json};

/// Time after which a case counts as hanging, seconds.
const TOO_LONG_S: f64 = 20.0;

/// Memory that a case may take, bytes.
const LIMIT: u64 = 200_000_000;

/// Numbers that files lie with.
const LIES: [f64; 14] =
    [-1.0, 0.0, 1.0, 2.0, 3.0, 255.0, 65_536.0, 4_294_967_295.0, 4_294_967_296.0, 1.8e19, 1e300, -0.5, 1e-300, 5126.0];

/// Kind of input, and how a case of it is made and read.
struct Target {
    name: &'static str,
    /// Ending of the file's name.
    ending: &'static str,
    make: fn(&mut SmallRng) -> Vec<u8>,
    /// Reads a case; true if it was taken for sound.
    read: fn(&Path) -> bool,
}

const TARGETS: [Target; 7] = [
    Target { name: "scene-structure", ending: "glb", make: scene_structure, read: read_scene },
    Target { name: "scene-bytes", ending: "glb", make: scene_bytes, read: read_scene },
    Target { name: "panorama", ending: "png", make: panorama, read: read_scene },
    Target { name: "recording", ending: "mcap", make: recording, read: read_recording },
    Target { name: "display", ending: "toml", make: display, read: read_display },
    Target { name: "projectors", ending: "pvx", make: paraview, read: read_display },
    Target { name: "probe", ending: "json", make: question, read: read_question },
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let seconds = arguments.first().and_then(|text| text.parse().ok()).unwrap_or(60.0);
    let first = arguments.get(2).and_then(|text| text.parse().ok()).unwrap_or(0);
    let folder = tempfile::tempdir().unwrap();
    let mut failed = false;
    for target in TARGETS.iter().filter(|target| arguments.get(1).is_none_or(|name| name == target.name)) {
        failed |= run(target, seconds, first, folder.path());
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Runs a target for a time, and prints its figures. True if a case panicked or hung.
fn run(target: &Target, seconds: f64, first: u64, folder: &Path) -> bool {
    let path: PathBuf = folder.join(format!("case.{}", target.ending));
    let (started, mut slowest, mut sound, mut failures) = (Instant::now(), Duration::ZERO, 0_u64, 0_u64);
    let mut cases = 0_u64;
    while started.elapsed().as_secs_f64() < seconds {
        let case = first + cases;
        let bytes = (target.make)(&mut SmallRng::seed_from_u64(case));
        std::fs::write(&path, bytes).unwrap();
        let began = Instant::now();
        let result = catch_unwind(|| (target.read)(&path));
        let took = began.elapsed();
        slowest = slowest.max(took);
        sound += u64::from(matches!(result, Ok(true)));
        if result.is_err() || took.as_secs_f64() > TOO_LONG_S {
            failures += 1;
            let _ = writeln!(std::io::stderr(), "{}: case {case} failed after {took:?}", target.name);
        }
        cases += 1;
    }
    let slowest = slowest.as_secs_f64();
    let _ = writeln!(
        std::io::stdout(),
        "{:16} {cases:8} cases, {sound:8} taken for sound, slowest {slowest:.2} s, {failures} failures",
        target.name
    );
    failures > 0
}

fn read_scene(path: &Path) -> bool {
    let budget = Budget::new(LIMIT);
    match scene_files::check::check(path, ReadRules { budget: &budget, trust: false }) {
        Ok(report) => !report.to_string().is_empty(),
        Err(error) => error.to_string().is_empty(),
    }
}

fn read_recording(path: &Path) -> bool {
    Recording::open(path).is_ok_and(|recording| recording.into_iter().all(|entry| entry.is_ok()))
}

fn read_display(path: &Path) -> bool {
    match Display::load(path) {
        Ok(display) => !display.to_string().is_empty(),
        Err(error) => error.to_string().is_empty(),
    }
}

fn read_question(path: &Path) -> bool {
    let text = std::fs::read(path).unwrap();
    probe::answer(&String::from_utf8_lossy(&text)).is_ok()
}

/// Replaces, removes or repeats a few bytes.
fn damage(bytes: &mut Vec<u8>, random: &mut SmallRng) {
    for _ in 0..random.random_range(1..6) {
        let place = random.random_range(0..bytes.len().max(1)).min(bytes.len().saturating_sub(1));
        match random.random_range(0..8) {
            0 => bytes.truncate(place),
            1 => drop(bytes.drain(place..(place + random.random_range(1..64)).min(bytes.len()))),
            2 => {
                let copy = bytes[place..(place + 32).min(bytes.len())].to_vec();
                bytes.splice(place..place, copy);
            }
            3 if place + 4 <= bytes.len() => {
                let lie = LIES[random.random_range(0..LIES.len())] as u32;
                bytes[place..place + 4].copy_from_slice(&lie.to_le_bytes());
            }
            _ if !bytes.is_empty() => bytes[place] = random.random(),
            _ => {}
        }
        if bytes.is_empty() {
            return;
        }
    }
}

/// Changes a random value somewhere in a JSON tree.
fn lie(value: &mut Value, random: &mut SmallRng) {
    let child = match value {
        Value::Array(items) if !items.is_empty() && random.random_range(0..8) > 0 => {
            let index = random.random_range(0..items.len());
            items.get_mut(index)
        }
        Value::Object(items) if !items.is_empty() && random.random_range(0..12) > 0 => {
            let index = random.random_range(0..items.len());
            items.values_mut().nth(index)
        }
        _ => None,
    };
    match child {
        Some(child) => lie(child, random),
        None => {
            *value = match random.random_range(0..6) {
                0 => Value::Null,
                1 => json!("data:;base64,AAAA"),
                2 => json!([]),
                3 => json!({}),
                _ => json!(LIES[random.random_range(0..LIES.len())]),
            };
        }
    }
}

/// JSON and binary chunk of a scene that uses nearly everything that is read.
fn scene() -> (Value, Vec<u8>) {
    let mut blob = Vec::new();
    let (mut views, mut accessors) = (Vec::new(), Vec::new());
    let mut add = |bytes: &[u8], component: u32, kind: &str, count: usize| {
        blob.resize(blob.len().next_multiple_of(4), 0);
        views.push(json!({ "buffer": 0, "byteOffset": blob.len(), "byteLength": bytes.len() }));
        blob.extend_from_slice(bytes);
        accessors
            .push(json!({ "bufferView": views.len() - 1, "componentType": component, "type": kind, "count": count }));
    };
    let floats = |values: &[f32]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
    add(&floats(&[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0]), 5126, "VEC3", 4);
    add(&floats(&[[0.0, 0.0, 1.0]; 4].concat()), 5126, "VEC3", 4);
    add(&floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0]), 5126, "VEC2", 4);
    add(&[0, 0, 1, 0, 2, 0, 1, 0, 3, 0, 2, 0], 5123, "SCALAR", 6);
    add(&[0; 16], 5121, "VEC4", 4);
    add(&floats(&[[1.0, 0.0, 0.0, 0.0]; 4].concat()), 5126, "VEC4", 4);
    add(&floats(&[0.0, 1.0]), 5126, "SCALAR", 2);
    add(&floats(&[0.0, 0.0, 0.0, 0.1, 0.0, 0.0]), 5126, "VEC3", 2);
    add(&floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0]), 5126, "VEC4", 2);
    let mut picture = Cursor::new(Vec::new());
    RgbImage::new(4, 2).write_to(&mut picture, ImageFormat::Png).unwrap();
    let picture = picture.into_inner();
    blob.resize(blob.len().next_multiple_of(4), 0);
    views.push(json!({ "buffer": 0, "byteOffset": blob.len(), "byteLength": picture.len() }));
    blob.extend_from_slice(&picture);
    let attributes = json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "JOINTS_0": 4, "WEIGHTS_0": 5 });
    let text = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 1, 2, 4], "extras": { "rapidity": { "white": 80, "light": { "sky": [0.1, 0.1, 0.2] } } } }],
        "nodes": [
            { "mesh": 0, "children": [3], "translation": [1, 2, 3], "extras": { "celerity": [0.1, 0, 0] } },
            { "mesh": 0, "skin": 0, "rotation": [0, 0, 0, 1], "scale": [1, 1, -1] },
            { "camera": 0, "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "mesh": 0, "weights": [0.5] },
            { "mesh": 0, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 7 } } } },
        ],
        "meshes": [{ "primitives": [
            { "attributes": attributes, "indices": 3, "material": 0, "targets": [{ "POSITION": 1 }] },
            { "attributes": { "POSITION": 0 }, "mode": 5 },
        ] }],
        "skins": [{ "joints": [3, 2] }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } }],
        "materials": [{
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "baseColorFactor": [1, 0.5, 0.5, 1] },
            "emissiveTexture": { "index": 0, "texCoord": 0, "extensions": { "KHR_texture_transform": { "scale": [2, 2] } } },
            "extras": { "spectrum": { "sampled": [[400, 0.5], [700, 1]] } },
        }],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{ "wrapS": 33071 }],
        "images": [{ "bufferView": views.len() - 1 }],
        "animations": [{
            "channels": [
                { "sampler": 0, "target": { "node": 4, "path": "translation" } },
                { "sampler": 1, "target": { "node": 4, "path": "rotation" } },
            ],
            "samplers": [{ "input": 6, "output": 7 }, { "input": 6, "output": 8 }],
        }],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "directional", "intensity": 3 }] } },
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": blob.len() }],
    });
    (text, blob)
}

fn glb(text: &Value, blob: &[u8]) -> Vec<u8> {
    let mut text = text.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let word = |value: usize| (value as u32).to_le_bytes();
    let length = 12 + 8 + text.len() + 8 + blob.len();
    let parts: [&[u8]; 9] =
        [b"glTF", &word(2), &word(length), &word(text.len()), b"JSON", &text, &word(blob.len()), b"BIN\0", blob];
    parts.concat()
}

fn scene_structure(random: &mut SmallRng) -> Vec<u8> {
    let (mut text, blob) = scene();
    for _ in 0..random.random_range(1..5) {
        lie(&mut text, random);
    }
    glb(&text, &blob)
}

fn scene_bytes(random: &mut SmallRng) -> Vec<u8> {
    let (text, blob) = scene();
    let mut bytes = glb(&text, &blob);
    damage(&mut bytes, random);
    bytes
}

fn panorama(random: &mut SmallRng) -> Vec<u8> {
    const FORMATS: [ImageFormat; 5] =
        [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::OpenExr, ImageFormat::WebP, ImageFormat::Tiff];
    let mut bytes = match random.random_range(0..6) {
        5 => [b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".as_slice(), &[120; 512]].concat(),
        kind => {
            let mut bytes = Cursor::new(Vec::new());
            let picture =
                DynamicImage::ImageRgb8(RgbImage::from_fn(16, 8, |x, y| image::Rgb([x as u8 * 15, y as u8 * 30, 9])));
            let picture = if FORMATS[kind] == ImageFormat::OpenExr { picture.into_rgb32f().into() } else { picture };
            picture.write_to(&mut bytes, FORMATS[kind]).unwrap();
            bytes.into_inner()
        }
    };
    damage(&mut bytes, random);
    bytes
}

fn recording(random: &mut SmallRng) -> Vec<u8> {
    let mut bytes = include_bytes!("../ride/tests/recordings/head.mcap").to_vec();
    damage(&mut bytes, random);
    bytes
}

/// Text with words replaced by lies, exchanged or lost.
fn words(text: &str, random: &mut SmallRng) -> Vec<u8> {
    let mut words: Vec<String> = text.split_inclusive([' ', '\n', ',', '=', '"', '<']).map(str::to_owned).collect();
    for _ in 0..random.random_range(1..5) {
        let (a, b) = (random.random_range(0..words.len()), random.random_range(0..words.len()));
        match random.random_range(0..4) {
            0 => words.swap(a, b),
            1 => words[a] = format!("{} ", LIES[random.random_range(0..LIES.len())]),
            2 => words[a] = words[b].clone(),
            _ => words[a].clear(),
        }
    }
    words.concat().into_bytes()
}

fn display(random: &mut SmallRng) -> Vec<u8> {
    const TEXTS: [&str; 3] = [
        include_str!("../displays/cave4.toml"),
        include_str!("../displays/dome6.toml"),
        include_str!("../displays/curved.toml"),
    ];
    words(TEXTS[random.random_range(0..TEXTS.len())], random)
}

fn paraview(random: &mut SmallRng) -> Vec<u8> {
    let text = "<?xml version=\"1.0\" ?>\n<pvx>\n <Process Type=\"client\" />\n <Process Type=\"render-server\">\n  \
        <EyeSeparation Value=\"0.065\"/>\n  <Machine Name=\"wall\" Environment=\"DISPLAY=:0\" Geometry=\"64x36+0+0\" \
        LowerLeft=\"-1.0 -1.0 -2.0\" LowerRight=\"1.0 -1.0 -2.0\" UpperRight=\"1.0 1.0 -2.0\" />\n </Process>\n</pvx>\n";
    words(text, random)
}

fn question(random: &mut SmallRng) -> Vec<u8> {
    let mut questions = [
        json!({ "ask": "aberration", "beta": [0.6, 0, 0], "direction": [0, 2, 0] }),
        json!({ "ask": "compose", "vehicle": { "beta": [0.6, 0, 0] }, "head": { "celerity": [0, 1, 0] } }),
        json!({ "ask": "colour", "spectrum": { "planck": 5800 }, "D": 1.5 }),
        json!({ "ask": "colour", "spectrum": { "sampled": [[400, 1], [700, 2]] }, "D": 0.5 }),
        json!({ "ask": "boost", "beta": [0, 0, 0.9], "event": [1, 2, 3, 4] }),
    ];
    let question = &mut questions[random.random_range(0..5)];
    for _ in 0..random.random_range(1..4) {
        lie(question, random);
    }
    question.to_string().into_bytes()
}
