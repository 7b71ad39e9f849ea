//! Check that glTF can express the values of a scene.

use super::error::ExportError;
use panoramas::is_equirectangular;
use scene::{Alpha, Scene};

/// Refuses values that glTF cannot express.
pub fn check_values(scene: &Scene) -> Result<(), ExportError> {
    let ensure = |holds: bool, what, name: &str, fault| {
        if holds { Ok(()) } else { Err(ExportError::Value { what, name: name.into(), fault }) }
    };
    const FINITE: &str = "it is not finite";
    let name = &scene.name;
    ensure(scene.origin.is_finite(), "the origin", name, FINITE)?;
    ensure(scene.start.position.is_finite() && scene.start.look.is_finite(), "the start", name, FINITE)?;
    ensure(scene.circuit.iter().all(|point| point.is_finite()), "the circuit", name, FINITE)?;
    let light = &scene.light;
    let light = [light.sun_direction.to_array(), light.sun, light.sky, light.ground, light.zenith, light.horizon];
    ensure(light.as_flattened().iter().all(|value| value.is_finite()), "the light", name, FINITE)?;
    if let Some(panorama) = &scene.panorama {
        let light = panorama.rgb.as_flattened().iter().all(|value| (0.0..f32::INFINITY).contains(&value.to_f32()));
        ensure(light, "the panorama", name, "it has a radiance that is negative or not finite")?;
        let around = is_equirectangular(panorama.width, panorama.height);
        ensure(around, "the panorama", name, "it is not twice as wide as high")?;
    }
    for texture in &scene.textures {
        ensure(!texture.rgba.is_empty(), "a picture", &texture.name, "it has no pixels")?;
    }
    for material in &scene.materials {
        let fraction = |value: &f32| (0.0..=1.0).contains(value);
        let name = &material.name;
        ensure(material.base_colour.iter().all(fraction), "the base colour", name, "it is not within 0…1")?;
        // The limit is half the largest f32, so that there is a power of two above it.
        let emissive = (material.emissive.iter()).all(|value| (0.0..=f32::MAX / 2.0).contains(value));
        ensure(emissive, "the emission", name, "it is negative or too large")?;
        let cutoff = !matches!(material.alpha, Alpha::Mask(cutoff) if !(cutoff.is_finite() && cutoff >= 0.0));
        ensure(cutoff, "the opacity threshold", name, "it is negative or not finite")?;
    }
    for lamp in &scene.lamps {
        let colour = lamp.colour.iter().all(|value| value.is_finite() && *value >= 0.0);
        ensure(lamp.position.is_finite() && colour, "a lamp", &lamp.name, "it is not finite")?;
    }
    for mesh in &scene.meshes {
        ensure(mesh.positions.iter().all(|position| position.is_finite()), "a position", &mesh.name, FINITE)?;
        ensure(mesh.normals.iter().all(|normal| normal.is_finite()), "a normal", &mesh.name, FINITE)?;
        ensure(mesh.uvs.iter().all(|uv| uv.is_finite()), "a texture coordinate", &mesh.name, FINITE)?;
        let colours = mesh.colours.as_flattened().iter().all(|value| value.is_finite() && *value >= 0.0);
        ensure(colours, "a vertex colour", &mesh.name, "it is negative or not finite")?;
    }
    Ok(())
}
