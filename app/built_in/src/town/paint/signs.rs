//! Guild signs, and the stripes of awnings.

use glam::{Vec2, Vec3, Vec4, ivec2, vec2, vec3};

use crate::town::canvas::{Area, ENDLESS, PaintCanvas, cloud, noise, smoothstep};
use crate::turn::circle;

/// Paints striped cloth, four kinds above one another, two stripes of each per metre.
pub(in crate::town) fn awning(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    const STRIPES: [Vec3; 4] =
        [vec3(0.66, 0.17, 0.14), vec3(0.20, 0.40, 0.27), vec3(0.22, 0.33, 0.55), vec3(0.80, 0.58, 0.20)];
    PaintCanvas::new(pixels, size, |p| {
        let along = (p.x * 2.0).fract();
        let stripe = smoothstep(-0.01, 0.01, 0.25 - (along - 0.5).abs());
        let kind = ((size.y - p.y) / size.y * 4.0) as usize % 4;
        let weave = 1.0 + 0.05 * noise(p * 90.0, ivec2(90, 90), seed) + 0.08 * cloud(p * 4.0, ivec2(4, 4), 3, seed + 1);
        vec3(0.90, 0.87, 0.80).lerp(STRIPES[kind], stripe) * weave
    })
}

/// Paints guild signs, four by four in a unit square.
pub(in crate::town) fn signs(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    const GROUNDS: [Vec3; 4] =
        [vec3(0.14, 0.26, 0.19), vec3(0.42, 0.12, 0.10), vec3(0.13, 0.19, 0.36), vec3(0.86, 0.80, 0.66)];
    PaintCanvas::with_opacity(pixels, size, |at| -> Vec4 {
        let cell = (at / size * 4.0).floor().as_ivec2();
        let p = (at / size * 4.0).fract() * 2.0 - 1.0;
        let kind = (cell.x + 4 * cell.y).rem_euclid(8);
        let ground = GROUNDS[((cell.x + 3 * cell.y).rem_euclid(4)) as usize];
        let ink = if ground.x > 0.6 { vec3(0.25, 0.14, 0.08) } else { vec3(0.88, 0.70, 0.32) };
        let worn = 1.0 + 0.07 * noise(at * 50.0, ENDLESS, seed) + 0.08 * cloud(at * 9.0, ENDLESS, 2, seed + 1);
        let border = p.abs().max_element();
        let mut colour = ground.lerp(ink, smoothstep(0.84, 0.86, border) * smoothstep(0.93, 0.91, border));
        colour = colour.lerp(ink, smoothstep(0.02, -0.02, emblem(p, kind)));
        (colour * worn).extend(1.0)
    })
}

/// Signed distance from the outline of an emblem in −1…1.
fn emblem(p: Vec2, kind: i32) -> f32 {
    let disc = |x: f32, y: f32, r: f32| (p - vec2(x, y)).length() - r;
    let bar = |x: f32, y: f32, w: f32, h: f32| Area::new(x - w / 2.0, y - h / 2.0, w, h).distance(p);
    match kind {
        // A pretzel.
        0 => {
            let loops =
                (disc(-0.26, 0.08, 0.30).abs().min(disc(0.26, 0.08, 0.30).abs())).min(disc(0.0, -0.2, 0.34).abs());
            loops - 0.075
        }
        // A key.
        1 => (disc(0.0, 0.40, 0.20).abs() - 0.07)
            .min(bar(0.0, -0.15, 0.11, 0.80))
            .min(bar(0.13, -0.46, 0.22, 0.1))
            .min(bar(0.11, -0.28, 0.18, 0.1)),
        // A boot.
        2 => bar(-0.12, 0.16, 0.34, 0.80).min(bar(0.08, -0.38, 0.74, 0.26)).min(disc(0.40, -0.36, 0.15)),
        // A bunch of grapes.
        3 => {
            let mut d = bar(0.0, 0.52, 0.07, 0.24);
            for row in 0..4 {
                for k in 0..(4 - row) {
                    d = d.min(disc((k as f32 - (3 - row) as f32 / 2.0) * 0.27, 0.28 - 0.24 * row as f32, 0.125));
                }
            }
            d
        }
        // A mug.
        4 => bar(-0.08, -0.05, 0.62, 0.84).min((disc(0.30, -0.04, 0.24).abs() - 0.06).max(0.2 - p.x)),
        // An anvil.
        5 => bar(0.0, 0.28, 1.0, 0.22).min(bar(0.0, 0.0, 0.34, 0.5)).min(bar(0.0, -0.36, 0.74, 0.2)),
        // Shears.
        6 => {
            let blade = |s: f32| {
                let axis = vec2(0.35 * s, 0.94);
                (p.perp_dot(axis).abs() - 0.06).max(p.dot(axis).abs() - 0.6)
            };
            blade(1.0)
                .min(blade(-1.0))
                .min(disc(0.26, -0.5, 0.17).abs() - 0.06)
                .min(disc(-0.26, -0.5, 0.17).abs() - 0.06)
        }
        // A star.
        _ => {
            let mut d = 9.0_f32;
            for k in 0..3 {
                let c = circle(k as f32 / 6.0);
                d = d.min((p.dot(c).abs() - 0.6).max(p.perp_dot(c).abs() - 0.14));
            }
            d
        }
    }
}
