//! Places between keys: a cubic spline, whose velocity and acceleration are continuous.
//!
//! The spline is the natural one, with no acceleration at its ends. At a stop it comes to rest: there it is cut into
//! two splines with velocity zero at their common end.
//!
//! *Equation:* with M the accelerations at the keys of an interval of length h, a the rest and t the time since its
//! beginning, S = y₀ + t Δ + (M₀ (a³ − h² a) + M₁ (t³ − h² t))/(6h), Δ = (y₁ − y₀)/h; continuous velocities make a
//! tridiagonal system for M (de Boor, A Practical Guide to Splines, chapter IV).

use glam::DVec3;

/// Cubic spline through places.
#[derive(Clone, Debug)]
pub(crate) struct PlaceSpline {
    times_s: Vec<f64>,
    places: Vec<DVec3>,
    /// Accelerations at both ends of each interval.
    bends: Vec<[DVec3; 2]>,
}

/// Place on a spline, with its rates of change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SplinePoint {
    /// Place, metres.
    pub(crate) place: DVec3,
    /// Velocity, metres per second of the keys' time.
    pub(crate) velocity: DVec3,
    /// Acceleration, metres per second².
    pub(crate) acceleration: DVec3,
}

impl PlaceSpline {
    /// Spline through at least two places at ascending times; true in `stops`: it rests there for a moment.
    pub(crate) fn new(times_s: Vec<f64>, places: Vec<DVec3>, stops: &[bool]) -> Self {
        let mut bends = Vec::with_capacity(times_s.len());
        let mut from = 0;
        for to in 1..times_s.len() {
            if stops[to] || to + 1 == times_s.len() {
                let run = from..=to;
                let moments = moments(&times_s[run.clone()], &places[run], [stops[from], stops[to]]);
                bends.extend(moments.windows(2).map(|ends| [ends[0], ends[1]]));
                from = to;
            }
        }
        Self { times_s, places, bends }
    }

    /// Times of the keys, seconds.
    pub(crate) fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// Point at a time; before the first key and after the last that of the key.
    pub(crate) fn at(&self, time_s: f64) -> SplinePoint {
        let after = self.times_s.partition_point(|key| *key <= time_s);
        let interval = after.saturating_sub(1).min(self.bends.len() - 1);
        let [from, to] = [self.times_s[interval], self.times_s[interval + 1]];
        let time = time_s.clamp(from, to);
        let (h, t, a) = (to - from, time - from, to - time);
        let ([m0, m1], start) = (self.bends[interval], self.places[interval]);
        let slope = (self.places[interval + 1] - start) / h;
        SplinePoint {
            place: start + slope * t + (m0 * (a * (a * a - h * h)) + m1 * (t * (t * t - h * h))) / (6.0 * h),
            velocity: slope + (m0 * (h * h - 3.0 * a * a) + m1 * (3.0 * t * t - h * h)) / (6.0 * h),
            acceleration: (m0 * a + m1 * t) / h,
        }
    }
}

/// Accelerations at the keys of a spline; `rests`: velocity zero at its ends, instead of acceleration zero.
fn moments(times_s: &[f64], places: &[DVec3], rests: [bool; 2]) -> Vec<DVec3> {
    let count = times_s.len();
    let last = count - 1;
    let length = |interval: usize| times_s[interval + 1] - times_s[interval];
    let slope = |interval: usize| (places[interval + 1] - places[interval]) / length(interval);
    // Rows of the system: below, on and above the diagonal, and the right side.
    let row = |key: usize| match key {
        0 if rests[0] => (0.0, 2.0 * length(0), length(0), 6.0 * slope(0)),
        key if key == last && rests[1] => (length(key - 1), 2.0 * length(key - 1), 0.0, -6.0 * slope(key - 1)),
        key if key == 0 || key == last => (0.0, 1.0, 0.0, DVec3::ZERO),
        key => {
            let [before, after] = [length(key - 1), length(key)];
            (before, 2.0 * (before + after), after, 6.0 * (slope(key) - slope(key - 1)))
        }
    };
    // Eliminate downwards, then substitute upwards.
    let mut reduced: Vec<(f64, DVec3)> = Vec::with_capacity(count);
    for key in 0..count {
        let (below, on, above, right) = row(key);
        let (share, carried) = reduced.last().copied().unwrap_or((0.0, DVec3::ZERO));
        let pivot = on - below * share;
        reduced.push((above / pivot, (right - below * carried) / pivot));
    }
    let mut moments = vec![DVec3::ZERO; count];
    let mut next = DVec3::ZERO;
    for (moment, (share, right)) in moments.iter_mut().zip(&reduced).rev() {
        next = *right - next * *share;
        *moment = next;
    }
    moments
}

