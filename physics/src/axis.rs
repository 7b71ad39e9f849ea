//! The axis of a boost: the split of a vector into parts along and across the motion, and the effect of the boost on
//! light.
//!
//! A boost multiplies the light-cone coordinate t + h by e^(−η), t − h by e^η, and leaves the part across alone. In
//! these coordinates nothing cancels if the split itself does not. Therefore the direction of motion is held to about
//! 106 bits, and the part across is formed as e × (d × e), which keeps its relative precision however close d is to
//! the axis.

use glam::DVec3;

use crate::celerity::Celerity;
use crate::double_double::{DoubleDouble, DoubleDoubleVec3};
use crate::light_cone::LightConeCoordinates;

/// The direction and size of a celerity, prepared for use on many vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoostAxis {
    /// Unit vector e of the motion; +x for an observer at rest, for whom any direction serves.
    pub(crate) direction: DoubleDoubleVec3,
    /// Magnitude w = |u| of the celerity.
    pub(crate) magnitude: f64,
    /// κ = γ + w = e^η, the Doppler factor dead ahead.
    pub(crate) kappa: f64,
}

/// A vector split by an [`BoostAxis`].
pub(crate) struct Split {
    /// Part along the motion, h = e·d.
    pub(crate) along: DoubleDouble,
    /// Part across the motion, d − h e, to its own relative precision.
    pub(crate) across: DVec3,
}

/// A point of a world at rest and its image for the moving observer.
pub(crate) struct Image {
    /// Apparent position relative to the observer, in the observer's frame.
    pub(crate) position: DVec3,
    /// Length of the position.
    pub(crate) distance: f64,
    /// Distance r of the point in the world.
    pub(crate) world_distance: f64,
    /// D = distance / world_distance.
    pub(crate) doppler: f64,
}

impl Image {
    /// The unit vector towards the image; zero for a point at the eye.
    pub(crate) fn direction(&self) -> DVec3 {
        if self.distance == 0.0 { DVec3::ZERO } else { self.position / self.distance }
    }
}

impl BoostAxis {
    pub(crate) fn new(celerity: Celerity) -> Self {
        let magnitude = celerity.magnitude();
        let direction = unit(celerity.vector());
        Self { direction, magnitude, kappa: celerity.kappa() }
    }

    /// The axis of the opposite motion.
    pub(crate) fn reversed(self) -> Self {
        Self { direction: -self.direction, ..self }
    }

    /// Splits a vector into its parts along and across the axis.
    pub(crate) fn split(&self, vector: DoubleDoubleVec3) -> Split {
        let along = self.direction.dot(vector);
        let normal = vector.cross(self.direction);
        Split { along, across: self.direction.high.cross(normal) }
    }

    /// The image of a point at rest in the world.
    ///
    /// *Frames:* `displacement` from the observer to the point, world axes; the image in the axes of the pure boost.
    ///
    /// *Equation:* the light that arrives now left the point r ago, and (−r, d) boosts to (−|x'|, x'). With h the part
    /// along and d⊥ the part across, x' = d⊥ + h' e and |x'| = r', h' and r' from the boosted light-cone coordinates of
    /// [`crate::light_cone`].
    ///
    /// *Accuracy:* a few units in the last place in distance and Doppler factor and 1e-15 rad in direction, for every
    /// direction and γ to 1e12 (`tests/physics/high_precision.rs`). A point nearer than 1e-308 is at the eye: its
    /// image is zero and D = γ.
    pub(crate) fn image(&self, displacement: DoubleDoubleVec3) -> Image {
        let scale = power_of_two_below(displacement.high.abs().max_element());
        if scale == 0.0 {
            let gamma = 0.5 * (self.kappa + 1.0 / self.kappa);
            return Image { position: DVec3::ZERO, distance: 0.0, world_distance: 0.0, doppler: gamma };
        }
        if self.magnitude == 0.0 {
            let position = displacement.rounded();
            let distance = scale * (position / scale).length();
            return Image { position, distance, world_distance: distance, doppler: 1.0 };
        }
        // Scale by a power of two, which rounds nothing, so that no square overflows.
        let unscaled = displacement.times_power_of_two(1.0 / scale);
        let split = self.split(unscaled);
        let along = split.along.rounded();
        let across_squared = split.across.length_squared();
        let distance = (along * along + across_squared).sqrt();
        // Boost the light-cone coordinates: stretch one, shrink the other.
        let seen = LightConeCoordinates::at_distance(distance, along, across_squared).boosted(self.kappa);
        let image_distance = seen.distance();
        Image {
            position: (split.across + self.direction.high * seen.along()) * scale,
            distance: image_distance * scale,
            world_distance: distance * scale,
            doppler: image_distance / distance,
        }
    }
}

/// The unit vector of `vector` to about 106 bits; +x for the zero vector.
fn unit(vector: DVec3) -> DoubleDoubleVec3 {
    let scale = power_of_two_below(vector.abs().max_element());
    if scale == 0.0 {
        return DVec3::X.into();
    }
    let scaled = DoubleDoubleVec3::from(vector / scale);
    scaled.scaled(DoubleDouble::from(1.0) / scaled.dot(scaled).sqrt())
}

/// The largest power of two not above a non-negative normal number; 0 for a subnormal one.
pub(crate) fn power_of_two_below(value: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(value.to_bits() & EXPONENT)
}
