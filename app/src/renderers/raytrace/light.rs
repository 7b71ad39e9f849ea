//! From the weights that a surface sends out to what the observer sees of them.
//!
//! The wavelength shift is linear in the weights: a matrix for each carrier and Doppler factor (B eq. 2.17), looked up in the same table
//! that the shaders have, or integrated for every single ray. The searchlight effect multiplies by D⁴ (W eq. 4.13).

use crate::renderers::Effects;
use crate::renderers::world::Spectra;
use glam::{DMat3, DVec3};
use physics::colour::{Carrier, ShiftTable, luminance};

/// Weights and their carrier, in cd/m² where the carrier's weights are.
pub type Sent = [(DVec3, usize); 2];

/// The carriers of a scene.
pub struct Light {
    carriers: Vec<Carrier>,
    at_rest: Vec<DMat3>,
    table: Option<ShiftTable>,
    /// Luminance that is white at rest, cd/m².
    pub white: f64,
}

impl Light {
    /// Works out the table, unless light is to be `exact`.
    pub fn new(spectra: &Spectra, exact: bool) -> Self {
        let carriers = spectra.carriers.clone();
        let at_rest = carriers.iter().map(|carrier| carrier.rgb_from_weights(1.0)).collect();
        let table = (!exact).then(|| ShiftTable::new(&carriers, ShiftTable::NODES));
        Self { carriers, at_rest, table, white: spectra.white_luminance }
    }

    /// Linear sRGB in cd/m² as observed, and the luminance at rest relative to white.
    pub fn observed(&self, sent: &Sent, effects: Effects, doppler: f64) -> (DVec3, f64) {
        let (mut colour, mut at_rest) = (DVec3::ZERO, DVec3::ZERO);
        for &(weights, carrier) in sent.iter().filter(|(weights, _)| *weights != DVec3::ZERO) {
            let unshifted = self.at_rest[carrier] * weights;
            at_rest += unshifted;
            colour +=
                if effects.doppler && doppler != 1.0 { self.shift(carrier, doppler) * weights } else { unshifted };
        }
        let brighter = if effects.searchlight { doppler.powi(4) } else { 1.0 };
        (colour * brighter, luminance(at_rest) / self.white)
    }

    fn shift(&self, carrier: usize, doppler: f64) -> DMat3 {
        match &self.table {
            Some(table) => table.rgb_from_weights(carrier, doppler),
            None => self.carriers[carrier].rgb_from_weights(doppler),
        }
    }
}
