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
