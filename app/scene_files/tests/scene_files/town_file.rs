//! Law: the old town passes every stage of a scene: a check, a file and back, refinement, a lap.
//!
//! A scene of hundreds of meshes reveals faults of a loader or writer that one of three meshes hides. A town with a
//! hole in its street would not carry a bicycle.

use crate::support::load_path;
use built_in::town;
use scene::Surroundings;
use scene::collision::Collision;
use scene::refine::refine;
use scene_files::check::Report;
use scene_files::export::write_glb;
use tempfile::TempDir;

#[test]
fn the_town_is_sound_and_survives_a_file() {
    let town = town::build(1);
    let warnings = Report::new(&town).unwrap().warnings;
    for wrong in ["ground", "face away", "nowhere"] {
        assert!(!warnings.iter().any(|warning| warning.contains(wrong)), "{warnings:?}");
    }

    let collision = Collision::new(&town).unwrap();
    for &point in &town.circuit {
        assert_eq!(collision.nearest_wall(point, 0.5), None, "the circuit leads into a wall at {point}");
    }

    let folder = TempDir::new().unwrap();
    let path = folder.path().join("town.glb");
    write_glb(&town, &path).unwrap();
    let back = load_path(&path).unwrap();
    // A file holds neither the hands' motion nor the names of clocks and places: all else comes back.
    let moving: Vec<String> =
        town.meshes.iter().filter(|mesh| mesh.motion.is_some()).map(|mesh| mesh.name.clone()).collect();
    assert_eq!(back.meshes.len(), town.meshes.len());
    let resting = |scene: &scene::Scene| {
        let meshes = scene.meshes.iter().filter(|mesh| !moving.contains(&mesh.name)).cloned().collect();
        let (motions, places, clocks) = (Vec::new(), Vec::new(), Vec::new());
        scene::Scene { meshes, motions, places, clocks, ..scene.clone() }
    };
    assert!(resting(&back) == resting(&town), "a part is lost: {:?}", back.notices);

    // A circuit would allow longer edges far from it; without one, all are cut.
    let anywhere = scene::Scene { circuit: Vec::new(), ..town };
    let refined = refine(&anywhere, 4.0).unwrap();
    assert!(Report::new(&refined).unwrap().longest_edge <= 4.0);
}
