//! Law: the walls of the house hold. Crates use each other as the table in ARCHITECTURE.md says and in no other way; no
//! two files of a crate import each other in a circle; a face (`lib.rs`, `mod.rs`) that its own crate imports defines
//! nothing; type names tell their room; comments open with a noun and are no wider than the style asks. A house without
//! these tests grows together again, one convenient import at a time.
//!
//! `cargo test --release -p system-tests house -- --nocapture` prints the figures.
#![allow(clippy::unwrap_used, reason = "a file that cannot be read is a failed test")]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use system_tests::house::{Measures, Room};

/// Crates of the house, each with the crates of the house that it uses, from the bottom upwards.
const PLAN: [(&str, &[&str]); 36] = [
    ("physics", &[]),
    ("exact_reference", &[]),
    ("shaders", &["physics"]),
    ("regular_file", &[]),
    ("words", &[]),
    ("xr_layer", &[]),
    ("decoders", &["regular_file"]),
    ("gltf_text", &[]),
    ("input", &["regular_file"]),
    ("view", &["physics"]),
    ("scene", &["physics", "view"]),
    ("panoramas", &["physics", "regular_file", "scene"]),
    ("scene_files", &["decoders", "gltf_text", "panoramas", "physics", "regular_file", "scene"]),
    ("built_in", &["physics", "scene"]),
    ("picture_cache", &["built_in", "regular_file"]),
    ("picture_files", &[]),
    ("room", &["regular_file", "view"]),
    ("hardware", &["input", "regular_file", "room", "words"]),
    ("trace", &["physics", "scene", "shaders", "view"]),
    ("render", &["physics", "scene", "shaders", "view"]),
    ("studio", &["render", "shaders", "view"]),
    ("ride", &["input", "physics", "scene", "view"]),
    ("instruments", &["physics", "ride", "scene"]),
    ("kiosk", &["input", "ride"]),
    ("tours", &["input", "regular_file", "ride", "scene", "view"]),
    ("camera_paths", &["physics", "regular_file", "scene", "view"]),
    ("presentation", &["input", "render", "view", "words"]),
    ("interface", &["hardware", "input", "presentation", "render", "ride", "shaders", "view", "words"]),
    ("probe", &["physics", "ride"]),
    ("walls", &["physics", "render", "room", "shaders", "studio", "view"]),
    (
        "filming",
        &["input", "picture_files", "presentation", "render", "ride", "shaders", "studio", "trace", "view", "walls"],
    ),
    ("headset", &["input", "render", "room", "walls"]),
    ("measure", &["exact_reference", "input", "physics", "render", "ride", "scene", "studio", "trace", "view"]),
    (
        "cabin",
        &[
            "input",
            "instruments",
            "interface",
            "physics",
            "presentation",
            "render",
            "ride",
            "room",
            "scene",
            "walls",
            "words",
        ],
    ),
    (
        "command",
        &[
            "filming",
            "input",
            "measure",
            "physics",
            "picture_files",
            "presentation",
            "regular_file",
            "render",
            "ride",
            "room",
            "scene",
            "view",
            "walls",
            "words",
        ],
    ),
    (
        "rapidity",
        &[
            "built_in",
            "cabin",
            "camera_paths",
            "command",
            "filming",
            "hardware",
            "headset",
            "input",
            "interface",
            "kiosk",
            "measure",
            "panoramas",
            "physics",
            "picture_cache",
            "picture_files",
            "presentation",
            "probe",
            "regular_file",
            "render",
            "ride",
            "room",
            "scene",
            "scene_files",
            "studio",
            "tours",
            "trace",
            "view",
            "walls",
            "words",
        ],
    ),
];

/// Largest share of types whose name stands for another type as well.
const SHARED_NAMES: f64 = 0.05;
/// Largest share of doc comments that open with a word that names nothing.
const NAMELESS_DOCS: f64 = 0.05;
/// Largest number of lines of a crate, but for `input`.
const LARGEST_CRATE: usize = 8000;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

/// What `cargo metadata` says of the workspace's packages.
fn packages() -> Vec<Value> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

fn name(package: &Value) -> &str {
    package["name"].as_str().unwrap()
}

/// Crates of the workspace with their sources, the whole-system tests left out.
fn rooms() -> Vec<Room> {
    let root = root();
    let room = |package: &Value| {
        let manifest = PathBuf::from(package["manifest_path"].as_str().unwrap());
        let folder = manifest.parent().unwrap().strip_prefix(&root).unwrap().to_owned();
        Room::read(&root, &folder, name(package))
    };
    packages().iter().filter(|package| name(package) != "system-tests").map(room).collect()
}

