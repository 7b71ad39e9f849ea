//! Materials as glTF.

use ::gltf::json::extensions::material::{
    AttenuationDistance, EmissiveStrength, EmissiveStrengthFactor, IndexOfRefraction, Ior, ThicknessFactor,
    Transmission, TransmissionFactor, Unlit, Volume,
};
use ::gltf::json::material::{
    AlphaCutoff, AlphaMode, EmissiveFactor, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor,
};
use ::gltf::json::texture::Info;
use ::gltf::json::validation::Checked;
use ::gltf::json::{self, Index};

use crate::gltf::material::NO_ABSORPTION;
use crate::gltf::spectrum;
use scene::{Alpha, Material};

/// Index of refraction that glTF assumes.
const DEFAULT_INDEX: f32 = 1.5;

/// Smallest power of two that is at least the emission and at least 1.
fn emissive_strength(material: &Material) -> f32 {
    let largest = material.emissive.into_iter().fold(1.0, f32::max);
    let power = largest.log2().ceil().exp2();
    if power < largest { 2.0 * power } else { power }
}

/// Material as glTF.
pub fn material(material: &Material) -> json::Material {
    let strength = emissive_strength(material);
    let (alpha_mode, alpha_cutoff) = match material.alpha {
        Alpha::Opaque => (AlphaMode::Opaque, None),
        Alpha::Mask(cutoff) => (AlphaMode::Mask, Some(AlphaCutoff(cutoff))),
        Alpha::Blend => (AlphaMode::Blend, None),
    };
    json::Material {
        name: Some(material.name.clone()),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor(material.base_colour),
            base_color_texture: material.base_colour_texture.map(texture),
            metallic_factor: StrengthFactor(material.metallic),
            roughness_factor: StrengthFactor(material.roughness),
            ..Default::default()
        },
        emissive_factor: EmissiveFactor(material.emissive.map(|value| value / strength)),
        emissive_texture: material.emissive_texture.map(texture),
        double_sided: material.double_sided,
        alpha_mode: Checked::Valid(alpha_mode),
        alpha_cutoff,
        extensions: extensions(material),
        extras: material.spectrum.as_ref().and_then(spectrum::to_extras),
        ..Default::default()
    }
}

fn texture(index: usize) -> Info {
    Info { index: Index::new(index as u32), tex_coord: 0, extensions: None, extras: None }
}

/// Extensions of a material, each only if its value is not glTF's default.
fn extensions(material: &Material) -> Option<json::extensions::material::Material> {
    let strength = emissive_strength(material);
    let emissive_strength = EmissiveStrength { emissive_strength: EmissiveStrengthFactor(strength) };
    let transmission_factor = TransmissionFactor(material.transmission);
    let transmission = Transmission { transmission_factor, ..Default::default() };
    let ior = Ior { ior: IndexOfRefraction(material.index_of_refraction), ..Default::default() };
    let volume = Volume {
        thickness_factor: ThicknessFactor(1.0),
        attenuation_distance: AttenuationDistance(NO_ABSORPTION),
        ..Default::default()
    };
    let extensions = json::extensions::material::Material {
        unlit: material.unlit.then_some(Unlit {}),
        emissive_strength: (strength > 1.0).then_some(emissive_strength),
        transmission: (material.transmission > 0.0).then_some(transmission),
        ior: (material.index_of_refraction != DEFAULT_INDEX).then_some(ior),
        volume: material.solid_glass.then_some(volume),
        ..Default::default()
    };
    (!extensions_of(&extensions).is_empty()).then_some(extensions)
}

/// Names of the extensions that are present.
pub fn extensions_of(extensions: &json::extensions::material::Material) -> Vec<&'static str> {
    let names = [
        (extensions.unlit.is_some(), "KHR_materials_unlit"),
        (extensions.emissive_strength.is_some(), "KHR_materials_emissive_strength"),
        (extensions.transmission.is_some(), "KHR_materials_transmission"),
        (extensions.ior.is_some(), "KHR_materials_ior"),
        (extensions.volume.is_some(), "KHR_materials_volume"),
    ];
    names.into_iter().filter_map(|(used, name)| used.then_some(name)).collect()
}
