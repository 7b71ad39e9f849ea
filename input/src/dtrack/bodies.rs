//! Bodies in the lines `6d` and `6di`.

use glam::{DMat3, DQuat, DVec3};

use super::wire::{DtrackError, DtrackStamp, block, count, finite, numbers};
use crate::clock::Nanos;
use crate::head::tracked_pose::TrackedPose;

/// Largest deviation of a rotation matrix's columns from orthonormal; six decimals are sent.
const ORTHONORMAL: f64 = 1e-2;

/// Body of a frame that was seen.
pub(super) struct DtrackBody {
    pub(super) number: i32,
    pub(super) position_mm: DVec3,
    pub(super) rotation: DMat3,
}

impl DtrackBody {
    /// Pose of the body, of which `thing` is the kind.
    pub(super) fn pose(&self, at: Nanos, stamp: DtrackStamp, thing: &'static str) -> Result<TrackedPose, DtrackError> {
        let error = self.rotation.transpose() * self.rotation - DMat3::IDENTITY;
        let largest = error.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
        if largest.is_nan() || largest > ORTHONORMAL || self.rotation.determinant() < 0.0 {
            return Err(DtrackError::Matrix { thing, number: self.number });
        }
        Ok(TrackedPose {
            sensor: self.number,
            at,
            measured_s: stamp.measured_s,
            latency_s: stamp.latency_s,
            position_m: self.position_mm / 1000.0,
            orientation: DQuat::from_mat3(&self.rotation).normalize(),
            velocity_m_s: None,
        })
    }
}

/// Bodies of a `6d` line that were seen.
pub(super) fn bodies(line: &str) -> Result<Vec<DtrackBody>, DtrackError> {
    const BAD: DtrackError =
        DtrackError::Line { line: "6d", expected: "a number of bodies and as many [id quality][6 numbers][9 numbers]" };
    // As ever: a blank stands behind the number.
    let (count, mut rest) = line.trim().split_once(' ').unwrap_or((line.trim(), ""));
    let count: usize = count.parse().map_err(|_| BAD)?;
    let mut bodies = Vec::new();
    let mut found = 0;
    while !rest.trim_start().is_empty() {
        let (number, quality) = block(&mut rest).and_then(|text| text.split_once(' ')).ok_or(BAD)?;
        let number = number.parse().map_err(|_| BAD)?;
        let quality: f64 = quality.trim().parse().map_err(|_| BAD)?;
        let [x, y, z, ..] = block(&mut rest).and_then(numbers::<6>).ok_or(BAD)?;
        let rotation = block(&mut rest).and_then(numbers::<9>).ok_or(BAD)?;
        found += 1;
        if quality >= 0.0 {
            let rotation = DMat3::from_cols_array(&rotation);
            bodies.push(DtrackBody { number, position_mm: DVec3::new(x, y, z), rotation });
        }
    }
    if found == count { Ok(bodies) } else { Err(BAD) }
}

/// Bodies of a `6di` line that were seen, by cameras or by their inertial sensors.
pub(super) fn inertial_bodies(line: &str) -> Result<Vec<DtrackBody>, DtrackError> {
    const BAD: DtrackError = DtrackError::Line {
        line: "6di",
        expected: "a number of bodies and as many [id state drift][3 numbers][9 numbers]",
    };
    let (count, mut rest) = count(line).ok_or(BAD)?;
    let mut bodies = Vec::new();
    let mut found = 0;
    while !rest.trim_start().is_empty() {
        let mut fields = block(&mut rest).ok_or(BAD)?.split_ascii_whitespace();
        let number = fields.next().and_then(|number| number.parse().ok()).ok_or(BAD)?;
        let state: u32 = fields.next().and_then(|state| state.parse().ok()).ok_or(BAD)?;
        fields.next().and_then(finite).ok_or(BAD)?;
        let position_mm = block(&mut rest).and_then(numbers::<3>).map(DVec3::from_array).ok_or(BAD)?;
        let rotation = block(&mut rest).and_then(numbers::<9>).ok_or(BAD)?;
        found += 1;
        if state > 0 {
            bodies.push(DtrackBody { number, position_mm, rotation: DMat3::from_cols_array(&rotation) });
        }
    }
    if found == count { Ok(bodies) } else { Err(BAD) }
}
