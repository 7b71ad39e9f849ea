//! Loan of memory: bytes of a budget, given back when a decoder is through with them.

use regular_file::{Budget, OverBudget};

/// Bytes taken from a budget. They are given back on drop, but for those that [`Loan::keep`] leaves taken.
pub(crate) struct Loan<'a> {
    budget: &'a Budget,
    bytes: u64,
}

impl<'a> Loan<'a> {
    /// Takes bytes from the budget, before they are allocated.
    ///
    /// # Errors
    /// [`OverBudget`] if fewer are left.
    pub(crate) fn new(budget: &'a Budget, bytes: u64) -> Result<Self, OverBudget> {
        budget.take(bytes)?;
        Ok(Self { budget, bytes })
    }

    /// Leaves `bytes` taken for the caller of the decoder and gives the others back.
    pub(crate) fn keep(mut self, bytes: u64) {
        debug_assert!(bytes <= self.bytes, "no more is kept than was lent");
        self.bytes -= bytes.min(self.bytes);
    }
}

impl Drop for Loan<'_> {
    fn drop(&mut self) {
        self.budget.give_back(self.bytes);
    }
}
