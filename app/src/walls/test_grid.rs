//! Test grids: what a channel shows while its corners are moved.
//!
//! A grid is drawn on the picture, so that corners and measured warps bend it as they bend the picture; then it goes the way of
//! all light, through gains and the projector's curve, but with no exposure that could change.

use super::calibration::Calibration;
use crate::gpu::Gpu;
use crate::renderers::display::{self, Adaptation, Development, Exposure, Gamut, Seen, Stored, Tone};
use crate::room::{Channel, Display, Eye};
use glam::{DVec2, DVec3};
use half::f16;
use rayon::prelude::*;
use wgpu::util::{DeviceExt, TextureDataOrder};

/// How it is developed: light is shown as it is.
pub const DEVELOPMENT: Development = Development { exposure: Exposure::WHITE, tone: Tone::Linear, gamut: Gamut::Clamp };

/// Lines along each axis divide the picture into so many parts.
const PARTS: f64 = 10.0;
/// Half the width of lines in pixels of the picture.
const HALF_WIDTH: f64 = 1.0;
/// Width of the frame, likewise: it lies wholly within the picture.
const FRAME: f64 = 3.0;
/// Diameter of the circle in the picture's smaller side.
const CIRCLE: f64 = 0.8;
/// Radius of corners' marks in the picture's smaller side.
const MARK: f64 = 0.05;

/// Light of lines, of what lies between them, and of the marks; white is 1.
const BETWEEN: f64 = 0.01;
const LINE: f64 = 0.2;
const BRIGHT: f64 = 1.0;

/// The grids of all channels, and an eye that does not adapt to them.
pub struct Grids {
    /// One for each channel.
    pub lights: Vec<wgpu::TextureView>,
    /// What shows them as they are.
    pub adaptation: Adaptation,
}

impl Grids {
    /// Of all channels of a display.
    pub fn new(gpu: &Gpu, display: &Display, passes: &display::Display, calibration: &Calibration) -> Self {
        let light = |channel: usize| light(gpu, &display.channels[channel], marked(calibration, channel));
        let lights: Vec<_> = (0..display.channels.len()).map(light).collect();
        let mut adaptation = Adaptation::new(gpu);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let seen = |radiance| Seen { radiance, stored: Stored::UNSHIFTED, elapsed_s: None };
        let seen: Vec<_> = lights.iter().take(1).map(seen).collect();
        passes.adapt_to_all(gpu, &mut encoder, &mut adaptation, &seen, &DEVELOPMENT);
        gpu.queue.submit([encoder.finish()]);
        Self { lights, adaptation }
    }

    /// Draws a channel's anew.
    pub fn update(&mut self, gpu: &Gpu, display: &Display, calibration: &Calibration, channel: usize) {
        self.lights[channel] = light(gpu, &display.channels[channel], marked(calibration, channel));
    }
}

/// The channel's corner that is chosen, if one is.
fn marked(calibration: &Calibration, channel: usize) -> Option<usize> {
    let (of_channel, corner) = calibration.chosen();
    (of_channel == channel).then_some(corner)
}

/// A channel's grid, pixel by pixel of its viewport.
fn light(gpu: &Gpu, channel: &Channel, chosen: Option<usize>) -> wgpu::TextureView {
    let [width, height] = channel.size();
    let size = DVec2::new(f64::from(width), f64::from(height));
    let colour = colour(channel.eye);
    let texels: Vec<[f16; 4]> = (0..height)
        .into_par_iter()
        .flat_map_iter(|row| {
            (0..width).map(move |column| {
                let viewport = (DVec2::new(f64::from(column), f64::from(row)) + 0.5) / size;
                let place = match &channel.warp {
                    Some(warp) => warp.picture(viewport),
                    None => Some(viewport),
                };
                let light = colour * place.map_or(0.0, |place| brightness(place, size, chosen));
                [light.x, light.y, light.z, 1.0].map(f16::from_f64)
            })
        })
        .collect();
    let descriptor = wgpu::TextureDescriptor {
        label: Some("test grid"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: display::LINEAR_FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let bytes = bytemuck::cast_slice(&texels);
    gpu.device
        .create_texture_with_data(&gpu.queue, &descriptor, TextureDataOrder::LayerMajor, bytes)
        .create_view(&wgpu::TextureViewDescriptor::default())
}

/// Linear sRGB that tells the eyes apart.
fn colour(eye: Eye) -> DVec3 {
    match eye {
        Eye::Left => DVec3::new(1.0, 0.3, 0.2),
        Eye::Right => DVec3::new(0.2, 0.4, 1.0),
        Eye::Centre => DVec3::ONE,
    }
}

/// Light of a place of the picture (0 to 1, y down) that has `size` pixels. `chosen`: the corner whose mark is filled.
fn brightness(place: DVec2, size: DVec2, chosen: Option<usize>) -> f64 {
    let pixels = place * size;
    let smaller = size.min_element();
    let line = |distance: f64| (HALF_WIDTH + 0.5 - distance.abs()).clamp(0.0, 1.0);

    // Lines every tenth, the middle ones brighter.
    let nearest = (place * PARTS).round();
    let off = (pixels - nearest / PARTS * size).abs();
    let weight = |number: f64| if number * 2.0 == PARTS { BRIGHT } else { LINE };
    let mut light = BETWEEN.max(line(off.x) * weight(nearest.x)).max(line(off.y) * weight(nearest.y));

    // The circle.
    let from_middle = (pixels - 0.5 * size).length();
    light = light.max(line(from_middle - 0.5 * CIRCLE * smaller));

    // The frame, within the picture.
    let to_edge = pixels.min(size - pixels).min_element();
    light = light.max((FRAME + 0.5 - to_edge).clamp(0.0, 1.0));

    // A quarter of a ring in each corner, of a disc in the chosen one.
    for (index, corner) in [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].into_iter().enumerate() {
        let beyond = (pixels - corner * size).length() - MARK * smaller;
        light = light.max(if chosen == Some(index) { (0.5 - beyond).clamp(0.0, 1.0) } else { line(beyond) });
    }
    light
}
