//! Accuracy that the kernel promises, held by `tests/physics/photo_surface_accuracy.rs`.

/// Largest error of a direction up to γ = [`GAMMA`], radians: a few roundings of f32, amplified by 1/D ≤ 4 where the
/// f32 form serves.
pub const DIRECTION_ERROR_RAD: f64 = 7e-7;
/// Largest γ of ordinary accuracy.
pub const GAMMA: f64 = 1e9;
/// Largest error of a direction beyond that, up to γ = 1e12, radians: there the roundings of f64 in d × e show,
/// multiplied by 2γ. Measured 2e-4 at 1e12.
pub const EXTREME_DIRECTION_ERROR_RAD: f64 = 4e-4;

/// Largest error of a direction that the kernel makes at this γ, radians.
pub fn direction_error_rad(gamma: f64) -> f64 {
    if gamma <= GAMMA { DIRECTION_ERROR_RAD } else { EXTREME_DIRECTION_ERROR_RAD }
}
