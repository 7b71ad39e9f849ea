//! Track: one quantity, a position, a rotation or scale factors, as a function of time in seconds.
//!
//! Keys are shared by all bodies that hang on them: a file may use the same ones for thousands.
//!
//! The interpolations are glTF's LINEAR and CUBICSPLINE (2.0, appendix C), with their derivatives. Between two linear
//! keys a rotation turns evenly about one axis, the shorter way round (slerp), so attached points move on an exact
//! circle. Before the first key and after the last the quantity is constant, unless the keys repeat.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use thiserror::Error;

/// Quantity that is constant or given by keys.
#[derive(Clone, Debug, PartialEq)]
pub enum Track<V> {
    /// Constant value.
    Fixed(V),
    /// Value given by keys.
    Keyed(TrackKeys<V>),
}

/// Values at given times, and their interpolation.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackKeys<V> {
    times_s: Arc<[f64]>,
    values: Arc<[V]>,
    /// Slopes into and out of each key, per second; `None` for linear interpolation.
    tangents: Option<Arc<[[V; 2]]>>,
    /// Start and end of the period, seconds, if the keys repeat for ever.
    repeats: Option<[f64; 2]>,
}

/// Reason why keys are refused.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum KeyFault {
    /// Lists of times and values whose lengths do not match.
    #[error("it has {times} times and {values} values")]
    Lengths {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// Times that do not ascend.
    #[error("its times do not ascend at key {key}")]
    Order {
        /// Index of the key.
        key: usize,
    },
    /// A value or time that is not finite.
    #[error("key {key} is not finite")]
    NotFinite {
        /// Index of the key.
        key: usize,
    },
    /// A quaternion of length zero.
    #[error("key {key} is no rotation")]
    NoRotation {
        /// Index of the key.
        key: usize,
    },
}

/// Position of a time among the keys.
enum KeyPlace {
    At(usize),
    Between { before: usize, share: f64, length_s: f64 },
}

impl<V: Copy> TrackKeys<V> {
    fn checked(
        times_s: Vec<f64>,
        values: Vec<V>,
        tangents: Option<Vec<[V; 2]>>,
        finite: impl Fn(&V) -> bool,
    ) -> Result<Self, KeyFault> {
        let whole = tangents.as_ref().is_none_or(|tangents| tangents.len() == values.len());
        if times_s.is_empty() || times_s.len() != values.len() || !whole {
            return Err(KeyFault::Lengths { times: times_s.len(), values: values.len() });
        }
        for key in 0..values.len() {
            let slopes = tangents.iter().all(|tangents| tangents[key].iter().all(&finite));
            if !(times_s[key].is_finite() && finite(&values[key]) && slopes) {
                return Err(KeyFault::NotFinite { key });
            }
            if key > 0 && times_s[key] <= times_s[key - 1] {
                return Err(KeyFault::Order { key });
            }
        }
        let (times_s, values) = (times_s.into(), values.into());
        Ok(Self { times_s, values, tangents: tangents.map(Into::into), repeats: None })
    }

    /// Times of the first key and of the last, seconds.
    pub fn span_s(&self) -> [f64; 2] {
        [self.times_s[0], self.times_s[self.times_s.len() - 1]]
    }

    /// Values at the first key and at the last.
    pub fn ends(&self) -> [V; 2] {
        [self.values[0], self.values[self.values.len() - 1]]
    }

    /// Times of all keys, seconds.
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// Period after which the keys repeat, seconds; `None` if they do not.
    pub fn period_s(&self) -> Option<f64> {
        self.repeats.map(|[from, to]| to - from)
    }

    /// Repeats the keys for ever with the period from `from` to `to`. The last value becomes `end`, so that both ends
    /// agree to the last bit.
    pub fn repeating(mut self, [from, to]: [f64; 2], end: V) -> Self {
        let mut values = self.values.to_vec();
        if let Some(last) = values.last_mut() {
            *last = end;
        }
        self.values = values.into();
        self.repeats = Some([from, to]);
        self
    }

