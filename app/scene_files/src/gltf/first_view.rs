//! First view of a scene: where an observer starts, what is seen from there, and how fast light is.
//!
//! A file that says where to start is taken at its word: its own `extras.rapidity.start`, then its first perspective
//! camera. Any other scene is looked at as viewers do, from outside and whole, whatever its size; unless it has a
//! floor that a person could stand on, where the observer stands. The speed of light follows from the size: slow
//! enough that effects are seen within seconds.

use ::gltf::json;
use ::gltf::json::validation::Checked;
use glam::DVec3;
use scene::motion::CameraMotion;
use scene::{Scene, Start, ViewCamera};
use std::sync::Arc;

use super::document::Document;
use super::extras::SceneExtras;
use super::floor;
use super::nodes::{NodeMotion, NodePlacement};
use super::notices::{Notices, Part};
use super::start_pose::at_start;

/// Time in which light crosses a scene by default, seconds.
const CROSSING_S: f64 = 5.0;

/// Factor by which light is faster than everything that is animated: at a fifth of its speed a body at rest in the
/// picture is still recognised.
const FASTER_THAN_ANIMATIONS: f64 = 5.0;

/// Length of the mean direction of all faces from which on a scene has a front.
const HAS_A_FRONT: f64 = 0.5;

/// Vertical field of view for which scenes are framed, radians: that of a picture without options.
const FIELD_OF_VIEW_RAD: f64 = std::f64::consts::FRAC_PI_3;

/// Width over height of the narrowest picture in which the whole of a framed scene is seen.
const ASPECT: f64 = 4.0 / 3.0;

/// Share of the picture's height and width that a framed scene may fill.
const FILLED: f64 = 0.85;

/// Height of the eye over the middle of a framed scene, and its distance to the right, as tangents at that middle: a
/// look from slightly above and from one side shows the shape.
const FROM_ABOVE: f64 = 0.4;
const FROM_THE_RIGHT: f64 = 0.6;

/// Tangent of the height from which flat-lying scenes, such as terrain, are looked at.
const FROM_HIGH_ABOVE: f64 = 0.7;

/// Height of a scene, as a share of its width, below which it counts as lying flat.
const FLAT: f64 = 0.15;

/// Places from which a scene may be seen, by its cameras. Orthographic ones give place and direction only.
pub(super) fn cameras(document: &Document<'_>, placements: &[NodePlacement], notices: &mut Notices) -> Vec<ViewCamera> {
    let mut found = Vec::new();
    for placement in placements {
        let Some(index) = placement.camera else { continue };
        let node = &document.json.nodes[placement.node];
        let Some(camera) = document.json.cameras.get(index) else {
            let fault = format!("there is no number {index} among {}", document.json.cameras.len());
            notices.left_out(Part::Node, &format!("nodes[{}].camera", placement.node), &fault);
            continue;
        };
        let named = camera.name.as_deref().or(node.name.as_deref()).filter(|name| !name.is_empty());
        let name = &named.map_or_else(|| format!("camera {index}"), str::to_owned);
        let perspective =
            camera.perspective.as_ref().filter(|_| camera.type_ != Checked::Valid(json::camera::Type::Orthographic));
        if perspective.is_none() {
            notices.add(format!("the camera \"{name}\" is not perspective: only its place and direction are used"));
        }
        let fov = perspective.map(|perspective| f64::from(perspective.yfov));
        let transform = at_start(placement);
        let axes = transform.matrix3;
        found.push(ViewCamera {
            name: name.clone(),
            start: Start {
                position: transform.translation,
                look: (axes * DVec3::NEG_Z).normalize_or(DVec3::NEG_Z),
                up: (axes * DVec3::Y).normalize_or(DVec3::Y),
                eye_height_m: 0.0,
                field_of_view_rad: fov.filter(|fov| (0.01..3.0).contains(fov)),
            },
            motion: motion(placement),
        });
    }
    // The view that a file opens on is that of its first perspective camera.
    found.sort_by_key(|camera| camera.start.field_of_view_rad.is_none());
    found
}

