//! Turns by yaw, pitch and roll.

use glam::{DMat3, DVec3};

/// Rotation of the axes x (right), y (above) and −z (ahead) by yaw, pitch and roll (degrees; see the [crate](crate)).
pub fn room_from_turned(yaw_deg: f64, pitch_deg: f64, roll_deg: f64) -> DMat3 {
    // Whole quarter turns are exact, so that the walls of a cube close without a gap.
    let turn = |angle_deg: f64| {
        let quarter = (angle_deg / 90.0).round();
        let (sin, cos) = (angle_deg - 90.0 * quarter).to_radians().sin_cos();
        match quarter.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    };
    let ((sy, cy), (sp, cp), (sr, cr)) = (turn(yaw_deg), turn(pitch_deg), turn(roll_deg));
    let yaw = DMat3::from_cols(DVec3::new(cy, 0.0, -sy), DVec3::Y, DVec3::new(sy, 0.0, cy));
    let pitch = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cp, sp), DVec3::new(0.0, -sp, cp));
    let roll = DMat3::from_cols(DVec3::new(cr, sr, 0.0), DVec3::new(-sr, cr, 0.0), DVec3::Z);
    yaw * pitch * roll
}
