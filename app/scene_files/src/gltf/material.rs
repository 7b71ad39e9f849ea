//! Materials: the diffuse part of glTF's metallic–roughness model, and the fields for mirrors and clear glass.

use std::collections::HashSet;

use ::gltf::json;
use ::gltf::json::material::AlphaMode;
use ::gltf::json::validation::Checked;
use glam::{Mat2, Vec2};

use super::document::Document;
use super::notices::{Notices, Part};
use super::spectrum::SpectrumReader;
use super::specular::SpecularSurface;
use scene::{Alpha, Material};

/// Attenuation distance, metres, from which on a volume absorbs no light. glTF's default is infinity, which JSON cannot
/// write; `export` writes this number.
pub(crate) const NO_ABSORPTION: f32 = f32::MAX;

/// Source of a mesh's texture coordinates: a set and a transform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct UvChannel {
    /// Number n of the set `TEXCOORD_n`.
    pub(super) set: u32,
    linear: Mat2,
    offset: Vec2,
}

impl UvChannel {
    const FIRST: Self = Self { set: 0, linear: Mat2::IDENTITY, offset: Vec2::ZERO };

    fn of(texture: &json::texture::Info) -> Self {
        let transform = texture.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
        let Some(transform) = transform else {
            return Self { set: texture.tex_coord, ..Self::FIRST };
        };
        // The v axis points down, so a counter-clockwise turn by φ takes u to (cos φ, −sin φ).
        let turn = Mat2::from_angle(-transform.rotation.0);
        Self {
            set: transform.tex_coord.unwrap_or(texture.tex_coord),
            linear: turn * Mat2::from_diagonal(Vec2::from_array(transform.scale.0)),
            offset: Vec2::from_array(transform.offset.0),
        }
    }

    pub(super) fn apply(self, uv: Vec2) -> Vec2 {
        self.linear * uv + self.offset
    }
}

/// Sources of texture coordinates of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SurfaceUvs {
    /// Source for the base colour, and for the emission if it has none of its own.
    pub(super) base: UvChannel,
    /// Source for the emission, if it is another.
    pub(super) emissive: Option<UvChannel>,
}

/// Materials of the file, then the default one, each with its sources of texture coordinates.
///
/// Texture indices are still those of the file; `picture::textures` replaces them.
pub(super) fn materials(
    document: &Document<'_>,
    spectra: &mut SpectrumReader<'_>,
    notices: &mut Notices,
) -> (Vec<Material>, Vec<SurfaceUvs>) {
    let mut materials = Vec::new();
    let mut channels = Vec::new();
    for (index, material) in document.json.materials.iter().enumerate() {
        let (material, channel) = read(index, material, spectra, notices);
        materials.push(material);
        channels.push(channel);
    }
    if uses_default(document) {
        materials.push(Material { name: "default".into(), ..Material::default() });
        channels.push(SurfaceUvs { base: UvChannel::FIRST, emissive: None });
    }
    (materials, channels)
}

/// True if a primitive has no material, or one that does not exist.
fn uses_default(document: &Document<'_>) -> bool {
    let count = document.json.materials.len();
    let mut primitives = document.json.meshes.iter().flat_map(|mesh| &mesh.primitives);
    primitives.any(|primitive| primitive.material.is_none_or(|material| material.value() >= count))
}