    fn place(&self, time_s: f64) -> KeyPlace {
        let time = match self.repeats {
            Some([from, to]) => from + (time_s - from).rem_euclid(to - from),
            None => time_s,
        };
        let after = self.times_s.partition_point(|&key| key <= time);
        if after == 0 {
            return KeyPlace::At(0);
        }
        if after == self.times_s.len() {
            return KeyPlace::At(after - 1);
        }
        let [from, to] = [self.times_s[after - 1], self.times_s[after]];
        KeyPlace::Between { before: after - 1, share: (time - from) / (to - from), length_s: to - from }
    }
}

/// Hermite's polynomials of two values and two slopes (scaled to the whole interval), and their derivatives with
/// respect to the share of the interval.
fn hermite(share: f64) -> ([f64; 4], [f64; 4]) {
    let (s, r) = (share, 1.0 - share);
    let values = [r * r * (1.0 + 2.0 * s), s * s * (1.0 + 2.0 * r), s * r * r, -s * s * r];
    let rates = [-6.0 * s * r, 6.0 * s * r, r * (r - 2.0 * s), s * (s - 2.0 * r)];
    (values, rates)
}

impl TrackKeys<DVec3> {
    /// Makes keys with linear interpolation.
    ///
    /// # Errors
    /// [`KeyFault`].
    pub fn linear(times_s: Vec<f64>, values: Vec<DVec3>) -> Result<Self, KeyFault> {
        Self::checked(times_s, values, None, |value| value.is_finite())
    }

    /// Makes keys with cubic interpolation; `tangents`: velocities into and out of each key, per second.
    ///
    /// # Errors
    /// [`KeyFault`].
    pub fn cubic(times_s: Vec<f64>, values: Vec<DVec3>, tangents: Vec<[DVec3; 2]>) -> Result<Self, KeyFault> {
        Self::checked(times_s, values, Some(tangents), |value| value.is_finite())
    }

    /// Value at a time, and its change per second.
    fn at(&self, time_s: f64) -> (DVec3, DVec3) {
        let (before, share, length_s) = match self.place(time_s) {
            KeyPlace::At(key) => return (self.values[key], DVec3::ZERO),
            KeyPlace::Between { before, share, length_s } => (before, share, length_s),
        };
        let (a, b) = (self.values[before], self.values[before + 1]);
        let Some(tangents) = &self.tangents else { return (a + (b - a) * share, (b - a) / length_s) };
        let ([_, to, leave, arrive], [_, to_rate, leave_rate, arrive_rate]) = hermite(share);
        let (out, into) = (tangents[before][1] * length_s, tangents[before + 1][0] * length_s);
        let rate = (b - a) * to_rate + out * leave_rate + into * arrive_rate;
        (a + (b - a) * to + out * leave + into * arrive, rate / length_s)
    }
}

impl TrackKeys<DQuat> {
    /// Makes keys of rotations that turn evenly from key to key, the shorter way round (slerp).
    ///
    /// # Errors
    /// [`KeyFault`].
    pub fn slerp(times_s: Vec<f64>, values: Vec<DQuat>) -> Result<Self, KeyFault> {
        let mut keys = Self::checked(times_s, values, None, |value| value.is_finite())?;
        if let Some(key) = keys.values.iter().position(|value| !value.length().is_normal()) {
            return Err(KeyFault::NoRotation { key });
        }
        keys.values = keys.values.iter().map(|value| value.normalize()).collect();
        Ok(keys)
    }

    /// Makes keys of rotations with cubic interpolation, component by component; `tangents`: changes into and out of
    /// each key, per second.
    ///
    /// # Errors
    /// [`KeyFault`].
    pub fn cubic_rotation(times_s: Vec<f64>, values: Vec<DQuat>, tangents: Vec<[DQuat; 2]>) -> Result<Self, KeyFault> {
        let keys = Self::checked(times_s, values, Some(tangents), |value| value.is_finite())?;
        match keys.values.iter().position(|value| !value.length().is_normal()) {
            Some(key) => Err(KeyFault::NoRotation { key }),
            None => Ok(keys),
        }
    }

