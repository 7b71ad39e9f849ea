//! Cube maps: the faces of a cube, laid out in one picture, and their conversion to an equirectangular panorama.
//!
//! Each face is a picture as seen from the middle. Cube maps are left-handed: ahead is +z and right is +x. In this
//! program ahead is −z, so z changes its sign on reading, and the panorama is not mirrored.

use std::f32::consts::{PI, TAU};

use glam::Vec3;
use rayon::prelude::*;

use scene::Panorama;

/// Width of the panorama in face widths: four faces stand round the horizon.
pub(super) const WIDTH_PER_SIDE: u32 = 4;

/// Layout of six faces in a picture.
pub(super) struct Unfolding {
    /// Number of faces across the picture.
    pub(super) columns: u32,
    /// Number of faces from its top to its bottom.
    pub(super) rows: u32,
    /// Column and row of the faces right, left, up, down, ahead, behind: a cube map's +x, −x, +y, −y, +z, −z.
    cells: [[u32; 2]; 6],
    /// True if the face behind is upside down, because it is joined to the lower one.
    behind_turned: bool,
}

const UNFOLDINGS: [Unfolding; 4] = [
    Unfolding { columns: 6, rows: 1, cells: [[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [5, 0]], behind_turned: false },
    Unfolding { columns: 1, rows: 6, cells: [[0, 0], [0, 1], [0, 2], [0, 3], [0, 4], [0, 5]], behind_turned: false },
    // Crosses: up above ahead above down; left, ahead and right side by side.
    Unfolding { columns: 4, rows: 3, cells: [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]], behind_turned: false },
    Unfolding { columns: 3, rows: 4, cells: [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]], behind_turned: true },
];

impl Unfolding {
    /// Layout for these proportions.
    pub(super) fn of(width: u32, height: u32) -> Option<&'static Self> {
        UNFOLDINGS.iter().find(|Self { columns, rows, .. }| {
            let side = width / columns;
            side > 0 && width == side * columns && u64::from(height) == u64::from(side) * u64::from(*rows)
        })
    }

    /// Panorama of the faces, bilinear within each face.
    pub(super) fn equirectangular(&self, picture: &Panorama) -> Panorama {
        let side = picture.width / self.columns;
        let (width, height) = (WIDTH_PER_SIDE * side, WIDTH_PER_SIDE / 2 * side);
        let directions = (0..height).into_par_iter().flat_map_iter(|row| {
            let (sine, cosine) = ((0.5 - (row as f32 + 0.5) / height as f32) * PI).sin_cos();
            (0..width).map(move |column| {
                let (right, ahead) = (((column as f32 + 0.5) / width as f32 - 0.5) * TAU).sin_cos();
                Vec3::new(right * cosine, sine, -ahead * cosine)
            })
        });
        Panorama { width, height, rgb: directions.map(|direction| self.seen(picture, side, direction)).collect() }
    }

    /// Radiance along a direction, world axes.
    fn seen(&self, picture: &Panorama, side: u32, direction: Vec3) -> [f32; 3] {
        let (face, [mut s, mut t]) = face(direction);
        if self.behind_turned && face == 5 {
            (s, t) = (1.0 - s, 1.0 - t);
        }
        // Interpolate between the centres of pixels; beyond the outermost centres, at the edges of the face, the
        // value is constant.
        let last = side - 1;
        let place = |share: f32| {
            let place = (share * side as f32 - 0.5).clamp(0.0, last as f32);
            (place as u32, (place as u32 + 1).min(last), place.fract())
        };
        let ((left, right, x), (upper, lower, y)) = (place(s), place(t));
        let [column, row] = self.cells[face];
        let pixel = |x: u32, y: u32| {
            let index = (row * side + y) as usize * picture.width as usize + (column * side + x) as usize;
            Vec3::from_array(picture.rgb[index])
        };
        let above = pixel(left, upper).lerp(pixel(right, upper), x);
        let below = pixel(left, lower).lerp(pixel(right, lower), x);
        above.lerp(below, y).to_array()
    }
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
