//! Windows and portal of the church.

use glam::{Vec2, ivec2, vec2, vec3};

use super::masonry::ashlar_at;
use super::openings::{Door, door};
use crate::town::canvas::{Area, PaintCanvas, chance, smoothstep};

/// Size of a church window, metres.
pub(in crate::town) const LANCET: Vec2 = vec2(1.6, 4.2);

/// Paints a pointed church window with tracery; outside its outline the picture is transparent.
pub(in crate::town) fn lancet(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    let half = size.x / 2.0;
    let pointed = move |p: Vec2, inset: f32| {
        // The point is made of two circles about the opposite springers.
        let x = (p.x - half).abs();
        let radius = 2.0 * half;
        let spring = size.y - radius * 0.866;
        if p.y > spring { vec2(x + half, p.y - spring).length() - radius + inset } else { (x - half).max(-p.y) + inset }
    };
    let mut canvas = PaintCanvas::new(pixels, size, |p| {
        let d = pointed(p, 0.0);
        let stone = ashlar_at(p, size, ivec2(2, 12), seed) * (0.8 + 0.2 * smoothstep(0.0, 0.03, -d));
        let inner = pointed(p, 0.2);
        let reveal = stone * if p.y > 0.4 * size.y { 0.55 } else { 0.68 };
        let q = p * 6.5;
        let diamond = vec2((q.x + q.y).fract() - 0.5, (q.x - q.y).fract() - 0.5).abs();
        let lead = smoothstep(0.42, 0.47, diamond.max_element());
        let pane = chance((q.x + q.y).floor() as i32, (q.x - q.y).floor() as i32, seed + 1);
        let hue = chance((q.x + q.y).floor() as i32, (q.x - q.y).floor() as i32, seed + 2);
        let tinted =
            vec3(0.22, 0.27, 0.33).lerp(vec3(0.33, 0.22, 0.24), smoothstep(0.79, 0.81, hue)) * (0.75 + 0.6 * pane);
        let glass = tinted.lerp(vec3(0.10, 0.10, 0.11), lead);
        let mullion = ((p.x - half).abs() - 0.06).min(((p.y - 0.45 * size.y).abs() - 0.05).max(-1.0));
        let eye = ((p - vec2(half, size.y - 1.05)).length() - 0.27).abs() - 0.05;
        let tracery = mullion.min(eye);
        let glass = glass * (0.65 + 0.35 * smoothstep(0.0, 0.2, -inner));
        let filled = glass.lerp(stone * 0.92, smoothstep(0.012, -0.012, tracery));
        stone.lerp(reveal, smoothstep(0.0, -0.01, pointed(p, 0.14))).lerp(filled, smoothstep(0.0, -0.01, inner))
    });
    canvas.keep(|p| pointed(p, 0.01));
    canvas
}

/// Size of the church's portal, metres.
pub(in crate::town) const PORTAL: Vec2 = vec2(3.6, 4.4);

/// Paints a stepped round portal with a double door.
pub(in crate::town) fn portal(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    let opening = Area::new(0.8, 0.0, 2.0, 3.1);
    let mut canvas = PaintCanvas::new(pixels, size, |p| {
        let wall = ashlar_at(p, size, ivec2(5, 12), seed);
        // Archivolts: rings of stone, each set back behind the one before.
        let d = opening.arch_distance(p);
        let ring = (d / 0.2).clamp(0.0, 3.0);
        let relief = 0.62 + 0.14 * ring.floor() + 0.16 * (ring.fract() * (1.0 - ring.fract()) * 4.0);
        if d < 0.6 { wall * relief.min(1.0) } else { wall }
    });
    let leaves = Door {
        opening: opening.grown(-0.2),
        stone: vec3(0.62, 0.54, 0.44),
        colour: vec3(0.36, 0.20, 0.13),
        arched: true,
    };
    door(&mut canvas, &leaves, seed + 1);
    canvas.darken(Area { low: Vec2::ZERO, high: vec2(size.x, 0.3) }, |p| 0.72 + 0.28 * smoothstep(0.0, 0.3, p.y));
    canvas
}
