//! JSON of a glTF file, as it is read and written.
//!
//! The lists have the types of the `gltf` crate, except for the nodes: that crate keeps transforms in f32, and here
//! nodes have all digits of the file. One pass over the text gives everything.

use ::gltf::json::{self, Extras, Index};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

/// JSON of a glTF file. Indices in it are not yet checked.
#[derive(Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", expecting = "an object")]
pub struct GltfJson {
    /// Version of the format, and who made the file.
    pub asset: json::Asset,
    /// Names of all extensions in the file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub extensions_used: Vec<String>,
    /// Names of the extensions without which the file cannot be read.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub extensions_required: Vec<String>,
    /// Extensions of the whole file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extensions: Option<json::extensions::Root>,
    /// Index of the scene that is shown first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<Index<json::Scene>>,
    /// Scenes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub scenes: Vec<json::Scene>,
    /// Nodes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub nodes: Vec<NodeJson>,
    /// Meshes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub meshes: Vec<json::Mesh>,
    /// Materials.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub materials: Vec<json::Material>,
    /// Textures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub textures: Vec<json::Texture>,
    /// Samplers of textures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub samplers: Vec<json::texture::Sampler>,
    /// Images.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub images: Vec<json::Image>,
    /// Animations.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub animations: Vec<json::Animation>,
    /// Skins.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skins: Vec<json::Skin>,
    /// Cameras.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cameras: Vec<json::Camera>,
    /// Accessors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub accessors: Vec<json::Accessor>,
    /// Buffer views.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub buffer_views: Vec<json::buffer::View>,
    /// Buffers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub buffers: Vec<json::Buffer>,
}

/// Node with all digits of its transform.
#[derive(Default, Deserialize, Serialize)]
#[serde(expecting = "an object")]
pub struct NodeJson {
    /// Name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Indices of the nodes below.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub children: Option<Vec<Index<json::Node>>>,
    /// Index of its mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<Index<json::Mesh>>,
    /// Index of its camera.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<Index<json::Camera>>,
    /// Index of its skin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub skin: Option<Index<json::Skin>>,
    /// Weights of the morph targets, in place of its mesh's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weights: Option<Vec<f32>>,
    /// Matrix of the transform to the parent's frame, column by column.
    #[serde(default, deserialize_with = "single_range", skip_serializing_if = "Option::is_none")]
    pub matrix: Option<[f64; 16]>,
    /// Translation, metres.
    #[serde(default, deserialize_with = "single_range", skip_serializing_if = "Option::is_none")]
    pub translation: Option<[f64; 3]>,
    /// Rotation, a quaternion x, y, z, w.
    #[serde(default, deserialize_with = "single_range", skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 4]>,
    /// Scale factors.
    #[serde(default, deserialize_with = "single_range", skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f64; 3]>,
    /// Extensions of the node.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extensions: Option<json::extensions::scene::Node>,
    /// Data of other programs, and of this one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extras: Extras,
}

/// Numbers of a transform, with all their digits, in the range of single precision: glTF knows no larger numbers, and
/// a larger one would take a mesh where nothing can be seen.
fn single_range<'de, D: Deserializer<'de>, const N: usize>(deserializer: D) -> Result<Option<[f64; N]>, D::Error>
where
    [f64; N]: Deserialize<'de>,
{
    let numbers = Option::<[f64; N]>::deserialize(deserializer)?;
    match numbers.iter().flatten().find(|&&number| !(number as f32).is_finite()) {
        Some(number) => Err(D::Error::custom(format!("number {number:e} is out of range"))),
        None => Ok(numbers),
    }
}
