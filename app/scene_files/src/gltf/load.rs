//! A scene from a glTF file, step by step.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use regular_file::Budget;
use scene::collision::ground_below;
use scene::motion::Motion;
use scene::{Alpha, MAX_TRIANGLES, Mesh, Panorama, Scene, Start};

use super::container::Document;
use super::error::GltfError;
use super::extras::SceneExtras;
use super::nodes::{Bounds, NodeMotion, NodePlacement};
use super::notices::{EXTENSIONS, Notices};
use super::primitive::Primitive;
use super::progress::{LoadStage, Progress};
use super::spectrum::SpectrumReader;
use super::{light, material, nodes, picture, primitive};
use crate::panorama;

/// Largest number of meshes in a scene, one for each primitive and instance.
const MAX_MESHES: usize = 1_000_000;

/// Reads a scene.
///
/// Triangles (lists, strips, fans) are drawn with base colour, emission, vertex colours, opacity and
/// `KHR_materials_unlit`, `KHR_materials_emissive_strength`, `KHR_texture_transform`, `KHR_mesh_quantization`; if
/// there are several scenes, the default one is loaded. The first directional light of `KHR_lights_punctual` is the
/// sun, others are lamps; materials and lights may have spectra in `extras.spectrum`. docs/SCENES.md describes all of
/// it. Further requests of a file are named in [`Scene::notices`]. Opaque meshes are solid unless
/// `extras.rapidity.solid` says otherwise. An observer starts where `extras.rapidity.start` of the scene says, else
/// on the ground below the first camera, else at the origin or in front of the scene.
///
/// `progress` is called from several threads at once.
///
/// # Errors
/// [`GltfError`]. A missing picture is a notice, a damaged picture an error.
pub fn load(path: &Path, progress: impl Fn(Progress) + Sync) -> Result<Scene, GltfError> {
    let document = Document::open(path)?;
    let mut notices = Notices::default();
    note_undrawn_features(&document, &mut notices);

    // Find the placements, and refuse a scene that is too large before any of it is unpacked.
    let scene_index = document.scene_index(&mut notices)?;
    let extras = document.scene_extras(scene_index)?;
    let placements = nodes::placements(&document, scene_index, &mut notices)?;
    let instances = instances(&document, &placements, &mut notices)?;

    // Read surfaces and light.
    let mut spectra = SpectrumReader::new(&document);
    let (mut materials, channels) = material::materials(&document, &mut spectra, &mut notices)?;
    let light::Lights { lighting, illuminant, lamps } =
        light::lighting(&document, scene_index, &extras, &placements, &mut spectra, &mut notices)?;
    spectra.finish()?;

    // Unpack every primitive once.
    let mut primitives = BTreeMap::new();
    for instance in &instances {
        let key = (instance.mesh, instance.primitive);
        if let Entry::Vacant(vacant) = primitives.entry(key) {
            vacant.insert(Primitive::read(&document, key, &channels, &mut notices)?);
        }
    }
    if primitives.values().all(|primitive| primitive.indices.is_empty()) {
        let found = if document.json.meshes.is_empty() { "nodes" } else { "points and lines" };
        return Err(GltfError::Nothing { path: document.path, found });
    }
    let panorama = around(&document, scene_index, &extras, &mut notices)?;
    let textures = picture::textures(&document, &mut materials, &mut notices, &progress)?;

    // Choose the origin, then place the primitives relative to it.
    let mut bounds = Bounds::default();
    for instance in &instances {
        bounds.add(&primitives[&(instance.mesh, instance.primitive)], instance.placement.transform);
    }
    let origin = extras.origin.map_or_else(|| bounds.origin(), DVec3::from_array);
    let (done, total) = (AtomicUsize::new(0), instances.len());
    let placed: Vec<(Mesh, usize)> = instances
        .par_iter()
        .map(|instance| {
            let primitive = &primitives[&(instance.mesh, instance.primitive)];
            let placed = match &instance.placement.motion {
                Some(NodeMotion::Animated { animated, body_from_node }) => {
                    let (mut mesh, not_finite) = primitive.place(instance.name.clone(), *body_from_node, DVec3::ZERO);
                    if animated.at(0.0).world_from_body.matrix3.determinant() < 0.0 {
                        mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
                    }
                    (mesh, not_finite)
                }
                _ => primitive.place(instance.name.clone(), instance.placement.transform, origin),
            };
            progress(Progress { stage: LoadStage::Meshes, done: done.fetch_add(1, Ordering::Relaxed) + 1, total });
            placed
        })
        .collect();
    let (mut meshes, mut motions) = (Vec::with_capacity(placed.len()), Vec::new());
    for ((mut mesh, not_finite), instance) in placed.into_iter().zip(&instances) {
        if not_finite > 0 {
            notices.add(format!("mesh \"{}\" has vertices that are nowhere (not finite): {not_finite}", mesh.name));
        }
        let opaque = materials[mesh.material].alpha == Alpha::Opaque;
        mesh.motion = instance.placement.motion.as_ref().map(|moves| {
            let motion = match moves {
                NodeMotion::Uniform(uniform) => Motion::Uniform(*uniform),
                NodeMotion::Animated { animated, .. } => Motion::Animated(Arc::clone(animated)),
            };
            motions.iter().position(|known| *known == motion).unwrap_or_else(|| {
                motions.push(motion);
                motions.len() - 1
            })
        });
        // Vehicles do not ride on moving or animated meshes.
        mesh.solid = mesh.motion.is_none() && instance.placement.solid.unwrap_or(opaque);
        meshes.push(mesh);
    }
    meshes.retain(|mesh| !mesh.indices.is_empty());

    let mut scene = Scene {
        name: document.scene_name(scene_index),
        origin,
        textures,
        materials,
        meshes,
        motions,
        light: lighting,
        illuminant,
        lamps,
        white: extras.white,
        panorama,
        start: extras.start.unwrap_or_else(|| bounds.start()),
        circuit: extras.circuit.into_iter().map(DVec3::from_array).collect(),
        notices: notices.into_sentences(),
    };
    if extras.start.is_none()
        && let Some(camera) = placements.iter().find(|placement| placement.camera)
    {
        scene.start = start_below(camera.transform, &scene);
    }
    Ok(scene)
}

