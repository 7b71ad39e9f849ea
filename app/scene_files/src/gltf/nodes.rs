//! Placements: the node tree, flattened.
//!
//! Every node of a glTF scene has one parent at most, so a node that is reached twice means a circle or two parents;
//! both are refused.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use super::animation::{self, NodeKeys};
use super::container::Document;
use super::error::GltfError;
use super::extras::{NodeExtras, celerity};
use super::file_json::NodeJson;
use super::notices::Notices;
use super::primitive::Primitive;
use physics::Event;
use scene::Start;
use scene::motion::{Animated, ChainLink, Keyed, Track, Uniform};
use std::sync::Arc;

/// Distance from the file's origin, metres, up to which f32 keeps a quarter of a millimetre and positions stay as the
/// file has them.
const NEAR: f64 = 4096.0;

/// Placement of a node that has a mesh, a light or a camera.
pub(super) struct NodePlacement {
    /// Index into the file's nodes.
    pub(super) node: usize,
    /// Index into the file's meshes, not yet checked.
    pub(super) mesh: Option<usize>,
    /// Index into the file's lights, not yet checked.
    pub(super) light: Option<usize>,
    /// True if the node has a camera.
    pub(super) camera: bool,
    /// Transform from the node's frame to the file's.
    pub(super) transform: DAffine3,
    /// Value of `extras.rapidity.solid`.
    pub(super) solid: Option<bool>,
    /// Motion of the node, or of its nearest moving ancestor, with that ancestor's anchor: connected nodes move
    /// together.
    pub(super) motion: Option<NodeMotion>,
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

/// Placements of all nodes of a scene that have a mesh, a light or a camera, parents before children, in the file's
/// order.
pub(super) fn placements(
    document: &Document,
    scene: Option<usize>,
    notices: &mut Notices,
) -> Result<Vec<NodePlacement>, GltfError> {
    let nodes = &document.json.nodes;
    let roots = match scene {
        Some(scene) => document.json.scenes[scene].nodes.iter().map(|node| node.value()).collect(),
        None => orphans(document),
    };
    let moved = animation::moved(document, notices)?;
    let mut reached = vec![false; nodes.len()];
    let mut placements = Vec::new();
    let mut stack: Vec<_> =
        roots.into_iter().rev().map(|root| (root, DAffine3::IDENTITY, None::<NodeMotion>)).collect();
    while let Some((index, parent, inherited)) = stack.pop() {
        let place = format!("nodes[{index}]");
        let node = document.item(nodes, index, &place)?;
        if std::mem::replace(&mut reached[index], true) {
            return Err(document.damaged(&place, "it has two parents or is its own ancestor"));
        }
        let local = local(node, &place, notices);
        let transform = parent * local;
        let own =
            celerity(&node.extras).map_err(|(key, fault)| document.damaged(&format!("{place}.extras.{key}"), fault))?;
        let uniform = own.map(|(celerity, ct)| {
            NodeMotion::Uniform(Uniform { celerity, anchor: Event { ct, position: transform.translation } })
        });
        let motion = match (uniform, moved.get(&index), inherited) {
            (None, Some(moved), inherited @ (None | Some(NodeMotion::Animated { .. }))) => {
                let keyed = keyed(node, moved);
                let name = node.name.clone().unwrap_or(place.clone());
                Some(animated(name, parent, inherited, keyed))
            }
            (uniform, moved, inherited) => {
                if moved.is_some() {
                    notices.add(format!("{place} has a celerity, or hangs on what has: its animation stands still"));
                }
                uniform.or_else(|| inherited.map(|moves| moves.of_child(local)))
            }
        };
        let light = node.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
        if node.mesh.is_some() || node.camera.is_some() || light.is_some() {
            let extras = NodeExtras::read(&node.extras);
            let extras = extras.map_err(|fault| document.damaged(&format!("{place}.extras.rapidity"), fault))?;
            let mesh = node.mesh.map(|mesh| mesh.value());
            placements.push(NodePlacement {
                node: index,
                mesh,
                light: light.map(|light| light.light.value()),
                camera: node.camera.is_some(),
                transform,
                solid: extras.solid,
                motion: motion.clone(),
            });
        }
        let children = node.children.iter().flatten().rev();
        stack.extend(children.map(|child| (child.value(), transform, motion.clone())));
    }
    Ok(placements)
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
    Keyed {
        translation: moved.translation.clone().map_or(Track::Fixed(translation), Track::Keyed),
        rotation: moved.rotation.clone().map_or(Track::Fixed(rotation), Track::Keyed),
        scale: DVec3::from_array(node.scale.unwrap_or([1.0; 3])),
    }
}

/// Indices of the nodes without a parent. If every node has one, the tree has a circle; then the first node alone,
/// which reveals it.
fn orphans(document: &Document) -> Vec<usize> {
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

/// Transform from a node's frame to its parent's.
fn local(node: &NodeJson, place: &str, notices: &mut Notices) -> DAffine3 {
    if let Some(matrix) = &node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(matrix));
    }
    let rotation = node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    let length = rotation.length();
    let rotation = if length.is_normal() {
        rotation / length
    } else {
        notices.add(format!("{place} has a rotation without direction, which is left out"));
        DQuat::IDENTITY
    };
    let scale = DVec3::from_array(node.scale.unwrap_or([1.0; 3]));
    let translation = DVec3::from_array(node.translation.unwrap_or_default());
    DAffine3 { matrix3: DMat3::from_quat(rotation) * DMat3::from_diagonal(scale), translation }
}

/// Bounding box of all finite vertices, in the file's frame.
pub(super) struct Bounds {
    least: DVec3,
    most: DVec3,
}

impl Default for Bounds {
    fn default() -> Self {
        Self { least: DVec3::INFINITY, most: DVec3::NEG_INFINITY }
    }
}

impl Bounds {
    pub(super) fn add(&mut self, primitive: &Primitive, transform: DAffine3) {
        for position in &primitive.positions {
            let position = transform.transform_point3(position.as_dvec3());
            if position.is_finite() {
                self.least = self.least.min(position);
                self.most = self.most.max(position);
            }
        }
    }

    fn is_empty(&self) -> bool {
        !self.least.cmple(self.most).all()
    }

    /// Origin for the scene: the file's own if f32 is fine enough there, else the middle of the box in whole metres.
    pub(super) fn origin(&self) -> DVec3 {
        if self.is_empty() || self.least.abs().max(self.most.abs()).max_element() <= NEAR {
            DVec3::ZERO
        } else {
            (0.5 * self.least + 0.5 * self.most).round()
        }
    }

    /// Start at the file's origin if it lies within the box, else on the ground in front of the box, looking at it.
    pub(super) fn start(&self) -> Start {
        let within = self.least.cmple(DVec3::ZERO).all() && self.most.cmpge(DVec3::ZERO).all();
        if self.is_empty() || within {
            return Start::default();
        }
        let middle = 0.5 * self.least + 0.5 * self.most;
        let size = (self.most - self.least).max_element();
        Start { position: DVec3::new(middle.x, self.least.y, self.most.z + size), ..Start::default() }
    }
}
