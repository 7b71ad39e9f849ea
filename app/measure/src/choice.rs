//! The best dial for a goal.

use std::fmt::{self, Display, Formatter};

use thiserror::Error;

use crate::row::Row;

/// Goal for which the renderers' dials are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// A frame time that 95 of 100 frames keep to.
    Budget {
        /// Frame time, milliseconds.
        ms: f64,
    },
    /// An error that 99 of 100 pixels keep to.
    Tolerance {
        /// Error of position, pixels.
        pixels: f64,
    },
}

impl Display for Goal {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Budget { ms } => write!(formatter, "budget {ms}ms"),
            Self::Tolerance { pixels } => write!(formatter, "tolerance {pixels}px"),
        }
    }
}

/// A goal that no setting reaches here.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ChoiceError {
    /// A budget for which every setting is too slow.
    #[error(
        "nothing was written, for no setting keeps to {budget_ms} ms a frame in 95 of 100 on this device; {flags} comes closest, with {ms:.1} ms; \
         a smaller --size is faster"
    )]
    TooSlow {
        /// Requested frame time, milliseconds.
        budget_ms: f64,
        /// Options of the fastest setting.
        flags: String,
        /// 95th percentile of its frame times, milliseconds.
        ms: f64,
    },
    /// A tolerance for which every setting is too far off.
    #[error(
        "nothing was written, for no setting keeps 99 of 100 pixels within {tolerance_px} pixels; {flags} comes closest, with {px:.2} pixels"
    )]
    TooFarOff {
        /// Requested error, pixels.
        tolerance_px: f64,
        /// Options of the closest setting.
        flags: String,
        /// 99th percentile of its errors, pixels.
        px: f64,
    },
    /// A scene of which no surface was seen.
    #[error("nothing was written, for no surface of this scene could be looked at; choose another --scene or --replay")]
    Nothing,
}

/// Row of the best dial. For a budget: the closest of those that keep to it in 95 of 100 frames. For a tolerance: the
/// fastest of those that keep to it in 99 of 100 pixels.
pub fn best(rows: &[Row], goal: Goal, pixel_arcmin: f64) -> Result<&Row, ChoiceError> {
    // A row without pixels has no errors, and does not count.
    let seen = || rows.iter().filter(|row| row.pixels > 0);
    let by = |key: fn(&Row) -> [f64; 2]| {
        move |a: &&Row, b: &&Row| {
            let ([a, then_a], [b, then_b]) = (key(a), key(b));
            a.total_cmp(&b).then(then_a.total_cmp(&then_b))
        }
    };
    let closer = by(|row| [row.arcmin[1], row.ms[0]]);
    let faster = by(|row| [row.ms[0], row.arcmin[1]]);
    match goal {
        Goal::Budget { ms: budget_ms } => seen().filter(|row| row.ms[1] <= budget_ms).min_by(closer).ok_or_else(|| {
            let fastest = seen().min_by(by(|row| [row.ms[1], row.arcmin[1]]));
            fastest.map_or(ChoiceError::Nothing, |row| ChoiceError::TooSlow {
                budget_ms,
                flags: row.dial.to_string(),
                ms: row.ms[1],
            })
        }),
        Goal::Tolerance { pixels } => {
            seen().filter(|row| row.arcmin[1] <= pixels * pixel_arcmin).min_by(faster).ok_or_else(|| {
                let closest = seen().min_by(closer);
                closest.map_or(ChoiceError::Nothing, |row| ChoiceError::TooFarOff {
                    tolerance_px: pixels,
                    flags: row.dial.to_string(),
                    px: row.arcmin[1] / pixel_arcmin,
                })
            })
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law: no setting that reaches the goal is better than the chosen one, and where none does, the nearest is named.

    use super::*;
    use view::Dial;

    /// Rows from metres of edge, 95th percentiles of time, and arcminutes.
    fn rows(of: &[(f64, f64, f64)]) -> Vec<Row> {
        let row = |&(edge, ms, arcmin): &(f64, f64, f64)| Row {
            dial: Dial::edge(edge),
            ms: [0.9 * ms, ms],
            stages_ms: [[0.0; 2]; 3],
            bytes: None,
            pixels: 1,
            arcmin: [0.0, arcmin, 2.0 * arcmin],
            above_one: 0.0,
            colour: None,
            best: false,
        };
        of.iter().map(row).collect()
    }

    #[test]
    fn the_best_that_reaches_the_goal_is_taken() {
        let rows = rows(&[(1.0, 5.0, 40.0), (2.0, 16.0, 12.0), (3.0, 17.0, 1.0), (4.0, 10.0, 12.0), (5.0, 90.0, 0.5)]);
        let edge = |goal| best(&rows, goal, 10.0).map(|row| row.dial.turned().unwrap().1);
        // Rows 2 and 4 are equally close, so the faster one is best.
        assert_eq!(edge(Goal::Budget { ms: 16.7 }), Ok(4.0));
        assert_eq!(edge(Goal::Budget { ms: 17.0 }), Ok(3.0));
        assert_eq!(edge(Goal::Budget { ms: 9.99 }), Ok(1.0));
        assert_eq!(edge(Goal::Tolerance { pixels: 1.0 }), Ok(3.0));
        assert_eq!(edge(Goal::Tolerance { pixels: 0.09 }), Ok(5.0));
        assert_eq!(edge(Goal::Tolerance { pixels: 10.0 }), Ok(1.0));
    }

    #[test]
    fn what_comes_closest_is_named_where_nothing_reaches_it() {
        let rows = rows(&[(1.0, 5.0, 40.0), (2.0, 16.0, 12.0)]);
        let told = |goal| best(&rows, goal, 10.0).unwrap_err().to_string();
        let slow = told(Goal::Budget { ms: 4.0 });
        assert!(slow.contains("--edge 1") && slow.contains("5.0 ms"), "{slow}");
        let far = told(Goal::Tolerance { pixels: 1.0 });
        assert!(far.contains("--edge 2") && far.contains("1.20 pixels"), "{far}");
        let unseen: Vec<Row> = rows.into_iter().map(|row| Row { pixels: 0, arcmin: [0.0; 3], ..row }).collect();
        assert_eq!(best(&unseen, Goal::Budget { ms: 90.0 }, 10.0), Err(ChoiceError::Nothing));
    }
}
