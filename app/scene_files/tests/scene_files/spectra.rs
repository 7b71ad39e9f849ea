//! Law: spectra and lights of a glTF file are read as written, and each mistake is reported by file, owner, key and
//! reason.
//!
//! A wrong loader would swallow a misspelt key and show grey, read a wavelength from the wrong line, let the sun
//! shine out of the ground, or stop at the first of five mistakes.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::f32::consts::PI;

use crate::support::{GltfUnderTest, load_path, png, read_path, report, write};
use built_in::spectra;
use glam::{DVec3, Vec3};
use physics::colour::Spectrum;
use scene::Surroundings;
use scene::collision::Collision;
use scene::refine::refine;
use scene::{Lighting, Material, Panorama, Scene};
use scene_files::check::Report;
use scene_files::export::write_glb;
use scene_files::gltf::GltfError;
use serde_json::{Value, json};
use tempfile::TempDir;

fn with_spectrum(spectrum: &Value) -> GltfUnderTest {
    let mut file = GltfUnderTest::triangle();
    file.material(json!({ "name": "lamp", "extras": { "spectrum": spectrum, "of somebody else": 1 } }));
    file
}

/// File with a triangle and lights, each at a node of its own.
fn with_lights(lights: &[Value]) -> GltfUnderTest {
    let mut file = GltfUnderTest::triangle();
    file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": lights } });
    for light in 0..lights.len() {
        let node = file.push("nodes", json!({ "extensions": { "KHR_lights_punctual": { "light": light } } }));
        file.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(node));
    }
    file
}

fn ours(file: &mut GltfUnderTest, extras: Value) {
    file.json["scenes"][0]["extras"] = json!({ "rapidity": extras });
}

/// Scene whose only material has its spectrum in this table beside it.
fn with_table(table: &str) -> Result<Scene, GltfError> {
    let folder = TempDir::new().unwrap();
    write(&folder, "paint.csv", table.as_bytes());
    load_path(&write(&folder, "scene.glb", &with_spectrum(&json!({ "sampled": "paint.csv" })).glb()))
}

#[test]
fn every_kind_of_spectrum_is_read() {
    let pairs = [[400.0, 0.25], [700.5, 1.0]];
    for (written, meant) in [
        (json!({ "planck": 2800 }), Spectrum::Planck { kelvin: 2800.0 }),
        (json!({ "sampled": pairs }), Spectrum::sampled(pairs).unwrap()),
        (json!({ "rgb": [0.25, 1, 0] }), Spectrum::Rgb([0.25, 1.0, 0.0])),
        (json!({ "gray": true }), Spectrum::Gray),
        (json!("gray"), Spectrum::Gray),
    ] {
        assert_eq!(with_spectrum(&written).scene().materials[0].spectrum, Some(meant));
    }
    assert_eq!(GltfUnderTest::triangle().scene().materials[0].spectrum, None);
}

#[test]
fn a_table_beside_the_scene_is_read() {
    let meant = Spectrum::sampled([[400.0, 0.25], [700.5, 1.0]]).ok();
    assert_eq!(with_table("# green\nnm,share\n400,0.25\n700.5,1\n").unwrap().materials[0].spectrum, meant);
    let folder = TempDir::new().unwrap();
    std::fs::create_dir(folder.path().join("measured")).unwrap();
    write(&folder, "measured/green paint.CSV", b"400,0.25\n700.5,1\n");
    let file = with_spectrum(&json!("measured/green%20paint.CSV"));
    assert_eq!(load_path(&write(&folder, "scene.glb", &file.glb())).unwrap().materials[0].spectrum, meant);
}

