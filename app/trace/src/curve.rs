//! A ray of light back through an animated body, in the body's own frame.
//!
//! s metres of light travel ago the light that is seen now from the direction n was at o + n s, and the body as its keys had it then. In the body's
//! frame, where its triangles rest, that is a curve, y(s) = M(ct − s)⁻¹ (o + n s), y' = M⁻¹ (n + β(y)). It is followed only inside a ball around
//! the body, which is stepped up to by distances that nothing slower than light can outrun; there, in chords that leave it by less than the boxes
//! are wide of their triangles. Every triangle whose box a chord meets is solved for on the curve itself (Newton's method on the distance from its
//! plane), so that what is found is as exact as the keys.

use glam::{DMat3, DVec3};
use physics::Observer;

use scene::motion::{Animated, Ball};

/// How far a chord may be from the curve, and by how much boxes are wide: in radii of the body.
pub const SLACK: f64 = 1e-2;

/// Looks at a chord are this much stricter than what they are to ensure between them.
const STRICT: f64 = 0.5;

/// The most steps along one ray.
const STEPS: usize = 100_000;

/// A body's curve for one ray.
pub struct Curve<'a> {
    pub animated: &'a Animated,
    /// Who sees it; s = 0 is here.
    pub observer: &'a Observer,
    /// Unit vector, world.
    pub direction: DVec3,
}

/// A piece of a curve, and the chord that stands for it.
pub struct Chord {
    /// s at its ends.
    pub span: [f64; 2],
    /// y at its ends.
    pub ends: [DVec3; 2],
}

impl Curve<'_> {
    /// y and y'.
    pub fn at(&self, s: f64) -> (DVec3, DVec3) {
        let pose = self.animated.at(self.observer.event.ct - s);
        let body_from_world: DMat3 = pose.world_from_body.matrix3.inverse();
        let light = self.observer.event.position + self.direction * s - pose.world_from_body.translation;
        let place = body_from_world * light;
        (place, body_from_world * (self.direction + pose.beta(place)))
    }

    /// How far the light is from the middle of a ball of the body.
    fn distance(&self, ball: &Ball, s: f64) -> f64 {
        let centre = self.animated.at(self.observer.event.ct - s).position(ball.centre);
        centre.distance(self.observer.event.position + self.direction * s)
    }

    /// The first chord after `after` of which something `meets`; what it says.
    ///
    /// * `ball` — around the body, in its own frame.
    /// * `world_radius` — of the same in the world, at most.
    /// * `reach` — a ball of the world that the body never leaves.
    pub fn first<T>(
        &self,
        after: f64,
        ball: &Ball,
        world_radius: f64,
        reach: &Ball,
        meets: impl Fn(&Chord) -> Option<T>,
    ) -> Option<T> {
        let near = world_radius * (1.0 + SLACK);
        let last = reach.centre.distance(self.observer.event.position) + reach.radius + near;
        let (mut s, mut chord) = (after, 2.0 * near);
        for _ in 0..STEPS {
            // Both light and body come no nearer than 2 metres in a metre.
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
                let piece = Chord { span: [s, s + chord], ends: [from, to] };
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

    /// How far the curve is from a chord of it, as far as looks tell.
    fn leaves(&self, chord: &Chord) -> f64 {
        let [a, b] = chord.ends;
        let off = |share: f64| {
            let s = chord.span[0] + (chord.span[1] - chord.span[0]) * share;
            self.at(s).0.distance(a + (b - a) * share)
        };
        off(0.5).max(off(0.25)).max(off(0.75))
    }

    /// Where a piece of the curve passes through the plane of a triangle.
    pub fn crosses(&self, chord: &Chord, [a, b, c]: [DVec3; 3]) -> Option<f64> {
        let normal = (b - a).cross(c - a);
        let height = |place: DVec3| normal.dot(place - a);
        let [first, last] = chord.span;
        let slack = 1e-9 * (last - first);
        let [low, high] = chord.ends.map(height);
        let mut s = if low == high { first } else { first + (last - first) * (low / (low - high)).clamp(0.0, 1.0) };
        // Newton's method; bisection where that leaves the piece and the ends are on either side.
        let mut bracket = (low * high <= 0.0).then_some([first, last]);
        for _ in 0..100 {
            let (place, rate) = self.at(s);
            let (off, slope) = (height(place), normal.dot(rate));
            if let Some([from, to]) = &mut bracket {
                if off * low > 0.0 { *from = s } else { *to = s }
            }
            let step = off / slope;
            if off == 0.0 || step.abs() <= 4.0 * f64::EPSILON * s.abs() {
                return Some(s);
            }
            let newton = s - step;
            s = match bracket {
                Some([from, to]) if !(from..=to).contains(&newton) => {
                    let middle = 0.5 * (from + to);
                    if middle == from || middle == to {
                        return Some(middle);
                    }
                    middle
                }
                None if !(first - slack..=last + slack).contains(&newton) => return None,
                _ => newton,
            };
        }
        Some(s)
    }
}
