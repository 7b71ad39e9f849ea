//! Surfaces and the pictures on them.

use physics::colour::Spectrum;

/// How a surface sends out light in the world frame (glTF's metallic–roughness model, diffuse part).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// From the file, for messages.
    pub name: String,
    /// Linear factor of the base colour, and opacity.
    pub base_colour: [f32; 4],
    /// Index into [`Scene::textures`]; its colour multiplies the factor.
    pub base_colour_texture: Option<usize>,
    /// Linear radiance sent out on its own.
    pub emissive: [f32; 3],
    /// Index into [`Scene::textures`]; its colour multiplies `emissive`.
    pub emissive_texture: Option<usize>,
    /// The base colour is the radiance itself: no light falls on it (KHR_materials_unlit).
    pub unlit: bool,
    /// Drawn from behind as well.
    pub double_sided: bool,
    /// How much of it is metal, 0 to 1. This and all up to `alpha` the ray tracer alone draws, where it is to follow mirrors.
    pub metallic: f32,
    /// 0 is a mirror, 1 quite rough.
    pub roughness: f32,
    /// Of what lies behind the surface (KHR_materials_ior); 1 or more.
    pub index_of_refraction: f32,
    /// Share of the light that enters and goes through (KHR_materials_transmission), 0 to 1.
    pub transmission: f32,
    /// Whether what goes through is bent, by a volume behind the surface (KHR_materials_volume), and not by a thin pane.
    pub solid_glass: bool,
    /// What the opacity does.
    pub alpha: Alpha,
    /// Instead of colours: on an unlit or emissive material the radiance sent out, on any other the reflectance, times the base
    /// colour's luminance.
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
    /// Whether the spectrum is of light that the material sends out, not of what it returns.
    pub fn is_source(&self) -> bool {
        self.unlit || self.emissive != [0.0; 3]
    }
}

/// What a material's opacity does (glTF `alphaMode`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Alpha {
    /// Ignored.
    #[default]
    Opaque,
    /// Below the threshold a fragment is not drawn.
    Mask(f32),
    /// Mixed with what lies behind.
    Blend,
}

/// A picture on a surface: 8-bit sRGB with straight alpha, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// From the file, for messages.
    pub name: String,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width * height` times four bytes: R, G, B, A.
    pub rgba: Vec<u8>,
    /// Beyond 0…1 along u, along v.
    pub wrap: [Wrap; 2],
    /// Sampled without filtering when magnified.
    pub nearest: bool,
}

/// What a texture shows beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// Itself again.
    #[default]
    Repeat,
    /// Its mirror image.
    Mirror,
    /// Its border pixels.
    Clamp,
}
