//! Where things stand: the node tree, flattened.
//!
//! Every node of a glTF scene has one parent at most, so a node that is reached twice means a circle or two parents; both are refused.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};

use super::container::{Document, Transform};
use super::extras::{NodeExtras, celerity};
use super::primitive::Primitive;
use super::{GltfError, NEAR, Notices};
use crate::scene::Start;
use crate::scene::motion::Uniform;
use physics::Event;

/// A node that bears something.
pub(super) struct Placement {
    /// Index into the file's nodes.
    pub(super) node: usize,
    /// Index into the file's meshes, not yet checked.
    pub(super) mesh: Option<usize>,
    /// Index into the file's lights, not yet checked.
    pub(super) light: Option<usize>,
    /// Whether it bears a camera.
    pub(super) camera: bool,
    /// File's frame from the node's.
    pub(super) transform: DAffine3,
    /// What `extras.rapidity.solid` says.
    pub(super) solid: Option<bool>,
    /// Its own motion, or that of the nearest ancestor that has one, with that one's anchor: what hangs together moves together.
    pub(super) motion: Option<Uniform>,
}

/// All nodes of a scene that bear a mesh, a light or a camera, parents before children, in the file's order.
pub(super) fn placements(
    document: &Document,
    scene: Option<usize>,
    notices: &mut Notices,
) -> Result<Vec<Placement>, GltfError> {
    let nodes = &document.json.nodes;
    let roots = match scene {
        Some(scene) => document.json.scenes[scene].nodes.iter().map(|node| node.value()).collect(),
        None => orphans(document),
    };
    let mut reached = vec![false; nodes.len()];
    let mut placements = Vec::new();
    let mut stack: Vec<_> = roots.into_iter().rev().map(|root| (root, DAffine3::IDENTITY, None)).collect();
    while let Some((index, parent, inherited)) = stack.pop() {
        let place = format!("nodes[{index}]");
        let node = document.item(nodes, index, &place)?;
        if std::mem::replace(&mut reached[index], true) {
            return Err(document.damaged(&place, "it has two parents or is its own ancestor"));
        }
        let transform = parent * local(&document.transforms[index], &place, notices);
        let own =
            celerity(&node.extras).map_err(|(key, fault)| document.damaged(&format!("{place}.extras.{key}"), fault))?;
        let motion = own
            .map(|(celerity, ct)| Uniform { celerity, anchor: Event { ct, position: transform.translation } })
            .or(inherited);
        let light = node.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
        if node.mesh.is_some() || node.camera.is_some() || light.is_some() {
            let extras = NodeExtras::read(&node.extras);
            let extras = extras.map_err(|fault| document.damaged(&format!("{place}.extras.rapidity"), fault))?;
            let mesh = node.mesh.map(|mesh| mesh.value());
            placements.push(Placement {
                node: index,
                mesh,
                light: light.map(|light| light.light.value()),
                camera: node.camera.is_some(),
                transform,
                solid: extras.solid,
                motion,
            });
        }
        let children = node.children.iter().flatten().rev();
        stack.extend(children.map(|child| (child.value(), transform, motion)));
    }
    Ok(placements)
}

/// Nodes without a parent. If there are none but nodes, the tree is a circle, which the first node will show.
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

fn local(transform: &Transform, place: &str, notices: &mut Notices) -> DAffine3 {
    if let Some(matrix) = &transform.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(matrix));
    }
    let rotation = transform.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    let length = rotation.length();
    let rotation = if length.is_normal() {
        rotation / length
    } else {
        notices.add(format!("{place} has a rotation without direction, which is left out"));
        DQuat::IDENTITY
    };
    let scale = DVec3::from_array(transform.scale.unwrap_or([1.0; 3]));
    let translation = DVec3::from_array(transform.translation.unwrap_or_default());
    DAffine3 { matrix3: DMat3::from_quat(rotation) * DMat3::from_diagonal(scale), translation }
}

/// The box round all finite vertices, in the file's frame.
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

    /// The file's own origin where f32 is fine enough there, else the middle of the box in whole metres.
    pub(super) fn origin(&self) -> DVec3 {
        if self.is_empty() || self.least.abs().max(self.most.abs()).max_element() <= NEAR {
            DVec3::ZERO
        } else {
            (0.5 * self.least + 0.5 * self.most).round()
        }
    }

    /// The file's origin if it lies within the box, else on the ground in front of it, looking at it.
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
