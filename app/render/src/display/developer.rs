//! Passes that sum samples and develop radiance.

use super::adaptation::{Adaptation, Meter, Seen};
use super::development::{Development, Gamut, Tone};
use super::passes::{Pass, READ, UNFILTERED, UNIFORM, clear, contents};
use crate::gpu::Gpu;
use crate::target::texture;
use bytemuck::bytes_of;
use glam::Vec2;

/// Format of developed pictures that are not encoded yet.
pub const LINEAR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Passes that read one radiance texture and write one target.
pub struct Developer {
    accumulate: Pass,
    /// One pass for each look that was asked for.
    show: Vec<(Look, Pass)>,
    /// One pass for both eyes for each pair of curves that was asked for.
    show_views: Vec<((Tone, Gamut), Pass)>,
    meter: Meter,
    sum_format: wgpu::TextureFormat,
    screen_format: wgpu::TextureFormat,
    /// True if light is exposed alone, without tone curve and gamut.
    exposes_alone: bool,
}

/// Mean of samples: each sample is added with the weight 1/count.
pub struct Accumulator {
    sums: [wgpu::TextureView; 2],
    current: usize,
    filled: bool,
}

impl Developer {
    /// Passes that sum in `radiance` format and show in `screen` format. An sRGB format encodes by itself.
    pub fn new(gpu: &Gpu, radiance: wgpu::TextureFormat, screen: wgpu::TextureFormat) -> Self {
        Self {
            accumulate: Pass::new(gpu, &shaders::ACCUMULATE, &[], &[UNFILTERED, UNFILTERED, UNIFORM], radiance),
            show: Vec::new(),
            show_views: Vec::new(),
            meter: Meter::new(gpu),
            sum_format: radiance,
            screen_format: screen,
            exposes_alone: false,
        }
    }

    /// Passes that expose light into [`LINEAR_FORMAT`] and do nothing else to it: white is 1, brighter is above, and
    /// colours that a screen lacks have negative parts.
    pub fn exposing(gpu: &Gpu, radiance: wgpu::TextureFormat) -> Self {
        Self { exposes_alone: true, ..Self::new(gpu, radiance, LINEAR_FORMAT) }
    }

    /// Textures for the sum of several samples.
    pub fn accumulator(&self, gpu: &Gpu, size: [u32; 2]) -> Accumulator {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC;
        let sum = || texture(gpu, "sum", size, self.sum_format, 1, usage);
        Accumulator { sums: [sum(), sum()], current: 0, filled: false }
    }

