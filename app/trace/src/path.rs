//! The light along a ray, through everything that turns it.
//!
//! The Doppler factors of a ray's legs multiply, and radiance scales with D⁴ of their product. A coloured mirror or
//! glass filters the weights of what it shows, channel by channel, like a coloured surface the light that falls on
//! it. After its last turn a ray treats a smooth surface as a rough one.

use super::bodies::Bodies;
use super::finish::{Shares, fresnel, mirrored, refracted};
use super::hit::{FirstHit, RayHit, TracedPlace, Turn};
use super::light::{LightShifts, ObservedLight};
use super::observer::ObserverInBodies;
use super::surface::LitSurfaces;
use glam::DVec3;
use physics::Observer;
use scene::Scene;
use scene::carriers::SceneCarriers;
use scene::irradiance::Irradiance;
use std::sync::Arc;
use view::{Effects, Places};

/// Smallest share of a ray's light that is followed.
const HIDDEN: f64 = 1e-4;

/// Scene with its light, ready for rays.
pub struct LitScene {
    surfaces: LitSurfaces,
    bodies: Bodies,
    light: LightShifts,
    /// Linear radiance that replaces the sky.
    background: Option<[f32; 3]>,
}

/// Observer in the frames of all bodies, and the irradiance of each motion for this observer.
pub struct LitObserver {
    bodies: ObserverInBodies,
    irradiances: Vec<Irradiance>,
}

/// Part of a ray from an observer, or from a surface that turns it.
struct Leg<'a> {
    observer: &'a LitObserver,
    /// Direction of sight, unit vector, observer's axes.
    seen: DVec3,
    /// Distance at which the ray begins in each body's frame, metres.
    start: Vec<f64>,
    state: LegState,
}

/// Factors on a leg's light when it arrives at the end of the ray, and limits of the ray beyond the leg.
#[derive(Clone, Copy)]
struct LegState {
    doppler: f64,
    filter: DVec3,
    bounces: u32,
    effects: Effects,
}

impl LitScene {
    /// Sorts the scene's triangles and computes its light; for the arguments see [`super::RayTracer::new`].
    pub fn new(scene: Scene, background: Option<[f32; 3]>, exact_light: bool) -> Self {
        let carriers = SceneCarriers::of(&scene);
        let scene = Arc::new(scene);
        let bodies = Bodies::new(&scene);
        let light = LightShifts::new(&carriers, &scene, exact_light);
        Self { surfaces: LitSurfaces::new(scene, carriers), bodies, light, background }
    }

    /// Sets if light goes through glass.
    pub fn set_clear_glass(&mut self, clear_glass: bool) {
        self.bodies.clear_glass = clear_glass;
    }

    /// Luminance that is white at rest, cd/m².
    pub fn white(&self) -> f64 {
        self.light.white
    }

    /// True if a part of the scene moves.
    pub fn moves(&self) -> bool {
        !self.surfaces.scene.motions.is_empty()
    }

    /// Observer in the frames of all bodies.
    pub fn observer(&self, observer: &Observer, places: Places) -> LitObserver {
        let bodies = self.bodies.observer(&self.surfaces.scene, observer, places);
        LitObserver { bodies, irradiances: self.surfaces.irradiances(observer, places) }
    }

    /// Place in the scene that is seen in a direction; `None` if no surface is there.
    pub fn place(&self, observer: &LitObserver, seen: DVec3) -> Option<TracedPlace> {
        let there = |hit: &RayHit| self.surfaces.is_there(hit);
        let hit = self.bodies.first(&observer.bodies, seen, &observer.bodies.start(), there)?;
        Some(self.bodies.place(seen, &hit))
    }

    /// Light that is seen in a direction, after up to `bounces` turns of the ray.
    pub fn seen(&self, observer: &LitObserver, seen: DVec3, effects: Effects, bounces: u32) -> ObservedLight {
        let state = LegState { doppler: 1.0, filter: DVec3::ONE, bounces, effects };
        self.along(Leg { observer, seen, start: observer.bodies.start(), state })
    }

    /// Light that comes along a leg.
    fn along(&self, mut leg: Leg<'_>) -> ObservedLight {
        let observer = &leg.observer.bodies;
        let mut light = DVec3::ZERO;
        let mut shines_through = 1.0;
        while shines_through * leg.state.filter.max_element() > HIDDEN {
            let there = |hit: &RayHit| self.surfaces.is_there(hit);
            let Some(found) = self.bodies.first(observer, leg.seen, &leg.start, there) else { break };
            let (opacity, clear, seen) = self.surface(&leg, &found);
            // The luminance at rest is that of a surface without anything mixed from behind it, like in the
            // renderers' targets.
            if opacity >= 1.0 && clear == DVec3::ZERO {
                return ObservedLight { light: light + shines_through * seen.light, at_rest: seen.at_rest };
            }
            light += shines_through * opacity * seen.light;
            if clear == DVec3::ZERO {
                shines_through *= 1.0 - opacity;
            } else {
                leg.state.filter *= clear * opacity + (1.0 - opacity);
            }
            leg.start = self.bodies.beyond(observer, leg.seen, &found);
        }
        let (direction, doppler) = observer.world(leg.seen);
        let sent = self.surfaces.sky(direction, self.background).dimmed(1.0, leg.state.filter);
        let seen = self.light.observed(&sent, leg.state.effects, leg.state.doppler * doppler);
        ObservedLight { light: light + shines_through * seen.light, ..seen }
    }

