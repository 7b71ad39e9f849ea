//! Cube maps: the faces of a cube, laid out in one picture, and their conversion to an equirectangular panorama.
//!
//! Each face is a picture as seen from the middle. Cube maps of graphics interfaces are left-handed: ahead is +z and
//! right is +x. In this program ahead is −z, so z changes its sign on reading, and the panorama is not mirrored.
//! OpenEXR's cubes (ImfEnvmap.h) are right-handed: ahead, as in its latitude-longitude maps, is +z, and left is +x.

use std::f32::consts::{PI, TAU};

use glam::Vec3;
use half::f16;
use rayon::prelude::*;
use std::sync::Arc;

use scene::Panorama;

/// Width of the panorama in face widths: four faces stand round the horizon.
pub(super) const WIDTH_PER_SIDE: u32 = 4;

/// Layout of six faces in a picture.
pub(super) struct Unfolding {
    /// Name of the layout.
    pub(super) name: &'static str,
    /// Number of faces across the picture.
    pub(super) columns: u32,
    /// Number of faces from its top to its bottom.
    pub(super) rows: u32,
    /// Column and row of the faces right, left, up, down, ahead, behind: a cube map's +x, −x, +y, −y, +z, −z.
    cells: [[u32; 2]; 6],
    /// True if the face behind is upside down, because it is joined to the lower one.
    behind_turned: bool,
    /// True if the faces are those of OpenEXR, whose outermost pixels lie on the edges of the cube.
    of_open_exr: bool,
}

/// Layout of a picture whose header says that it is a cube, of OpenEXR.
pub(super) static OPEN_EXR_CUBE: Unfolding = Unfolding {
    name: "OpenEXR cube",
    columns: 1,
    rows: 6,
    cells: [[0, 0], [0, 1], [0, 2], [0, 3], [0, 4], [0, 5]],
    behind_turned: false,
    of_open_exr: true,
};

/// Greatest share of the pixels in the empty corners of a cross that are not empty: compression blurs the edges.
const STAINED: f32 = 0.05;

/// Greatest difference between radiances of empty corners, by compression.
const STAIN: f32 = 0.02;

static UNFOLDINGS: [Unfolding; 4] = [
    Unfolding {
        name: "cube, faces side by side",
        columns: 6,
        rows: 1,
        cells: [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [5, 0]],
        behind_turned: false,
        of_open_exr: false,
    },
    Unfolding {
        name: "cube, faces one below another",
        columns: 1,
        rows: 6,
        cells: [[0, 0], [0, 1], [0, 2], [0, 3], [0, 4], [0, 5]],
        behind_turned: false,
        of_open_exr: false,
    },
    // Crosses: up above ahead above down; left, ahead and right side by side.
    Unfolding {
        name: "cube, cross",
        columns: 4,
        rows: 3,
        cells: [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]],
        behind_turned: false,
        of_open_exr: false,
    },
    Unfolding {
        name: "cube, upright cross",
        columns: 3,
        rows: 4,
        cells: [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]],
        behind_turned: true,
        of_open_exr: false,
    },
];