    /// Adds one of `count` samples.
    pub fn add(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        sum: &mut Accumulator,
        sample: &wgpu::TextureView,
        count: u32,
    ) {
        // Clear before the first sample. Loads outside a 1 × 1 texture must not be relied on to give zeros.
        if !sum.filled {
            clear(encoder, &sum.sums[sum.current]);
            sum.filled = true;
        }
        let uniform = shaders::AccumulateUniforms { weight: 1.0 / count as f32 };
        let uniform = contents(gpu, "accumulate", bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let before = sum.current;
        sum.current = 1 - before;
        self.accumulate.draw(
            gpu,
            encoder,
            &sum.sums[sum.current],
            &[
                wgpu::BindingResource::TextureView(sample),
                wgpu::BindingResource::TextureView(&sum.sums[before]),
                uniform.as_entire_binding(),
            ],
        );
    }

    /// Adapts an eye to a picture. [`Developer::show`] then shows radiance as that eye sees it.
    pub fn adapt(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        adaptation: &mut Adaptation,
        seen: &Seen<'_>,
        development: &Development,
    ) {
        self.adapt_to_all(gpu, encoder, adaptation, std::slice::from_ref(seen), development);
    }

    /// Adapts an eye to several pictures that surround it. The exposure is meant for the scale of the first one.
    pub fn adapt_to_all(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        adaptation: &mut Adaptation,
        seen: &[Seen<'_>],
        development: &Development,
    ) {
        self.meter.adapt(gpu, encoder, adaptation, seen, development);
    }

    /// Writes `radiance` to the screen, as an eye in the state `adaptation` sees it.
    pub fn show(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        radiance: &wgpu::TextureView,
        adaptation: &Adaptation,
        development: &Development,
        screen: &wgpu::TextureView,
    ) {
        let size = screen.texture().size();
        let whole = DevelopedPart {
            viewport: [0, 0, size.width, size.height],
            over: false,
            exposure: 1.0,
            gains: None,
            gamma: None,
        };
        self.show_part(gpu, encoder, radiance, adaptation, development, screen, &whole);
    }

    /// Writes `radiance` to a part of the screen.
    #[expect(clippy::too_many_arguments, reason = "light, eye and screen are three things")]
    pub fn show_part(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        radiance: &wgpu::TextureView,
        adaptation: &Adaptation,
        development: &Development,
        screen: &wgpu::TextureView,
        part: &DevelopedPart<'_>,
    ) {
        let [x, y, ..] = part.viewport.map(|pixels| pixels as f32);
        let placement = shaders::PlacementUniforms { origin: Vec2::new(x, y), exposure: part.exposure, odd: 0.0 };
        let placement = contents(gpu, "placement", bytes_of(&placement), wgpu::BufferUsages::UNIFORM);
        let resources = [
            wgpu::BindingResource::TextureView(radiance),
            adaptation.state.as_entire_binding(),
            adaptation.curve.as_entire_binding(),
            placement.as_entire_binding(),
            wgpu::BindingResource::TextureView(part.gains.unwrap_or(radiance)),
        ];
        let pass = self.shown_by(gpu, development, part);
        pass.draw_part(gpu, encoder, screen, &resources, part.viewport, part.over);
    }

    /// Writes the radiance of two views, with the factor of each besides the eye's exposure, to the two layers of a
    /// screen, in one pass. Only for a device that draws views.
    pub fn show_views(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        [first, second]: [(&wgpu::TextureView, f32); 2],
        adaptation: &Adaptation,
        development: &Development,
        screen: &wgpu::TextureView,
    ) {
        let placement = |exposure| {
            let placement = shaders::PlacementUniforms { origin: Vec2::ZERO, exposure, odd: 0.0 };
            contents(gpu, "placement", bytes_of(&placement), wgpu::BufferUsages::UNIFORM)
        };
        let placements = [placement(first.1), placement(second.1)];
        let resources = [
            wgpu::BindingResource::TextureView(first.0),
            adaptation.state.as_entire_binding(),
            adaptation.curve.as_entire_binding(),
            placements[0].as_entire_binding(),
            wgpu::BindingResource::TextureView(second.0),
            placements[1].as_entire_binding(),
        ];
        let Development { tone, gamut, .. } = *development;
        let known = self.show_views.iter().position(|pass| pass.0 == (tone, gamut));
        let index = known.unwrap_or_else(|| {
            let bindings = [UNFILTERED, UNIFORM, READ, UNIFORM, UNFILTERED, UNIFORM];
            let overrides = overrides(self.screen_format, tone, gamut);
            let pass = Pass::of_views(gpu, &shaders::DISPLAY_VIEWS, &overrides, &bindings, self.screen_format);
            self.show_views.push(((tone, gamut), pass));
            self.show_views.len() - 1
        });
        self.show_views[index].1.draw(gpu, encoder, screen, &resources);
    }

    /// Pass for a development and a part of the screen, compiled when it is first asked for.
    fn shown_by(&mut self, gpu: &Gpu, development: &Development, part: &DevelopedPart<'_>) -> &Pass {
        let Development { tone, gamut, .. } = *development;
        let look = Look { tone, gamut, gains: part.gains.is_some(), gamma: part.gamma };
        let known = self.show.iter().position(|pass| pass.0 == look);
        let index = known.unwrap_or_else(|| {
            let [encode, mut tone, mut gamut] = overrides(self.screen_format, tone, gamut);
            if self.exposes_alone {
                (tone.1, gamut.1) = (f64::from(shaders::TONE_LINEAR), f64::from(shaders::GAMUT_OPEN));
            }
            let gains = ("GAINS", f64::from(u8::from(look.gains)));
            let overrides = [encode, tone, gamut, gains, ("SIGNAL_POWER", look.gamma.map_or(0.0, f64::recip))];
            let bindings = [UNFILTERED, UNIFORM, READ, UNIFORM, UNFILTERED];
            let pass = Pass::new(gpu, &shaders::DISPLAY, &overrides, &bindings, self.screen_format);
            self.show.push((look, pass));
            self.show.len() - 1
        });
        &self.show[index].1
    }
}

/// Place of a picture on a screen, and the corrections that apply there.
#[derive(Clone, Copy, Debug)]
pub struct DevelopedPart<'a> {
    /// Rectangle of the picture: x, y, width and height in pixels from the screen's upper left corner.
    pub viewport: [u32; 4],
    /// True if the rest of the screen stays unchanged. Otherwise it becomes black.
    pub over: bool,
    /// Factor on radiance besides the eye's exposure.
    pub exposure: f32,
    /// Factor for each pixel, on the screen's linear light.
    pub gains: Option<&'a wgpu::TextureView>,
    /// Exponent of the screen: its light is its signal to this power. `None` stands for the sRGB curve.
    pub gamma: Option<f64>,
}

/// Settings for which a pass is compiled.
#[derive(Clone, Copy, PartialEq)]
struct Look {
    tone: Tone,
    gamut: Gamut,
    gains: bool,
    gamma: Option<f64>,
}

impl Accumulator {
    /// Texture with the sum of the samples added so far.
    pub fn result(&self) -> &wgpu::TextureView {
        &self.sums[self.current]
    }

