//! Law: an animated camera of a glTF file is flown by the world's time of its keys, through the transforms above it,
//! with the celerity that its keys give, and its own time is the slower for it. A wrong program sees with a camera at
//! rest.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::support::assert_derivatives;
use camera_paths::CameraPath;
use glam::DVec3;
use regular_file::Budget;
use scene::Scene;
use scene_files::gltf::ReadRules;
use serde_json::json;

const LIGHT: f64 = 10.0;

/// Scene of one triangle with a camera below an animated node, which is turned by 90 degrees to the left, and a camera
/// at rest. The keys: times, and places three by three.
fn scene(interpolation: &str, times: &[f32], places: &[f32]) -> Scene {
    let triangle: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let bytes = |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    let parts = [bytes(&triangle), bytes(times), bytes(places)];
    let view = |part: usize| {
        let begin: usize = parts[..part].iter().map(Vec::len).sum();
        json!({ "buffer": 0, "byteOffset": begin, "byteLength": parts[part].len() })
    };
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let file = json!({
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": parts.concat().len(), "uri": "scene.bin" }],
        "bufferViews": [view(0), view(1), view(2)],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5126, "count": times.len(), "type": "SCALAR",
              "min": [times[0]], "max": [times[times.len() - 1]] },
            { "bufferView": 2, "componentType": 5126, "count": places.len() / 3, "type": "VEC3" },
        ],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "cameras": [
            { "name": "flight", "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } },
            { "name": "tripod", "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } },
        ],
        "nodes": [
            { "mesh": 0 },
            { "rotation": [0, half, 0, half], "translation": [0, 5, 0], "children": [2] },
            { "name": "rail", "children": [3] },
            { "camera": 0, "translation": [0, 0.5, 0] },
            { "camera": 1 },
        ],
        "animations": [{
            "channels": [{ "sampler": 0, "target": { "node": 2, "path": "translation" } }],
            "samplers": [{ "input": 1, "output": 2, "interpolation": interpolation }],
        }],
        "scenes": [{ "nodes": [0, 1, 4] }],
        "scene": 0,
    });
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.bin"), parts.concat()).unwrap();
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, file.to_string()).unwrap();
    scene_files::read(&path, ReadRules { budget: &Budget::default(), trust: false }, |_| {}).unwrap()
}

fn flight(scene: &Scene) -> Result<CameraPath, camera_paths::CameraPathError> {
    let camera = scene.cameras.iter().find(|camera| camera.name == "flight").unwrap();
    CameraPath::of_gltf_camera(camera, LIGHT)
}

#[test]
fn a_camera_on_a_rail_is_flown_by_the_worlds_time() {
    // Ahead at 6 m/s for 2 s, β = 0.6, then at rest for 1 s.
    let scene = scene("LINEAR", &[1.0, 3.0, 4.0], &[0.0, 0.0, 0.0, 0.0, 0.0, -12.0, 0.0, 0.0, -12.0]);
    let path = flight(&scene).unwrap();
    assert!((path.length_s() - (2.0 / 1.25 + 1.0)).abs() < 1e-12, "{}", path.length_s());
    let seen = path.at(0.8);
    let observer = seen.gaze.observer;
    // The node above turns −z to −x.
    assert!((observer.event.ct - 2.0 * LIGHT).abs() < 1e-9);
    assert!(observer.event.position.distance(DVec3::new(-6.0, 5.5, 0.0)) < 1e-6, "{}", observer.event.position);
    assert!(observer.celerity.vector().distance(DVec3::new(-0.75, 0.0, 0.0)) < 1e-6);
    assert!((seen.gaze.observer_from_eye * DVec3::NEG_Z).distance(DVec3::NEG_X) < 1e-6);
    assert!(seen.upright.distance(DVec3::Y) < 1e-6);
    assert!((seen.fov_deg.unwrap() - 0.5_f64.to_degrees()).abs() < 1e-6);
    assert_eq!(path.at(2.0).gaze.observer.celerity.magnitude(), 0.0);
    let end = path.at(path.length_s()).gaze.observer.event;
    assert_eq!(end.ct, 4.0 * LIGHT);
}

#[test]
fn a_cubic_camera_has_the_celerity_of_its_way() {
    // Slope in, place, slope out.
    let keys = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [3.0, 0.0, -4.0],
        [4.0, 1.0, -6.0],
        [3.0, 0.0, -4.0],
        [0.0, 0.0, 0.0],
        [8.0, 0.0, -8.0],
        [0.0, 0.0, 0.0],
    ];
    let path = flight(&scene("CUBICSPLINE", &[0.0, 2.0, 4.0], &keys.concat())).unwrap();
    assert_derivatives(&path, LIGHT, 1e-6);
    assert!(path.length_s() < 3.9, "{}", path.length_s());
    let rests = [0.0, path.length_s()].map(|own_s| path.at(own_s).gaze.observer.celerity.magnitude());
    assert!(rests.iter().all(|rest| *rest < 1e-6), "{rests:?}");
}

#[test]
fn cameras_at_rest_and_faster_than_light_are_refused() {
    let fast = scene("LINEAR", &[0.0, 1.0, 2.0], &[0.0, 0.0, 0.0, 0.0, 0.0, -5.0, 0.0, 0.0, -17.0]);
    let error = flight(&fast).unwrap_err().to_string();
    assert!(
        error.contains("flight") && error.contains("from 1.000 s to 2.000 s") && error.contains("12.0000"),
        "{error}"
    );
    let tripod = fast.cameras.iter().find(|camera| camera.name == "tripod").unwrap();
    let error = CameraPath::of_gltf_camera(tripod, LIGHT).unwrap_err().to_string();
    assert!(error.contains("tripod") && error.contains("not animated"), "{error}");
    let flying = fast.cameras.iter().find(|camera| camera.name == "flight").unwrap();
    assert!(CameraPath::of_gltf_camera(flying, f64::NAN).is_err());
}
