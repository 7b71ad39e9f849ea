//! Row of the table of extremes: a group of cases, and its largest error.

/// Largest allowed error, in radians, units of rapidity, or as a share of the measured quantity.
pub const LIMIT: f64 = 1e-10;

/// Largest allowed error of RK4 in the steps of a ride: that of its order, not of rounding.
pub const RK4_LIMIT: f64 = 1e-6;

/// One quantity of one group of cases.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtremesRow {
    /// Description of the cases: speeds, places, steps.
    pub what: String,
    /// Number of cases.
    pub cases: u64,
    /// Quantity whose error is given, with its unit.
    pub quantity: &'static str,
    /// Largest error of all cases.
    pub error: f64,
    /// Largest error that is allowed.
    pub limit: f64,
}

impl ExtremesRow {
    /// True if the error is within its limit. NaN is not.
    pub fn holds(&self) -> bool {
        self.error <= self.limit
    }
}

/// Largest errors of a group of cases, for each quantity.
#[derive(Debug)]
pub struct Worst {
    what: String,
    cases: u64,
    errors: Vec<(&'static str, f64)>,
    limit: f64,
}

impl Worst {
    /// Group without any case yet.
    pub fn new(what: impl Into<String>) -> Self {
        Self::within(LIMIT, what)
    }

    /// Group without any case yet, with a limit of its own.
    pub fn within(limit: f64, what: impl Into<String>) -> Self {
        Self { what: what.into(), cases: 0, errors: Vec::new(), limit }
    }

    /// Adds the errors of one more case. Every case has the same quantities.
    pub fn meet<const N: usize>(&mut self, errors: [(&'static str, f64); N]) {
        self.cases += 1;
        for (quantity, error) in errors {
            match self.errors.iter_mut().find(|(name, _)| *name == quantity) {
                // NaN counts as the largest error.
                Some((_, worst)) if error > *worst || error.is_nan() => *worst = error,
                Some(_) => {}
                None => self.errors.push((quantity, error)),
            }
        }
    }

    /// Rows of the group, one for each quantity.
    pub fn rows(self) -> Vec<ExtremesRow> {
        let Self { what, cases, errors, limit } = self;
        let row = |(quantity, error)| ExtremesRow { what: what.clone(), cases, quantity, error, limit };
        errors.into_iter().map(row).collect()
    }
}
