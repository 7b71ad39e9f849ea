//! Law: a file's animations place its nodes at each second of the world, under all their parents. An impossible
//! animation is refused in a sentence, and a part that is not shown is named.
//!
//! A wrong program shows nodes that stand still, keys read in the wrong order, a child that ignores its parents, an
//! animation that jumps back where it should go on, or a body faster than light.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::support::{GltfUnderTest, read_path};
use glam::{DQuat, DVec3};
use scene::Scene;
use scene::motion::{Animated, Motion};
use scene_files::check::Report;
use serde_json::{Value, json};

/// Speed of light, m/s: faster than everything that moves here.
const SPEED_OF_LIGHT: f64 = 20.0;

/// Tolerance, metres, for keys in f32.
const ROUNDED: f64 = 1e-6;

fn scalars(file: &mut GltfUnderTest, values: &[f32]) -> usize {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    file.accessor(&bytes, 5126, "SCALAR", values.len())
}

/// Adds an animation with one channel.
fn animate(file: &mut GltfUnderTest, node: usize, path: &str, interpolation: &str, times: &[f32], values: &[f32]) {
    let input = scalars(file, times);
    let output = file.floats(if path == "rotation" { "VEC4" } else { "VEC3" }, values);
    let animation = json!({
        "channels": [{ "sampler": 0, "target": { "node": node, "path": path } }],
        "samplers": [{ "input": input, "output": output, "interpolation": interpolation }],
    });
    match file.json.get_mut("animations") {
        Some(Value::Array(animations)) => animations.push(animation),
        _ => file.json["animations"] = json!([animation]),
    }
}

/// Carousel: node 0 rests and is twice as large, 1 turns on it, 2 is moved on 1, 3 has the triangle.
fn carousel() -> GltfUnderTest {
    let mut file = GltfUnderTest::triangle();
    file.json["scenes"][0]["nodes"] = json!([0]);
    file.json["nodes"] = json!([
        { "children": [1], "translation": [10, 0, 0], "scale": [2, 2, 2] },
        { "name": "carousel", "children": [2], "translation": [0, 1, 0] },
        { "name": "horse", "children": [3] },
        { "mesh": 0, "translation": [0, 0, 3] },
    ]);
    let quarters: Vec<f32> = (0..=4)
        .flat_map(|quarter| DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2 * f64::from(quarter)).to_array())
        .map(|value| value as f32)
        .collect();
    animate(&mut file, 1, "rotation", "LINEAR", &[0.0, 1.0, 2.0, 3.0, 4.0], &quarters);
    file
}

fn read(file: &GltfUnderTest, speed_of_light: f64) -> Result<Scene, String> {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("scene.glb");
    std::fs::write(&path, file.glb()).unwrap();
    let mut scene = read_path(&path).map_err(|error| error.to_string())?;
    scene.set_speed_of_light(speed_of_light).map_err(|error| error.to_string())?;
    Ok(scene)
}

fn animated(scene: &Scene) -> &Animated {
    let motion = scene.meshes[0].motion.unwrap();
    let Motion::Animated(animated) = &scene.motions[motion] else { unreachable!("it is animated") };
    animated
}

/// World position of the triangle's first corner, `time_s` after the world's start.
fn corner(scene: &Scene, time_s: f64) -> DVec3 {
    let pose = animated(scene).at(time_s * SPEED_OF_LIGHT);
    pose.position(scene.meshes[0].positions[0].as_dvec3())
}

