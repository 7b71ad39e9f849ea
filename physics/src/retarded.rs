//! Where an accelerated point is seen: its retarded event, found on whatever worldline it has.
//!
//! An observer sees a point at the event where its worldline crosses his past light cone. With t the world's time, x(t) the worldline and
//! o the observer, that is the root of f(t) = (t_o − t) − |x(t) − o|. Slower than light, |dx/dt| < 1, makes f strictly
//! decreasing: there is at most one root, and it stays bracketed while Newton's method, f' = −1 − n·β, closes in on it (the theses solve
//! uniform motion only, W 5.1.2).

use glam::DVec3;
use thiserror::Error;

use crate::event::Event;

/// Where a point is at each time of the world.
pub trait Worldline {
    /// Position in metres and velocity v/c at world time `ct`, metres.
    fn at(&self, ct: f64) -> (DVec3, DVec3);
}

/// The event at which an observer sees a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Retarded {
    /// World time at which the light left, metres.
    pub ct: f64,
    /// World position at that time, metres.
    pub position: DVec3,
    /// Velocity v/c at that time.
    pub beta: DVec3,
}

/// Why a point is not seen.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum NotSeen {
    /// The worldline is faster than light somewhere on the way back to the light cone.
    #[error("it moves at {speed} times the speed of light at ct = {ct} m")]
    FasterThanLight {
        /// World time, metres.
        ct: f64,
        /// |v|/c.
        speed: f64,
    },
    /// The worldline gives no finite place, or never crosses the light cone.
    #[error("its worldline does not cross the past light cone after ct = {ct} m")]
    Never {
        /// Earliest world time looked at, metres.
        ct: f64,
    },
}

/// Finds the event at which `observer` sees what moves along `worldline`.
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
    let (mut late, mut step) = (observer.ct, -lag);
    let mut early = observer.ct - step;
    let mut guess = loop {
        let (seen, lag, _) = look(early)?;
        if lag >= 0.0 {
            break seen;
        }
        late = early;
        step *= 2.0;
        early = observer.ct - step;
        if !early.is_finite() || step > 1e300 {
            return Err(NotSeen::Never { ct: early });
        }
    };

    // Newton from wherever is best, bisection where that leaves the bracket.
    for _ in 0..200 {
        let (seen, lag, direction) = look(guess.ct)?;
        if lag >= 0.0 {
            early = seen.ct;
        } else {
            late = seen.ct;
        }
        guess = seen;
        let newton = seen.ct + lag / (1.0 + direction.dot(seen.beta));
        let next = if newton > early && newton < late { newton } else { 0.5 * (early + late) };
        if lag == 0.0 || next == seen.ct || next <= early || next >= late {
            break;
        }
        guess.ct = next;
    }
    look(guess.ct).map(|(seen, ..)| seen)
}
