//! Animations: the nodes that keys move, and their keys (glTF 2.0, 3.11).
//!
//! All animations of a file run together, on the world's clock. Smooth translations, rotations and scalings move a
//! node; a channel that holds one value is a pose, of a shape as well. A jump is faster than light, and stands still,
//! as does a change of shape; a notice names them. Keys at equal times, and values that no time belongs to, are passed
//! over.

use std::collections::BTreeMap;

use ::gltf::json::accessor::Type;
use ::gltf::json::animation::{Animation, Channel, Interpolation, Property};
use ::gltf::json::validation::Checked;
use glam::{DQuat, DVec3};

use super::accessor::{self, Elements, Purpose};
use super::document::Document;
use super::error::GltfError;
use super::notices::{Notices, Part};
use scene::motion::{KeyFault, Track, TrackKeys};

/// Memory of a key, bytes: its time, its value and two slopes, each a quaternion of doubles.
const KEY_BYTES: u64 = 104;

/// Tolerance within which the first and last pose of an animation are equal, so that it repeats; covers f32 rounding
/// and exporters. Metres for each metre of size, and in a rotation's components.
const SAME: f64 = 1e-5;

/// Motion of a node: tracks of its translation, rotation and scale, as far as animations give them.
#[derive(Clone, Debug, Default)]
pub(super) struct NodeKeys {
    pub(super) translation: Option<Track<DVec3>>,
    pub(super) rotation: Option<Track<DQuat>>,
    pub(super) scale: Option<Track<DVec3>>,
}

impl NodeKeys {
    /// True if any quantity changes with time.
    pub(super) fn moves(&self) -> bool {
        matches!(self.translation, Some(Track::Keyed(_)))
            || matches!(self.rotation, Some(Track::Keyed(_)))
            || matches!(self.scale, Some(Track::Keyed(_)))
    }

    /// Takes over what `self` does not have. True if both have the same quantity.
    fn complete(&mut self, other: Self) -> bool {
        let twice = self.translation.is_some() && other.translation.is_some()
            || self.rotation.is_some() && other.rotation.is_some()
            || self.scale.is_some() && other.scale.is_some();
        self.translation = self.translation.take().or(other.translation);
        self.rotation = self.rotation.take().or(other.rotation);
        self.scale = self.scale.take().or(other.scale);
        twice
    }
}

/// Gives nodes whose shape an animation holds the weights of that shape.
pub(super) fn hold_shapes(document: &mut Document<'_>) {
    let mut held = BTreeMap::new();
    for (number, animation) in document.json.animations.iter().enumerate() {
        for (index, channel) in animation.channels.iter().enumerate() {
            let place = format!("animations[{number}].channels[{index}]");
            // Faults are told where the motions are read.
            if channel.target.path == Checked::Valid(Property::MorphTargetWeights)
                && let Ok(Some(weights)) = held_weights(document, animation, channel, &place)
            {
                held.entry(channel.target.node.value()).or_insert(weights);
            }
        }
    }
    for (node, weights) in held {
        document.json.nodes[node].weights = Some(weights);
    }
}

/// Weights of morph targets that all keys of a channel hold, if they do.
fn held_weights(
    document: &Document<'_>,
    animation: &Animation,
    channel: &Channel,
    place: &str,
) -> Result<Option<Vec<f32>>, GltfError> {
    document.item(&document.json.nodes, channel.target.node.value(), &format!("{place}.target.node"))?;
    let sampler = document.item(&animation.samplers, channel.sampler.value(), &format!("{place}.sampler"))?;
    let keys = accessor::count(document, sampler.input.value(), place)?;
    let scalars = Purpose::Vectors(Type::Scalar);
    let values =
        accessor::read(document, (sampler.output.value(), Elements::All), place, scalars, |value| value as f32)?.values;
    let cubic = sampler.interpolation == Checked::Valid(Interpolation::CubicSpline);
    let targets = values.len().checked_div(if cubic { 3 * keys } else { keys }).unwrap_or(0);
    if targets == 0 {
        return Ok(None);
    }
    // Cubic keys have a list of slopes before and behind their list of values.
    let lists: Vec<&[f32]> = values.chunks_exact(targets).collect();
    let level = |slopes: &[f32]| keys == 1 || slopes.iter().all(|slope| *slope == 0.0);
    let (first, held) = match cubic {
        true => (lists[1], lists.as_chunks().0.iter().all(|[a, value, b]| *value == lists[1] && level(a) && level(b))),
        false => (lists[0], lists[..keys].iter().all(|value| *value == lists[0])),
    };
    Ok(held.then(|| first.to_vec()))
}

