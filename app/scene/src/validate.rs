//! Check of the promises of a scene's types: array lengths, indices, and values that have a range.

use crate::lamp::Lamp;
use crate::material::{Material, Texture};
use crate::mesh::Mesh;
use crate::motion::{Motion, Uniform};
use crate::panorama::Panorama;
use crate::scene::{MAX_SPECTRA, Scene};
use physics::colour::Spectrum;

/// Fault in a scene that breaks a promise of its types.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("scene \"{scene}\" is damaged: {fault}; make it anew or load it from a file")]
pub struct SceneFault {
    /// Name of the scene.
    pub scene: String,
    /// Description of the fault, with its mesh, material or texture.
    pub fault: String,
}

impl Scene {
    /// Checks the promises of the scene's types: array lengths and indices, not coordinates.
    ///
    /// Loaders keep the promises. This check is for scenes made by hand; after it, code may index freely.
    ///
    /// # Errors
    /// The first broken promise, as a [`SceneFault`].
    pub fn validate(&self) -> Result<(), SceneFault> {
        match self.fault() {
            None => Ok(()),
            Some(fault) => Err(SceneFault { scene: self.name.clone(), fault }),
        }
    }

    /// First broken promise, in words.
    fn fault(&self) -> Option<String> {
        let texture = |texture: &Texture| {
            let bytes = u64::from(texture.width) * u64::from(texture.height) * 4;
            (bytes != texture.rgba.len() as u64).then(|| {
                let (name, width, height, given) = (&texture.name, texture.width, texture.height, texture.rgba.len());
                format!("texture \"{name}\" of {width} × {height} pixels has {given} bytes instead of {bytes}")
            })
        };
        let spectrum = |spectrum: &Option<Spectrum>, of: &str| {
            // A spectrum from its own constructors is valid, but its public fields can be set without them.
            let checked = match spectrum.as_ref()? {
                Spectrum::Planck { kelvin } => Spectrum::planck(*kelvin),
                Spectrum::Rgb(rgb) => Spectrum::rgb(*rgb),
                good @ (Spectrum::Sampled(_) | Spectrum::Gray) => Ok(good.clone()),
            };
            checked.err().map(|fault| format!("the spectrum of {of}: {fault}"))
        };
        let white = || {
            let white = self.white.filter(|white| !(white.is_finite() && *white > 0.0))?;
            Some(format!("the luminance of white is {white} cd/m², not a finite number above 0"))
        };
        let panorama = || {
            let Panorama { width, height, rgb } = self.panorama.as_ref()?;
            let pixels = u64::from(*width) * u64::from(*height);
            let whole = pixels > 0 && pixels == rgb.len() as u64;
            (!whole).then(|| format!("the panorama of {width} × {height} pixels has {}", rgb.len()))
        };
        let material = |material: &Material| {
            let fault = spectrum(&material.spectrum, &format!("material \"{}\"", material.name));
            if fault.is_some() {
                return fault;
            }
            if !(material.index_of_refraction >= 1.0 && material.index_of_refraction.is_finite()) {
                let (name, index) = (&material.name, material.index_of_refraction);
                return Some(format!(
                    "material \"{name}\" has an index of refraction of {index}, which is not 1 or more"
                ));
            }
            let used = [material.base_colour_texture, material.emissive_texture];
            let missing = used.into_iter().flatten().find(|&index| index >= self.textures.len())?;
            let (name, count) = (&material.name, self.textures.len());
            Some(format!("material \"{name}\" uses texture {missing} of {count}"))
        };
        let mesh = |mesh: &Mesh| {
            let (name, count) = (&mesh.name, mesh.positions.len());
            if mesh.material >= self.materials.len() {
                return Some(format!("mesh \"{name}\" uses material {} of {}", mesh.material, self.materials.len()));
            }
            if let Some(motion) = mesh.motion.filter(|&motion| motion >= self.motions.len()) {
                return Some(format!("mesh \"{name}\" has motion {motion} of {}", self.motions.len()));
            }
            let spared = [mesh.uvs.len(), mesh.colours.len()].into_iter().all(|length| [0, count].contains(&length));
            if mesh.normals.len() != count || !spared {
                return Some(format!("mesh \"{name}\" has vertex arrays of different lengths"));
            }
            if ![0, count].contains(&mesh.emissive_uvs.len()) {
                return Some(format!("mesh \"{name}\" has {} emissive texture coordinates", mesh.emissive_uvs.len()));
            }
            if !mesh.indices.len().is_multiple_of(3) {
                return Some(format!("mesh \"{name}\" has {} indices, not three per triangle", mesh.indices.len()));
            }
            let beyond = mesh.indices.iter().find(|&&index| index as usize >= count)?;
            Some(format!("mesh \"{name}\" uses vertex {beyond} of {count}"))
        };
        let motion = |(number, motion): (usize, &Motion)| {
            let Motion::Uniform(Uniform { anchor, .. }) = motion else { return None };
            let finite = anchor.position.is_finite() && anchor.ct.is_finite();
            (!finite)
                .then(|| format!("motion {number} passes {} at {} m, which is not finite", anchor.position, anchor.ct))
        };
        let spectra = || {
            let mut different: Vec<(&Spectrum, bool)> = Vec::new();
            for material in &self.materials {
                if let Some(spectrum) = material.spectrum.as_ref().map(|spectrum| (spectrum, material.is_source()))
                    && different.len() <= MAX_SPECTRA
                    && !different.contains(&spectrum)
                {
                    different.push(spectrum);
                }
            }
            let many = different.len() > MAX_SPECTRA;
            many.then(|| {
                format!("its materials have more than {MAX_SPECTRA} different spectra, which is all that can be drawn")
            })
        };
        let lamp = |lamp: &Lamp| {
            let place = (!lamp.position.is_finite()).then(|| format!("lamp \"{}\" is nowhere", lamp.name));
            place.or_else(|| spectrum(&lamp.spectrum, &format!("lamp \"{}\"", lamp.name)))
        };
        let textures = self.textures.iter().find_map(texture);
        textures
            .or_else(|| self.materials.iter().find_map(material))
            .or_else(|| self.meshes.iter().find_map(mesh))
            .or_else(|| self.motions.iter().enumerate().find_map(motion))
            .or_else(|| self.lamps.iter().find_map(lamp))
            .or_else(|| spectrum(&self.illuminant, "the light"))
            .or_else(white)
            .or_else(panorama)
            .or_else(spectra)
    }
}
