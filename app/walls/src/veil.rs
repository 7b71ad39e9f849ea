//! Veils before the pictures of flat screens: light grows darker away from straight ahead, or everywhere.
//!
//! The angle is measured at each eye from where the head faces, so both eyes see the edge of a veil in the same
//! direction, and it fuses as if it were far away.

use bytemuck::bytes_of;
use glam::{DVec3, Vec4};
use render::Gpu;
use render::display::{Pass, UNIFORM, contents, encodes};
use room::FlatSurface;

/// Power of sRGB's signal that is close to its light.
const LIGHT_OF_SIGNAL: f64 = 2.2;

/// Veil before an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Veil {
    /// Angle from straight ahead up to which nothing is darkened, and angle from which on all is; radians.
    pub angles_rad: [f64; 2],
    /// Share of the screen's signal that is taken beyond the second angle, 0 to 1.
    pub opacity: f64,
}

impl Veil {
    /// No veil.
    pub const NONE: Self = Self::everywhere(0.0);

    /// Veil that darkens everything alike.
    pub const fn everywhere(opacity: f64) -> Self {
        // Every angle lies beyond these.
        Self { angles_rad: [-2.0, -1.0], opacity }
    }

    /// True if the veil darkens nothing.
    pub fn is_none(&self) -> bool {
        self.opacity <= 0.0
    }

    /// Share of the signal that is taken at an angle from straight ahead, radians.
    pub fn opacity_at(&self, angle_rad: f64) -> f64 {
        let [clear, dark] = self.angles_rad;
        let share = ((angle_rad - clear) / (dark - clear)).clamp(0.0, 1.0);
        self.opacity * share * share * (3.0 - 2.0 * share)
    }
}

/// Eye before whose picture a veil is, and its screen; room axes, metres.
pub struct VeiledEye {
    /// Place of the eye.
    pub eye_m: DVec3,
    /// Unit vector to where the head faces.
    pub ahead: DVec3,
    /// Screen of the picture.
    pub screen: FlatSurface,
    /// Rectangle of the picture in the target: x, y, width, height, pixels.
    pub viewport: [u32; 4],
}

/// Passes that draw veils, each compiled when its format is first asked for.
#[derive(Default)]
pub struct VeilPasses {
    passes: Vec<(wgpu::TextureFormat, Pass)>,
}

impl VeilPasses {
    /// Draws a veil over a picture in `target`, which is written in this format.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (target, format): (&wgpu::TextureView, wgpu::TextureFormat),
        veil: &Veil,
        eye: &VeiledEye,
    ) {
        let vector = |vector: DVec3| vector.as_vec3().extend(0.0);
        let [x, y, width, height] = eye.viewport.map(|pixels| pixels as f32);
        let [clear, dark] = veil.angles_rad.map(|angle| angle as f32);
        let uniform = shaders::VeilUniforms {
            eye: vector(eye.eye_m),
            ahead: vector(eye.ahead),
            screen_corner: vector(eye.screen.lower_left),
            screen_right: vector(eye.screen.right),
            screen_up: vector(eye.screen.up),
            viewport: Vec4::new(x, y, width, height),
            shade: Vec4::new(clear, dark, veil.opacity as f32, 0.0),
        };
        let uniform = contents(gpu, "veil", bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let resources = [uniform.as_entire_binding()];
        self.pass(gpu, format).draw_part(gpu, encoder, target, &resources, eye.viewport, true);
    }

    fn pass(&mut self, gpu: &Gpu, format: wgpu::TextureFormat) -> &Pass {
        let known = self.passes.iter().position(|(known, _)| *known == format);
        let index = known.unwrap_or_else(|| {
            let power = if encodes(format) { 1.0 } else { LIGHT_OF_SIGNAL };
            let pass = Pass::over(gpu, &shaders::VEIL, &[("SIGNAL_POWER", power)], &[UNIFORM], format);
            self.passes.push((format, pass));
            self.passes.len() - 1
        });
        &self.passes[index].1
    }
}

#[cfg(test)]
mod tests {
    //! Law: each pixel of each eye loses the share of its signal that the angle between its direction and the head's
    //! says, whatever shape and cant the eyes' pictures have; so both eyes darken alike in every direction. A wrong
    //! program darkens about the middle of each picture, which eyes that are not alike see in two places.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use glam::{DMat3, DQuat, DVec2};
    use room::{Display, HeadsetEye};
    use studio::Sheet;

