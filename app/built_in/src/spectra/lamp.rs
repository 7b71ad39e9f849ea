//! Irradiance in a room with one lamp: direct light of the lamp, with soft shadows, and light returned by the room.
//!
//! The lamp is a luminous part of the ceiling, so its light is an integral over a rectangle (W 3.3). Light returned
//! by walls and floor is even, and weaker in corners. It does not depend on the wavelength: everything in the room is
//! colourless, so all light in it has the lamp's spectrum.

use std::f32::consts::PI;

use glam::{Vec2, Vec3, Vec3Swizzles, vec2, vec3};

use super::sheet::HallSheet;
use crate::turn::circle;

/// Albedo of everything in a room.
const ALBEDO: f32 = 0.7;
/// Radiance returned by the room, as a share of the lamp's radiance.
const AMBIENT: f32 = 0.075;
/// Distance within which a surface blocks such light from another, metres.
const REACH_M: f32 = 1.5;
/// Number of sample points on the lamp, across and along.
const POINTS: [u32; 2] = [4, 10];
/// Number of sample directions into the room.
const LOOKS: u32 = 24;
/// Height above a surface at which sample rays begin, metres.
const CLEARANCE_M: f32 = 1e-3;

/// Solid body in a room.
#[derive(Clone, Copy)]
pub(super) enum RoomBody {
    Ball { centre: Vec3, radius: f32 },
    Block { low: Vec3, high: Vec3 },
    Drum { base: Vec3, radius: f32, height: f32 },
}

/// Room with a lamp.
pub(super) struct Room {
    /// Least and greatest corner of the room, metres.
    pub(super) bounds: [Vec3; 2],
    /// Least and greatest corner of the lamp in plan, metres.
    pub(super) lamp: [Vec2; 2],
    /// Height of the lamp, metres.
    pub(super) lamp_height: f32,
    /// Bodies in the room.
    pub(super) bodies: Vec<RoomBody>,
}

impl RoomBody {
    pub(super) fn build(self, sheet: &mut HallSheet) {
        match self {
            Self::Ball { centre, radius } => sheet.ball(centre, radius),
            Self::Block { low, high } => sheet.block(low, high),
            Self::Drum { base, radius, height } => sheet.drum(base, radius, height),
        }
    }

    /// True if the body stands between two points.
    fn hides(self, from: Vec3, to: Vec3) -> bool {
        let way = to - from;
        match self {
            Self::Ball { centre, radius } => {
                let nearest = (centre - from).dot(way) / way.length_squared();
                (from + way * nearest.clamp(0.0, 1.0)).distance_squared(centre) < radius * radius
            }
            Self::Block { low, high } => {
                let spans = [0, 1, 2].map(|axis| span(from[axis], way[axis], low[axis], high[axis]));
                overlap(&spans)
            }
            Self::Drum { base, radius, height } => {
                // The ray in plan meets the circle where |p + t w|² = r².
                let (place, way_in_plan) = ((from - base).xz(), way.xz());
                let (a, b) = (way_in_plan.length_squared(), place.dot(way_in_plan));
                let root = (b * b - a * (place.length_squared() - radius * radius)).max(0.0).sqrt();
                let round =
                    if a > 0.0 { [(-b - root) / a, (-b + root) / a] } else { [f32::NEG_INFINITY, f32::INFINITY] };
                let outside = a == 0.0 && place.length() > radius;
                !outside && overlap(&[round, span(from.y, way.y, base.y, base.y + height)])
            }
        }
    }
}

/// Interval of shares of a way at which one coordinate lies between two values.
fn span(from: f32, way: f32, low: f32, high: f32) -> [f32; 2] {
    let (a, b) = ((low - from) / way, (high - from) / way);
    if a.is_nan() || b.is_nan() { [f32::INFINITY, f32::NEG_INFINITY] } else { [a.min(b), a.max(b)] }
}

/// True if a share between 0 and 1 lies in all intervals.
fn overlap(spans: &[[f32; 2]]) -> bool {
    let begin = spans.iter().map(|span| span[0]).fold(0.0, f32::max);
    let end = spans.iter().map(|span| span[1]).fold(1.0, f32::min);
    begin < end
}

impl Room {
    /// Radiance of a surface as a share of the lamp's.
    pub(super) fn radiance(&self, position: Vec3, normal: Vec3) -> f32 {
        let from = position + normal * CLEARANCE_M;
        ALBEDO * (self.direct(from, normal) + AMBIENT * self.openness(from, normal))
    }

    /// Irradiance by the lamp over π times its radiance: ∫ cos θ cos θ' / (π r²) dA over the visible part of it.
    fn direct(&self, from: Vec3, normal: Vec3) -> f32 {
        let [low, high] = self.lamp;
        let [columns, rows] = POINTS;
        let area = (high - low).x * (high - low).y / (columns * rows) as f32;
        let points = (0..columns * rows).map(|index| {
            let share = vec2((index % columns) as f32 + 0.5, (index / columns) as f32 + 0.5)
                / vec2(columns as f32, rows as f32);
            let place = low + (high - low) * share;
            vec3(place.x, self.lamp_height, place.y)
        });
        let light = |point: Vec3| {
            let way = point - from;
            let cosines = normal.dot(way).max(0.0) * way.y.max(0.0);
            if cosines == 0.0 || self.hidden(from, point) {
                return 0.0;
            }
            cosines / (PI * way.length_squared() * way.length_squared()) * area
        };
        points.map(light).sum()
    }

