//! CSV grids: values at even places of the unit square.

/// Largest number of samples that is read.
const MAX_SAMPLES: usize = 2_000_000;

/// Columns, rows, and values row by row, starting with the lowest second coordinate.
pub(crate) type GridSamples<const N: usize> = (u32, u32, Vec<[f64; N]>);

/// Reads lines with the two coordinates of a place and N values, in any order. They must make a complete even grid
/// from 0 to 1 both ways. A first line of words is a heading, and text after a # is ignored. Error texts are worded
/// to follow the file's name.
pub(crate) fn read<const N: usize>(text: &str, head: &str) -> Result<GridSamples<N>, String> {
    let mut samples: Vec<([f64; 2], [f64; N])> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.is_empty() || (samples.is_empty() && line.starts_with(|letter: char| letter.is_ascii_alphabetic())) {
            continue;
        }
        let mut words = line.split([',', ';']).map(str::trim);
        let mut number = || words.next()?.parse().ok().filter(|number: &f64| number.is_finite());
        let mut sample = || {
            Some(([number()?, number()?], {
                let mut values = [0.0; N];
                for value in &mut values {
                    *value = number()?;
                }
                values
            }))
        };
        let wrong = || format!("line {}: write {head}: {} finite numbers", index + 1, N + 2);
        samples.push(sample().ok_or_else(wrong)?);
        if samples.len() > MAX_SAMPLES {
            return Err(format!("it has more than {MAX_SAMPLES} lines"));
        }
    }
    samples.sort_by(|(a, _), (b, _)| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
    let columns = samples.iter().take_while(|(place, _)| place[1] == samples[0].0[1]).count();
    let rows = samples.len() / columns.max(1);
    if columns < 2 || rows < 2 || samples.len() != columns * rows {
        return Err(NO_GRID.into());
    }

    // Rounded coordinates are accepted; places off the grid are not.
    let even = |index: usize, count: usize| index as f64 / (count - 1) as f64;
    let off = |index: usize| {
        let [x, y] = samples[index].0;
        (x - even(index % columns, columns)).abs().max((y - even(index / columns, rows)).abs())
    };
    if (0..samples.len()).any(|index| off(index) > 1e-3 / columns.max(rows) as f64) {
        return Err(NO_GRID.into());
    }
    Ok((columns as u32, rows as u32, samples.into_iter().map(|(_, values)| values).collect()))
}

const NO_GRID: &str = "its places make no even grid: they must run from 0 to 1 in equal steps, every first with every second, once, at least two of each";
