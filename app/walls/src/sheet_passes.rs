//! Passes that draw sheets over the pictures of channels.

use crate::room_sheet::RoomSheet;
use bytemuck::bytes_of;
use glam::{DVec2, DVec3, Vec4};
use render::Gpu;
use render::display::{FILTERED, Pass, UNFILTERED, UNIFORM, contents, encodes};
use room::{FlatSurface, frustum};

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
    /// Format in which the target is written.
    pub format: wgpu::TextureFormat,
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
                SheetScreen::Flat(flat) => {
                    match outline([sheet.corner_m, sheet.right_m, sheet.up_m], &flat, channel.eye_m, channel.viewport) {
                        Some(within) => within,
                        None => continue,
                    }
                }
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
            format: channel.format,
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

/// Rectangle of pixels outside of which a flat screen shows nothing of a sheet, which is given by its lower left
/// corner and its edges. `None` if the screen shows nothing of it, or its back.
fn outline(
    [corner_m, right_m, up_m]: [DVec3; 3],
    flat: &FlatSurface,
    eye_m: DVec3,
    [x, y, width, height]: [u32; 4],
) -> Option<[u32; 4]> {
    let frustum = frustum(flat, eye_m).ok()?;
    let size = DVec2::new(f64::from(width), f64::from(height));
    let corners = [corner_m, corner_m + right_m, corner_m + right_m + up_m, corner_m + up_m]
        .map(|corner| frustum.room_from_eye.transpose() * (corner - eye_m));
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for eye in ahead(&corners) {
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

/// Corners of the part of a polygon that lies ahead of the eye, which looks along −z.
fn ahead(corners: &[DVec3]) -> Vec<DVec3> {
    /// Smallest distance ahead, metres.
    const LEAST_M: f64 = 1e-3;
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (&from, &to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let [one, other] = [from, to].map(|corner| -corner.z - LEAST_M);
        if one >= 0.0 {
            kept.push(from);
        }
        if (one >= 0.0) != (other >= 0.0) {
            kept.push(from.lerp(to, one / (one - other)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    //! Law: the outline of a sheet holds every pixel whose ray meets the sheet, wherever the sheet is, also behind the
    //! eye in part; and it is as small as the sheet, up to its margin, where the pixels show its outermost points.

    use super::*;
    use crate::room_sheet::meet;
    use glam::DQuat;
    use std::f64::consts::PI;

    const SIDE: u32 = 48;

    /// Rectangle of the pixels that show a sheet: lowest and highest column and row.
    fn shown(sheet: [DVec3; 3], flat: &FlatSurface, eye_m: DVec3) -> Option<[u32; 4]> {
        let pixels = (0..SIDE * SIDE).map(|number| [number % SIDE, number / SIDE]);
        let seen = pixels.filter(|[x, y]| {
            let share = [*x, *y].map(|pixel| (f64::from(pixel) + 0.5) / f64::from(SIDE));
            let point = flat.lower_left + share[0] * flat.right + (1.0 - share[1]) * flat.up;
            meet(sheet[0], sheet[1], sheet[2], eye_m, point - eye_m).is_some()
        });
        seen.map(|[x, y]| [x, x, y, y])
            .reduce(|all, one| [all[0].min(one[0]), all[1].max(one[1]), all[2].min(one[2]), all[3].max(one[3])])
    }

    #[test]
    fn an_outline_holds_the_pixels_that_show_the_sheet_and_few_more() {
        let flat = FlatSurface {
            lower_left: DVec3::new(-1.0, 0.0, -1.5),
            right: DVec3::new(2.0, 0.0, 0.0),
            up: DVec3::new(0.0, 2.0, 0.0),
        };
        let (mut seen, mut behind) = (0, 0);
        for number in 0..600 {
            let turn = |step: f64| (f64::from(number) * step).fract();
            let eye_m = DVec3::new(turn(0.37) - 0.5, 1.0 + 0.4 * turn(0.71), 0.3 * turn(0.13));
            let towards =
                DQuat::from_rotation_y(2.0 * PI * turn(0.618)) * DQuat::from_rotation_x(PI * (turn(0.41) - 0.5));
            let (right, up) = (towards * DVec3::X * (0.2 + 1.6 * turn(0.29)), towards * DVec3::Y * (0.2 + turn(0.53)));
            let corner = eye_m + towards * DVec3::NEG_Z * (0.4 + 2.0 * turn(0.83)) - 0.5 * (right + up);
            let sheet = [corner, right, up];
            let outline = outline(sheet, &flat, eye_m, [0, 0, SIDE, SIDE]);
            let Some([left, last, top, bottom]) = shown(sheet, &flat, eye_m) else { continue };
            let [x, y, width, height] = outline.expect("a sheet that is seen has an outline");
            let inside = x <= left && last < x + width && y <= top && bottom < y + height;
            assert!(inside, "{number}: {outline:?} does not hold {:?}", [left, last, top, bottom]);
            // Corners on the screen are shown by pixels next to them.
            let corners = [corner, corner + right, corner + right + up, corner + up];
            let on_screen = corners.iter().all(|point| {
                let way = (flat.lower_left.z - eye_m.z) / (point.z - eye_m.z);
                let at = eye_m + way * (point - eye_m) - flat.lower_left;
                way > 0.0 && at.x > 0.0 && at.x < 2.0 && at.y > 0.0 && at.y < 2.0
            });
            seen += 1;
            behind += usize::from(corners.iter().any(|point| point.z >= eye_m.z));
            if on_screen {
                let more = 2 * MARGIN_PIXELS as u32 + 4;
                assert!(width <= last - left + 1 + more && height <= bottom - top + 1 + more, "{number}: too large");
            }
        }
        assert!(seen > 100 && behind > 10, "{seen} sheets are seen, {behind} of them behind the eye in part");
    }
}
