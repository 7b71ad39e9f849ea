//! Hits of a ray of light: plain data that the tracer's parts hand to each other.

use glam::DVec3;

/// Point of a triangle that a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct RayHit {
    /// Index into the scene's meshes.
    pub mesh: usize,
    /// Indices of the corners into the mesh's vertices.
    pub corners: [usize; 3],
    /// Share of each corner at the point.
    pub weights: [f64; 3],
    /// Position in the body's frame, metres relative to the scene's origin.
    pub position: DVec3,
    /// Distance from the beginning of the ray, metres in the body's frame.
    pub distance: f64,
    /// Vector along the normal of the triangle's front, of any length.
    pub plane: DVec3,
    /// True if the ray meets the front.
    pub front: bool,
}

impl RayHit {
    /// Unit normal of the triangle, on the visible side.
    pub fn facing(&self) -> DVec3 {
        let plane = self.plane.normalize_or_zero();
        if self.front { plane } else { -plane }
    }
}

/// First hit of a ray among all bodies.
#[derive(Clone, Copy, Debug)]
pub struct FirstHit {
    /// Point that the ray meets.
    pub hit: RayHit,
    /// Doppler factor ν_observed / ν_emitted.
    pub doppler: f64,
    /// Index into the bodies.
    pub body: usize,
    /// Apparent distance, metres in the observer's frame.
    pub apparent: f64,
    /// Metres of the body's time for each metre of the ray: −1 for light that is followed back.
    pub time: f64,
}

/// Place in the scene that a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracedPlace {
    /// Position, metres relative to the scene's origin; for a moving body, in its own frame.
    pub position: DVec3,
    /// Index into the scene's motions; `None` for the resting scene.
    pub motion: Option<usize>,
    /// Apparent position relative to the observer, observer's axes, metres.
    pub apparent: DVec3,
    /// Doppler factor ν_observed / ν_emitted.
    pub doppler: f64,
}

/// Time at which light leaves a body, by that body's clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Index into the bodies.
    pub body: usize,
    /// Time in the body's frame, metres of light travel; for animated bodies, in the world's.
    pub ct: f64,
}

/// Turn of a ray at a surface, in the surface's own frame.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Time at which the light left.
    pub emission: Emission,
    /// Place of the turn, metres relative to the scene's origin.
    pub position: DVec3,
    /// Direction of the ray away from the observer, against the light's way.
    pub direction: DVec3,
}
