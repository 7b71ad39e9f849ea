//! Test grids, which channels show while their corners are moved.
//!
//! A grid is drawn on the picture, so corners and measured warps bend it as they bend the picture. Then it passes
//! through gains and the projector's curve like all light, but with a fixed exposure.

use crate::calibration::Calibration;
use glam::{DVec2, DVec3};
use half::f16;
use rayon::prelude::*;
use render::display::{Adaptation, Developer, Development, Exposure, Gamut, LINEAR_FORMAT, Seen, Tone};
use render::{Gpu, view_from_rows};
use room::{Channel, Display, EyeSide};
use view::Stored;

/// Development of test grids: light is shown as it is.
pub const DEVELOPMENT: Development = Development { exposure: Exposure::WHITE, tone: Tone::Linear, gamut: Gamut::Clamp };

/// Number of parts into which lines divide the picture along each axis.
const PARTS: f64 = 10.0;
/// Half the width of a line, pixels of the picture.
const HALF_WIDTH: f64 = 1.0;
/// Width of the frame, pixels of the picture. The frame lies wholly within the picture.
const FRAME: f64 = 3.0;
/// Diameter of the circle, in units of the picture's smaller side.
const CIRCLE: f64 = 0.8;
/// Radius of the corners' marks, in units of the picture's smaller side.
const MARK: f64 = 0.05;

/// Light between the lines; white is 1. It is not quite black, so that the picture's extent shows.
const BETWEEN: f64 = 0.01;
/// Light of all lines except the middle ones; white is 1.
const LINE: f64 = 0.2;

/// Grids of all channels, and an adaptation that the grids do not change.
pub struct TestGrids {
    /// Pictures of the grids, one for each channel.
    pub lights: Vec<wgpu::TextureView>,
    /// Adaptation that shows the grids as they are.
    pub adaptation: Adaptation,
    /// True if corners have been moved since the grids were shown.
    pub moved: bool,
}

impl TestGrids {
    /// Creates the grids of all channels of a display.
    pub fn new(gpu: &Gpu, display: &Display, passes: &Developer, calibration: &Calibration) -> Self {
        let light = |channel: usize| light(gpu, &display.channels[channel], marked(calibration, channel));
        let lights: Vec<_> = (0..display.channels.len()).map(light).collect();
        let mut adaptation = Adaptation::new(gpu);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let seen = |radiance| Seen { radiance, stored: Stored::UNSHIFTED, elapsed_s: None };
        let seen: Vec<_> = lights.iter().take(1).map(seen).collect();
        passes.adapt_to_all(gpu, &mut encoder, &mut adaptation, &seen, &DEVELOPMENT);
        gpu.queue.submit([encoder.finish()]);
        Self { lights, adaptation, moved: false }
    }

    /// Redraws the grid of a channel.
    pub fn update(&mut self, gpu: &Gpu, display: &Display, calibration: &Calibration, channel: usize) {
        self.lights[channel] = light(gpu, &display.channels[channel], marked(calibration, channel));
    }
}

/// Chosen corner, if it belongs to this channel.
fn marked(calibration: &Calibration, channel: usize) -> Option<usize> {
    let (of_channel, corner) = calibration.chosen();
    (of_channel == channel).then_some(corner)
}

/// Texture with a channel's grid.
fn light(gpu: &Gpu, channel: &Channel, chosen: Option<usize>) -> wgpu::TextureView {
    let [width, height] = channel.size();
    let texels = texels(channel, chosen);
    view_from_rows(gpu, "test grid", [width, height, 1], LINEAR_FORMAT, bytemuck::cast_slice(&texels))
}

/// Linear light of the pixels of a channel's viewport, row by row from the upper left; black outside the picture.
fn texels(channel: &Channel, chosen: Option<usize>) -> Vec<[f16; 4]> {
    let [width, height] = channel.size();
    let size = DVec2::new(f64::from(width), f64::from(height));
    let colour = colour(channel.eye);
    let texel = |column: u32, row: u32| {
        let viewport = (DVec2::new(f64::from(column), f64::from(row)) + 0.5) / size;
        let place = channel.picture(viewport);
        let light = colour * place.map_or(0.0, |place| brightness(place, size, chosen));
        [light.x, light.y, light.z, 1.0].map(f16::from_f64)
    };
    (0..height).into_par_iter().flat_map_iter(|row| (0..width).map(move |column| texel(column, row))).collect()
}

/// Colour of an eye's grid, linear sRGB.
fn colour(eye: EyeSide) -> DVec3 {
    match eye {
        EyeSide::Left => DVec3::new(1.0, 0.3, 0.2),
        EyeSide::Right => DVec3::new(0.2, 0.4, 1.0),
        EyeSide::Centre => DVec3::ONE,
    }
}

