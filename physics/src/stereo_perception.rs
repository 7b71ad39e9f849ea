//! Stereo perception: the place at which two eyes together see a moving source.
//!
//! Stereo vision intersects the two sight lines. But light that reaches both eyes at once left a moving source at two
//! different places, so the lines point at two retarded positions. Unless the motion keeps to a plane through both
//! eyes, the lines do not even meet: the source is then perceived midway between them where they come closest (B 3.4).

use glam::DVec3;
use thiserror::Error;

use crate::apparent::{self, PointSource};
use crate::celerity::{Celerity, unit_vector};
use crate::event::Event;
use crate::observer::Observer;

/// A place perceived by both eyes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StereoPerception {
    /// Middle of the shortest line between the two sight lines, metres. Behind the eyes if the lines diverge.
    pub position: DVec3,
    /// Length of that line, metres; where it is large, two images are seen.
    pub gap: f64,
}

/// The place at which two eyes perceive a source in uniform motion.
///
/// *Frames, units:* everything in the rest frame of the observer, in metres: places of the eyes, the source at time 0
/// and its celerity, and the `time` at which the light reaches both eyes.
///
/// *Equation:* the sight lines run through the retarded positions of B eq. 3.5.
///
/// *Accuracy:* the rounding of a sight line over the angle between the lines.
///
/// # Errors
///
/// An input is not finite, the eyes are at one place, the source is seen at an eye, or the sight lines are parallel.
pub fn perceived_place(
    eyes: [DVec3; 2],
    source: &PointSource,
    time: f64,
) -> Result<StereoPerception, StereoPerceptionError> {
    /// Largest sine that the rounding of two parallel unit vectors can make.
    const PARALLEL: f64 = 4.0 * f64::EPSILON;
    if !(eyes.iter().all(|eye| eye.is_finite()) && source.position.is_finite() && time.is_finite()) {
        return Err(StereoPerceptionError::NotFinite);
    }
    let baseline = eyes[1] - eyes[0];
    if baseline == DVec3::ZERO {
        return Err(StereoPerceptionError::EyesCoincide { position: eyes[0] });
    }
    let [first, second] = [sight_line(eyes[0], source, time)?, sight_line(eyes[1], source, time)?];
    let normal = first.cross(second);
    let sine_squared = normal.length_squared();
    if sine_squared <= PARALLEL * PARALLEL {
        return Err(StereoPerceptionError::Parallel { direction: first });
    }
    // Find both feet of the common perpendicular.
    let along_first = baseline.cross(second).dot(normal) / sine_squared;
    let along_second = baseline.cross(first).dot(normal) / sine_squared;
    let feet = [eyes[0] + first * along_first, eyes[1] + second * along_second];
    Ok(StereoPerception { position: feet[0].midpoint(feet[1]), gap: baseline.dot(normal).abs() / sine_squared.sqrt() })
}

/// Direction in which an eye at rest sees the source.
fn sight_line(eye: DVec3, source: &PointSource, time: f64) -> Result<DVec3, StereoPerceptionError> {
    let observer = Observer { event: Event { ct: time, position: eye }, celerity: Celerity::ZERO };
    let seen = apparent::moving(&observer, source);
    unit_vector(seen.position).ok_or(StereoPerceptionError::SourceAtEye { position: eye })
}

/// The reasons why nothing is perceived at one place.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum StereoPerceptionError {
    /// A place or the time is infinite or not a number.
    #[error("the places of eyes and source and the time must all be finite")]
    NotFinite,
    /// Eyes at one place, which see no depth.
    #[error("both eyes are at {position}; they must be apart")]
    EyesCoincide {
        /// Position of both eyes, metres.
        position: DVec3,
    },
    /// A source whose light left it at the eye itself, so that it has no direction.
    #[error("the source is at the eye at {position} when its light is seen there, so it is seen in no direction")]
    SourceAtEye {
        /// Position of the eye, metres.
        position: DVec3,
    },
    /// Sight lines without a closest point.
    #[error("both eyes see the source in the direction {direction}; parallel sight lines give no distance")]
    Parallel {
        /// Common direction of the sight lines.
        direction: DVec3,
    },
}
