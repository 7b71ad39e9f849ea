//! Pictures of leaves, flowers, grass, water and fruit.

use glam::{Vec2, Vec3, Vec4, ivec2, vec2, vec3};

use crate::town::canvas::{PaintCanvas, chance, cloud, noise, smoothstep};
use crate::turn::circle;

/// Topmost of many scattered things at a point: `layers` sheets of them, each on a jittered lattice of `cells` per
/// unit.
///
/// The closure `outline` gives the signed distance in units of the thing's own size, for a place in −1…1 turned with
/// the thing.
fn scatter(p: Vec2, cells: f32, layers: u32, seed: u32, outline: impl Fn(Vec2) -> f32) -> Option<(f32, Vec2, f32)> {
    for layer in (0..layers).rev() {
        let q = p * cells + 0.37 * layer as f32;
        let home = q.floor().as_ivec2();
        for dy in -1..=1 {
            for dx in -1..=1 {
                let at = home + ivec2(dx, dy);
                let own = |k: u32| chance(at.x, at.y, seed + 13 * layer + k);
                let offset = q - at.as_vec2() - vec2(own(1), own(2));
                let turn = circle(own(3));
                let place = vec2(offset.dot(turn), offset.perp_dot(turn)) / (0.55 + 0.25 * own(4));
                let d = outline(place);
                if d < 0.0 {
                    return Some((own(5), place, (layer as f32 + 1.0) / layers as f32));
                }
            }
        }
    }
    None
}

/// Signed distance from the outline of a leaf: two arcs that meet at its ends.
fn leaf(p: Vec2) -> f32 {
    p.y.abs() - 0.42 * (1.0 - p.x * p.x)
}

/// Paints a spray of foliage in a unit square, transparent between the leaves.
pub(in crate::town) fn leaves(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::with_opacity(pixels, size, |at| {
        let p = at / size;
        let ragged = 0.40 + 0.16 * cloud(p * 5.0, ivec2(64, 64), 3, seed);
        let reach = (p - 0.5).length();
        let Some((own, place, height)) = scatter(p, 19.0, 4, seed, leaf) else {
            return vec3(0.16, 0.22, 0.08).extend(0.0);
        };
        let vein = 0.12 * smoothstep(0.06, 0.0, place.y.abs());
        let base = vec3(0.25, 0.36, 0.12).lerp(vec3(0.42, 0.50, 0.18), own);
        let colour = base * (0.45 + 0.62 * height + vein) * (0.95 + 0.1 * place.y);
        colour.extend(if reach + 0.12 * (own - 0.5) < ragged { 1.0 } else { 0.0 })
    })
}

/// Paints a hanging mat of ivy.
pub(in crate::town) fn ivy(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::with_opacity(pixels, size, |at| {
        let p = at / size;
        let edge = p.x.min(1.0 - p.x).min(p.y + 0.3).min(1.0 - p.y);
        let ragged = 0.10 + 0.09 * cloud(p * 7.0, ivec2(64, 64), 3, seed + 4);
        let Some((own, place, height)) = scatter(p, 13.0, 4, seed, |p| (p.length() - 0.62).min(leaf(p))) else {
            return vec3(0.13, 0.19, 0.08).extend(0.0);
        };
        let base = vec3(0.20, 0.33, 0.13).lerp(vec3(0.33, 0.43, 0.16), own);
        let vein = 0.2 * smoothstep(0.06, 0.0, place.y.abs().min(place.x.abs()));
        (base * (0.5 + 0.5 * height + vein)).extend(if edge > ragged { 1.0 } else { 0.0 })
    })
}