    /// Rotation at a time, and its angular velocity about its own turned axes, radians per second.
    fn at(&self, time_s: f64) -> (DQuat, DVec3) {
        let (before, share, length_s) = match self.place(time_s) {
            KeyPlace::At(key) => return (self.values[key].normalize(), DVec3::ZERO),
            KeyPlace::Between { before, share, length_s } => (before, share, length_s),
        };
        let (a, b) = (self.values[before], self.values[before + 1]);
        let Some(tangents) = &self.tangents else {
            let between = a.conjugate() * if a.dot(b) < 0.0 { -b } else { b };
            let vector = between.xyz();
            let sine = vector.length();
            if sine == 0.0 {
                return (a, DVec3::ZERO);
            }
            let angle = 2.0 * sine.atan2(between.w);
            let axis = vector / sine;
            return (a * DQuat::from_axis_angle(axis, angle * share), axis * (angle / length_s));
        };
        let ([from, to, leave, arrive], [from_rate, to_rate, leave_rate, arrive_rate]) = hermite(share);
        let (out, into) = (tangents[before][1] * length_s, tangents[before + 1][0] * length_s);
        let mixed = a * from + b * to + out * leave + into * arrive;
        let rate = (a * from_rate + b * to_rate + out * leave_rate + into * arrive_rate) * (1.0 / length_s);
        let length = mixed.length();
        if !length.is_normal() {
            return (a.normalize(), DVec3::ZERO);
        }
        // ω = 2 q* q' for a unit q. A change of length alone is no turn, and falls to the real part.
        let turn = (mixed.conjugate() * rate) * (2.0 / (length * length));
        (mixed * (1.0 / length), turn.xyz())
    }
}

impl Track<DVec3> {
    /// Value at a time, and its change per second.
    pub(super) fn at(&self, time_s: f64) -> (DVec3, DVec3) {
        match self {
            Self::Fixed(value) => (*value, DVec3::ZERO),
            Self::Keyed(keys) => keys.at(time_s),
        }
    }

    /// Box that holds every value: its least corner and its greatest.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        let keys = match self {
            Self::Fixed(value) => return [*value; 2],
            Self::Keyed(keys) => keys,
        };
        let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let mut add = |value: DVec3| bounds = [bounds[0].min(value), bounds[1].max(value)];
        keys.values.iter().for_each(|value| add(*value));
        // A cubic lies within its four control points.
        for (key, tangents) in keys.tangents.iter().flat_map(|tangents| tangents.iter()).enumerate() {
            if key + 1 < keys.values.len() {
                add(keys.values[key] + tangents[1] * ((keys.times_s[key + 1] - keys.times_s[key]) / 3.0));
            }
            if key > 0 {
                add(keys.values[key] - tangents[0] * ((keys.times_s[key] - keys.times_s[key - 1]) / 3.0));
            }
        }
        bounds
    }
}

impl Track<DQuat> {
    /// Rotation at a time, and its angular velocity about its own turned axes, radians per second.
    pub(super) fn at(&self, time_s: f64) -> (DQuat, DVec3) {
        match self {
            Self::Fixed(value) => (*value, DVec3::ZERO),
            Self::Keyed(keys) => keys.at(time_s),
        }
    }
}

impl<V: Copy> Track<V> {
    pub(crate) fn keys(&self) -> Option<&TrackKeys<V>> {
        match self {
            Self::Fixed(_) => None,
            Self::Keyed(keys) => Some(keys),
        }
    }
}

#[cfg(test)]
mod tests {
    //! Laws under test: rates are the derivatives of values, linear turns are even, and repeating keys repeat for
    //! ever, into the past too. A wrong sign or a wrong frame of the angular velocity differs from finite
    //! differences.

