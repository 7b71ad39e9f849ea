//! Warnings about likely mistakes in a scene.

use super::survey::Survey;
use glam::DVec3;
use scene::collision::Collision;
use scene::{Material, Scene, Surroundings};

/// Plausible size of a scene, metres; outside of it the unit is probably not the metre.
const PLAUSIBLE_SIZE: std::ops::RangeInclusive<f64> = 1e-3..=1e6;

/// Plausible brightness of white surfaces in sunlight, as a multiple of the luminance shown as white; above it the
/// sun's unit is probably wrong.
const PLAUSIBLE_SUN: f64 = 8.0;

/// Share of white's luminance below which a surface cannot be seen beside white.
const DARK: f64 = 1.0 / 300.0;

/// Likely mistakes in a scene, a sentence each with advice.
pub fn warnings(scene: &Scene, survey: &Survey, collision: &Collision) -> Vec<String> {
    let mut warnings = Vec::new();
    let mut warn = |holds: bool, warning: String| {
        if holds {
            warnings.push(warning);
        }
    };
    let Survey { without_area, not_finite, inside_out, .. } = *survey;
    let empty = scene.triangle_count() == 0;
    warn(empty && scene.panorama.is_none(), "there is nothing to draw: the scene has no triangles".into());
    warn(
        not_finite > 0,
        format!("triangles with corners that are nowhere (not finite): {not_finite}; they are not drawn"),
    );
    warn(without_area > 0, format!("triangles without area: {without_area}; remove them to save time"));
    let advice = "their light falls on the wrong side; turn their winding or their normals";
    warn(inside_out > 0, format!("triangles that face away from their normals: {inside_out}; {advice}"));
    for material in &scene.materials {
        let black = material.spectrum.is_some() && material.base_colour[..3].iter().all(|channel| *channel == 0.0);
        let advice = "the spectrum is multiplied by the base colour's luminance; make it white";
        warn(black, format!("material \"{}\" has a spectrum and a black base colour: {advice}", material.name));
    }
    // Luminance of a white surface in light of the colour 1, as a multiple of the luminance shown as white.
    let white = scene.white_luminance();
    let anything_lit =
        scene.materials.iter().any(|material| !(material.unlit || material.spectrum.is_some() && material.is_source()));
    let lit =
        if anything_lit { scene.illuminant.as_ref().map_or(1.0, |spectrum| spectrum.xyz(1.0).y) / white } else { 0.0 };
    let greatest = |colour: [f32; 3]| colour.into_iter().map(f64::from).fold(0.0, f64::max);
    let (brightest, sky) = (greatest(scene.light.sun) * lit, greatest(scene.light.sky) * lit);
    let advice = "name their luminance in cd/m² as extras.rapidity.white of the scene, or dim the sun to π lux";
    warn(
        brightest > PLAUSIBLE_SUN,
        format!("surfaces in the sun are up to {brightest:.1} times as bright as white: {advice}"),
    );
    let dark = |material: &&Material| match (material.is_source(), &material.spectrum) {
        (true, None) => f64::from(material.unlit).max(greatest(material.emissive)) / white < DARK,
        (true, Some(_)) => false,
        (false, _) => scene.illuminant.is_none() && brightest.max(sky) < DARK,
    };
    let dark: Vec<_> = scene.materials.iter().filter(dark).map(|material| material.name.as_str()).collect();
    let advice =
        "give a spectrum to them, or to the light that falls on them, or lower extras.rapidity.white of the scene";
    warn(
        white > 1.0 / DARK && !dark.is_empty(),
        format!(
            "{white:.3e} cd/m² are white, beside which colours, of 1 cd/m², are black ({}): {advice}",
            dark.join(", ")
        ),
    );
    if let Some([least, most]) = survey.bounds {
        let size = (most - least).max_element();
        let advice = "lengths are metres; scale the scene if they were not";
        warn(!PLAUSIBLE_SIZE.contains(&size), format!("the scene is {size} m large: {advice}"));
    }
    let grounded = |point: DVec3| collision.height_below(point).is_some();
    let advice = "a vehicle on wheels stays at its height";
    let solid = scene.meshes.iter().any(|mesh| mesh.solid);
    let ridden_in = (!empty || scene.panorama.is_none()) && scene.start.is_on_ground();
    warn(ridden_in && !solid, format!("no mesh is solid: {advice} and passes through everything"));
    warn(
        solid && ridden_in && !grounded(scene.start.position),
        format!("there is no ground below the start: {advice}"),
    );
    let airborne = scene.circuit.iter().filter(|&&point| !grounded(point)).count();
    let points = scene.circuit.len();
    warn(
        solid && airborne > 0,
        format!("points of the circuit without ground below: {airborne} of {points}; {advice}"),
    );
    warnings
}