/// Light at a place (0 to 1, y down) of a picture of `size` pixels. `chosen` is the corner whose mark is filled.
fn brightness(place: DVec2, size: DVec2, chosen: Option<usize>) -> f64 {
    let pixels = place * size;
    let smaller = size.min_element();
    let line = |distance: f64| (HALF_WIDTH + 0.5 - distance.abs()).clamp(0.0, 1.0);

    // Lines every tenth, the middle ones brighter.
    let nearest = (place * PARTS).round();
    let off = (pixels - nearest / PARTS * size).abs();
    let weight = |number: f64| if number * 2.0 == PARTS { 1.0 } else { LINE };
    let mut light = BETWEEN.max(line(off.x) * weight(nearest.x)).max(line(off.y) * weight(nearest.y));

    // The circle.
    let from_middle = (pixels - 0.5 * size).length();
    light = light.max(line(from_middle - 0.5 * CIRCLE * smaller));

    // The frame, within the picture.
    let to_edge = pixels.min(size - pixels).min_element();
    light = light.max((FRAME + 0.5 - to_edge).clamp(0.0, 1.0));

    // A quarter of a ring in each corner, a quarter of a disc in the chosen one.
    for (index, corner) in [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].into_iter().enumerate() {
        let beyond = (pixels - corner * size).length() - MARK * smaller;
        light = light.max(if chosen == Some(index) { (0.5 - beyond).clamp(0.0, 1.0) } else { line(beyond) });
    }
    light
}

#[cfg(test)]
mod tests {
    //! Law under test: the grid shows where the picture ends. A wrong program would draw the frame away from the
    //! corners, or mark another corner than the one that keys move.

    use super::*;
    use room::{CornerWarp, Warp};

    /// Channel of 200 × 100 pixels.
    fn channel() -> Channel {
        let mut channel = Display::built_in("window").unwrap().channels[0].clone();
        channel.viewport = [0, 0, 200, 100];
        channel
    }

    /// Green of a pixel, which is its brightness in the grid of the centre eye.
    fn green(texels: &[[f16; 4]], column: usize, row: usize) -> f64 {
        texels[row * 200 + column][1].to_f64()
    }

    #[test]
    fn the_frame_is_the_pictures_edge() {
        let texels = texels(&channel(), None);
        for column in 0..200 {
            assert_eq!((green(&texels, column, 0), green(&texels, column, 99)), (1.0, 1.0), "column {column}");
        }
        for row in 0..100 {
            assert_eq!((green(&texels, 0, row), green(&texels, 199, row)), (1.0, 1.0), "row {row}");
        }
    }

    #[test]
    fn the_frame_goes_with_the_corners() {
        let size = DVec2::new(200.0, 100.0);
        let [upper_left, lower_left] = [DVec2::new(20.0, 10.0), DVec2::new(20.0, 100.0)];
        let places = [upper_left, DVec2::new(200.0, 10.0), size, lower_left];
        let mut channel = channel();
        channel.warp = Some(Warp::Corners(CornerWarp::new(places.map(|place| place / size)).unwrap()));
        let texels = texels(&channel, None);
        for column in 20..200 {
            assert_eq!((green(&texels, column, 9), green(&texels, column, 10)), (0.0, 1.0), "column {column}");
        }
        for row in 10..100 {
            assert_eq!((green(&texels, 19, row), green(&texels, 20, row)), (0.0, 1.0), "row {row}");
        }
    }

    #[test]
    fn the_chosen_corner_alone_is_filled() {
        // Pixels within the marks, whose radius is 10 pixels, and beyond the frame.
        let within = [(5, 5), (394, 5), (394, 194), (5, 194)];
        let mut channel = channel();
        channel.viewport = [0, 0, 400, 200];
        for chosen in 0..4 {
            let texels = texels(&channel, Some(chosen));
            for (corner, (column, row)) in within.into_iter().enumerate() {
                let filled = texels[row * 400 + column][1] == f16::ONE;
                assert_eq!(filled, corner == chosen, "corner {corner} of {chosen}");
            }
        }
    }

    #[test]
    fn eyes_differ_and_grids_are_symmetric() {
        let [mut left, mut right] = [channel(), channel()];
        (left.eye, right.eye) = (EyeSide::Left, EyeSide::Right);
        let [left, right] = [left, right].map(|channel| texels(&channel, None));
        assert!(left[0][0] > left[0][2] && right[0][2] > right[0][0]);
        for row in 0..100 {
            for column in 0..200 {
                let mirrored = [(199 - column, row), (column, 99 - row)].map(|(x, y)| green(&left, x, y));
                // The tolerance covers rounding of places.
                assert!(mirrored.iter().all(|light| (light - green(&left, column, row)).abs() < 1e-3));
            }
        }
    }
}
