//! A line of the table: what was tried, and by how much the worst case was off.

/// What no error may exceed, in radians, units of rapidity, or as a share of what is measured.
pub const LIMIT: f64 = 1e-10;

/// One quantity of one group of cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The cases: speeds, places, steps.
    pub what: String,
    /// How many there were.
    pub cases: u64,
    /// Which error, and in what it is measured.
    pub quantity: &'static str,
    /// The largest met.
    pub error: f64,
}

impl Row {
    /// Whether the error is within [`LIMIT`]; one that is not a number is not.
    pub fn holds(&self) -> bool {
        self.error <= LIMIT
    }
}

/// The largest errors of a group of cases, by quantity.
#[derive(Debug)]
pub struct Worst {
    what: String,
    cases: u64,
    errors: Vec<(&'static str, f64)>,
}

impl Worst {
    /// No case yet.
    pub fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), cases: 0, errors: Vec::new() }
    }

    /// Takes the errors of one more case; every case has the same quantities.
    pub fn meet<const N: usize>(&mut self, errors: [(&'static str, f64); N]) {
        self.cases += 1;
        for (quantity, error) in errors {
            match self.errors.iter_mut().find(|(name, _)| *name == quantity) {
                // Not a number stays the worst.
                Some((_, worst)) if error > *worst || error.is_nan() => *worst = error,
                Some(_) => {}
                None => self.errors.push((quantity, error)),
            }
        }
    }

    /// A row for each quantity.
    pub fn rows(self) -> Vec<Row> {
        let Self { what, cases, errors } = self;
        errors.into_iter().map(|(quantity, error)| Row { what: what.clone(), cases, quantity, error }).collect()
    }
}
