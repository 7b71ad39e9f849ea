//! Sheets in the vehicle: an egui interface of its own, drawn into a texture.

use crate::painter::{Painter, layouts};
use egui::{Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Ui, Vec2};
use render::Gpu;
use render::target::texture;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Format of a sheet's picture: sRGB, times its opacity.
pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Pointer on a sheet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SheetPointer {
    /// Place on the sheet, 0 to 1, from its upper left corner to the right and down; `None` beside it.
    pub place: Option<[f64; 2]>,
    /// True while its button is held.
    pub pressed: bool,
}

/// Interface on a sheet: its contents, and the texture that they are drawn into.
pub struct DrawnSheet {
    context: egui::Context,
    painter: Painter,
    picture: wgpu::TextureView,
    /// Size of the sheet, points.
    size: Vec2,
    pixels_per_point: f32,
    before: SheetPointer,
    /// Last place of the pointer on the sheet.
    last_place: [f64; 2],
    /// Hash of what is drawn at present.
    drawn: Option<u64>,
}

impl DrawnSheet {
    /// Sheet of `size` points, with so many pixels for each point along each axis.
    pub fn new(gpu: &Gpu, size: [f32; 2], pixels_per_point: f32) -> Self {
        let pixels = size.map(|points| (points * pixels_per_point).round() as u32);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC;
        Self {
            context: layouts(),
            painter: Painter::new(gpu, FORMAT),
            picture: texture(gpu, "sheet", pixels, FORMAT, 1, usage),
            size: size.into(),
            pixels_per_point,
            before: SheetPointer::default(),
            last_place: [0.0; 2],
            drawn: None,
        }
    }

    /// Picture of the sheet.
    pub fn picture(&self) -> &wgpu::TextureView {
        &self.picture
    }

    /// Height over width.
    pub fn aspect(&self) -> f64 {
        f64::from(self.size.y / self.size.x)
    }

    /// Middles of the controls in the newest layout, 0 to 1, from the upper left corner to the right and down.
    pub fn controls(&self) -> Vec<[f64; 2]> {
        self.context.viewport(|viewport| {
            let all = viewport.prev_pass.widgets.layers().flat_map(|(_, widgets)| widgets);
            let active = all.filter(|widget| widget.enabled && widget.sense.interactive());
            let place = |at: Pos2| [f64::from(at.x / self.size.x), f64::from(at.y / self.size.y)];
            active.map(|widget| place(widget.interact_rect.center())).collect()
        })
    }

    /// Lays out `contents` at the time `now_s`, seconds, and draws them unless they are drawn already. `keys`: keys
    /// that were pressed since.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        now_s: f64,
        (pointer, keys): (SheetPointer, &[egui::Key]),
        contents: impl FnMut(&mut Ui),
    ) {
        let screen = Rect::from_min_size(Pos2::ZERO, self.size);
        let mut input = RawInput {
            screen_rect: Some(screen),
            time: Some(now_s),
            focused: true,
            events: self.events(pointer).into_iter().chain(keys.iter().flat_map(|key| key_events(*key))).collect(),
            ..Default::default()
        };
        if let Some(viewport) = input.viewports.get_mut(&egui::ViewportId::ROOT) {
            viewport.native_pixels_per_point = Some(self.pixels_per_point);
        }
        let output = self.context.run_ui(input, contents);
        let shapes = self.context.tessellate(output.shapes, output.pixels_per_point);
        let now = fingerprint(&shapes);
        let changes = self.drawn != Some(now) || !output.textures_delta.set.is_empty();
        self.painter.take_textures(gpu, &output.textures_delta);
        if changes {
            self.drawn = Some(now);
            let texture = self.picture.texture();
            let size = [texture.width(), texture.height()];
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = render::display::clear(&mut encoder, &self.picture);
            self.painter.paint(gpu, &mut pass, &shapes, (size, output.pixels_per_point));
            drop(pass);
            gpu.queue.submit([encoder.finish()]);
        }
        self.painter.forget_textures(&output.textures_delta);
    }

    /// Events of the pointer since the last layout.
    fn events(&mut self, pointer: SheetPointer) -> Vec<Event> {
        let before = std::mem::replace(&mut self.before, pointer);
        let at = |[x, y]: [f64; 2]| Pos2::new(x as f32 * self.size.x, y as f32 * self.size.y);
        let mut events = Vec::new();
        match (pointer.place, before.place) {
            (Some(place), _) => events.push(Event::PointerMoved(at(place))),
            (None, Some(_)) => events.push(Event::PointerGone),
            (None, None) => {}
        }
        self.last_place = pointer.place.unwrap_or(self.last_place);
        // What is released beside the sheet is released on it, too.
        if pointer.pressed != before.pressed && (pointer.place.is_some() || !pointer.pressed) {
            let (pos, pressed) = (at(self.last_place), pointer.pressed);
            let (button, modifiers) = (PointerButton::Primary, Modifiers::default());
            events.push(Event::PointerButton { pos, button, pressed, modifiers });
        }
        events
    }
}

/// Events of a key that is pressed and released.
pub fn key_events(key: egui::Key) -> [Event; 2] {
    let modifiers = Modifiers::default();
    [true, false].map(|pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers })
}

/// Hash of the shapes that are drawn.
fn fingerprint(shapes: &[egui::ClippedPrimitive]) -> u64 {
    let mut hasher = DefaultHasher::new();
    for egui::ClippedPrimitive { clip_rect, primitive } in shapes {
        let edges = [clip_rect.min.x, clip_rect.min.y, clip_rect.max.x, clip_rect.max.y];
        edges.map(f32::to_bits).hash(&mut hasher);
        if let egui::epaint::Primitive::Mesh(mesh) = primitive {
            mesh.indices.hash(&mut hasher);
            for vertex in &mesh.vertices {
                let place = [vertex.pos.x, vertex.pos.y, vertex.uv.x, vertex.uv.y].map(f32::to_bits);
                (place, vertex.color.to_array()).hash(&mut hasher);
            }
        }
    }
    hasher.finish()
}

#[cfg(test)]
mod tests {
    //! Law: a button on a sheet is pressed once it is released, however long it was held before.

    use super::*;

    #[test]
    fn a_button_is_pressed_however_long_it_is_held() {
        let gpu = Gpu::new().unwrap();
        for held_s in [0.1, 30.0] {
            let mut sheet = DrawnSheet::new(&gpu, [200.0, 100.0], 1.0);
            let mut presses = 0;
            let mut show = |sheet: &mut DrawnSheet, now_s: f64, pointer: SheetPointer| {
                sheet.draw(&gpu, now_s, (pointer, &[]), |ui| presses += u32::from(ui.button("go").clicked()));
            };
            show(&mut sheet, 0.0, SheetPointer::default());
            let place = sheet.controls().first().copied();
            assert!(place.is_some(), "the button has no place");
            for (now_s, pressed) in [(0.1, false), (0.2, true), (0.2 + held_s, true), (0.3 + held_s, false)] {
                show(&mut sheet, now_s, SheetPointer { place, pressed });
            }
            assert_eq!(presses, 1, "held for {held_s} s");
        }
    }
}
