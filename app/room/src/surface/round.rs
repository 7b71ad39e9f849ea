//! Equations that cylinder and sphere share.

use crate::unit_square::EDGE;
use std::f64::consts::TAU;

/// Solutions of a·t² + 2·b·t + c = 0, the smaller first; NaN if there are none.
///
/// The textbook form cancels for the root near zero, which a projector on a dome's rim has.
pub(super) fn crossings(a: f64, b: f64, c: f64) -> [f64; 2] {
    let root = (b * b - a * c).sqrt();
    let sum = -(b + root.copysign(b));
    let (one, other) = (sum / a, c / sum);
    if one <= other { [one, other] } else { [other, one] }
}

/// Position of a yaw between `left` (0) and `right` (1), counted downwards; `None` outside.
pub(super) fn share(yaw: f64, left: f64, right: f64) -> Option<f64> {
    let width = left - right;
    let slack = EDGE * width;
    let turned = (left - yaw + slack).rem_euclid(TAU) - slack;
    (turned <= width + slack).then(|| (turned / width).clamp(0.0, 1.0))
}
