//! Count of the messages that a decoder could not use.

/// Messages that were skipped because they made no sense.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    number: u64,
    last: Option<String>,
}

impl Faults {
    /// Counts one more fault.
    pub(crate) fn count(&mut self, what: impl Into<String>) {
        self.number += 1;
        self.last = Some(what.into());
    }

    /// Number of faults so far.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Description of the last fault.
    pub fn last(&self) -> Option<&str> {
        self.last.as_deref()
    }
}
