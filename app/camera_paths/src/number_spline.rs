//! A number between keys, as a field of view: smooth, and never beyond the two keys that it is between.
//!
//! *Equation:* Hermite's cubics with the slopes of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984): the
//! weighted harmonic mean of the slopes on both sides, zero where these have different signs, and at the ends.

/// Smooth curve through numbers.
#[derive(Clone, Debug)]
pub(crate) struct NumberSpline {
    times_s: Vec<f64>,
    values: Vec<f64>,
    slopes: Vec<f64>,
}

impl NumberSpline {
    /// Curve through at least one number at ascending times.
    pub(crate) fn new(times_s: Vec<f64>, values: Vec<f64>) -> Self {
        let length = |interval: usize| times_s[interval + 1] - times_s[interval];
        let slope = |interval: usize| (values[interval + 1] - values[interval]) / length(interval);
        let slopes = (0..values.len()).map(|key| {
            if key == 0 || key + 1 == values.len() {
                return 0.0;
            }
            let [before, after] = [slope(key - 1), slope(key)];
            let [first, second] = [length(key - 1), length(key)];
            if before * after <= 0.0 {
                return 0.0;
            }
            3.0 * (first + second) / ((first + 2.0 * second) / before + (2.0 * first + second) / after)
        });
        let slopes = slopes.collect();
        Self { times_s, values, slopes }
    }

    /// Number at a time; before the first key and after the last that of the key.
    pub(crate) fn at(&self, time_s: f64) -> f64 {
        let after = self.times_s.partition_point(|key| *key <= time_s);
        if after == 0 || after == self.values.len() {
            return self.values[after.saturating_sub(1)];
        }
        let before = after - 1;
        let length = self.times_s[after] - self.times_s[before];
        let s = (time_s - self.times_s[before]) / length;
        let r = 1.0 - s;
        let [from, to] = [self.values[before], self.values[after]];
        let [leaves, arrives] = [self.slopes[before] * length, self.slopes[after] * length];
        from + (to - from) * (s * s * (3.0 - 2.0 * s)) + leaves * (s * r * r) - arrives * (s * s * r)
    }
}

#[cfg(test)]
mod tests {
    //! Law: a number passes through its keys, stays between neighbours, and its slope has no leaps. A cubic spline
    //! swings beyond its keys, and a field of view of −3 degrees is none.
    use super::*;

    #[test]
    fn a_number_stays_between_its_keys() {
        let (times, values) = ([0.0, 1.0, 1.1, 3.0, 4.0], [60.0, 20.0, 1.0, 1.0, 90.0]);
        let spline = NumberSpline::new(times.to_vec(), values.to_vec());
        let mut slope_before: Option<f64> = None;
        for step in 0..4000 {
            let time = 0.001 * f64::from(step);
            let interval = times.iter().rposition(|key| *key <= time).unwrap_or(0);
            let [a, b] = [values[interval], values[interval + 1]];
            let found = spline.at(time);
            assert!((a.min(b)..=a.max(b)).contains(&found), "{found} at {time}");
            let slope = (spline.at(time + 1e-7) - found) / 1e-7;
            assert!(slope_before.is_none_or(|before| (slope - before).abs() < 15.0), "{slope} at {time}");
            slope_before = Some(slope);
        }
        assert_eq!(times.map(|time| spline.at(time)), values);
        assert_eq!([spline.at(-1.0), spline.at(9.0)], [60.0, 90.0]);
    }
}
