//! Interface drawn by egui over the picture: input goes in, shapes come out and are drawn in a last pass.

use interface::Painter;
use render::Gpu;
use winit::event::WindowEvent;
use winit::window::Window;

/// State of egui for one window.
pub struct SurfaceInterface {
    context: egui::Context,
    state: egui_winit::State,
    painter: Painter,
}

impl SurfaceInterface {
    /// Creates the interface of a window whose surface has `format`.
    pub fn new(gpu: &Gpu, window: &Window, format: wgpu::TextureFormat) -> Self {
        let context = interface::layouts();
        let side = gpu.device.limits().max_texture_dimension_2d as usize;
        let state = egui_winit::State::new(
            context.clone(),
            egui::ViewportId::ROOT,
            window,
            Some(window.scale_factor() as f32),
            None,
            Some(side),
        );
        Self { context, state, painter: Painter::new(gpu, format) }
    }

    /// Offers an event to the panels first. Returns true if one of them took it.
    pub fn event(&mut self, window: &Window, event: &WindowEvent) -> bool {
        self.state.on_window_event(window, event).consumed
    }

    /// Presses and releases keys for the panels.
    pub fn press(&mut self, keys: impl IntoIterator<Item = egui::Key>) {
        self.state.egui_input_mut().events.extend(keys.into_iter().flat_map(interface::key_events));
    }

    /// Makes a texture known, so that it can be shown.
    pub fn register(&mut self, gpu: &Gpu, view: &wgpu::TextureView) -> egui::TextureId {
        self.painter.register(gpu, view)
    }

    /// Forgets a texture that was made known.
    pub fn forget(&mut self, texture: egui::TextureId) {
        self.painter.forget(texture);
    }

    /// Lays out and draws `contents` over the picture in `target`. `size` is the target's size in pixels, which may
    /// still be the window's previous one.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        window: &Window,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        size: [u32; 2],
        contents: impl FnMut(&mut egui::Ui),
    ) {
        let input = self.state.take_egui_input(window);
        let output = self.context.run_ui(input, contents);
        self.state.handle_platform_output(window, output.platform_output);
        let shapes = self.context.tessellate(output.shapes, output.pixels_per_point);
        self.painter.take_textures(gpu, &output.textures_delta);
        let mut pass = render::display::over(encoder, target);
        self.painter.paint(gpu, &mut pass, &shapes, (size, output.pixels_per_point));
        drop(pass);
        self.painter.forget_textures(&output.textures_delta);
    }
}
