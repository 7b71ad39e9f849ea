//! Cost of a frame: a fixed part, and a part in proportion to the pixels that are drawn, from frames that were seen.
//!
//! Frames are kept by their number of pixels, in classes half an octave wide. Each class holds a mean of pixels and
//! times, which lies on the line that its frames lie on. A line needs classes that differ by nearly two: nearer
//! ones differ less than their noise. A load that grows or falls slowly scales all that was seen before. Frames that
//! are far from the line show that the load has changed; what was seen before says nothing then.

/// Number of classes: two for each octave, down to a sixteenth of all pixels.
const CLASSES: usize = 9;
/// Least weight of the newest frames in the mean of their class.
const NEWEST: f64 = 0.05;
/// Smallest ratio of the largest to the smallest number of pixels from which the fixed part is known.
const SPREAD: f64 = 1.8;
/// Largest ratio of a time to the expected one, or its reciprocal, under an unchanged load.
const SURPRISE: f64 = 1.4;
/// Part of a deviation from the expected time that is taken to be a growing or falling load, and not noise.
const DRIFT: f64 = 0.2;

/// Times of frames by their number of pixels.
#[derive(Clone, Debug, Default)]
pub struct FrameCost {
    classes: [Option<SeenFrames>; CLASSES],
    newest: Option<SeenFrames>,
}

/// Frames with about the same number of pixels.
#[derive(Clone, Copy, Debug)]
struct SeenFrames {
    /// Share of all pixels.
    pixels: f64,
    /// Time of a frame, seconds.
    time_s: f64,
    /// Weight of the next ones in the mean.
    next: f64,
}

/// Both parts of a frame's time; neither is negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameParts {
    /// Time that does not depend on the number of pixels, seconds.
    pub fixed_s: f64,
    /// Further time of a frame with all pixels, seconds.
    pub full_s: f64,
}

impl FrameParts {
    /// Parts of a frame that spends all of its time on this share of the pixels.
    pub fn all_in_pixels(pixels: f64, time_s: f64) -> Self {
        Self { fixed_s: 0.0, full_s: time_s / pixels }
    }

    /// Time of a frame with this share of the pixels, seconds.
    pub fn time_s(&self, pixels: f64) -> f64 {
        self.fixed_s + self.full_s * pixels
    }

    /// Share of the pixels, 0 to 1, with which a frame takes this long.
    pub fn pixels_within(&self, time_s: f64) -> f64 {
        let room_s = time_s - self.fixed_s;
        if room_s <= 0.0 { 0.0 } else { (room_s / self.full_s.max(f64::MIN_POSITIVE)).min(1.0) }
    }

    /// Share of the pixels, 0 to 1, at which they take this part of the frame's time: fewer gain little.
    pub fn pixels_that_take(&self, part: f64) -> f64 {
        self.pixels_within(self.fixed_s / (1.0 - part))
    }
}

impl FrameCost {
    /// Takes into account that frames with this share of the pixels take this long.
    pub fn see(&mut self, pixels: f64, time_s: f64) {
        let surprise = self.parts().map_or(1.0, |parts| time_s / parts.time_s(pixels).max(f64::MIN_POSITIVE));
        // A load that lies in pixels alone is only assumed while one class is known.
        let certain = self.has_spread() || self.newest.is_some_and(|newest| newest.pixels == pixels);
        if certain && !(SURPRISE.recip()..=SURPRISE).contains(&surprise) {
            *self = Self::default();
        } else if certain {
            let drift = surprise.powf(DRIFT);
            self.classes.iter_mut().flatten().for_each(|seen| seen.time_s *= drift);
        }
        let class = &mut self.classes[((-2.0 * pixels.log2()).round().max(0.0) as usize).min(CLASSES - 1)];
        let now = SeenFrames { pixels, time_s, next: 0.5 };
        *class = Some(class.map_or(now, |before| SeenFrames {
            pixels: before.pixels + before.next * (pixels - before.pixels),
            time_s: before.time_s + before.next * (time_s - before.time_s),
            next: (before.next / (1.0 + before.next)).max(NEWEST),
        }));
        self.newest = Some(now);
    }