#[test]
fn what_is_no_spectrum_is_told_by_owner_key_and_reason() {
    let refused = |spectrum: Value, key: &str, reason: &str| {
        let error = with_spectrum(&spectrum).error();
        let place = format!("materials[0] \"lamp\", {key}: ");
        assert!(error.contains(&place) && error.contains(reason), "{place}…{reason} is not in: {error}");
    };
    refused(json!({ "plank": 2800 }), "extras.spectrum", "there is no spectrum \"plank\"; expected one of planck");
    refused(json!({ "planck": 2800, "kelvin": 1 }), "extras.spectrum", "there is no spectrum \"kelvin\"");
    refused(json!({ "planck": 2800, "rgb": [1, 1, 1] }), "extras.spectrum", "planck and rgb at once");
    refused(json!({}), "extras.spectrum", "it is empty");
    refused(json!("grey"), "extras.spectrum", "not \"grey\"");
    refused(json!(2800), "extras.spectrum", "not 2800");
    refused(json!(null), "extras.spectrum", "not null");
    refused(json!({ "planck": 0 }), "extras.spectrum.planck", "above 0, not 0");
    refused(json!({ "planck": -5.5 }), "extras.spectrum.planck", "not -5.5");
    refused(json!({ "planck": "hot" }), "extras.spectrum.planck", "not \"hot\"");
    refused(json!({ "rgb": [1, 1] }), "extras.spectrum.rgb", "three numbers");
    refused(json!({ "rgb": [1, -1, 0] }), "extras.spectrum.rgb", "0 or more");
    refused(json!({ "gray": false }), "extras.spectrum.gray", "expected true, not false");
    refused(json!({ "sampled": [] }), "extras.spectrum.sampled", "at least one sample");
    refused(json!({ "sampled": [[400, 1], [400, 1]] }), "extras.spectrum.sampled", "sample 1 is at 400");
    refused(json!({ "sampled": [[400, 1], [500, -1]] }), "extras.spectrum.sampled", "sample 1 is -1");
    refused(json!({ "sampled": [[-400, 1]] }), "extras.spectrum.sampled", "sample 0 is at -400");
    refused(json!({ "sampled": [[400, 1], 500] }), "extras.spectrum.sampled", "sample 1 is 500");
    refused(json!({ "sampled": [[400, "x"]] }), "extras.spectrum.sampled", "sample 0 is [400,\"x\"]");
    refused(json!({ "sampled": "paint.txt" }), "extras.spectrum.sampled", "not \"paint.txt\"");
    refused(json!({ "sampled": "nowhere.csv" }), "extras.spectrum.sampled", "nowhere.csv");
    refused(json!({ "sampled": "../paint.csv" }), "extras.spectrum.sampled", "not in the scene's folder");
    refused(json!("/etc/paint.csv"), "extras.spectrum", "not in the scene's folder");
    refused(json!("..%2Fpaint.csv"), "extras.spectrum", "not in the scene's folder");
}

#[test]
fn mistakes_in_a_table_are_told_with_their_line() {
    let refused = |table: &str, reason: &str| {
        let error = with_table(table).unwrap_err().to_string();
        assert!(
            error.contains("materials[0] \"lamp\", extras.spectrum.sampled: paint.csv") && error.contains(reason),
            "{error}"
        );
    };
    refused("nm,value\n400,1\n500;1\n", "paint.csv, line 3: expected a wavelength in nm, a comma and a value");
    refused("# measured\n\n400,1\n300,1\n", "paint.csv, line 4: ");
    refused("nm,value\n400,-1\n", "paint.csv, line 2: ");
    refused("400,inf\n", "paint.csv, line 1: ");
    refused("NaN,1\n", "paint.csv, line 1: ");
    refused("nm,value\n", "paint.csv: expected at least one sample");
}

#[test]
fn all_mistakes_are_told_at_once() {
    let mut file = with_lights(&[json!({ "type": "directional", "name": "Sun", "extras": { "spectrum": "red" } })]);
    file.material(json!({ "extras": { "spectrum": { "planck": -1 } } }));
    file.material(json!({ "extras": { "spectrum": { "plank": 1 } } }));
    file.json["nodes"][0]["extras"] = json!({ "spectrum": "gray" });
    ours(&mut file, json!({ "light": { "spectrum": { "rgb": 1 } } }));
    let Err(GltfError::Spectra { faults, .. }) = file.load() else { panic!("these are no spectra") };
    let owners: Vec<_> = faults.iter().map(|fault| fault.owner.as_str()).collect();
    assert_eq!(
        owners,
        ["materials[0] \"material 0\"", "materials[1] \"material 1\"", "lights[0] \"Sun\"", "nodes[0]", "scenes[0]"]
    );
    assert_eq!(faults[4].key, "extras.rapidity.light.spectrum.rgb");
    let error = file.error();
    assert_eq!(error.lines().filter(|line| line.contains("scene.glb has a spectrum")).count(), 5, "{error}");
    assert!(error.contains("nodes[0], extras.spectrum: this node bears no light"), "{error}");
}

#[test]
fn a_directional_light_is_the_sun() {
    let mut file = with_lights(&[json!({
        "type": "directional", "color": [1, 0.5, 0.25], "intensity": PI, "extras": { "spectrum": { "planck": 5800 } },
    })]);
    // The node turns its −z, along which the light travels, downwards: about x by −90°.
    let half = 0.5_f64.sqrt();
    file.json["nodes"][1]["rotation"] = json!([-half, 0, 0, half]);
    let scene = file.scene();
    assert!(scene.light.sun_direction.distance(Vec3::Y) < 1e-6, "{}", scene.light.sun_direction);
    assert_eq!(scene.light.sun, [1.0, 0.5, 0.25], "π lux show white as white");
    assert_eq!(scene.light.sky, Lighting::default().sky);
    assert_eq!(scene.illuminant, Some(Spectrum::Planck { kelvin: 5800.0 }));
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
}

