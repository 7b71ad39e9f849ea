//! Instances of a node's mesh: `EXT_mesh_gpu_instancing`.

use ::gltf::json::accessor::Type;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use serde_json::Value;

use super::accessor::{self, Elements, Purpose};
use super::document::Document;
use super::error::GltfError;
use super::file_json::NodeJson;

/// Name of the extension.
const NAME: &str = "EXT_mesh_gpu_instancing";

/// Transforms from each instance's frame to the node's; `None` if the node has a single mesh.
pub(super) fn instances(
    document: &Document<'_>,
    node: &NodeJson,
    place: &str,
) -> Result<Option<Vec<DAffine3>>, GltfError> {
    let Some(extension) = node.extensions.as_ref().and_then(|extensions| extensions.others.get(NAME)) else {
        return Ok(None);
    };
    let place = format!("{place}.extensions.{NAME}.attributes");
    let attribute = |name: &str| {
        let index = extension.get("attributes").and_then(|attributes| attributes.get(name));
        index.and_then(Value::as_u64).and_then(|index| usize::try_from(index).ok())
    };
    let numbers = |name: &str, element: Type| {
        let purpose = Purpose::Vectors(element);
        let read = |index| accessor::read(document, (index, Elements::All), &place, purpose, |value| value);
        attribute(name).map(read).transpose()
    };
    let translations = numbers("TRANSLATION", Type::Vec3)?;
    let rotations = numbers("ROTATION", Type::Vec4)?;
    let scales = numbers("SCALE", Type::Vec3)?;
    let lengths = [&translations, &rotations, &scales]
        .map(|numbers| numbers.as_ref().map(|numbers| numbers.values.len() / numbers.width));
    let Some(count) = lengths.into_iter().flatten().min() else { return Ok(None) };
    let part = |numbers: &Option<accessor::AccessorNumbers<f64>>, index: usize| {
        numbers.as_ref().map(|numbers| numbers.values[index * numbers.width..][..numbers.width].to_vec())
    };
    let vector = |part: Option<Vec<f64>>, otherwise| part.map_or(otherwise, |part| DVec3::from_slice(&part));
    let instance = |index| {
        let rotation = part(&rotations, index).map_or(DQuat::IDENTITY, |part| DQuat::from_slice(&part));
        let length = rotation.length();
        let rotation = if length.is_normal() { rotation / length } else { DQuat::IDENTITY };
        let scale = vector(part(&scales, index), DVec3::ONE);
        DAffine3 {
            matrix3: DMat3::from_quat(rotation) * DMat3::from_diagonal(scale),
            translation: vector(part(&translations, index), DVec3::ZERO),
        }
    };
    Ok(Some((0..count).map(instance).collect()))
}
