//! Painter of an interface: egui's triangles into a picture.
//!
//! Every pixel costs one look at a texture. Painters that can also filter by themselves ask a uniform whether to, and
//! drivers that draw on the processor do both for each pixel.

use egui::epaint::{ClippedPrimitive, ImageData, ImageDelta, Primitive, Vertex};
use egui::{Rect, Shadow, TextureFilter, TextureId, TextureWrapMode, TexturesDelta};
use render::Gpu;
use render::display::{FILTERED, UNIFORM, encodes, group, layout, module, pipeline_layout};
use render::target::texture;
use std::collections::HashMap;

/// Format of egui's own textures: sRGB as it is stored, times its opacity.
const OWN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Painter of interfaces into pictures of one format.
pub struct Painter {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    view: wgpu::Buffer,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    textures: HashMap<TextureId, Painted>,
    /// Number of textures that were registered.
    registered: u64,
}

/// Texture with its binding.
struct Painted {
    view: wgpu::TextureView,
    group: wgpu::BindGroup,
}

impl Painter {
    /// Painter into pictures of `format`, which holds sRGB.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat) -> Self {
        let shader = &shaders::INTERFACE;
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let stages = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let layout = layout(gpu, shader.name, stages, &[UNIFORM, FILTERED, sampler]);
        let module = module(gpu, shader);
        let constants = [("ENCODE", f64::from(u8::from(encodes(format))))];
        let attributes = wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Unorm8x4];
        let blend = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(shader.name),
            layout: Some(&pipeline_layout(gpu, &layout)),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: size_of::<Vertex>() as u64,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &attributes,
                })],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
                targets: &[Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL })],
            }),
            multiview_mask: None,
            cache: None,
        });
        let view = buffer(gpu, wgpu::BufferUsages::UNIFORM, size_of::<shaders::InterfaceUniforms>() as u64);
        let vertices = buffer(gpu, wgpu::BufferUsages::VERTEX, 1 << 16);
        let indices = buffer(gpu, wgpu::BufferUsages::INDEX, 1 << 16);
        Self { layout, pipeline, view, vertices, indices, textures: HashMap::new(), registered: 0 }
    }

    /// Makes a texture known, so that an interface can show it.
    pub fn register(&mut self, gpu: &Gpu, view: &wgpu::TextureView) -> TextureId {
        let id = TextureId::User(self.registered);
        self.registered += 1;
        self.know(gpu, id, view.clone(), egui::TextureOptions::LINEAR);
        id
    }

    /// Forgets a texture that was registered.
    pub fn forget(&mut self, id: TextureId) {
        self.textures.remove(&id);
    }

    /// Takes the new and changed textures of a layout, before it is painted.
    pub fn take_textures(&mut self, gpu: &Gpu, delta: &TexturesDelta) {
        for (id, deltas) in &delta.set {
            for delta in deltas {
                self.change(gpu, *id, delta);
            }
        }
    }

    /// Forgets the textures that a layout was the last to need, after it was painted.
    pub fn forget_textures(&mut self, delta: &TexturesDelta) {
        for id in &delta.free {
            self.textures.remove(id);
        }
    }

    /// Paints shapes into a pass of this painter's format. `size`: that of the picture, pixels. The pass must be
    /// submitted before the painter paints again.
    pub fn paint(
        &mut self,
        gpu: &Gpu,
        pass: &mut wgpu::RenderPass<'_>,
        shapes: &[ClippedPrimitive],
        (size, pixels_per_point): ([u32; 2], f32),
    ) {
        // Lay the meshes one behind the other.
        let meshes = shapes.iter().filter_map(|ClippedPrimitive { clip_rect, primitive }| match primitive {
            Primitive::Mesh(mesh) => Some((within(*clip_rect, size, pixels_per_point)?, mesh)),
            Primitive::Callback(_) => None,
        });
        let (mut vertices, mut indices, mut draws) = (Vec::new(), Vec::new(), Vec::new());
        for (clip, mesh) in meshes {
            let first = indices.len() as u32;
            indices.extend_from_slice(&mesh.indices);
            draws.push((clip, mesh.texture_id, first..indices.len() as u32, vertices.len() as i32));
            vertices.extend_from_slice(&mesh.vertices);
        }
        if indices.is_empty() {
            return;
        }
        let view = shaders::InterfaceUniforms { size: size.map(|side| side as f32 / pixels_per_point).into() };
        gpu.queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&view));
        fill(gpu, &mut self.vertices, wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&vertices));
        fill(gpu, &mut self.indices, wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&indices));

        // Paint each within its rectangle.
        pass.set_pipeline(&self.pipeline);
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        for ([x, y, width, height], id, range, base) in draws {
            let Some(texture) = self.textures.get(&id) else { continue };
            pass.set_scissor_rect(x, y, width, height);
            pass.set_bind_group(0, &texture.group, &[]);
            pass.draw_indexed(range, base, 0..1);
        }
    }

    /// Changes a texture of egui, or makes it.
    fn change(&mut self, gpu: &Gpu, id: TextureId, delta: &ImageDelta) {
        let ImageData::Color(image) = &delta.image;
        let size = image.size.map(|side| side as u32);
        if delta.pos.is_none() {
            let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
            let view = texture(gpu, "interface", size, OWN_FORMAT, 1, usage);
            self.know(gpu, id, view, delta.options);
        }
        let Some(painted) = self.textures.get(&id) else { return };
        let [x, y] = delta.pos.unwrap_or_default().map(|place| place as u32);
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                texture: painted.view.texture(),
                mip_level: 0,
                origin: wgpu::Origin3d { x, y, z: 0 },
                aspect: wgpu::TextureAspect::All,
            },
            bytemuck::cast_slice(&image.pixels),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * size[0]), rows_per_image: None },
            wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        );
    }

    fn know(&mut self, gpu: &Gpu, id: TextureId, view: wgpu::TextureView, options: egui::TextureOptions) {
        let filter = |filter| match filter {
            TextureFilter::Nearest => wgpu::FilterMode::Nearest,
            TextureFilter::Linear => wgpu::FilterMode::Linear,
        };
        let address_mode = match options.wrap_mode {
            TextureWrapMode::ClampToEdge => wgpu::AddressMode::ClampToEdge,
            TextureWrapMode::Repeat => wgpu::AddressMode::Repeat,
            TextureWrapMode::MirroredRepeat => wgpu::AddressMode::MirrorRepeat,
        };
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("interface"),
            mag_filter: filter(options.magnification),
            min_filter: filter(options.minification),
            address_mode_u: address_mode,
            address_mode_v: address_mode,
            ..Default::default()
        });
        let resources = [
            self.view.as_entire_binding(),
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&sampler),
        ];
        let group = group(gpu, shaders::INTERFACE.name, &self.layout, &resources);
        self.textures.insert(id, Painted { view, group });
    }
}

