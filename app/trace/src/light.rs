//! Conversion of the weights that a surface emits to the light that the observer sees.
//!
//! The wavelength shift is linear in the weights: a matrix for each carrier and Doppler factor (B eq. 2.17). It is
//! looked up in the same table that the shaders have, or integrated for every single ray. The searchlight effect
//! multiplies by D⁴ (W eq. 4.13).

use super::path::Seen;
use glam::{DMat3, DVec3};
use physics::colour::{Carrier, ShiftTable, Spectrum, luminance};
use scene::carriers::Spectra;
use scene::{Lamp, Scene};
use view::Effects;

/// Weights, and the index of their carrier. They are in cd/m² if the carrier's weights are.
pub type Weights = (DVec3, usize);

/// Light that leaves a point.
#[derive(Clone, Debug, Default)]
pub struct Sent {
    /// Reflected light; of an unlit surface or of the sky, the whole light.
    pub returned: Weights,
    /// Reflected light of lamps that has a carrier of its own.
    pub of_lamps: Vec<Weights>,
    /// Light that the surface itself emits.
    pub emitted: Weights,
}

impl Sent {
    /// Light of a partly diffuse surface behind a filter: the reflected light times `share` and `filter`, the emitted
    /// light times `filter`.
    pub fn dimmed(mut self, share: f64, filter: DVec3) -> Self {
        self.returned.0 *= filter * share;
        self.of_lamps.iter_mut().for_each(|(weights, _)| *weights *= filter * share);
        self.emitted.0 *= filter;
        self
    }

    fn all(&self) -> impl Iterator<Item = Weights> {
        [self.returned, self.emitted].into_iter().chain(self.of_lamps.iter().copied())
    }
}

/// Carriers of a lamp's light.
struct OfLamp {
    /// Carrier of the light reflected by a white surface.
    white: usize,
    /// Carrier of the light reflected by each material, if the lamp has a spectrum of its own.
    materials: Option<Vec<usize>>,
}

/// Carriers of a scene, and their shifts.
pub struct Light {
    carriers: Vec<Carrier>,
    at_rest: Vec<DMat3>,
    table: Option<ShiftTable>,
    lamps: Vec<OfLamp>,
    /// Luminance that is white at rest, cd/m².
    pub white: f64,
}

impl Light {
    /// Computes the shift table, unless light is to be `exact`.
    pub fn new(spectra: &Spectra, scene: &Scene, exact: bool) -> Self {
        let mut carriers = spectra.carriers.clone();
        let mut number = |carrier: Carrier| {
            carriers.iter().position(|known| *known == carrier).unwrap_or_else(|| {
                carriers.push(carrier);
                carriers.len() - 1
            })
        };
        let mut of_lamp = |lamp: &Lamp| {
            let Some(spectrum) = &lamp.spectrum else { return OfLamp { white: spectra.sky, materials: None } };
            let mut reflected =
                |reflectance: Option<Spectrum>| number(Carrier::reflected(reflectance, Some(spectrum.clone())));
            let materials = scene.materials.iter().map(|material| reflected(material.spectrum.clone())).collect();
            OfLamp { white: reflected(None), materials: Some(materials) }
        };
        let lamps = scene.lamps.iter().map(&mut of_lamp).collect();
        let at_rest = carriers.iter().map(|carrier| carrier.rgb_from_weights(1.0)).collect();
        let table = (!exact).then(|| ShiftTable::new(&carriers, ShiftTable::NODES));
        Self { carriers, at_rest, table, lamps, white: spectra.white_luminance }
    }

    /// Carrier of a lamp's light reflected by a material, if it is not the material's own carrier.
    pub fn carrier_of_lamp(&self, lamp: usize, material: usize) -> Option<usize> {
        self.lamps[lamp].materials.as_ref().map(|materials| materials[material])
    }

    /// Weights on the lamp's own carrier that look the same as its light after a shift.
    pub fn shifted_lamp(&self, lamp: usize, weights: DVec3, doppler: f64) -> DVec3 {
        if doppler == 1.0 {
            return weights;
        }
        let white = self.lamps[lamp].white;
        self.at_rest[white].inverse() * (self.shift(white, doppler) * weights)
    }

    /// Emitted light as the observer sees it.
    pub fn observed(&self, sent: &Sent, effects: Effects, doppler: f64) -> Seen {
        let (mut colour, mut at_rest) = (DVec3::ZERO, DVec3::ZERO);
        for (weights, carrier) in sent.all().filter(|(weights, _)| *weights != DVec3::ZERO) {
            let unshifted = self.at_rest[carrier] * weights;
            at_rest += unshifted;
            colour +=
                if effects.doppler && doppler != 1.0 { self.shift(carrier, doppler) * weights } else { unshifted };
        }
        let brighter = if effects.searchlight { doppler.powi(4) } else { 1.0 };
        Seen { light: colour * brighter, at_rest: luminance(at_rest) / self.white }
    }

    fn shift(&self, carrier: usize, doppler: f64) -> DMat3 {
        match &self.table {
            Some(table) => table.rgb_from_weights(carrier, doppler),
            None => self.carriers[carrier].rgb_from_weights(doppler),
        }
    }
}