    /// Opacity of a surface, filter of the light that it lets through straight on, and its own light.
    fn surface(&self, leg: &Leg<'_>, found: &FirstHit) -> (f64, DVec3, ObservedLight) {
        let scene = &self.surfaces.scene;
        let LitObserver { bodies: observer, irradiances } = leg.observer;
        let state = LegState { doppler: leg.state.doppler * found.doppler, ..leg.state };
        let emission = self.bodies.emission(scene, observer, found);
        let (opacity, sent) = self.surfaces.light(&found.hit, emission, irradiances, &self.bodies, &self.light);
        // No light brings what is measured, so nothing turns it.
        let turns = state.bounces > 0 && state.effects.places != Places::Measured;
        let finish = if turns { self.surfaces.finish(&found.hit) } else { None };
        let Some(finish) = finish else {
            let sent = sent.dimmed(1.0, state.filter);
            return (opacity, DVec3::ZERO, self.light.observed(&sent, state.effects, state.doppler));
        };

        // Find what a smooth surface turns.
        let turn = self.bodies.turn(scene, observer, leg.seen, found);
        let (normal, plane) = (self.surfaces.normal(&found.hit), found.hit.facing());
        let front = found.hit.front;
        let cosine = normal.dot(-turn.direction).clamp(0.0, 1.0);
        let Shares { mirrored: share_mirrored, through, diffuse } = finish.shares(cosine, front);
        let sent = sent.dimmed(diffuse, state.filter);
        let mut seen = self.light.observed(&sent, state.effects, state.doppler);

        // Follow the turned rays.
        let turned = |direction: DVec3| Turn { direction, ..turn };
        let further = |share: DVec3| LegState { filter: state.filter * share, bounces: state.bounces - 1, ..state };
        seen += self.onward(turned(mirrored(turn.direction, normal, plane)), further(share_mirrored));
        if !finish.solid {
            return (opacity, through, seen);
        }
        if let Some(direction) = refracted(turn.direction, normal, finish.beyond(front)) {
            let (turn, state) = (turned(direction), further(through));
            seen += if front { self.within(turn, state, finish.index) } else { self.onward(turn, state) };
        }
        (opacity, DVec3::ZERO, seen)
    }

    /// Light from the direction into which a surface has turned a ray.
    fn onward(&self, turn: Turn, state: LegState) -> ObservedLight {
        if state.filter.max_element() <= HIDDEN {
            return ObservedLight::default();
        }
        let places = state.effects.places;
        let (bodies, seen, start) = self.bodies.onward(&self.surfaces.scene, &turn, places);
        let irradiances = self.surfaces.irradiances(&bodies.observer, places);
        self.along(Leg { observer: &LitObserver { bodies, irradiances }, seen, start, state })
    }

    /// Light that comes through glass, for a ray inside it. Light is slower there by the index of refraction, in the
    /// glass's own frame. The ray meets only triangles of the same body.
    fn within(&self, mut turn: Turn, mut state: LegState, index: f64) -> ObservedLight {
        let mut sum = ObservedLight::default();
        while state.filter.max_element() > HIDDEN {
            let Some(hit) = self.bodies.within(&turn, |hit| self.surfaces.is_there(hit)) else {
                return sum + self.onward(turn, state);
            };
            turn.position = hit.position;
            if state.effects.bend() {
                turn.emission.ct -= index * hit.distance;
            }
            if self.surfaces.finish(&hit).is_none_or(|finish| !finish.solid) {
                let observer = self.bodies.in_world(&self.surfaces.scene, turn.emission, turn.position);
                let irradiances = self.surfaces.irradiances(&observer, state.effects.places);
                let (_, sent) = self.surfaces.light(&hit, turn.emission, &irradiances, &self.bodies, &self.light);
                let sent = sent.dimmed(1.0, state.filter);
                return sum + self.light.observed(&sent, state.effects, state.doppler);
            }
            let (normal, plane) = (self.surfaces.normal(&hit), hit.facing());
            let reflected = fresnel(normal.dot(-turn.direction).clamp(0.0, 1.0), 1.0 / index);
            if let Some(direction) = refracted(turn.direction, normal, 1.0 / index) {
                let state = LegState { filter: state.filter * (1.0 - reflected), ..state };
                sum += self.onward(Turn { direction, ..turn }, state);
            } else if state.bounces == 0 {
                // No turn is left, so the ray goes straight on.
                return sum + self.onward(turn, state);
            }
            if state.bounces == 0 {
                return sum;
            }
            state = LegState { filter: state.filter * reflected, bounces: state.bounces - 1, ..state };
            turn.direction = mirrored(turn.direction, normal, plane);
        }
        sum
    }
}