/// Keys of every animated node, by the node's index.
pub(super) fn moved(document: &Document<'_>, notices: &mut Notices) -> Result<BTreeMap<usize, NodeKeys>, GltfError> {
    let mut moved = BTreeMap::<usize, NodeKeys>::new();
    for (number, animation) in document.json.animations.iter().enumerate() {
        let of_animation = read(document, number, animation, notices)?;
        for (node, channels) in repeated(of_animation) {
            if moved.entry(node).or_default().complete(channels) {
                notices.add("nodes that several animations move follow the first".into());
            }
        }
    }
    Ok(moved)
}

/// Keys of the nodes that one animation moves.
fn read(
    document: &Document<'_>,
    number: usize,
    animation: &Animation,
    notices: &mut Notices,
) -> Result<BTreeMap<usize, NodeKeys>, GltfError> {
    let mut moved = BTreeMap::<usize, NodeKeys>::new();
    for (index, channel) in animation.channels.iter().enumerate() {
        let place = format!("animations[{number}].channels[{index}]");
        match self::channel(document, animation, channel, &place, notices) {
            Ok((node, keys)) => {
                moved.entry(node).or_default().complete(keys);
            }
            Err(error) => notices.left_out(Part::Animation, &place, &error.part_fault()?),
        }
    }
    Ok(moved)
}

/// Node that a channel moves, and its keys.
fn channel(
    document: &Document<'_>,
    animation: &Animation,
    channel: &Channel,
    place: &str,
    notices: &mut Notices,
) -> Result<(usize, NodeKeys), GltfError> {
    let stands_still = |why: &str| Err(document.damaged(place, why));
    let node = channel.target.node.value();
    let target = document.item(&document.json.nodes, node, &format!("{place}.target.node"))?;
    let sampler = document.item(&animation.samplers, channel.sampler.value(), &format!("{place}.sampler"))?;
    let (Checked::Valid(path), Checked::Valid(interpolation)) = (channel.target.path, sampler.interpolation) else {
        return stands_still("its path or its interpolation is unknown");
    };
    if target.matrix.is_some() {
        return stands_still("it moves a node that has a matrix");
    }
    let fault = |fault: KeyFault| document.damaged(place, fault.to_string());
    let mut keys = NodeKeys::default();
    match path {
        Property::MorphTargetWeights => {
            return match held_weights(document, animation, channel, place)? {
                Some(_) => Ok((node, keys)),
                None => stands_still("it changes a shape (morph targets)"),
            };
        }
        Property::Rotation => {
            let read = KeyList::read(document, animation, (channel, place), Type::Vec4, DQuat::from_array, notices)?;
            let jumps = interpolation == Interpolation::Step;
            keys.rotation = Some(match read.held(DQuat::from_array([0.0; 4])) {
                Some(value) if value.length().is_normal() => Track::Fixed(value.normalize()),
                _ if jumps => return stands_still("it jumps (STEP), which is faster than light"),
                _ => Track::Keyed(
                    match read.tangents {
                        Some(tangents) => TrackKeys::cubic_rotation(read.times, read.values, tangents),
                        None => TrackKeys::slerp(read.times, read.values),
                    }
                    .map_err(fault)?,
                ),
            });
        }
        Property::Translation | Property::Scale => {
            let read = KeyList::read(document, animation, (channel, place), Type::Vec3, DVec3::from_array, notices)?;
            let jumps = interpolation == Interpolation::Step;
            let track = match read.held(DVec3::ZERO) {
                Some(value) if value.is_finite() => Track::Fixed(value),
                _ if jumps => return stands_still("it jumps (STEP), which is faster than light"),
                _ => Track::Keyed(
                    match read.tangents {
                        Some(tangents) => TrackKeys::<DVec3>::cubic(read.times, read.values, tangents),
                        None => TrackKeys::linear(read.times, read.values),
                    }
                    .map_err(fault)?,
                ),
            };
            if path == Property::Translation {
                keys.translation = Some(track);
            } else {
                keys.scale = Some(track);
            }
        }
    }
    Ok((node, keys))
}

/// Keys of a channel: times in seconds, values, and slopes into and out of each key if they are cubic.
struct KeyList<V> {
    times: Vec<f64>,
    values: Vec<V>,
    tangents: Option<Vec<[V; 2]>>,
}