#[cfg(test)]
mod tests {
    //! Law: a spline passes through its keys, its velocity and acceleration are its derivatives and have no leaps, and
    //! it rests where it is told to. A line of straight pieces leaps in velocity at each key.
    use super::*;

    fn spline(stops: [bool; 5]) -> PlaceSpline {
        let times = vec![-1.0, 0.5, 1.0, 3.0, 3.2];
        let places = [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [4.0, 1.0, -2.0], [4.0, 5.0, 2.0], [-1e3, 5.0, 2.0]];
        PlaceSpline::new(times, places.map(DVec3::from_array).to_vec(), &stops)
    }

    #[test]
    fn keys_are_met_and_nothing_leaps() {
        for stops in [[false; 5], [true, false, false, true, true], [false, true, true, false, false]] {
            let spline = spline(stops);
            for (key, time) in spline.times_s.clone().into_iter().enumerate() {
                assert!(spline.at(time).place.distance(spline.places[key]) < 1e-12);
                let [before, after] = [time - 1e-9, time + 1e-9].map(|time| spline.at(time));
                assert!(before.velocity.distance(after.velocity) < 1e-3, "{stops:?} at {time}");
                if stops[key] {
                    assert!(spline.at(time).velocity.length() < 1e-9, "{stops:?} at {time}");
                } else if key > 0 && key < 4 {
                    assert!(before.acceleration.distance(after.acceleration) < 1e-2, "{stops:?} at {time}");
                } else {
                    assert_eq!(spline.at(time).acceleration, DVec3::ZERO);
                }
            }
        }
    }

    #[test]
    fn rates_are_derivatives() {
        let spline = spline([true, false, true, false, false]);
        for step in 1..400 {
            let time = -0.9991 + 4.19 * f64::from(step) / 400.0;
            let [before, after] = [time - 1e-5, time + 1e-5].map(|time| spline.at(time));
            let (velocity, acceleration) = (spline.at(time).velocity, spline.at(time).acceleration);
            let close = |found: DVec3, of: DVec3| found.distance(of / 2e-5) < 1e-4 * (1.0 + found.length());
            assert!(close(velocity, after.place - before.place), "{time}");
            assert!(
                close(acceleration, after.velocity - before.velocity)
                    || spline.times_s.iter().any(|key| (key - time).abs() < 1e-4),
                "{time}"
            );
        }
    }

    #[test]
    fn two_keys_are_a_straight_line_or_an_eased_one() {
        let two = |stop| PlaceSpline::new(vec![0.0, 2.0], vec![DVec3::ZERO, DVec3::X], &[stop, stop]);
        assert_eq!(two(false).at(0.5).place, 0.25 * DVec3::X);
        let eased = two(true);
        // 3s² − 2s³.
        assert!(eased.at(0.5).place.distance(DVec3::X * (3.0 / 16.0 - 2.0 / 64.0)) < 1e-15);
        assert!(eased.at(1.0).velocity.distance(0.75 * DVec3::X) < 1e-15);
        assert_eq!(eased.at(7.0).place, DVec3::X);
    }
}
