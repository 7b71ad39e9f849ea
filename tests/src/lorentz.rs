//! Lorentz transformations in their textbook form: 4 × 4 matrices on (ct, x, y, z), multiplied out.
//!
//! The program never uses this form, since it cancels at high speeds; at moderate ones it is an independent check.

use glam::{DMat3, DMat4, DQuat, DVec3, DVec4};

/// Boost into the frame of a body with celerity `u`, axes kept (Jackson, eq. 11.98).
pub fn boost(u: DVec3) -> DMat4 {
    let gamma = (1.0 + u.length_squared()).sqrt();
    let column = |axis: DVec3| (-u.dot(axis), axis + u * (u.dot(axis) / (1.0 + gamma)));
    let columns = DVec3::AXES.map(|axis| {
        let (time, space) = column(axis);
        DVec4::new(time, space.x, space.y, space.z)
    });
    DMat4::from_cols(DVec4::new(gamma, -u.x, -u.y, -u.z), columns[0], columns[1], columns[2])
}

/// Matrix of a rotation in space.
pub fn rotation(turn: DQuat) -> DMat4 {
    let columns = DVec3::AXES.map(|axis| {
        let turned = turn * axis;
        DVec4::new(0.0, turned.x, turned.y, turned.z)
    });
    DMat4::from_cols(DVec4::X, columns[0], columns[1], columns[2])
}

/// Four-vector with this time and space part.
pub fn four(ct: f64, space: DVec3) -> DVec4 {
    DVec4::new(ct, space.x, space.y, space.z)
}

/// Space part of a four-vector.
pub fn space(vector: DVec4) -> DVec3 {
    DVec3::new(vector.y, vector.z, vector.w)
}

/// Celerity and rotation of a transformation that is a boost followed by a rotation.
pub fn parts(transformation: DMat4) -> (DVec3, DQuat) {
    let row = transformation.transpose().x_axis;
    let celerity = -space(row);
    let turn = transformation * boost(-celerity);
    let columns = [turn.y_axis, turn.z_axis, turn.w_axis].map(space);
    (celerity, DQuat::from_mat3(&DMat3::from_cols(columns[0], columns[1], columns[2])))
}
