//! Directions and places of an MPCDI file: frusta, coordinate frames, units, origins.
//!
//! *Frames.* The file's angles turn a viewer who looks ahead: yaw to the right, pitch up, roll clockwise, in this
//! order, each about the axes as the turns before have left them (MPCDI 2.0, 2.2 and table 2-1). A coordinate frame
//! names the file's own axes by three unit vectors along an aeroplane's axes: pitch to the right, yaw down, roll ahead
//! (figure 2-2). Without one, as in profile a3, y is up, x to the *left*, and z into the screen.

use super::xml;
use crate::turning::room_from_turned;
use glam::{DMat3, DVec2, DVec3};
use roxmltree::Node;
use view::Tangents;

/// Largest error of a coordinate frame's vectors: of their lengths, and of the cosines between them.
const TOLERANCE: f64 = 1e-2;

/// Rotation from the axes of a frustum's picture (x right, y up, −z ahead) to those of the file's viewer, and the
/// picture's rectangle one unit ahead.
pub(super) fn frustum(region: Node<'_, '_>) -> Result<(DMat3, Tangents), String> {
    let node = xml::first(region, "frustum").ok_or("it has no <frustum>, and its profile needs one")?;
    let [yaw, pitch, roll] = numbers(node, ["yaw", "pitch", "roll"])?;
    let angles = numbers(node, ["leftAngle", "rightAngle", "downAngle", "upAngle"])?;
    let [left, right, down, up] = angles;
    if angles.iter().any(|angle| angle.abs() >= 90.0) || left >= right || down >= up {
        return Err(format!(
            "its angles are {left}° to {right}° and {down}° to {up}°; leftAngle must be less than rightAngle, downAngle \
             less than upAngle, and all between -90° and 90°"
        ));
    }
    let tangent = |angle: f64| angle.to_radians().tan();
    let tangents =
        Tangents { low: DVec2::new(tangent(left), tangent(down)), high: DVec2::new(tangent(right), tangent(up)) };
    Ok((room_from_turned(-yaw, pitch, -roll), tangents))
}

/// Rotation from the file's axes to the room's.
pub(super) fn room_from_file(region: Node<'_, '_>) -> Result<DMat3, String> {
    let node = frame(region)?;
    let [right, down, ahead] = [["pitchx", "pitchy", "pitchz"], ["yawx", "yawy", "yawz"], ["rollx", "rolly", "rollz"]]
        .map(|names| numbers(node, names).map(DVec3::from));
    let (right, down, ahead) = (right?, down?, ahead?);
    let long = [right, down, ahead].iter().any(|axis| (axis.length() - 1.0).abs() > TOLERANCE);
    if long || [right.dot(down), down.dot(ahead), ahead.dot(right)].iter().any(|cosine| cosine.abs() > TOLERANCE) {
        return Err(format!(
            "its coordinateFrame has pitch {right}, yaw {down}, roll {ahead}; they must be unit vectors at right angles"
        ));
    }
    Ok(DMat3::from_cols(right, -down, -ahead).transpose())
}

/// Place of the projector, the file's axes and units.
pub(super) fn position(region: Node<'_, '_>) -> Result<DVec3, String> {
    numbers(frame(region)?, ["posx", "posy", "posz"]).map(DVec3::from)
}

fn frame<'a>(region: Node<'a, 'a>) -> Result<Node<'a, 'a>, String> {
    Ok(xml::first(region, "coordinateFrame").ok_or("it has no <coordinateFrame>, and profile sl needs one")?)
}

fn numbers<const N: usize>(node: Node<'_, '_>, names: [&'static str; N]) -> Result<[f64; N], String> {
    let mut found = [0.0; N];
    for (number, name) in found.iter_mut().zip(names) {
        let text = xml::text(node, name).ok_or_else(|| format!("{}: it has no <{name}>", xml::place(node)))?;
        *number = text
            .parse()
            .ok()
            .filter(|number: &f64| number.is_finite())
            .ok_or_else(|| format!("{}: <{name}> {text:?} is no number", xml::place(node)))?;
    }
    Ok(found)
}

/// Length of a geometric unit, metres; `None` for a unit that is not known.
pub(super) fn metres(unit: &str) -> Option<f64> {
    Some(match unit.to_ascii_lowercase().as_str() {
        "mm" => 1e-3,
        "cm" => 1e-2,
        "dm" => 1e-1,
        "m" => 1.0,
        "in" => 0.0254,
        "ft" => 0.3048,
        "yd" => 0.9144,
        _ => return None,
    })
}
