//! Placements: the node tree, flattened.
//!
//! Every node of a glTF scene has one parent at most. A node that is reached twice means a circle or two parents; it is
//! placed where it was reached first.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use super::animation::{self, NodeKeys};
use super::document::Document;
use super::error::GltfError;
use super::extras::{NodeExtras, celerity};
use super::file_json::NodeJson;
use super::instancing;
use super::notices::{Notices, Part};
use physics::Event;
use scene::motion::{Animated, ChainLink, Keyed, Track, Uniform};
use std::sync::Arc;

/// Largest number of transforms in a chain of animated nodes. Each point asks for all of them whenever it is seen.
const MOST_LINKS: usize = 128;

/// Placement of a node that has a mesh, a light or a camera.
pub(super) struct NodePlacement {
    /// Index into the file's nodes.
    pub(super) node: usize,
    /// Index into the file's meshes, not yet checked.
    pub(super) mesh: Option<usize>,
    /// Index into the file's lights, not yet checked.
    pub(super) light: Option<usize>,
    /// Index into the file's cameras, not yet checked.
    pub(super) camera: Option<usize>,
    /// Transform from the node's frame to the file's.
    pub(super) transform: DAffine3,
    /// Value of `extras.rapidity.solid`.
    pub(super) solid: Option<bool>,
    /// Motion of the node, or of its nearest moving ancestor, with that ancestor's anchor: connected nodes move
    /// together.
    pub(super) motion: Option<NodeMotion>,
}

/// Placements of a scene.
pub(super) struct Placed {
    /// Placements of all visible nodes that have a mesh, a light or a camera, parents before children, in the file's
    /// order.
    pub(super) placements: Vec<NodePlacement>,
    /// Transforms from each node's frame to the file's at time 0, of every node of the scene.
    pub(super) transforms: BTreeMap<usize, DAffine3>,
}

/// Motion of a node.
#[derive(Clone)]
pub(super) enum NodeMotion {
    Uniform(Uniform),
    /// Node moved by keys. `body_from_node`: transform from the node's frame to that of the last node of the chain.
    Animated {
        animated: Arc<Animated>,
        body_from_node: DAffine3,
    },
}

impl NodeMotion {
    /// Number of transforms in the chain of an animated node.
    fn links(&self) -> usize {
        match self {
            Self::Uniform(_) => 0,
            Self::Animated { animated, .. } => animated.links().len(),
        }
    }

    /// Motion of a child with the transform `local`.
    fn of_child(&self, local: DAffine3) -> Self {
        match self {
            Self::Uniform(uniform) => Self::Uniform(*uniform),
            Self::Animated { animated, body_from_node } => {
                Self::Animated { animated: Arc::clone(animated), body_from_node: *body_from_node * local }
            }
        }
    }
}

/// Node on the way through the tree.
struct Visit {
    index: usize,
    /// Transform of the parent's frame to the file's.
    parent: DAffine3,
    motion: Option<NodeMotion>,
    visible: bool,
}