/// Panorama that the scene names: a file beside it, or a picture in a buffer view.
fn around(
    document: &Document,
    scene: Option<usize>,
    extras: &SceneExtras,
    notices: &mut Notices,
) -> Result<Option<Panorama>, GltfError> {
    let (Some(scene), Some(value)) = (scene, &extras.panorama) else {
        return Ok(None);
    };
    let place = format!("scenes[{scene}].extras.rapidity.panorama");
    let view = value.get("bufferView").and_then(|view| usize::try_from(view.as_u64()?).ok());
    let (bytes, path) = match (value.as_str(), view) {
        (Some(data), _) if data.starts_with("data:") => (document.fetch(data, &place)?, document.path.clone()),
        (Some(name), _) => (document.beside(name, &place)?, document.path.with_file_name(name)),
        (None, Some(view)) => (document.view(view, &place)?.0.to_vec(), document.path.clone()),
        (None, None) => return Err(document.damaged(&place, format!("expected the name of a picture, not {value}"))),
    };
    let read = panorama::decode(&bytes, &path, &Budget::default())?;
    read.notices.into_iter().for_each(|notice| notices.add(notice));
    Ok(Some(read.panorama))
}

/// Primitive of a mesh, placed at a node.
struct Instance<'a> {
    placement: &'a NodePlacement,
    mesh: usize,
    primitive: usize,
    name: String,
}

/// Instances of all primitives that are drawn, checked against the limits.
fn instances<'a>(
    document: &Document,
    placements: &'a [NodePlacement],
    notices: &mut Notices,
) -> Result<Vec<Instance<'a>>, GltfError> {
    let mut instances = Vec::new();
    let mut corners = 0_u64;
    for placement in placements {
        let Some(mesh_index) = placement.mesh else {
            continue;
        };
        let place = format!("nodes[{}].mesh", placement.node);
        let mesh = document.item(&document.json.meshes, mesh_index, &place)?;
        for (index, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("meshes[{mesh_index}].primitives[{index}]");
            let Some(predicted) = primitive::corners(document, primitive, &place, notices)? else {
                continue;
            };
            corners += predicted;
            if corners > 3 * MAX_TRIANGLES as u64 || instances.len() == MAX_MESHES {
                let fault = format!("more than {MAX_TRIANGLES} triangles or {MAX_MESHES} meshes with all instances");
                return Err(document.too_large(&place, fault));
            }
            let name = instance_name(document, placement.node, mesh_index, index);
            instances.push(Instance { placement, mesh: mesh_index, primitive: index, name });
        }
    }
    Ok(instances)
}

/// Name of an instance: the names of node and mesh (once if they are the same) and, if there are several, the
/// primitive's number.
fn instance_name(document: &Document, node: usize, mesh: usize, primitive: usize) -> String {
    let node_name = document.json.nodes[node].name.clone();
    let mesh_name = document.json.meshes[mesh].name.clone();
    let name = match (node_name, mesh_name) {
        (Some(node), Some(mesh)) if node != mesh => format!("{node} / {mesh}"),
        (Some(name), _) => name,
        (None, Some(mesh)) => format!("node {node} / {mesh}"),
        (None, None) => format!("node {node}"),
    };
    if document.json.meshes[mesh].primitives.len() > 1 { format!("{name} #{primitive}") } else { name }
}

/// Start on the ground below a camera, or at the camera if there is no ground, with the camera's direction of view.
fn start_below(camera: DAffine3, scene: &Scene) -> Start {
    let look = (camera.matrix3 * DVec3::NEG_Z).normalize_or(DVec3::NEG_Z);
    let ground = ground_below(scene, camera.translation).expect("loaded scenes keep the promises of their types");
    let height = ground.map_or(camera.translation.y, |ground| ground.height);
    Start { position: camera.translation.with_y(height), look }
}

/// Adds a notice for every feature that the file uses and that is not drawn.
fn note_undrawn_features(document: &Document, notices: &mut Notices) {
    let json = &document.json;
    for name in json.extensions_used.iter().filter(|name| !EXTENSIONS.contains(&name.as_str())) {
        notices.add(format!("the extension {name} is not drawn"));
    }
    let mut count = |number: usize, sentence: &str| (0..number).for_each(|_| notices.add(sentence.into()));
    count(json.skins.len(), "skins stay in their rest position");
    count(json.cameras.len(), "cameras only say where to start: lenses are not used");
    let morphs = json.meshes.iter().flat_map(|mesh| &mesh.primitives).filter(|primitive| primitive.targets.is_some());
    count(morphs.count(), "morph targets are not applied");
    let materials = || json.materials.iter();
    count(materials().filter(|material| material.normal_texture.is_some()).count(), "normal maps are not drawn");
    count(materials().filter(|material| material.occlusion_texture.is_some()).count(), "occlusion maps are not drawn");
    let metallic = materials().filter(|material| material.pbr_metallic_roughness.metallic_roughness_texture.is_some());
    count(metallic.count(), "metallic-roughness maps are not drawn");
}
