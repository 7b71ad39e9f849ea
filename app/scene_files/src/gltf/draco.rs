//! Draco's form of a primitive: `KHR_draco_mesh_compression`.

use std::collections::BTreeMap;

use ::gltf::json;
use ::gltf::json::accessor::{ComponentType, GenericComponentType};
use ::gltf::json::validation::Checked;
use decoders::draco::{Attribute, DracoMesh, decode};
use serde_json::Value;

use super::document::Document;
use super::error::GltfError;

/// Name of the extension.
const NAME: &str = "KHR_draco_mesh_compression";

/// Decoded data of a primitive.
pub(super) struct DracoData {
    mesh: DracoMesh,
    /// Unique id of each attribute, and the value that stands for 1 in its accessor, by the attribute's name.
    ids: BTreeMap<String, (u64, f32)>,
}

impl DracoData {
    /// Decodes a primitive's data; `None` if they are not compressed, or if they cannot be decoded but are there
    /// uncompressed, too.
    pub(super) fn read(
        document: &Document<'_>,
        primitive: &json::mesh::Primitive,
        place: &str,
    ) -> Result<Option<Self>, GltfError> {
        let Some(extension) = primitive.extensions.as_ref().and_then(|extensions| extensions.others.get(NAME)) else {
            return Ok(None);
        };
        let place = format!("{place}.extensions.{NAME}");
        let decoded = || {
            let view = extension.get("bufferView").and_then(Value::as_u64).and_then(|view| usize::try_from(view).ok());
            let view = view.ok_or_else(|| document.damaged(&place, "it names no buffer view"))?;
            let (bytes, _) = document.view(view, &place)?;
            decode(bytes, document.budget).map_err(|fault| document.undecodable(&place, fault))
        };
        let ids = extension.get("attributes").and_then(Value::as_object).into_iter().flatten();
        let ids =
            ids.filter_map(|(name, id)| Some((name.clone(), (id.as_u64()?, one(document, primitive, name))))).collect();
        match decoded() {
            Ok(mesh) => Ok(Some(Self { mesh, ids })),
            Err(error) => {
                let plain = primitive.attributes.values().all(|accessor| {
                    document.json.accessors.get(accessor.value()).is_some_and(|accessor| accessor.buffer_view.is_some())
                });
                if plain { Ok(None) } else { Err(error) }
            }
        }
    }

    /// Number of vertices; `None` if they have no positions.
    pub(super) fn count(&self) -> Option<usize> {
        let (positions, _) = self.stored("POSITION")?;
        Some(positions.values.len() / positions.components.max(1))
    }

    /// Attribute as it was decoded, and the value that stands for 1 in it.
    fn stored(&self, name: &str) -> Option<(&Attribute, f32)> {
        let (id, one) = *self.ids.get(name)?;
        let found = self.mesh.attributes.iter().find(|attribute| u64::from(attribute.unique_id) == id)?;
        Some((found, one))
    }

    /// Components of an attribute, and their number in an element.
    pub(super) fn attribute(&self, name: &str) -> Option<(Vec<f32>, usize)> {
        let (found, one) = self.stored(name)?;
        // Some encoders leave it to the accessor that integers are fractions.
        let whole = one > 1.0 && found.values.iter().any(|value| *value > 1.0);
        let one = if whole { one } else { 1.0 };
        Some((found.values.iter().map(|value| value / one).collect(), found.components.max(1)))
    }

    /// Indices of vertices, three for each triangle.
    pub(super) fn indices(&self) -> Vec<u32> {
        self.mesh.indices.clone()
    }
}

/// Value that stands for 1 in an attribute's accessor: the largest integer if it is normalised, or a colour.
fn one(document: &Document<'_>, primitive: &json::mesh::Primitive, name: &str) -> f32 {
    let accessor = primitive.attributes.iter().find(|(semantic, _)| match semantic {
        Checked::Valid(semantic) => semantic.to_string() == name,
        Checked::Invalid => false,
    });
    let Some(accessor) = accessor.and_then(|(_, index)| document.json.accessors.get(index.value())) else { return 1.0 };
    match accessor.component_type {
        Checked::Valid(GenericComponentType(component)) if accessor.normalized || name.starts_with("COLOR") => {
            match component {
                ComponentType::I8 => 127.0,
                ComponentType::U8 => 255.0,
                ComponentType::I16 => 32767.0,
                ComponentType::U16 => 65535.0,
                ComponentType::U32 | ComponentType::F32 => 1.0,
            }
        }
        _ => 1.0,
    }
}
