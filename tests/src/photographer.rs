//! Pictures made by the program: a scene, a device, and a studio of one size.

use glam::DVec3;
use image::{Rgb32FImage, RgbaImage};
use physics::Celerity;
use render::display::{Development, Gamut};
use render::target::Format;
use render::{Gpu, GpuError, Pending, SceneRenderer};
use scene::Scene;
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;
use studio::{Shown, Studio};
use trace::{RayTracer, Traced, TracedPlace};
use view::{Dial, Effects, Occasion, RendererName, Shot};

use crate::bodies::observer;
use crate::view::View;

/// `polygon` with the scene drawn as it is given. A test that wants short edges cuts them itself, so the length does
/// not matter.
pub const AS_GIVEN: Dial = Dial::edge(1.0);

/// Map of the image renderer in its quality for pictures with one sample a pixel.
pub const DEFAULT_MAP: Dial = Dial::map(8.0);

/// Ray tracer.
pub const RAYS: Dial =
    Dial { renderer: RendererName::Raytrace, edge: None, transform: None, tolerance: None, map_scale: None };

/// Device on which all tests of a process draw.
///
/// # Panics
/// If there is no Vulkan driver, with a sentence that names the package to install: a test that cannot draw has
/// failed.
pub fn gpu() -> &'static Gpu {
    // Keep the result, not the panic, which would reach only the first test.
    static GPU: LazyLock<Result<Gpu, GpuError>> = LazyLock::new(Gpu::new);
    #[expect(clippy::panic, reason = "a test without a driver fails, and says what to install")]
    GPU.as_ref().unwrap_or_else(|error| panic!("{error}"))
}

/// Renderer or tracer of a photographer's scene.
enum Source {
    Drawn(Box<SceneRenderer>),
    Traced(Box<RayTracer>),
}

/// Photographer of one scene, with one method.
pub struct Photographer {
    source: Source,
    studio: Studio,
    size: [u32; 2],
    samples: u32,
}

impl Photographer {
    /// Prepares pictures by the `polygon` renderer, of `size` pixels with `samples` each. `background` is a linear
    /// radiance that replaces the scene's sky.
    pub fn new(scene: &Scene, size: [u32; 2], samples: u32, background: Option<[f32; 3]>) -> Self {
        Self::with(scene, size, samples, background, AS_GIVEN)
    }

    /// Prepares pictures by any renderer or by rays.
    pub fn with(scene: &Scene, size: [u32; 2], samples: u32, background: Option<[f32; 3]>, dial: Dial) -> Self {
        let source = if dial.renderer == RendererName::Raytrace {
            let tracer = RayTracer::new(scene.clone(), background, false).expect("scenes of tests are whole");
            Source::Traced(Box::new(tracer))
        } else {
            let format = Studio::format(gpu());
            let renderer = SceneRenderer::new(gpu(), scene.clone(), format, background, dial, Occasion::Still)
                .expect("scenes of tests have a finite origin");
            Source::Drawn(Box::new(renderer))
        };
        Self { source, studio: Studio::new(gpu(), size, samples), size, samples }
    }

    /// Prepares pictures by any renderer, with the half floats of a window.
    pub fn of_window(scene: &Scene, size: [u32; 2], dial: Dial) -> Self {
        let format = Format::fast(1);
        let renderer = SceneRenderer::new(gpu(), scene.clone(), format, None, dial, Occasion::Ride)
            .expect("scenes of tests have a finite origin");
        let studio = Studio::with_format(gpu(), size, 1, format);
        Self { source: Source::Drawn(Box::new(renderer)), studio, size, samples: 1 }
    }

    /// Picture of an eye that moves, with the effect of geometry alone.
    pub fn moving(&mut self, view: &View, eye: DVec3, celerity: Celerity) -> RgbaImage {
        self.seen(view, eye, celerity, Effects::GEOMETRY)
    }

    /// Picture of the plain world, as if light were infinitely fast.
    pub fn plain(&mut self, view: &View, eye: DVec3) -> RgbaImage {
        self.seen(view, eye, Celerity::ZERO, Effects::NONE)
    }

    /// Picture of an eye that moves, with these effects.
    pub fn seen(&mut self, view: &View, eye: DVec3, celerity: Celerity, effects: Effects) -> RgbaImage {
        let shot = self.aim(view, eye, celerity, effects);
        // Channels are clipped one by one, like in `colour`.
        let development = Development { gamut: Gamut::Clamp, ..Default::default() };
        let taken = match &mut self.source {
            Source::Drawn(renderer) => {
                let pending = submit(renderer, &shot);
                self.studio.photograph(gpu(), renderer, &shot, pending, &development, None)
            }
            Source::Traced(tracer) => {
                let traced = trace(tracer, &shot, self.size, self.samples);
                self.studio.develop(gpu(), &traced.texels(), traced.stored, &development, None)
            }
        };
        taken.expect("the device is there")
    }

    /// Light that a moving eye sees: linear sRGB in cd/m².
    pub fn light(&mut self, view: &View, eye: DVec3, celerity: Celerity, effects: Effects) -> Rgb32FImage {
        let shot = self.aim(view, eye, celerity, effects);
        match &mut self.source {
            Source::Drawn(renderer) => {
                let pending = submit(renderer, &shot);
                self.studio.expose(gpu(), renderer, &shot, pending).expect("the device is there")
            }
            Source::Traced(tracer) => trace(tracer, &shot, self.size, self.samples).image(),
        }
    }

    /// Place in the scene that each pixel's centre shows to a moving eye, row by row.
    pub fn places(&mut self, view: &View, eye: DVec3, celerity: Celerity) -> Vec<Option<Shown>> {
        let shot = self.aim(view, eye, celerity, Effects::GEOMETRY);
        match &mut self.source {
            Source::Drawn(renderer) => {
                let pending = submit(renderer, &shot);
                self.studio.places(gpu(), renderer, &shot, pending).expect("the device is there")
            }
            Source::Traced(tracer) => {
                let shown = |place: Option<TracedPlace>| {
                    let TracedPlace { position, motion, apparent, .. } = place?;
                    Some(Shown { position, motion, apparent })
                };
                tracer.places(&shot, self.size).into_iter().map(shown).collect()
            }
        }
    }

    /// Shot of this photographer's size, at world time 0.
    fn aim(&self, view: &View, eye: DVec3, celerity: Celerity, effects: Effects) -> Shot {
        assert_eq!(view.size, self.size, "a studio takes pictures of one size");
        view.shot(&observer(eye, celerity), effects)
    }
}

/// Photo-surface for a shot, under way.
fn submit(renderer: &mut SceneRenderer, shot: &Shot) -> Pending {
    renderer.submit(gpu(), &shot.observer, shot.effects).expect("the device is there")
}

/// Light of a shot by rays.
fn trace(tracer: &RayTracer, shot: &Shot, size: [u32; 2], samples: u32) -> Traced {
    tracer.trace(shot, size, samples, &AtomicBool::new(false), || {})
}
