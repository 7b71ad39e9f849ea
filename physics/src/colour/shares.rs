//! The spectra of colours: one smooth white, and the shares of it that red, green and blue have.
//!
//! A picture gives three numbers where a moving observer needs a whole spectrum. The spectrum taken here is W(λ) Σ cᵢ
//! Sᵢ(λ) for the linear sRGB colour c. Its properties, and how they are reached:
//!
//! - **At rest it is that colour, exactly.** W is D65 white, and each Sᵢ W is the primary; the last rounding is taken
//!   out when the tables are read, by one 3 × 3 system.
//! - **Grey stays near-neutral at every shift.** A power law keeps its chromaticity when it is shifted, so W is one,
//!   λ^−0.62, but for a bump of 15 % in the green: D65 lies beside the colours of power laws, by Δu'v' = 0.0080 at
//!   least.
//! - **Nothing goes black.** Shares are nowhere less than 0.0059, they sum to 1, and each is 1/3 in the far ultraviolet
//!   and infrared, where all colours fade into grey.
//! - **Colours change gracefully.** Among all shares of this kind, these bend least: they minimise ∑ ∫ (d²Sᵢ/d(ln
//!   λ)²)² d(ln λ), in cubic B-splines over ln λ with knots 0.02 apart, subject to Sᵢ ≥ 0.006, the primaries at D = 1,
//!   and 1/3 below 270 and above 1150 nm. This is a convex problem, so there is one answer. The primaries of sRGB are
//!   so vivid that a floor above 0.016 has no solution at all, and a higher one makes the shares steep.
//!
//! Mallett & Yuksel, *Spectral Primary Decomposition for Rendering with sRGB Reflectance* (EGSR 2019), find shares of
//! this kind for reflectances at rest.

use std::sync::LazyLock;

use glam::{DMat3, DVec3};

use super::{matching, srgb, table};

/// Exponent of the power law that white follows away from green.
const WHITE_EXPONENT: f64 = -0.622_553_245_054_623;
/// Height of the bump; with the exponent, it gives D65's two chromaticities.
const BUMP: f64 = 0.153_504_351_113_035_15;
/// Wavelength of the bump. *Units:* nm.
const BUMP_NM: f64 = 520.0;
/// Standard deviation of the bump, over ln λ.
const BUMP_WIDTH: f64 = 0.08;

/// Wavelength of the spline's knot 0. *Units:* nm.
const KNOT_NM: f64 = 545.0;
/// Distance of the spline's knots, over ln λ.
const KNOT_STEP: f64 = 0.02;

/// Factor that gives white the luminance of 1 cd/m².
static WHITE_SCALE: LazyLock<f64> =
    LazyLock::new(|| matching::xyz(1.0, None, |nm| DVec3::X * white_shape(nm)).x_axis.y.recip());

/// The spline's coefficients as they are stored, and its first knot.
static SPLINE: LazyLock<(f64, Vec<DVec3>)> = LazyLock::new(|| {
    let rows = table::rows::<4>(include_str!("data/shares.csv"));
    (rows[0][0], rows.into_iter().map(|[_, red, green, blue]| DVec3::new(red, green, blue)).collect())
});

/// Matrix that turns the stored shares into shares whose colours at rest are exactly the primaries.
static CORRECTION: LazyLock<DMat3> = LazyLock::new(|| {
    let xyz = matching::xyz(1.0, None, |nm| white(nm) * stored_shares(nm));
    (srgb::rgb_from_xyz() * xyz).inverse().transpose()
});

/// Spectrum of white, W(λ). At D = 1 it is D65 with a luminance of 1 cd/m².
///
/// *Units:* nm; W sr⁻¹ m⁻³. *Accuracy:* shifted by D = 1/4 … 4, its Δu'v' from D65 is 0.0149 at most, at D = 1.19
/// (`colour_rgb.rs`).
pub fn white(wavelength_nm: f64) -> f64 {
    *WHITE_SCALE * white_shape(wavelength_nm)
}

/// Shares Sᵢ(λ) of white that red, green and blue have. They are positive, and sum to 1.
///
/// *Units:* nm.
pub fn shares(wavelength_nm: f64) -> [f64; 3] {
    (*CORRECTION * stored_shares(wavelength_nm)).to_array()
}

/// Tristimulus values of white's shares at D = 1, as columns, if white were the power law alone, as it is far from
/// visible light.
static FAR_XYZ: LazyLock<DMat3> = LazyLock::new(|| {
    let law = |nm: f64| *WHITE_SCALE * (WHITE_EXPONENT * (nm / BUMP_NM).ln()).exp();
    matching::xyz(1.0, None, |nm| *CORRECTION * EVEN * law(nm))
});

/// Distance from the bump beyond which nothing of it is left in an f64, in standard deviations.
const NO_BUMP: f64 = 9.0;

/// Tristimulus values of white's shares for an observer with the Doppler factor D, as columns; `None` if D is not so
/// far from 1 that all that is seen of white is a power law.
///
/// *Equation:* 683 ∫ Sᵢ W(λ) x̄(λ/D) dλ, where W(Dλ) = D^p W(λ).
/// *Accuracy:* that of an f64 (`far_white_is_a_power_law`).
pub(super) fn far_white_xyz(doppler: f64) -> Option<DMat3> {
    let ends = [matching::SHORTEST_NM, matching::LONGEST_NM].map(|nm| doppler * nm);
    let beside = |nm: f64| {
        let from_bump = (nm / BUMP_NM).ln() / BUMP_WIDTH;
        (from_bump.abs() > NO_BUMP && spline_place(nm).is_none()).then_some(from_bump.signum())
    };
    let [shortest, longest] = ends.map(beside);
    (shortest.is_some() && shortest == longest).then(|| *FAR_XYZ * (doppler * doppler.powf(WHITE_EXPONENT)))
}

fn white_shape(nm: f64) -> f64 {
    let place = (nm / BUMP_NM).ln();
    let from_bump = place / BUMP_WIDTH;
    (WHITE_EXPONENT * place).exp() * (1.0 + BUMP * (-0.5 * from_bump * from_bump).exp())
}

/// Stored shares where the spline has none: even ones.
const EVEN: DVec3 = DVec3::splat(1.0 / 3.0);

/// Place on the spline, in knots from its first; `None` where no coefficient counts.
fn spline_place(nm: f64) -> Option<f64> {
    let (first, coefficients) = &*SPLINE;
    let place = (nm / KNOT_NM).ln() / KNOT_STEP - first;
    // A coefficient counts within two knots of its place.
    (-2.0..coefficients.len() as f64 + 1.0).contains(&place).then_some(place)
}

fn stored_shares(nm: f64) -> DVec3 {
    let Some(place) = spline_place(nm) else { return EVEN };
    let coefficients = &SPLINE.1;
    let last = coefficients.len() as f64;
    let knot = place.floor();
    let coefficient = |offset: f64| {
        let index = knot + offset;
        if (0.0..last).contains(&index) { coefficients[index as usize] } else { EVEN }
    };
    // The four cubic B-splines that reach this place.
    let right = place - knot;
    let left = 1.0 - right;
    coefficient(-1.0) * (left.powi(3) / 6.0)
        + coefficient(0.0) * (2.0 / 3.0 - right * right + right.powi(3) / 2.0)
        + coefficient(1.0) * (2.0 / 3.0 - left * left + left.powi(3) / 2.0)
        + coefficient(2.0) * (right.powi(3) / 6.0)
}