impl Unfolding {
    /// Layout for these proportions.
    pub(super) fn of(width: u32, height: u32) -> Option<&'static Self> {
        UNFOLDINGS.iter().find(|Self { columns, rows, .. }| {
            let side = width / columns;
            side > 0 && width == side * columns && u64::from(height) == u64::from(side) * u64::from(*rows)
        })
    }

    /// True if the corners that the faces leave empty, if there are any, all have one colour.
    pub(super) fn corners_are_empty(&self, picture: &Panorama) -> bool {
        let side = picture.width / self.columns;
        let empty = |cell: &[u32; 2]| !self.cells.contains(cell);
        let cells = (0..self.rows).flat_map(|row| (0..self.columns).map(move |column| [column, row])).filter(empty);
        let pixels = cells.flat_map(|[column, row]| {
            let (left, top) = ((column * side) as usize, (row * side) as usize);
            (0..side as usize).flat_map(move |y| (0..side as usize).map(move |x| (left + x, top + y)))
        });
        let (mut first, mut all, mut stained) = (None, 0_usize, 0_usize);
        for (x, y) in pixels {
            let pixel = Vec3::from_array(picture.pixel(x, y));
            let first = *first.get_or_insert(pixel);
            all += 1;
            stained += usize::from((pixel - first).abs().max_element() > STAIN * first.max_element().max(1.0));
        }
        stained as f32 <= STAINED * all as f32
    }

    /// Size of the panorama of the faces, pixels.
    pub(super) fn size_of_panorama(&self, picture: &Panorama) -> [u32; 2] {
        let side = picture.width / self.columns;
        [WIDTH_PER_SIDE * side, WIDTH_PER_SIDE / 2 * side]
    }

    /// Panorama of the faces, bilinear within each face.
    pub(super) fn equirectangular(&self, picture: &Panorama) -> Panorama {
        let side = picture.width / self.columns;
        let [width, height] = self.size_of_panorama(picture);
        let mut rgb = vec![[f16::ZERO; 3]; width as usize * height as usize];
        rgb.par_chunks_exact_mut(width as usize).enumerate().for_each(|(row, pixels)| {
            let (sine, cosine) = ((0.5 - (row as f32 + 0.5) / height as f32) * PI).sin_cos();
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let (right, ahead) = (((column as f32 + 0.5) / width as f32 - 0.5) * TAU).sin_cos();
                let direction = Vec3::new(right * cosine, sine, -ahead * cosine);
                *pixel = self.seen(picture, side, direction).map(f16::from_f32);
            }
        });
        Panorama { width, height, rgb: Arc::new(rgb) }
    }

    /// Radiance along a direction, world axes.
    fn seen(&self, picture: &Panorama, side: u32, direction: Vec3) -> [f32; 3] {
        let (face, [mut s, mut t]) = if self.of_open_exr { face_of_open_exr(direction) } else { face(direction) };
        if self.behind_turned && face == 5 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        // Interpolate between the centres of pixels; beyond the outermost centres, at the edges of the face, the
        // value is constant.
        let last = side - 1;
        let place = |share: f32| {
            let place = if self.of_open_exr { share * last as f32 } else { share * side as f32 - 0.5 };
            let place = place.clamp(0.0, last as f32);
            (place as u32, (place as u32 + 1).min(last), place.fract())
        };
        let ((left, right, x), (upper, lower, y)) = (place(s), place(t));
        let [column, row] = self.cells[face];
        let pixel =
            |x: u32, y: u32| Vec3::from_array(picture.pixel((column * side + x) as usize, (row * side + y) as usize));
        let above = pixel(left, upper).lerp(pixel(right, upper), x);
        let below = pixel(left, lower).lerp(pixel(right, lower), x);
        above.lerp(below, y).to_array()
    }
}

/// Face of an OpenEXR cube that a direction meets, and the place on it (`ImfEnvmap.cpp`, `CubeMap::pixelPosition`).
fn face_of_open_exr(direction: Vec3) -> (usize, [f32; 2]) {
    let [x, y, z] = [-direction.x, direction.y, -direction.z];
    let [across, up, along] = [x.abs(), y.abs(), z.abs()];
    let (face, s, t, major) = if across >= up && across >= along {
        if x > 0.0 { (0, z, -y, across) } else { (1, -z, -y, across) }
    } else if up >= along {
        if y > 0.0 { (2, x, -z, up) } else { (3, x, z, up) }
    } else if z > 0.0 {
        (4, -x, -y, along)
    } else {
        (5, x, -y, along)
    };
    (face, [s, t].map(|offset| (offset / major + 1.0) / 2.0))
}

/// Face that a direction meets, and the place on it as shares from its left and from its top (OpenGL 4.6, table
/// 8.19).
fn face(direction: Vec3) -> (usize, [f32; 2]) {
    let [x, y, z] = [direction.x, direction.y, -direction.z];
    let [across, up, along] = [x.abs(), y.abs(), z.abs()];
    let (face, s, t, major) = if along >= across && along >= up {
        if z >= 0.0 { (4, x, -y, along) } else { (5, -x, -y, along) }
    } else if across >= up {
        if x >= 0.0 { (0, -z, -y, across) } else { (1, z, -y, across) }
    } else if y >= 0.0 {
        (2, x, z, up)
    } else {
        (3, x, -z, up)
    };
    (face, [s, t].map(|offset| (offset / major + 1.0) / 2.0))
}
