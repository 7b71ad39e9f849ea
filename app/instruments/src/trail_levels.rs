//! Points of a worldline in bounded memory: dense for the recent past, thinner for what is long ago.
//!
//! Points come into the first level. When it has grown to twice its size, its older half is thinned out: of every two
//! points, the one goes that bends the line less, and the rest moves to the next level, where the same happens later.
//! A ride of n points thus keeps about `SIZE` log₂(n / `SIZE`), and its corners longest.

use std::collections::VecDeque;

use crate::trail_point::TrailPoint;

/// Number of points of a level that stay.
const SIZE: usize = 1024;

/// Levels of points, the newest first.
#[derive(Clone, Debug, Default)]
pub struct TrailLevels {
    levels: Vec<VecDeque<TrailPoint>>,
}

impl TrailLevels {
    /// Appends a point that is newer than all others.
    pub fn push(&mut self, point: TrailPoint) {
        if self.levels.is_empty() {
            self.levels.push(VecDeque::new());
        }
        self.levels[0].push_back(point);
        for level in 0.. {
            if self.levels[level].len() < 2 * SIZE {
                return;
            }
            let older: Vec<TrailPoint> = self.levels[level].drain(..SIZE).collect();
            if level + 1 == self.levels.len() {
                self.levels.push(VecDeque::new());
            }
            self.levels[level + 1].extend(thinned(&older));
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.levels.iter().map(VecDeque::len).sum()
    }

    /// All points, the oldest first.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = &TrailPoint> {
        self.levels.iter().rev().flatten()
    }

    /// Newest point.
    pub fn last(&self) -> Option<&TrailPoint> {
        self.levels.first().and_then(VecDeque::back)
    }
}

/// Of every two points, the one that bends the line more. Beginnings of lines stay.
fn thinned(points: &[TrailPoint]) -> Vec<TrailPoint> {
    let bend = |index: usize| {
        let (before, after) = (index.checked_sub(1), points.get(index + 1));
        let (Some(before), Some(after), here) = (before.map(|n| &points[n]), after, &points[index]) else {
            return f64::INFINITY;
        };
        if here.begins {
            return f64::INFINITY;
        }
        let (to, from) = (here.event - before.event, after.event - before.event);
        let share = if from.t > 0.0 { to.t / from.t } else { 0.5 };
        (to.r - share * from.r).length()
    };
    let kept = |pair: usize| {
        let (one, other) = (2 * pair, 2 * pair + 1);
        let later = other < points.len() && bend(other) > bend(one);
        let begins = other < points.len() && points[other].begins;
        TrailPoint { begins: points[one].begins || begins, ..points[if later { other } else { one }] }
    };
    (0..points.len().div_ceil(2)).map(kept).collect()
}
