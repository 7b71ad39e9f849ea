//! A ray, followed through an animated body in the body's own frame: of light back in time, or along the observer's
//! present.
//!
//! The light that is seen now from the direction n was at o + n s when it had s metres still to travel; the place at
//! o + n s of the observer's present has the time ct + k s (`time` metres for each of s). Time and places are those of
//! the frame in which the body's chain begins. The body then stood as its keys say. In the body's frame, where its
//! triangles rest, the path is a curve, y(s) = M(ct + k s)⁻¹ (o + n s), y' = M⁻¹ (n − k β(y)), with k = −1 for light
//! and |k| < 1 for the present. The curve is followed only inside a ball around the body. Outside, steps are bounded by
//! the gap, since nothing outruns light. Inside, it is followed in chords whose distance from it is less than the
//! margin of the boxes around the triangles. For every triangle whose box a chord meets, the hit is solved for on the
//! curve itself (Newton's method on the distance from the triangle's plane), so that it is as exact as the keys.

use glam::{DMat3, DVec3};
use physics::Observer;
use physics::newton::{Newton, RootInterval};

use scene::motion::{Animated, Ball};
use std::convert::Infallible;

/// Largest distance of a chord from the curve, and margin of the boxes, both in radii of the body.
pub const SLACK: f64 = 1e-2;

/// Factor on the slack where a chord is tested, since it is tested only at a few places.
const STRICT: f64 = 0.5;

/// Largest number of steps along one ray.
const STEPS: usize = 100_000;

/// Search for the place where a ray passes through a plane.
const CROSSING: Newton = Newton { tolerance: 4.0 * f64::EPSILON, most_steps: 100 };

/// Path of one ray in the frame of a body.
pub struct Curve<'a> {
    pub animated: &'a Animated,
    /// Observer from whom the ray is followed, in the frame in which the body's chain begins; s = 0 is here.
    pub observer: &'a Observer,
    /// Direction of the ray, unit vector, axes of that frame.
    pub direction: DVec3,
    /// Time of that frame for each metre of the ray, k; −1 for light.
    pub time: f64,
}

/// A piece of a curve, and the chord that stands for it.
pub struct CurveChord {
    /// Values of s at the ends.
    pub span: [f64; 2],
    /// Values of y at the ends, metres.
    pub ends: [DVec3; 2],
}

impl Curve<'_> {
    /// Time at s, of the frame in which the body's chain begins, metres.
    pub fn ct(&self, s: f64) -> f64 {
        self.observer.event.ct + self.time * s
    }

    /// Place y and its derivative y'.
    pub fn at(&self, s: f64) -> (DVec3, DVec3) {
        let pose = self.animated.in_carrier(self.ct(s));
        let body_from_world: DMat3 = pose.world_from_body.matrix3.inverse();
        let light = self.observer.event.position + self.direction * s - pose.world_from_body.translation;
        let place = body_from_world * light;
        (place, body_from_world * (self.direction - self.time * pose.beta(place)))
    }

    /// Distance of the ray from the middle of a ball of the body, metres.
    fn distance(&self, ball: &Ball, s: f64) -> f64 {
        let centre = self.animated.in_carrier(self.ct(s)).position(ball.centre);
        centre.distance(self.observer.event.position + self.direction * s)
    }

    /// Result of `meets` for the first chord after `after` for which it returns one.
    ///
    /// * `ball` — around the body, in its own frame.
    /// * `world_radius` — largest radius of that ball in the world.
    /// * `reach` — a ball of the chain's first frame that the body never leaves.
    pub fn first<T>(
        &self,
        after: f64,
        ball: &Ball,
        world_radius: f64,
        reach: &Ball,
        meets: impl Fn(&CurveChord) -> Option<T>,
    ) -> Option<T> {
        let near = world_radius * (1.0 + SLACK);
        let last = reach.centre.distance(self.observer.event.position) + reach.radius + near;
        let (mut s, mut chord) = (after, 2.0 * near);
        for _ in 0..STEPS {
            // Light and body together close a gap by less than 2 metres for each metre that the light travels.
            let gap = self.distance(ball, s) - near;
            if gap > 0.0 {
                s += 0.5 * gap + 0.25 * SLACK * world_radius;
                if s > last {
                    return None;
                }
                continue;
            }
            let from = self.at(s).0;
            let piece = loop {
                let to = self.at(s + chord).0;
                let piece = CurveChord { span: [s, s + chord], ends: [from, to] };
                if self.leaves(&piece) <= STRICT * SLACK * ball.radius || chord < 1e-9 * near {
                    break piece;
                }
                chord *= 0.5;
            };
            if let Some(met) = meets(&piece) {
                return Some(met);
            }
            s += chord;
            chord = (2.0 * chord).min(2.0 * near);
        }
        None
    }

    /// Distance of the curve from a chord of it, as measured at three places.
    fn leaves(&self, chord: &CurveChord) -> f64 {
        let [a, b] = chord.ends;
        let off = |share: f64| {
            let s = chord.span[0] + (chord.span[1] - chord.span[0]) * share;
            self.at(s).0.distance(a + (b - a) * share)
        };
        off(0.5).max(off(0.25)).max(off(0.75))
    }

    /// Value of s at which a piece of the curve passes through the plane of a triangle.
    pub fn crosses(&self, chord: &CurveChord, [a, b, c]: [DVec3; 3]) -> Option<f64> {
        let normal = (b - a).cross(c - a);
        let height = |place: DVec3| normal.dot(place - a);
        let [first, last] = chord.span;
        let slack = 1e-9 * (last - first);
        let [low, high] = chord.ends.map(height);
        let start = if low == high { first } else { first + (last - first) * (low / (low - high)).clamp(0.0, 1.0) };
        let interval = if low * high <= 0.0 {
            RootInterval::Bracket { low: first, high: last, sign_at_low: low }
        } else {
            RootInterval::Range { low: first - slack, high: last + slack }
        };
        let height_and_rate = |s| {
            let (place, rate) = self.at(s);
            Ok::<_, Infallible>((height(place), normal.dot(rate)))
        };
        CROSSING.root(interval, start, height_and_rate).ok()
    }
}
