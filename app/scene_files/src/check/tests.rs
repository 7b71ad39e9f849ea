//! Laws under test: a report counts the contents, and warns of faults only. A wrong one would miss a hole below
//! the start, or warn of a sound scene.

use glam::{Vec2, Vec3};

use super::*;
use regular_file::Budget;
use scene::{Material, Mesh, Texture};

/// Scene with a square of ground, 10 m wide, in two triangles.
fn ground() -> Scene {
    let positions = [(-5, -5), (-5, 5), (5, 5), (5, -5)].map(|(x, z)| Vec3::new(x as f32, 0.0, z as f32));
    let mesh = Mesh {
        name: "ground".into(),
        positions: positions.to_vec(),
        normals: vec![Vec3::Y; 4],
        uvs: vec![Vec2::ZERO; 4],
        colours: vec![[1.0; 4]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        solid: true,
        ..Mesh::default()
    };
    let texture = Texture {
        name: "grass".into(),
        width: 4,
        height: 2,
        rgba: vec![0; 32].into(),
        wrap: Default::default(),
        nearest: false,
    };
    Scene {
        name: "meadow".into(),
        origin: DVec3::new(0.0, 100.0, 0.0),
        textures: vec![texture],
        materials: vec![Material::default()],
        meshes: vec![mesh],
        start: scene::Start { position: DVec3::new(0.0, 100.0, 0.0), ..scene::Start::default() },
        circuit: vec![DVec3::new(1.0, 100.0, 1.0)],
        ..Scene::default()
    }
}

fn warning(change: impl Fn(&mut Scene)) -> String {
    let mut scene = ground();
    change(&mut scene);
    let [warning] = Report::new(&scene).unwrap().warnings.try_into().expect("one warning");
    warning
}

#[test]
fn a_sound_scene_is_counted_and_not_warned_of() {
    let report = Report::new(&ground()).unwrap();
    assert_eq!((report.meshes, report.triangles, report.vertices), (1, 2, 4));
    assert_eq!((report.materials, report.textures, report.texture_bytes), (1, 1, 32));
    assert_eq!(report.bounds, Some([DVec3::new(-5.0, 100.0, -5.0), DVec3::new(5.0, 100.0, 5.0)]));
    assert_eq!(report.longest_edge, 200_f64.sqrt());
    assert!(report.warnings.is_empty(), "{:?}", report.warnings);
}

#[test]
fn what_is_wrong_is_warned_of() {
    assert!(warning(|scene| scene.meshes[0].indices.extend([0, 0, 1])).starts_with("triangles without area: 1;"));
    assert!(warning(|scene| scene.meshes[0].indices.swap(0, 1)).contains("face away from their normals: 1;"));
    assert!(warning(|scene| scene.start.position.x = 6.0).contains("no ground below the start"));
    assert!(warning(|scene| scene.circuit.push(DVec3::ZERO)).contains("without ground below: 1 of 2;"));
    assert!(warning(|scene| scene.meshes[0].solid = false).contains("no mesh is solid"));
    let far = |scene: &mut Scene| {
        scene.meshes[0].positions.push(Vec3::X * 1e6);
        scene.meshes[0].normals.push(Vec3::Y);
        scene.meshes[0].uvs.push(Vec2::ZERO);
        scene.meshes[0].colours.push([1.0; 4]);
    };
    assert!(warning(far).contains("lengths are metres"));
    let nowhere = |scene: &mut Scene| {
        far(scene);
        scene.meshes[0].positions[4] = Vec3::NAN;
        scene.meshes[0].indices.extend([0, 1, 4]);
    };
    assert!(warning(nowhere).contains("nowhere (not finite): 1;"));
}

#[test]
fn an_empty_scene_says_so() {
    let report = Report::new(&Scene::default()).unwrap();
    assert!(report.warnings[0].contains("nothing to draw"));
    assert_eq!(report.bounds, None);
}

#[test]
fn a_file_is_reported_as_it_is_drawn() {
    let folder = tempfile::TempDir::new().unwrap();
    let path = folder.path().join("meadow.glb");
    crate::export::write_glb(&ground(), &path).unwrap();
    let mut expected = Report::new(&ground()).unwrap();
    // The texture is drawn by no material, so it is not loaded.
    (expected.textures, expected.texture_bytes) = (0, 0);
    let report = check(&path, ReadRules { budget: &Budget::default(), trust: false }).unwrap();
    assert_eq!(report, expected);
    let text = report.to_string();
    assert!(text.contains("2, 4 vertices, 1 meshes") && text.contains("10.000 × 0.000 × 10.000 m"), "{text}");
}

#[test]
fn a_file_that_is_no_scene_is_an_error() {
    let rules = ReadRules { budget: &Budget::default(), trust: false };
    assert!(matches!(check(Path::new("/nowhere.glb"), rules), Err(CheckError::Load(SceneReadError::Gltf(_)))));
}
