//! Conversion of other primaries to linear sRGB.

use glam::{DMat3, DVec3, Mat3};
use physics::colour::{rgb_from_xyz, xyz_from_rgb};

/// Difference of chromaticities below which primaries are those of sRGB.
const SAME: f64 = 1e-3;

/// Chromaticities of sRGB: red, green, blue, white (IEC 61966-2-1).
const SRGB: [[f64; 2]; 4] = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]];

/// Bradford's cone responses (Lindbloom, "Chromatic Adaptation"), by which one white becomes another.
const BRADFORD: DMat3 = DMat3::from_cols_array(&[
    0.8951, -0.7502, 0.0389, //
    0.2664, 1.7135, -0.0685, //
    -0.1614, 0.0367, 1.0296,
]);

/// Primaries of a picture.
pub(super) struct Primaries {
    /// Tristimulus values from the picture's numbers.
    xyz_from_picture: DMat3,
    /// Tristimulus values of its white.
    white: DVec3,
    /// True if they are those of sRGB.
    usual: bool,
}

impl Primaries {
    /// Primaries by their chromaticities x, y: red, green, blue, white. `None` if these are no colours.
    pub(super) fn new(chromaticities: [[f64; 2]; 4]) -> Option<Self> {
        let close = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs() < SAME && (a[1] - b[1]).abs() < SAME;
        let usual = chromaticities.iter().zip(&SRGB).all(close);
        let of_unit_luminance = |[x, y]: [f64; 2]| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
        let of_unit_sum = |[x, y]: [f64; 2]| DVec3::new(x, y, 1.0 - x - y);
        let [red, green, blue, white] = chromaticities;
        let columns = DMat3::from_cols(of_unit_sum(red), of_unit_sum(green), of_unit_sum(blue));
        let white = of_unit_luminance(white);
        let xyz_from_picture = columns * DMat3::from_diagonal(columns.inverse() * white);
        let sound = xyz_from_picture.is_finite() && columns.determinant().abs() > 1e-9;
        let invertible = xyz_from_picture.determinant().abs() > 1e-12;
        (sound && invertible).then_some(Self { xyz_from_picture, white, usual })
    }

    /// Linear sRGB from the picture's numbers; `None` if they are linear sRGB. White becomes white.
    pub(super) fn srgb_from_picture(&self) -> Option<Mat3> {
        if self.usual {
            return None;
        }
        let [cones, wanted] = [self.white, xyz_from_rgb() * DVec3::ONE].map(|white| BRADFORD * white);
        let adapted = BRADFORD.inverse() * DMat3::from_diagonal(wanted / cones) * BRADFORD;
        let matrix = rgb_from_xyz() * adapted * self.xyz_from_picture;
        matrix.is_finite().then(|| matrix.as_mat3())
    }

    /// Luminances of the three primaries; their sum is 1.
    pub(super) fn luminances(&self) -> [f32; 3] {
        self.xyz_from_picture.row(1).as_vec3().to_array()
    }

    /// Primaries of sRGB.
    pub(super) fn srgb() -> Self {
        Self { xyz_from_picture: xyz_from_rgb(), white: xyz_from_rgb() * DVec3::ONE, usual: true }
    }
}

/// Linear sRGB from tristimulus values.
pub(super) fn srgb_from_xyz() -> Mat3 {
    rgb_from_xyz().as_mat3()
}

/// Converts pixels by a matrix. Those with a number that is not finite keep it, so that it is found later.
/// The result counts the pixels whose colour sRGB does not have; they become the nearest ones that it has.
pub(super) fn convert(matrix: Mat3, pixels: &mut [[f32; 3]]) -> usize {
    let mut outside = 0;
    for pixel in pixels.iter_mut().filter(|pixel| pixel.iter().all(|value| value.abs() < 1e10)) {
        let colour = matrix * glam::Vec3::from_array(*pixel);
        outside += usize::from(colour.min_element() < -1e-3 * colour.max_element().max(1e-3));
        *pixel = colour.max(glam::Vec3::ZERO).to_array();
    }
    outside
}
