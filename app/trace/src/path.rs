//! The light along a ray, through everything that turns it.
//!
//! The Doppler factors of a ray's legs multiply, and radiance scales with D⁴ of their product. A coloured mirror or
//! glass filters the weights of what it shows, channel by channel, like a coloured surface the light that falls on
//! it. After its last turn a ray treats a smooth surface as a rough one.

use super::finish::{Shares, fresnel, mirrored, refracted};
use super::hits::{Found, Hit, Sight, Turn};
use super::tracer::RayTracer;
use glam::DVec3;
use std::ops::{Add, AddAssign, Mul};
use view::Effects;

/// Smallest share of a ray's light that is followed.
const HIDDEN: f64 = 1e-4;

/// Light along a ray, as observed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// Light in linear sRGB, cd/m².
    pub light: DVec3,
    /// Luminance without any shift, relative to white.
    pub at_rest: f64,
}

/// Part of a ray from an observer, or from a surface that turns it.
pub struct Leg<'a> {
    sight: &'a Sight,
    seen: DVec3,
    start: Vec<f64>,
    /// Share of the leg's light that arrives at the end of the ray.
    rest: Rest,
}

/// Factors on a leg's light, and limits of the ray beyond it.
#[derive(Clone, Copy)]
struct Rest {
    doppler: f64,
    filter: DVec3,
    bounces: u32,
    effects: Effects,
}

impl<'a> Leg<'a> {
    /// First leg, from the observer.
    pub fn first(sight: &'a Sight, seen: DVec3, effects: Effects, bounces: u32) -> Self {
        let rest = Rest { doppler: 1.0, filter: DVec3::ONE, bounces, effects };
        Self { sight, seen, start: sight.start(), rest }
    }
}

impl RayTracer {
    /// Light that comes along a leg.
    pub(super) fn along(&self, mut leg: Leg<'_>) -> Seen {
        let mut light = DVec3::ZERO;
        let mut shines_through = 1.0;
        while shines_through * leg.rest.filter.max_element() > HIDDEN {
            let there = |hit: &Hit| self.surfaces.is_there(hit);
            let Some(found) = self.bodies.first(leg.sight, leg.seen, &leg.start, there) else { break };
            let (opacity, clear, seen) = self.surface(&leg, &found);
            // The luminance at rest is that of a surface without anything mixed from behind it, like in the
            // renderers' targets.
            if opacity >= 1.0 && clear == DVec3::ZERO {
                return Seen { light: light + shines_through * seen.light, at_rest: seen.at_rest };
            }
            light += shines_through * opacity * seen.light;
            if clear == DVec3::ZERO {
                shines_through *= 1.0 - opacity;
            } else {
                leg.rest.filter *= clear * opacity + (1.0 - opacity);
            }
            leg.start = self.bodies.beyond(leg.sight, leg.seen, &found);
        }
        let (direction, doppler) = leg.sight.world(leg.seen);
        let sent = self.surfaces.sky(direction, self.background).dimmed(1.0, leg.rest.filter);
        let seen = self.light.observed(&sent, leg.rest.effects, leg.rest.doppler * doppler);
        Seen { light: light + shines_through * seen.light, ..seen }
    }

