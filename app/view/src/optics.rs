//! The camera's lens and shutter, which turn one view into many.
//!
//! Every point of a lens is an eye of its own at the observer's event, and every moment of the exposure has an eye
//! further along the worldline. Each of them is an observer with the same celerity at another event, so nothing else
//! in the tracer needs to know of them.
//!
//! A sample's place in the lens and its moment come from a low-discrepancy sequence in three dimensions. The sequence
//! is the same in every pixel but for a shift by a hash of the pixel's place. That gives noise instead of patterns,
//! and the same picture for any number of threads.

use crate::camera::{Camera, Field};
use crate::effects::Places;
use crate::exposure::OpenShutter;
use crate::projection::PlaceSight;
use crate::shot::{Gaze, Shot};
use glam::{DVec2, DVec3};
use physics::Observer;
use std::f64::consts::TAU;

/// A thin lens in front of the observer, at rest in the observer's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraLens {
    /// Diameter of the aperture, metres.
    pub aperture_m: f64,
    /// Distance of the focal plane of apparent positions, metres along the axis of the picture, observer's frame.
    pub focus_m: f64,
}

/// Lens and shutter of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Optics {
    /// Lens; `None` stands for a pinhole.
    pub lens: Option<CameraLens>,
}

/// Place in the lens and moment of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LensDraw {
    /// Place in the unit disc.
    lens: DVec2,
    /// Moment in units of the exposure, −½ to ½.
    moment: f64,
}

impl Optics {
    /// Smallest number of samples of a picture that is drawn once for each, with a lens or a shutter.
    pub const LEAST_SAMPLES: u32 = 16;

    /// True if there is no lens, or a closed one.
    pub fn is_pinhole(&self) -> bool {
        self.lens.is_none_or(|lens| lens.aperture_m == 0.0)
    }

    /// Observer for a sample of a pixel, and the direction in which it looks.
    ///
    /// *Frames:* `sight` is the pixel's line of sight in eye axes; the result is in the observer's axes.
    ///
    /// *Equation:* a thin lens brings together the rays that cross at a point of its focal plane. From the place o in
    /// the lens a pixel looks along F (x, y, −1) − o, F being the distance of that plane (W C.1.2). In a picture that
    /// is not flat each direction has a lens of its own, square to it, and F is a distance from the eye.
    pub fn look(
        &self,
        shot: &Shot,
        exposure: &OpenShutter,
        sight: PlaceSight,
        pixel: [u32; 2],
        sample: u32,
    ) -> (Observer, DVec3) {
        let draw = LensDraw::of(pixel, sample);
        let Gaze { observer, observer_from_eye } = exposure.of_shot(shot, draw.moment);
        let PlaceSight { from_m, mut ahead, .. } = sight;
        let mut place = from_m;
        if let Some(lens) = self.open_lens() {
            let on_lens = 0.5 * lens.aperture_m * draw.lens;
            let eye = if sight.is_flat {
                on_lens.extend(0.0)
            } else {
                let (across, up) = ahead.any_orthonormal_pair();
                across * on_lens.x + up * on_lens.y
            };
            ahead = ahead * lens.focus_m - eye;
            place += eye;
        }
        (displaced(&observer, observer_from_eye * place, shot.effects.places), (observer_from_eye * ahead).normalize())
    }

    /// Shot of a sample of a flat picture of `size` pixels that is drawn once for each: from one place of the lens at
    /// one moment of the exposure. The focal plane stays where it is. All samples store light with the same scale.
    pub fn shot(&self, shot: &Shot, exposure: &OpenShutter, size: [u32; 2], sample: u32) -> Shot {
        let draw = LensDraw::of([0, 0], sample);
        let Gaze { mut observer, observer_from_eye } = exposure.of_shot(shot, draw.moment);
        let mut field = shot.camera.field;
        if let Some(lens) = self.open_lens() {
            let on_lens = 0.5 * lens.aperture_m * draw.lens;
            let mut tangents = shot.camera.tangents(size);
            tangents.low -= on_lens / lens.focus_m;
            tangents.high -= on_lens / lens.focus_m;
            field = Field::Screen(tangents);
            observer = displaced(&observer, observer_from_eye * on_lens.extend(0.0), shot.effects.places);
        }
        let camera = Camera { observer_from_eye, field };
        Shot { camera, observer, stored_scale: Some(shot.scale()), ..*shot }
    }

