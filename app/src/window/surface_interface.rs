//! Interface drawn by egui over the picture: input goes in, shapes come out and are drawn in a last pass.

use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};
use render::Gpu;
use winit::event::WindowEvent;
use winit::window::Window;

/// State of egui for one window.
pub struct SurfaceInterface {
    context: egui::Context,
    state: egui_winit::State,
    renderer: Renderer,
}

impl SurfaceInterface {
    /// Creates the interface of a window whose surface has `format`.
    pub fn new(gpu: &Gpu, window: &Window, format: wgpu::TextureFormat) -> Self {
        let context = egui::Context::default();
        context.set_theme(egui::Theme::Dark);
        let side = gpu.device.limits().max_texture_dimension_2d as usize;
        let state = egui_winit::State::new(
            context.clone(),
            egui::ViewportId::ROOT,
            window,
            Some(window.scale_factor() as f32),
            None,
            Some(side),
        );
        let renderer = Renderer::new(&gpu.device, format, RendererOptions::default());
        Self { context, state, renderer }
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
        self.renderer.register_native_texture(&gpu.device, view, wgpu::FilterMode::Linear)
    }

    /// Forgets a texture that was made known.
    pub fn forget(&mut self, texture: egui::TextureId) {
        self.renderer.free_texture(&texture);
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
        let mut output = self.context.run_ui(input, contents);
        self.state.handle_platform_output(window, output.platform_output);
        let shapes = self.context.tessellate(output.shapes, output.pixels_per_point);
        let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point: output.pixels_per_point };

        for (id, deltas) in &output.textures_delta.set {
            for delta in deltas {
                self.renderer.update_texture(&gpu.device, &gpu.queue, *id, delta);
            }
        }
        let uploads = self.renderer.update_buffers(&gpu.device, &gpu.queue, encoder, &shapes, &screen);
        gpu.queue.submit(uploads);
        {
            let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("interface"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
                })],
                ..Default::default()
            });
            self.renderer.render(&mut pass.forget_lifetime(), &shapes, &screen);
        }
        for id in &output.textures_delta.free {
            self.renderer.free_texture(id);
        }
        output.textures_delta.clear();
    }
}
