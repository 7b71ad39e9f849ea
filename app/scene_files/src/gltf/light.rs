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

use super::document::Document;
use super::error::GltfError;
use super::extras::{OwnExtras, SceneExtras};
use super::nodes::NodePlacement;
use super::notices::{Notices, Part};
use super::spectrum::SpectrumReader;
use super::start_pose::at_start;
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
    document: &Document<'_>,
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

/// Light source of any kind.
enum Source {
    Sun(Sun),
    Lamp(Lamp),
}

/// Light of the file, given with its number, as it stands in the scene.
fn source(
    document: &Document<'_>,
    (light, index): (&Light, usize),
    placement: &NodePlacement,
    spectrum: Option<Spectrum>,
) -> Result<Source, GltfError> {
    let place = format!("extensions.KHR_lights_punctual.lights[{index}]");
    let Checked::Valid(kind) = light.type_ else {
        return Err(document.damaged(&format!("{place}.type"), "it is none of directional, point, spot"));
    };
    let colour = light.color.map(|channel| channel * light.intensity / PI);
    if !colour.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
        return Err(document.damaged(&place, "its colour times its intensity is negative or beyond all numbers"));
    }
    let direction = || {
        let direction = (at_start(placement).matrix3 * DVec3::Z).try_normalize();
        direction.ok_or_else(|| document.damaged(&format!("nodes[{}]", placement.node), "its light has no direction"))
    };
    if kind == Type::Directional {
        return Ok(Source::Sun(Sun { direction: direction()?, colour, spectrum }));
    }
    let spot = light.spot.as_ref().filter(|_| kind == Type::Spot).map(|spot| -> Result<Spot, GltfError> {
        let outer_rad = f64::from(spot.outer_cone_angle).clamp(0.0, FRAC_PI_2);
        let inner_rad = f64::from(spot.inner_cone_angle).clamp(0.0, outer_rad);
        Ok(Spot { direction: -direction()?, inner_rad, outer_rad })
    });
    Ok(Source::Lamp(Lamp {
        name: light.name.clone().unwrap_or_else(|| "without a name".to_owned()),
        position: placement.transform.translation,
        colour,
        range: light.range.map(f64::from).filter(|range| *range > 0.0),
        spot: spot.transpose()?,
        spectrum,
    }))
}

fn sun_and_lamps(
    document: &Document<'_>,
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
        let of_node = spectra.of_extras(&document.json.nodes[node].extras, &format!("nodes[{node}]"));
        let Some(light) = lights.get(index) else {
            let place = format!("nodes[{node}].extensions.KHR_lights_punctual.light");
            notices.left_out(Part::Light, &place, &format!("there is no number {index} among {}", lights.len()));
            continue;
        };
        let spectrum = of_node.or_else(|| own[index].clone());
        let name = light.name.as_deref().unwrap_or("without a name");
        match source(document, (light, index), placement, spectrum) {
            Err(error) => {
                let place = format!("extensions.KHR_lights_punctual.lights[{index}]");
                notices.left_out(Part::Light, &place, &error.part_fault()?);
            }
            Ok(Source::Lamp(lamp)) => {
                let kind = if lamp.spot.is_some() { "spot" } else { "point" };
                if placement.motion.is_some() {
                    notices.add(format!("the {kind} light \"{name}\" moves and does not shine: only lamps at rest do"));
                    continue;
                }
                notices.add(format!("the {kind} light \"{name}\" shines in pictures by --renderer raytrace only"));
                lamps.push(lamp);
            }
            Ok(Source::Sun(_)) if sun.is_some() => {
                notices.add(format!("the directional light \"{name}\" does not shine: there is one sun, the first"));
            }
            Ok(Source::Sun(found)) => sun = Some(found),
        }
    }
    Ok((sun, lamps))
}

fn lights<'a>(document: &'a Document<'_>) -> &'a [Light] {
    let extensions = document.json.extensions.as_ref();
    extensions.and_then(|extensions| extensions.khr_lights_punctual.as_ref()).map_or(&[], |lights| &lights.lights)
}

fn owner(index: usize, light: &Light) -> String {
    let name = light.name.as_ref().map(|name| format!(" \"{name}\"")).unwrap_or_default();
    format!("lights[{index}]{name}")
}

/// Refuses spectra on nodes that are not lights, which would otherwise be lost silently.
fn refuse_spectra_of_other_nodes(document: &Document<'_>, spectra: &mut SpectrumReader<'_>) {
    for (index, node) in document.json.nodes.iter().enumerate() {
        let light = node.extensions.as_ref().is_some_and(|extensions| extensions.khr_lights_punctual.is_some());
        if !light && OwnExtras::of(&node.extras).is_ok_and(|own| own.spectrum.is_some()) {
            let name = node.name.as_ref().map(|name| format!(" \"{name}\"")).unwrap_or_default();
            let fault =
                "this node bears no light; give the spectrum to a material, or to a light of KHR_lights_punctual";
            spectra.refuse(&format!("nodes[{index}]{name}"), "extras.spectrum", fault);
        }
    }
}