/// Layouts of an interface: dark, without shadows, which would be drawn under whatever they hide. However long a
/// button is held before it is released, it is pressed.
pub fn layouts() -> egui::Context {
    let context = egui::Context::default();
    context.set_theme(egui::Theme::Dark);
    context.options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
    context.all_styles_mut(|style| {
        style.visuals.window_shadow = Shadow::NONE;
        style.visuals.popup_shadow = Shadow::NONE;
    });
    context
}

/// Rectangle of pixels of a clip rectangle in points, within a picture of `size` pixels: x, y, width and height;
/// `None` if it holds none.
fn within(clip: Rect, size: [u32; 2], pixels_per_point: f32) -> Option<[u32; 4]> {
    let pixel = |at: f32, side: u32| (pixels_per_point * at).round().clamp(0.0, side as f32) as u32;
    let [width, height] = size;
    let (left, top) = (pixel(clip.min.x, width), pixel(clip.min.y, height));
    let (right, bottom) = (pixel(clip.max.x, width), pixel(clip.max.y, height));
    (right > left && bottom > top).then_some([left, top, right - left, bottom - top])
}

/// Fills a buffer, after making it larger where it is too small.
fn fill(gpu: &Gpu, target: &mut wgpu::Buffer, usage: wgpu::BufferUsages, bytes: &[u8]) {
    let size = bytes.len() as u64;
    if size > target.size() {
        *target = buffer(gpu, usage, size.next_power_of_two());
    }
    gpu.queue.write_buffer(target, 0, bytes);
}

fn buffer(gpu: &Gpu, usage: wgpu::BufferUsages, size: u64) -> wgpu::Buffer {
    let usage = usage | wgpu::BufferUsages::COPY_DST;
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("interface"),
        size,
        usage,
        mapped_at_creation: false,
    })
}

#[cfg(test)]
mod tests {
    //! Laws: a rectangle fills the pixels that it covers with its colour, within its clip rectangle; a texture is shown
    //! texel by texel where it has the size of its pixels; what is half opaque lets half of what was there through; a
    //! target that encodes by itself stores the same values.

    use super::*;
    use egui::epaint::Mesh;
    use egui::{Color32, ColorImage, Pos2, Vec2};
    use studio::Sheet;

    const SIZE: [u32; 2] = [16, 8];
    const PIXELS_PER_POINT: f32 = 2.0;
    const FOUND: [u8; 4] = [200, 100, 40, 255];

