//! Steps of turns in the vehicle.

/// Largest step of a turn, degrees.
const LARGEST_DEG: f64 = 180.0;

/// True if turns in steps of this size can be made, degrees; 0 stands for none.
pub(crate) fn is_step(degrees: f64) -> bool {
    (0.0..=LARGEST_DEG).contains(&degrees)
}
