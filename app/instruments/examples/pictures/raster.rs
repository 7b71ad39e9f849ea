//! Software painter of egui's triangles, so that the pictures need no GPU.

use std::collections::HashMap;

use egui::epaint::{ClippedPrimitive, ImageData, Primitive, Vertex};
use egui::{Color32, ColorImage, TextureId, TexturesDelta};

/// Textures so far.
#[derive(Default)]
pub struct Raster {
    textures: HashMap<TextureId, ColorImage>,
}

impl Raster {
    /// Takes new and changed textures.
    pub fn update(&mut self, delta: &TexturesDelta) {
        for (id, changes) in &delta.set {
            for change in changes {
                let ImageData::Color(image) = &change.image;
                let Some([left, top]) = change.pos else {
                    self.textures.insert(*id, (**image).clone());
                    continue;
                };
                let whole = self.textures.get_mut(id).unwrap();
                for (row, pixels) in image.pixels.chunks(image.size[0]).enumerate() {
                    let from = (top + row) * whole.size[0] + left;
                    whole.pixels[from..from + pixels.len()].copy_from_slice(pixels);
                }
            }
        }
    }

    /// Paints over a ground of one colour; RGBA, rows from the top.
    pub fn paint(&self, primitives: &[ClippedPrimitive], scale: f32, [width, height]: [usize; 2]) -> Vec<u8> {
        let mut pixels = vec![[60.0_f32, 78.0, 96.0, 255.0]; width * height];
        for ClippedPrimitive { clip_rect, primitive } in primitives {
            let Primitive::Mesh(mesh) = primitive else { continue };
            let texture = &self.textures[&mesh.texture_id];
            let clip = [clip_rect.min.x, clip_rect.min.y, clip_rect.max.x, clip_rect.max.y].map(|edge| edge * scale);
            for corners in mesh.indices.chunks(3) {
                let [a, b, c] = [0, 1, 2].map(|index| mesh.vertices[corners[index] as usize]);
                triangle(&mut pixels, [width, height], clip, scale, [a, b, c], texture);
            }
        }
        pixels.iter().flat_map(|pixel| pixel.map(|value| value.round().clamp(0.0, 255.0) as u8)).collect()
    }
}

fn triangle(
    pixels: &mut [[f32; 4]],
    [width, height]: [usize; 2],
    clip: [f32; 4],
    scale: f32,
    corners: [Vertex; 3],
    texture: &ColorImage,
) {
    let [a, b, c] = corners.map(|corner| corner.pos * scale);
    let area = (b - a).x * (c - a).y - (b - a).y * (c - a).x;
    if area == 0.0 {
        return;
    }
    let range = |low: f32, high: f32, least: f32, most: f32, end: usize| {
        let from = (low.max(least) - 0.5).ceil().max(0.0) as usize;
        let to = ((high.min(most) - 0.5).ceil().max(0.0) as usize).min(end);
        from..to.max(from)
    };
    let across = range(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x), clip[0], clip[2], width);
    for row in range(a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y), clip[1], clip[3], height) {
        for column in across.clone() {
            // A little beside the middle of the pixel, so that no edge goes through it.
            let p = egui::pos2(column as f32 + 0.5 + 3e-4, row as f32 + 0.5 + 7e-4);
            let weight = |q: egui::Pos2, r: egui::Pos2| ((r - q).x * (p - q).y - (r - q).y * (p - q).x) / area;
            let (of_a, of_b, of_c) = (weight(b, c), weight(c, a), weight(a, b));
            if !(of_a > 0.0 && of_b > 0.0 && of_c > 0.0) {
                continue;
            }
            let mix = |value: fn(&Vertex) -> f32| {
                of_a * value(&corners[0]) + of_b * value(&corners[1]) + of_c * value(&corners[2])
            };
            let texel = sampled(texture, mix(|v| v.uv.x), mix(|v| v.uv.y));
            let tint = [
                mix(|v| v.color.r().into()),
                mix(|v| v.color.g().into()),
                mix(|v| v.color.b().into()),
                mix(|v| v.color.a().into()),
            ];
            let source: [f32; 4] = std::array::from_fn(|index| texel[index] * tint[index] / 255.0);
            let pixel = &mut pixels[row * width + column];
            for (under, over) in pixel.iter_mut().zip(source) {
                *under = over + *under * (1.0 - source[3] / 255.0);
            }
        }
    }
}

fn sampled(texture: &ColorImage, u: f32, v: f32) -> [f32; 4] {
    let [width, height] = texture.size;
    let (x, y) = ((u * width as f32 - 0.5).max(0.0), (v * height as f32 - 0.5).max(0.0));
    let (left, top) = (x as usize, y as usize);
    let texel = |right: usize, down: usize| -> Color32 {
        texture.pixels[(top + down).min(height - 1) * width + (left + right).min(width - 1)]
    };
    let (fx, fy) = (x.fract(), y.fract());
    std::array::from_fn(|index| {
        let value = |right, down| f32::from(texel(right, down).to_array()[index]);
        let upper = value(0, 0) * (1.0 - fx) + value(1, 0) * fx;
        let lower = value(0, 1) * (1.0 - fx) + value(1, 1) * fx;
        upper * (1.0 - fy) + lower * fy
    })
}