    fn hidden(&self, from: Vec3, to: Vec3) -> bool {
        self.bodies.iter().any(|body| body.hides(from, to))
    }

    /// Share of the room that a surface sees beyond [`REACH_M`], weighted by cosines; nearer parts count less.
    fn openness(&self, from: Vec3, normal: Vec3) -> f32 {
        let (right, up) = normal.any_orthonormal_pair();
        /// Golden ratio; its multiples spread points evenly over a disk.
        const GOLDEN: f32 = 0.618_034;
        let look = |index: u32| {
            let out = (index as f32 + 0.5) / LOOKS as f32;
            let around = circle((index as f32 * GOLDEN).fract()) * out.sqrt();
            let direction = right * around.x + up * around.y + normal * (1.0 - out).sqrt();
            if self.hidden(from, from + direction * REACH_M) {
                0.0
            } else {
                (self.depth(from, direction) / REACH_M).min(1.0)
            }
        };
        (0..LOOKS).map(look).sum::<f32>() / LOOKS as f32
    }

    /// Distance to a wall along a direction, metres.
    fn depth(&self, from: Vec3, direction: Vec3) -> f32 {
        let [low, high] = self.bounds;
        let towards = |axis: usize| {
            let wall = if direction[axis] > 0.0 { high[axis] } else { low[axis] };
            if direction[axis] == 0.0 { f32::INFINITY } else { ((wall - from[axis]) / direction[axis]).max(0.0) }
        };
        [0, 1, 2].map(towards).into_iter().fold(f32::INFINITY, f32::min)
    }
}

#[cfg(test)]
mod tests {
    //! Laws under test: the lamp's light equals its closed form where nothing stands in the way, and shadows fall
    //! behind bodies only. A wrong shadow falls where nothing stands, or misses a body.

    use super::*;

    fn room(bodies: Vec<RoomBody>) -> Room {
        let bounds = [vec3(-4.0, 0.0, -10.0), vec3(4.0, 5.0, 0.0)];
        Room { bounds, lamp: [vec2(-1.0, -6.0), vec2(1.0, -4.0)], lamp_height: 5.0, bodies }
    }

    #[test]
    fn a_lamp_overhead_lights_as_its_form_factor_says() {
        // The lamp is a square of 2 a = 2 m, seen from h = 5 m below its middle: F = (4/π) X/√(1+X²) atan(X/√(1+X²)),
        // X = a/h.
        let x: f32 = 0.2;
        let part = x / (1.0 + x * x).sqrt();
        let expected = 4.0 / PI * part * part.atan();
        let found = room(Vec::new()).direct(vec3(0.0, 0.0, -5.0), Vec3::Y);
        // Forty points stand for the integral.
        assert!((found / expected - 1.0).abs() < 0.002, "{found} is not {expected}");
        assert_eq!(room(Vec::new()).direct(vec3(0.0, 0.0, -5.0), Vec3::NEG_Y), 0.0, "facing away");
        assert_eq!(room(Vec::new()).direct(vec3(0.0, 6.0, -5.0), Vec3::NEG_Y), 0.0, "behind the lamp");
    }

    #[test]
    fn shadows_fall_where_something_stands() {
        let bodies = [
            RoomBody::Ball { centre: vec3(0.0, 2.5, -5.0), radius: 1.6 },
            RoomBody::Block { low: vec3(-1.6, 2.0, -6.6), high: vec3(1.6, 3.0, -3.4) },
            RoomBody::Drum { base: vec3(0.0, 2.0, -5.0), radius: 2.0, height: 0.5 },
        ];
        for body in bodies {
            let room = room(vec![body]);
            assert_eq!(room.direct(vec3(0.0, 0.0, -5.0), Vec3::Y), 0.0, "below");
            assert!(room.direct(vec3(0.0, 4.2, -5.0), Vec3::Y) > 0.0, "above");
            assert!(room.direct(vec3(3.9, 0.0, -5.0), Vec3::Y) > 0.0, "beside");
            assert!(!body.hides(vec3(0.0, 0.0, 3.0), vec3(0.0, 5.0, 3.0)), "beside, straight up");
        }
    }

    #[test]
    fn corners_are_darker_than_the_open_floor() {
        let room = room(Vec::new());
        assert_eq!(room.openness(vec3(0.0, 0.0, -5.0), Vec3::Y), 1.0);
        let corner = room.openness(vec3(-3.95, 0.0, -0.05), Vec3::Y);
        assert!((0.1..0.5).contains(&corner), "{corner}");
    }
}
