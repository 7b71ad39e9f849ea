//! Scenes from glTF 2.0 files, `.gltf` and `.glb`.
//!
//! A file is read in several steps, each in a module of its own: `container` (the file, its chunks and buffers),
//! `accessor` (numbers in buffers), `animation` (keys), `primitive` (triangles), `nodes` (placements), `picture`,
//! `material`, `light` and `spectrum`. The `gltf` crate only reads the JSON. Every index, offset and length in it is
//! looked up with a check here: a file may come from any source, and none may crash the program or make it ask for
//! more memory than [`MAX_TRIANGLES`] and the limits in `picture` allow.
//!
//! Node transforms are composed in f64, from the digits in the file. Positions become f32 only after
//! [`Scene::origin`] is subtracted: a street 1000 km from the file's origin keeps its millimetres.

mod accessor;
mod animation;
mod container;
pub(super) mod extras;
mod light;
mod material;
mod nodes;
mod picture;
mod primitive;
pub(super) mod spectrum;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DAffine3, DVec3};
use rayon::prelude::*;

use self::container::Document;
use self::extras::SceneExtras;
use self::nodes::{Bounds, Moves, Placement};
use self::primitive::Primitive;
use self::spectrum::Spectra;
pub use self::spectrum::SpectrumFault;
use super::collision::Collision;
use super::motion::Motion;
use super::panorama::{self, PanoramaError};
use super::{MAX_TRIANGLES, Mesh, Panorama, Scene, Start};
use crate::vehicle::Surroundings;

/// Largest number of meshes in a scene, one for each primitive and instance.
const MAX_MESHES: usize = 1_000_000;

/// Distance from the file's origin, metres, up to which f32 keeps a quarter of a millimetre and positions stay as the
/// file has them.
const NEAR: f64 = 4096.0;

/// Reason why a file gives no scene. Every message says what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum GltfError {
    /// A file that the operating system cannot read.
    #[error("cannot read {path}: {error}; check the name and the permissions")]
    Read {
        /// Path of the scene or of a file it refers to.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
    /// A directory or a device.
    #[error("{path} is not a file; name a .gltf or .glb file")]
    NotAFile {
        /// Path of the scene or of a file it refers to.
        path: PathBuf,
    },
    /// An empty file.
    #[error("{path} is empty; export or download it again")]
    Empty {
        /// Path of the scene.
        path: PathBuf,
    },
    /// A file of another format, or of another version of glTF.
    #[error("{path} is not glTF 2.0: {fault}; export the scene as .glb or .gltf")]
    NotGltf {
        /// Path of the scene.
        path: PathBuf,
        /// Description of what is wrong.
        fault: String,
    },
    /// A required extension that this program lacks.
    #[error("{path} requires the extension {name}, which this program does not know; export the scene without it")]
    Extension {
        /// Path of the scene.
        path: PathBuf,
        /// Name of the extension, as in `extensionsRequired`.
        name: String,
    },
    /// A file that contradicts itself or the format.
    #[error("{path} is damaged at {place}: {fault}; export the scene again")]
    Damaged {
        /// Path of the scene.
        path: PathBuf,
        /// Place of the fault in its JSON.
        place: String,
        /// Description of what is wrong.
        fault: String,
    },
    /// A scene beyond the limits of this program.
    #[error("{path} is too large at {place}: {fault}; export a smaller part or a coarser version of the scene")]
    TooLarge {
        /// Path of the scene.
        path: PathBuf,
        /// Place of the excess in its JSON.
        place: String,
        /// Description of what is too large, and the limit.
        fault: String,
    },
    /// A scene without triangles.
    #[error("{path} has nothing to draw: no triangles in its scene; export meshes, not only {found}")]
    Nothing {
        /// Path of the scene.
        path: PathBuf,
        /// Objects found instead of triangles.
        found: &'static str,
    },
    /// Spectra that are not valid, with a sentence for each.
    #[error("{}", sentences(path, faults))]
    Spectra {
        /// Path of the scene.
        path: PathBuf,
        /// Faults of all invalid spectra, in the file's order.
        faults: Vec<SpectrumFault>,
    },
    /// A panorama that cannot be used.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
}

