//! Sorted numbers, their quantiles, and shares above a limit.

/// Sorted numbers, stored as f32, since millions of pixels make one list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sorted(Vec<f32>);

impl Sorted {
    /// Sorted list of any numbers.
    pub fn of(numbers: impl IntoIterator<Item = f64>) -> Self {
        let mut numbers: Vec<f32> = numbers.into_iter().map(|number| number as f32).collect();
        numbers.sort_unstable_by(f32::total_cmp);
        Self(numbers)
    }

    /// Several lists joined into one.
    pub fn together(lists: impl IntoIterator<Item = Self>) -> Self {
        let mut numbers: Vec<f32> = lists.into_iter().flat_map(|list| list.0).collect();
        numbers.sort_unstable_by(f32::total_cmp);
        Self(numbers)
    }

    /// Count of the numbers.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Number that this share of all, 0 to 1, does not exceed; 0 if the list is empty.
    pub fn quantile(&self, share: f64) -> f64 {
        let last = self.0.len().saturating_sub(1);
        let index = (share.clamp(0.0, 1.0) * self.0.len() as f64).ceil() as usize;
        self.0.get(index.saturating_sub(1).min(last)).copied().map_or(0.0, f64::from)
    }

    /// Median, 99th percentile and largest number.
    pub fn summary(&self) -> [f64; 3] {
        [0.5, 0.99, 1.0].map(|share| self.quantile(share))
    }

    /// Median and 95th percentile, the summary of times.
    pub fn usual_and_slow(&self) -> [f64; 2] {
        [0.5, 0.95].map(|share| self.quantile(share))
    }

    /// Share of the numbers above `limit`.
    pub fn share_above(&self, limit: f64) -> f64 {
        let above = self.0.len() - self.0.partition_point(|&number| f64::from(number) <= limit);
        above as f64 / self.0.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    //! Quantiles must be those of the sorted list, in whatever order and in however many pieces the numbers came.

    use super::*;

    #[test]
    fn quantiles_are_those_of_the_sorted_list() {
        let numbers =
            Sorted::together([Sorted::of((51..=100).rev().map(f64::from)), Sorted::of((1..=50).map(f64::from))]);
        assert_eq!([0.0, 0.5, 0.95, 0.99, 1.0].map(|share| numbers.quantile(share)), [1.0, 50.0, 95.0, 99.0, 100.0]);
        assert_eq!(numbers.share_above(99.0), 0.01);
        assert_eq!(Sorted::default().summary(), [0.0; 3]);
        assert_eq!(Sorted::default().share_above(1.0), 0.0);
    }
}
