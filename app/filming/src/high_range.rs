//! Light for screens of a high dynamic range: signals of ITU-R BT.2100 in the colours of BT.2020.

use image::{ImageBuffer, Rgb, Rgb32FImage};
use picture_files::HdrCurve;

/// Picture with 16 bits a colour.
pub type DeepPicture = ImageBuffer<Rgb<u16>, Vec<u16>>;

/// Luminance of white, cd/m² (ITU-R BT.2408).
const WHITE: f64 = 203.0;
/// Luminance of the brightest signal of the perceptual quantiser, and that for which hybrid log-gamma is shown, cd/m².
const PQ_PEAK: f64 = 10_000.0;
const HLG_PEAK: f64 = 1000.0;
/// Gamma of a whole hybrid log-gamma system at that peak.
const HLG_SYSTEM_GAMMA: f64 = 1.2;
/// Rows of the matrix from linear colours of BT.709, which sRGB shares, to those of BT.2020 (ITU-R BT.2087).
const BT2020_FROM_BT709: [[f64; 3]; 3] = [[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0114], [0.0164, 0.0880, 0.8956]];
/// Shares of red, green and blue of BT.2020 in luminance.
const LUMINANCE: [f64; 3] = [0.2627, 0.6780, 0.0593];

/// Signal of light: linear sRGB, white is 1. What is beyond the signal's range becomes its end.
pub fn signal(light: &Rgb32FImage, curve: HdrCurve) -> DeepPicture {
    let mut deep = DeepPicture::new(light.width(), light.height());
    for (deep, light) in deep.pixels_mut().zip(light.pixels()) {
        let colour = BT2020_FROM_BT709.map(|row| {
            let sum: f64 = row.iter().zip(light.0).map(|(weight, value)| weight * f64::from(value)).sum();
            (WHITE * sum).max(0.0)
        });
        let signal = match curve {
            HdrCurve::Pq => colour.map(perceptual),
            HdrCurve::Hlg => log_gamma(colour),
        };
        deep.0 = signal.map(|value| (65_535.0 * value.clamp(0.0, 1.0)).round() as u16);
    }
    deep
}

/// Signal of the perceptual quantiser for a luminance in cd/m² (SMPTE ST 2084).
fn perceptual(luminance: f64) -> f64 {
    const M1: f64 = 2610.0 / 16_384.0;
    const M2: f64 = 2523.0 / 4096.0 * 128.0;
    const C1: f64 = 3424.0 / 4096.0;
    const C2: f64 = 2413.0 / 4096.0 * 32.0;
    const C3: f64 = 2392.0 / 4096.0 * 32.0;
    let power = (luminance / PQ_PEAK).min(1.0).powf(M1);
    ((C1 + C2 * power) / (1.0 + C3 * power)).powf(M2)
}

/// Signal of hybrid log-gamma for the light of a screen, cd/m² for each colour (ITU-R BT.2100).
fn log_gamma(colour: [f64; 3]) -> [f64; 3] {
    const A: f64 = 0.178_832_77;
    const B: f64 = 1.0 - 4.0 * A;
    let c = 0.5 - A * (4.0 * A).ln();
    let shown: f64 = colour.iter().zip(LUMINANCE).map(|(value, share)| value * share / HLG_PEAK).sum();
    // The screen raises the scene's luminance to the system's gamma.
    let factor = if shown > 0.0 { shown.powf(1.0 / HLG_SYSTEM_GAMMA - 1.0) } else { 0.0 };
    colour.map(|value| {
        let scene = value / HLG_PEAK * factor;
        if scene <= 1.0 / 12.0 { (3.0 * scene).sqrt() } else { A * (12.0 * scene - B).ln() + c }
    })
}

#[cfg(test)]
mod tests {
    //! Law: signals are those of the standards at the luminances that these name. A wrong program makes white glare or
    //! greys of everything.

    use super::*;

    fn grey(times_white: f64, curve: HdrCurve) -> f64 {
        let light = Rgb32FImage::from_pixel(1, 1, Rgb([times_white as f32; 3]));
        let [red, green, blue] = signal(&light, curve).get_pixel(0, 0).0;
        assert!(red.abs_diff(green) < 40 && blue.abs_diff(green) < 40, "{red} {green} {blue}");
        f64::from(green) / 65_535.0
    }

    #[test]
    fn signals_are_those_of_the_standards() {
        // BT.2408, table 1: 203 cd/m² is 58 % of PQ and 75 % of HLG. ST 2084: 100 cd/m² is 0.508, 1000 are 0.752.
        for (luminance, expected) in [(203.0, 0.5807), (100.0, 0.5081), (1000.0, 0.7518), (10_000.0, 1.0), (0.0, 0.0)] {
            let shown = grey(luminance / WHITE, HdrCurve::Pq);
            assert!((shown - expected).abs() < 2e-3, "{luminance} cd/m²: {shown}");
        }
        for (luminance, expected) in [(203.0, 0.75), (1000.0, 1.0), (26.0, 0.38), (0.0, 0.0)] {
            let shown = grey(luminance / WHITE, HdrCurve::Hlg);
            assert!((shown - expected).abs() < 4e-3, "{luminance} cd/m²: {shown}");
        }
        assert_eq!(grey(1e6, HdrCurve::Pq), 1.0);
    }

    #[test]
    fn colours_that_a_usual_screen_lacks_are_kept() {
        // Green of BT.2020 itself has negative red and blue in sRGB.
        let light = Rgb32FImage::from_pixel(1, 1, Rgb([-0.5876, 1.1329, -0.1006]));
        let [red, green, blue] = signal(&light, HdrCurve::Pq).get_pixel(0, 0).0;
        assert!(green > 37_000 && red < 4000 && blue < 4000, "{red} {green} {blue}");
    }
}
