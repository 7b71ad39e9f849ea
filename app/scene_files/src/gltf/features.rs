//! Features of a file: extensions that are drawn, and notices about what is not.

use std::collections::BTreeSet;

use super::document::Document;
use super::notices::Notices;

/// Extensions that are drawn, or that need no drawing.
const EXTENSIONS: [&str; 19] = [
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_lod",
];

/// Adds a notice for every feature that the file uses and that is not drawn.
pub(super) fn note_undrawn(document: &Document<'_>, notices: &mut Notices) {
    let json = &document.json;
    let named = json.extensions_used.iter().chain(&json.extensions_required).collect::<BTreeSet<_>>();
    for name in named.into_iter().filter(|name| !EXTENSIONS.contains(&name.as_str())) {
        let required = if json.extensions_required.contains(name) { ", though the file requires it" } else { "" };
        notices.add(format!("the extension {name} is not drawn{required}"));
    }
    let mut count = |number: usize, sentence: &str| (0..number).for_each(|_| notices.add(sentence.into()));
    if !json.animations.is_empty() {
        count(json.skins.len(), "skins do not move: they are drawn in their pose at the start");
    }
    let materials = || json.materials.iter();
    let glass = materials().filter(|material| {
        let extensions = material.extensions.as_ref().and_then(|extensions| extensions.transmission.as_ref());
        extensions.is_some_and(|extension| extension.transmission_factor.0 > 0.0)
    });
    count(glass.count(), "clear glass is opaque, except in pictures by --renderer raytrace --bounces");
    count(materials().filter(|material| material.normal_texture.is_some()).count(), "normal maps are not drawn");
    count(materials().filter(|material| material.occlusion_texture.is_some()).count(), "occlusion maps are not drawn");
    let metallic = materials().filter(|material| material.pbr_metallic_roughness.metallic_roughness_texture.is_some());
    count(metallic.count(), "metallic-roughness maps are not drawn");
}
