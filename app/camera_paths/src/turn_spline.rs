//! Turns between keys: a curve of rotations whose rate of turn is continuous, whatever the times of the keys.
//!
//! *Equation:* Bézier's cubic in its cumulative form on the sphere of quaternions, q(s) = q₀ exp(w₁ B₁(s)) exp(w₂
//! B₂(s)) exp(w₃ B₃(s)) (Kim, Kim and Shin, SIGGRAPH 1995), with w₁ and w₃ a third of the turn that the rates at the
//! two keys make in the interval, and w₂ what is left. Rates at the keys are the means of the rates on both sides, each
//! weighted by the other's length; a rest on one side makes it zero, so that a look that is held does not swing.

use glam::{DQuat, DVec3};

/// Turn of an interval below which it is a rest, radians.
const REST: f64 = 1e-9;

/// Curve of rotations through keys.
#[derive(Clone, Debug)]
pub(crate) struct TurnSpline {
    times_s: Vec<f64>,
    /// Rotations at the keys; neighbours have the same sign.
    turns: Vec<DQuat>,
    /// Rates of turn at the keys, radians per second, in the axes that are turned.
    rates: Vec<DVec3>,
}

impl TurnSpline {
    /// Curve through at least one rotation at ascending times.
    pub(crate) fn new(times_s: Vec<f64>, mut turns: Vec<DQuat>) -> Self {
        for key in 1..turns.len() {
            if turns[key - 1].dot(turns[key]) < 0.0 {
                turns[key] = -turns[key];
            }
        }
        let length = |interval: usize| times_s[interval + 1] - times_s[interval];
        let between: Vec<DVec3> = turns.windows(2).map(|ends| logarithm(ends[0].conjugate() * ends[1])).collect();
        let rate = |interval: usize| between[interval] / length(interval);
        let last = turns.len() - 1;
        let rates = (0..turns.len()).map(|key| match key {
            _ if last == 0 => DVec3::ZERO,
            0 => rate(0),
            key if key == last => rate(key - 1),
            key if between[key - 1].length() < REST || between[key].length() < REST => DVec3::ZERO,
            key => {
                let [before, after] = [length(key - 1), length(key)];
                (rate(key - 1) * after + rate(key) * before) / (before + after)
            }
        });
        let rates = rates.collect();
        Self { times_s, turns, rates }
    }

    /// Rotation at a time; before the first key and after the last that of the key.
    pub(crate) fn at(&self, time_s: f64) -> DQuat {
        let after = self.times_s.partition_point(|key| *key <= time_s);
        if after == 0 {
            return self.turns[0];
        }
        if after == self.turns.len() {
            return self.turns[after - 1];
        }
        let before = after - 1;
        let length = self.times_s[after] - self.times_s[before];
        let s = (time_s - self.times_s[before]) / length;
        let [from, to] = [self.turns[before], self.turns[after]];
        let [leaves, arrives] = [self.rates[before], self.rates[after]].map(|rate| rate * (length / 3.0));
        let rest = logarithm(exponential(-leaves) * (from.conjugate() * to) * exponential(-arrives));
        let r = 1.0 - s;
        let [first, second, third] = [1.0 - r * r * r, s * s * (3.0 - 2.0 * s), s * s * s];
        (from * exponential(leaves * first) * exponential(rest * second) * exponential(arrives * third)).normalize()
    }
}

/// Rotation by a vector along its axis, radians.
fn exponential(turn: DVec3) -> DQuat {
    let half = 0.5 * turn.length();
    // sin x / x is 1 to rounding there.
    let share = if half < 1e-9 { 0.5 } else { 0.5 * libm::sin(half) / half };
    let vector = turn * share;
    DQuat::from_xyzw(vector.x, vector.y, vector.z, libm::cos(half))
}

/// Vector along a rotation's axis, radians, the shorter way round.
fn logarithm(turn: DQuat) -> DVec3 {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let vector = DVec3::new(turn.x, turn.y, turn.z);
    let sine = vector.length();
    if sine < 1e-12 { 2.0 * vector } else { vector * (2.0 * libm::atan2(sine, turn.w) / sine) }
}

#[cfg(test)]
mod tests {
    //! Law: turns pass through their keys without a leap of their rate, two of them make an even turn, and what is held
    //! does not swing. Slerp from key to key leaps in its rate at each.
    use super::*;
    use std::f64::consts::PI;

    fn rate(spline: &TurnSpline, time_s: f64, step_s: f64) -> DVec3 {
        logarithm(spline.at(time_s).conjugate() * spline.at(time_s + step_s)) / step_s
    }

    #[test]
    fn keys_are_met_and_the_rate_does_not_leap() {
        let times = vec![0.0, 1.0, 1.2, 4.0, 4.5];
        let turns = vec![
            DQuat::IDENTITY,
            DQuat::from_rotation_y(1.9),
            DQuat::from_rotation_y(2.0) * DQuat::from_rotation_x(0.4),
            -(DQuat::from_rotation_z(-1.0) * DQuat::from_rotation_y(2.9)),
            DQuat::from_rotation_x(1.0),
        ];
        let spline = TurnSpline::new(times.clone(), turns.clone());
        for (key, time) in times.iter().enumerate() {
            assert!(spline.at(*time).dot(turns[key]).abs() > 1.0 - 1e-14, "key {key}");
            if key > 0 && key < 4 {
                let [before, after] = [-1e-6, 1e-6].map(|step| rate(&spline, *time, step));
                assert!(before.distance(after) < 1e-3, "{before} and {after} at {time}");
            }
        }
    }

    #[test]
    fn an_even_turn_is_even_and_a_held_look_rests() {
        let even: Vec<DQuat> = [0.0, 0.3, 1.5, 1.8].map(|time| DQuat::from_rotation_y(1.7 * time)).to_vec();
        let spline = TurnSpline::new(vec![0.0, 0.3, 1.5, 1.8], even);
        for step in 0..=18 {
            let time = 0.1 * f64::from(step);
            let expected = DQuat::from_rotation_y(1.7 * time);
            assert!(spline.at(time).dot(expected).abs() > 1.0 - 1e-14, "{time}");
        }
        let held = [0.0, 0.0, PI / 2.0, PI / 2.0].map(DQuat::from_rotation_y).to_vec();
        let held = TurnSpline::new(vec![0.0, 1.0, 2.0, 3.0], held);
        for (time, angle) in [(0.5, 0.0), (2.7, PI / 2.0), (9.0, PI / 2.0), (1.5, PI / 4.0)] {
            assert!(held.at(time).dot(DQuat::from_rotation_y(angle)).abs() > 1.0 - 1e-14, "{time}");
        }
    }
}
