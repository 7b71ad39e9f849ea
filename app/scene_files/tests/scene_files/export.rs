//! Law: a written glTF file is read back to the bit, here and by an independent reader.
//!
//! A wrong writer would lose a texture's wrapping, round an emission, forget the start, or produce files that other
//! programs refuse.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, too, may fail the test")]

use std::path::PathBuf;

use crate::support::load_path;
use glam::{DVec3, Vec2, Vec3};
use physics::colour::Spectrum;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scene::{Alpha, Lighting, Material, Mesh, Panorama, Scene, Start, Texture, Wrap};
use scene_files::export::{ExportError, write_glb};
use tempfile::TempDir;

/// Scene in which everything differs from its default, with numbers that have no short decimal form.
fn scene(origin: DVec3) -> Scene {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut mesh = |name: &str, material, solid| {
        let vector = |random: &mut ChaCha8Rng| Vec3::from_array(random.random()) - 0.5;
        let positions: Vec<Vec3> = (0..33).map(|_| vector(&mut random) * 77.7).collect();
        Mesh {
            name: name.into(),
            material,
            normals: positions.iter().map(|_| vector(&mut random).normalize()).collect(),
            uvs: positions.iter().map(|_| Vec2::from_array(random.random())).collect(),
            colours: positions.iter().map(|_| random.random()).collect(),
            // Vertices of no triangle would not be read.
            indices: (0..33).chain((0..30).map(|_| random.random_range(0..33))).collect(),
            emissive_uvs: Vec::new(),
            positions,
            solid,
            motion: None,
        }
    };
    let meshes = vec![mesh("house 1", 1, true), mesh("tree \"é\"", 0, false), mesh("", 2, true)];
    let texture = |name: &str, wrap, nearest| Texture {
        name: name.into(),
        width: 3,
        height: 2,
        rgba: std::sync::Arc::new((0..24).map(|byte| byte * 10).collect()),
        wrap,
        nearest,
    };
    Scene {
        name: "Marktplatz".into(),
        origin,
        textures: vec![
            texture("stone", [Wrap::Repeat, Wrap::Mirror], false),
            texture("leaf", [Wrap::Clamp, Wrap::Repeat], true),
        ],
        materials: vec![
            Material {
                name: "leaf".into(),
                base_colour: [0.1, 0.7, 1.0 / 3.0, 0.9],
                base_colour_texture: Some(1),
                alpha: Alpha::Mask(0.37),
                double_sided: true,
                ..Material::default()
            },
            Material {
                name: "lamp".into(),
                emissive: [17.3, 0.1, 5.77],
                emissive_texture: Some(0),
                ..Material::default()
            },
            Material {
                name: "glass".into(),
                unlit: true,
                alpha: Alpha::Blend,
                spectrum: Some(Spectrum::Planck { kelvin: 1e4 / 3.0 }),
                ..Material::default()
            },
            Material { name: "paint".into(), spectrum: Some(measured(&mut random)), ..Material::default() },
            Material {
                name: "ink".into(),
                spectrum: Some(Spectrum::Rgb([0.1, 1.0 / 3.0, 1e-9])),
                ..Material::default()
            },
            Material { name: "paper".into(), spectrum: Some(Spectrum::Gray), ..Material::default() },
        ],
        meshes,
        light: Lighting {
            sun_direction: Vec3::new(0.3, 0.9, -0.2).normalize(),
            sun: [0.1, 0.2, 0.3],
            shadows: false,
            ..Lighting::default()
        },
        start: Start {
            position: origin + DVec3::new(0.1, 0.2, 0.3),
            look: DVec3::new(1.0, 0.1, 2.0).normalize(),
            ..Start::default()
        },
        circuit: vec![DVec3::new(0.1, 0.0, 1e9 + 0.1), DVec3::ZERO],
        illuminant: Some(measured(&mut random)),
        white: Some(1e10 / 7.0),
        panorama: Some(Panorama::new(4, 2, (0..8).map(|_| random.random()))),
        ..Scene::default()
    }
}

/// Spectrum of a hundred samples with no short decimal form.
fn measured(random: &mut ChaCha8Rng) -> Spectrum {
    let sample = |index| [300.0 + f64::from(index) + random.random::<f64>(), random.random::<f64>() * 1e13];
    Spectrum::sampled((0..100).map(sample).collect::<Vec<_>>()).unwrap()
}

fn written(scene: &Scene) -> (TempDir, PathBuf) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.glb");
    write_glb(scene, &path).unwrap_or_else(|error| panic!("{error}"));
    (folder, path)
}

#[test]
fn what_is_written_is_read_back_to_the_bit() {
    for origin in [DVec3::ZERO, DVec3::new(1e9 + 0.1, -3.7e6, 0.123_456_789)] {
        let scene = scene(origin);
        let (_folder, path) = written(&scene);
        assert_eq!(load_path(&path).unwrap(), scene);
    }
}

#[test]
fn any_emission_is_read_back_exactly() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let mut scene = scene(DVec3::ZERO);
    scene.materials.extend((0..500).map(|_| Material {
        name: "lamp".into(),
        emissive: [(); 3].map(|()| 10_f32.powf(random.random_range(-3.0..6.0))),
        ..Material::default()
    }));
    let (_folder, path) = written(&scene);
    assert_eq!(load_path(&path).unwrap().materials, scene.materials);
}

