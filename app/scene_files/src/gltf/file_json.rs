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
pub(crate) struct GltfJson {
    pub(crate) asset: json::Asset,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) extensions_used: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) extensions_required: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) extensions: Option<json::extensions::Root>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) scene: Option<Index<json::Scene>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) scenes: Vec<json::Scene>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) nodes: Vec<NodeJson>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) meshes: Vec<json::Mesh>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) materials: Vec<json::Material>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) textures: Vec<json::Texture>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) samplers: Vec<json::texture::Sampler>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) images: Vec<json::Image>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) animations: Vec<json::Animation>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) skins: Vec<json::Skin>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) cameras: Vec<json::Camera>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) accessors: Vec<json::Accessor>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) buffer_views: Vec<json::buffer::View>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) buffers: Vec<json::Buffer>,
}

/// Node with all digits of its transform.
#[derive(Default, Deserialize, Serialize)]
#[serde(expecting = "an object")]
pub(crate) struct NodeJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) children: Option<Vec<Index<json::Node>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) mesh: Option<Index<json::Mesh>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) camera: Option<Index<json::Camera>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) skin: Option<Index<json::Skin>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) weights: Option<Vec<f32>>,
    /// Matrix of the transform to the parent's frame, column by column.
    #[serde(default, deserialize_with = "single_range", skip_serializing_if = "Option::is_none")]
    pub(crate) matrix: Option<[f64; 16]>,
    /// Translation, metres.
    #[serde(default, deserialize_with = "single_range", skip_serializing_if = "Option::is_none")]
    pub(crate) translation: Option<[f64; 3]>,
    /// Rotation, a quaternion x, y, z, w.
    #[serde(default, deserialize_with = "single_range", skip_serializing_if = "Option::is_none")]
    pub(crate) rotation: Option<[f64; 4]>,
    /// Scale factors.
    #[serde(default, deserialize_with = "single_range", skip_serializing_if = "Option::is_none")]
    pub(crate) scale: Option<[f64; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) extensions: Option<json::extensions::scene::Node>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) extras: Extras,
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
