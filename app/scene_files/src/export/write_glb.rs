//! Scene to `.glb`, step by step.

use std::path::Path;

use ::gltf::json::extensions::root::KhrLightsPunctual;
use ::gltf::json::{self, Index};
use glam::{DMat4, DVec3};

use super::error::ExportError;
use super::expressible::check_values;
use super::lists::GlbLists;
use super::{glb, lamps, materials};
use crate::gltf::extras::{LightExtras, NodeExtras, SceneExtras, to_extras};
use crate::gltf::file_json::NodeJson;
use crate::gltf::spectrum;
use scene::motion::{Motion, Uniform};
use scene::{Mesh, Scene};

/// Writes a scene as `.glb`.
///
/// The complete file appears at once, or not at all. Meshes without triangles, [`Scene::notices`] and the keys of
/// animations are left out.
///
/// # Errors
/// [`ExportError`], for example for non-finite values or base colours outside 0…1.
pub fn write_glb(scene: &Scene, path: &Path) -> Result<(), ExportError> {
    scene.validate()?;
    check_values(scene)?;
    let drawn: Vec<&Mesh> = scene.meshes.iter().filter(|mesh| !mesh.indices.is_empty()).collect();
    if drawn.is_empty() {
        return Err(ExportError::Nothing { scene: scene.name.clone() });
    }

    // Add pictures, surfaces, meshes and lamps.
    let mut lists = GlbLists::default();
    lists.textures(&scene.textures)?;
    lists.json.materials = scene.materials.iter().map(materials::material).collect();
    let mut roots = Vec::new();
    for mesh in drawn {
        let index = lists.mesh(mesh);
        roots.push(add_mesh_nodes(&mut lists.json.nodes, scene, mesh, index));
    }
    for (number, lamp) in scene.lamps.iter().enumerate() {
        roots.push(add_node(&mut lists.json.nodes, lamps::lamp_node(number, lamp)));
    }
    if !scene.lamps.is_empty() {
        let lights = scene.lamps.iter().map(lamps::light).collect();
        lists.json.extensions = Some(json::extensions::Root {
            khr_lights_punctual: Some(KhrLightsPunctual { lights }),
            ..Default::default()
        });
    }

    // Add the scene itself, with its data beyond glTF.
    let extras = SceneExtras {
        origin: Some(scene.origin.to_array()),
        light: LightExtras::of(scene.light, scene.illuminant.as_ref().map(spectrum::to_json)),
        white: scene.white,
        panorama: scene.panorama.as_ref().map(|panorama| lists.panorama(panorama, &scene.name)).transpose()?,
        start: Some(scene.start),
        speed_of_light: scene.speed_of_light_m_s,
        circuit: scene.circuit.iter().map(|point| point.to_array()).collect(),
    };
    let (mut root, blob) = lists.finish();
    root.asset.generator = Some(concat!("Rapidity ", env!("CARGO_PKG_VERSION")).into());
    root.scene = Some(Index::new(0));
    root.scenes = vec![json::Scene {
        name: Some(scene.name.clone()),
        nodes: roots,
        extensions: None,
        extras: extras.into_extras(),
    }];
    root.extensions_used = extensions_used(&root.materials, !scene.lamps.is_empty());
    let text = serde_json::to_vec(&root).expect("the types of a file's JSON have no other form");
    glb::write(path, text, blob)
}

/// Adds the node of a mesh; for a moving mesh also its parent, a node at its motion's anchor. Index of the upper one.
fn add_mesh_nodes(
    nodes: &mut Vec<NodeJson>,
    scene: &Scene,
    mesh: &Mesh,
    index: Index<json::Mesh>,
) -> Index<json::Node> {
    let node = |translation: DVec3| NodeJson {
        name: Some(mesh.name.clone()),
        mesh: Some(index),
        translation: Some(translation.to_array()),
        extras: NodeExtras { solid: Some(mesh.solid) }.to_extras(),
        ..NodeJson::default()
    };
    let (above, below) = match mesh.motion.map(|motion| &scene.motions[motion]) {
        None => return add_node(nodes, node(scene.origin)),
        Some(Motion::Uniform(Uniform { celerity, anchor })) => {
            let motion = serde_json::json!({ "celerity": celerity.vector().to_array(), "at": anchor.ct });
            let translation = Some(anchor.position.to_array());
            let above = NodeJson { translation, extras: to_extras(&motion), ..NodeJson::default() };
            (above, node(scene.origin - anchor.position))
        }
        // Keys are left out: the mesh is placed by its pose at time 0.
        Some(Motion::Animated(animated)) => {
            let pose = DMat4::from(animated.at(0.0).world_from_body).to_cols_array();
            (NodeJson { matrix: Some(pose), ..NodeJson::default() }, node(DVec3::ZERO))
        }
    };
    let parent = add_node(nodes, above);
    let child = add_node(nodes, below);
    nodes[parent.value()].children = Some(vec![child]);
    parent
}

fn add_node(nodes: &mut Vec<NodeJson>, node: NodeJson) -> Index<json::Node> {
    Index::new(Index::push(nodes, node).value() as u32)
}

/// Names of the extensions that a file uses.
fn extensions_used(materials: &[json::Material], lamps: bool) -> Vec<String> {
    let extensions = materials.iter().filter_map(|material| material.extensions.as_ref());
    let mut names: Vec<&str> = extensions.flat_map(materials::extensions_of).collect();
    names.extend(lamps.then_some("KHR_lights_punctual"));
    names.sort_unstable();
    names.dedup();
    names.into_iter().map(String::from).collect()
}
