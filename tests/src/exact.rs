//! The exact picture of boxes: each ray is bent by aberration in f64 and intersected with planes, not with triangles.
//!
//! A box at rest does not change its place, so light-travel time does not matter. The observer's direction, taken to
//! the world, is followed straight back from the eye. The pixel shows the first box on the way, in the colour of its
//! face.

use built_in::lattice::Lattice;
use glam::DVec3;
use image::{Rgba, RgbaImage};
use physics::{Aberration, Celerity};
use rayon::prelude::*;

use crate::colour::srgb_pixel;
use crate::view::{View, middle};

/// Boxes along the axes of the world, before a background of one colour.
pub struct Boxes {
    boxes: Vec<AxisAligned>,
    /// Encoded colours of the faces, by axis and by side: 0 for the face towards +, 1 for the face towards −.
    faces: [[[u8; 4]; 2]; 3],
    background: [u8; 4],
}

struct AxisAligned {
    low: DVec3,
    high: DVec3,
}

/// Boxes as one eye sees them, exactly.
pub struct BoxesSeen<'a> {
    boxes: &'a Boxes,
    view: View,
    eye: DVec3,
    aberration: Aberration,
}

impl Boxes {
    /// Boxes of a lattice, before a background of this linear colour.
    pub fn of(lattice: &Lattice, background: [f32; 3]) -> Self {
        let [columns, rows, layers] = lattice.count;
        let half = DVec3::splat(f64::from(lattice.side) / 2.0);
        let boxes = (0..columns * rows * layers).map(|n| {
            let centre = lattice.centre([n % columns, n / columns % rows, n / (columns * rows)]).as_dvec3();
            AxisAligned { low: centre - half, high: centre + half }
        });
        let face = |normal: DVec3| {
            let colour = Lattice::face_colour(normal.as_vec3()).expect("a box has faces along every axis");
            srgb_pixel(colour)
        };
        Self {
            boxes: boxes.collect(),
            faces: DVec3::AXES.map(|axis| [face(axis), face(-axis)]),
            background: srgb_pixel(background),
        }
    }

    /// View of an eye at `eye` that moves with `celerity`.
    pub fn seen_by(&self, view: &View, eye: DVec3, celerity: Celerity) -> BoxesSeen<'_> {
        BoxesSeen { boxes: self, view: *view, eye, aberration: Aberration::new(celerity) }
    }

    /// Encoded colour that a ray from `eye` along `direction` (world axes) meets first.
    pub fn first(&self, eye: DVec3, direction: DVec3) -> [u8; 4] {
        let nearest = self.nearest(eye, direction);
        nearest.map_or(self.background, |(_, axis)| self.faces[axis][usize::from(direction[axis] > 0.0)])
    }

    /// Distance in the world of what a ray from `eye` along `direction` (world axes) meets first, metres.
    pub fn distance(&self, eye: DVec3, direction: DVec3) -> Option<f64> {
        self.nearest(eye, direction).map(|(distance, _)| distance)
    }

    /// Distance to the face that a ray meets first, and the axis across it.
    fn nearest(&self, eye: DVec3, direction: DVec3) -> Option<(f64, usize)> {
        let hits = self.boxes.iter().filter_map(|target| target.meet(eye, direction));
        hits.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

impl AxisAligned {
    /// Distance to the face where the ray enters, and the axis across that face; none if the ray misses or begins
    /// inside.
    fn meet(&self, eye: DVec3, direction: DVec3) -> Option<(f64, usize)> {
        // Most boxes are missed by far, so test the sphere around the box first.
        let centre = 0.5 * (self.low + self.high) - eye;
        let along = centre.dot(direction);
        if along < 0.0 || centre.length_squared() - along * along > 0.25 * (self.high - self.low).length_squared() {
            return None;
        }
        let (low, high) = ((self.low - eye) / direction, (self.high - eye) / direction);
        let (entries, exits) = (low.min(high), low.max(high));
        let (entry, exit) = (entries.max_element(), exits.min_element());
        (entry > 0.0 && entry < exit).then(|| (entry, entries.max_position()))
    }
}

impl BoxesSeen<'_> {
    /// Exact colour at a place in the picture, pixels from the upper left corner.
    pub fn colour(&self, place: [f64; 2]) -> [u8; 4] {
        let (direction, _) = self.aberration.world_from_observer(self.view.direction(place));
        self.boxes.first(self.eye, direction)
    }

    /// Exact picture: the colour at the middle of each pixel.
    pub fn picture(&self) -> RgbaImage {
        let mut picture = RgbaImage::new(self.view.size[0], self.view.size[1]);
        picture.enumerate_rows_mut().par_bridge().for_each(|(_, pixels)| {
            for (column, row, pixel) in pixels {
                *pixel = Rgba(self.colour(middle([column, row])));
            }
        });
        picture
    }

    /// True if `colour` can be seen within `reach` pixels of a pixel's middle, on a grid of `steps` rays to the
    /// pixel.
    pub fn shows_near(&self, pixel: [u32; 2], colour: [u8; 4], reach: f64, steps: f64) -> bool {
        let [x, y] = middle(pixel);
        let count = (reach * steps).ceil() as i32;
        let offsets = || (-count..=count).map(|step| f64::from(step) * reach / f64::from(count));
        offsets().any(|down| offsets().any(|right| self.colour([x + right, y + down]) == colour))
    }
}

/// Pixels that differ between two pictures of one size.
pub fn differing(one: &RgbaImage, other: &RgbaImage) -> Vec<[u32; 2]> {
    assert_eq!(one.dimensions(), other.dimensions());
    let pairs = one.enumerate_pixels().zip(other.pixels());
    pairs.filter(|((.., a), b)| a != b).map(|((column, row, _), _)| [column, row]).collect()
}
