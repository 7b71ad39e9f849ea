//! Turns and mirrorings by which a stored picture becomes the shown one.

use half::f16;

/// Turn of a stored picture: rows become columns first, then the order of the columns and of the rows is reversed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct PictureTurn {
    /// True if the rows of the stored picture are columns of the shown one.
    pub(super) transposed: bool,
    /// True if the columns come from right to left.
    pub(super) mirrored: bool,
    /// True if the rows come from the bottom up.
    pub(super) upside_down: bool,
}

impl PictureTurn {
    /// Size of the shown picture for that of the stored one, and the other way round.
    pub(super) fn size(self, [width, height]: [u32; 2]) -> [u32; 2] {
        if self.transposed { [height, width] } else { [width, height] }
    }

    /// Shown pixels of a stored picture of this size.
    pub(super) fn shown(self, stored: [u32; 2], mut rgb: Vec<[f16; 3]>) -> Vec<[f16; 3]> {
        let [width, height] = stored.map(|side| side as usize);
        if self.transposed {
            rgb = (0..width).flat_map(|x| (0..height).map(move |y| (x, y))).map(|(x, y)| rgb[y * width + x]).collect();
        }
        let width = self.size(stored)[0] as usize;
        if self.mirrored {
            rgb.chunks_exact_mut(width).for_each(<[_]>::reverse);
        }
        if self.upside_down {
            rgb.reverse();
            rgb.chunks_exact_mut(width).for_each(<[_]>::reverse);
        }
        rgb
    }
}
