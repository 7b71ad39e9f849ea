//! Layout of a picture, by its proportions.

use super::cube::{self, Unfolding};

/// Layout of a picture of all directions.
#[derive(Clone, Copy)]
pub(super) enum PanoramaShape {
    /// Longitude to the right, latitude upwards.
    Equirectangular,
    /// Faces of a cube.
    Cube(&'static Unfolding),
}

/// True if a picture is twice as wide as high, within 1 in 100, or to a column or a row: scaling rounds.
pub fn is_equirectangular(width: u32, height: u32) -> bool {
    /// Least height at which a column more or less is no other shape, pixels.
    const LARGE: u64 = 16;
    let (width, height) = (u64::from(width), u64::from(height));
    let rounding = if height < LARGE { 0 } else { 2 };
    width > 0 && width.abs_diff(2 * height) <= rounding.max(width / 100)
}

impl PanoramaShape {
    /// Layout for these proportions.
    pub(super) fn of([width, height]: [u32; 2]) -> Option<Self> {
        if is_equirectangular(width, height) {
            return Some(Self::Equirectangular);
        }
        Unfolding::of(width, height).map(Self::Cube)
    }

    /// Name of the layout.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Equirectangular => "equirectangular",
            Self::Cube(unfolding) => unfolding.name,
        }
    }

    /// Size at which the panorama is not wider than `max_width`: the size divided by a whole number, for cubes face
    /// by face.
    pub(super) fn reduced(self, [width, height]: [u32; 2], max_width: u32) -> [u32; 2] {
        match self {
            Self::Equirectangular => {
                let divisor = width.div_ceil(max_width);
                [width / divisor, (height / divisor).max(1)]
            }
            Self::Cube(unfolding) => {
                let side = width / unfolding.columns;
                let side =
                    side / (u64::from(cube::WIDTH_PER_SIDE) * u64::from(side)).div_ceil(u64::from(max_width)) as u32;
                [side * unfolding.columns, side * unfolding.rows]
            }
        }
    }
}
