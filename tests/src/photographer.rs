//! Pictures by the program: a scene, a device, and a studio of one size.

use glam::DVec3;
use image::RgbaImage;
use physics::Celerity;
use physics::photo_surface::Eye;
use rapidity::gpu::{Gpu, GpuError};
use rapidity::renderers::display::Development;
use rapidity::renderers::picture::{Shot, Studio};
use rapidity::renderers::polygon::{PolygonRenderer, Positions};
use rapidity::scene::Scene;
use std::sync::LazyLock;

use crate::view::View;

/// The device that all tests of a process draw on.
///
/// # Panics
/// Without a Vulkan driver, with a sentence that says which package to install: a test that cannot draw has failed.
pub fn gpu() -> &'static Gpu {
    // Not the panic itself, which would reach the first test alone.
    static GPU: LazyLock<Result<Gpu, GpuError>> = LazyLock::new(Gpu::new);
    #[expect(clippy::panic, reason = "a test without a driver fails, and says what to install")]
    GPU.as_ref().unwrap_or_else(|error| panic!("{error}"))
}

/// Draws one scene with the `polygon` renderer.
pub struct Photographer {
    renderer: PolygonRenderer,
    studio: Studio,
    size: [u32; 2],
}

impl Photographer {
    /// Prepares pictures of `size` pixels with `samples` each. `background`: linear radiance instead of the scene's sky.
    pub fn new(scene: &Scene, size: [u32; 2], samples: u32, background: Option<[f32; 3]>) -> Self {
        let renderer = PolygonRenderer::new(gpu(), scene, Studio::format(gpu()), background)
            .expect("scenes of tests have a finite origin");
        Self { renderer, studio: Studio::new(gpu(), size, samples), size }
    }

    /// What an eye that moves sees.
    pub fn moving(&mut self, view: &View, eye: DVec3, celerity: Celerity) -> RgbaImage {
        let event = Eye::new(eye, celerity.vector()).expect("eyes of tests are somewhere");
        self.renderer.submit(gpu(), event).expect("the device is there");
        self.shoot(view, Shot { camera: view.camera(), positions: Positions::Apparent, eye, motion: celerity })
    }

    /// The plain world, as if light were infinitely fast.
    pub fn plain(&mut self, view: &View, eye: DVec3) -> RgbaImage {
        let positions = Positions::Plain(eye);
        self.shoot(view, Shot { camera: view.camera(), positions, eye, motion: Celerity::ZERO })
    }

    fn shoot(&mut self, view: &View, shot: Shot) -> RgbaImage {
        assert_eq!(view.size, self.size, "a studio takes pictures of one size");
        let development = Development::default();
        self.studio.photograph(gpu(), &mut self.renderer, &shot, &development, None).expect("the device is there")
    }
}
