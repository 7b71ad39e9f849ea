//! Conversion of the weights that a surface emits to the light that the observer sees.
//!
//! The wavelength shift is linear in the weights: a matrix for each carrier and Doppler factor (B eq. 2.17). It is
//! looked up in the same table that the shaders have, or integrated for every single ray. The searchlight effect
//! multiplies by D⁴ (W eq. 4.13).

use glam::{DMat3, DVec3};
use physics::colour::{Carrier, ShiftTable, Spectrum, luminance};
use scene::carriers::SceneCarriers;
use scene::{Lamp, Scene};
use std::ops::{Add, AddAssign, Mul};
use view::Effects;

/// Weights, and the index of their carrier. They are in cd/m² if the carrier's weights are.
pub type CarrierWeights = (DVec3, usize);

/// Light that leaves a point.
#[derive(Clone, Debug, Default)]
pub struct SentLight {
    /// Reflected light; of an unlit surface or of the sky, the whole light.
    pub returned: CarrierWeights,
    /// Reflected light of lamps that has a carrier of its own.
    pub of_lamps: Vec<CarrierWeights>,
    /// Light that the surface itself emits.
    pub emitted: CarrierWeights,
}

impl SentLight {
    /// Light of a partly diffuse surface behind a filter: the reflected light times `share` and `filter`, the emitted
    /// light times `filter`.
    pub fn dimmed(mut self, share: f64, filter: DVec3) -> Self {
        self.returned.0 *= filter * share;
        self.of_lamps.iter_mut().for_each(|(weights, _)| *weights *= filter * share);
        self.emitted.0 *= filter;
        self
    }

    fn all(&self) -> impl Iterator<Item = CarrierWeights> {
        [self.returned, self.emitted].into_iter().chain(self.of_lamps.iter().copied())
    }
}

/// Carriers of a lamp's light.
struct LampCarriers {
    /// Carrier of the light reflected by a white surface.
    white: usize,
    /// Carrier of the light reflected by each material, if the lamp has a spectrum of its own.
    materials: Option<Vec<usize>>,
}

/// Carriers of a scene and of its lamps, and their shifts.
pub struct LightShifts {
    carriers: Vec<Carrier>,
    at_rest: Vec<DMat3>,
    table: Option<ShiftTable>,
    lamps: Vec<LampCarriers>,
    /// Luminance that is white at rest, cd/m².
    pub white: f64,
}

impl LightShifts {
    /// Computes the shift table, unless light is to be `exact`.
    pub fn new(scene_carriers: &SceneCarriers, scene: &Scene, exact: bool) -> Self {
        let mut carriers = scene_carriers.carriers.clone();
        let mut number = |carrier: Carrier| {
            carriers.iter().position(|known| *known == carrier).unwrap_or_else(|| {
                carriers.push(carrier);
                carriers.len() - 1
            })
        };
        let mut of_lamp = |lamp: &Lamp| {
            let Some(spectrum) = &lamp.spectrum else {
                return LampCarriers { white: scene_carriers.sky, materials: None };
            };
            let mut reflected =
                |reflectance: Option<Spectrum>| number(Carrier::reflected(reflectance, Some(spectrum.clone())));
            let materials = scene.materials.iter().map(|material| reflected(material.spectrum.clone())).collect();
            LampCarriers { white: reflected(None), materials: Some(materials) }
        };
        let lamps = scene.lamps.iter().map(&mut of_lamp).collect();
        let at_rest = carriers.iter().map(|carrier| carrier.rgb_from_weights(1.0)).collect();
        let table = (!exact).then(|| ShiftTable::new(&carriers, ShiftTable::NODES));
        Self { carriers, at_rest, table, lamps, white: scene_carriers.white_luminance }
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
    pub fn observed(&self, sent: &SentLight, effects: Effects, doppler: f64) -> ObservedLight {
        let (mut colour, mut at_rest) = (DVec3::ZERO, DVec3::ZERO);
        for (weights, carrier) in sent.all().filter(|(weights, _)| *weights != DVec3::ZERO) {
            let unshifted = self.at_rest[carrier] * weights;
            at_rest += unshifted;
            colour += if effects.shift_colour() && doppler != 1.0 {
                self.shift(carrier, doppler) * weights
            } else {
                unshifted
            };
        }
        let brighter = if effects.brighten() { doppler.powi(4) } else { 1.0 };
        ObservedLight { light: colour * brighter, at_rest: luminance(at_rest) / self.white }
    }

    fn shift(&self, carrier: usize, doppler: f64) -> DMat3 {
        match &self.table {
            Some(table) => table.rgb_from_weights(carrier, doppler),
            None => self.carriers[carrier].rgb_from_weights(doppler),
        }
    }
}

/// Light along a ray, as observed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ObservedLight {
    /// Light in linear sRGB, cd/m².
    pub light: DVec3,
    /// Luminance without any shift, relative to white.
    pub at_rest: f64,
}

impl Add for ObservedLight {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { light: self.light + other.light, at_rest: self.at_rest + other.at_rest }
    }
}

impl AddAssign for ObservedLight {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f64> for ObservedLight {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { light: self.light * factor, at_rest: self.at_rest * factor }
    }
}
