//! Attributes of a primitive's vertices, by their names.

use ::gltf::json;
use ::gltf::json::mesh::Semantic;
use ::gltf::json::validation::Checked;

/// Index of the accessor that holds an attribute.
pub(super) fn attribute(primitive: &json::mesh::Primitive, semantic: Semantic) -> Option<usize> {
    primitive.attributes.get(&Checked::Valid(semantic)).map(|index| index.value())
}