#[test]
fn colours_above_one_are_kept_for_us_and_clamped_for_others() {
    let mut scene = scene(DVec3::ZERO);
    scene.meshes[0].colours[7] = [0.5, 1.7, 1.0, 1.0];
    let (_folder, path) = written(&scene);
    assert_eq!(load_path(&path).unwrap(), scene);
    let (document, buffers, _) = gltf::import(&path).unwrap();
    let primitive = document.meshes().next().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|buffer| Some(&buffers[buffer.index()]));
    let colours: Vec<_> = reader.read_colors(0).unwrap().into_rgba_f32().collect();
    assert_eq!(colours[7], [0.5, 1.0, 1.0, 1.0]);
}

#[test]
fn defaults_are_read_back_too() {
    let plain = Scene {
        name: String::new(),
        materials: vec![Material::default()],
        meshes: vec![Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: vec![Vec2::ZERO; 3],
            colours: vec![[1.0; 4]; 3],
            indices: vec![0, 1, 2],
            solid: true,
            ..Mesh::default()
        }],
        ..Scene::default()
    };
    let (_folder, path) = written(&plain);
    assert_eq!(load_path(&path).unwrap(), plain);
}

#[test]
fn an_independent_reader_accepts_it() {
    let scene = scene(DVec3::new(10.0, 20.0, 30.0));
    let (_folder, path) = written(&scene);
    let (document, buffers, images) = gltf::import(&path).unwrap();
    assert_eq!(document.nodes().count(), 3);
    assert_eq!(images[0].pixels, *scene.textures[0].rgba);
    for (node, mesh) in document.nodes().zip(&scene.meshes) {
        let primitive = node.mesh().unwrap().primitives().next().unwrap();
        let reader = primitive.reader(|buffer| Some(&buffers[buffer.index()]));
        let positions: Vec<Vec3> = reader.read_positions().unwrap().map(Vec3::from_array).collect();
        assert_eq!(positions, mesh.positions);
        assert_eq!(reader.read_indices().unwrap().into_u32().collect::<Vec<_>>(), mesh.indices);
        let bounds = primitive.bounding_box();
        assert_eq!(Vec3::from_array(bounds.min), positions.iter().copied().reduce(Vec3::min).unwrap());
        assert_eq!(Vec3::from_array(bounds.max), positions.iter().copied().reduce(Vec3::max).unwrap());
        assert_eq!(node.transform().decomposed().0, [10.0, 20.0, 30.0]);
    }
}

#[test]
fn header_and_chunks_are_whole_words() {
    let (_folder, path) = written(&scene(DVec3::ZERO));
    let bytes = std::fs::read(path).unwrap();
    let word = |place: usize| u32::from_le_bytes(bytes[place..place + 4].try_into().unwrap()) as usize;
    assert_eq!(word(8), bytes.len());
    let text = word(12);
    assert_eq!(text % 4, 0);
    let blob = word(20 + text);
    assert_eq!(blob % 4, 0);
    assert_eq!(20 + text + 8 + blob, bytes.len());
    let json: serde_json::Value = serde_json::from_slice(&bytes[20..20 + text]).unwrap();
    for view in json["bufferViews"].as_array().unwrap() {
        assert_eq!(view["byteOffset"].as_u64().unwrap() % 4, 0);
    }
}

#[test]
fn nothing_is_left_behind_but_the_file() {
    let (folder, _path) = written(&scene(DVec3::ZERO));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn what_gltf_cannot_say_is_refused_by_name() {
    let refused = |change: fn(&mut Scene), words: &str| {
        let mut scene = scene(DVec3::ZERO);
        change(&mut scene);
        let folder = TempDir::new().unwrap();
        let error = write_glb(&scene, &folder.path().join("scene.glb")).unwrap_err().to_string();
        assert!(error.contains(words), "{words} is not in: {error}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "no half a file");
    };
    refused(|scene| scene.meshes[0].positions[3].y = f32::NAN, "a position of \"house 1\"");
    refused(|scene| scene.meshes[0].normals[3].y = f32::INFINITY, "a normal of \"house 1\"");
    refused(|scene| scene.meshes[0].colours[3][1] = -0.5, "a vertex colour of \"house 1\"");
    refused(|scene| scene.materials[1].base_colour[0] = 1.5, "the base colour of \"lamp\"");
    refused(|scene| scene.materials[1].emissive[0] = f32::MAX, "the emission of \"lamp\"");
    refused(|scene| scene.start.look.x = f64::NAN, "the start of \"Marktplatz\"");
    refused(|scene| scene.meshes[0].indices[0] = 99, "uses vertex 99 of 33");
    refused(|scene| scene.meshes[0].material = 9, "uses material 9 of 6");
    refused(
        |scene| scene.materials[3].spectrum = Some(Spectrum::Planck { kelvin: f64::NAN }),
        "the spectrum of material \"paint\"",
    );
    refused(|scene| scene.illuminant = Some(Spectrum::Rgb([-1.0, 0.0, 0.0])), "the spectrum of the light");
    refused(
        |scene| scene.panorama = Some(Panorama::new(4, 2, [[-1.0, 0.0, 0.0]; 8])),
        "the panorama of \"Marktplatz\": it has a radiance",
    );
    refused(
        |scene| scene.panorama = Some(Panorama { width: 2, height: 4, ..scene.panorama.take().unwrap() }),
        "not twice as wide",
    );
    refused(|scene| scene.panorama.as_mut().unwrap().width = 7, "the panorama of 7 × 2 pixels has 8");
    refused(|scene| scene.white = Some(0.0), "the luminance of white is 0");
    refused(|scene| scene.meshes.clear(), "no triangles");
}

#[test]
fn a_folder_that_is_not_there_is_named() {
    let error = write_glb(&scene(DVec3::ZERO), "/nowhere/at/all.glb".as_ref()).unwrap_err();
    assert!(matches!(error, ExportError::Write { .. }));
    assert!(error.to_string().contains("/nowhere/at/all.glb"), "{error}");
}
