//! Paints: two greens that look alike until they are shifted, and the textures of tiles.
//!
//! The greens are after B fig. 2.4, where the same paint was measured on aluminium and on pine: visible light shows
//! the paint, but in the infrared the paint is clear and shows the material below. The numbers here are invented
//! after that pattern: metal goes on reflecting but for the bands in which the binder absorbs (3.4, 5.8, 8 … 10 µm);
//! wood hardly begins to.

use physics::colour::Spectrum;
use std::sync::Arc;

use scene::{Texture, Wrap};

/// Reflectance of the paint where it hides the material below; pairs of wavelength in nm and reflectance.
const PAINT: [[f64; 2]; 17] = [
    [300.0, 0.04],
    [350.0, 0.05],
    [400.0, 0.06],
    [430.0, 0.07],
    [450.0, 0.08],
    [470.0, 0.11],
    [490.0, 0.19],
    [510.0, 0.31],
    [525.0, 0.37],
    [540.0, 0.36],
    [560.0, 0.28],
    [580.0, 0.18],
    [600.0, 0.12],
    [620.0, 0.09],
    [640.0, 0.075],
    [660.0, 0.07],
    [680.0, 0.07],
];

const ON_ALUMINIUM: [[f64; 2]; 17] = [
    [700.0, 0.085],
    [720.0, 0.15],
    [750.0, 0.30],
    [800.0, 0.48],
    [900.0, 0.60],
    [1000.0, 0.66],
    [1500.0, 0.74],
    [2200.0, 0.78],
    [3000.0, 0.70],
    [3400.0, 0.45],
    [3700.0, 0.70],
    [5000.0, 0.75],
    [5800.0, 0.35],
    [6500.0, 0.60],
    [8000.0, 0.40],
    [9500.0, 0.35],
    [12000.0, 0.55],
];

const ON_PINE: [[f64; 2]; 11] = [
    [700.0, 0.07],
    [720.0, 0.075],
    [750.0, 0.085],
    [800.0, 0.10],
    [900.0, 0.12],
    [1200.0, 0.12],
    [1450.0, 0.08],
    [1900.0, 0.05],
    [2900.0, 0.03],
    [6000.0, 0.04],
    [12000.0, 0.05],
];

/// Reflectances of green paint on aluminium and on pine.
pub(super) fn greens() -> [Spectrum; 2] {
    [&ON_ALUMINIUM[..], &ON_PINE[..]].map(|infrared| {
        Spectrum::sampled([&PAINT[..], infrared].concat()).expect("the tables ascend and are not negative")
    })
}

/// Side of a texture of tiles, pixels.
const SIDE: u32 = 256;
/// Width of the joints, pixels.
const JOINT: u32 = 3;

/// Texture of one square metre of tiles, `count` along each side: grey levels of two kinds of alternating tiles, and
/// of the joints.
pub(super) fn tiles(name: &str, count: u32, tile_codes: [u8; 2], joint_code: u8) -> Texture {
    let tile = SIDE / count;
    let code = |index: u32| {
        let (x, y) = (index % SIDE, index / SIDE);
        let joint = x % tile < JOINT || y % tile < JOINT;
        if joint { joint_code } else { tile_codes[((x / tile + y / tile) % 2) as usize] }
    };
    let rgba = (0..SIDE * SIDE).flat_map(|index| [code(index), code(index), code(index), 255]).collect();
    Texture {
        name: name.into(),
        width: SIDE,
        height: SIDE,
        rgba: Arc::new(rgba),
        wrap: [Wrap::Repeat; 2],
        nearest: false,
    }
}

#[cfg(test)]
mod tests {
    //! Laws under test: the two greens look alike to an observer at rest, and differ to one in motion.

    use glam::DVec3;
    use physics::colour::Carrier;
    use physics::colour::difference::{delta_e_2000, lab_from_xyz};

    use super::*;

    /// Colour difference of the two greens, shifted by D, in daylight of 5900 K; lightness is relative to a white
    /// surface beside them.
    fn difference(doppler: f64) -> f64 {
        let xyz = |reflectance| {
            let daylight = Spectrum::Planck { kelvin: 5900.0 };
            Carrier::reflected(Some(reflectance), Some(daylight)).xyz_from_weights(doppler) * DVec3::ONE
        };
        let white = xyz(Spectrum::Gray);
        let [aluminium, pine] = greens().map(|green| lab_from_xyz(xyz(green), white));
        delta_e_2000(aluminium, pine)
    }

    #[test]
    fn greens_look_alike_at_rest_and_part_when_shifted() {
        // A difference of about 1 is the least that is visible side by side; beyond 10 the colours are clearly
        // different.
        assert!(difference(1.0) < 0.5, "{}", difference(1.0));
        for doppler in [1.3, 1.5, 2.0, 4.0] {
            assert!(difference(doppler) > 10.0, "{doppler}: {}", difference(doppler));
        }
    }

    #[test]
    fn both_are_green() {
        for green in greens() {
            let seen = Carrier::reflected(Some(green), Some(Spectrum::Planck { kelvin: 5900.0 }));
            let [red, green, blue] = (seen.rgb_from_weights(1.0) * DVec3::ONE).to_array();
            assert!(green > 1.5 * red && green > 1.5 * blue, "{red} {green} {blue}");
        }
    }
}
