//! Sheets that bend in one direction: a profile of height and depth, rounded at its corners, carried along x.

use super::mesh::MeshSurface;
use glam::{DVec2, DVec3};
use thiserror::Error;

/// Largest angle of the chords into which rounded corners are cut, radians: 0.5 mm from the arc at a radius of half a
/// metre.
const CHORD_RAD: f64 = 0.0873;

/// Profile from which no sheet can be made.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SweepError {
    /// Fewer than two points, or two neighbours in one place.
    #[error("a profile needs at least two points, each in a place of its own")]
    TooShort,
    /// A rounding that does not fit on the sides next to its corner.
    #[error(
        "bend = {bend_m} m does not fit at corner {corner} of the profile: it would use up {needed_m:.3} m of each side; make it smaller"
    )]
    TooRound {
        /// Radius of the rounding, metres.
        bend_m: f64,
        /// Number of the profile's point, counted from 1.
        corner: usize,
        /// Distance from the corner to the beginning of the rounding, metres.
        needed_m: f64,
    },
}

/// Mesh of the sheet, with u along x from the left and v along the profile by its length.
///
/// # Arguments
/// * `centre` — origin of `profile`, room axes, metres.
/// * `width_m` — width along x, metres, half of it on either side of `centre`.
/// * `profile` — (y, z) in metres from the lower edge to the upper.
/// * `bend_m` — radius of the rounding at the profile's inner corners, metres; 0 leaves them sharp.
///
/// # Errors
/// [`SweepError`].
pub fn sweep(centre: DVec3, width_m: f64, profile: &[DVec2], bend_m: f64) -> Result<MeshSurface, SweepError> {
    let line = rounded(profile, bend_m)?;

    // Each row's v is its length along the profile, and there is a row at every corner of the line.
    let mut along = vec![0.0];
    for pair in line.windows(2) {
        along.push(along[along.len() - 1] + pair[0].distance(pair[1]));
    }
    let whole = along[along.len() - 1];
    let (mut points, mut uvs) = (Vec::new(), Vec::new());
    for (place, along) in line.iter().zip(&along) {
        for u in [0.0, 1.0] {
            points.push(centre + DVec3::new((u - 0.5) * width_m, place.x, place.y));
            uvs.push(DVec2::new(u, along / whole));
        }
    }
    let triangles: Vec<[u32; 3]> = (0..line.len() as u32 - 1)
        .map(|row| 2 * row)
        .flat_map(|first| [[first, first + 1, first + 3], [first, first + 3, first + 2]])
        .collect();
    Ok(MeshSurface::new(points, uvs, &triangles))
}

/// Profile with rounded corners, as a line of points (y, z), metres.
fn rounded(profile: &[DVec2], bend_m: f64) -> Result<Vec<DVec2>, SweepError> {
    if profile.len() < 2 || profile.windows(2).any(|pair| pair[0].distance(pair[1]) <= 0.0) {
        return Err(SweepError::TooShort);
    }
    let mut line = vec![profile[0]];
    for (index, corner) in profile.windows(3).enumerate() {
        let [before, at, after] = [corner[0], corner[1], corner[2]];
        let (back, ahead) = ((before - at).normalize(), (after - at).normalize());
        let turn = std::f64::consts::PI - back.angle_to(ahead).abs();
        let needed_m = bend_m * (0.5 * turn).tan();

        // Each corner may use half of a side; on the first and the last side it may use the whole.
        let room = |side: f64, whole: bool| if whole { side } else { 0.5 * side };
        let first = room(before.distance(at), index == 0);
        let last = room(at.distance(after), index + 3 == profile.len());
        if needed_m.is_nan() || needed_m > first.min(last) {
            return Err(SweepError::TooRound { bend_m, corner: index + 2, needed_m });
        }
        if needed_m <= 0.0 {
            line.push(at);
            continue;
        }
        let middle = at + (back + ahead).normalize() * (bend_m / (0.5 * turn).cos());
        let (from, to) = (at + back * needed_m - middle, at + ahead * needed_m - middle);
        let steps = (turn / CHORD_RAD).ceil();
        let signed = from.angle_to(to);
        line.extend(
            (0..=steps as u32).map(|step| middle + DVec2::from_angle(signed * f64::from(step) / steps).rotate(from)),
        );
    }
    line.push(profile[profile.len() - 1]);
    line.dedup_by(|a, b| a.distance(*b) < 1e-12);
    Ok(line)
}
