//! Spectra of a scene's light, and their colours for the observer.
//!
//! Every radiance is three weights on a carrier spectrum ([`physics::colour::Carrier`]). An ordinary scene has one
//! carrier, the white for which weights are linear sRGB. Each spectrum that a material or the illuminant names adds
//! one. The shift table of all carriers is computed once, on all cores, and the shaders look it up (B eq. 2.16,
//! 2.17).

use crate::material::Material;
use crate::scene::Scene;
use glam::DVec3;
use physics::colour::Carrier;

/// Index of the carrier whose weights are linear sRGB: that of plain colours, of a background and of a panorama.
pub const WHITE: usize = 0;

/// Luminance below which a carrier counts as dark at rest, cd/m². Its weights are then not scaled by its luminance at
/// rest.
const DARKEST: f64 = 1e-30;

/// Carriers of a scene, each once.
///
/// For every carrier the shaders get weights relative to what is white at rest. Absolute luminance differs by many
/// orders of magnitude from black body to black body, and half floats hold only a few. [`SceneCarriers::factor`] is the
/// ratio.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneCarriers {
    /// Carriers, to which the weights belong.
    pub carriers: Vec<Carrier>,
    /// Carrier of the light that each material reflects or, if unlit, emits, in the scene's order.
    pub materials: Vec<usize>,
    /// Index of the sky's carrier.
    pub sky: usize,
    /// Luminance that is white at rest, cd/m².
    pub white_luminance: f64,
    /// Luminance of each carrier at rest with weights of 1, cd/m².
    luminances: Vec<f64>,
}

impl SceneCarriers {
    /// Finds the carriers of a scene.
    pub fn of(scene: &Scene) -> Self {
        let mut carriers = vec![Carrier::white()];
        let mut number = |carrier: Carrier| {
            carriers.iter().position(|known| *known == carrier).unwrap_or_else(|| {
                carriers.push(carrier);
                carriers.len() - 1
            })
        };
        let carrier_of = |material: &Material| match &material.spectrum {
            Some(spectrum) if material.is_source() => Carrier::emitted(spectrum.clone()),
            None if material.unlit => Carrier::white(),
            reflectance => Carrier::reflected(reflectance.clone(), scene.illuminant.clone()),
        };
        let materials = scene.materials.iter().map(|material| number(carrier_of(material))).collect();
        let sky = number(Carrier::reflected(None, scene.illuminant.clone()));
        let at_rest = |carrier: &Carrier| {
            let luminance = (carrier.xyz_from_weights(1.0) * DVec3::ONE).y;
            if luminance > DARKEST { luminance } else { 1.0 }
        };
        let luminances = carriers.iter().map(at_rest).collect();
        Self { carriers, materials, sky, white_luminance: scene.white_luminance(), luminances }
    }

    /// Luminance of each carrier at rest with weights of 1, cd/m².
    pub fn luminances(&self) -> &[f64] {
        &self.luminances
    }

    /// Factor from weights on a carrier to weights relative to the scene's white.
    pub fn factor(&self, carrier: usize) -> f32 {
        (self.luminances[carrier] / self.white_luminance) as f32
    }
}
