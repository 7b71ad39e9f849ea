//! Passes that draw sheets over the pictures of channels.

use crate::room_sheet::RoomSheet;
use bytemuck::bytes_of;
use glam::{DVec2, DVec3, Vec4};
use render::Gpu;
use render::display::{Pass, UNFILTERED, UNIFORM, contents, encodes};
use room::{FlatSurface, frustum};

const FILTERED: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Float { filterable: true },
    view_dimension: wgpu::TextureViewDimension::D2,
    multisampled: false,
};

/// Pixels around a sheet's outline that its edge may touch.
const MARGIN_PIXELS: f64 = 2.0;

/// Screen of a channel, as its pixels find their points.
#[derive(Clone, Copy)]
pub enum SheetScreen<'a> {
    /// Flat screen.
    Flat(FlatSurface),
    /// Any other screen: the point of each pixel.
    Table(&'a wgpu::TextureView),
}

/// Channel over whose picture sheets are drawn.
pub struct SheetChannel<'a> {
    /// Screen of the channel.
    pub screen: SheetScreen<'a>,
    /// Place of the eye in the room, metres.
    pub eye_m: DVec3,
    /// Rectangle of the picture in the target: x, y, width, height, pixels.
    pub viewport: [u32; 4],
    /// Gains of the channel's pixels.
    pub gains: Option<&'a wgpu::TextureView>,
    /// Exponent of the projector's light over its signal; `None` for the sRGB curve.
    pub gamma: Option<f64>,
}

/// Way in which a pass shows light.
#[derive(Clone, Copy, PartialEq)]
struct SheetLook {
    format: wgpu::TextureFormat,
    table: bool,
    gains: bool,
    gamma: Option<f64>,
}

/// Passes that draw sheets, compiled when they are first asked for.
#[derive(Default)]
pub struct SheetPasses {
    passes: Vec<(SheetLook, Pass)>,
    sampler: Option<wgpu::Sampler>,
}

impl SheetPasses {
    /// Draws sheets over a channel's picture in `target`, the first undermost.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        sheets: &[RoomSheet],
        channel: &SheetChannel<'_>,
    ) {
        for sheet in sheets {
            let within = match channel.screen {
                SheetScreen::Flat(flat) => match outline(sheet, &flat, channel) {
                    Some(within) => within,
                    None => continue,
                },
                SheetScreen::Table(_) => channel.viewport,
            };
            self.draw_sheet(gpu, encoder, target, sheet, channel, within);
        }
    }

    fn draw_sheet(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        sheet: &RoomSheet,
        channel: &SheetChannel<'_>,
        within: [u32; 4],
    ) {
        let vector = |vector: DVec3| vector.as_vec3().extend(0.0);
        let [x, y, width, height] = channel.viewport.map(|pixels| pixels as f32);
        let (flat, points) = match channel.screen {
            SheetScreen::Flat(flat) => (Some(flat), None),
            SheetScreen::Table(points) => (None, Some(points)),
        };
        let of_flat = |part: fn(&FlatSurface) -> DVec3| flat.as_ref().map_or(DVec3::ZERO, part);
        let uniform = shaders::SheetUniforms {
            eye: vector(channel.eye_m),
            corner: vector(sheet.corner_m),
            right: vector(sheet.right_m),
            up: vector(sheet.up_m),
            screen_corner: vector(of_flat(|flat| flat.lower_left)),
            screen_right: vector(of_flat(|flat| flat.right)),
            screen_up: vector(of_flat(|flat| flat.up)),
            viewport: Vec4::new(x, y, width, height),
        };
        let uniform = contents(gpu, "sheet", bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let make = || {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("sheet"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            })
        };
        let sampler = self.sampler.get_or_insert_with(make).clone();
        let resources = [
            uniform.as_entire_binding(),
            wgpu::BindingResource::TextureView(&sheet.picture),
            wgpu::BindingResource::Sampler(&sampler),
            wgpu::BindingResource::TextureView(points.unwrap_or(&sheet.picture)),
            wgpu::BindingResource::TextureView(channel.gains.unwrap_or(&sheet.picture)),
        ];
        let look = SheetLook {
            format: target.texture().format(),
            table: points.is_some(),
            gains: channel.gains.is_some(),
            gamma: channel.gamma,
        };
        let pass = self.pass(gpu, look);
        pass.draw_within(gpu, encoder, target, &resources, (channel.viewport, within), true);
    }

    fn pass(&mut self, gpu: &Gpu, look: SheetLook) -> &Pass {
        let known = self.passes.iter().position(|(known, _)| *known == look);
        let index = known.unwrap_or_else(|| {
            let overrides = [
                ("ENCODE", f64::from(u8::from(encodes(look.format)))),
                ("TABLE", f64::from(u8::from(look.table))),
                ("GAINS", f64::from(u8::from(look.gains))),
                ("SIGNAL_POWER", look.gamma.map_or(0.0, f64::recip)),
            ];
            let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
            let bindings = [UNIFORM, FILTERED, sampler, UNFILTERED, UNFILTERED];
            self.passes.push((look, Pass::over(gpu, &shaders::SHEET, &overrides, &bindings, look.format)));
            self.passes.len() - 1
        });
        &self.passes[index].1
    }
}

/// Rectangle of pixels outside of which a flat screen shows nothing of a sheet; the whole picture if a corner of the
/// sheet is beside or behind the eye. `None` if the screen shows nothing of it, or its back.
fn outline(sheet: &RoomSheet, flat: &FlatSurface, channel: &SheetChannel<'_>) -> Option<[u32; 4]> {
    let frustum = frustum(flat, channel.eye_m).ok()?;
    let [x, y, width, height] = channel.viewport;
    let size = DVec2::new(f64::from(width), f64::from(height));
    let RoomSheet { corner_m, right_m, up_m, .. } = sheet;
    let corners = [*corner_m, corner_m + right_m, corner_m + up_m, corner_m + right_m + up_m];
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for corner in corners {
        let eye = frustum.room_from_eye.transpose() * (corner - channel.eye_m);
        if eye.z > -1e-3 {
            return Some(channel.viewport);
        }
        let tangent = DVec2::new(eye.x, eye.y) / -eye.z;
        let share = (tangent - frustum.tangents.low) / (frustum.tangents.high - frustum.tangents.low);
        let pixel = DVec2::new(share.x, 1.0 - share.y) * size;
        (low, high) = (low.min(pixel), high.max(pixel));
    }
    let low = (low - MARGIN_PIXELS).floor().clamp(DVec2::ZERO, size);
    let high = (high + MARGIN_PIXELS).ceil().clamp(DVec2::ZERO, size);
    let [left, top, right, bottom] = [low.x, low.y, high.x, high.y].map(|pixel| pixel as u32);
    (right > left && bottom > top).then_some([x + left, y + top, right - left, bottom - top])
}