    /// Picture after a painter painted meshes over [`FOUND`], four bytes a pixel.
    fn painted(
        gpu: &Gpu,
        format: wgpu::TextureFormat,
        texture: Option<&ColorImage>,
        shapes: &[ClippedPrimitive],
    ) -> Vec<u8> {
        let mut painter = Painter::new(gpu, format);
        let white = ColorImage::filled([1, 1], Color32::WHITE);
        let image = texture.unwrap_or(&white).clone();
        let mut delta = TexturesDelta::default();
        delta.push(TextureId::default(), ImageDelta::full(image, egui::TextureOptions::LINEAR));
        painter.take_textures(gpu, &delta);
        let all = FOUND.repeat((SIZE[0] * SIZE[1]) as usize);
        let usage =
            wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::COPY_DST;
        let target = render::target::texture(gpu, "target", SIZE, format, 1, usage);
        gpu.queue.write_texture(
            target.texture().as_image_copy(),
            &all,
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * SIZE[0]), rows_per_image: None },
            target.texture().size(),
        );
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = render::display::over(&mut encoder, &target);
        painter.paint(gpu, &mut pass, shapes, (SIZE, PIXELS_PER_POINT));
        drop(pass);
        Sheet::new(gpu, SIZE, format).fetch_from(gpu, encoder, target.texture(), 0).unwrap()
    }

    /// Rectangle of one colour over the whole of a texture.
    fn rectangle(rect: Rect, clip_rect: Rect, colour: Color32) -> ClippedPrimitive {
        let mut mesh = Mesh::default();
        mesh.add_rect_with_uv(rect, Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0)), colour);
        ClippedPrimitive { clip_rect, primitive: Primitive::Mesh(mesh) }
    }

    #[test]
    fn a_rectangle_fills_its_pixels_within_its_clip_rectangle() {
        let gpu = Gpu::new().unwrap();
        let rect = Rect::from_min_max(Pos2::new(1.0, 1.0), Pos2::new(6.0, 3.0));
        let clip = Rect::from_min_max(Pos2::new(2.0, -5.0), Pos2::new(90.0, 90.0));
        let half = Color32::from_rgba_premultiplied(10, 60, 30, 128);
        let over = |under: u8, over: u8| f64::from(over) + f64::from(under) * (1.0 - 128.0 / 255.0);
        for (colour, expected) in [
            (Color32::from_rgb(10, 60, 130), [10.0, 60.0, 130.0]),
            (half, [over(200, 10), over(100, 60), over(40, 30)]),
        ] {
            let bytes = painted(&gpu, wgpu::TextureFormat::Rgba8Unorm, None, &[rectangle(rect, clip, colour)]);
            for (number, pixel) in bytes.chunks_exact(4).enumerate() {
                let (x, y) = (number % SIZE[0] as usize, number / SIZE[0] as usize);
                let filled = (4..12).contains(&x) && (2..6).contains(&y);
                let expected = if filled { expected } else { [200.0, 100.0, 40.0] };
                let near = pixel.iter().zip(expected).all(|(one, other)| (f64::from(*one) - other).abs() <= 1.0);
                assert!(near, "{x}, {y}: {pixel:?} instead of {expected:?}");
            }
        }
        // A target that encodes by itself stores the same.
        let opaque = [rectangle(rect, clip, Color32::from_rgb(10, 60, 130))];
        let plain = painted(&gpu, wgpu::TextureFormat::Rgba8Unorm, None, &opaque);
        let encoding = painted(&gpu, wgpu::TextureFormat::Rgba8UnormSrgb, None, &opaque);
        assert!(plain.iter().zip(&encoding).all(|(one, other)| one.abs_diff(*other) <= 1));
    }

    #[test]
    fn a_texture_of_the_size_of_its_pixels_is_shown_texel_by_texel() {
        let gpu = Gpu::new().unwrap();
        let texels: Vec<Color32> =
            (0..32u8).map(|number| Color32::from_rgb(8 * number, 255 - 5 * number, 77)).collect();
        let image = ColorImage::new([8, 4], texels.clone());
        let rect = Rect::from_min_size(Pos2::new(2.0, 1.0), Vec2::new(4.0, 2.0));
        let shapes = [rectangle(rect, Rect::EVERYTHING, Color32::WHITE)];
        let bytes = painted(&gpu, wgpu::TextureFormat::Rgba8Unorm, Some(&image), &shapes);
        for (number, texel) in texels.iter().enumerate() {
            let (x, y) = (4 + number % 8, 2 + number / 8);
            let at = 4 * (y * SIZE[0] as usize + x);
            let near = bytes[at..at + 4].iter().zip(texel.to_array()).all(|(one, other)| one.abs_diff(other) <= 1);
            assert!(near, "{x}, {y}: {:?} instead of {texel:?}", &bytes[at..at + 4]);
        }
    }
}