#[test]
fn lights_that_do_not_shine_are_named() {
    let mut file = with_lights(&[
        json!({ "type": "point", "name": "Bulb" }),
        json!({ "type": "directional", "name": "Sun", "color": [0, PI, 0] }),
        json!({ "type": "directional", "name": "Moon", "extras": { "spectrum": "gray" } }),
        json!({ "type": "spot", "name": "Stage", "spot": {} }),
    ]);
    let scene = file.scene();
    assert_eq!((scene.light.sun, scene.illuminant), ([0.0, 1.0, 0.0], None));
    for name in ["the point light \"Bulb\"", "the directional light \"Moon\"", "the spot light \"Stage\""] {
        assert!(scene.notices.iter().any(|notice| notice.contains(name)), "{name} is not in {:?}", scene.notices);
    }
    assert_eq!(scene.notices.len(), 3);
    // Two of them are lamps, for the ray tracer.
    let [bulb, stage] = &scene.lamps[..] else { panic!("{:?}", scene.lamps) };
    assert_eq!((bulb.name.as_str(), bulb.colour, bulb.spot), ("Bulb", [1.0 / std::f32::consts::PI; 3], None));
    let spot = stage.spot.unwrap();
    assert_eq!((spot.direction, spot.inner_rad), (DVec3::NEG_Z, 0.0));
    assert!((spot.outer_rad - std::f64::consts::FRAC_PI_4).abs() < 1e-6);
    file.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = json!(9);
    let said = file.scene().notices.join("\n");
    assert!(said.contains("KHR_lights_punctual.light (there is no number 9 among 4)"), "{said}");
}

#[test]
fn lights_that_are_none_do_not_shine_and_are_named() {
    let refused = |light: Value, words: &str| {
        let said = with_lights(&[light]).scene().notices.join("\n");
        assert!(said.contains("1 light does not shine: extensions.KHR_lights_punctual.lights[0]"), "{said}");
        assert!(said.contains(words), "{said}");
    };
    refused(json!({ "type": "area" }), "none of directional, point, spot");
    refused(json!({ "type": "directional", "intensity": -1 }), "negative");
    refused(json!({ "type": "directional", "intensity": 1e38, "color": [9, 1, 1] }), "beyond all numbers");
}

#[test]
fn a_light_at_a_node_may_have_its_spectrum_there() {
    let mut file = with_lights(&[json!({ "type": "directional" })]);
    file.json["nodes"][1]["extras"] = json!({ "spectrum": { "planck": 3000 } });
    assert_eq!(file.scene().illuminant, Some(Spectrum::Planck { kelvin: 3000.0 }));
}

#[test]
fn our_own_words_about_light_come_last() {
    let mut file = with_lights(&[json!({
        "type": "directional", "intensity": PI, "extras": { "spectrum": { "planck": 5800 } },
    })]);
    ours(&mut file, json!({ "white": 80.5, "light": { "sky": [0.5, 0.25, 0.125], "spectrum": { "planck": 3000 } } }));
    let scene = file.scene();
    let expected = Lighting { sun_direction: Vec3::Z, sun: [1.0; 3], sky: [0.5, 0.25, 0.125], ..Lighting::default() };
    assert_eq!(scene.light, expected, "what is not mentioned stays");
    assert_eq!(scene.illuminant, Some(Spectrum::Planck { kelvin: 3000.0 }));
    assert_eq!(scene.white, Some(80.5));
    assert_eq!(scene.start.look, DVec3::NEG_Z);
}

#[test]
fn a_white_that_is_none_is_refused() {
    for white in [json!(0), json!(-1), json!("bright"), json!([1])] {
        let mut file = GltfUnderTest::triangle();
        ours(&mut file, json!({ "white": white }));
        let error = file.error();
        assert!(error.contains("scenes[0].extras.rapidity"), "{error}");
    }
    let mut file = GltfUnderTest::triangle();
    ours(&mut file, json!({ "whit": 1 }));
    assert!(file.error().contains("unknown field `whit`"), "{}", file.error());
}