fn sentences(path: &Path, faults: &[SpectrumFault]) -> String {
    let sentence = |fault| format!("{} has a spectrum that cannot be used: {fault}", path.display());
    faults.iter().map(sentence).collect::<Vec<_>>().join("\n")
}

/// Stage of `load`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Decoding of pictures.
    Pictures,
    /// Placing of meshes.
    Meshes,
}

/// Progress of `load`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Current stage.
    pub stage: Stage,
    /// Number of pictures or meshes that are ready.
    pub done: usize,
    /// Total number of pictures or meshes.
    pub total: usize,
}

/// Loads a scene from a file.
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
    note_what_is_not_drawn(&document, &mut notices);

    // Find the placements, and refuse a scene that is too large before any of it is unpacked.
    let scene_index = document.scene_index(&mut notices)?;
    let extras = document.scene_extras(scene_index)?;
    let placements = nodes::placements(&document, scene_index, &mut notices)?;
    let instances = instances(&document, &placements, &mut notices)?;

    // Read surfaces and light.
    let mut spectra = Spectra::new(&document);
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
                Some(Moves::Animated { animated, body_from_node }) => {
                    let (mut mesh, not_finite) = primitive.place(instance.name.clone(), *body_from_node, DVec3::ZERO);
                    if animated.at(0.0).world_from_body.matrix3.determinant() < 0.0 {
                        mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
                    }
                    (mesh, not_finite)
                }
                _ => primitive.place(instance.name.clone(), instance.placement.transform, origin),
            };
            progress(Progress { stage: Stage::Meshes, done: done.fetch_add(1, Ordering::Relaxed) + 1, total });
            placed
        })
        .collect();
    let (mut meshes, mut motions) = (Vec::with_capacity(placed.len()), Vec::new());
    for ((mut mesh, not_finite), instance) in placed.into_iter().zip(&instances) {
        if not_finite > 0 {
            notices.add(format!("mesh \"{}\" has vertices that are nowhere (not finite): {not_finite}", mesh.name));
        }
        let opaque = materials[mesh.material].alpha == super::Alpha::Opaque;
        mesh.motion = instance.placement.motion.as_ref().map(|moves| {
            let motion = match moves {
                Moves::Uniform(uniform) => Motion::Uniform(*uniform),
                Moves::Animated { animated, .. } => Motion::Animated(Arc::clone(animated)),
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
    Ok(Some(panorama::decode(&bytes, &path, |notice| notices.add(notice))?))
}

/// Primitive of a mesh, placed at a node.
struct Instance<'a> {
    placement: &'a Placement,
    mesh: usize,
    primitive: usize,
    name: String,
}

/// Instances of all primitives that are drawn, checked against the limits.
fn instances<'a>(
    document: &Document,
    placements: &'a [Placement],
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
    let collision = Collision::new(scene).expect("loaded scenes keep the promises of their types");
    let ground = collision.height_below(camera.translation);
    let height = ground.map_or(camera.translation.y, |ground| ground.height);
    Start { position: camera.translation.with_y(height), look }
}

/// Extensions that are drawn.
const EXTENSIONS: [&str; 8] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

fn note_what_is_not_drawn(document: &Document, notices: &mut Notices) {
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

/// Sentences for [`Scene::notices`], each once, with its number of occurrences, in order of first occurrence.
#[derive(Default)]
struct Notices {
    sentences: Vec<(String, usize)>,
    place_of: BTreeMap<String, usize>,
}

impl Notices {
    fn add(&mut self, sentence: String) {
        let place = *self.place_of.entry(sentence.clone()).or_insert(self.sentences.len());
        match self.sentences.get_mut(place) {
            Some((_, count)) => *count += 1,
            None => self.sentences.push((sentence, 1)),
        }
    }

    fn into_sentences(self) -> Vec<String> {
        let sentence = |(sentence, count)| {
            if count > 1 { format!("{sentence} ({count})") } else { sentence }
        };
        self.sentences.into_iter().map(sentence).collect()
    }
}