/// Motion of a camera that hangs on what keys move.
fn motion(placement: &NodePlacement) -> Option<CameraMotion> {
    match &placement.motion {
        Some(NodeMotion::Animated { animated, body_from_node }) => {
            Some(CameraMotion::new(Arc::clone(animated), *body_from_node))
        }
        _ => None,
    }
}

/// Start of an observer, and the speed of light in m/s that suits the size, if the file does not say where to start.
/// `bounds`: least and greatest corner in the file's frame.
pub(super) fn first_view(scene: &Scene, extras: &SceneExtras, bounds: Option<[DVec3; 2]>) -> (Start, Option<f64>) {
    if let Some(start) = extras.start {
        return (start, extras.speed_of_light);
    }
    let Some(bounds) = bounds else { return (Start::default(), extras.speed_of_light) };
    let [least, most] = with_paths(scene, bounds);
    let light = extras.speed_of_light.or_else(|| speed_of_light(most - least, fastest_m_s(scene)));
    if let Some(camera) = scene.cameras.first().filter(|camera| camera.start.field_of_view_rad.is_some()) {
        return (camera.start, light);
    }
    let start = floor::start(scene, bounds).unwrap_or_else(|| framed([least, most], facing(scene)));
    (start, light)
}

/// Box round a scene and the paths of what is animated in it, as far as these are not much larger than the scene.
fn with_paths(scene: &Scene, [least, most]: [DVec3; 2]) -> [DVec3; 2] {
    /// Largest size of a path, as a multiple of the scene's own, that the first view takes in.
    const LARGEST: f64 = 10.0;
    let size = (most - least).length();
    let meshes = scene.moving_meshes();
    let paths = meshes.iter().enumerate().filter_map(|(motion, meshes)| scene.path_bounds(motion, meshes));
    let near = paths.filter(|[from, to]| size > 0.0 && (*to - *from).length() <= LARGEST * size);
    near.fold([least, most], |[least, most], [from, to]| [least.min(from), most.max(to)])
}

/// Largest speed of what is animated, m/s.
fn fastest_m_s(scene: &Scene) -> f64 {
    let meshes = scene.moving_meshes();
    let speed = |(number, meshes): (usize, &Vec<usize>)| {
        scene.motions[number].animated().map(|body| scene.fastest(number, meshes).beta * body.speed_of_light_m_s())
    };
    meshes.iter().enumerate().filter_map(speed).fold(0.0, f64::max)
}

/// Mean direction in which the single-sided triangles of a scene face, weighted by their areas: a unit vector if all
/// face the same way, short if they face all ways.
fn facing(scene: &Scene) -> DVec3 {
    let (mut sum, mut area) = (DVec3::ZERO, 0.0);
    for mesh in scene.meshes.iter().filter(|mesh| mesh.motion.is_none()) {
        let double_sided = scene.materials[mesh.material].double_sided;
        for corners in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize].as_dvec3());
            let face = (b - a).cross(c - a);
            if face.is_finite() {
                area += face.length();
                sum += if double_sided { DVec3::ZERO } else { face };
            }
        }
    }
    if area > 0.0 { sum / area } else { DVec3::ZERO }
}

/// Speed of light that crosses a scene of this size in a few seconds, and leaves its animations slow beside it; m/s,
/// rounded to two digits.
fn speed_of_light(size: DVec3, fastest_m_s: f64) -> Option<f64> {
    let speed = (size.length() / CROSSING_S).max(FASTER_THAN_ANIMATIONS * fastest_m_s);
    // By way of a text, whose digits are those that a person reads.
    let rounded = format!("{speed:.1e}").parse::<f64>().ok()?;
    (rounded.is_finite() && rounded > 0.0).then_some(rounded)
}

