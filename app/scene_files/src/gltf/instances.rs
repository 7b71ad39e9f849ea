//! Instances: every primitive of every placed mesh, counted before any data are read.

use std::collections::BTreeMap;

use glam::DAffine3;
use scene::MAX_TRIANGLES;

use super::deform::Deformation;
use super::document::Document;
use super::error::GltfError;
use super::nodes::{NodeMotion, NodePlacement, Placed};
use super::notices::{Notices, Part};
use super::primitive;

/// Largest number of meshes in a scene, one for each primitive and instance.
const MAX_MESHES: usize = 1_000_000;

/// Memory of a vertex in all its copies, bytes: in the scene, and for drawing.
const VERTEX_BYTES: u64 = 120;

/// Memory of a triangle's corner in all its copies, bytes.
const CORNER_BYTES: u64 = 8;

/// Primitive of a mesh, placed at a node.
pub(super) struct Instance<'a> {
    pub(super) placement: &'a NodePlacement,
    /// Indices of the mesh and of the primitive in the file.
    pub(super) primitive: (usize, usize),
    /// Index into [`Instances::deformations`].
    pub(super) deformation: Option<usize>,
    /// True if joints place the mesh, not its node.
    pub(super) skinned: bool,
    /// Transform from the mesh's frame to the file's at time 0.
    pub(super) transform: DAffine3,
    pub(super) name: String,
}

/// Instances of all primitives that are drawn.
pub(super) struct Instances<'a> {
    pub(super) list: Vec<Instance<'a>>,
    /// Deformations, each once.
    pub(super) deformations: Vec<Deformation>,
}

impl<'a> Instances<'a> {
    /// Finds all instances, and refuses more of them than memory may be taken for.
    pub(super) fn of(document: &Document<'_>, placed: &'a Placed, notices: &mut Notices) -> Result<Self, GltfError> {
        let mut found = Self { list: Vec::new(), deformations: Vec::new() };
        let mut deformation_of_node = BTreeMap::new();
        let mut corners = 0_u64;
        for placement in &placed.placements {
            let Some(mesh_index) = placement.mesh else {
                continue;
            };
            let node_place = format!("nodes[{}]", placement.node);
            let Some(mesh) = document.json.meshes.get(mesh_index) else {
                let fault = format!("there is no number {mesh_index} among {}", document.json.meshes.len());
                notices.left_out(Part::Mesh, &format!("{node_place}.mesh"), &fault);
                continue;
            };
            let deformation = match deformation_of_node.get(&placement.node) {
                Some(known) => *known,
                None => {
                    let node = &document.json.nodes[placement.node];
                    let of_node = Deformation::of(
                        document,
                        (placement.node, node),
                        mesh,
                        &placed.transforms,
                        &node_place,
                        notices,
                    )?;
                    let index = of_node.map(|of_node| found.number(of_node));
                    deformation_of_node.insert(placement.node, index);
                    index
                }
            };
            let skin = deformation.and_then(|index| found.deformations[index].skin.as_ref());
            let transform = match (skin, &placement.motion) {
                (Some(skin), _) => DAffine3::from_translation(skin.anchor),
                (None, Some(NodeMotion::Animated { animated, body_from_node })) => {
                    animated.at(0.0).world_from_body * *body_from_node
                }
                (None, _) => placement.transform,
            };
            let skinned = skin.is_some();
            for (index, primitive) in mesh.primitives.iter().enumerate() {
                let place = format!("meshes[{mesh_index}].primitives[{index}]");
                let extent = match primitive::extent(document, primitive, &place, notices) {
                    Ok(Some(extent)) => extent,
                    Ok(None) => continue,
                    Err(error) => {
                        notices.left_out(Part::Mesh, &place, &error.part_fault()?);
                        continue;
                    }
                };
                corners += extent.vertices.max(extent.corners);
                if corners > 3 * MAX_TRIANGLES as u64 || found.list.len() == MAX_MESHES {
                    let fault =
                        format!("more than {MAX_TRIANGLES} triangles or {MAX_MESHES} meshes with all instances");
                    return Err(document.too_large(&place, fault));
                }
                document.take(VERTEX_BYTES * extent.vertices + CORNER_BYTES * extent.corners, &place)?;
                let name = instance_name(document, placement.node, mesh_index, index);
                found.list.push(Instance {
                    placement,
                    primitive: (mesh_index, index),
                    deformation,
                    skinned,
                    transform,
                    name,
                });
            }
        }
        Ok(found)
    }

    /// Name of what the scene has, if no triangles.
    pub(super) fn found_instead(&self, document: &Document<'_>, placed: &Placed) -> &'static str {
        let bears_mesh = |node: &usize| document.json.nodes[*node].mesh.is_some();
        if document.json.meshes.is_empty() {
            "nodes"
        } else if placed.placements.iter().any(|placement| placement.mesh.is_some()) {
            "points and lines"
        } else if placed.transforms.keys().any(bears_mesh) {
            "hidden nodes (KHR_node_visibility)"
        } else {
            "nodes without meshes"
        }
    }

    /// Index of a deformation, which is added if it is new.
    fn number(&mut self, deformation: Deformation) -> usize {
        // Only neighbours are compared, so that the work stays in proportion to the file.
        if self.deformations.last() != Some(&deformation) {
            self.deformations.push(deformation);
        }
        self.deformations.len() - 1
    }
}

/// Name of an instance: the names of node and mesh (once if they are the same) and, if there are several, the
/// primitive's number.
fn instance_name(document: &Document<'_>, node: usize, mesh: usize, primitive: usize) -> String {
    let node_name = document.json.nodes[node].name.as_deref();
    let mesh_name = document.json.meshes[mesh].name.as_deref();
    let name = match (node_name, mesh_name) {
        (Some(node), Some(mesh)) if node != mesh => format!("{node} / {mesh}"),
        (Some(name), _) => name.to_owned(),
        (None, Some(mesh)) => format!("node {node} / {mesh}"),
        (None, None) => format!("node {node}"),
    };
    if document.json.meshes[mesh].primitives.len() > 1 { format!("{name} #{primitive}") } else { name }
}