#[test]
fn crates_use_each_other_as_planned() {
    let packages = packages();
    let ours: BTreeSet<&str> = packages.iter().map(name).collect();
    let used = |package: &Value| {
        let dependencies = package["dependencies"].as_array().unwrap().iter();
        let of_program = dependencies.filter(|dependency| dependency["kind"].is_null());
        let names = of_program.map(|dependency| dependency["name"].as_str().unwrap().to_owned());
        names.filter(|name| ours.contains(name.as_str())).collect::<BTreeSet<String>>()
    };
    let arrows: BTreeMap<&str, BTreeSet<String>> = packages
        .iter()
        .filter(|package| name(package) != "system-tests")
        .map(|package| (name(package), used(package)))
        .collect();
    let planned = PLAN.iter().map(|(room, uses)| (*room, uses.iter().map(|&name| name.to_owned()).collect()));
    assert_eq!(arrows, planned.collect(), "change the plan here and in ARCHITECTURE.md, with the reason, or the arrow");
    // From the bottom upwards, so that no arrow leads back.
    for (place, (room, uses)) in PLAN.iter().enumerate() {
        let below: Vec<&str> = PLAN[..place].iter().map(|(name, _)| *name).collect();
        assert!(uses.iter().all(|used| below.contains(used)), "{room} uses what is above it");
    }
}

#[test]
fn the_figures_of_the_house_are_kept() {
    let rooms = rooms();
    let measures = Measures::of(&rooms);
    let share = |(all, some): (usize, usize)| some as f64 / all as f64;
    let (types, shared) = (measures.types.0, measures.types.1.len());
    let lines = |room: &Room| room.lines();
    let large: Vec<_> = rooms.iter().filter(|room| room.name != "input" && lines(room) > LARGEST_CRATE).collect();
    println!("largest crate: {} with {} lines", measures.largest.0, measures.largest.1);
    println!("circles of files: {}", measures.circles.len());
    println!("types: {types}, of which {shared} share their name ({:.1} %)", 100.0 * share((types, shared)));
    println!(
        "doc comments: {}, of which {} open with a word that names nothing ({:.1} %)",
        measures.docs.0,
        measures.docs.1,
        100.0 * share(measures.docs)
    );
    println!("comment lines: {}, of which {} are too wide", measures.comments.0, measures.comments.1.len());
    println!("lines that print: {:?}", measures.printing);

    assert_eq!(measures.circles, Vec::<Vec<PathBuf>>::new());
    assert_eq!(measures.defining_faces, Vec::<PathBuf>::new());
    let mut names = measures.types.1.clone();
    names.sort();
    names.dedup();
    assert!(share((types, shared)) <= SHARED_NAMES, "{names:?}");
    assert!(share(measures.docs) <= NAMELESS_DOCS, "{:?}", measures.docs);
    assert_eq!(measures.comments.1, Vec::<String>::new());
    assert!(large.is_empty(), "{:?}", large.iter().map(|room| &room.name).collect::<Vec<_>>());
    // The program writes lines without macros that panic where nothing can be written.
    assert!(measures.printing.is_empty(), "{:?}: libraries return, the program reports", measures.printing);
}

/// Parts of `physics` that no ride depends on: light and pictures.
const BESIDE_THE_RIDE: [&str; 3] = ["colour/", "photo_surface/", "interpolation_error.rs"];

#[test]
fn a_ride_asks_the_c_library_for_no_elementary_function() {
    let of_ride = |room: &&Room| ["physics", "input", "ride"].contains(&room.name.as_str());
    for room in rooms().iter().filter(of_ride) {
        for file in &room.files {
            let path = file.path.to_string_lossy();
            let beside = room.name == "physics" && BESIDE_THE_RIDE.iter().any(|part| path.contains(part));
            let calls = file.elementary_calls();
            assert!(beside || calls.is_empty(), "{path}: {calls:?}; take them from libm, which is the same everywhere");
        }
    }
}

#[test]
fn each_crate_has_one_test_binary() {
    // The memory of a process is measured in a process of its own.
    for package in packages() {
        let targets = package["targets"].as_array().unwrap().iter();
        // Tests that need a runtime of their own are asked for by name.
        let is_usual = |target: &&Value| target["kind"] == Value::from(vec!["test"]) && target["test"] == true;
        let tests = targets.filter(is_usual).count();
        assert!(tests <= if name(&package) == "system-tests" { 2 } else { 1 }, "{}: {tests}", name(&package));
    }
}