#[test]
fn a_carousel_turns_for_ever_under_its_parents() {
    let scene = read(&carousel(), SPEED_OF_LIGHT).unwrap();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert!(!scene.meshes[0].solid);
    for time in [-3.3_f64, 0.0, 0.4, 2.5, 3.9, 4.0, 103.7] {
        let (sine, cosine) = (std::f64::consts::FRAC_PI_2 * time).sin_cos();
        let expected = DVec3::new(10.0, 2.0, 0.0) + 6.0 * DVec3::new(sine, 0.0, cosine);
        let found = corner(&scene, time);
        assert!(found.distance(expected) < 10.0 * ROUNDED, "{found} {expected} at {time} s");
    }
    // The triangle's node passes 6 m from the axis, its furthest corner further out.
    let report = Report::new(&scene).unwrap();
    assert!(report.moving[0].contains("\"carousel\"") && report.moving[0].contains("11.327"), "{:?}", report.moving);
    assert!(report.to_string().contains("moves       \"carousel\""));
}

#[test]
fn a_chain_of_two_moves_as_both_say() {
    let mut file = carousel();
    // The horse rises by 1 along y in two seconds: cubic, at rest at its keys.
    let up = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    animate(&mut file, 2, "translation", "CUBICSPLINE", &[0.0, 2.0], &up);
    let scene = read(&file, SPEED_OF_LIGHT).unwrap();
    assert_eq!(animated(&scene).name, "horse");
    // Half way in time the cubic is half way up; it stays at its end, since it does not end as it began.
    for (time, height) in [(-1.0, 0.0), (0.0, 0.0), (1.0, 0.5), (2.0, 1.0), (50.0, 1.0)] {
        let (sine, cosine) = (std::f64::consts::FRAC_PI_2 * time).sin_cos();
        let expected = DVec3::new(10.0, 2.0 + 2.0 * height, 0.0) + 6.0 * DVec3::new(sine, 0.0, cosine);
        let found = corner(&scene, time);
        assert!(found.distance(expected) < 10.0 * ROUNDED, "{found} {expected} at {time} s");
    }
}

#[test]
fn what_would_be_faster_than_light_is_refused() {
    let said = read(&carousel(), 9.0).unwrap_err();
    assert!(said.starts_with("carousel moves at 11.327"), "{said}");
    assert!(said.contains("s of its animation, and light at 9.000000 m/s"), "{said}");
    assert!(said.contains("slow the animation down, or raise --speed-of-light"), "{said}");
    // A speed below that of light by less than one part in a thousand is accepted.
    assert!(read(&carousel(), 11.33).is_ok());
}

#[test]
fn what_is_not_shown_stands_still_and_is_named() {
    let mut file = carousel();
    animate(&mut file, 2, "translation", "STEP", &[0.0, 1.0], &[0.0, 0.0, 0.0, 5.0, 0.0, 0.0]);
    animate(&mut file, 1, "rotation", "LINEAR", &[0.0], &[0.0, 0.0, 0.0, 1.0]);
    let scene = read(&file, SPEED_OF_LIGHT).unwrap();
    let said = scene.notices.join("\n");
    assert!(
        said.contains("1 channel of an animation stands still: animations[1].channels[0] (it jumps (STEP)"),
        "{said}"
    );
    assert!(said.contains("nodes that several animations move follow the first"), "{said}");
    let turned = corner(&scene, 1.0);
    assert!(turned.distance(DVec3::new(16.0, 2.0, 0.0)) < 10.0 * ROUNDED, "{turned}");

    let mut file = carousel();
    file.json["nodes"][0]["extras"] = json!({ "celerity": [0.1, 0, 0] });
    let scene = read(&file, SPEED_OF_LIGHT).unwrap();
    assert!(matches!(scene.motions[0], Motion::Uniform(_)));
    assert!(scene.notices.join("\n").contains("its animation stands still"), "{:?}", scene.notices);
}