/// Paints geraniums and their leaves over the edge of a box, in a unit square that is full below and ragged above.
pub(in crate::town) fn flowers(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::with_opacity(pixels, size, |at| {
        let p = at / size;
        let crest = 0.62 + 0.36 * noise(vec2(p.x * 9.0, 0.5), ivec2(9, 9), seed);
        let hem = 0.10 + 0.10 * noise(vec2(p.x * 12.0, 4.5), ivec2(12, 12), seed + 1);
        let opaque = if p.y < crest && p.y > hem { 1.0 } else { 0.0 };
        let blossom = scatter(p, 11.0, 2, seed + 5, |p| p.length() - 0.46);
        if let Some((own, place, _)) = blossom {
            let hue = if own < 0.6 {
                vec3(0.80, 0.10, 0.12)
            } else if own < 0.85 {
                vec3(0.86, 0.36, 0.48)
            } else {
                vec3(0.92, 0.86, 0.84)
            };
            let petals = 0.80 + 0.25 * noise(place * 9.0 + own * 40.0, ivec2(4096, 4096), seed) + 0.15 * place.y;
            return (hue * petals).extend(opaque);
        }
        match scatter(p, 12.0, 3, seed + 9, leaf) {
            Some((own, _, height)) => {
                (vec3(0.18, 0.34, 0.13).lerp(vec3(0.35, 0.47, 0.18), own) * (0.45 + 0.6 * height)).extend(opaque)
            }
            None => Vec4::new(0.09, 0.14, 0.06, opaque),
        }
    })
}

/// Paints grass seen from above.
pub(in crate::town) fn grass(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, size, |p| {
        let broad = cloud(p / 1.5, ivec2(6, 6), 4, seed);
        let blade = noise(p * vec2(24.0, 12.0), ivec2(216, 108), seed + 1)
            + noise(p * vec2(11.0, 26.0), ivec2(99, 234), seed + 2);
        vec3(0.36, 0.43, 0.20).lerp(vec3(0.48, 0.50, 0.26), 0.5 + 0.8 * broad) * (1.0 + 0.13 * blade)
    })
}

/// Paints wooded slopes seen from afar.
pub(in crate::town) fn woods(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, size, |p| {
        let crowns = noise(p * 0.2, ivec2(12, 12), seed) * 0.5 + noise(p * 0.6, ivec2(36, 36), seed + 1);
        vec3(0.50, 0.58, 0.36) * (1.0 + 0.25 * crowns)
    })
}

/// Paints rippled water that mirrors the sky.
pub(in crate::town) fn water(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, size, |p| {
        let ripple =
            noise(p * vec2(5.0, 9.0), ivec2(15, 27), seed) + 0.6 * noise(p * vec2(13.0, 10.0), ivec2(39, 30), seed + 1);
        vec3(0.30, 0.42, 0.45) * (1.0 + 0.16 * ripple) + Vec3::splat(0.12) * smoothstep(0.7, 1.1, ripple)
    })
}

/// Paints bark of a lime tree.
pub(in crate::town) fn bark(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    PaintCanvas::new(pixels, size, |p| {
        let ridge =
            noise(p * vec2(10.0, 2.0), ivec2(20, 4), seed) + 0.6 * noise(p * vec2(24.0, 6.0), ivec2(48, 12), seed + 1);
        vec3(0.38, 0.33, 0.27) * (0.85 + 0.28 * ridge)
    })
}

/// Paints heaps of fruit and vegetables, four kinds side by side in a unit square.
pub(in crate::town) fn produce(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    const KINDS: [[Vec3; 2]; 4] = [
        [vec3(0.72, 0.13, 0.10), vec3(0.80, 0.34, 0.14)],
        [vec3(0.90, 0.55, 0.12), vec3(0.92, 0.74, 0.20)],
        [vec3(0.35, 0.52, 0.17), vec3(0.58, 0.66, 0.25)],
        [vec3(0.36, 0.16, 0.30), vec3(0.70, 0.52, 0.30)],
    ];
    PaintCanvas::new(pixels, size, |at| {
        let p = at / size;
        let kind = (p.x * 4.0) as usize % 4;
        match scatter(p, 22.0, 3, seed + kind as u32, |p| p.length() - 0.85) {
            Some((own, place, height)) => {
                let shine = 0.25 * smoothstep(0.4, 0.0, (place - vec2(-0.25, 0.3)).length());
                KINDS[kind][0].lerp(KINDS[kind][1], own) * (0.5 + 0.5 * height) * (1.05 - 0.35 * place.length_squared())
                    + Vec3::splat(shine)
            }
            None => vec3(0.14, 0.10, 0.07),
        }
    })
}
