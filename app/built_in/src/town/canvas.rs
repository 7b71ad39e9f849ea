//! Canvas in metres, with the few strokes from which every picture of the town is painted.
//!
//! Coordinates are metres with x to the right and y up from the lower left corner, as on a façade. Colours are
//! sRGB-encoded 0…1, as they are mixed by eye. A stroke visits only the pixels of its bounding box. Strokes and noise
//! wrap round the edges, so that pictures tile. Only sums, products, quotients and square roots are used: the same
//! seed paints the same bits on every machine.

use glam::{IVec2, Vec2, Vec3, Vec4, ivec2, vec2};
use rayon::prelude::*;
use std::sync::Arc;

use super::pictures::TownPicture;

/// Picture while it is being painted.
pub(super) struct PaintCanvas {
    /// Number of pixels across and down.
    width: usize,
    height: usize,
    /// Size of the painted area, metres.
    pub(super) size: Vec2,
    /// Colours and opacities, rows from the top.
    pixels: Vec<Vec4>,
}

/// Axis-aligned box on the canvas, metres.
#[derive(Clone, Copy)]
pub(super) struct Area {
    pub(super) low: Vec2,
    pub(super) high: Vec2,
}

impl Area {
    /// Box with this lower left corner and extent.
    pub(super) fn new(x: f32, y: f32, width: f32, height: f32) -> Self {
        Self { low: vec2(x, y), high: vec2(x + width, y + height) }
    }

    /// Box enlarged by a margin on every side.
    pub(super) fn grown(self, margin: f32) -> Self {
        Self { low: self.low - margin, high: self.high + margin }
    }

    pub(super) fn centre(self) -> Vec2 {
        (self.low + self.high) / 2.0
    }

    pub(super) fn extent(self) -> Vec2 {
        self.high - self.low
    }

    /// Signed distance of `p` from the outline, negative inside.
    pub(super) fn distance(self, p: Vec2) -> f32 {
        let q = (p - self.centre()).abs() - self.extent() / 2.0;
        q.max(Vec2::ZERO).length() + q.max_element().min(0.0)
    }

    /// Signed distance from the outline with its upper side replaced by a half circle.
    pub(super) fn arch_distance(self, p: Vec2) -> f32 {
        let radius = self.extent().x / 2.0;
        let spring = vec2(self.centre().x, self.high.y - radius);
        if p.y > spring.y { (p - spring).length() - radius } else { self.distance(p) }
    }
}

impl PaintCanvas {
    /// Makes a canvas of `size` metres, each pixel coloured by `colour` (in parallel).
    pub(super) fn new(pixels: [usize; 2], size: Vec2, colour: impl Fn(Vec2) -> Vec3 + Sync) -> Self {
        Self::with_opacity(pixels, size, |p| colour(p).extend(1.0))
    }

    /// Makes a canvas of `size` metres, colour and opacity of each pixel by `colour` (in parallel).
    pub(super) fn with_opacity([width, height]: [usize; 2], size: Vec2, colour: impl Fn(Vec2) -> Vec4 + Sync) -> Self {
        let mut canvas = Self { width, height, size, pixels: vec![Vec4::ZERO; width * height] };
        let step = canvas.pixel();
        canvas.pixels.par_chunks_mut(width).enumerate().for_each(|(row, pixels)| {
            let y = size.y - (row as f32 + 0.5) * step.y;
            for (column, pixel) in pixels.iter_mut().enumerate() {
                *pixel = colour(vec2((column as f32 + 0.5) * step.x, y));
            }
        });
        canvas
    }

    /// Extent of a pixel, metres.
    fn pixel(&self) -> Vec2 {
        self.size / vec2(self.width as f32, self.height as f32)
    }

    /// Visits the pixels of `area`, wrapped round the canvas sideways, cut off above and below.
    fn visit(&mut self, area: Area, mut stroke: impl FnMut(Vec2, &mut Vec4)) {
        let step = self.pixel();
        let left = (area.low.x / step.x).floor() as i64;
        let right = (area.high.x / step.x).ceil() as i64;
        let top = (((self.size.y - area.high.y) / step.y).floor().max(0.0)) as usize;
        let bottom = (((self.size.y - area.low.y) / step.y).ceil().max(0.0) as usize).min(self.height);
        for row in top..bottom {
            let y = self.size.y - (row as f32 + 0.5) * step.y;
            let pixels = &mut self.pixels[row * self.width..(row + 1) * self.width];
            let mut wrapped = left.rem_euclid(self.width as i64) as usize;
            for column in left..right {
                stroke(vec2((column as f32 + 0.5) * step.x, y), &mut pixels[wrapped]);
                wrapped = if wrapped + 1 == self.width { 0 } else { wrapped + 1 };
            }
        }
    }

