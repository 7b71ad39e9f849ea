//! The retarded event of an accelerated point: where and when its worldline crosses the observer's past light cone.
//!
//! An observer sees a point at the event at which the point's worldline crosses the observer's past light cone. With t
//! the world's time, x(t) the worldline and o the observer, that is the root of f(t) = (t_o − t) − |x(t) − o|. A point
//! slower than light, |dx/dt| < 1, makes f strictly decreasing: there is at most one root, and it stays bracketed
//! while Newton's method, f' = −1 − n·β, closes in on it. (The theses solve uniform motion only, W 5.1.2.)

use glam::DVec3;
use thiserror::Error;

use crate::event::Event;
use crate::newton::{Newton, NewtonError, RootInterval};

/// Number of looks at a worldline after which the search is given up: three times what bisecting an f64 to its last bit
/// takes.
const MOST_LOOKS: usize = 200;

/// The worldline of a point: its position and velocity as functions of world time.
pub trait Worldline {
    /// Position in metres and velocity v/c at world time `ct`, metres.
    fn at(&self, ct: f64) -> (DVec3, DVec3);
}

/// Event at which an observer sees a point, with the point's velocity there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Retarded {
    /// World time at which the light left, metres.
    pub ct: f64,
    /// World position at that time, metres.
    pub position: DVec3,
    /// Velocity v/c at that time.
    pub beta: DVec3,
}

/// The reasons why a point is not seen.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum NotSeen {
    /// A worldline that is faster than light somewhere on the way back to the light cone.
    #[error("it moves at {speed} times the speed of light at ct = {ct} m")]
    FasterThanLight {
        /// World time at which it is, metres.
        ct: f64,
        /// Speed there, |v|/c.
        speed: f64,
    },
    /// A worldline that gives no finite position, or never crosses the light cone.
    #[error("its worldline does not cross the past light cone after ct = {ct} m")]
    Never {
        /// Earliest world time looked at, metres.
        ct: f64,
    },
    /// A worldline on which the search for the retarded event does not end: its velocity is not that of its motion.
    #[error("the search for the event at which it is seen did not converge near ct = {ct} m")]
    NotConverged {
        /// World time looked at last, metres.
        ct: f64,
    },
}

/// The event at which `observer` sees the point that moves along `worldline`.
///
/// *Frames:* all in the world. *Errors:* [`NotSeen`].
pub fn retarded(observer: Event, worldline: &impl Worldline) -> Result<Retarded, NotSeen> {
    let look = |ct: f64| {
        let (position, beta) = worldline.at(ct);
        let speed = beta.length();
        if speed >= 1.0 {
            return Err(NotSeen::FasterThanLight { ct, speed });
        }
        let towards = position - observer.position;
        let distance = towards.length();
        if !distance.is_finite() {
            return Err(NotSeen::Never { ct });
        }
        Ok((Retarded { ct, position, beta }, (observer.ct - ct) - distance, towards / distance.max(f64::MIN_POSITIVE)))
    };

    // Bracket: now it is outside the cone (f ≤ 0); go back, twice as far each time, until it is inside.
    let (now, lag, _) = look(observer.ct)?;
    if lag >= 0.0 {
        return Ok(now);
    }
    let (mut high, mut step) = (observer.ct, -lag);
    let mut low = observer.ct - step;
    while look(low)?.1 < 0.0 {
        high = low;
        step *= 2.0;
        low = observer.ct - step;
        if !low.is_finite() || step > 1e300 {
            return Err(NotSeen::Never { ct: low });
        }
    }

    // Solve from the earlier end.
    let interval = RootInterval::Bracket { low, high, sign_at_low: 1.0 };
    let search = Newton { tolerance: 0.0, most_steps: MOST_LOOKS };
    let ct = search.root(interval, low, |ct| {
        let (seen, lag, direction) = look(ct)?;
        Ok((lag, -(1.0 + direction.dot(seen.beta))))
    });
    match ct {
        Ok(ct) => look(ct).map(|(seen, ..)| seen),
        Err(NewtonError::Function(not_seen)) => Err(not_seen),
        Err(NewtonError::NotConverged { x: ct, .. } | NewtonError::Left { x: ct, .. }) => {
            Err(NotSeen::NotConverged { ct })
        }
    }
}
