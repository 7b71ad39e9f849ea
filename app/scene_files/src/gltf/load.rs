//! A scene from a glTF file, step by step.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use rayon::prelude::*;
use regular_file::Budget;
use scene::motion::{Animated, Motion};
use scene::{Alpha, Mesh, Panorama, Scene};

use super::bounds::Bounds;
use super::document::Document;
use super::error::GltfError;
use super::extras::SceneExtras;
use super::first_view::{cameras, first_view};
use super::instances::{Instance, Instances};
use super::nodes::NodeMotion;
use super::notices::{Notices, Part};
use super::primitive::Primitive;
use super::progress::{LoadStage, Progress};
use super::spectrum::SpectrumReader;
use super::{animation, features, light, material, nodes, picture};

/// Rules for reading a file.
#[derive(Clone, Copy, Debug)]
pub struct ReadRules<'a> {
    /// Memory that the scene may take.
    pub budget: &'a Budget,
    /// True if the file may refer to files outside its folder.
    pub trust: bool,
}

/// Reads a scene.
///
/// Triangles (lists, strips, fans; plain, quantised, or compressed by meshopt or Draco) are drawn with base colour,
/// emission, vertex colours, opacity and the extensions that docs/SCENES.md lists; skins and morph targets in their
/// rest pose. If there are several scenes, the default one is loaded. The first directional light of
/// `KHR_lights_punctual` is the sun, others are lamps; materials and lights may have spectra in `extras.spectrum`.
/// Further requests of a file are named in [`Scene::notices`]. Opaque meshes are solid unless `extras.rapidity.solid`
/// says otherwise. An observer starts where `extras.rapidity.start` of the scene says, else at the first perspective
/// camera, else on the scene's floor, else outside with the whole scene in view.
///
/// `progress` is called from several threads at once.
///
/// # Errors
/// [`GltfError`] if there is nothing to draw, a mistake in this program's own extras, or too large a scene. A part
/// that is faulty is left out, and a notice names it.
pub fn load(path: &Path, rules: ReadRules<'_>, progress: impl Fn(Progress) + Sync) -> Result<Scene, GltfError> {
    let mut notices = Notices::default();
    let mut document = Document::open(path, rules.budget, rules.trust, &mut notices)?;
    animation::hold_shapes(&mut document);
    features::note_undrawn(&document, &mut notices);

    // Find the placements, and refuse a scene that is too large before any of it is unpacked.
    let scene_index = document.scene_index(&mut notices);
    let extras = document.scene_extras(scene_index)?;
    let placed = nodes::placements(&document, scene_index, &mut notices)?;
    let instances = Instances::of(&document, &placed, &mut notices)?;

    // Read surfaces and light.
    let mut spectra = SpectrumReader::new(&document);
    let (mut materials, channels) = material::materials(&document, &mut spectra, &mut notices);
    let light::Lights { lighting, illuminant, lamps } =
        light::lighting(&document, scene_index, &extras, &placed.placements, &mut spectra, &mut notices)?;
    spectra.finish()?;

    // Unpack every primitive once.
    let mut primitives = BTreeMap::new();
    for instance in &instances.list {
        let key = (instance.primitive, instance.deformation);
        if let Entry::Vacant(vacant) = primitives.entry(key) {
            let deformation = instance.deformation.map(|index| &instances.deformations[index]);
            match Primitive::read(&document, instance.primitive, deformation, &channels, &mut notices) {
                Ok(primitive) => {
                    vacant.insert(Arc::new(primitive));
                }
                Err(error) => {
                    let (mesh, primitive) = instance.primitive;
                    let place = format!("meshes[{mesh}].primitives[{primitive}]");
                    notices.left_out(Part::Mesh, &place, &error.part_fault()?);
                    vacant.insert(Arc::default());
                }
            }
        }
    }
    if primitives.values().all(|primitive| primitive.indices.is_empty()) {
        let found = instances.found_instead(&document, &placed);
        let fault = notices.first_fault().map(str::to_owned);
        return Err(GltfError::Nothing { path: document.path, found, fault });
    }
    let panorama = around(&document, scene_index, &extras, &mut notices)?;
    let textures = picture::textures(&document, &mut materials, &mut notices, &progress)?;

    let name = document.scene_name(scene_index);
    let cameras = cameras(&document, &placed.placements, &mut notices);
    // The file itself is no longer needed.
    drop(document);

    // Choose the origin, then place the primitives relative to it.
    let mut bounds = Bounds::default();
    for instance in &instances.list {
        bounds.add(&primitives[&(instance.primitive, instance.deformation)], instance.transform);
    }
    let origin = extras.origin.map_or_else(|| bounds.origin(), DVec3::from_array);
    let (done, total) = (AtomicUsize::new(0), instances.list.len());
    let primitive_of = |instance: &Instance<'_>| Arc::clone(&primitives[&(instance.primitive, instance.deformation)]);
    let wanted: Vec<_> = instances.list.iter().map(|instance| (instance, primitive_of(instance))).collect();
    drop(primitives);
    let placed_meshes: Vec<(Mesh, usize)> = wanted
        .into_par_iter()
        .map(|(instance, primitive)| {
            // The last instance takes the arrays as they are.
            let placed = place(instance, Arc::unwrap_or_clone(primitive), origin);
            progress(Progress { stage: LoadStage::Meshes, done: done.fetch_add(1, Ordering::Relaxed) + 1, total });
            placed
        })
        .collect();
    let (mut meshes, mut motions) = (Vec::with_capacity(placed_meshes.len()), MotionList::default());
    for ((mut mesh, not_finite), instance) in placed_meshes.into_iter().zip(&instances.list) {
        if not_finite > 0 {
            notices.add(format!("mesh \"{}\" has vertices that are nowhere (not finite): {not_finite}", mesh.name));
        }
        let opaque = materials[mesh.material].alpha == Alpha::Opaque;
        mesh.motion = motions.index(instance);
        // Vehicles do not ride on moving or animated meshes.
        mesh.solid = mesh.motion.is_none() && instance.placement.solid.unwrap_or(opaque);
        meshes.push(mesh);
    }
    meshes.retain(|mesh| !mesh.indices.is_empty());

    if !meshes.iter().any(has_extent) {
        let fault = format!(
            "none of its {} triangles has finite corners at different places",
            meshes.iter().map(|mesh| mesh.indices.len() / 3).sum::<usize>()
        );
        return Err(GltfError::Nothing { path: path.into(), found: "triangles", fault: Some(fault) });
    }
    let mut scene = Scene {
        name,
        origin,
        textures,
        materials,
        meshes,
        motions: motions.list,
        light: lighting,
        illuminant,
        lamps,
        white: extras.white,
        panorama,
        cameras,
        circuit: extras.circuit.iter().copied().map(DVec3::from_array).collect(),
        ..Scene::default()
    };
    (scene.start, scene.speed_of_light_m_s) = first_view(&scene, &extras, bounds.corners());
    scene.notices = notices.into_sentences();
    Ok(scene)
}