    /// Makes the sum black.
    pub fn blacken(&self, encoder: &mut wgpu::CommandEncoder) {
        drop(clear(encoder, self.result()));
    }

    /// Forgets the samples, for the next picture.
    pub fn restart(&mut self) {
        self.filled = false;
    }
}

/// Override values of the development for a screen of this format.
fn overrides(screen: wgpu::TextureFormat, tone: Tone, gamut: Gamut) -> [(&'static str, f64); 3] {
    let encode = f64::from(u8::from(encodes(screen)));
    [("ENCODE", encode), ("TONE", f64::from(tone as u32)), ("GAMUT", f64::from(gamut as u32))]
}

/// True if the values written to a screen must be encoded: the format does not encode by itself, and is no float
/// format for linear light.
pub fn encodes(screen: wgpu::TextureFormat) -> bool {
    !screen.is_srgb() && screen != LINEAR_FORMAT
}

/// Pass that resamples flat pictures onto a surface that is not flat; see `resample.wgsl`. If `smooth` is true,
/// texels are interpolated.
pub fn resample(gpu: &Gpu, format: wgpu::TextureFormat, smooth: bool) -> Pass {
    let overrides = [("SMOOTH", f64::from(u8::from(smooth)))];
    Pass::new(gpu, &shaders::RESAMPLE, &overrides, &[UNFILTERED, UNIFORM, UNFILTERED], format)
}

/// Pass that takes a picture of any projection from light of all directions; see `from_sphere.wgsl`.
pub fn from_sphere(gpu: &Gpu, format: wgpu::TextureFormat) -> Pass {
    Pass::new(gpu, &shaders::FROM_SPHERE, &[], &[UNFILTERED, UNFILTERED], format)
}

/// Pass that writes linear light to a screen.
pub fn encoded(gpu: &Gpu, screen: wgpu::TextureFormat) -> Pass {
    let overrides = [("ENCODE", f64::from(u8::from(encodes(screen))))];
    Pass::new(gpu, &shaders::ENCODED, &overrides, &[UNFILTERED], screen)
}

/// Copies radiance into a target of another format.
pub fn copy(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    radiance: &wgpu::TextureView,
    target: &wgpu::TextureView,
    format: wgpu::TextureFormat,
) {
    let resources = [wgpu::BindingResource::TextureView(radiance)];
    Pass::new(gpu, &shaders::COPY, &[], &[UNFILTERED], format).draw(gpu, encoder, target, &resources);
}
