//! Linear sRGB: its primaries and its white, and the matrices that follow from them.

use std::sync::LazyLock;

use glam::{DMat3, DVec3};

/// Chromaticities x, y of the red, green and blue primaries (IEC 61966-2-1, table 1; the same in ITU-R BT.709).
const PRIMARIES: [[f64; 2]; 3] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];

/// Chromaticity x, y of white: D65, in the four digits of the standard.
const WHITE: [f64; 2] = [0.3127, 0.3290];

static XYZ_FROM_RGB: LazyLock<DMat3> = LazyLock::new(|| {
    // Scale the primaries so that equal amounts of them are white with Y = 1.
    let [red, green, blue] = PRIMARIES.map(of_unit_luminance);
    let primaries = DMat3::from_cols(red, green, blue);
    primaries * DMat3::from_diagonal(primaries.inverse() * of_unit_luminance(WHITE))
});

static RGB_FROM_XYZ: LazyLock<DMat3> = LazyLock::new(|| XYZ_FROM_RGB.inverse());

/// Tristimulus values (CIE 1931 2°) of a linear sRGB colour; white, (1, 1, 1), is D65 with Y = 1.
pub fn xyz_from_rgb() -> DMat3 {
    *XYZ_FROM_RGB
}

/// The linear sRGB colour of tristimulus values; negative where sRGB cannot show it.
pub fn rgb_from_xyz() -> DMat3 {
    *RGB_FROM_XYZ
}

/// Y of a linear sRGB colour.
pub fn luminance(rgb: DVec3) -> f64 {
    XYZ_FROM_RGB.row(1).dot(rgb)
}

/// Tristimulus values with Y = 1 of a chromaticity.
fn of_unit_luminance([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}
