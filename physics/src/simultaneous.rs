//! The event of a worldline that is simultaneous with an observer's, for that observer.
//!
//! With t the world's time, x(t) the worldline and o the observer, of celerity u, it is the root of f(t) = (t − t_o) −
//! β_o·(x(t) − x_o): the hyperplane of the observer's present (W 4.1). A point slower than light makes f strictly
//! increasing, f' = 1 − β_o·β > 0, so there is at most one root, and it stays bracketed while Newton's method closes in
//! on it. At uniform motion the first step hits it.

use thiserror::Error;

use crate::newton::{Newton, NewtonError, RootInterval};
use crate::observer::Observer;
use crate::retarded::Worldline;
use glam::DVec3;

/// Number of looks at a worldline after which the search is given up: three times what bisecting an f64 to its last bit
/// takes.
const MOST_LOOKS: usize = 200;

/// Event of a worldline at an observer's present, with the point's velocity there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PresentEvent {
    /// World time, metres.
    pub ct: f64,
    /// World position at that time, metres.
    pub position: DVec3,
    /// Velocity v/c at that time.
    pub beta: DVec3,
}

/// The reasons why a point has no place at an observer's present.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum NotPresent {
    /// A worldline that is faster than light somewhere on the way to the observer's present.
    #[error("it moves at {speed} times the speed of light at ct = {ct} m")]
    FasterThanLight {
        /// World time at which it is, metres.
        ct: f64,
        /// Speed there, |v|/c.
        speed: f64,
    },
    /// A worldline that gives no finite position, or never crosses the observer's present.
    #[error("its worldline does not cross the observer's present as far as ct = {ct} m")]
    Never {
        /// World time looked at last, metres.
        ct: f64,
    },
    /// A worldline on which the search does not end: its velocity is not that of its motion.
    #[error("the search for its event at the observer's present did not converge near ct = {ct} m")]
    NotConverged {
        /// World time looked at last, metres.
        ct: f64,
    },
}

/// The event of `worldline` that has, for `observer`, the same time as the observer's own event.
///
/// *Frames:* all in the world. *Errors:* [`NotPresent`].
pub fn simultaneous(observer: &Observer, worldline: &impl Worldline) -> Result<PresentEvent, NotPresent> {
    let of_observer = observer.celerity.beta().vector();
    let look = |ct: f64| {
        let (position, beta) = worldline.at(ct);
        let speed = beta.length();
        if speed >= 1.0 {
            return Err(NotPresent::FasterThanLight { ct, speed });
        }
        let lag = (ct - observer.event.ct) - of_observer.dot(position - observer.event.position);
        if !lag.is_finite() {
            return Err(NotPresent::Never { ct });
        }
        Ok((PresentEvent { ct, position, beta }, lag, 1.0 - of_observer.dot(beta)))
    };

    // Bracket: at the world's present it is before the observer's (f < 0) or after. Go that way, twice as far each
    // time.
    let start = observer.event.ct;
    let (now, lag, _) = look(start)?;
    if lag == 0.0 {
        return Ok(now);
    }
    let (mut near, mut step) = (start, -lag);
    let mut far = start + step;
    while look(far)?.1 * lag > 0.0 {
        near = far;
        step *= 2.0;
        far = start + step;
        if !far.is_finite() || step.abs() > 1e300 {
            return Err(NotPresent::Never { ct: far });
        }
    }

    let interval = RootInterval::Bracket { low: near.min(far), high: near.max(far), sign_at_low: -1.0 };
    let search = Newton { tolerance: 0.0, most_steps: MOST_LOOKS };
    let found = search.root(interval, near, |ct| look(ct).map(|(_, lag, slope)| (lag, slope)));
    match found {
        Ok(ct) => look(ct).map(|(present, ..)| present),
        Err(NewtonError::Function(not_present)) => Err(not_present),
        Err(NewtonError::NotConverged { x: ct, .. } | NewtonError::Left { x: ct, .. }) => {
            Err(NotPresent::NotConverged { ct })
        }
    }
}
