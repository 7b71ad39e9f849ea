//! Points of the unit circle from sums and products alone, so that built-in scenes are the same to the bit on every
//! machine.

use glam::{Vec2, vec2};

/// (cos, sin) of an angle given in turns.
///
/// *Accuracy*: 1e-6, by the Taylor series on ±1/8 turn.
pub fn circle(turns: f32) -> Vec2 {
    let quarters = (turns * 4.0).round();
    let x = (turns * 4.0 - quarters) * std::f32::consts::FRAC_PI_2;
    let q = x * x;
    let sine = x * (1.0 - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0 * (1.0 - q / 72.0))));
    let cosine = 1.0 - q / 2.0 * (1.0 - q / 12.0 * (1.0 - q / 30.0 * (1.0 - q / 56.0)));
    match (quarters as i64).rem_euclid(4) {
        0 => vec2(cosine, sine),
        1 => vec2(-sine, cosine),
        2 => vec2(-cosine, -sine),
        _ => vec2(sine, -cosine),
    }
}
