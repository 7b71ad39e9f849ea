//! Light: the sun of `KHR_lights_punctual`, and `extras.rapidity.light`, which replaces or extends it.
//!
//! The first directional light that stands in the scene is the sun. As in other viewers its intensity E, in lux,
//! makes a white surface that faces it send out E/π: light of π lux and the colour 1 shows white as white. Point and
//! spot lights at rest are lamps, I candela of which give I lux at one metre; only the ray tracer draws them, and a
//! notice says so.

use ::gltf::json::extensions::scene::khr_lights_punctual::{Light, Type};
use ::gltf::json::validation::Checked;
use glam::DVec3;
use physics::colour::Spectrum;
use std::f32::consts::PI;
use std::f64::consts::FRAC_PI_2;

use super::container::Document;
use super::error::GltfError;
use super::extras::SceneExtras;
use super::nodes::NodePlacement;
use super::notices::Notices;
use super::spectrum::{SpectrumReader, in_extras};
use scene::{Lamp, Lighting, Spot};

/// Light of a scene.
pub(super) struct Lights {
    /// Light of sun and sky.
    pub(super) lighting: Lighting,
    /// Spectrum of sun and sky, if they have one.
    pub(super) illuminant: Option<Spectrum>,
    /// Point and spot lights at rest.
    pub(super) lamps: Vec<Lamp>,
}

/// Reads the file's light.
pub(super) fn lighting(
    document: &Document,
    scene: Option<usize>,
    extras: &SceneExtras,
    placements: &[NodePlacement],
    spectra: &mut SpectrumReader<'_>,
    notices: &mut Notices,
) -> Result<Lights, GltfError> {
    let (sun, lamps) = sun_and_lamps(document, placements, spectra, notices)?;
    refuse_spectra_of_other_nodes(document, spectra);
    let mut lighting = Lighting::default();
    let mut illuminant = None;
    if let Some(sun) = sun {
        (lighting.sun_direction, lighting.sun) = (sun.direction.as_vec3(), sun.colour);
        illuminant = sun.spectrum;
    }
    extras.light.apply(&mut lighting);
    if let (Some(value), Some(scene)) = (&extras.light.spectrum, scene) {
        illuminant = spectra.read(value, &format!("scenes[{scene}]"), "extras.rapidity.light.spectrum");
    }
    Ok(Lights { lighting, illuminant, lamps })
}

struct Sun {
    direction: DVec3,
    colour: [f32; 3],
    spectrum: Option<Spectrum>,
}

fn sun_and_lamps(
    document: &Document,
    placements: &[NodePlacement],
    spectra: &mut SpectrumReader<'_>,
    notices: &mut Notices,
) -> Result<(Option<Sun>, Vec<Lamp>), GltfError> {
    // Every light's spectrum is checked, even if the light does not shine, so that every mistake is reported.
    let lights = lights(document);
    let own: Vec<_> = lights
        .iter()
        .enumerate()
        .map(|(index, light)| spectra.of_extras(&light.extras, &owner(index, light)))
        .collect();
    let (mut sun, mut lamps) = (None, Vec::new());
    for placement in placements {
        let Some(index) = placement.light else {
            continue;
        };
        let node = placement.node;
        let light = document.item(lights, index, &format!("nodes[{node}].extensions.KHR_lights_punctual.light"))?;
        let place = format!("extensions.KHR_lights_punctual.lights[{index}]");
        let of_node = spectra.of_extras(&document.json.nodes[node].extras, &format!("nodes[{node}]"));
        let name = light.name.as_deref().unwrap_or("without a name");
        let Checked::Valid(kind) = light.type_ else {
            return Err(document.damaged(&format!("{place}.type"), "it is none of directional, point, spot"));
        };
        let colour = light.color.map(|channel| channel * light.intensity / PI);
        if !colour.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
            return Err(document.damaged(&place, "its colour times its intensity is negative or beyond all numbers"));
        }
        let direction = || {
            let direction = (placement.transform.matrix3 * DVec3::Z).try_normalize();
            direction.ok_or_else(|| document.damaged(&format!("nodes[{node}]"), "its light has no direction"))
        };
        let spectrum = of_node.or_else(|| own[index].clone());
        if kind != Type::Directional {
            let kind = if kind == Type::Point { "point" } else { "spot" };
            if placement.motion.is_some() {
                notices.add(format!("the {kind} light \"{name}\" moves and does not shine: only lamps at rest do"));
                continue;
            }
            notices.add(format!("the {kind} light \"{name}\" shines in pictures by --renderer raytrace only"));
            let spot = light.spot.as_ref().map(|spot| -> Result<Spot, GltfError> {
                let outer_rad = f64::from(spot.outer_cone_angle).clamp(0.0, FRAC_PI_2);
                let inner_rad = f64::from(spot.inner_cone_angle).clamp(0.0, outer_rad);
                Ok(Spot { direction: -direction()?, inner_rad, outer_rad })
            });
            lamps.push(Lamp {
                name: name.to_owned(),
                position: placement.transform.translation,
                colour,
                range: light.range.map(f64::from).filter(|range| *range > 0.0),
                spot: spot.transpose()?,
                spectrum,
            });
        } else if sun.is_some() {
            notices.add(format!("the directional light \"{name}\" does not shine: there is one sun, the first"));
        } else {
            sun = Some(Sun { direction: direction()?, colour, spectrum });
        }
    }
    Ok((sun, lamps))
}

fn lights(document: &Document) -> &[Light] {
    let extensions = document.json.extensions.as_ref();
    extensions.and_then(|extensions| extensions.khr_lights_punctual.as_ref()).map_or(&[], |lights| &lights.lights)
}

fn owner(index: usize, light: &Light) -> String {
    let name = light.name.as_ref().map(|name| format!(" \"{name}\"")).unwrap_or_default();
    format!("lights[{index}]{name}")
}

/// Refuses spectra on nodes that are not lights, which would otherwise be lost silently.
fn refuse_spectra_of_other_nodes(document: &Document, spectra: &mut SpectrumReader<'_>) {
    for (index, node) in document.json.nodes.iter().enumerate() {
        let light = node.extensions.as_ref().is_some_and(|extensions| extensions.khr_lights_punctual.is_some());
        if !light && in_extras(&node.extras).is_some() {
            let name = node.name.as_ref().map(|name| format!(" \"{name}\"")).unwrap_or_default();
            let fault =
                "this node bears no light; give the spectrum to a material, or to a light of KHR_lights_punctual";
            spectra.refuse(&format!("nodes[{index}]{name}"), "extras.spectrum", fault);
        }
    }
}
