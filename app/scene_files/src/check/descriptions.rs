//! Descriptions of a scene's first view, motions and spectra, a line each.

use physics::colour::Spectrum;
use scene::Scene;
use scene::motion::Motion;

/// Description of the place from which the scene is seen first.
pub fn first_view(scene: &Scene) -> String {
    let start = &scene.start;
    let [x, y, z] = start.position.to_array();
    let place = format!("{x:.3}, {y:.3}, {z:.3} m");
    match scene.cameras.iter().find(|camera| camera.start == *start) {
        Some(camera) => format!("at its camera \"{}\"", camera.name),
        None if scene.triangle_count() == 0 => "in the middle of a panorama".to_owned(),
        None if start.is_on_ground() => format!("on the ground at {place}"),
        None => format!("outside, with all of it in view, at {place}"),
    }
}

/// Descriptions of the moving bodies, in the order of the scene's motions.
pub fn moving(scene: &Scene) -> Vec<String> {
    let meshes = scene.moving_meshes();
    let said = |(number, motion): (usize, &Motion)| {
        let beta = scene.fastest(number, &meshes[number]).beta;
        match motion {
            Motion::Uniform(uniform) => {
                let name = meshes[number].first().map_or("nothing", |&mesh| scene.meshes[mesh].name.as_str());
                format!("\"{name}\" at {beta:.6} c, a celerity of {:.6}", uniform.celerity.magnitude())
            }
            Motion::Animated(animated) => {
                let speed = beta * animated.speed_of_light_m_s();
                format!("\"{}\" by its animation, at up to {speed:.6} m/s: light has to be faster", animated.name)
            }
        }
    };
    scene.motions.iter().enumerate().map(said).collect()
}

/// Descriptions of the spectra of light and materials; equal spectra share a line.
pub fn spectra(scene: &Scene) -> Vec<String> {
    let mut owners: Vec<(&Spectrum, Vec<String>)> = Vec::new();
    let illuminant = scene.illuminant.iter().map(|spectrum| (spectrum, "the light".to_owned()));
    let materials = scene.materials.iter().filter_map(|material| {
        let role = if material.is_source() { "sent out by" } else { "returned by" };
        Some((material.spectrum.as_ref()?, format!("{role} \"{}\"", material.name)))
    });
    for (spectrum, owner) in illuminant.chain(materials) {
        match owners.iter_mut().find(|(known, _)| *known == spectrum) {
            Some((_, names)) => names.push(owner),
            None => owners.push((spectrum, vec![owner])),
        }
    }
    owners.into_iter().map(|(spectrum, owners)| format!("{}: {}", described(spectrum), owners.join(", "))).collect()
}

fn described(spectrum: &Spectrum) -> String {
    match spectrum {
        Spectrum::Planck { kelvin } => format!("Planck at {kelvin} K"),
        Spectrum::Sampled(sampled) => match sampled.samples() {
            [[first, _], .., [last, _]] => format!("{} samples from {first} to {last} nm", sampled.samples().len()),
            samples => format!("{} sample", samples.len()),
        },
        Spectrum::Rgb([red, green, blue]) => format!("rgb {red}, {green}, {blue}"),
        Spectrum::Gray => "gray".to_owned(),
    }
}