    /// Parts of a frame's time: the line that fits best, or all of the newest frames' time in their pixels as long as
    /// no line is known; `None` before any frame.
    pub fn parts(&self) -> Option<FrameParts> {
        let newest = self.newest?;
        if !self.has_spread() {
            return Some(FrameParts::all_in_pixels(newest.pixels, newest.time_s));
        }
        // What was seen more often weighs more.
        let seen = || self.classes.iter().flatten().map(|seen| (seen.next.recip() - 1.0, seen));
        let weight: f64 = seen().map(|(weight, _)| weight).sum();
        let mean = |of: fn(&SeenFrames) -> f64| seen().map(|(weight, seen)| weight * of(seen)).sum::<f64>() / weight;
        let (pixels, time_s) = (mean(|seen| seen.pixels), mean(|seen| seen.time_s));
        let square = mean(|seen| seen.pixels * seen.pixels);
        let product = mean(|seen| seen.pixels * seen.time_s);
        let full_s = ((product - pixels * time_s) / (square - pixels * pixels)).max(0.0);
        let fixed_s = time_s - full_s * pixels;
        // A line through the origin fits best where the free one lies below it.
        Some(if fixed_s < 0.0 {
            FrameParts { fixed_s: 0.0, full_s: product / square }
        } else {
            FrameParts { fixed_s, full_s }
        })
    }

    /// True if frames were seen that differ enough in their pixels.
    pub fn has_spread(&self) -> bool {
        let seen = || self.classes.iter().flatten().map(|seen| seen.pixels);
        let (least, most) = (seen().fold(f64::INFINITY, f64::min), seen().fold(0.0, f64::max));
        most >= SPREAD * least
    }
}

#[cfg(test)]
mod tests {
    //! Laws under test: both parts are found in spite of noise, are never negative, and follow a changed load.

    use super::*;

    fn seen(frames: &[(f64, f64)]) -> FrameCost {
        let mut cost = FrameCost::default();
        frames.iter().for_each(|(pixels, time_s)| cost.see(*pixels, *time_s));
        cost
    }

    #[test]
    fn both_parts_are_found_in_spite_of_noise() {
        let mut noise = 0.3_f64;
        let frames = [1.0, 0.4, 0.25, 0.4, 0.25, 0.2].map(|pixels| {
            noise = (noise * 97.0 + 0.13).fract();
            (pixels, (0.05 + 0.1 * pixels) * (0.98 + 0.04 * noise))
        });
        let parts = seen(&frames).parts().unwrap();
        assert!((parts.fixed_s - 0.05).abs() < 0.004 && (parts.full_s - 0.1).abs() < 0.008, "{parts:?}");
        assert!((parts.pixels_that_take(1.0 / 3.0) - 0.25).abs() < 0.04);
        assert!((parts.time_s(0.3) - 0.08).abs() < 0.003);
    }

    #[test]
    fn no_part_is_negative() {
        for frames in [[(1.0, 0.10), (0.4, 0.11)], [(1.0, 0.30), (0.4, 0.05)], [(1.0, 0.0), (0.4, 0.0)]] {
            let parts = seen(&frames).parts().unwrap();
            assert!(parts.fixed_s >= 0.0 && parts.full_s >= 0.0, "{frames:?}: {parts:?}");
        }
        // Where pixels cost nothing, all of them are drawn.
        assert_eq!(seen(&[(1.0, 0.1), (0.4, 0.1)]).parts().unwrap().pixels_that_take(1.0 / 3.0), 1.0);
    }

    #[test]
    fn near_numbers_of_pixels_tell_nothing_of_the_fixed_part() {
        let parts = seen(&[(0.5, 0.10), (0.35, 0.10)]).parts().unwrap();
        assert_eq!(parts.fixed_s, 0.0);
        assert!((parts.time_s(0.35) - 0.10).abs() < 1e-12);
    }

    #[test]
    fn a_load_that_grows_slowly_scales_what_was_seen_before() {
        let mut cost = seen(&[(1.0, 0.15), (0.4, 0.09), (1.0, 0.15), (0.4, 0.09)]);
        for step in 1..=100 {
            cost.see(0.4, 0.09 * (1.0 + 0.01 * f64::from(step)));
        }
        let parts = cost.parts().unwrap();
        assert!((parts.time_s(1.0) / 0.30 - 1.0).abs() < 0.15, "{parts:?}");
        assert!((parts.time_s(0.4) / 0.18 - 1.0).abs() < 0.08, "{parts:?}");
    }

    #[test]
    fn a_changed_load_is_learned_anew() {
        let mut cost = seen(&[(1.0, 0.15), (0.4, 0.09)]);
        cost.see(0.4, 0.02);
        assert_eq!(cost.parts(), Some(FrameParts::all_in_pixels(0.4, 0.02)));
    }
}
