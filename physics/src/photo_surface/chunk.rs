//! A chunk: up to 8192 vertices of one mesh, transformed by one thread with one formula.

use std::mem::MaybeUninit;

use super::formula::{AtRest, ExactAstern, Formula, LightCone};
use super::lanes::{AlignedLine, LaneWork, Lanes, OutputLine};
use super::line::{LINE, VertexLine};
use super::plan::{FormulaChoice, FramePlan};
use super::simd;

/// Work of one call of the kernel.
pub(super) struct KernelChunk<'a> {
    pub(super) plan: FramePlan,
    pub(super) form: FormulaChoice,
    pub(super) input: [&'a [VertexLine]; 3],
    /// Apparent positions x, y, z, a value of each for every vertex.
    pub(super) position: [&'a mut [MaybeUninit<f32>]; 3],
    /// Doppler factors, a value for every vertex; empty if they are not wanted.
    pub(super) doppler: &'a mut [MaybeUninit<f32>],
    /// True to write past the caches where the memory is aligned.
    pub(super) streaming: bool,
}

impl LaneWork for KernelChunk<'_> {
    /// Number of results that are not finite.
    type Output = usize;

    /// Transforms the chunk with the formula that it needs.
    #[inline(always)]
    fn run<L: Lanes>(self) -> usize {
        match self.form {
            FormulaChoice::AtRest => self.transform_by::<L, AtRest<L>>(),
            FormulaChoice::LightCone => self.transform_by::<L, LightCone<L>>(),
            FormulaChoice::ExactAstern => self.transform_by::<L, ExactAstern<L>>(),
        }
    }
}

impl KernelChunk<'_> {
    /// Transforms the chunk with one formula; returns the number of results that are not finite.
    #[inline(always)]
    fn transform_by<L: Lanes, F: Formula<L>>(self) -> usize {
        let formula = F::new(&self.plan);
        let streams = self.position.map(<[_]>::as_chunks_mut);
        let (doppler, doppler_end) = self.doppler.as_chunks_mut();
        let [(x, x_end), (y, y_end), (z, z_end)] = streams;
        let lines = x.len();
        let left_over = x_end.len();

        // Transform the whole lines, past the caches if asked for and possible.
        let mut not_finite = if self.streaming {
            match simd::aligned([x, y, z, doppler]) {
                Ok(target) => {
                    let not_finite = transform_lines(&formula, self.input, target);
                    L::finish_streaming();
                    not_finite
                }
                Err(target) => transform_lines(&formula, self.input, target),
            }
        } else {
            transform_lines(&formula, self.input, [x, y, z, doppler])
        };

        // Transform the vertices that do not fill a line by way of a line of their own, and copy the part that belongs
        // to them.
        if left_over > 0 {
            let mut target = [[MaybeUninit::uninit(); LINE]; 4];
            let [x, y, z, doppler] = &mut target;
            let input = self.input.map(|stream| &stream[lines]);
            let finite = transform_line(&formula, input, [x, y, z], Some(doppler));
            not_finite += left_over - (finite & !(u32::MAX << left_over)).count_ones() as usize;
            for (end, line) in [x_end, y_end, z_end, doppler_end].into_iter().zip(&target) {
                end.copy_from_slice(&line[..end.len()]);
            }
        }
        not_finite
    }
}

/// A line to write to: through the caches or past them.
trait LineTarget {
    fn put<L: Lanes>(&mut self, first: usize, values: L);
}

impl LineTarget for OutputLine {
    #[inline(always)]
    fn put<L: Lanes>(&mut self, first: usize, values: L) {
        values.store(&mut self[first..]);
    }
}

impl LineTarget for AlignedLine {
    #[inline(always)]
    fn put<L: Lanes>(&mut self, first: usize, values: L) {
        values.stream(self, first);
    }
}

/// Transforms as many lines as the first target holds; returns the number of results that are not finite.
#[inline(always)]
fn transform_lines<L: Lanes, F: Formula<L>, T: LineTarget>(
    formula: &F,
    input: [&[VertexLine]; 3],
    [x, y, z, doppler]: [&mut [T]; 4],
) -> usize {
    let lines = x.len();
    let [in_x, in_y, in_z] = input.map(|stream| &stream[..lines]);
    let (y, z) = (&mut y[..lines], &mut z[..lines]);
    let mut not_finite = 0;
    for line in 0..lines {
        let finite = transform_line(
            formula,
            [&in_x[line], &in_y[line], &in_z[line]],
            [&mut x[line], &mut y[line], &mut z[line]],
            doppler.get_mut(line),
        );
        not_finite += LINE - finite.count_ones() as usize;
    }
    not_finite
}

/// Transforms a line; returns a set bit for every vertex whose result is finite. The other vertices are written as
/// zeros.
#[inline(always)]
fn transform_line<L: Lanes, F: Formula<L>, T: LineTarget>(
    formula: &F,
    [in_x, in_y, in_z]: [&VertexLine; 3],
    [x, y, z]: [&mut T; 3],
    mut doppler: Option<&mut T>,
) -> u32 {
    let mut finite = 0;
    for first in (0..LINE).step_by(L::COUNT) {
        let vertex = [L::load(&in_x.0[first..]), L::load(&in_y.0[first..]), L::load(&in_z.0[first..])];
        let mut seen = formula.seen(vertex);
        if seen.finite != L::ALL {
            seen = seen.collapsed();
        }
        let [to_x, to_y, to_z] = seen.position;
        x.put(first, to_x);
        y.put(first, to_y);
        z.put(first, to_z);
        if let Some(doppler) = &mut doppler {
            doppler.put(first, seen.doppler);
        }
        finite |= seen.finite << first;
    }
    finite
}
