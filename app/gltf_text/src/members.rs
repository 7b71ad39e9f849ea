//! Members that cannot be read, and their removal, so that the rest of an item can.

use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_path_to_error::{Path, Segment};

/// Number of faults that one item may have; an item with more is given up.
const MOST_FAULTS: usize = 16;

/// Keys of lists of indices, from which a single index can be left out.
const INDEX_LISTS: [&str; 2] = ["children", "nodes"];

/// Removes the members of an item that cannot be read as part of a `T`, and gives their paths in the item and their
/// faults. `spared` is true for the path of a member without which the rest means the same.
///
/// # Errors
/// First fault of an item that cannot be read all the same; the item stays as it was.
pub(crate) fn remove_unreadable<T: DeserializeOwned>(
    item: &mut Value,
    spared: impl Fn(&str) -> bool,
) -> Result<Vec<(String, String)>, String> {
    let Err((_, first)) = read::<T>(item) else { return Ok(Vec::new()) };
    let mut mended = item.clone();
    let mut removed = Vec::new();
    for _ in 0..MOST_FAULTS {
        let Err((path, fault)) = read::<T>(&mended) else {
            *item = mended;
            return Ok(removed);
        };
        let Some(member) = remove_at(&mut mended, &path).filter(|member| spared(member)) else { break };
        removed.push((member, fault));
    }
    Err(first)
}

/// Reads an item; else the path to the fault, and the fault.
fn read<T: DeserializeOwned>(item: &Value) -> Result<(), (Path, String)> {
    match serde_path_to_error::deserialize::<_, T>(item) {
        Ok(_) => Ok(()),
        Err(error) => Err((error.path().clone(), error.inner().to_string())),
    }
}

/// Removes the innermost member on a path, and gives its own path. Of a list of indices, one index is removed.
fn remove_at(item: &mut Value, path: &Path) -> Option<String> {
    let segments: Vec<&Segment> = path.iter().collect();
    let last = segments.iter().rposition(|segment| matches!(segment, Segment::Map { .. }))?;
    let of_list = |index: usize| match (segments[index], segments.get(index + 1)) {
        (Segment::Map { key }, Some(Segment::Seq { index })) if INDEX_LISTS.contains(&key.as_str()) => Some(*index),
        _ => None,
    };
    let mut parent = &mut *item;
    let mut place = String::new();
    for segment in &segments[..last] {
        (parent, place) = match segment {
            Segment::Map { key } => (parent.get_mut(key)?, format!("{place}.{key}")),
            Segment::Seq { index } => (parent.get_mut(*index)?, format!("{place}[{index}]")),
            Segment::Enum { .. } | Segment::Unknown => return None,
        };
    }
    let Segment::Map { key } = segments[last] else { return None };
    let place = format!("{place}.{key}");
    if let Some(index) = of_list(last) {
        let list = parent.get_mut(key)?.as_array_mut()?;
        return (index < list.len()).then(|| {
            list.remove(index);
            format!("{place}[{index}]")
        });
    }
    parent.as_object_mut()?.remove(key)?;
    Some(place)
}
