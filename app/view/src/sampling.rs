//! Places within a pixel at which a picture is sampled.

use glam::DVec2;

/// Sample of a picture: a place within each pixel, and the part of the pixel that it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSample {
    /// Place from the pixel's centre, pixels, x right and y down.
    pub offset: DVec2,
    /// Width of the part that it stands for, pixels: textures are averaged over that, so that the mean of all samples
    /// is the mean over the pixel, and not over its neighbours too.
    pub width: f64,
}

impl PixelSample {
    /// Sample that stands for the whole pixel.
    pub const WHOLE: Self = Self { offset: DVec2::ZERO, width: 1.0 };

    /// Sample `index` of `count`.
    pub fn of(index: u32, count: u32) -> Self {
        Self { offset: sample_offset(index, count), width: 1.0 / f64::from(count.max(1)).sqrt() }
    }
}

/// Offset of sample `index` of `count` from the centre of its pixel, pixels, in −½…½.
///
/// *Equation:* a lattice of N = `count` + 1 points without its origin, x = ib mod N and y = xa mod N, a being close to
/// N over the golden ratio. Every column and every row of `count` has one sample, and with each place its mirror image
/// in the centre is one: the mean place is the centre, so no number of samples shifts a picture. The step b, close to
/// N over the plastic number, keeps neighbours in the order of the samples apart. A single sample is at the centre.
pub fn sample_offset(index: u32, count: u32) -> DVec2 {
    const GOLDEN: f64 = 1.618_033_988_749_895;
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let count = u64::from(count.max(1));
    let points = count + 1;
    let x = (u64::from(index) + 1) * coprime(points, PLASTIC) % points;
    let y = x * coprime(points, GOLDEN) % points;
    DVec2::new(x as f64, y as f64).map(|place| (place - 0.5) / count as f64 - 0.5)
}

/// Number without a common divisor with `points`, close to `points` over `ratio`.
fn coprime(points: u64, ratio: f64) -> u64 {
    let divisor = |mut a: u64, mut b: u64| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let close = (points as f64 / ratio).round() as u64;
    let outwards = (0..points).flat_map(|step| [close.saturating_sub(step), close + step]);
    outwards.into_iter().find(|&number| number > 0 && divisor(number, points) == 1).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    //! Law: the samples of a pixel fill it evenly, and their mean is its centre. A wrong set would shift the picture.

    use super::*;

    #[test]
    fn samples_fill_a_pixel_evenly_around_its_centre() {
        for count in [1, 2, 3, 4, 5, 8, 9, 16, 17, 25, 32, 64, 100, 256] {
            let places: Vec<_> = (0..count).map(|index| sample_offset(index, count)).collect();
            let mean = places.iter().sum::<DVec2>() / f64::from(count);
            assert!(mean.length() < 1e-12, "{count}: {mean}");
            for axis in 0..2 {
                let mut sorted: Vec<_> = places.iter().map(|place| place[axis]).collect();
                sorted.sort_by(f64::total_cmp);
                for (number, place) in (0..).zip(sorted) {
                    let expected = (f64::from(number) + 0.5) / f64::from(count) - 0.5;
                    assert!((place - expected).abs() < 1e-12, "{count}: {place} is not {expected}");
                }
            }
        }
        assert_eq!(sample_offset(0, 1), DVec2::ZERO);
        assert_eq!(PixelSample::of(0, 1), PixelSample::WHOLE);
        assert_eq!(PixelSample::of(3, 16).width, 0.25);
    }
}
