//! Tables of numbers that are part of the program: comma-separated text, read once, at first use.

/// Rows of `N` numbers; lines that start with `#` are comments.
///
/// The text is part of the program, so one that cannot be read is a broken build and ends it.
pub(super) fn rows<const N: usize>(text: &'static str) -> Vec<[f64; N]> {
    text.lines().filter(|line| !line.starts_with('#')).map(row).collect()
}

fn row<const N: usize>(line: &str) -> [f64; N] {
    let numbers: Vec<f64> = line.split(',').map_while(|number| number.parse().ok()).collect();
    numbers.try_into().expect("a built-in table has the same count of numbers in every row")
}