impl<V: Copy + PartialEq> KeyList<V> {
    /// Keys with values of `WIDTH` components. Of keys at one time the later counts, and surplus values are passed
    /// over, because exporters share lists.
    fn read<const WIDTH: usize>(
        document: &Document<'_>,
        animation: &Animation,
        (channel, place): (&Channel, &str),
        of: Type,
        from: impl Fn([f64; WIDTH]) -> V,
        notices: &mut Notices,
    ) -> Result<Self, GltfError> {
        let sampler = &animation.samplers[channel.sampler.value()];
        let numbers = |index: usize, of| {
            accessor::read(document, (index, Elements::All), place, Purpose::Vectors(of), |value| value)
        };
        let times = numbers(sampler.input.value(), Type::Scalar)?.values;
        let values = numbers(sampler.output.value(), of)?.values;
        let mut values: Vec<V> = values.as_chunks::<WIDTH>().0.iter().copied().map(from).collect();
        document.take(KEY_BYTES * times.len() as u64, place)?;
        let cubic = sampler.interpolation == Checked::Valid(Interpolation::CubicSpline);
        let each = if cubic { 3 } else { 1 };
        if values.len() > each * times.len() {
            notices.add(format!("{place} has more values than times: the surplus is passed over"));
            values.truncate(each * times.len());
        }
        let (values, tangents) = if cubic {
            let (values, tangents) = thirds(values);
            (values, Some(tangents))
        } else {
            (values, None)
        };
        let mut keys = Self { times, values, tangents };
        keys.keep_later(place, notices);
        Ok(keys)
    }

    /// Leaves out each key that has the same time as the next.
    fn keep_later(&mut self, place: &str, notices: &mut Notices) {
        let count = self.times.len();
        if self.values.len() != count || !self.times.windows(2).any(|pair| pair[0] == pair[1]) {
            return;
        }
        notices.add(format!("{place} has several keys at one time: the last of them counts"));
        let kept: Vec<usize> = (0..count).filter(|&key| self.times.get(key + 1) != Some(&self.times[key])).collect();
        self.times = kept.iter().map(|&key| self.times[key]).collect();
        self.values = kept.iter().map(|&key| self.values[key]).collect();
        if let Some(tangents) = &mut self.tangents {
            *tangents = kept.iter().map(|&key| tangents[key]).collect();
        }
    }

    /// Value that all keys hold, if there is one and no slope, other than `none`, leads away from it.
    fn held(&self, none: V) -> Option<V> {
        let first = self.values.first()?;
        let alike = self.times.len() == self.values.len() && self.values.iter().all(|value| first == value);
        let mut slopes = self.tangents.iter().flatten().flatten();
        let level = self.values.len() == 1 || slopes.all(|slope| *slope == none);
        (alike && level).then_some(*first)
    }
}

/// Separates triples (slope into a key, its value, slope out of it) into values and slopes.
fn thirds<V: Copy>(values: Vec<V>) -> (Vec<V>, Vec<[V; 2]>) {
    values.as_chunks::<3>().0.iter().map(|[into, value, out]| (*value, [*into, *out])).unzip()
}

/// Makes an animation that ends as it began repeat for ever; leaves any other as it is.
fn repeated(mut moved: BTreeMap<usize, NodeKeys>) -> BTreeMap<usize, NodeKeys> {
    fn span<V: Copy>(track: &Option<Track<V>>) -> Option<[f64; 2]> {
        match track {
            Some(Track::Keyed(keys)) => Some(keys.span_s()),
            _ => None,
        }
    }
    fn ends<V: Copy>(track: &Option<Track<V>>) -> Option<[V; 2]> {
        match track {
            Some(Track::Keyed(keys)) => Some(keys.ends()),
            _ => None,
        }
    }
    /// Repeats the keys of a track; `end` gives the last value from the first and the last.
    fn repeat<V: Copy>(track: &mut Option<Track<V>>, whole: [f64; 2], end: impl Fn([V; 2]) -> V) {
        if let Some(Track::Keyed(keys)) = track {
            let last = end(keys.ends());
            *keys = keys.clone().repeating(whole, last);
        }
    }
    let spans = moved.values().flat_map(|of| [span(&of.translation), span(&of.rotation), span(&of.scale)]);
    let whole = spans.flatten().reduce(|[from, to], [first, last]| [from.min(first), to.max(last)]);
    let Some(whole) = whole.filter(|[from, to]| from < to) else { return moved };
    let same_place = |[first, last]: [DVec3; 2]| first.distance(last) <= SAME * (1.0 + first.length());
    let same_turn = |[first, last]: [DQuat; 2]| {
        let [first, last] = [first, last].map(DQuat::normalize);
        (1.0 - first.dot(last).abs()) <= SAME * SAME
    };
    let returns = moved.values().all(|of| {
        ends(&of.translation).is_none_or(same_place)
            && ends(&of.rotation).is_none_or(same_turn)
            && ends(&of.scale).is_none_or(same_place)
    });
    if returns {
        for of in moved.values_mut() {
            repeat(&mut of.translation, whole, |[first, _]| first);
            repeat(&mut of.scale, whole, |[first, _]| first);
            // Both signs of a quaternion are the same rotation. The sign of the last key must stay, as it fixes the
            // way there.
            repeat(&mut of.rotation, whole, |[first, last]| if first.dot(last) < 0.0 { -first } else { first });
        }
    }
    moved
}
