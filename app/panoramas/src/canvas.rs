//! Canvas on which a picture of any size is collected, a few rows at a time: it is scaled down and rounded to half
//! floats as it comes, so that the full picture is held once, in its smallest form.

use half::f16;
use half::slice::HalfFloatSliceExt;
use rayon::prelude::*;

use scene::Panorama;

/// Least number that is no radiance: the sun's disc has 2e9 cd/m², and no scale has greater numbers than cd/m².
const NOT_LIGHT: f32 = 1e10;

/// Counts of the numbers that are no radiances, or cannot be drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct LightFaults {
    /// Numbers that were negative, not finite, or too large for light.
    pub(super) replaced: usize,
    /// Numbers above [`Panorama::BRIGHTEST`].
    pub(super) cut: usize,
}

/// Canvas of one picture.
pub(super) struct PanoramaCanvas {
    /// Size of the picture that comes, pixels.
    source: [u32; 2],
    /// Size of the picture that is kept, pixels.
    target: [u32; 2],
    rgb: Vec<[f16; 3]>,
    /// Sums of the row of the kept picture that is under way; empty if the picture is not scaled.
    sums: Vec<[f32; 3]>,
    row: usize,
    faults: LightFaults,
}

impl PanoramaCanvas {
    /// Black canvas for a picture of size `source` that is kept at the size `target`.
    pub(super) fn new(source: [u32; 2], target: [u32; 2]) -> Self {
        let [width, height] = target.map(|side| side as usize);
        let sums = if source == target { Vec::new() } else { vec![[0.0; 3]; width] };
        Self { source, target, rgb: vec![[f16::ZERO; 3]; width * height], sums, row: 0, faults: LightFaults::default() }
    }

    /// Memory of a canvas of this size, bytes.
    pub(super) fn bytes([width, height]: [u32; 2]) -> u64 {
        u64::from(width) * u64::from(height) * size_of::<[f16; 3]>() as u64
    }

    /// Adds rows of `width` pixels, the first of which is at column `x` and row `y` of the picture. Rows come from the
    /// top down. What lies outside of the picture is left out.
    pub(super) fn add(&mut self, [x, y]: [i64; 2], width: usize, rows: &mut [[f32; 3]]) {
        let [columns, height] = self.source.map(i64::from);
        let first = (-x).clamp(0, width as i64) as usize;
        let last = (columns - x).clamp(first as i64, width as i64) as usize;
        let above = usize::try_from(-y).unwrap_or(0).saturating_mul(width).min(rows.len());
        let below = usize::try_from(height - y).unwrap_or(0).saturating_mul(width).min(rows.len());
        if first == last || above >= below {
            return;
        }
        let rows = &mut rows[above..below];
        let (x, y) = ((x + first as i64) as usize, y.max(0) as usize);
        let mended = rows.par_chunks_exact_mut(width).map(|row| mend(&mut row[first..last]));
        let mended = mended.reduce(LightFaults::default, LightFaults::with);
        self.faults = self.faults.with(mended);
        if self.sums.is_empty() {
            let kept = self.rgb.par_chunks_exact_mut(columns as usize).skip(y).zip(rows.par_chunks_exact(width));
            kept.for_each(|(kept, row)| {
                let kept = kept[x..x + last - first].as_flattened_mut();
                kept.convert_from_f32_slice(row[first..last].as_flattened());
            });
        } else {
            let columns: Vec<u32> = (0..last - first).map(|column| self.place(0, x + column) as u32).collect();
            for (y, row) in (y..).zip(rows.chunks_exact(width)) {
                let row_of_target = self.place(1, y);
                if row_of_target != self.row {
                    self.finish_row();
                    self.row = row_of_target;
                }
                for (&column, pixel) in columns.iter().zip(&row[first..last]) {
                    let sum = &mut self.sums[column as usize];
                    (0..3).for_each(|channel| sum[channel] += pixel[channel]);
                }
            }
        }
    }

    /// Kept pixels, and the counts of faults. Numbers that were too large have become as bright as the brightest good
    /// pixel.
    pub(super) fn finish(mut self) -> (Vec<[f16; 3]>, LightFaults) {
        if !self.sums.is_empty() {
            self.finish_row();
        }
        if self.faults.replaced > 0 {
            let values = self.rgb.as_flattened_mut();
            let good = values.par_iter().filter(|value| value.is_finite()).map(|value| value.to_f32());
            let brightest = f16::from_f32(good.reduce(|| 0.0, f32::max));
            values.par_iter_mut().filter(|value| !value.is_finite()).for_each(|value| *value = brightest);
        }
        (self.rgb, self.faults)
    }

    /// Index of the kept column (axis 0) or row (axis 1) that covers one of the source.
    fn place(&self, axis: usize, index: usize) -> usize {
        let [source, target] = [self.source[axis], self.target[axis]].map(u64::from);
        (((index as u64 + 1) * target).div_ceil(source) - 1) as usize
    }

    /// Writes the means of the row that is under way.
    fn finish_row(&mut self) {
        let covered = |axis: usize, index: usize| {
            let [source, target] = [self.source[axis], self.target[axis]].map(u64::from);
            let edge = |index: u64| index * source / target;
            (edge(index as u64 + 1) - edge(index as u64)) as f32
        };
        let rows = covered(1, self.row);
        let width = self.target[0] as usize;
        let kept = &mut self.rgb[self.row * width..][..width];
        for (column, (kept, sum)) in kept.iter_mut().zip(&self.sums).enumerate() {
            *kept = sum.map(|sum| f16::from_f32(sum / (rows * covered(0, column))));
        }
        self.sums.fill([0.0; 3]);
    }
}

impl LightFaults {
    fn with(self, other: Self) -> Self {
        Self { replaced: self.replaced + other.replaced, cut: self.cut + other.cut }
    }
}

/// Makes radiances of any numbers. Those that are too large for light become infinite, and stay so in a mean.
fn mend(row: &mut [[f32; 3]]) -> LightFaults {
    let mut faults = LightFaults::default();
    for value in row.as_flattened_mut() {
        if (0.0..=Panorama::BRIGHTEST).contains(value) {
            continue;
        }
        if *value > Panorama::BRIGHTEST && *value < NOT_LIGHT {
            faults.cut += 1;
            *value = Panorama::BRIGHTEST;
        } else {
            faults.replaced += 1;
            *value = if *value > 0.0 { f32::INFINITY } else { 0.0 };
        }
    }
    faults
}
