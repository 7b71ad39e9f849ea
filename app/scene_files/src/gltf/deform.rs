//! Deformation of a mesh in its rest pose: morph targets by their weights, then the joints of a skin.
//!
//! A skinned vertex is where its joints take it: x' = Σ wᵢ Jᵢ Bᵢ x, J the joint's transform into the file's frame and
//! B its inverse bind matrix (glTF 2.0, 3.7.3). The transform of the mesh's own node does not count.

use std::collections::BTreeMap;

use ::gltf::json;
use ::gltf::json::accessor::Type;
use ::gltf::json::mesh::Semantic;
use glam::{DAffine3, DMat3, DMat4, DVec3, Vec3};

use super::accessor::{self, Elements, Purpose};
use super::document::Document;
use super::error::GltfError;
use super::file_json::NodeJson;
use super::notices::{Notices, Part};
use super::source::Source;

/// Sum of a vertex's weights below which it has no joint.
const NO_WEIGHT: f64 = 1e-12;

/// Deformation of one node's mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Deformation {
    /// Weights of the morph targets that are not zero, by their numbers.
    pub(super) weights: Vec<(usize, f32)>,
    /// Skin, if the mesh has joints.
    pub(super) skin: Option<PosedSkin>,
}

/// Skin in a pose.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PosedSkin {
    /// Place in the file's frame that deformed positions are relative to, metres.
    pub(super) anchor: DVec3,
    /// Transform of each joint from the mesh's frame to the file's, relative to the anchor.
    joints: Vec<DAffine3>,
    /// Transform of the mesh's own node, relative to the anchor, for vertices without joints.
    unposed: DAffine3,
}

impl PosedSkin {
    /// Skin in the pose of its joints, whose transforms into the file's frame are `placed`.
    pub(super) fn of(
        document: &Document<'_>,
        index: usize,
        placed: &BTreeMap<usize, DAffine3>,
        (node, place): (usize, &str),
    ) -> Result<Self, GltfError> {
        let skin = document.item(&document.json.skins, index, place)?;
        let place = format!("skins[{index}]");
        let inverse = match skin.inverse_bind_matrices {
            None => Vec::new(),
            Some(matrices) => {
                let place = format!("{place}.inverseBindMatrices");
                let purpose = Purpose::Vectors(Type::Mat4);
                let numbers =
                    accessor::read(document, (matrices.value(), Elements::All), &place, purpose, |value| value)?;
                let matrices = numbers.values.as_chunks::<16>().0.iter();
                matrices.map(|matrix| DAffine3::from_mat4(DMat4::from_cols_array(matrix))).collect()
            }
        };
        let mut joints = Vec::with_capacity(skin.joints.len());
        for (number, joint) in skin.joints.iter().enumerate() {
            let transform = placed.get(&joint.value()).ok_or_else(|| {
                document.damaged(&place, format!("its joint, nodes[{}], is not in the scene", joint.value()))
            })?;
            joints.push(*transform * inverse.get(number).copied().unwrap_or(DAffine3::IDENTITY));
        }
        let first = skin.joints.first().ok_or_else(|| document.damaged(&place, "it has no joints"))?;
        let anchor = placed[&first.value()].translation;
        joints.iter_mut().for_each(|joint| joint.translation -= anchor);
        let mut unposed = placed.get(&node).copied().unwrap_or(DAffine3::IDENTITY);
        unposed.translation -= anchor;
        Ok(Self { anchor, joints, unposed })
    }
}

impl Deformation {
    /// Deformation of a node's mesh; `None` if there is none.
    pub(super) fn of(
        document: &Document<'_>,
        (index, node): (usize, &NodeJson),
        mesh: &json::Mesh,
        placed: &BTreeMap<usize, DAffine3>,
        place: &str,
        notices: &mut Notices,
    ) -> Result<Option<Self>, GltfError> {
        let weights = node.weights.as_ref().or(mesh.weights.as_ref()).into_iter().flatten().copied().enumerate();
        let weights = weights.filter(|(_, weight)| *weight != 0.0 && weight.is_finite()).collect();
        let skin = match node.skin {
            None => None,
            Some(skin) => match PosedSkin::of(document, skin.value(), placed, (index, &format!("{place}.skin"))) {
                Ok(skin) => Some(skin),
                Err(error) => {
                    notices.left_out(Part::Skin, place, &error.part_fault()?);
                    None
                }
            },
        };
        let deformation = Self { weights, skin };
        Ok((deformation != Self::default()).then_some(deformation))
    }