#[test]
fn a_channel_that_holds_one_value_is_a_pose() {
    for (interpolation, times, values) in [
        ("LINEAR", &[2.0][..], &[0.0, 5.0, 0.0][..]),
        ("STEP", &[0.0, 1.0], &[0.0, 5.0, 0.0, 0.0, 5.0, 0.0]),
        ("CUBICSPLINE", &[2.0], &[9.0, 9.0, 9.0, 0.0, 5.0, 0.0, 9.0, 9.0, 9.0]),
    ] {
        let mut file = GltfUnderTest::triangle();
        animate(&mut file, 0, "translation", interpolation, times, values);
        let scene = read(&file, SPEED_OF_LIGHT).unwrap();
        assert!(scene.motions.is_empty() && scene.notices.is_empty(), "{interpolation}: {:?}", scene.notices);
        assert_eq!(scene.meshes[0].positions[0], glam::Vec3::new(0.0, 5.0, 0.0), "{interpolation}");
    }
    let mut file = GltfUnderTest::triangle();
    animate(&mut file, 0, "scale", "STEP", &[0.0], &[3.0, 1.0, 1.0]);
    assert_eq!(read(&file, SPEED_OF_LIGHT).unwrap().meshes[0].positions[1], glam::Vec3::new(6.0, 0.0, 0.0));
}

#[test]
fn a_body_grows_evenly_and_not_faster_than_light() {
    let mut file = GltfUnderTest::triangle();
    animate(&mut file, 0, "scale", "LINEAR", &[0.0, 2.0], &[0.0, 1.0, 1.0, 4.0, 1.0, 1.0]);
    let scene = read(&file, SPEED_OF_LIGHT).unwrap();
    for (time, width) in [(0.0, 0.0), (0.5, 2.0), (1.0, 4.0), (3.0, 8.0)] {
        let pose = animated(&scene).at(time * SPEED_OF_LIGHT);
        let corner = pose.position(scene.meshes[0].positions[1].as_dvec3());
        assert!((corner.x - width).abs() < ROUNDED, "{corner} at {time} s");
    }
    // Its corner, 2 m out, moves at 4 m/s.
    let said = read(&file, 3.9).unwrap_err();
    assert!(said.contains("moves at 4.000000 m/s"), "{said}");
}

#[test]
fn damaged_keys_stand_still_and_are_named() {
    let said = |change: fn(&mut GltfUnderTest)| {
        let mut file = carousel();
        change(&mut file);
        let scene = read(&file, SPEED_OF_LIGHT).unwrap();
        assert_eq!(animated(&scene).name, "carousel", "the rest moves");
        scene.notices.join("\n")
    };
    let faulty = said(|file| animate(file, 2, "translation", "LINEAR", &[1.0, 0.0], &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0]));
    assert!(faulty.contains("animations[1].channels[0] (its times do not ascend at key 1)"), "{faulty}");
    let faulty = said(|file| animate(file, 2, "translation", "CUBICSPLINE", &[0.0, 1.0], &[0.0; 6]));
    assert!(faulty.contains("it has 2 times and 0 values"), "{faulty}");
    let faulty = said(|file| animate(file, 2, "rotation", "LINEAR", &[0.0], &[0.0; 4]));
    assert!(faulty.contains("key 0 is no rotation"), "{faulty}");
    let faulty = said(|file| animate(file, 9, "rotation", "LINEAR", &[0.0], &[0.0; 4]));
    assert!(faulty.contains("animations[1].channels[0].target.node") || faulty.contains("no number 9"), "{faulty}");
}

#[test]
fn of_keys_at_one_time_the_later_counts_and_surplus_values_are_passed_over() {
    let mut file = GltfUnderTest::triangle();
    let (times, values) =
        (&[0.0, 1.0, 1.0, 2.0], &[0.0, 0.0, 0.0, 9.0, 9.0, 9.0, 2.0, 0.0, 0.0, 2.0, 0.0, 0.0, 7.0, 7.0, 7.0]);
    animate(&mut file, 0, "translation", "LINEAR", times, values);
    let scene = read(&file, SPEED_OF_LIGHT).unwrap();
    assert!(corner(&scene, 0.5).distance(DVec3::X) < ROUNDED && corner(&scene, 1.5).distance(DVec3::X * 2.0) < ROUNDED);
    let said = scene.notices.join("\n");
    assert!(said.contains("several keys at one time") && said.contains("more values than times"), "{said}");
}