fn read(
    index: usize,
    material: &json::Material,
    spectra: &mut SpectrumReader<'_>,
    notices: &mut Notices,
) -> (Material, SurfaceUvs) {
    let place = format!("materials[{index}]");
    let surface = &material.pbr_metallic_roughness;
    // Specular-glossiness, where a file has it, is what the surface was made with; the rest is a fallback.
    let specular = material.extensions.as_ref().and_then(|extensions| extensions.pbr_specular_glossiness.as_ref());
    let extensions = material.extensions.as_ref();
    let strength = extensions.and_then(|extensions| extensions.emissive_strength.as_ref());
    let strength = strength.map_or(1.0, |extension| extension.emissive_strength.0);
    let mode = match material.alpha_mode {
        Checked::Valid(mode) => mode,
        Checked::Invalid => {
            notices.left_out(Part::Material, &format!("{place}.alphaMode"), "it is none of OPAQUE, MASK, BLEND");
            AlphaMode::Opaque
        }
    };
    let specular = specular.map(|specular| SpecularSurface::of(specular, mode == AlphaMode::Opaque, notices));
    let base_texture = specular.map_or(surface.base_color_texture.as_ref(), |specular| specular.texture);
    let name = material.name.clone().unwrap_or_else(|| format!("material {index}"));
    let rough = surface.metallic_roughness_texture.is_some();
    let factor = |factor: f32| if factor.is_finite() { factor.clamp(0.0, 1.0) } else { 0.0 };
    let transmission = extensions.and_then(|extensions| extensions.transmission.as_ref());
    let index = extensions.and_then(|extensions| extensions.ior.as_ref()).map_or(1.5, |extension| extension.ior.0);
    let volume = extensions.and_then(|extensions| extensions.volume.as_ref());
    if volume.is_some_and(|volume| volume.attenuation_distance.0 < NO_ABSORPTION) {
        notices.add(format!("the glass of material \"{}\" does not absorb light on its way", name));
    }
    let mut read = Material {
        spectrum: spectra.of_extras(&material.extras, &format!("{place} \"{name}\"")),
        name,
        base_colour: specular.map_or(surface.base_color_factor.0, |specular| specular.base),
        base_colour_texture: base_texture.map(|texture| texture.index.value()),
        emissive: material.emissive_factor.0.map(|factor| factor * strength),
        emissive_texture: material.emissive_texture.as_ref().map(|texture| texture.index.value()),
        unlit: extensions.is_some_and(|extensions| extensions.unlit.is_some()),
        double_sided: material.double_sided,
        metallic: specular.map_or_else(|| factor(surface.metallic_factor.0), |specular| specular.metallic),
        // A roughness map gives the smooth places, but it is not drawn, so no part of the surface is a mirror.
        roughness: match specular {
            Some(specular) => specular.roughness,
            None if rough => 1.0,
            None => factor(surface.roughness_factor.0),
        },
        // The value 0 in glTF stands for a metal in another material model.
        index_of_refraction: if index >= 1.0 && index.is_finite() { index } else { 1.5 },
        transmission: transmission.map_or(0.0, |extension| factor(extension.transmission_factor.0)),
        solid_glass: volume.is_some_and(|volume| volume.thickness_factor.0 > 0.0),
        alpha: match mode {
            AlphaMode::Opaque => Alpha::Opaque,
            AlphaMode::Mask => Alpha::Mask(material.alpha_cutoff.map_or(0.5, |cutoff| cutoff.0)),
            AlphaMode::Blend => Alpha::Blend,
        },
    };
    let numbers = read.base_colour.iter().chain(&read.emissive);
    if !numbers.copied().all(f32::is_finite) {
        notices.left_out(Part::Material, &place, "its colours are beyond all numbers");
        (read.base_colour, read.emissive) = ([1.0; 4], [0.0; 3]);
    }
    let [base, emissive] = [base_texture, material.emissive_texture.as_ref()].map(|texture| texture.map(UvChannel::of));
    let uvs = SurfaceUvs {
        base: base.or(emissive).unwrap_or(UvChannel::FIRST),
        emissive: emissive.filter(|emissive| base.is_some_and(|base| base != *emissive)),
    };
    (read, uvs)
}

/// Indices of the file's textures that any material draws.
pub(super) fn textures_used(materials: &[Material]) -> HashSet<usize> {
    materials.iter().flat_map(|material| [material.base_colour_texture, material.emissive_texture]).flatten().collect()
}