    use super::*;

    /// Velocity of a turned place by the rotation's rate, R' = R [ω]×, and by finite differences.
    fn turned(keys: &TrackKeys<DQuat>, time_s: f64, place: DVec3) -> (DVec3, DVec3) {
        let step = 1e-6;
        let [before, after] = [-step, step].map(|step| keys.at(time_s + step).0 * place);
        let (rotation, rate) = keys.at(time_s);
        (rotation * rate.cross(place), (after - before) / (2.0 * step))
    }

    #[test]
    fn rates_are_derivatives() {
        let times = vec![0.0, 1.0, 3.0];
        let turns =
            [DQuat::IDENTITY, DQuat::from_rotation_y(1.9), -DQuat::from_rotation_x(0.8)].map(|q| q * 1.0).to_vec();
        let slopes = [[0.2, -0.1], [0.4, 0.3], [-0.2, 0.5]]
            .map(|pair| pair.map(|s| DQuat::from_xyzw(s, 0.3 * s, -s, 0.1)))
            .to_vec();
        let place = DVec3::new(0.3, -0.7, 1.1);
        for keys in [
            TrackKeys::slerp(times.clone(), turns.clone()).unwrap(),
            TrackKeys::cubic_rotation(times.clone(), turns, slopes).unwrap(),
        ] {
            for time in [0.2, 0.9, 1.4, 2.8] {
                let (said, found) = turned(&keys, time, place);
                assert!(said.distance(found) < 1e-8, "{said} {found} at {time}");
            }
        }
        let values = vec![DVec3::X, DVec3::new(0.0, 2.0, 1.0), DVec3::Z];
        let tangents = vec![[DVec3::X, DVec3::Y], [DVec3::Z, DVec3::X], [DVec3::Y, DVec3::Y]];
        let keys = TrackKeys::cubic(times, values.clone(), tangents).unwrap();
        for (key, time) in [0.0, 1.0, 3.0].into_iter().enumerate() {
            assert!(keys.at(time).0.distance(values[key]) < 1e-15);
        }
        assert!(keys.at(1.0).1.distance(DVec3::X) < 1e-15 && keys.at(5.0).1 == DVec3::ZERO);
        for time in [0.3, 0.99, 1.7] {
            let difference = (keys.at(time + 1e-6).0 - keys.at(time - 1e-6).0) / 2e-6;
            assert!(keys.at(time).1.distance(difference) < 1e-8);
        }
    }

    #[test]
    fn what_repeats_was_always_so() {
        let keys = TrackKeys::linear(vec![1.0, 2.0, 4.0], vec![DVec3::ZERO, DVec3::X, DVec3::ZERO]).unwrap();
        assert_eq!(keys.at(-7.0).0, DVec3::ZERO);
        let keys = keys.repeating([1.0, 4.0], DVec3::ZERO);
        for turn in [-5.0, -1.0, 0.0, 3.0] {
            let (value, rate) = keys.at(3.0 + 3.0 * turn);
            assert_eq!((value, rate), (DVec3::X * 0.5, DVec3::X * -0.5));
        }
    }

    #[test]
    fn keys_that_are_none_are_refused() {
        let linear = |times: &[f64], count| TrackKeys::linear(times.to_vec(), vec![DVec3::ZERO; count]);
        assert_eq!(linear(&[], 0), Err(KeyFault::Lengths { times: 0, values: 0 }));
        assert_eq!(linear(&[0.0, 0.0], 2), Err(KeyFault::Order { key: 1 }));
        assert_eq!(linear(&[f64::NAN], 1), Err(KeyFault::NotFinite { key: 0 }));
        let none = TrackKeys::slerp(vec![0.0], vec![DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0)]);
        assert_eq!(none, Err(KeyFault::NoRotation { key: 0 }));
    }
}
