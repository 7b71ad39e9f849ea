//! Law: parts follow each other by own time; a part without a scene of its own goes on in the time of the one before,
//! and legs in its place and motion. A wrong program begins each part at time zero, or sees the wrong scene.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use camera_paths::{CameraPath, PathFile, PathScene};
use glam::DVec3;

const PARTS: &str = "
[[part]]
scene = \"town\"
speed_of_light = \"36 km/h\"
[part.circle]
centre = [0, 2, 0]
radius = 4
speed = 6

[[part]]
[[part.leg]]
seconds = 1.5
[[part.leg]]
seconds = 1
thrust = [0, 1, 0]
look = [0, 1, 0]
up = [1, 0, 0]

[[part]]
scene = \"lattice\"
time = \"world\"
[[part.key]]
at = 4
position = [0, 0, 0]
[[part.key]]
at = 5
position = [0, 0, -3]
";

#[test]
fn parts_follow_each_other() {
    let file = PathFile::parse("path.toml", PARTS).unwrap();
    let scene = |name: &str, light| PathScene { scene: Some(name.to_owned()), speed_of_light_m_s: light };
    assert_eq!(file.scenes(), [scene("town", Some(10.0)), scene("town", Some(10.0)), scene("lattice", None)]);
    let path = file.path(&[10.0, 10.0, 5.0]).unwrap();
    assert_eq!(path.scenes()[2], scene("lattice", Some(5.0)));
    let begins = path.begins_s();
    let round_s = std::f64::consts::TAU * 4.0 / 6.0 / 1.25;
    assert!((begins[1] - round_s).abs() < 1e-12 && (begins[2] - begins[1] - 2.5).abs() < 1e-12);
    assert!((path.length_s() - begins[2] - 0.8).abs() < 1e-12);

    // Event, motion and look go on where the circle ended.
    let [circle, coasting] = [begins[1] - 1e-9, begins[1]].map(|own_s| path.at(own_s));
    assert_eq!([circle.part, coasting.part], [0, 1]);
    let (before, after) = (circle.gaze.observer, coasting.gaze.observer);
    assert!(
        before.event.position.distance(after.event.position) < 1e-7 && (before.event.ct - after.event.ct).abs() < 1e-7
    );
    assert!(before.celerity.vector().distance(after.celerity.vector()) < 1e-7);
    let looks = [circle, coasting].map(|seen| seen.gaze.observer_from_eye * DVec3::NEG_Z);
    assert!(looks[0].distance(looks[1]) < 1e-6, "{looks:?}");
    let coasted = path.at(begins[1] + 1.5).gaze.observer;
    assert!((coasted.event.ct - after.event.ct - 1.25 * 15.0).abs() < 1e-9, "γ = 1.25 for 1.5 s at 10 m/s");
    assert!(coasted.event.position.distance(after.event.position + after.celerity.vector() * 15.0) < 1e-9);

    // Another scene has its own time, place and light.
    let third = path.at(begins[2]);
    assert_eq!((third.part, third.gaze.observer.event.ct), (2, 20.0));
    assert!((third.gaze.observer.celerity.vector().z + 0.75).abs() < 1e-14);
    assert_eq!(path.at(1e9), path.at(path.length_s()));
    assert_eq!(path.at(-3.0).gaze.observer.event.position, path.at(0.0).gaze.observer.event.position);
}

#[test]
fn what_a_path_does_not_name_is_the_usual() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("path.toml");
    std::fs::write(&file, "[circle]\ncentre = [0, 0, 0]\nradius = 1\nspeed = \"9 km/h\"").unwrap();
    let usual = PathScene { scene: Some("train".to_owned()), speed_of_light_m_s: Some(5.0) };
    let path = CameraPath::read(&file, &usual).unwrap();
    assert_eq!(path.scenes(), [usual]);
    assert!((path.at(0.0).gaze.observer.celerity.beta().vector().length() - 0.5).abs() < 1e-15);
    let nothing = CameraPath::read(&file, &PathScene { scene: None, speed_of_light_m_s: None }).unwrap_err();
    assert!(nothing.to_string().contains("speed of light"), "{nothing}");
}