    /// Width and height of the pictures, pixels.
    const SIZE: [u32; 2] = [96, 80];
    /// Rounding of a value of 8 bits; of one that the format encodes as sRGB, which is no power.
    const ROUNDING: f64 = 1.0;
    const CURVE: f64 = 12.0;

    fn eye(side: f64) -> HeadsetEye {
        HeadsetEye {
            position_m: DVec3::new(0.0315 * side, 0.0, 0.0),
            orientation: DQuat::from_rotation_y(-0.12 * side),
            low: DVec2::new(-1.1 - 0.2 * side, -0.9),
            high: DVec2::new(1.0 - 0.2 * side, 1.2),
        }
    }

    /// Bytes of a white picture of an eye behind a veil.
    fn veiled(gpu: &Gpu, veil: &Veil, format: wgpu::TextureFormat, eye: &VeiledEye) -> Vec<u8> {
        let sheet = Sheet::new(gpu, SIZE, format);
        let target = sheet.view();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::WHITE), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        }));
        VeilPasses::default().draw(gpu, &mut encoder, (&target, format), veil, eye);
        sheet.fetch(gpu, encoder).unwrap()
    }

    #[test]
    fn each_eye_darkens_by_the_angle_from_where_the_head_faces() {
        let gpu = Gpu::new().unwrap();
        let eyes = [eye(-1.0), eye(1.0)];
        let mut display = Display::headset("headset", &eyes, &[SIZE; 2]);
        let head_m = DVec3::new(-0.7, 1.1, 2.0);
        display.follow_head(&eyes, head_m);
        let edges = Veil { angles_rad: [0.3, 0.75], opacity: 0.8 };
        let [plain, srgb] = [wgpu::TextureFormat::Rgba8Unorm, wgpu::TextureFormat::Rgba8UnormSrgb];
        for (veil, format, rounding) in
            [(edges, plain, ROUNDING), (edges, srgb, CURVE), (Veil::everywhere(0.35), plain, ROUNDING)]
        {
            let (mut clear, mut dark) = (0, 0);
            for (channel, eye) in display.channels.iter().zip(&eyes) {
                let veiled_eye = VeiledEye {
                    eye_m: display.viewer.eye_m(channel.eye, head_m, DMat3::IDENTITY),
                    ahead: DVec3::NEG_Z,
                    screen: channel.flat(&display).unwrap(),
                    viewport: channel.viewport,
                };
                let bytes = veiled(&gpu, &veil, format, &veiled_eye);
                for (number, pixel) in (0..).zip(bytes.chunks_exact(4)) {
                    let share = DVec2::new(f64::from(number % SIZE[0]), f64::from(number / SIZE[0])) + 0.5;
                    let share = share / DVec2::new(f64::from(SIZE[0]), f64::from(SIZE[1]));
                    let tangents = eye.low + DVec2::new(share.x, 1.0 - share.y) * (eye.high - eye.low);
                    let angle = (eye.orientation * tangents.extend(-1.0)).angle_between(DVec3::NEG_Z);
                    let expected = 255.0 * (1.0 - veil.opacity_at(angle));
                    let off = pixel[..3].iter().map(|part| (f64::from(*part) - expected).abs()).fold(0.0, f64::max);
                    assert!(off <= rounding, "pixel {number}, {angle} rad: {pixel:?} for {expected}");
                    clear += usize::from(pixel[0] == 255);
                    dark += usize::from(expected < 60.0);
                }
            }
            assert!(veil != edges || (clear > 500 && dark > 500), "{clear} pixels are clear, {dark} are dark");
        }
    }

    #[test]
    fn a_veil_grows_from_one_angle_to_the_other_without_a_step() {
        let veil = Veil { angles_rad: [0.3, 0.7], opacity: 0.8 };
        for (angle, opacity) in [(0.0, 0.0), (0.3, 0.0), (0.5, 0.4), (0.7, 0.8), (3.0, 0.8)] {
            assert!((veil.opacity_at(angle) - opacity).abs() < 1e-12, "{angle}");
        }
        let angles = (0..100).map(|number| f64::from(number) * 0.01);
        assert!(angles.clone().zip(angles.skip(1)).all(|(one, other)| veil.opacity_at(one) <= veil.opacity_at(other)));
        assert!(Veil::NONE.is_none() && Veil::everywhere(1.0).opacity_at(0.0) == 1.0);
    }
}
