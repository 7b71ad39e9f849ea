//! Light: the sun of `KHR_lights_punctual`, and what `extras.rapidity.light` says instead of it or beyond it.
//!
//! The first directional light that stands in the scene is the sun. As in other viewers its intensity E, in lux, makes a white surface
//! that faces it send out E/π: light of π lux and the colour 1 shows white as white. There is no lamp nearby in this program, whose only
//! light comes from infinity; point and spot lights are named in a notice.

use ::gltf::json::extensions::scene::khr_lights_punctual::{Light, Type};
use ::gltf::json::validation::Checked;
use glam::DVec3;
use physics::colour::Spectrum;

use super::container::Document;
use super::extras::SceneExtras;
use super::nodes::Placement;
use super::spectrum::{Spectra, in_extras};
use super::{GltfError, Notices};
use crate::scene::Lighting;

/// The file's light, and its spectrum if it has one.
pub(super) fn lighting(
    document: &Document,
    scene: Option<usize>,
    extras: &SceneExtras,
    placements: &[Placement],
    spectra: &mut Spectra<'_>,
    notices: &mut Notices,
) -> Result<(Lighting, Option<Spectrum>), GltfError> {
    let sun = sun(document, placements, spectra, notices)?;
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
    Ok((lighting, illuminant))
}

struct Sun {
    direction: DVec3,
    colour: [f32; 3],
    spectrum: Option<Spectrum>,
}

fn sun(
    document: &Document,
    placements: &[Placement],
    spectra: &mut Spectra<'_>,
    notices: &mut Notices,
) -> Result<Option<Sun>, GltfError> {
    // Every light's spectrum is looked at, whether it shines or not: a mistake is a mistake.
    let lights = lights(document);
    let own: Vec<_> = lights
        .iter()
        .enumerate()
        .map(|(index, light)| spectra.of_extras(&light.extras, &owner(index, light)))
        .collect();
    let mut sun = None;
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
        if kind != Type::Directional {
            let kind = if kind == Type::Point { "point" } else { "spot" };
            notices.add(format!("the {kind} light \"{name}\" does not shine: only directional lights do"));
        } else if sun.is_some() {
            notices.add(format!("the directional light \"{name}\" does not shine: there is one sun, the first"));
        } else {
            let colour = light.color.map(|channel| channel * light.intensity / std::f32::consts::PI);
            if !colour.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
                return Err(
                    document.damaged(&place, "its colour times its intensity is negative or beyond all numbers")
                );
            }
            let Some(direction) = (placement.transform.matrix3 * DVec3::Z).try_normalize() else {
                return Err(document.damaged(&format!("nodes[{node}]"), "its light has no direction"));
            };
            sun = Some(Sun { direction, colour, spectrum: of_node.or_else(|| own[index].clone()) });
        }
    }
    Ok(sun)
}

fn lights(document: &Document) -> &[Light] {
    let extensions = document.json.extensions.as_ref();
    extensions.and_then(|extensions| extensions.khr_lights_punctual.as_ref()).map_or(&[], |lights| &lights.lights)
}

fn owner(index: usize, light: &Light) -> String {
    let name = light.name.as_ref().map(|name| format!(" \"{name}\"")).unwrap_or_default();
    format!("lights[{index}]{name}")
}

/// A spectrum on a node that is no light would be lost silently.
fn refuse_spectra_of_other_nodes(document: &Document, spectra: &mut Spectra<'_>) {
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