#[test]
fn a_report_names_spectra_and_what_darkens_them() {
    let mut file = GltfUnderTest::triangle();
    let black = json!({ "baseColorFactor": [0, 0, 0, 1] });
    let planck = json!({ "spectrum": { "planck": 2800 } });
    file.material(json!({ "name": "lamp", "extensions": { "KHR_materials_unlit": {} }, "extras": planck }));
    file.material(json!({ "name": "wall", "extras": planck, "pbrMetallicRoughness": black }));
    file.material(json!({ "name": "paint", "extras": { "spectrum": { "sampled": [[400, 0], [700, 1]] } } }));
    let folder = TempDir::new().unwrap();
    let report = report(&write(&folder, "scene.glb", &file.glb()));
    assert_eq!(
        report.spectra,
        [
            "Planck at 2800 K: sent out by \"lamp\", returned by \"wall\"",
            "2 samples from 400 to 700 nm: returned by \"paint\""
        ]
    );
    let text = report.to_string();
    assert!(text.contains("spectrum    Planck at 2800 K"), "{text}");
    assert!(text.contains("material \"wall\" has a spectrum and a black base colour"), "{text}");
}

#[test]
fn a_report_warns_of_what_is_burnt_out_or_black() {
    let warned = |change: &dyn Fn(&mut Scene), words: &str| {
        let mut scene = with_lights(&[json!({ "type": "directional", "intensity": 1000.0 * PI })]).scene();
        change(&mut scene);
        let warnings = Report::new(&scene).unwrap().warnings;
        assert!(warnings.iter().any(|warning| warning.contains(words)), "{words} is not in {warnings:?}");
    };
    let planck = || Some(Spectrum::Planck { kelvin: 2800.0 });
    warned(&|_| (), "1000.0 times as bright as white");
    warned(&|scene| scene.illuminant = planck(), "1000.0 times as bright as white");
    warned(&|scene| scene.white = Some(1e6), "beside which colours, of 1 cd/m², are black (default)");
    warned(
        &|scene| {
            scene.light.sun = [1.0; 3];
            scene.materials.push(Material { unlit: true, spectrum: planck(), ..Material::default() });
        },
        "are black (default)",
    );
    let quiet = |change: &dyn Fn(&mut Scene)| {
        let mut scene = GltfUnderTest::triangle().scene();
        change(&mut scene);
        let warnings = Report::new(&scene).unwrap().warnings;
        assert!(!warnings.iter().any(|warning| warning.contains("white")), "{warnings:?}");
    };
    quiet(&|_| ());
    quiet(&|scene| scene.white = Some(100.0));
    quiet(&|scene| (scene.white, scene.light.sun) = (Some(25000.0), [25465.0; 3]));
    quiet(&|scene| scene.illuminant = planck());
}

#[test]
fn the_built_in_hall_survives_a_file() {
    let scene = spectra::build();
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("spectra.glb");
    write_glb(&scene, &path).unwrap();
    assert_eq!(load_path(&path).unwrap(), scene);
}

#[test]
fn a_panorama_beside_the_scene_surrounds_it() {
    let folder = TempDir::new().unwrap();
    write(&folder, "sky.png", &png(2, 1, &[255, 0, 0, 255, 0, 255, 0, 255]));
    let mut file = GltfUnderTest::triangle();
    ours(&mut file, json!({ "panorama": "sky.png" }));
    let scene = load_path(&write(&folder, "scene.glb", &file.glb())).unwrap();
    assert_eq!(scene.panorama.unwrap(), Panorama::new(2, 1, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]));

    let mut refused = |panorama: Value, words: &str| {
        ours(&mut file, json!({ "panorama": panorama }));
        let error = load_path(&write(&folder, "scene.glb", &file.glb())).unwrap_err().to_string();
        assert!(error.contains(words), "{words} is not in: {error}");
    };
    refused(json!("nowhere.png"), "cannot read");
    refused(json!("../sky.png"), "scenes[0].extras.rapidity.panorama: ../sky.png is not in the scene's folder");
    refused(json!(7), "expected the name of a picture, not 7");
    refused(json!({ "bufferView": 99 }), "no number 99");
    refused(json!({ "bufferView": 0 }), "scene.glb is no picture");
}

#[test]
fn a_picture_is_a_good_scene_and_so_is_an_empty_one_to_ride_in() {
    let folder = TempDir::new().unwrap();
    let path = write(&folder, "sky.png", &png(2, 1, &[255; 8]));
    let report = report(&path);
    assert_eq!((report.panorama, report.triangles), (Some([2, 1]), 0));
    assert!(report.warnings.is_empty() && report.notices.is_empty(), "{report}");
    assert!(report.to_string().contains("panorama    2 × 1 pixels"), "{report}");
    let scene = read_path(&path).unwrap();
    assert_eq!((scene.start.position, scene.start.look, scene.name.as_str()), (DVec3::ZERO, DVec3::NEG_Z, "sky"));
    assert_eq!(refine(&scene, 0.5).unwrap(), scene);
    let collision = Collision::new(&scene).unwrap();
    assert_eq!(collision.height_below(DVec3::ZERO), None);
    assert_eq!(collision.nearest_wall(DVec3::ZERO, 1e9), None);
}
