//! Budget of memory: one sum over all that a file makes the program hold.
//!
//! A file of few bytes may ask for many: a picture that is all one colour, an accessor of zeros, a buffer that is named
//! again and again. Every reader takes bytes from the budget before it allocates them, so that the sum is refused
//! before the memory is asked for.

use std::sync::atomic::{AtomicU64, Ordering};
use thiserror::Error;

/// Memory that the files of one request may take, bytes. Threads share it.
#[derive(Debug)]
pub struct Budget {
    limit: u64,
    used: AtomicU64,
}

/// More memory than the budget has left.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error(
    "it would take {:.1} GB of memory, above the limit of {:.1} GB; use a smaller file, or raise the limit with --limit",
    *asked as f64 * 1e-9, *limit as f64 * 1e-9
)]
pub struct OverBudget {
    /// Sum of the memory, with the part that was refused, bytes.
    pub asked: u64,
    /// Limit of the sum, bytes.
    pub limit: u64,
}

impl Budget {
    /// Limit of a budget of which nothing is said, bytes.
    pub const DEFAULT: u64 = 3_000_000_000;

    /// Budget of `limit` bytes.
    pub fn new(limit: u64) -> Self {
        Self { limit, used: AtomicU64::new(0) }
    }

    /// Takes bytes from the budget, before they are allocated.
    ///
    /// # Errors
    /// [`OverBudget`] if fewer are left; nothing is taken then.
    pub fn take(&self, bytes: u64) -> Result<(), OverBudget> {
        let sum = |used: u64| used.checked_add(bytes).filter(|sum| *sum <= self.limit);
        match self.used.try_update(Ordering::Relaxed, Ordering::Relaxed, sum) {
            Ok(_) => Ok(()),
            Err(used) => Err(OverBudget { asked: used.saturating_add(bytes), limit: self.limit }),
        }
    }

    /// Returns bytes that were taken and have been freed.
    pub fn give_back(&self, bytes: u64) {
        let _ = self.used.try_update(Ordering::Relaxed, Ordering::Relaxed, |used| Some(used.saturating_sub(bytes)));
    }

    /// Bytes that are left.
    pub fn left(&self) -> u64 {
        self.limit - self.used.load(Ordering::Relaxed)
    }
}

impl Default for Budget {
    fn default() -> Self {
        Self::new(Self::DEFAULT)
    }
}

#[cfg(test)]
mod tests {
    //! Law: the sum of what was taken never exceeds the limit, and a refusal takes nothing.

    use super::*;

    #[test]
    fn the_sum_is_bounded() {
        let budget = Budget::new(100);
        assert_eq!(budget.take(60), Ok(()));
        assert_eq!(budget.take(50), Err(OverBudget { asked: 110, limit: 100 }));
        assert_eq!(budget.take(u64::MAX), Err(OverBudget { asked: u64::MAX, limit: 100 }));
        assert_eq!((budget.take(40), budget.left()), (Ok(()), 0));
        budget.give_back(10);
        assert_eq!((budget.left(), budget.take(11).is_err()), (10, true));
    }
}