    /// Fills the inside of an outline, given as signed distance, with the colour of a point at that distance.
    pub(super) fn fill(&mut self, area: Area, outline: impl Fn(Vec2) -> f32, colour: impl Fn(Vec2, f32) -> Vec3) {
        let step = self.pixel();
        let width = step.x.max(step.y);
        self.visit(area.grown(width), |p, pixel| {
            let distance = outline(p);
            let coverage = (0.5 - distance / width).clamp(0.0, 1.0);
            if coverage > 0.0 {
                let mixed = pixel.truncate().lerp(colour(p, distance), coverage);
                *pixel = mixed.extend(pixel.w.max(coverage));
            }
        });
    }

    /// Multiplies colours by `shade`, which is 1 for no change.
    pub(super) fn darken(&mut self, area: Area, shade: impl Fn(Vec2) -> f32) {
        self.visit(area, |p, pixel| {
            *pixel = (pixel.truncate() * shade(p)).extend(pixel.w);
        });
    }

    /// Darkens the surroundings of a box by a soft shadow, `depth` metres wide, of `strength` at its outline.
    pub(super) fn halo(&mut self, area: Area, depth: f32, strength: f32) {
        self.darken(area.grown(depth), |p| {
            let near = 1.0 - (area.distance(p).max(0.0) / depth).min(1.0);
            1.0 - strength * near * near
        });
    }

    /// Makes everything outside an outline transparent.
    pub(super) fn keep(&mut self, distance: impl Fn(Vec2) -> f32) {
        let whole = Area { low: Vec2::ZERO, high: self.size };
        let step = self.pixel();
        let width = step.x.max(step.y);
        self.visit(whole, |p, pixel| {
            pixel.w *= (0.5 - distance(p) / width).clamp(0.0, 1.0);
        });
    }

    /// Finished picture.
    pub(super) fn finish(self) -> TownPicture {
        let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let mut rgba = vec![0; self.pixels.len() * 4];
        rgba.par_chunks_mut(4 * self.width).zip(self.pixels.par_chunks(self.width)).for_each(|(bytes, pixels)| {
            for (bytes, pixel) in bytes.chunks_exact_mut(4).zip(pixels) {
                bytes.copy_from_slice(&pixel.to_array().map(byte));
            }
        });
        TownPicture { width: self.width as u32, height: self.height as u32, rgba: Arc::new(rgba) }
    }
}

/// Pseudo-random number in 0…1 from three integers, by an even mix of their bits.
pub(super) fn chance(x: i32, y: i32, seed: u32) -> f32 {
    let mut bits =
        (x as u32).wrapping_mul(0x9E37_79B1) ^ (y as u32).wrapping_mul(0x85EB_CA77) ^ seed.wrapping_mul(0xC2B2_AE3D);
    bits ^= bits >> 15;
    bits = bits.wrapping_mul(0x2C1B_3C6D);
    bits ^= bits >> 12;
    bits = bits.wrapping_mul(0x297A_2D39);
    bits ^= bits >> 15;
    (bits >> 8) as f32 / 16_777_216.0
}

/// Smooth noise in −1…1 on a lattice of unit cells that repeats after `period` cells.
pub(super) fn noise(p: Vec2, period: IVec2, seed: u32) -> f32 {
    let cell = ivec2(floor(p.x), floor(p.y));
    let f = p - cell.as_vec2();
    let s = f * f * (3.0 - 2.0 * f);
    let low = ivec2(within(cell.x, period.x), within(cell.y, period.y));
    let next = |low: i32, period: i32| if low + 1 == period { 0 } else { low + 1 };
    let (x, y) = (next(low.x, period.x), next(low.y, period.y));
    let row = |row: i32| {
        let (a, b) = (chance(low.x, row, seed), chance(x, row, seed));
        a + (b - a) * s.x
    };
    let (a, b) = (row(low.y), row(y));
    2.0 * (a + (b - a) * s.y) - 1.0
}

/// Remainder of `cell` in 0…`period`, without a division where it is the cell itself, as nearly always.
pub(super) fn within(cell: i32, period: i32) -> i32 {
    if (0..period).contains(&cell) { cell } else { cell.rem_euclid(period) }
}

/// Number of cells along and up a repetition of `tile` metres, `scale` of them a metre.
pub(super) fn repeats(tile: Vec2, scale: Vec2) -> IVec2 {
    let sides = tile * scale + 0.5;
    ivec2(sides.x as i32, sides.y as i32)
}

/// Largest whole number not above `x`, without a call into a mathematics library.
pub(super) fn floor(x: f32) -> i32 {
    let whole = x as i32;
    if (whole as f32) > x { whole - 1 } else { whole }
}

/// Period of a lattice that never repeats within a picture.
pub(super) const ENDLESS: IVec2 = IVec2::splat(1 << 20);

/// Noise of `octaves` scales, each half the size and half the strength of the one before.
pub(super) fn cloud(p: Vec2, period: IVec2, octaves: u32, seed: u32) -> f32 {
    let (mut sum, mut weight, mut scale) = (0.0, 0.5, 1);
    for octave in 0..octaves {
        sum += weight * noise(p * scale as f32, period * scale, seed.wrapping_add(octave));
        weight *= 0.5;
        scale *= 2;
    }
    sum
}

/// Smooth step: 0 below `low`, 1 above `high`.
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