    fn open_lens(&self) -> Option<CameraLens> {
        self.lens.filter(|lens| lens.aperture_m > 0.0)
    }
}

/// Observer at a place beside another, the observer's axes, metres: at the same time for the observer, or, if light
/// takes no time, for the world.
fn displaced(observer: &Observer, place: DVec3, places: Places) -> Observer {
    if places != Places::Instant {
        return observer.at_offset(place);
    }
    let mut beside = *observer;
    beside.event.position += place;
    beside
}

impl LensDraw {
    /// Draw for a sample of a pixel.
    ///
    /// *Equation:* the additive recurrence x_n = n (1/g, 1/g², 1/g³) + x₀ mod 1 with g⁴ = g + 1 (Roberts' R₃), the
    /// third component for the time. Its steps differ from those of the places within a pixel; otherwise both would
    /// keep pace.
    fn of(pixel: [u32; 2], sample: u32) -> Self {
        const G: f64 = 1.220_744_084_605_759_5;
        let steps = [1.0 / G, 1.0 / (G * G), 1.0 / (G * G * G)];
        let [u, v, w] = [0, 1, 2].map(|dimension: u32| {
            let start = f64::from(hash([pixel[0], pixel[1], dimension])) / (f64::from(u32::MAX) + 1.0);
            (start + steps[dimension as usize] * f64::from(sample)).fract()
        });
        let (sine, cosine) = (TAU * v).sin_cos();
        Self { lens: DVec2::new(cosine, sine) * u.sqrt(), moment: w - 0.5 }
    }
}

/// Hash of three numbers: a multiplication and a shift by the upper bits for each (after PCG).
fn hash(numbers: [u32; 3]) -> u32 {
    numbers.into_iter().fold(0x9e37_79b9, |state: u32, number| {
        let state = (state ^ number).wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
        (word >> 22) ^ word
    })
}

#[cfg(test)]
mod tests {
    //! Samples must fill the lens and the exposure evenly, in every pixel. A wrong program leaves holes, or draws
    //! neighbouring pixels alike.

    use super::*;

    #[test]
    fn samples_fill_the_lens_and_the_exposure_evenly() {
        for pixel in [[0, 0], [1, 0], [0, 1], [917, 401]] {
            let count = 256;
            let draws: Vec<_> = (0..count).map(|sample| LensDraw::of(pixel, sample)).collect();
            assert!(draws.iter().all(|draw| draw.lens.length() <= 1.0 && draw.moment.abs() <= 0.5));
            // Each of eight rings and sectors of equal area, and each eighth of the time, has an eighth of the
            // samples to within a quarter of that. Independent random numbers would be further off in one part of
            // eight.
            let parts = |part: &dyn Fn(&LensDraw) -> f64| {
                let mut counts = [0; 8];
                draws.iter().for_each(|draw| counts[(part(draw) * 8.0).min(7.0) as usize] += 1);
                counts
            };
            let sector = |draw: &LensDraw| draw.lens.y.atan2(draw.lens.x).rem_euclid(TAU) / TAU;
            for counts in [parts(&|draw| draw.lens.length_squared()), parts(&sector), parts(&|draw| draw.moment + 0.5)]
            {
                assert!(counts.iter().all(|count| (24..=40).contains(count)), "{counts:?} at {pixel:?}");
            }
        }
        assert_ne!(LensDraw::of([3, 4], 0), LensDraw::of([4, 3], 0));
    }
}