/// Motions of a scene, each once.
#[derive(Default)]
struct MotionList {
    list: Vec<Motion>,
    numbers: HashMap<MotionKey, usize>,
}

/// Identity of a motion: the bits of a uniform one, or the address of the animation that its nodes share.
#[derive(PartialEq, Eq, Hash)]
enum MotionKey {
    Uniform([u64; 7]),
    Animated(*const Animated),
}

impl MotionList {
    /// Index of an instance's motion, which is added if it is new. A skinned mesh stands still in its pose.
    fn index(&mut self, instance: &Instance<'_>) -> Option<usize> {
        let (key, motion) = match instance.placement.motion.as_ref()? {
            NodeMotion::Animated { .. } if instance.skinned => return None,
            NodeMotion::Uniform(uniform) => {
                let [u, p] = [uniform.celerity.vector(), uniform.anchor.position].map(|vector| vector.to_array());
                let numbers = [u[0], u[1], u[2], p[0], p[1], p[2], uniform.anchor.ct];
                (MotionKey::Uniform(numbers.map(f64::to_bits)), Motion::Uniform(*uniform))
            }
            NodeMotion::Animated { animated, .. } => {
                (MotionKey::Animated(Arc::as_ptr(animated)), Motion::Animated(Arc::clone(animated)))
            }
        };
        Some(*self.numbers.entry(key).or_insert_with(|| {
            self.list.push(motion);
            self.list.len() - 1
        }))
    }
}

/// True if a triangle of a mesh can be seen at all: its corners are finite and not one place.
fn has_extent(mesh: &Mesh) -> bool {
    mesh.indices.as_chunks::<3>().0.iter().any(|corners| {
        let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize].as_dvec3());
        a.is_finite() && b.is_finite() && c.is_finite() && (a != b || b != c)
    })
}

/// Mesh of an instance, relative to `origin`, and the number of its vertices that are not finite.
fn place(instance: &Instance<'_>, primitive: Primitive, origin: DVec3) -> (Mesh, usize) {
    match &instance.placement.motion {
        Some(NodeMotion::Animated { animated, body_from_node }) if !instance.skinned => {
            let (mut mesh, not_finite) = primitive.place(instance.name.clone(), *body_from_node, DVec3::ZERO);
            if animated.at(0.0).world_from_body.matrix3.determinant() < 0.0 {
                mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
            }
            (mesh, not_finite)
        }
        _ => primitive.place(instance.name.clone(), instance.transform, origin),
    }
}

/// Panorama that the scene names: a file beside it, or a picture in a buffer view.
fn around(
    document: &Document<'_>,
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
        (Some(name), _) => (document.fetch(name, &place)?, document.path.with_file_name(name)),
        (None, Some(view)) => (document.view(view, &place)?.0.to_vec(), document.path.clone()),
        (None, None) => return Err(document.damaged(&place, format!("expected the name of a picture, not {value}"))),
    };
    let read = panoramas::decode(&bytes, &path, document.budget)?;
    read.notices.into_iter().for_each(|notice| notices.add(notice));
    Ok(Some(read.panorama))
}
