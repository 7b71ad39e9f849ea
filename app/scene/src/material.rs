//! Surfaces and the pictures on them.

use physics::colour::Spectrum;
use std::sync::Arc;

/// Surface and how it sends out light in the world frame (glTF's metallic–roughness model, diffuse part).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name from the file, for messages.
    pub name: String,
    /// Linear factor of the base colour, and opacity.
    pub base_colour: [f32; 4],
    /// Index into [`Scene::textures`](crate::Scene::textures); its colour multiplies the factor.
    pub base_colour_texture: Option<usize>,
    /// Linear radiance that the surface emits.
    pub emissive: [f32; 3],
    /// Index into [`Scene::textures`](crate::Scene::textures); its colour multiplies `emissive`.
    pub emissive_texture: Option<usize>,
    /// True if the base colour is the radiance itself and no light falls on the surface (KHR_materials_unlit).
    pub unlit: bool,
    /// True if the surface is drawn from behind as well.
    pub double_sided: bool,
    /// Share of metal in the surface, 0 to 1. Only the ray tracer draws this and the fields up to `alpha`, and only
    /// when it follows mirrors.
    pub metallic: f32,
    /// Roughness of the surface: 0 for a mirror, 1 for a quite rough surface.
    pub roughness: f32,
    /// Refractive index of the matter behind the surface (KHR_materials_ior); 1 or more.
    pub index_of_refraction: f32,
    /// Share of the entering light that is transmitted (KHR_materials_transmission), 0 to 1.
    pub transmission: f32,
    /// True if a volume behind the surface (KHR_materials_volume) bends the transmitted light; false for a thin pane.
    pub solid_glass: bool,
    /// Treatment of the opacity.
    pub alpha: Alpha,
    /// Spectrum that replaces the colours: the emitted radiance of an unlit or emissive material, the reflectance of
    /// any other, times the base colour's luminance.
    pub spectrum: Option<Spectrum>,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_colour: [1.0; 4],
            base_colour_texture: None,
            emissive: [0.0; 3],
            emissive_texture: None,
            unlit: false,
            double_sided: false,
            metallic: 0.0,
            roughness: 1.0,
            index_of_refraction: 1.5,
            transmission: 0.0,
            solid_glass: false,
            alpha: Alpha::Opaque,
            spectrum: None,
        }
    }
}

impl Material {
    /// True if the spectrum is that of emitted light, false if it is a reflectance.
    pub fn is_source(&self) -> bool {
        self.unlit || self.emissive != [0.0; 3]
    }
}

/// Treatment of a material's opacity (glTF `alphaMode`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Alpha {
    /// Opacity is ignored.
    #[default]
    Opaque,
    /// Fragments with an opacity below this threshold are not drawn.
    Mask(f32),
    /// Surface is mixed with the things behind it.
    Blend,
}

/// Texture of a surface: 8-bit sRGB with straight alpha, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Name from the file, for messages.
    pub name: String,
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Pixels: `width * height` times four bytes, R, G, B, A. Textures with the same picture share them.
    pub rgba: Arc<Vec<u8>>,
    /// Continuation beyond 0…1 along u and along v.
    pub wrap: [Wrap; 2],
    /// True if the texture is sampled without filtering when magnified.
    pub nearest: bool,
}

/// Continuation of a texture beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// Texture repeats.
    #[default]
    Repeat,
    /// Texture repeats, mirrored every other time.
    Mirror,
    /// Border pixels continue.
    Clamp,
}
