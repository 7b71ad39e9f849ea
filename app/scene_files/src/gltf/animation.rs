//! Animations: the nodes that keys move, and their keys (glTF 2.0, 3.11).
//!
//! All animations of a file run together, on the world's clock. Only smooth translations and rotations are used: a
//! jump is faster than light, and a change of shape is not a body's motion. Other channels stand still, and a notice
//! names them.

use std::collections::BTreeMap;

use ::gltf::json::accessor::Type;
use ::gltf::json::animation::{Animation, Channel, Interpolation, Property};
use ::gltf::json::validation::Checked;
use glam::{DQuat, DVec3};

use super::accessor::{self, Purpose};
use super::container::Document;
use super::error::GltfError;
use super::notices::Notices;
use scene::motion::{KeyFault, TrackKeys};

/// Tolerance within which the first and last pose of an animation are equal, so that it repeats; covers f32 rounding
/// and exporters. Metres for each metre of size, and in a rotation's components.
const SAME: f64 = 1e-5;

/// Keys of a node's translation and rotation.
#[derive(Clone, Debug, Default)]
pub(super) struct NodeKeys {
    pub(super) translation: Option<TrackKeys<DVec3>>,
    pub(super) rotation: Option<TrackKeys<DQuat>>,
}

/// Keys of every animated node, by the node's index.
pub(super) fn moved(document: &Document, notices: &mut Notices) -> Result<BTreeMap<usize, NodeKeys>, GltfError> {
    let mut moved = BTreeMap::<usize, NodeKeys>::new();
    for (number, animation) in document.json.animations.iter().enumerate() {
        let of_animation = read(document, number, animation, notices)?;
        if of_animation.is_empty() {
            notices.add("animations stand still".into());
        }
        for (node, channels) in repeated(of_animation) {
            let known = moved.entry(node).or_default();
            let twice = known.translation.is_some() && channels.translation.is_some()
                || known.rotation.is_some() && channels.rotation.is_some();
            if twice {
                notices.add(format!("nodes[{node}] is moved by two animations, of which the first is shown"));
            }
            known.translation = known.translation.take().or(channels.translation);
            known.rotation = known.rotation.take().or(channels.rotation);
        }
    }
    Ok(moved)
}

/// Keys of the nodes that one animation moves.
fn read(
    document: &Document,
    number: usize,
    animation: &Animation,
    notices: &mut Notices,
) -> Result<BTreeMap<usize, NodeKeys>, GltfError> {
    let mut moved = BTreeMap::<usize, NodeKeys>::new();
    for (index, channel) in animation.channels.iter().enumerate() {
        let place = format!("animations[{number}].channels[{index}]");
        let node = channel.target.node.value();
        document.item(&document.json.nodes, node, &format!("{place}.target.node"))?;
        let sampler = document.item(&animation.samplers, channel.sampler.value(), &format!("{place}.sampler"))?;
        let (Checked::Valid(path), Checked::Valid(interpolation)) = (channel.target.path, sampler.interpolation) else {
            return Err(document.damaged(&place, "its path or its interpolation is unknown"));
        };
        let refused = match (path, interpolation) {
            (Property::Scale, _) => Some("changes a scale"),
            (Property::MorphTargetWeights, _) => Some("changes a shape (morph targets)"),
            (_, Interpolation::Step) => Some("jumps (STEP), which is faster than light"),
            _ if document.json.nodes[node].matrix.is_some() => Some("moves a node that has a matrix"),
            _ => None,
        };
        if let Some(refused) = refused {
            notices.add(format!("{place} stands still: it {refused}"));
            continue;
        }
        let fault = |fault: KeyFault| document.damaged(&place, fault.to_string());
        let of_node = moved.entry(node).or_default();
        let cubic = interpolation == Interpolation::CubicSpline;
        if path == Property::Translation {
            let (times, values) = lists::<3>(document, animation, channel, Type::Vec3)?;
            let values = values.into_iter().map(DVec3::from_array);
            let keys = if cubic {
                let (values, tangents) = thirds(values.collect());
                TrackKeys::<DVec3>::cubic(times, values, tangents)
            } else {
                TrackKeys::linear(times, values.collect())
            };
            of_node.translation = Some(keys.map_err(fault)?);
        } else {
            let (times, values) = lists::<4>(document, animation, channel, Type::Vec4)?;
            let values = values.into_iter().map(DQuat::from_array);
            let keys = if cubic {
                let (values, tangents) = thirds(values.collect());
                TrackKeys::cubic_rotation(times, values, tangents)
            } else {
                TrackKeys::slerp(times, values.collect())
            };
            of_node.rotation = Some(keys.map_err(fault)?);
        }
    }
    Ok(moved)
}

/// Times in seconds, and values of `WIDTH` components.
fn lists<const WIDTH: usize>(
    document: &Document,
    animation: &Animation,
    channel: &Channel,
    of: Type,
) -> Result<(Vec<f64>, Vec<[f64; WIDTH]>), GltfError> {
    let sampler = &animation.samplers[channel.sampler.value()];
    let numbers = |index: usize, of, place| accessor::read(document, index, place, Purpose::Vectors(of), |value| value);
    let times = numbers(sampler.input.value(), Type::Scalar, "animations.samplers.input")?.values;
    let values = numbers(sampler.output.value(), of, "animations.samplers.output")?.values;
    Ok((times, values.as_chunks::<WIDTH>().0.to_vec()))
}

/// Separates triples (slope into a key, its value, slope out of it) into values and slopes.
fn thirds<V: Copy>(values: Vec<V>) -> (Vec<V>, Vec<[V; 2]>) {
    values.as_chunks::<3>().0.iter().map(|[into, value, out]| (*value, [*into, *out])).unzip()
}

/// Makes an animation that ends as it began repeat for ever; leaves any other as it is.
fn repeated(mut moved: BTreeMap<usize, NodeKeys>) -> BTreeMap<usize, NodeKeys> {
    let spans = moved.values().flat_map(|of_node| {
        [of_node.translation.as_ref().map(TrackKeys::span_s), of_node.rotation.as_ref().map(TrackKeys::span_s)]
    });
    let whole = spans.flatten().reduce(|[from, to], [first, last]| [from.min(first), to.max(last)]);
    let Some(whole) = whole.filter(|[from, to]| from < to) else { return moved };
    let same_place = |keys: &TrackKeys<DVec3>| {
        let [first, last] = keys.ends();
        first.distance(last) <= SAME * (1.0 + first.length())
    };
    let same_turn = |keys: &TrackKeys<DQuat>| {
        let [first, last] = keys.ends().map(DQuat::normalize);
        (1.0 - first.dot(last).abs()) <= SAME * SAME
    };
    let returns = moved.values().all(|of_node| {
        of_node.translation.as_ref().is_none_or(same_place) && of_node.rotation.as_ref().is_none_or(same_turn)
    });
    if returns {
        for of_node in moved.values_mut() {
            of_node.translation = of_node.translation.take().map(|keys| {
                let [first, _] = keys.ends();
                keys.repeating(whole, first)
            });
            of_node.rotation = of_node.rotation.take().map(|keys| {
                // Both signs of a quaternion are the same rotation. The sign of the last key must stay, as it fixes
                // the way there.
                let [first, last] = keys.ends();
                keys.repeating(whole, if first.dot(last) < 0.0 { -first } else { first })
            });
        }
    }
    moved
}
