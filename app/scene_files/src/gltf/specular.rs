//! Specular-glossiness surfaces in the form of metallic-roughness ones.
//!
//! A metal of `KHR_materials_pbrSpecularGlossiness` has no diffuse colour, and its specular one is its colour. Factors
//! are converted as the extension's authors do (Khronos, "PBR utilities", `solveMetallic`); of pictures, either the
//! diffuse one is drawn, or the specular one where nothing is diffuse.

use ::gltf::json::extensions::material::PbrSpecularGlossiness;
use ::gltf::json::texture::Info;

use super::notices::Notices;

/// Specular reflectance of a surface that is no metal.
const DIELECTRIC: f32 = 0.04;

/// Specular factor of a file that names none; it says nothing of the surface's matter.
const UNNAMED: [f32; 3] = [1.0; 3];

/// Surface in the form of metallic-roughness.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpecularSurface<'a> {
    /// Linear base colour, and opacity.
    pub(super) base: [f32; 4],
    /// Texture of the base colour.
    pub(super) texture: Option<&'a Info>,
    /// Share of metal, 0 to 1.
    pub(super) metallic: f32,
    /// Roughness, 0 to 1.
    pub(super) roughness: f32,
}

impl<'a> SpecularSurface<'a> {
    /// Converts a surface; `opaque` if its opacity is ignored.
    pub(super) fn of(of: &'a PbrSpecularGlossiness, opaque: bool, notices: &mut Notices) -> Self {
        let [red, green, blue, alpha] = of.diffuse_factor.0;
        let (diffuse, specular) = ([red, green, blue], of.specular_factor.0);
        let map = of.specular_glossiness_texture.as_ref();
        let roughness = if map.is_some() { 1.0 } else { 1.0 - unit(of.glossiness_factor.0) };
        let plain = Self { base: of.diffuse_factor.0, texture: of.diffuse_texture.as_ref(), metallic: 0.0, roughness };
        let metal = diffuse.iter().all(|factor| *factor <= 0.0) && specular.iter().any(|factor| *factor > DIELECTRIC);
        match (&of.diffuse_texture, map) {
            // The opacity of the diffuse picture would be lost, and that of the specular one is glossiness.
            (Some(_), _) | (None, Some(_)) if metal && (opaque || map.is_none() && of.diffuse_texture.is_none()) => {
                let [red, green, blue] = specular;
                Self { base: [red, green, blue, alpha], texture: map, metallic: 1.0, ..plain }
            }
            (None, None) if metal || specular != UNNAMED => {
                let (colour, metallic) = converted(diffuse, specular);
                let [red, green, blue] = colour;
                Self { base: [red, green, blue, alpha], metallic, ..plain }
            }
            (_, Some(_)) => {
                notices.add("specular colours are not drawn where a map has them: metals are dark".into());
                plain
            }
            (Some(_), None) | (None, None) => plain,
        }
    }
}

fn unit(factor: f32) -> f32 {
    if factor.is_finite() { factor.clamp(0.0, 1.0) } else { 0.0 }
}

/// Brightness as the eye has it, of a linear colour.
fn brightness([red, green, blue]: [f32; 3]) -> f32 {
    (0.299 * red * red + 0.587 * green * green + 0.114 * blue * blue).sqrt()
}

/// Base colour and share of metal of a diffuse and a specular colour.
fn converted(diffuse: [f32; 3], specular: [f32; 3]) -> ([f32; 3], f32) {
    let (diffuse, specular) = (diffuse.map(unit), specular.map(unit));
    let strongest = specular.into_iter().fold(0.0, f32::max);
    let metallic = metallic(brightness(diffuse), brightness(specular), 1.0 - strongest);
    let of_diffuse = |value: f32| value * (1.0 - strongest) / (1.0 - DIELECTRIC) / (1.0 - metallic).max(1e-6);
    let of_specular = |value: f32| (value - DIELECTRIC * (1.0 - metallic)) / metallic.max(1e-6);
    let mut base = diffuse;
    if metallic > 0.0 {
        let share = metallic * metallic;
        for (base, specular) in base.iter_mut().zip(specular) {
            *base = unit(of_diffuse(*base) * (1.0 - share) + of_specular(specular) * share);
        }
    }
    (base, metallic)
}

/// Share of metal with which a surface reflects as much: the root of a quadratic equation.
fn metallic(diffuse: f32, specular: f32, not_reflected: f32) -> f32 {
    if specular < DIELECTRIC {
        return 0.0;
    }
    let b = diffuse * not_reflected / (1.0 - DIELECTRIC) + specular - 2.0 * DIELECTRIC;
    let c = DIELECTRIC - specular;
    unit((-b + (b * b - 4.0 * DIELECTRIC * c).max(0.0).sqrt()) / (2.0 * DIELECTRIC))
}

#[cfg(test)]
mod tests {
    //! Law: a surface of known matter keeps its colour: a metal that of its mirror, any other its diffuse one.

    use super::*;

    #[test]
    fn a_metal_has_the_colour_of_its_mirror() {
        let gold = [1.0, 0.76, 0.33];
        let (colour, metallic) = converted([0.0; 3], gold);
        assert!(metallic > 0.99, "{metallic}");
        assert!(colour.iter().zip(gold).all(|(a, b)| (a - b).abs() < 0.01), "{colour:?}");
    }

    #[test]
    fn what_is_no_metal_keeps_its_diffuse_colour() {
        for specular in [[0.0; 3], [DIELECTRIC - 0.001; 3]] {
            assert_eq!(converted([0.5, 0.1, 0.2], specular), ([0.5, 0.1, 0.2], 0.0));
        }
        let (colour, metallic) = converted([0.5, 0.1, 0.2], [DIELECTRIC + 0.01; 3]);
        assert!(metallic < 0.1 && (colour[0] - 0.5).abs() < 0.05, "{colour:?}, {metallic}");
    }
}
