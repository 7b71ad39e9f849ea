//! Pictures made by the program: a scene, a device, and a studio of one size.

use glam::DVec3;
use image::{Rgb32FImage, RgbaImage};
use physics::Celerity;
use physics::photo_surface::Eye;
use rapidity::gpu::{Gpu, GpuError};
use rapidity::renderers::display::{Development, Gamut};
use rapidity::renderers::image::MapQuality;
use rapidity::renderers::picture::{Shown, Studio};
use rapidity::renderers::raytrace::{Place, RayTracer};
use rapidity::renderers::target::Format;
use rapidity::renderers::{Effects, Method, SceneRenderer, Shot};
use rapidity::scene::Scene;
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

use crate::view::View;

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

/// Way in which pictures are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum By {
    /// Drawn by a renderer.
    Method(Method),
    /// Traced ray by ray.
    Rays,
}

enum Way {
    Drawn(Box<SceneRenderer>),
    Traced(Box<RayTracer>),
}

/// Photographer of one scene, with one method.
pub struct Photographer {
    way: Way,
    studio: Studio,
    size: [u32; 2],
    samples: u32,
}

impl Photographer {
    /// Prepares pictures by the `polygon` renderer, of `size` pixels with `samples` each. `background` is a linear
    /// radiance that replaces the scene's sky.
    pub fn new(scene: &Scene, size: [u32; 2], samples: u32, background: Option<[f32; 3]>) -> Self {
        Self::with(scene, size, samples, background, Method::Polygon)
    }

    /// Prepares pictures by any renderer.
    pub fn with(scene: &Scene, size: [u32; 2], samples: u32, background: Option<[f32; 3]>, method: Method) -> Self {
        let renderer = SceneRenderer::new(gpu(), scene, Studio::format(gpu()), background, method)
            .expect("scenes of tests have a finite origin");
        Self { way: Way::Drawn(Box::new(renderer)), studio: Studio::new(gpu(), size, samples), size, samples }
    }

    /// Prepares pictures by any renderer or by rays.
    pub fn by(scene: &Scene, size: [u32; 2], samples: u32, background: Option<[f32; 3]>, by: By) -> Self {
        match by {
            By::Method(method) => Self::with(scene, size, samples, background, method),
            By::Rays => {
                let tracer = RayTracer::new(scene.clone(), background, false).expect("scenes of tests are whole");
                Self { way: Way::Traced(Box::new(tracer)), studio: Studio::new(gpu(), size, samples), size, samples }
            }
        }
    }

    /// Picture of an eye that moves, with the effect of geometry alone.
    pub fn moving(&mut self, view: &View, eye: DVec3, celerity: Celerity) -> RgbaImage {
        self.seen(view, eye, celerity, Effects::GEOMETRY)
    }

    /// Picture of the plain world, as if light were infinitely fast.
    pub fn plain(&mut self, view: &View, eye: DVec3) -> RgbaImage {
        self.seen(view, eye, Celerity::ZERO, Effects::NONE)
    }

    /// Photographer with the half floats of a window.
    pub fn of_window(scene: &Scene, size: [u32; 2], method: Method) -> Self {
        let format = Format::fast(1);
        let renderer =
            SceneRenderer::new(gpu(), scene, format, None, method).expect("scenes of tests have a finite origin");
        let studio = Studio::with_format(gpu(), size, 1, format);
        Self { way: Way::Drawn(Box::new(renderer)), studio, size, samples: 1 }
    }

    /// Picture of an eye that moves, with these effects.
    pub fn seen(&mut self, view: &View, eye: DVec3, celerity: Celerity, effects: Effects) -> RgbaImage {
        let shot = self.aim(view, eye, celerity, effects);
        // Channels are clipped one by one, like in `colour`.
        let development = Development { gamut: Gamut::Clamp, ..Default::default() };
        let taken = match &mut self.way {
            Way::Drawn(renderer) => self.studio.photograph(gpu(), renderer, &shot, &development, None),
            Way::Traced(tracer) => {
                let traced = tracer.trace(&shot, self.size, self.samples, &AtomicBool::new(false), || {});
                self.studio.develop(gpu(), &traced.texels(), traced.stored, &development, None)
            }
        };
        taken.expect("the device is there")
    }

    /// Light that a moving eye sees: linear sRGB in cd/m².
    pub fn light(&mut self, view: &View, eye: DVec3, celerity: Celerity, effects: Effects) -> Rgb32FImage {
        let shot = self.aim(view, eye, celerity, effects);
        match &mut self.way {
            Way::Drawn(renderer) => self.studio.expose(gpu(), renderer, &shot).expect("the device is there"),
            Way::Traced(tracer) => tracer.trace(&shot, self.size, self.samples, &AtomicBool::new(false), || {}).image(),
        }
    }

    /// Place in the scene that each pixel's centre shows to a moving eye, row by row.
    pub fn places(&mut self, view: &View, eye: DVec3, celerity: Celerity) -> Vec<Option<Shown>> {
        let shot = self.aim(view, eye, celerity, Effects::GEOMETRY);
        match &mut self.way {
            Way::Drawn(renderer) => self.studio.places(gpu(), renderer, &shot).expect("the device is there"),
            Way::Traced(tracer) => {
                let shown = |place: Option<Place>| {
                    let Place { position, motion, apparent, .. } = place?;
                    Some(Shown { position, motion, apparent })
                };
                tracer.places(&shot, self.size).into_iter().map(shown).collect()
            }
        }
    }

    fn aim(&mut self, view: &View, eye: DVec3, celerity: Celerity, effects: Effects) -> Shot {
        assert_eq!(view.size, self.size, "a studio takes pictures of one size");
        let eye = Eye::new(eye, celerity.vector()).expect("eyes of tests are somewhere");
        if let Way::Drawn(renderer) = &mut self.way
            && renderer.transforms(effects)
        {
            renderer.submit(gpu(), eye, 0.0).expect("the device is there");
        }
        Shot { camera: view.camera(), eye, ct: 0.0, effects, stored_scale: None }
    }
}

/// Map of the image renderer in its quality for pictures with one sample a pixel.
pub const DEFAULT_MAP: Method = Method::Image(MapQuality { texels_per_pixel: 8.0, smooth: false });