    /// Opacity of a surface, filter of the light that it lets through straight on, and its own light.
    fn surface(&self, leg: &Leg<'_>, found: &Found) -> (f64, DVec3, Seen) {
        let scene = &self.surfaces.scene;
        let rest = Rest { doppler: leg.rest.doppler * found.doppler, ..leg.rest };
        let emission = self.bodies.emission(scene, leg.sight, found);
        let (opacity, sent) = self.surfaces.light(&found.hit, emission, &leg.sight.falling, &self.bodies, &self.light);
        let finish = if rest.bounces > 0 { self.surfaces.finish(&found.hit) } else { None };
        let Some(finish) = finish else {
            let sent = sent.dimmed(1.0, rest.filter);
            return (opacity, DVec3::ZERO, self.light.observed(&sent, rest.effects, rest.doppler));
        };

        // Find what a smooth surface turns.
        let turn = self.bodies.turn(scene, leg.sight, leg.seen, found);
        let (normal, plane) = (self.surfaces.normal(&found.hit), plane(&found.hit));
        let front = found.hit.front;
        let cosine = normal.dot(-turn.direction).clamp(0.0, 1.0);
        let Shares { mirrored: share_mirrored, through, diffuse } = finish.shares(cosine, front);
        let sent = sent.dimmed(diffuse, rest.filter);
        let mut seen = self.light.observed(&sent, rest.effects, rest.doppler);

        // Follow the turned rays.
        let turned = |direction: DVec3| Turn { direction, ..turn };
        let further = |share: DVec3| Rest { filter: rest.filter * share, bounces: rest.bounces - 1, ..rest };
        seen += self.onward(turned(mirrored(turn.direction, normal, plane)), further(share_mirrored));
        if !finish.solid {
            return (opacity, through, seen);
        }
        if let Some(direction) = refracted(turn.direction, normal, finish.beyond(front)) {
            let (turn, rest) = (turned(direction), further(through));
            seen += if front { self.within(turn, rest, finish.index) } else { self.onward(turn, rest) };
        }
        (opacity, DVec3::ZERO, seen)
    }

    /// Light from the direction into which a surface has turned a ray.
    fn onward(&self, turn: Turn, rest: Rest) -> Seen {
        if rest.filter.max_element() <= HIDDEN {
            return Seen::default();
        }
        let (sight, seen, start) = self.bodies.onward(&self.surfaces, &turn, rest.effects.geometry);
        self.along(Leg { sight: &sight, seen, start, rest })
    }

    /// Light that comes through glass, for a ray inside it. Light is slower there by the index of refraction, in the
    /// glass's own frame. The ray meets only triangles of the same body.
    fn within(&self, mut turn: Turn, mut rest: Rest, index: f64) -> Seen {
        let mut sum = Seen::default();
        while rest.filter.max_element() > HIDDEN {
            let Some(hit) = self.bodies.within(&turn, |hit| self.surfaces.is_there(hit)) else {
                return sum + self.onward(turn, rest);
            };
            turn.position = hit.position;
            if rest.effects.geometry {
                turn.emission.ct -= index * hit.distance;
            }
            if self.surfaces.finish(&hit).is_none_or(|finish| !finish.solid) {
                let observer = self.bodies.in_world(&self.surfaces.scene, turn.emission, turn.position);
                let falling = self.surfaces.falling(&observer, rest.effects.geometry);
                let (_, sent) = self.surfaces.light(&hit, turn.emission, &falling, &self.bodies, &self.light);
                let sent = sent.dimmed(1.0, rest.filter);
                return sum + self.light.observed(&sent, rest.effects, rest.doppler);
            }
            let (normal, plane) = (self.surfaces.normal(&hit), plane(&hit));
            let reflected = fresnel(normal.dot(-turn.direction).clamp(0.0, 1.0), 1.0 / index);
            if let Some(direction) = refracted(turn.direction, normal, 1.0 / index) {
                let rest = Rest { filter: rest.filter * (1.0 - reflected), ..rest };
                sum += self.onward(Turn { direction, ..turn }, rest);
            } else if rest.bounces == 0 {
                // No turn is left, so the ray goes straight on.
                return sum + self.onward(turn, rest);
            }
            if rest.bounces == 0 {
                return sum;
            }
            rest = Rest { filter: rest.filter * reflected, bounces: rest.bounces - 1, ..rest };
            turn.direction = mirrored(turn.direction, normal, plane);
        }
        sum
    }
}

/// Unit normal of the triangle, on the visible side.
fn plane(hit: &Hit) -> DVec3 {
    let plane = hit.plane.normalize_or_zero();
    if hit.front { plane } else { -plane }
}

impl Add for Seen {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { light: self.light + other.light, at_rest: self.at_rest + other.at_rest }
    }
}

impl AddAssign for Seen {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f64> for Seen {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { light: self.light * factor, at_rest: self.at_rest * factor }
    }
}