/// Placements of all nodes of a scene.
pub(super) fn placements(
    document: &Document<'_>,
    scene: Option<usize>,
    notices: &mut Notices,
) -> Result<Placed, GltfError> {
    let nodes = &document.json.nodes;
    let roots = match scene {
        Some(scene) => document.json.scenes[scene].nodes.iter().map(|node| node.value()).collect(),
        None => orphans(document),
    };
    let moved = animation::moved(document, notices)?;
    let mut placed = Placed { placements: Vec::new(), transforms: BTreeMap::new() };
    let root = |index| Visit { index, parent: DAffine3::IDENTITY, motion: None, visible: true };
    let mut stack: Vec<Visit> = roots.into_iter().rev().map(root).collect();
    while let Some(Visit { index, parent, motion: inherited, visible }) = stack.pop() {
        let place = format!("nodes[{index}]");
        let Some(node) = nodes.get(index) else {
            notices.left_out(Part::Node, &place, &format!("there is no number {index} among {}", nodes.len()));
            continue;
        };
        if placed.transforms.contains_key(&index) {
            notices.left_out(Part::Node, &place, "it has two parents or is its own ancestor");
            continue;
        }
        let local = local(node, moved.get(&index), &place, notices);
        let transform = parent * local;
        let own =
            celerity(&node.extras).map_err(|(key, fault)| document.damaged(&format!("{place}.extras.{key}"), fault))?;
        let uniform = own.map(|(celerity, ct)| {
            NodeMotion::Uniform(Uniform { celerity, anchor: Event { ct, position: transform.translation } })
        });
        let keys = moved.get(&index).filter(|keys| keys.moves());
        let motion = match (uniform, keys, inherited) {
            (None, Some(keys), inherited @ (None | Some(NodeMotion::Animated { .. })))
                if inherited.as_ref().is_none_or(|motion| motion.links() < MOST_LINKS) =>
            {
                let name = node.name.clone().unwrap_or(place.clone());
                Some(animated(name, parent, inherited, keyed(node, keys)))
            }
            (uniform, keys, inherited) => {
                if keys.is_some() && inherited.as_ref().is_some_and(|motion| motion.links() >= MOST_LINKS) {
                    notices.add(format!("nodes below {MOST_LINKS} animated ones do not move by themselves"));
                } else if keys.is_some() {
                    notices.add(format!("{place} has a celerity, or hangs on what has: its animation stands still"));
                }
                uniform.or_else(|| inherited.map(|moves| moves.of_child(local)))
            }
        };
        let at_start = match &motion {
            Some(NodeMotion::Animated { animated, body_from_node }) => {
                animated.at(0.0).world_from_body * *body_from_node
            }
            _ => transform,
        };
        placed.transforms.insert(index, at_start);
        let visible = visible && visibility(node);
        if !visible && node.mesh.is_some() {
            notices.add("nodes that the file hides (KHR_node_visibility) are not drawn".into());
        }
        place_node(document, (index, node), transform, motion.as_ref(), visible, &mut placed.placements, notices)?;
        let children = node.children.iter().flatten().rev();
        stack.extend(children.map(|child| Visit {
            index: child.value(),
            parent: transform,
            motion: motion.clone(),
            visible,
        }));
    }
    Ok(placed)
}

/// Adds the placements of one node, if it has a mesh, a light or a camera: one for each instance of its mesh.
fn place_node(
    document: &Document<'_>,
    (index, node): (usize, &NodeJson),
    transform: DAffine3,
    motion: Option<&NodeMotion>,
    visible: bool,
    placements: &mut Vec<NodePlacement>,
    notices: &mut Notices,
) -> Result<(), GltfError> {
    let light = node.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    if node.mesh.is_none() && node.camera.is_none() && light.is_none() {
        return Ok(());
    }
    let place = format!("nodes[{index}]");
    let extras =
        NodeExtras::read(&node.extras).map_err(|fault| document.damaged(&format!("{place}.extras.rapidity"), fault))?;
    let first = NodePlacement {
        node: index,
        mesh: node.mesh.filter(|_| visible).map(|mesh| mesh.value()),
        light: light.filter(|_| visible).map(|light| light.light.value()),
        camera: node.camera.map(|camera| camera.value()),
        transform,
        solid: extras.solid,
        motion: motion.cloned(),
    };
    let instances = match instancing::instances(document, node, &place) {
        Ok(instances) => instances,
        Err(error) => {
            notices.left_out(Part::Node, &place, &error.part_fault()?);
            None
        }
    };
    let Some(instances) = instances.filter(|_| first.mesh.is_some()) else {
        placements.push(first);
        return Ok(());
    };
    if first.light.is_some() || first.camera.is_some() {
        placements.push(NodePlacement { mesh: None, motion: first.motion.clone(), ..first });
    }
    placements.extend(instances.into_iter().map(|instance| NodePlacement {
        light: None,
        camera: None,
        transform: transform * instance,
        motion: motion.map(|motion| motion.of_child(instance)),
        ..first
    }));
    Ok(())
}

