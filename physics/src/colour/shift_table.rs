//! The shift table: the colour of every carrier at every Doppler factor, looked up instead of integrated.
//!
//! A pixel has weights c, a carrier and a Doppler factor D; its colour after the shift of wavelengths is linear in the
//! weights, so the table holds one colour per carrier, weight and D. Nodes are even in ln D from 1e-6 to 1e6.
//! Brightness runs over hundreds of orders of magnitude there, and chromaticity hardly changes, so a texel holds the
//! linear sRGB colour divided by its luminance Y, and log₂ Y; all four are interpolated linearly. Beyond the ends the
//! colour stays and log₂ Y goes on in a straight line: the power law in which white, thermal light and a measured
//! spectrum end, if nothing was measured in gamma rays or radio waves.

use std::f64::consts::{LN_2, LN_10};

use glam::{DMat3, DVec3, DVec4, Vec4};
use rayon::prelude::*;

use super::carrier::Carrier;
use super::srgb;

/// Colours over ln D, as a texture holds them.
#[derive(Clone, Debug, PartialEq)]
pub struct ShiftTable {
    nodes: usize,
    texels: Vec<[f32; 4]>,
}

/// Texel for no light, or for light too faint for an f64: 2⁻¹⁰⁰⁰ cd/m² of white.
const DARK: [f32; 4] = [1.0, 1.0, 1.0, LOG2_DARKEST];
const LOG2_DARKEST: f32 = -1000.0;

impl ShiftTable {
    /// Limit of ln D: the table's first and last node are at ∓ this, D = 1e-6 and 1e6.
    pub const LN_LIMIT: f64 = 6.0 * LN_10;

    /// Number of nodes that suffices, 0.0034 apart in ln D, and no more than a texture may be wide (8192) on any
    /// graphics card.
    ///
    /// *Accuracy:* looked up with these, colours of all kinds of light differ from direct integration by a ΔE2000 of
    /// 0.15 at most over D = 0.05 … 20 (`colour_table.rs`); the error goes with the square of the distance.
    pub const NODES: usize = 8191;

    /// Integrates the colours of these carriers, on all cores.
    ///
    /// The number of nodes is made odd, and 3 at least, so that D = 1 is one.
    pub fn new(carriers: &[Carrier], nodes: usize) -> Self {
        let nodes = nodes.max(3) | 1;
        let mut texels = vec![DARK; 3 * nodes * carriers.len()];
        texels.par_chunks_mut(3 * nodes).zip(carriers).for_each(|(rows, carrier)| {
            let (red, others) = rows.split_at_mut(nodes);
            let (green, blue) = others.split_at_mut(nodes);
            let columns = red.par_iter_mut().zip(green).zip(blue).enumerate();
            columns.for_each(|(node, ((red, green), blue))| {
                [*red, *green, *blue] = column(carrier, Self::doppler(node, nodes));
            });
        });
        Self { nodes, texels }
    }

    /// Number of nodes over ln D: the texture's width.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Texels by rows: row 3 × carrier + weight, one texel per node: red, green and blue divided by Y, and log₂ Y,
    /// with Y in cd/m².
    pub fn texels(&self) -> &[[f32; 4]] {
        &self.texels
    }

    /// Linear sRGB of each weight alone, as columns: [`Carrier::rgb_from_weights`] as a shader looks it up.
    ///
    /// *Equation:* with p = (ln D / LN_LIMIT + 1) / 2 · (nodes − 1), i = ⌊p⌋ held within 0 … nodes − 2 and f = p − i,
    /// the colour is mix(texelᵢ, texelᵢ₊₁, f held within 0 … 1).rgb · exp2(mix(texelᵢ, texelᵢ₊₁, f).w).
    pub fn rgb_from_weights(&self, carrier: usize, doppler: f64) -> DMat3 {
        let place = (doppler.ln() / Self::LN_LIMIT + 1.0) * 0.5 * (self.nodes - 1) as f64;
        let node = place.floor().clamp(0.0, (self.nodes - 2) as f64);
        let fraction = place - node;
        let look_up = |weight: usize| {
            let start = (3 * carrier + weight) * self.nodes + node as usize;
            let [left, right] = [start, start + 1].map(|texel| Vec4::from_array(self.texels[texel]).as_dvec4());
            let colour: DVec4 = left.lerp(right, fraction.clamp(0.0, 1.0));
            colour.truncate() * left.lerp(right, fraction).w.exp2()
        };
        DMat3::from_cols(look_up(0), look_up(1), look_up(2))
    }

    fn doppler(node: usize, nodes: usize) -> f64 {
        let middle = (nodes / 2) as f64;
        ((node as f64 - middle) / middle * Self::LN_LIMIT).exp()
    }
}

/// The texels of the three weights at one node.
fn column(carrier: &Carrier, doppler: f64) -> [[f32; 4]; 3] {
    let (xyz, lift) = carrier.lifted_xyz_from_weights(doppler);
    [xyz.x_axis, xyz.y_axis, xyz.z_axis].map(|xyz| texel(xyz, lift))
}

fn texel(xyz: DVec3, lift: f64) -> [f32; 4] {
    let ratios = srgb::rgb_from_xyz() * (xyz / xyz.y);
    let texel = ratios.extend(xyz.y.log2() - lift / LN_2).as_vec4();
    if texel.is_finite() { texel.with_w(texel.w.max(LOG2_DARKEST)).to_array() } else { DARK }
}
