//! Fastest moment of a course between two knots.

/// Samples of an interval. A spline's speed has three extremes there at most.
const SAMPLES: u32 = 64;
/// Steps that narrow a maximum down to rounding, each to 0.618 of the width.
const STEPS: usize = 50;

/// Largest of `speed` between two parameters.
pub(crate) fn fastest([from, to]: [f64; 2], speed: &dyn Fn(f64) -> f64) -> f64 {
    let at = |sample: u32| from + (to - from) * f64::from(sample) / f64::from(SAMPLES);
    let best = (0..=SAMPLES).map(|sample| (sample, speed(at(sample))));
    let (sample, found) = best.fold((0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
    // Golden section about the best sample.
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let (mut low, mut high) = (at(sample.saturating_sub(1)), at((sample + 1).min(SAMPLES)));
    for _ in 0..STEPS {
        let [left, right] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        if speed(left) < speed(right) {
            low = left;
        } else {
            high = right;
        }
    }
    found.max(speed(0.5 * (low + high)))
}

#[cfg(test)]
mod tests {
    //! Law: the largest speed is found between the samples, too.
    use super::*;

    #[test]
    fn a_maximum_between_samples_is_found() {
        for peak in [0.0, 0.31, 0.5031, 0.999, 1.0] {
            let speed = |t: f64| 1.0 - (t - peak) * (t - peak);
            assert!((fastest([0.0, 1.0], &speed) - 1.0).abs() < 1e-15, "{peak}");
        }
    }
}
