//! Tristimulus values of a spectral radiance: the CIE 1931 2° standard observer, and the sum over wavelengths.
//!
//! The standard observer is defined by a table in steps of 1 nm from 360 to 830 nm. Integrals are trapezoidal sums
//! over these steps and over the places where the spectrum itself bends. For spectra that are smooth within a
//! nanometre this is the convention of the CIE, and nothing that a measured spectrum says between two steps is passed
//! over, however far a Doppler shift has squeezed it.

use std::sync::LazyLock;

use glam::{DMat3, DVec3};

use super::table::rows;

/// Longest wavelength that is seen. *Units:* nm.
pub(super) const LONGEST_NM: f64 = 830.0;

/// Shortest wavelength that is seen. *Units:* nm.
pub(super) const SHORTEST_NM: f64 = 360.0;

/// Luminous efficacy of radiation at 555 nm. *Units:* lm W⁻¹.
const EFFICACY: f64 = 683.0;

/// Metres per nanometre: spectral radiance is per metre of wavelength, tables are in nanometres.
const METRES_PER_NM: f64 = 1e-9;

/// Wavelengths in nm with the colour-matching functions there. Source: CIE 018:2019, table 6.
static MATCHING: LazyLock<Vec<(f64, DVec3)>> = LazyLock::new(|| {
    let rows = rows(include_str!("data/cie-1931-2deg-1nm.csv"));
    rows.into_iter().map(|[nm, x, y, z]| (nm, DVec3::new(x, y, z))).collect()
});

/// Tristimulus values of three lights at once, each a column, after their wavelengths have been shifted by D.
///
/// *Equation:* X_i = 683 ∫ D L_i(Dλ) x̄(λ) dλ over 360 … 830 nm, and so Y, Z (CIE 15:2018, 7.1; B 2.17); summed over
/// the wavelengths that are sent out, as 683 ∫ L_i(λ) x̄(λ/D) dλ. *Units:* spectral radiance in W sr⁻¹ m⁻³, result in
/// cd/m².
///
/// `bends` are the wavelengths in nm at which the spectra are not smooth, ascending; those that cannot be seen are
/// passed over.
pub(super) fn xyz(doppler: f64, bends: impl IntoIterator<Item = f64>, radiance: impl Fn(f64) -> DVec3) -> DMat3 {
    let mut sum = DMat3::ZERO;
    let mut before: Option<(f64, DMat3)> = None;
    let mut add = |nm: f64, matching: DVec3| {
        let seen = outer(matching, radiance(nm));
        if let Some((nm_before, seen_before)) = before {
            sum += (seen_before + seen) * (0.5 * (nm - nm_before));
        }
        before = Some((nm, seen));
    };
    let (first, matching_first) = MATCHING[0];
    let mut bends = bends.into_iter().skip_while(|nm| *nm < doppler * first).peekable();
    add(doppler * first, matching_first);
    for pair in MATCHING.windows(2) {
        let [(left, matching_left), (right, matching_right)] = [pair[0], pair[1]];
        while let Some(nm) = bends.next_if(|nm| *nm < doppler * right) {
            add(nm, matching_left.lerp(matching_right, (nm / doppler - left) / (right - left)));
        }
        add(doppler * right, matching_right);
    }
    sum * (EFFICACY * METRES_PER_NM)
}

/// Outer product: column i is `column` times component i of `row`.
fn outer(column: DVec3, row: DVec3) -> DMat3 {
    DMat3::from_cols(column * row.x, column * row.y, column * row.z)
}