/// Visibility of a node, by `KHR_node_visibility`; its children share it.
fn visibility(node: &NodeJson) -> bool {
    let extension = node.extensions.as_ref().and_then(|extensions| extensions.others.get("KHR_node_visibility"));
    extension.is_none_or(|extension| extension.get("visible").and_then(serde_json::Value::as_bool) != Some(false))
}

/// Motion of a chain that ends in an animated node. `parent`: transform from its parent's frame to the file's, used
/// if nothing above it moves.
fn animated(name: String, parent: DAffine3, inherited: Option<NodeMotion>, keyed: Keyed) -> NodeMotion {
    let mut links = match inherited {
        Some(NodeMotion::Animated { animated, body_from_node }) => {
            let mut links = animated.links().to_vec();
            links.push(ChainLink::Fixed(body_from_node));
            links
        }
        _ => vec![ChainLink::Fixed(parent)],
    };
    links.retain(|link| *link != ChainLink::Fixed(DAffine3::IDENTITY));
    links.push(ChainLink::Keyed(keyed));
    NodeMotion::Animated { animated: Arc::new(Animated::new(name, links)), body_from_node: DAffine3::IDENTITY }
}

/// Transform of an animated node; quantities without keys are constant, as the node has them.
fn keyed(node: &NodeJson, moved: &NodeKeys) -> Keyed {
    let rotation = node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    let rotation = if rotation.length().is_normal() { rotation.normalize() } else { DQuat::IDENTITY };
    let translation = DVec3::from_array(node.translation.unwrap_or_default());
    let scale = DVec3::from_array(node.scale.unwrap_or([1.0; 3]));
    Keyed {
        translation: moved.translation.clone().unwrap_or(Track::Fixed(translation)),
        rotation: moved.rotation.clone().unwrap_or(Track::Fixed(rotation)),
        scale: moved.scale.clone().unwrap_or(Track::Fixed(scale)),
    }
}

/// Indices of the nodes without a parent. If every node has one, the tree has a circle; then the first node alone,
/// which reveals it.
fn orphans(document: &Document<'_>) -> Vec<usize> {
    let nodes = &document.json.nodes;
    let mut orphan = vec![true; nodes.len()];
    for child in nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(orphan) = orphan.get_mut(child.value()) {
            *orphan = false;
        }
    }
    let orphans: Vec<usize> = (0..nodes.len()).filter(|&node| orphan[node]).collect();
    if orphans.is_empty() && !nodes.is_empty() { vec![0] } else { orphans }
}

/// Transform from a node's frame to its parent's. Quantities that an animation holds constant are as it holds them.
fn local(node: &NodeJson, held: Option<&NodeKeys>, place: &str, notices: &mut Notices) -> DAffine3 {
    if let Some(matrix) = &node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(matrix));
    }
    let held_vector = |track: Option<&Track<DVec3>>| match track {
        Some(Track::Fixed(value)) => Some(*value),
        _ => None,
    };
    let rotation = match held.and_then(|held| held.rotation.as_ref()) {
        Some(Track::Fixed(rotation)) => *rotation,
        _ => node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array),
    };
    let length = rotation.length();
    let rotation = if length.is_normal() {
        rotation / length
    } else {
        notices.add(format!("{place} has a rotation without direction, which is left out"));
        DQuat::IDENTITY
    };
    let scale = held_vector(held.and_then(|held| held.scale.as_ref()));
    let scale = scale.unwrap_or(DVec3::from_array(node.scale.unwrap_or([1.0; 3])));
    let translation = held_vector(held.and_then(|held| held.translation.as_ref()));
    let translation = translation.unwrap_or(DVec3::from_array(node.translation.unwrap_or_default()));
    DAffine3 { matrix3: DMat3::from_quat(rotation) * DMat3::from_diagonal(scale), translation }
}
