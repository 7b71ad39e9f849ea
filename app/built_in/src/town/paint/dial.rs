//! Dial of a clock: twelve numbers round a pale face, without hands, which turn before it.

use crate::town::canvas::{ENDLESS, PaintCanvas, cloud, smoothstep};
use crate::town::pictures::TownPicture;
use crate::turn::circle;
use glam::{Vec2, Vec3, vec2, vec3};

/// Strokes of the digits 0 to 9: polylines in a box 0.6 wide and 1 high.
const DIGITS: [&[(f32, f32)]; 10] = [
    &[
        (0.0, 0.25),
        (0.0, 0.75),
        (0.15, 1.0),
        (0.45, 1.0),
        (0.6, 0.75),
        (0.6, 0.25),
        (0.45, 0.0),
        (0.15, 0.0),
        (0.0, 0.25),
    ],
    &[(0.08, 0.78), (0.34, 1.0), (0.34, 0.0)],
    &[(0.0, 0.8), (0.15, 1.0), (0.45, 1.0), (0.6, 0.8), (0.6, 0.65), (0.0, 0.0), (0.6, 0.0)],
    &[(0.0, 1.0), (0.56, 1.0), (0.25, 0.6), (0.5, 0.55), (0.6, 0.3), (0.45, 0.0), (0.15, 0.0), (0.0, 0.15)],
    &[(0.45, 0.0), (0.45, 1.0), (0.0, 0.3), (0.6, 0.3)],
    &[
        (0.55, 1.0),
        (0.06, 1.0),
        (0.0, 0.55),
        (0.4, 0.62),
        (0.6, 0.4),
        (0.6, 0.2),
        (0.45, 0.0),
        (0.15, 0.0),
        (0.0, 0.15),
    ],
    &[
        (0.5, 1.0),
        (0.15, 0.75),
        (0.0, 0.4),
        (0.0, 0.2),
        (0.15, 0.0),
        (0.45, 0.0),
        (0.6, 0.2),
        (0.6, 0.4),
        (0.45, 0.58),
        (0.15, 0.58),
        (0.0, 0.38),
    ],
    &[(0.0, 1.0), (0.6, 1.0), (0.2, 0.0)],
    &[
        (0.15, 0.55),
        (0.03, 0.7),
        (0.03, 0.85),
        (0.18, 1.0),
        (0.42, 1.0),
        (0.57, 0.85),
        (0.57, 0.7),
        (0.45, 0.55),
        (0.6, 0.38),
        (0.6, 0.15),
        (0.45, 0.0),
        (0.15, 0.0),
        (0.0, 0.15),
        (0.0, 0.38),
        (0.15, 0.55),
        (0.45, 0.55),
    ],
    &[
        (0.1, 0.0),
        (0.45, 0.25),
        (0.6, 0.6),
        (0.6, 0.8),
        (0.45, 1.0),
        (0.15, 1.0),
        (0.0, 0.8),
        (0.0, 0.6),
        (0.15, 0.42),
        (0.45, 0.42),
        (0.6, 0.62),
    ],
];

/// Height of a number, and half the thickness of its strokes, shares of the dial's width.
const HEIGHT: f32 = 0.105;
const STROKE: f32 = 0.0115;
/// Distance of the numbers' middles from the dial's.
const CIRCLE: f32 = 0.365;

/// Paints the face of a clock that fills a unit square.
pub(in crate::town) fn dial(pixels: [usize; 2], size: Vec2, seed: u32) -> PaintCanvas {
    const FACE: Vec3 = vec3(0.95, 0.93, 0.86);
    const INK: Vec3 = vec3(0.07, 0.08, 0.11);
    const RIM: Vec3 = vec3(0.12, 0.17, 0.33);
    const GOLD: Vec3 = vec3(0.86, 0.68, 0.28);
    PaintCanvas::new(pixels, size, |at| {
        let p = at - size / 2.0;
        let r = p.length();
        let mut colour = FACE * (0.97 + 0.05 * cloud(at * 6.0, ENDLESS, 2, seed));
        let mut put = |d: f32, paint: Vec3| colour = colour.lerp(paint, smoothstep(0.003, -0.003, d));
        for tick in 0..48 {
            let c = circle(tick as f32 / 48.0);
            let (along, across) = (p.dot(vec2(c.y, c.x)), p.perp_dot(vec2(c.y, c.x)).abs());
            let (half, inner) = if tick % 4 == 0 { (0.008, 0.425) } else { (0.003, 0.44) };
            put((across - half).max(inner - along).max(along - 0.46), INK);
        }
        for number in 1..=12_usize {
            let c = circle(number as f32 / 12.0);
            let middle = vec2(c.y, c.x) * CIRCLE;
            // Strokes of a number never reach beyond this square.
            if (p - middle).abs().max_element() < HEIGHT {
                put(number_distance((p - middle) / HEIGHT, number) * HEIGHT - STROKE, INK);
            }
        }
        put(0.462 - r, RIM);
        put((r - 0.466).abs() - 0.006, GOLD);
        put(r - 0.03, INK);
        colour
    })
}

/// Picture of a dial, of `pixels` by `pixels`, for scenes other than the town.
pub(crate) fn picture(pixels: usize) -> TownPicture {
    dial([pixels; 2], Vec2::ONE, 1).finish()
}

/// Distance from the strokes of a number of one or two digits about the origin, in heights of a digit.
fn number_distance(p: Vec2, number: usize) -> f32 {
    if number < 10 {
        return digit_distance(p + vec2(0.3, 0.5), number);
    }
    let left = digit_distance(p + vec2(0.62, 0.5), number / 10);
    left.min(digit_distance(p + vec2(-0.06, 0.5), number % 10))
}

/// Distance from the strokes of a digit.
fn digit_distance(p: Vec2, digit: usize) -> f32 {
    let pairs = DIGITS[digit].windows(2);
    pairs.map(|pair| segment_distance(p, pair[0].into(), pair[1].into())).fold(f32::INFINITY, f32::min)
}

fn segment_distance(p: Vec2, a: Vec2, b: Vec2) -> f32 {
    let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    p.distance(a + (b - a) * along)
}