/// Start outside a box from where the whole of it is seen, on the side that its faces show, `facing`, if it has one.
pub(super) fn framed([least, most]: [DVec3; 2], facing: DVec3) -> Start {
    let (middle, half) = (0.5 * (least + most), 0.5 * (most - least));
    let flat = half.y < FLAT * half.x.min(half.z);
    let above = if flat { FROM_HIGH_ABOVE } else { FROM_ABOVE };
    // A box without depth, a wall or a picture, is looked at straight.
    let sideways = if half.z < FLAT * half.x.max(half.y) { 0.0 } else { FROM_THE_RIGHT };
    let above = if half.z < FLAT * half.x.max(half.y) && !flat { 0.0 } else { above };
    let mut backward = DVec3::new(sideways, above, 1.0).normalize();
    if facing.length() > HAS_A_FRONT && backward.dot(facing.normalize()) < 0.15 {
        backward = (facing.normalize() + DVec3::new(0.0, 0.2, 0.1)).normalize();
    }
    let upward = if backward.y.abs() > 0.99 { DVec3::NEG_Z } else { DVec3::Y };
    let right = upward.cross(backward).normalize();
    let up = backward.cross(right);

    // The distance at which the outermost corners touch the edges of the picture.
    let edge = FILLED * (0.5 * FIELD_OF_VIEW_RAD).tan();
    let corners = (0..8).map(|corner| {
        let side = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        half * DVec3::new(side(0), side(1), side(2))
    });
    let distance = corners
        .map(|corner| corner.dot(backward) + (corner.dot(right).abs() / ASPECT).max(corner.dot(up).abs()) / edge)
        .fold(0.0, f64::max);
    let distance = if distance > 0.0 { distance } else { 1.0 };
    Start {
        position: middle + backward * distance,
        look: -backward,
        up: upward,
        eye_height_m: 0.0,
        field_of_view_rad: None,
    }
}

#[cfg(test)]
mod tests {
    //! Law: a framed scene of any size is in the picture with all its corners, and fills most of it; light crosses it
    //! in seconds.

    use super::*;

    #[test]
    fn a_framed_box_is_whole_and_large_at_any_size() {
        for size in [1e-4, 0.02, 1.0, 150.0, 4000.0] {
            for shape in [DVec3::ONE, DVec3::new(3.0, 1.0, 0.5), DVec3::new(1.0, 1.0, 0.0), DVec3::new(2.0, 0.01, 2.0)]
            {
                let half = 0.5 * size * shape;
                let middle = DVec3::new(7.0, -3.0, 2.0) * size;
                let start = framed([middle - half, middle + half], DVec3::ZERO);
                let right = start.look.cross(start.up).normalize();
                let up = right.cross(start.look);
                let edge = (0.5 * FIELD_OF_VIEW_RAD).tan();
                let mut filled: f64 = 0.0;
                for corner in 0..8 {
                    let side = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
                    let towards = middle + half * DVec3::new(side(0), side(1), side(2)) - start.position;
                    let depth = towards.dot(start.look);
                    assert!(depth > 0.0);
                    let out = (towards.dot(right) / depth / ASPECT).abs().max((towards.dot(up) / depth).abs()) / edge;
                    assert!(out < 0.9, "a corner of {shape} at {out} of the picture's half");
                    filled = filled.max(out);
                }
                assert!(filled > 0.7, "{shape} fills {filled}");
            }
        }
    }

    #[test]
    fn light_crosses_a_scene_in_seconds() {
        for size in [1e-4, 0.02, 1.0, 150.0, 4000.0] {
            let speed = speed_of_light(DVec3::new(size, 0.0, 0.0), 0.0).unwrap_or_default();
            assert!((4.5..5.6).contains(&(size / speed)), "{size} m at {speed} m/s");
        }
        assert_eq!(speed_of_light(DVec3::ZERO, 0.0), None);
        assert_eq!(speed_of_light(DVec3::X, 3.0), Some(15.0), "animations stay slow beside light");
    }

    #[test]
    fn a_scene_with_a_front_is_seen_from_there() {
        let half = DVec3::new(1.0, 1.0, 0.0);
        for facing in [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_Y, DVec3::Y] {
            let start = framed([-half, half], facing);
            assert!(start.look.dot(facing) < 0.0, "{facing}: {start:?}");
            assert!(start.look.cross(start.up).length() > 0.05, "{facing}: {start:?}");
        }
    }
}
