//! Paths for tests.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed construction is a failed test")]

use camera_paths::{CameraPath, CameraPathError, PathFile};
use glam::DVec3;

/// Path of a text where light has this speed in all parts, m/s.
pub fn try_path(text: &str, light_m_s: f64) -> Result<CameraPath, CameraPathError> {
    let file = PathFile::parse("path.toml", text)?;
    file.path(&vec![light_m_s; file.scenes().len()])
}

/// Path of a text that is one.
pub fn path(text: &str, light_m_s: f64) -> CameraPath {
    try_path(text, light_m_s).unwrap_or_else(|error| panic!("{error}"))
}

/// Celerity by differences of the place over own time, units of c, and Lorentz factor by those of the world's time.
pub fn by_differences(path: &CameraPath, own_s: f64, light_m_s: f64) -> (DVec3, f64) {
    const STEP_S: f64 = 1e-5;
    let [before, after] = [-STEP_S, STEP_S].map(|step| path.at(own_s + step).gaze.observer.event);
    let metres = 2.0 * STEP_S * light_m_s;
    ((after.position - before.position) / metres, (after.ct - before.ct) / metres)
}

/// Checks at evenly spread moments that celerity and the world's clock are the derivatives of the event.
#[track_caller]
pub fn assert_derivatives(path: &CameraPath, light_m_s: f64, tolerance: f64) {
    for step in 1..200 {
        let own_s = path.length_s() * (f64::from(step) + 0.37) / 200.5;
        let (celerity, gamma) = by_differences(path, own_s, light_m_s);
        let found = path.at(own_s).gaze.observer.celerity;
        let close = found.vector().distance(celerity) <= tolerance * gamma
            && (found.gamma() - gamma).abs() <= tolerance * gamma;
        assert!(close, "at {own_s} s: {} for {celerity}, γ {} for {gamma}", found.vector(), found.gamma());
    }
}
