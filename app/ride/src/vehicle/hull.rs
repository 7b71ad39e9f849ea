//! Hull of a spaceship: a sphere round the pilot's eye that passes through no surface.
//!
//! As with the [soft walls](super::walls) of the ground, the nearer a surface is, the slower it may be approached: with
//! d the clearance left, the celerity into the surface is at most d/T, and the celerity along it is not changed. A step
//! is cut into strides in which the ship's middle cannot reach a surface. If rounding or a second surface has still let
//! it come too near, it is pushed back to its clearance, and loses the celerity into what has pushed it. A ship that
//! begins nearer to a surface than its radius keeps that distance until it goes away.

use glam::DVec3;
use physics::Celerity;
use scene::{Surroundings, Wall};

use super::light_speed::LightSpeed;

/// Time T above, seconds of own time.
const YIELD_S: f64 = 0.25;
/// Distance within which surfaces are looked for at usual speeds, in radii.
const REACH: f64 = 7.5;
/// Longest stride beside a surface, in radii.
const STRIDE: f64 = 0.375;
/// Shortest stride, in radii.
const SHORTEST: f64 = 1.0 / 64.0;
/// Number of corrections. The surfaces of a corner are cleared in turns.
const PUSHES: usize = 32;
/// Accuracy of distances, in radii.
const ROUNDING: f64 = 1e-6;

/// Sphere round the pilot's eye.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hull {
    /// Radius of the sphere, metres.
    pub(super) radius_m: f64,
}

/// End of a stride that is clear of all surfaces.
pub(super) struct Landing {
    /// Place of the ship's middle.
    pub(super) position: DVec3,
    /// Celerity of the ship there.
    pub(super) celerity: DVec3,
    /// Nearest surface there.
    pub(super) surface: Option<Wall>,
}

impl Hull {
    /// Nearest surface that matters for a motion of `distance_m` metres.
    pub(super) fn nearest(self, surroundings: &dyn Surroundings, position: DVec3, distance_m: f64) -> Option<Wall> {
        let reach_m = self.radius_m * REACH;
        surroundings
            .nearest_surface(position, reach_m.max(self.radius_m + distance_m))
            .filter(|surface| surface.distance.is_finite())
    }

    /// Distance that the ship may go in any direction before the next look, metres.
    pub(super) fn stride_m(self, surface: Option<Wall>, distance_m: f64) -> f64 {
        let Some(surface) = surface else { return distance_m };
        let stride = (self.radius_m * STRIDE).min(0.5 * surface.distance).max(self.radius_m * SHORTEST);
        stride.max(surface.distance - self.radius_m)
    }

    /// Celerity without its excess into the surface.
    pub(super) fn slid(self, surface: &Wall, celerity: DVec3, light_speed: LightSpeed) -> DVec3 {
        let allowed = light_speed.celerity((surface.distance - self.radius_m).max(0.0) / YIELD_S);
        let excess = (-celerity.dot(surface.normal) - allowed).max(0.0);
        celerity + surface.normal * excess
    }

    /// Motion of a stride without the part that would lead through the surface.
    pub(super) fn held(self, surface: Option<Wall>, moved: DVec3) -> DVec3 {
        let Some(surface) = surface else { return moved };
        let most_m = (surface.distance - self.radius_m).max(0.5 * surface.distance);
        moved + surface.normal * (-moved.dot(surface.normal) - most_m).max(0.0)
    }

    /// End of a motion to `to`, no nearer to any surface than the radius, or than the start was. `None` if no such end
    /// is found.
    pub(super) fn landed(
        self,
        surroundings: &dyn Surroundings,
        before: Option<Wall>,
        to: DVec3,
        celerity: Celerity,
        distance_m: f64,
    ) -> Option<Landing> {
        let clearance_m = before.map_or(self.radius_m, |surface| surface.distance.min(self.radius_m));
        let (mut position, mut celerity) = (to, celerity.vector());
        for _ in 0..PUSHES {
            let surface = self.nearest(surroundings, position, distance_m);
            match surface {
                Some(near) if near.distance < clearance_m - self.radius_m * ROUNDING => {
                    position += near.normal * (clearance_m - near.distance);
                    celerity += near.normal * (-celerity.dot(near.normal)).max(0.0);
                }
                _ => return Some(Landing { position, celerity, surface }),
            }
        }
        None
    }
}
