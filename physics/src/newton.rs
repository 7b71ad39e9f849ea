//! Roots of a function of one variable: Newton's method, safeguarded by bisection.
//!
//! Newton's step x − f/f' doubles the digits of a root each time, once it is near; far from it the step may lead
//! anywhere. Where the root is bracketed, by two places at which f has opposite signs, every value of f shrinks the
//! bracket, and a step that would not land strictly inside it is replaced by the bracket's middle: the search cannot
//! leave, and no cycle of Newton's steps can last, since each of its places becomes an end. Where no bracket is known,
//! a step that leaves the range ends the search. A search that is still under way after its last step says so.

use thiserror::Error;

/// Interval in which a root is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RootInterval {
    /// An interval whose ends have values of opposite signs, so that a root lies between them.
    Bracket {
        /// Lower end of the interval.
        low: f64,
        /// Upper end of the interval.
        high: f64,
        /// A number with the sign that the function has at the lower end.
        sign_at_low: f64,
    },
    /// An interval that may hold a root or not.
    Range {
        /// Lower end of the interval.
        low: f64,
        /// Upper end of the interval.
        high: f64,
    },
}

/// A search for a root: when it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newton {
    /// A step this small, as a share of |x|, ends the search. 0 goes on until the function is zero or the bracket holds
    /// no other f64. A [`RootInterval::Range`] needs a few roundings: the last steps may alternate between neighbours.
    pub tolerance: f64,
    /// Largest number of values of the function that are asked for.
    pub most_steps: usize,
}

/// The reasons why a search ends without a root.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum NewtonError<E> {
    /// The function has no value somewhere on the way.
    #[error(transparent)]
    Function(E),
    /// A step out of a [`RootInterval::Range`], or a place where the function is flat.
    #[error("Newton's method leaves the range from {low} to {high} at {x}")]
    Left {
        /// Place from which the step led out.
        x: f64,
        /// Lower end of the range.
        low: f64,
        /// Upper end of the range.
        high: f64,
    },
    /// A search that had not ended after its last step.
    #[error("Newton's method did not converge in {steps} steps; the last took it to {x}")]
    NotConverged {
        /// Place that the last step led to.
        x: f64,
        /// Number of steps taken.
        steps: usize,
    },
}

impl Newton {
    /// The root of `function` in `interval`, from a first guess `start` inside it.
    ///
    /// `function` gives the value and the derivative. The result is a place at which it was asked.
    ///
    /// # Errors
    ///
    /// [`NewtonError`]: the function has no value, the range holds no root that Newton's method finds, or the search
    /// did not end in as many steps as it may take.
    ///
    /// # Example
    ///
    /// √2 from a start at which x² − 2 is nearly flat:
    ///
    /// ```
    /// use physics::newton::{Newton, RootInterval};
    /// let interval = RootInterval::Bracket { low: 0.0, high: 2.0, sign_at_low: -1.0 };
    /// let search = Newton { tolerance: 1e-15, most_steps: 100 };
    /// let root = search.root(interval, 1e-9, |x| Ok::<_, ()>((x * x - 2.0, 2.0 * x)));
    /// assert!((root.unwrap() - 2.0_f64.sqrt()).abs() < 1e-15);
    /// ```
    pub fn root<E>(
        &self,
        mut interval: RootInterval,
        start: f64,
        mut function: impl FnMut(f64) -> Result<(f64, f64), E>,
    ) -> Result<f64, NewtonError<E>> {
        let mut x = start;
        for _ in 0..self.most_steps {
            let (value, slope) = function(x).map_err(NewtonError::Function)?;

            // Shrink the bracket to the side of the root.
            if let RootInterval::Bracket { low, high, sign_at_low } = &mut interval {
                if value * sign_at_low.signum() > 0.0 { *low = x } else { *high = x }
            }
            let step = value / slope;
            if value == 0.0 || step.abs() <= self.tolerance * x.abs() {
                return Ok(x);
            }

            // Step, or halve the bracket where the step would not land inside it.
            let newton = x - step;
            x = match interval {
                RootInterval::Bracket { low, high, .. } if !(newton > low && newton < high) => {
                    let middle = 0.5 * (low + high);
                    if !(middle > low && middle < high) {
                        return Ok(x);
                    }
                    middle
                }
                RootInterval::Range { low, high } if !(low..=high).contains(&newton) => {
                    return Err(NewtonError::Left { x, low, high });
                }
                _ => newton,
            };
        }
        Err(NewtonError::NotConverged { x, steps: self.most_steps })
    }
}
