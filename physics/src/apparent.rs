//! Apparent positions: the place in the observer's frame from which a point's light comes, and the light's age and
//! colour shift.
//!
//! Light that arrives now left the source at a retarded event on the observer's past light cone. For a point at rest in
//! the world that event is (−r, d), d being the displacement and r its length; [`crate::aberration`] says how the boost
//! of it is computed. A source in uniform motion has its retarded event found in the world first, at 106 bits, so that
//! a source as fast as the observer keeps all its digits; from there on it is a point at rest. The points of an object,
//! each taken to its apparent position, make up its photo-surface (W 5.1).

use glam::DVec3;

use crate::axis::{BoostAxis, Image, power_of_two_below};
use crate::celerity::Celerity;
use crate::double_double::{DoubleDouble, DoubleDoubleVec3};
use crate::observer::Observer;

/// A point source in uniform motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointSource {
    /// Position at world time 0, metres.
    pub position: DVec3,
    /// Celerity in the world.
    pub celerity: Celerity,
}

/// Appearance of a point to an observer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Apparent {
    /// Apparent position relative to the observer, in the axes of the pure boost into that frame, metres. The light
    /// seen left it.
    pub position: DVec3,
    /// Doppler factor D = ν_observed / ν_emitted.
    pub doppler: f64,
    /// World time ct at which the light was emitted, metres.
    pub emitted_at: f64,
}

/// Appearance of a point that rests in the world.
///
/// *Frames:* `point` in the world.
///
/// *Equation:* the image of d = point − observer, [`Aberration`](crate::aberration::Aberration); emitted at ct − r.
///
/// *Accuracy:* of the displacement, which is formed without rounding: 1e-15 rad, γ to 1e12
/// (`tests/physics/high_precision.rs`). Coordinates up to 1e150 m.
///
/// # Example
///
/// ```
/// use physics::{Celerity, Event, Observer, apparent, glam::DVec3};
/// let observer = Observer { event: Event::default(), celerity: Celerity::new(DVec3::new(0.75, 0.0, 0.0))? };
/// let seen = apparent::at_rest(&observer, DVec3::new(4.0, 0.0, 0.0));
/// assert_eq!(seen.position, DVec3::new(8.0, 0.0, 0.0)); // twice as far ahead: D = 2
/// assert_eq!(seen.emitted_at, -4.0);
/// # Ok::<(), physics::CelerityError>(())
/// ```
pub fn at_rest(observer: &Observer, point: DVec3) -> Apparent {
    let displacement = DoubleDoubleVec3::difference(point, observer.event.position);
    let Image { position, doppler, world_distance, .. } = BoostAxis::new(observer.celerity).image(displacement);
    Apparent { position, doppler, emitted_at: observer.event.ct - world_distance }
}

/// Appearance of a source in uniform motion.
///
/// *Frames:* source and observer in the world.
///
/// *Equation:* let d₀ be the displacement to where the source is at the observer's time. The light left it a proper
/// time l of the source's clock before, with l² + 2 l (u·d₀) − d₀² = 0, at d = d₀ − l u (B eq. 2.22, in celerity). Of
/// the two forms of the positive root the one without a difference is taken. D is that of the observer at d over that
/// of the source at d.
///
/// *Accuracy:* as [`at_rest`] (`tests/physics/high_precision.rs`).
pub fn moving(observer: &Observer, source: &PointSource) -> Apparent {
    let time = DoubleDouble::from(observer.event.ct);
    let celerity = DoubleDoubleVec3::from(source.celerity.vector());
    let gamma = (DoubleDouble::from(1.0) + celerity.dot(celerity)).sqrt();

    // Move the source to the observer's time, and scale by a power of two so that no square overflows.
    let at_zero = DoubleDoubleVec3::difference(source.position, observer.event.position);
    let now = at_zero + celerity.scaled(time / gamma);
    let scale = match power_of_two_below(now.high.abs().max_element()) {
        0.0 => 1.0,
        scale => scale,
    };
    let now = now.times_power_of_two(1.0 / scale);

    // Go back along its worldline to the observer's past light cone.
    let along = celerity.dot(now);
    let squared = now.dot(now);
    let root = (along * along + squared).sqrt();
    let age = if along.high > 0.0 { squared / (along + root) } else { root - along };
    let displacement = (now - celerity.scaled(age)).times_power_of_two(scale);
    let emitted_at = time - gamma * age * scale.into();

    let seen = BoostAxis::new(observer.celerity).image(displacement);
    let sent = BoostAxis::new(source.celerity).image(displacement);
    Apparent { position: seen.position, doppler: seen.doppler / sent.doppler, emitted_at: emitted_at.rounded() }
}