    /// Applies the deformation to vertices of the primitive that `source` reads. True if the skin mirrors the
    /// primitive.
    pub(super) fn apply(
        &self,
        source: &Source<'_>,
        positions: &mut [Vec3],
        mut normals: Option<&mut Vec<Vec3>>,
        notices: &mut Notices,
    ) -> Result<bool, GltfError> {
        let document = source.document;
        for &(number, weight) in &self.weights {
            let Some(target) = source.primitive.targets.as_ref().and_then(|targets| targets.get(number)) else {
                continue;
            };
            let place = format!("{}.targets[{number}]", source.place);
            let add = |index: Option<usize>, values: &mut [Vec3]| -> Result<(), GltfError> {
                let Some(index) = index else { return Ok(()) };
                source.check_count(&place, accessor::count(document, index, &place)?)?;
                let (elements, purpose) = ((index, source.elements()), Purpose::Vectors(Type::Vec3));
                let moved = accessor::read(document, elements, &place, purpose, |value| value as f32)?.values;
                for (value, moved) in values.iter_mut().zip(moved.as_chunks::<3>().0) {
                    *value += weight * Vec3::from_array(*moved);
                }
                Ok(())
            };
            let mut applied = add(target.positions.map(|index| index.value()), positions);
            if let Some(normals) = normals.as_deref_mut() {
                applied = applied.and_then(|()| add(target.normals.map(|index| index.value()), normals));
            }
            if let Err(error) = applied {
                notices.left_out(Part::Morph, &place, &error.part_fault()?);
            }
        }
        let Some(skin) = &self.skin else { return Ok(false) };
        let influences = match Influences::read(source, skin.joints.len()) {
            Ok(influences) => influences,
            Err(error) => {
                notices.left_out(Part::Skin, source.place, &error.part_fault()?);
                Influences { sets: Vec::new() }
            }
        };
        Ok(influences.apply(skin, positions, normals))
    }
}

/// Joints of every vertex and their weights, four or eight each.
struct Influences {
    sets: Vec<(Vec<usize>, Vec<f64>)>,
}

impl Influences {
    fn read(source: &Source<'_>, joint_count: usize) -> Result<Self, GltfError> {
        let (document, place) = (source.document, source.place);
        let mut sets = Vec::new();
        for set in 0.. {
            let joints = source.attribute(Semantic::Joints(set), &format!("JOINTS_{set}"), Purpose::Joints)?;
            let purpose = Purpose::Vectors(Type::Vec4);
            let weights = source.attribute(Semantic::Weights(set), &format!("WEIGHTS_{set}"), purpose)?;
            let (Some((joints, _)), Some((shares, _))) = (joints, weights) else { break };
            let place = format!("{place}.attributes.JOINTS_{set}");
            let found: Vec<usize> = joints.into_iter().map(|joint| joint as usize).collect();
            let shares: Vec<f64> = shares.into_iter().map(f64::from).collect();
            let beyond = found.iter().zip(&shares).find(|(joint, share)| **joint >= joint_count && **share != 0.0);
            if let Some((joint, _)) = beyond {
                return Err(document.damaged(&place, format!("joint {joint} of {joint_count}")));
            }
            sets.push((found, shares));
        }
        if sets.is_empty() {
            return Err(document.damaged(&format!("{place}.attributes"), "JOINTS_0 and WEIGHTS_0 are missing"));
        }
        Ok(Self { sets })
    }

    /// Applies a skin; true if it mirrors most of the vertices. Without any joints, they are where their node is.
    fn apply(&self, skin: &PosedSkin, positions: &mut [Vec3], mut normals: Option<&mut Vec<Vec3>>) -> bool {
        let mut mirrored = 0;
        for (vertex, position) in positions.iter_mut().enumerate() {
            let mut matrix = DMat3::ZERO;
            let (mut translation, mut sum) = (DVec3::ZERO, 0.0);
            for (joints, weights) in &self.sets {
                for (&joint, &weight) in joints[4 * vertex..][..4].iter().zip(&weights[4 * vertex..][..4]) {
                    let Some(joint) = skin.joints.get(joint).filter(|_| weight != 0.0) else { continue };
                    matrix += joint.matrix3 * weight;
                    translation += joint.translation * weight;
                    sum += weight;
                }
            }
            // A vertex that no joint holds follows the first.
            let whole = if self.sets.is_empty() {
                skin.unposed
            } else if sum > NO_WEIGHT {
                DAffine3 { matrix3: matrix * (1.0 / sum), translation: translation / sum }
            } else {
                skin.joints.first().copied().unwrap_or(DAffine3::IDENTITY)
            };
            *position = whole.transform_point3(position.as_dvec3()).as_vec3();
            let [x, y, z] = [whole.matrix3.x_axis, whole.matrix3.y_axis, whole.matrix3.z_axis];
            let mirror = if x.dot(y.cross(z)) < 0.0 { -1.0 } else { 1.0 };
            mirrored += usize::from(mirror < 0.0);
            if let Some(normals) = normals.as_deref_mut() {
                let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * mirror;
                normals[vertex] = (cofactors * normals[vertex].as_dvec3()).normalize_or_zero().as_vec3();
            }
        }
        2 * mirrored > positions.len()
    }
}
